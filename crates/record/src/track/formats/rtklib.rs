//! RTKLIB: solutions (`.pos`), with the names in the last comment above the rows.

use super::{Format, Known, Label, PLAIN, has};
use crate::track::{Aside, Delimiter};

pub(super) const FORMAT: Format = Format {
    name: "RTKLIB .pos",
    about: "positions that RTKLIB computed from GNSS observations",
    known_by: "a comment `% GPST` (`UTC`, `JST`) with the names of a position",
    maps: "time as date and clock, or as GPS week and seconds; units from the names; the quality `Q` and the number of \
           satellites `ns` are no channels",
    known: |text| header(text).is_some(),
    complete,
    label: |_, name| match name {
        "Q" | "ns" => Label::aside(Aside::Quality),
        _ => Label::default(),
    },
    utc: true,
    ..PLAIN
};

/// The names, as the last comment above the rows has them.
fn header(text: &str) -> Option<&str> {
    if !has(text, "latitude(") && !has(text, "x-ecef(") && !has(text, "e-baseline(") {
        return None;
    }
    let is = |line: &&str| {
        let mut words = line.trim_start_matches('%').split_whitespace();
        let time = words.next().is_some_and(|w| matches!(w, "GPST" | "UTC" | "JST"));
        let position = ["latitude(", "x-ecef(", "e-baseline("];
        line.starts_with('%') && time && words.next().is_some_and(|w| position.iter().any(|p| w.starts_with(p)))
    };
    text.lines().find(is)
}

fn complete(text: &str, known: &mut Known) {
    let Some(line) = header(text) else { return };
    known.options.delimiter.get_or_insert(Delimiter::Blanks);
    let first = text.lines().find(|l| !l.starts_with('%') && !l.trim().is_empty()).unwrap_or("");
    let week = first.split_whitespace().next().is_some_and(|w| w.parse::<u32>().is_ok());
    let mut words = line.trim_start_matches('%').split_whitespace();
    let clock = words.next().unwrap_or("GPST");
    // A time is two cells: date and time of day, or week and its seconds.
    let start = if week { ["week", "tow"] } else { [clock, "time of day"] };
    let mut names: Vec<String> = start.map(str::to_owned).to_vec();
    for word in words {
        // Degrees, minutes and seconds are three cells under one name.
        match word.strip_suffix("(d'\")") {
            Some(angle) => names.extend(["deg", "min", "sec"].map(|unit| format!("{angle}({unit})"))),
            None => names.push(word.to_owned()),
        }
    }
    known.name(names.iter().map(String::as_str));
    if clock == "GPST" {
        known.said.push("times are those of GPS, which count no leap seconds".to_owned());
    }
}
