//! FLUXNET and AmeriFlux: fluxes of eddy covariance stations, under names that tell their units by agreement.

use super::{Format, Known, Label, PLAIN, has, line_where};
use crate::track::{Aside, Delimiter};

pub(super) const FORMAT: Format = Format {
    name: "FLUXNET",
    about: "fluxes and weather of eddy covariance stations (FLUXNET, AmeriFlux, ICOS)",
    known_by: "the names begin with `TIMESTAMP_START` or `TIMESTAMP`, with `_F` or `_QC` among them",
    maps: "time `TIMESTAMP_START` (or `TIMESTAMP`); units by convention; columns `_QC`, `_TEST` and `NIGHT` are not \
           channels; -9999 means missing",
    known: |text| header(text).is_some(),
    complete,
    label: |_, name| label(name),
    ..PLAIN
};

fn header(text: &str) -> Option<usize> {
    if !has(text, "TIMESTAMP") {
        return None;
    }
    line_where(text, |line| {
        let line = line.trim_start_matches('\u{feff}');
        let names: Vec<&str> = line.split(',').map(str::trim).collect();
        let agreed = |n: &&str| n.ends_with("_QC") || n.ends_with("_F") || n.contains("_F_");
        names.starts_with(&["TIMESTAMP_START", "TIMESTAMP_END"])
            || (names.first() == Some(&"TIMESTAMP") && names.iter().any(agreed))
    })
    .filter(|at| *at < 20)
}

fn complete(text: &str, known: &mut Known) {
    known.options.delimiter.get_or_insert(Delimiter::Byte(b','));
    let header = header(text);
    known.header(header);
    let line = header.and_then(|at| text.lines().nth(at)).unwrap_or("");
    known.time(if line.contains("TIMESTAMP_START") { "TIMESTAMP_START" } else { "TIMESTAMP" });
    known.missing(["-9999"]);
}

/// Units of variables by the first words of their names, as FLUXNET and AmeriFlux agree on them; longer ones first.
const UNITS: [(&str, &str); 32] = [
    ("SW_", "W m-2"),
    ("LW_", "W m-2"),
    ("NETRAD", "W m-2"),
    ("PPFD_", "umol m-2 s-1"),
    ("TA", "degC"),
    ("TS", "degC"),
    ("T_SONIC", "degC"),
    ("VPD", "hPa"),
    ("PA", "kPa"),
    ("RH", "%"),
    ("P", "mm"),
    ("WS", "m s-1"),
    ("WD", "deg"),
    ("USTAR", "m s-1"),
    ("CO2", "umol mol-1"),
    ("CH4", "nmol mol-1"),
    ("H2O", "mmol mol-1"),
    ("FCH4", "nmol m-2 s-1"),
    ("FC", "umol m-2 s-1"),
    ("FH2O", "mmol m-2 s-1"),
    ("NEE", "umol m-2 s-1"),
    ("RECO", "umol m-2 s-1"),
    ("GPP", "umol m-2 s-1"),
    ("SC", "umol m-2 s-1"),
    ("LE", "W m-2"),
    ("H", "W m-2"),
    ("G", "W m-2"),
    ("SWC", "%"),
    ("WTD", "m"),
    ("TAU", "kg m-1 s-2"),
    ("ZL", ""),
    ("MO_LENGTH", "m"),
];

fn label(name: &str) -> Label {
    let words: Vec<&str> = name.split('_').collect();
    if words.iter().any(|w| matches!(*w, "QC" | "TEST" | "SSITC")) {
        return Label { unit: Some(String::new()), aside: Some(Aside::Quality) };
    }
    if name == "NIGHT" {
        return Label { unit: Some(String::new()), aside: Some(Aside::Flag) };
    }
    if name.starts_with("TIMESTAMP") {
        return Label { unit: Some(String::new()), aside: Some(Aside::Time) };
    }
    let fits = |(start, _): &&(&str, &str)| match start.strip_suffix('_') {
        Some(_) => name.starts_with(start),
        None => name.strip_prefix(start).is_some_and(|rest| rest.is_empty() || rest.starts_with('_')),
    };
    Label { unit: UNITS.iter().find(fits).map(|(_, unit)| (*unit).to_owned()), aside: None }
}
