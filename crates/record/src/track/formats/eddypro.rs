//! EddyPro: full output and biomet files, with groups above the names and units below them.

use super::{Format, Known, Label, PLAIN, has, line_where};
use crate::track::{Aside, Delimiter};

pub(super) const FORMAT: Format = Format {
    name: "EddyPro",
    about: "full output of the flux software of LI-COR",
    known_by: "the names `filename,date,time`, or `file_info` above them",
    maps: "time from `date` and `time`; units in the line below the names; columns `qc_`, `daytime` and counts of records \
           are not channels; -9999 means missing",
    known: |text| header(text).is_some(),
    complete,
    label: |_, name| label(name),
    ..PLAIN
};

fn header(text: &str) -> Option<usize> {
    if !has(text, "filename,date,time") {
        return None;
    }
    line_where(text, |line| line.trim_start_matches('\u{feff}').starts_with("filename,date,time,")).filter(|at| *at < 3)
}

fn complete(text: &str, known: &mut Known) {
    known.options.delimiter.get_or_insert(Delimiter::Byte(b','));
    let header = header(text);
    known.header(header);
    if let Some(at) = header.filter(|at| text.lines().nth(at + 1).is_some_and(|l| l.contains("[yyyy-mm-dd]"))) {
        known.units(at + 1);
    }
    known.missing(["-9999", "-9999.0"]);
}

fn label(name: &str) -> Label {
    let aside = match name {
        "DOY" => Some(Aside::Time),
        "daytime" => Some(Aside::Flag),
        "file_records" | "used_records" => Some(Aside::Quality),
        _ if name.starts_with("qc_") || name.ends_with("_hf") || name.ends_with("_LI-7200") => Some(Aside::Quality),
        _ => None,
    };
    Label { unit: None, aside }
}
