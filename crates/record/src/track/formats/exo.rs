//! YSI EXO: exports of Kor, in which a name ends with its unit.

use super::{Format, Known, Label, PLAIN, has, line_where, names_in};
use crate::track::Aside;

pub(super) const FORMAT: Format = Format {
    name: "YSI EXO",
    about: "exports of water quality sondes, as Kor writes them",
    known_by: "`KOR` and `Export` in the first line, or the names `Time (Fract. Sec)` and `Site Name`",
    maps: "time from date and `Time (HH:mm:ss)`; units from the ends of the names (`Cond µS/cm`); fault codes are not channels",
    known: |text| {
        let first = text.lines().next().unwrap_or("").to_uppercase();
        header(text).is_some() || (first.contains("KOR") && first.contains("EXPORT"))
    },
    complete,
    label: |_, name| label(name),
    ..PLAIN
};

fn header(text: &str) -> Option<usize> {
    if !has(text, "(Fract. Sec)") && !has(text, "Time (HH:mm:ss)") {
        return None;
    }
    line_where(text, |line| {
        line.contains("(Fract. Sec)") || (line.contains("Date (") && line.contains("Time (HH:mm:ss)"))
    })
}

fn complete(text: &str, known: &mut Known) {
    let header = header(text);
    known.header(header);
    let names = header.and_then(|at| text.lines().nth(at)).map(names_in).unwrap_or_default();
    if let Some(date) = names.iter().find(|n| n.starts_with("Date (")) {
        known.options.day_first.get_or_insert(date.contains("(DD"));
    }
}

/// Units that stand at the ends of names, longest first where one ends another.
const UNITS: [&str; 32] = [
    "% CB", "% sat", "% local", "mg/L", "µg/L", "ug/L", "µS/cm", "uS/cm", "mS/cm", "psu", "ppt", "QSU", "RFU", "FNU",
    "NTU", "psi a", "psi g", "psi", "mmHg", "mbar", "kPa", "°C", "C", "°F", "mV", "volt", "V", "PPB", "cells/mL", "ft",
    "m", "%",
];

fn label(name: &str) -> Label {
    if name.contains("(Fract. Sec)") {
        return Label { unit: Some("s".to_owned()), aside: Some(Aside::Time) };
    }
    if name.contains("Fault Code") {
        return Label { unit: Some(String::new()), aside: Some(Aside::Quality) };
    }
    let ends = |unit: &&&str| name.strip_suffix(**unit).is_some_and(|rest| rest.ends_with([' ', '-']));
    Label { unit: UNITS.iter().find(ends).map(|unit| (*unit).to_owned()), aside: None }
}
