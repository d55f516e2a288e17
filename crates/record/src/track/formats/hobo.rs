//! HOBOware: exports of Onset loggers. A name carries the unit and, in brackets, the serial numbers of logger and sensor.

use super::{Format, Known, Label, PLAIN, line_where, month_first_unless_shown};
use crate::track::Aside;

pub(super) const FORMAT: Format = Format {
    name: "HOBO",
    about: "exports of Onset loggers, as HOBOware writes them",
    known_by: "`Plot Title` in the first line, `LGR S/N` or `Date Time, GMT` in the names",
    maps: "units from the names (`Temp, °F (LGR S/N: …)`); `#` and the logger's event columns (`Logged`) \
           are not channels; clocks are those of the zone in the header",
    known: |text| {
        let mut lines = text.lines().take(4);
        lines.any(|l| l.trim_start_matches(['\u{feff}', '"']).starts_with("Plot Title") || is_header(l))
    },
    complete,
    label: |_, name| label(name),
    ..PLAIN
};

fn is_header(line: &str) -> bool {
    let named = ["LGR S/N", "Date Time, GMT", "Date-Time ("].iter().any(|word| line.contains(word));
    named && line.contains("Date")
}

/// What the logger notes beside the samples.
const NOTES: [&str; 11] = [
    "Coupler Detached",
    "Coupler Attached",
    "Host Connect",
    "New Interval",
    "Water Detect",
    "Stopped",
    "End Of File",
    "Button Up",
    "Button Down",
    "Bad Battery",
    "Good Battery",
];

fn complete(text: &str, known: &mut Known) {
    let header = line_where(text, is_header).or_else(|| line_where(text, |l| l.contains("Date") && l.contains("Time")));
    known.header(header);
    month_first_unless_shown(text, &mut known.options);
}

fn label(name: &str) -> Label {
    if name == "#" {
        return Label { unit: Some(String::new()), aside: Some(Aside::Index) };
    }
    if NOTES.iter().any(|note| name.starts_with(note)) {
        return Label { unit: Some(String::new()), aside: Some(Aside::Flag) };
    }
    // `Temp, °F (LGR S/N: 1, SEN S/N: 2, LBL: water)`
    let bare = ["(LGR S/N", "(SEN S/N", "(LBL"].iter().filter_map(|open| name.find(open)).min();
    let bare = name[..bare.unwrap_or(name.len())].trim();
    // HOBOconnect writes `Ch: 1 - Temperature   (°C)`.
    let bracketed = bare.strip_suffix(')').and_then(|b| b.rsplit_once('('));
    let unit = bare.rsplit_once(", ").or(bracketed).map(|(_, unit)| unit.trim().to_owned());
    Label { unit: unit.filter(|unit| !unit.is_empty() && !bare.starts_with("Date")), aside: None }
}
