//! KNMI: hourly and daily data of the weather stations of the Netherlands, with a legend above.

use super::{Format, Known, Label, PLAIN, has, line_where};
use crate::track::{Aside, Delimiter};

pub(super) const FORMAT: Format = Format {
    name: "KNMI",
    about: "hourly and daily data of the weather stations of the Netherlands",
    known_by: "the names `STN,YYYYMMDD`",
    maps: "time from `YYYYMMDD` and `HH` (hours 1 to 24), in UT; units from the legend (`in 0.1 m/s`); codes of the weather \
           are no channels; a track for each station",
    known: |text| header(text).is_some(),
    complete,
    label,
    utc: true,
    ..PLAIN
};

fn header(text: &str) -> Option<usize> {
    if !has(text, "YYYYMMDD") {
        return None;
    }
    line_where(text, |line| {
        let bare: String = line.chars().filter(|c| !c.is_whitespace() && *c != '#').collect();
        bare.starts_with("STN,YYYYMMDD")
    })
}

fn complete(text: &str, known: &mut Known) {
    known.options.delimiter.get_or_insert(Delimiter::Byte(b','));
    known.header(header(text));
}

/// Codes and yes-or-no columns of the hourly data.
const CODES: [&str; 8] = ["WW", "IX", "M", "R", "S", "O", "Y", "VV"];

fn label(text: &str, name: &str) -> Label {
    if name == "STN" {
        return Label { unit: Some(String::new()), aside: Some(Aside::Id) };
    }
    if CODES.contains(&name) {
        return Label { unit: Some(String::new()), aside: Some(Aside::Quality) };
    }
    let described = |line: &str| {
        let line = line.trim_start_matches('#').trim();
        let (short, long) = line.split_once([':', '='])?;
        if short.trim() != name {
            return None;
        }
        // `Hourly mean wind speed (in 0.1 m/s)`, `… (in 0.1 hPa) …`
        let (_, rest) = long.split_once("(in ").or_else(|| long.split_once(" in "))?;
        Some(
            rest.trim_start_matches('(')
                .split([')', ';'])
                .next()?
                .trim()
                .replace("degrees Celsius", "degC")
                .replace("percents", "%"),
        )
    };
    Label { unit: text.lines().find_map(described), aside: None }
}
