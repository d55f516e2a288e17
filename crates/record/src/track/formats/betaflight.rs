//! Betaflight and its relatives: blackbox logs as CSV, as `blackbox_decode` and the Blackbox Explorer write them.

use super::{Format, Known, Label, PLAIN, has, line_where, names_in};
use crate::track::{Aside, Delimiter, TimeUnit, Worded};

pub(super) const FORMAT: Format = Format {
    name: "Betaflight blackbox",
    about: "flight logs of Betaflight, Cleanflight and INAV, decoded to CSV",
    known_by: "the names `loopIteration` and `time`",
    maps: "time in microseconds; units from the names; the count of loops and the flags are not channels",
    known: |text| header(text).is_some(),
    complete,
    label: |_, name| match name {
        "loopIteration" => Label::aside(Aside::Counter),
        _ if name.to_lowercase().contains("flags") || name.starts_with("failsafe") => Label::aside(Aside::Flag),
        _ => Label::default(),
    },
    ..PLAIN
};

fn header(text: &str) -> Option<usize> {
    if !has(text, "loopIteration") {
        return None;
    }
    line_where(text, |line| {
        let mut names = names_in(line).into_iter();
        names.next() == Some("loopIteration") && names.next().is_some_and(|n| n == "time" || n.starts_with("time ("))
    })
}

fn complete(text: &str, known: &mut Known) {
    known.options.delimiter.get_or_insert(Delimiter::Byte(b','));
    let header = header(text);
    known.header(header);
    let names = header.and_then(|at| text.lines().nth(at)).map(names_in).unwrap_or_default();
    if let Some(time) = names.get(1) {
        known.time(time);
    }
    if known.options.time_unit.is_none() {
        known.options.time_unit = TimeUnit::of_word("us");
    }
}
