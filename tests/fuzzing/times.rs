//! Arbitrary text where a time is expected, in a file and from a person: it is read or not, and what is read can be
//! written in the form of the file and read back.

use std::sync::Arc;

use wildpoint::track::{DateOrder, LoadOptions, Source, TimeAxis, TimeFormat, Zero, load};

use super::bytes::Bytes;

const FORMATS: [TimeFormat; 18] = [
    TimeFormat::SampleNumber,
    TimeFormat::Seconds,
    TimeFormat::Elapsed { unit_ns: 1_000_000 },
    TimeFormat::Elapsed { unit_ns: 86_400_000_000_000 },
    TimeFormat::Epoch { unit_ns: 1_000_000_000 },
    TimeFormat::Epoch { unit_ns: 1_000_000 },
    TimeFormat::Epoch { unit_ns: 1 },
    TimeFormat::Iso,
    TimeFormat::YearLast { day_first: true },
    TimeFormat::YearLast { day_first: false },
    TimeFormat::Clock,
    TimeFormat::Stamp { order: DateOrder::YearFirst },
    TimeFormat::Stamp { order: DateOrder::DayFirst },
    TimeFormat::Stamp { order: DateOrder::MonthFirst },
    TimeFormat::Duration,
    TimeFormat::DecimalYear,
    TimeFormat::Since { unit_ns: 86_400_000_000_000, zero: Zero::Spreadsheet },
    TimeFormat::Since { unit_ns: 1_000_000_000, zero: Zero::At(1_614_852_000) },
];

pub(super) fn body(data: &[u8]) {
    let mut bytes = Bytes(data);
    let format = FORMATS[bytes.below(FORMATS.len())].clone();
    let origin_ns = match bytes.byte() {
        0..=127 => 0,
        128..=191 => 1_573_495_025_250_000_000,
        192..=223 => i128::from(i64::MIN),
        _ => i128::from(bytes.word() as i64),
    };
    let axis = TimeAxis {
        name: "t".into(),
        column: Some(0),
        date_column: None,
        part_columns: Vec::new(),
        zone: None,
        clocks: Default::default(),
        newest_first: false,
        format,
        origin_ns,
        seconds: Vec::new(),
    };
    let text = String::from_utf8_lossy(bytes.0);
    typed(&axis, &text);
    in_a_file(&text);
}

/// What a person types at `/`.
fn typed(axis: &TimeAxis, text: &str) {
    let Some(seconds) = axis.parse(text) else { return };
    for digits in [0, 3, 9, 20] {
        assert!(axis.label(seconds, digits).chars().all(|c| c.is_ascii_graphic()), "{text}");
    }
    drop((axis.full_label(seconds), axis.date(seconds)));
    let written = axis.write_like(seconds, text);
    // Within a thousand years nothing saturates, and a nanosecond is what the form holds at least... of a unit.
    if seconds.abs() < 3e10 && axis.origin_ns.abs() < 1 << 60 && !written.is_empty() {
        let again = axis.parse(&written);
        let calendar = axis.date(seconds).is_some() || axis.format == TimeFormat::Clock;
        // A time of day is the first such time of the record, whichever day it was written for.
        assert!(again.is_some() || calendar, "{text:?} gives {written:?}, which is not read");
    }
}

/// Two rows whose times are the two halves of the text.
fn in_a_file(text: &str) {
    let plain: String = text.chars().filter(|c| !matches!(c, ',' | '"' | '\n' | '\r' | '\0')).take(200).collect();
    let (first, second) = plain.split_once('|').unwrap_or((&plain, "12:00:00"));
    let file = format!("time,x\n{first},1\n{second},2\n{first},3\n");
    let source = Source::BuiltIn { name: "times.csv", bytes: Arc::from(file.as_bytes()) };
    for day_first in [true, false] {
        let options = LoadOptions { day_first: Some(day_first), header: Some(true), ..LoadOptions::default() };
        let Ok(track) = load(&source, &options) else { continue };
        let seconds: Vec<f64> = track.time.seconds.iter().copied().filter(|s| s.is_finite()).collect();
        assert!(seconds.windows(2).all(|w| w[0] < w[1]));
        seconds.iter().for_each(|s| drop((track.time.full_label(*s), track.time.write_like(*s, first))));
    }
}
