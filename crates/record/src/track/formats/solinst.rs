//! Solinst: exports of Levelogger and Barologger, with the unit of each channel above the table.

use super::{Format, Known, Label, PLAIN, line_where, names_in};
use crate::track::Aside;

pub(super) const FORMAT: Format = Format {
    name: "Solinst",
    about: "exports of Levelogger and Barologger",
    known_by: "`Serial_number:` at the start, the names `Date`, `Time`, `ms` below `UNIT:`",
    maps: "time from `Date`, `Time` and `ms`; the unit of a channel from the `UNIT:` line below its name",
    known: |text| {
        let keys = text.lines().take(12).any(|l| l.to_lowercase().starts_with("serial_number"));
        keys && header(text).is_some()
    },
    complete,
    label,
    ..PLAIN
};

fn header(text: &str) -> Option<usize> {
    line_where(text, |line| {
        let names = names_in(line);
        names.first() == Some(&"Date") && names.get(1) == Some(&"Time")
    })
}

fn complete(text: &str, known: &mut Known) {
    known.header(header(text));
}

fn label(text: &str, name: &str) -> Label {
    if name.eq_ignore_ascii_case("ms") {
        return Label { unit: Some("ms".to_owned()), aside: Some(Aside::Time) };
    }
    let lines: Vec<&str> = text.lines().map(|l| l.trim_end_matches([',', ';', '\r']).trim()).collect();
    let at = lines.iter().position(|l| *l == name);
    // The unit stands right below the name, or a line further down.
    let below = at.map_or(&[][..], |at| &lines[at + 1..(at + 3).min(lines.len())]);
    let unit = below.iter().find_map(|l| l.to_uppercase().starts_with("UNIT:").then(|| l[5..].trim().to_owned()));
    Label { unit, aside: None }
}
