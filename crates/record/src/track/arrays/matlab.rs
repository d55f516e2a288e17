//! What Matlab stores in its files: MAT 7.3 is HDF5 with a text of 512 bytes before it.

use super::super::names::time_rank;
use super::attributes::Attributes;
use super::scalar::{Kind, Scalar};

/// How such a file begins.
pub(in super::super) const BEGINNING: &[u8] = b"MATLAB 7.3 MAT";

/// True for the bytes of such a file.
pub(super) fn is_matlab(bytes: &[u8]) -> bool {
    bytes.starts_with(BEGINNING)
}

/// Why an array of Matlab is not read, where it is not.
pub(super) fn unread(about: &Attributes) -> Option<&'static str> {
    if about.has("MATLAB_object_decode") {
        return Some(
            "an object, as tables and datetimes are: save its columns as vectors, times with datenum or posixtime",
        );
    }
    if about.has("MATLAB_empty") {
        return Some("empty");
    }
    match about.text("MATLAB_class")? {
        "char" | "string" => Some("text"),
        "cell" => Some("cells"),
        "function_handle" => Some("a function"),
        _ => None,
    }
}

/// How values of a class are meant.
pub(super) fn kind(stored: Kind, about: &Attributes) -> Kind {
    if about.text("MATLAB_class") == Some("logical") { Kind::truth() } else { stored }
}

/// The days that Matlab counts from 1900 to 2100.
const DAYS: std::ops::Range<f64> = 693_962.0..767_011.0;

/// True for numbers under the name of a time that are days as Matlab counts them (`datenum`), in two hundred years around ours.
pub(super) fn are_datenums(name: &str, values: impl Iterator<Item = Scalar>) -> bool {
    let base = name.rsplit('/').next().unwrap_or(name);
    let named = time_rank(base) > 0 || base.to_lowercase().contains("datenum") || base.eq_ignore_ascii_case("mtime");
    let mut present = values.map(Scalar::as_f64).filter(|value| !value.is_nan()).peekable();
    named && present.peek().is_some() && present.all(|value| DAYS.contains(&value))
}
