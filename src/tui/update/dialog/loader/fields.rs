//! What can be told the loader: one row for each option.

use crate::track::{LoadOptions, Pattern, Worded};

/// A field of the dialog.
#[derive(Debug)]
pub struct Field {
    /// Its name.
    pub name: &'static str,
    /// What it says, in a few words.
    pub help: &'static str,
    /// What is told, as text; none when it is detected.
    pub text: fn(&LoadOptions) -> Option<String>,
    /// The next of its values (1), or the one before (-1), where they can be counted up; the columns of the record are
    /// known.
    pub(super) step: Option<fn(&mut LoadOptions, &[String], isize)>,
    /// Back to what is detected.
    pub(super) clear: fn(&mut LoadOptions),
    /// Takes what was typed, where that makes sense.
    pub(super) take: Option<fn(&mut LoadOptions, &str)>,
    /// A text that it takes.
    #[cfg_attr(not(test), expect(dead_code, reason = "tests type it"))]
    example: &'static str,
}

impl Field {
    /// True when its value can be typed.
    #[must_use]
    pub fn is_typed(&self) -> bool {
        self.take.is_some()
    }
}

/// Every field, in the order of the dialog.
pub static FIELDS: &[Field] = &[
    Field {
        name: "time column",
        help: "a column, or the sample number",
        text: |o| o.time.clone().map(|t| if t == "sample" { "the sample number".into() } else { t }),
        step: Some(|o, columns, by| o.time = next(&named(columns, Some("sample")), o.time.clone(), by)),
        clear: |o| o.time = None,
        take: Some(|o, text| o.time = told(text)),
        example: "x",
    },
    Field {
        name: "time unit",
        help: "unit of numeric times",
        text: |o| o.time_unit.and_then(Worded::word).map(str::to_owned),
        step: Some(|o, _, by| o.time_unit = stepped(o.time_unit, by)),
        clear: |o| o.time_unit = None,
        take: None,
        example: "x",
    },
    Field {
        name: "time format",
        help: "like %d.%m.%Y %H:%M:%S%.f",
        text: |o| o.time_format.as_ref().map(|p| p.text().to_owned()),
        step: None,
        clear: |o| o.time_format = None,
        // What is no pattern yet is left as it was.
        take: Some(|o, text| o.time_format = Pattern::new(text).ok()),
        example: "%H:%M",
    },
    Field {
        name: "time zone",
        help: "time zone of times without one: Europe/Berlin, +01:00",
        text: |o| o.time_zone.clone(),
        step: None,
        clear: |o| o.time_zone = None,
        take: Some(|o, text| o.time_zone = told(text)),
        example: "UTC",
    },
    Field {
        name: "channels",
        help: "columns of numbers, separated by commas",
        text: |o| (!o.channels.is_empty()).then(|| o.channels.join(", ")),
        step: Some(|o, columns, by| {
            let now = o.channels.first().cloned();
            o.channels = next(&named(columns, None), now, by).into_iter().collect();
        }),
        clear: |o| o.channels.clear(),
        take: Some(|o, text| o.channels = list(text)),
        example: "x",
    },
    Field {
        name: "track column",
        help: "column with the track id, if the table has several tracks",
        text: |o| o.track.clone(),
        step: Some(|o, columns, by| o.track = next(&named(columns, None), o.track.clone(), by)),
        clear: |o| o.track = None,
        take: Some(|o, text| o.track = told(text)),
        example: "x",
    },
    Field {
        name: "truth column",
        help: "1 marks a true outlier",
        text: |o| o.truth.clone(),
        step: Some(|o, columns, by| o.truth = next(&named(columns, None), o.truth.clone(), by)),
        clear: |o| o.truth = None,
        take: Some(|o, text| o.truth = told(text)),
        example: "x",
    },
    Field {
        name: "missing markers",
        help: "texts for \"no value\", besides empty, NaN, NA, null and -",
        text: |o| (!o.missing.is_empty()).then(|| o.missing.join(", ")),
        step: None,
        clear: |o| o.missing.clear(),
        take: Some(|o, text| o.missing = list(text)),
        example: "x",
    },
    Field {
        name: "header line",
        help: "line with the column names, from 1",
        text: |o| o.header_line.map(|n| n.to_string()),
        step: Some(|o, _, by| o.header_line = counted(o.header_line, by)),
        clear: |o| o.header_line = None,
        take: Some(|o, text| o.header_line = number(text)),
        example: "3",
    },
    Field {
        name: "units line",
        help: "line with the units, from 1",
        text: |o| o.units_line.map(|n| n.to_string()),
        step: Some(|o, _, by| o.units_line = counted(o.units_line, by)),
        clear: |o| o.units_line = None,
        take: Some(|o, text| o.units_line = number(text)),
        example: "3",
    },
    Field {
        name: "skipped lines",
        help: "lines to skip at the start of the file",
        text: |o| o.skip.map(|n| n.to_string()),
        step: Some(|o, _, by| o.skip = counted(o.skip, by)),
        clear: |o| o.skip = None,
        take: Some(|o, text| o.skip = number(text)),
        example: "3",
    },
    Field {
        name: "table",
        help: "which table, if the file has several (from 1)",
        text: |o| o.table.map(|n| n.to_string()),
        step: Some(|o, _, by| o.table = counted(o.table, by)),
        clear: |o| o.table = None,
        take: Some(|o, text| o.table = number(text)),
        example: "3",
    },
    Field {
        name: "names",
        help: "column names, separated by commas",
        text: |o| (!o.names.is_empty()).then(|| o.names.join(", ")),
        step: None,
        clear: |o| o.names.clear(),
        take: Some(|o, text| o.names = list(text)),
        example: "x",
    },
    Field {
        name: "comments",
        help: "prefix of comment lines, besides #, % and //",
        text: |o| o.comment.clone(),
        step: None,
        clear: |o| o.comment = None,
        take: Some(|o, text| o.comment = told(text).filter(|t| t.len() <= 16)),
        example: ";",
    },
    Field {
        name: "delimiter",
        help: "field separator",
        text: |o| o.delimiter.and_then(Worded::word).map(str::to_owned),
        step: Some(|o, _, by| o.delimiter = stepped(o.delimiter, by)),
        clear: |o| o.delimiter = None,
        take: None,
        example: "x",
    },
    Field {
        name: "decimal comma",
        help: "decimal comma",
        text: |o| o.decimal_comma.map(yes),
        step: Some(|o, _, by| o.decimal_comma = next(&[true, false], o.decimal_comma, by)),
        clear: |o| o.decimal_comma = None,
        take: None,
        example: "x",
    },
    Field {
        name: "header",
        help: "the first line holds the column names",
        text: |o| o.header.map(yes),
        step: Some(|o, _, by| o.header = next(&[true, false], o.header, by)),
        clear: |o| o.header = None,
        take: None,
        example: "x",
    },
    Field {
        name: "quotes",
        help: "cells may be quoted",
        text: |o| o.quotes.map(yes),
        step: Some(|o, _, by| o.quotes = next(&[true, false], o.quotes, by)),
        clear: |o| o.quotes = None,
        take: None,
        example: "x",
    },
    Field {
        name: "order of dates",
        help: "what 1/2/2005 means",
        text: |o| o.day_first.map(|d| if d { "day first" } else { "month first" }.to_owned()),
        step: Some(|o, _, by| o.day_first = next(&[true, false], o.day_first, by)),
        clear: |o| o.day_first = None,
        take: None,
        example: "x",
    },
    Field {
        name: "encoding",
        help: "text encoding",
        text: |o| o.encoding.and_then(Worded::word).map(str::to_owned),
        step: Some(|o, _, by| o.encoding = stepped(o.encoding, by)),
        clear: |o| o.encoding = None,
        take: None,
        example: "x",
    },
];

fn yes(value: bool) -> String {
    if value { "yes" } else { "no" }.to_owned()
}

/// The next of the values that have a word, or the one before.
fn stepped<T: Worded>(now: Option<T>, by: isize) -> Option<T> {
    let values: Vec<T> = T::WORDS.iter().map(|(_, value)| *value).collect();
    next(&values, now, by)
}

/// Columns by name, after a word of its own.
fn named(columns: &[String], first: Option<&str>) -> Vec<String> {
    first.into_iter().map(str::to_owned).chain(columns.iter().cloned()).collect()
}

/// The value after `now` (or before it), with "recognised" between the last and the first.
fn next<T: PartialEq + Clone>(values: &[T], now: Option<T>, by: isize) -> Option<T> {
    let places = isize::try_from(values.len() + 1).unwrap_or(isize::MAX);
    let at = now.and_then(|now| values.iter().position(|v| *v == now)).map_or(0, |at| at + 1);
    let to = (isize::try_from(at).unwrap_or(0) + by).rem_euclid(places);
    usize::try_from(to - 1).ok().and_then(|at| values.get(at)).cloned()
}

fn told(text: &str) -> Option<String> {
    (!text.is_empty()).then(|| text.to_owned())
}

/// A whole number from 1.
fn number(text: &str) -> Option<usize> {
    text.parse().ok().filter(|n| *n > 0)
}

/// The number after `now`, or the one before it; none below 1.
fn counted(now: Option<usize>, by: isize) -> Option<usize> {
    now.unwrap_or(0).checked_add_signed(by).filter(|n| *n > 0)
}

fn list(text: &str) -> Vec<String> {
    text.split(',').map(str::trim).filter(|t| !t.is_empty()).map(str::to_owned).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn values_go_round_through_recognised() {
        assert_eq!(next(&[1, 2], None, 1), Some(1));
        assert_eq!(next(&[1, 2], Some(2), 1), None);
        assert_eq!(next(&[1, 2], None, -1), Some(2));
        assert_eq!(next(&[1, 2], Some(7), 1), Some(1), "what is not there any more is like nothing");
        assert_eq!(next::<i32>(&[], None, 1), None);
    }

    #[test]
    fn every_field_can_be_told_shown_and_taken_back() {
        let columns = ["t".to_owned(), "x".to_owned()];
        for field in FIELDS {
            let mut options = LoadOptions::default();
            match field.take {
                Some(take) => take(&mut options, field.example),
                None => field.step.unwrap()(&mut options, &columns, 1),
            }
            assert!((field.text)(&options).is_some(), "{}", field.name);
            assert_ne!(options, LoadOptions::default(), "{}", field.name);
            (field.clear)(&mut options);
            assert_eq!(options, LoadOptions::default(), "{}", field.name);
        }
    }
}
