//! A track that is handed over as columns of numbers, not as a file.

use std::sync::Arc;

use super::names;
use super::order::{Moments, UNREADABLE, order};
use super::timestamp::{Count, count};
use super::timing::Timing;
use super::{
    Channel, Clocks, Column, ColumnKind, Delimiter, Dialect, Encoding, Faults, Reading, RowsAt, Source, TimeAxis,
    TimeFormat, Track, Wanted, number_text,
};
use crate::memory::Share;

/// A moment that is not known.
pub const NO_MOMENT: i64 = UNREADABLE;

/// The values of a channel, one for each row; NaN where there is none.
#[derive(Debug, Clone)]
pub struct ChannelValues {
    /// Name of the channel.
    pub name: String,
    /// Its values.
    pub values: Vec<f64>,
}

/// The moment of `value` units of `unit_ns` nanoseconds, to the nanosecond. It is that of the decimal text of the
/// number, as in a file; [`NO_MOMENT`] for NaN and for what 64 bits do not hold.
#[must_use]
pub fn moment_of(value: f64, unit_ns: i64) -> i64 {
    /// Below it the product is less than half a nanosecond off.
    const EXACT: f64 = (1_u64 << 50) as f64;
    #[expect(clippy::cast_precision_loss, reason = "units are powers of ten below 2^53")]
    let product = value * unit_ns as f64;
    #[expect(clippy::cast_possible_truncation, reason = "within the range of 64 bits")]
    let rounded = |ns: f64| if ns.abs() < 9.2e18 { ns.round() as i64 } else { NO_MOMENT };
    if product.abs() < EXACT {
        return rounded(product);
    }
    match count(number_text(value).as_bytes(), unit_ns, false) {
        Some(Count::Exact(ns)) => ns,
        _ => rounded(product),
    }
}

/// The number that a text of a session stands for, with a decimal point or a decimal comma.
#[must_use]
pub fn number_of(text: &str) -> Option<f64> {
    let text = text.trim();
    text.parse().ok().or_else(|| text.replacen(',', ".", 1).parse().ok()).filter(|value: &f64| value.is_finite())
}

impl TimeAxis {
    /// The moment that a date and time in the form of `format` stands for; dates without a zone are those of UTC.
    #[must_use]
    pub fn moment_of_text(text: &str, format: &TimeFormat) -> Option<i64> {
        match Timing::of(0, None, format.clone()).read(|_| text.trim().as_bytes(), false)? {
            Count::Exact(ns) => Some(ns),
            Count::Inexact(_) => None,
        }
    }
}

/// Nanoseconds in the unit that the name of a column of numbers ends with (`t_ms`), if it does.
#[must_use]
pub fn unit_in_name(name: &str) -> Option<i64> {
    names::time_unit_ns(&names::unit_of(name)).or_else(|| names::time_unit_ns(name))
}

impl Track {
    /// The moment in a time cell: of a number in units of `unit_ns` nanoseconds, of a date and time as the file writes
    /// it. [`NO_MOMENT`] where it cannot be read.
    #[must_use]
    pub fn moment(&self, text: &str, unit_ns: i64) -> i64 {
        let bytes = text.trim().as_bytes();
        #[expect(
            clippy::cast_possible_truncation,
            clippy::cast_precision_loss,
            reason = "rounded to nanoseconds, within 64 bits"
        )]
        let rounded = |value: f64| match (value * unit_ns as f64).round() {
            ns if ns.abs() < 9.2e18 => ns as i64,
            _ => NO_MOMENT,
        };
        match count(bytes, unit_ns, self.dialect.decimal_comma) {
            Some(Count::Exact(ns)) => return ns,
            Some(Count::Inexact(value)) => return rounded(value),
            None => {}
        }
        let timing = Timing { zone: self.time.zone.clone(), ..Timing::of(0, None, self.time.format.clone()) };
        match timing.read(|_| bytes, self.dialect.decimal_comma) {
            Some(Count::Exact(ns)) => ns,
            _ => NO_MOMENT,
        }
    }

    /// A track of `channels` at `moments` (nanoseconds, ascending; [`NO_MOMENT`] where there is none). Of rows with the
    /// same moment the first counts. Values that `missing` names, and those that are not finite, count as missing.
    #[must_use]
    pub fn of_columns(time: &str, moments: Vec<i64>, channels: Vec<ChannelValues>, missing: &Reading) -> Self {
        let rows = moments.len();
        let ordered = order(Moments::Exact(moments), false, None, Wanted::always());
        let column = |name: &str, kind| Column { name: name.to_owned(), unit: String::new(), kind, missing: 0 };
        let mut columns = vec![column(time, ColumnKind::Time)];
        columns.extend(channels.iter().map(|c| column(&c.name, ColumnKind::Number)));
        let channel = |(index, mut given): (usize, ChannelValues)| {
            let lost = |v: &f64| !v.is_finite() || missing.is_missing(*v);
            given.values.iter_mut().filter(|v| lost(v)).for_each(|v| *v = f64::NAN);
            Channel { name: given.name, unit: String::new(), column: index + 1, target: None, values: given.values }
        };
        let channels: Vec<Channel> = channels.into_iter().enumerate().map(channel).collect();
        let time = TimeAxis {
            name: time.to_owned(),
            column: Some(0),
            date_column: None,
            part_columns: Vec::new(),
            zone: None,
            clocks: Clocks::Stated,
            newest_first: false,
            format: TimeFormat::Seconds,
            origin_ns: ordered.origin_ns,
            seconds: ordered.seconds,
        };
        Self {
            source: Source::BuiltIn { name: "columns", bytes: Arc::from([]) },
            sha256: String::new(),
            bytes: 0,
            dialect: plain(),
            rows,
            columns,
            time,
            channels,
            truth: None,
            truth_told: false,
            faults: Faults::default(),
            notes: Vec::new(),
            share: Arc::new(Share::default()),
        }
    }
}

/// The layout of columns that were not read from a text.
fn plain() -> Dialect {
    Dialect {
        delimiter: Delimiter::Byte(b','),
        quote: None,
        decimal_comma: false,
        encoding: Encoding::Utf8 { bom: false },
        packing: None,
        header: true,
        units_row: false,
        missing: Vec::new(),
        preamble: 0,
        rows: RowsAt::default(),
        styles: Vec::new(),
        fixed_width: false,
        view: None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_moment_is_that_of_the_decimal_text() {
        const SECOND: i64 = 1_000_000_000;
        assert_eq!(moment_of(0.1, SECOND), 100_000_000);
        // The product of the doubles is a multiple of 256 here.
        assert_eq!(moment_of(1_573_495_025.123_457, SECOND), 1_573_495_025_123_457_000);
        assert_eq!(moment_of(-2.5, 1_000_000), -2_500_000);
        assert_eq!(moment_of(1e300, SECOND), NO_MOMENT);
        assert_eq!(moment_of(f64::NAN, SECOND), NO_MOMENT);
    }

    #[test]
    fn rows_without_a_moment_of_their_own_and_markers_count_as_missing() {
        let values = vec![1.0, 2.0, -999.0, f64::INFINITY];
        let channels = vec![ChannelValues { name: "a".into(), values }];
        let markers = Reading::new(false, &["-999".to_owned()]);
        let track = Track::of_columns("t", vec![5, 5, NO_MOMENT, 9], channels, &markers);
        assert_eq!(track.channels[0].series(&track.time).len(), 1);
        assert!(track.channels[0].values[2].is_nan() && track.time.seconds[1].is_nan());
    }
}
