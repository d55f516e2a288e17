//! USGS RDB: tab-delimited tables of the National Water Information System.

use super::{Format, Known, Label, PLAIN, has, line_where};
use crate::track::{Aside, Delimiter};

pub(super) const FORMAT: Format = Format {
    name: "USGS RDB",
    about: "tables of the National Water Information System",
    known_by: "a line of names that begins with `agency_cd` and tabs",
    maps: "time `datetime`, in the zone given by `tz_cd` in each row; units from the list of parameters in the comments; \
           columns `_cd` are not channels; remarks like `Ice` and `Eqp` mean missing",
    known: |text| header(text).is_some(),
    complete,
    label,
    ..PLAIN
};

fn header(text: &str) -> Option<usize> {
    if !has(text, "agency_cd\t") {
        return None;
    }
    line_where(text, |line| line.starts_with("agency_cd\t"))
}

/// Remarks that stand in place of a value, as the USGS lists them.
const REMARKS: [&str; 23] = [
    "Ssn", "Ice", "Pr", "Rat", "Eqp", "Fld", "Dry", "Dis", "***", "--", "Mnt", "ZFl", "Bkw", "Tst", "Dam", "Df", "Em",
    "Ent", "Eq", "Pmp", "Wnd", "Zfl", "Unk",
];

fn complete(text: &str, known: &mut Known) {
    known.options.delimiter.get_or_insert(Delimiter::Byte(b'\t'));
    known.header(header(text));
    known.missing(REMARKS);
    let names = header(text).and_then(|at| text.lines().nth(at)).unwrap_or("");
    if let Some(time) = names.split('\t').find(|n| *n == "datetime") {
        known.time(time);
    }
}

fn label(text: &str, name: &str) -> Label {
    if name.ends_with("_cd") {
        return Label { unit: Some(String::new()), aside: Some(Aside::Quality) };
    }
    if name == "site_no" {
        return Label { unit: Some(String::new()), aside: Some(Aside::Id) };
    }
    Label { unit: unit(text, name), aside: None }
}

/// The unit of `12345_00060` or `01_00060_00003`: what follows the last comma in the list of parameters,
/// `#    12345    00060    Discharge, cubic feet per second`; a statistic in brackets may follow.
fn unit(text: &str, name: &str) -> Option<String> {
    let mut codes = name.split('_');
    let (series, parameter) = (codes.next()?, codes.next()?);
    let described = |line: &&str| {
        let mut words = line.trim_start_matches('#').split_whitespace();
        line.starts_with('#') && words.next() == Some(series) && words.next() == Some(parameter)
    };
    let line = text.lines().find(described)?;
    let words = line.split('(').next()?.rsplit_once(',')?.1.trim();
    Some(match words {
        "cubic feet per second" => "ft3/s".to_owned(),
        "feet" => "ft".to_owned(),
        "feet per second" => "ft/s".to_owned(),
        "degrees Celsius" => "degC".to_owned(),
        "inches" => "in".to_owned(),
        other => other.to_owned(),
    })
}
