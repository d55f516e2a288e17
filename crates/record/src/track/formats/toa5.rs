//! TOA5 and TOACI1: tables of Campbell Scientific loggers.

use super::{Format, Known, Label, PLAIN};
use crate::track::Aside;

pub(super) const FORMAT: Format = Format {
    name: "TOA5",
    about: "tables of Campbell Scientific data loggers",
    known_by: "`TOA5` (or `TOACI1`) in the first cell",
    maps: "time `TIMESTAMP`; names, units and the kind of processing in lines 2 to 4; `NAN` means missing",
    known: |text| kind(text).is_some(),
    complete,
    label: |_, name| match name {
        "RECORD" => Label { unit: Some(String::new()), aside: Some(Aside::Counter) },
        "TIMESTAMP" | "TMSTAMP" => Label::unit(""),
        _ => Label::default(),
    },
    ..PLAIN
};

/// What stands in the first cell.
fn kind(text: &str) -> Option<&'static str> {
    let first = text.split(',').next()?.trim().trim_matches('"');
    ["TOA5", "TOACI1"].into_iter().find(|kind| *kind == first)
}

fn complete(text: &str, known: &mut Known) {
    known.header(Some(1));
    if kind(text) == Some("TOA5") {
        known.units(2);
    }
    known.missing(["INF", "-INF"]);
}
