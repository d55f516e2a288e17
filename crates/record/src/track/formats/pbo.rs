//! PBO: daily positions of stations of the Plate Boundary Observatory, as CSV and as `.pos`.

use super::{Format, Known, Label, PLAIN, line_where};
use crate::track::{Aside, Delimiter};

pub(super) const FORMAT: Format = Format {
    name: "PBO",
    about: "daily positions of GNSS stations of the Plate Boundary Observatory (CSV and .pos)",
    known_by: "`PBO Station` or `Station Time Series` in the first lines, or `4-character ID` above the names",
    maps: "time `Date`, or `YYYYMMDD` and `HHMMSS`; units from the names, or by convention; the quality is not a channel",
    known: |text| {
        let head = text.lines().take(12).any(|l| {
            l.starts_with("PBO Station") || l.starts_with("4-character ID") || l.starts_with("Station Time Series")
        });
        head && (csv(text).is_some() || pos(text).is_some())
    },
    complete,
    label: |text, name| if pos(text).is_some() { label(name) } else { Label::default() },
    utc: true,
    ..PLAIN
};

fn csv(text: &str) -> Option<usize> {
    line_where(text, |line| line.starts_with("Date,"))
}

fn pos(text: &str) -> Option<usize> {
    line_where(text, |line| line.starts_with("*YYYYMMDD"))
}

fn complete(text: &str, known: &mut Known) {
    if let Some(at) = csv(text) {
        known.header(Some(at));
        known.time("Date");
        return;
    }
    let Some(at) = pos(text) else { return };
    let line = text.lines().nth(at).unwrap_or("").trim_start_matches('*');
    let options = &mut known.options;
    if options.header_line.is_none() {
        options.skip.get_or_insert(at + 1);
        options.header.get_or_insert(false);
        options.delimiter.get_or_insert(Delimiter::Blanks);
    }
    known.name(line.split_whitespace());
    known.time("YYYYMMDD,HHMMSS");
}

/// The columns of a `.pos` file, as its field description has them.
fn label(name: &str) -> Label {
    match name {
        "JJJJJ.JJJJ" => Label { unit: Some("d".to_owned()), aside: Some(Aside::Time) },
        "NLat" | "Elong" => Label::unit("deg"),
        _ if name.starts_with('R') => Label::unit(""),
        "X" | "Y" | "Z" | "Height" | "dN" | "dE" | "dU" => Label::unit("m"),
        _ if name.starts_with('S') && name.len() == 2 => Label::unit("m"),
        _ => Label::default(),
    }
}
