//! What Matlab stores in its files: MAT 7.3 is HDF5 with a text of 512 bytes before it.

use super::attributes::Attributes;
use super::scalar::Kind;

/// How such a file begins.
pub(in super::super) const BEGINNING: &[u8] = b"MATLAB 7.3 MAT";

/// True for the bytes of such a file.
pub(super) fn is_matlab(bytes: &[u8]) -> bool {
    bytes.starts_with(BEGINNING)
}

/// Why an array of Matlab is not read, where it is not.
pub(super) fn unread(about: &Attributes) -> Option<&'static str> {
    if about.has("MATLAB_object_decode") {
        return Some("an object, as tables and datetimes are: save its columns as vectors, times with datenum or posixtime");
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
