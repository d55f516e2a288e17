//! Several columns that are one time: year, month and day; date and time of day; seconds and nanoseconds; week and
//! second of the week.

use super::super::calendar::{DAY, Date, SECOND};
use super::super::timestamp::{self, Count};
use super::free::{DateOrder, fields};

/// What a column contributes to the time.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Part {
    /// A year of four or two digits.
    Year,
    /// 1 to 12, or a name.
    Month,
    /// 1 to 31.
    Day,
    /// From 1, perhaps with decimals.
    DayOfYear,
    /// A whole date.
    Date(DateOrder),
    /// A time of day, with colons or as digits (`100000.00`).
    Clock,
    /// Hours after midnight, perhaps with decimals; written as 1 to 24 where `from_one` is true, and meant from 0 then.
    Hour,
    /// A number of units of this many nanoseconds.
    Count {
        /// Nanoseconds in one unit.
        unit_ns: i64,
    },
    /// Seconds since 1970, or another whole number of seconds that is the coarse part of the time.
    Seconds,
    /// The zone of the clocks of the row: `EST`, `+01:00`, or hours.
    Zone,
    /// A week of the GPS calendar, counted from 1980-01-06; numbers below 1024 are those since April 2019.
    GpsWeek,
}

/// Days from 1970 to 1980-01-06.
pub(crate) const GPS_ZERO_DAYS: i64 = 3_657;

impl Part {
    /// True where the parts with it tell a date.
    pub(crate) fn dates(self) -> bool {
        matches!(self, Self::Year | Self::Date(_) | Self::GpsWeek | Self::Seconds)
    }
}

/// The moment that the cells of the parts make, in nanoseconds; none where one of them cannot be read.
pub(crate) fn moment<'a>(parts: &[Part], cell: impl Fn(usize) -> &'a [u8], decimal_comma: bool) -> Option<i64> {
    let (mut year, mut month, mut day) = (None, None, None);
    let mut sum = 0_i64;
    for (place, part) in parts.iter().enumerate() {
        let text = cell(place);
        let count = |unit: i64| match timestamp::count(text, unit, decimal_comma)? {
            Count::Exact(ns) => Some(ns),
            #[expect(clippy::cast_precision_loss, clippy::cast_possible_truncation, reason = "a short number of units")]
            Count::Inexact(value) => Some((value * unit as f64).round() as i64),
        };
        let whole = || timestamp::integer(text).or_else(|| whole_number(text));
        match *part {
            Part::Year => {
                let value = whole()?;
                year = Some(match value {
                    0..69 => 2000 + value,
                    69..100 => 1900 + value,
                    _ => value,
                });
            }
            Part::Month => month = Some(whole().or_else(|| super::words::month(text))?),
            Part::Day => day = Some(whole()?),
            Part::DayOfYear => {
                (month, day) = (Some(1), Some(1));
                sum = sum.checked_add(count(DAY)?.checked_sub(DAY)?)?;
            }
            Part::Date(order) => {
                let told = fields(text, order)?.told(text)?;
                sum = sum.checked_add(told.days?.checked_mul(DAY)?)?.checked_add(told.of_day)?;
            }
            Part::Clock => sum = sum.checked_add(clock(text)?)?,
            Part::Hour => sum = sum.checked_add(count(3600 * SECOND)?)?,
            Part::Count { unit_ns } => sum = sum.checked_add(count(unit_ns)?)?,
            Part::Seconds => sum = sum.checked_add(count(SECOND)?)?,
            Part::Zone => sum = sum.checked_sub(offset_in(std::str::from_utf8(text).ok()?, true)?)?,
            Part::GpsWeek => {
                let week = whole()?;
                let week = if week < 1024 { week + 2048 } else { week };
                sum = sum.checked_add(GPS_ZERO_DAYS.checked_add(week.checked_mul(7)?)?.checked_mul(DAY)?)?;
            }
        }
    }
    let Some(year) = year else { return Some(sum) };
    let date = Date { year, month: month?, day: day.unwrap_or(1) };
    sum.checked_add(date.days()?.checked_mul(DAY)?)
}

/// How far a zone lies ahead of UTC, in nanoseconds: by its name, by its offset, and by hours (`-5`) where those can be
/// meant.
pub(crate) fn offset_in(zone: &str, hours: bool) -> Option<i64> {
    let zone = zone.trim();
    if zone.is_empty() {
        return None;
    }
    let counted = || {
        let value: f64 = zone.parse().ok().filter(|value: &f64| hours && value.abs() <= 14.0)?;
        #[expect(clippy::cast_possible_truncation, reason = "at most 14 hours")]
        let quarters = (value * 4.0).round() as i64;
        Some(quarters * 900 * SECOND)
    };
    super::words::zone(zone.as_bytes()).or_else(|| timestamp::offset(zone.as_bytes())).or_else(counted)
}

/// `4.0` is 4.
fn whole_number(text: &[u8]) -> Option<i64> {
    let at = text.iter().position(|b| matches!(b, b'.' | b','))?;
    text[at + 1..].iter().all(|b| *b == b'0').then(|| timestamp::integer(&text[..at]))?
}

/// A time of day with colons in any spelling, or as digits: `100000`, `100000.25`, `1000`, `930`.
pub(crate) fn clock(text: &[u8]) -> Option<i64> {
    if text.contains(&b':') {
        return timestamp::clock(text).or_else(|| {
            let told = fields(text, DateOrder::YearFirst)?.told(text)?;
            told.days.is_none().then_some(told.of_day)
        });
    }
    let (digits, fraction) = match text.iter().position(|b| matches!(b, b'.' | b',')) {
        Some(at) => (&text[..at], timestamp::fraction_ns(&text[at + 1..]).filter(|_| at + 1 < text.len())?),
        None => (text, 0),
    };
    let value = timestamp::integer(digits)?;
    // Leading zeros may be gone: 930 is half past nine, 5 is midnight and five minutes (or seconds with decimals).
    let (hour, minute, second) = match digits.len() {
        5 | 6 => (value / 10_000, value / 100 % 100, value % 100),
        1..=4 if fraction == 0 && text.len() == digits.len() => (value / 100, value % 100, 0),
        1..=4 => (value / 10_000, value / 100 % 100, value % 100),
        _ => return None,
    };
    let fits = hour <= 24 && minute < 60 && second <= 60;
    fits.then(|| ((hour * 60 + minute) * 60 + second) * SECOND + fraction)
}

/// The cell `sample` of a part at another moment, in nanoseconds since 1970.
pub(crate) fn written(part: Part, parts: &[Part], sample: &str, ns: i64) -> String {
    let (days, of_day) = (ns.div_euclid(DAY), ns.rem_euclid(DAY));
    let date = Date::of_days(days);
    let padded = |value: i64| {
        let width = if sample.starts_with('0') || sample.len() > 2 { sample.len() } else { 0 };
        let decimals = sample.find('.').map_or(0, |at| sample.len() - at - 1);
        if decimals > 0 { format!("{value}.{}", "0".repeat(decimals)) } else { format!("{value:0width$}") }
    };
    let finer = |unit: i64| {
        parts.iter().any(|p| match p {
            Part::Count { unit_ns } => *unit_ns < unit,
            Part::Hour => unit > 3600 * SECOND,
            Part::Clock => true,
            _ => false,
        })
    };
    let counted = |ns: i64, unit: i64| {
        let decimals = if finer(unit) { 0 } else { sample.find(['.', ',']).map_or(0, |at| sample.len() - at - 1) };
        let scale = 10_i128.pow(u32::try_from(decimals.min(9)).unwrap_or(0));
        let scaled = i128::from(ns) * scale / i128::from(unit);
        let text = if decimals == 0 {
            format!("{scaled}")
        } else {
            format!("{}.{:0decimals$}", scaled / scale, scaled % scale)
        };
        let width = if sample.starts_with('0') { sample.len() } else { 0 };
        format!("{text:0>width$}")
    };
    let larger = |unit: i64| {
        let units = [DAY, 3600 * SECOND, 60 * SECOND, SECOND, SECOND / 1000, SECOND / 1_000_000];
        let there = |u: &i64| match *u {
            DAY => parts.iter().any(|p| matches!(p, Part::Day | Part::Date(_) | Part::DayOfYear)),
            u if u == 3600 * SECOND => parts.contains(&Part::Hour),
            u if u == SECOND => parts.iter().any(|p| matches!(p, Part::Seconds | Part::Count { unit_ns: SECOND })),
            u => parts.contains(&Part::Count { unit_ns: u }),
        };
        units.into_iter().filter(|u| *u > unit).filter(there).min()
    };
    match part {
        Part::Year if sample.len() <= 2 => format!("{:02}", date.year.rem_euclid(100)),
        Part::Year => padded(date.year),
        Part::Month => padded(date.month),
        Part::Day => padded(date.day),
        Part::DayOfYear => {
            let start = Date { month: 1, day: 1, ..date }.days().unwrap_or(days);
            let fraction = if sample.contains('.') { of_day } else { 0 };
            counted((days - start + 1) * DAY + fraction, DAY)
        }
        Part::Date(order) => fields(sample.as_bytes(), order)
            .map_or_else(|| sample.to_owned(), |pieces| pieces.written(sample, Some(days), of_day)),
        Part::Clock => match fields(sample.as_bytes(), DateOrder::YearFirst).filter(|_| sample.contains(':')) {
            Some(pieces) => pieces.written(sample, None, of_day),
            None => {
                let s = of_day / SECOND;
                let fraction = sample.find('.').map_or(0, |at| sample.len() - at - 1);
                let decimals: String = format!("{:09}", of_day % SECOND).chars().take(fraction).collect();
                let dot = if fraction > 0 { "." } else { "" };
                if sample.len() <= 4 && fraction == 0 {
                    format!("{:02}{:02}", s / 3600, s / 60 % 60)
                } else {
                    format!("{:02}{:02}{:02}{dot}{decimals}", s / 3600, s / 60 % 60, s % 60)
                }
            }
        },
        Part::Hour => counted(of_day, 3600 * SECOND),
        Part::Zone => sample.to_owned(),
        Part::Seconds => counted(ns, SECOND),
        Part::Count { unit_ns } if parts.contains(&Part::GpsWeek) => {
            counted((ns - GPS_ZERO_DAYS * DAY).rem_euclid(7 * DAY), unit_ns)
        }
        Part::Count { unit_ns } => counted(larger(unit_ns).map_or(ns, |l| ns.rem_euclid(l)), unit_ns),
        Part::GpsWeek => {
            let week = (days - GPS_ZERO_DAYS).div_euclid(7);
            let short = sample.parse::<i64>().is_ok_and(|w| w < 1024);
            padded(if short { week - 2048 } else { week })
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn read(parts: &[Part], cells: &[&str]) -> Option<String> {
        let ns = moment(parts, |i| cells[i].as_bytes(), false)?;
        Some(jiff::Timestamp::from_nanosecond(ns.into()).unwrap().to_string())
    }

    #[test]
    fn columns_are_put_together() {
        let second = Part::Count { unit_ns: SECOND };
        for (parts, cells, text) in [
            (
                &[Part::Year, Part::Month, Part::Day, Part::Hour, Part::Count { unit_ns: 60 * SECOND }][..],
                &["2021", "03", "04", "10", "30"][..],
                "2021-03-04T10:30:00Z",
            ),
            (&[Part::Date(DateOrder::YearFirst), Part::Clock], &["20210304", "103000.5"], "2021-03-04T10:30:00.5Z"),
            (&[Part::Date(DateOrder::DayFirst), Part::Clock], &["04.03.21", "9:05"], "2021-03-04T09:05:00Z"),
            (&[Part::Date(DateOrder::YearFirst), Part::Hour], &["2021-03-04", "24"], "2021-03-05T00:00:00Z"),
            (&[Part::Year, Part::DayOfYear, second], &["2021", "63", "36000"], "2021-03-04T10:00:00Z"),
            (&[Part::Year, Part::DayOfYear], &["21", "63.5"], "2021-03-04T12:00:00Z"),
            (&[Part::Seconds, Part::Count { unit_ns: 1 }], &["1614852030", "500000000"], "2021-03-04T10:00:30.5Z"),
            // IS-GPS-200: week 2147 begins on 2021-02-28.
            (&[Part::GpsWeek, second], &["2147", "604799"], "2021-03-06T23:59:59Z"),
            (&[Part::GpsWeek, second], &["99", "0"], "2021-02-28T00:00:00Z"),
        ] {
            assert_eq!(read(parts, cells).as_deref(), Some(text), "{cells:?}");
        }
        assert_eq!(read(&[Part::Year, Part::Month, Part::Day], &["2021", "2", "30"]), None);
    }

    #[test]
    fn parts_are_written_as_they_are_read() {
        let second = Part::Count { unit_ns: SECOND };
        for (parts, cells) in [
            (
                &[Part::Year, Part::Month, Part::Day, Part::Hour, Part::Count { unit_ns: 60 * SECOND }][..],
                &["2021", "03", "04", "10", "30"][..],
            ),
            (&[Part::Date(DateOrder::YearFirst), Part::Clock], &["20210304", "103000.50"]),
            (&[Part::Seconds, Part::Count { unit_ns: 1 }], &["1614852030", "500000000"]),
            (&[Part::GpsWeek, second], &["2147", "604799.5"]),
            (&[Part::Year, Part::DayOfYear, second], &["2021", "63", "36000"]),
        ] {
            let ns = moment(parts, |i| cells[i].as_bytes(), false).unwrap();
            for (part, cell) in parts.iter().zip(cells) {
                assert_eq!(written(*part, parts, cell, ns), *cell);
            }
        }
    }
}
