//! Times for people: labels, what a user types, and new times in the form of the file.

use super::calendar::{DAY, Date, SECOND};
use super::timestamp::{self, Count};
use super::timing::Timing;
use super::{Clocks, DateOrder, Part, TimeAxis, TimeFormat};

/// More decimals than nanoseconds have are never written.
const MOST_DECIMALS: usize = 9;

impl TimeAxis {
    /// The time of day (calendar formats, in UTC) or the file's own number, with `digits` decimals: `17:57:05.0`,
    /// `1239.5`. Empty for NaN.
    #[must_use]
    pub fn label(&self, seconds: f64, digits: usize) -> String {
        let Some(ns) = self.ns_at(seconds) else { return String::new() };
        match self.number_unit() {
            Some(unit) => fixed(ns, unit, digits),
            // Hours go on beyond 24 where the file counts them so.
            None if self.format == TimeFormat::Duration => clock_text(rounded(ns, digits).max(0), digits, true, true),
            None => clock_text(rounded(ns, digits).rem_euclid(i128::from(DAY)), digits, true, true),
        }
    }

    /// The whole time, with as many decimals as it needs, to the microsecond: `2019-11-11 17:57:05.25 UTC` (without `UTC`
    /// where nothing tells the zone), `1239.5 s`. Empty for NaN.
    #[must_use]
    pub fn full_label(&self, seconds: f64) -> String {
        let Some(ns) = self.ns_at(seconds) else { return String::new() };
        let label = self.label(seconds, self.digits_of(ns));
        match (self.date(seconds), &self.format) {
            (Some(date), _) if self.clocks == Clocks::Unstated => format!("{date} {label}"),
            (Some(date), _) => format!("{date} {label} UTC"),
            (None, TimeFormat::Seconds) => format!("{label} s"),
            (None, _) => label,
        }
    }

    /// How many decimals a time needs, to the microsecond; to the nanosecond where samples are closer than ten microseconds.
    fn digits_of(&self, ns: i128) -> usize {
        if let Some(unit) = self.number_unit().filter(|unit| *unit < SECOND) {
            let tenths = |digits: &usize| 10_i128.pow(u32::try_from(*digits).unwrap_or(0));
            // Times that no record has would overflow.
            let whole = |digits: &usize| ns.checked_mul(tenths(digits)).is_some_and(|n| n % i128::from(unit) == 0);
            return (0..6).find(whole).unwrap_or(6);
        }
        let step = self.seconds.windows(2).map(|pair| pair[1] - pair[0]).find(|step| *step > 0.0);
        let most = if step.is_some_and(|step| step < 1e-5) { MOST_DECIMALS } else { 6 };
        (0..most).find(|digits| rounded(ns, *digits) == rounded(ns, most)).unwrap_or(most)
    }

    /// The whole time with all the decimals that it has, so that equal texts mean equal times: `2019-11-11T17:57:05.25Z`,
    /// `1239.5`. Empty for NaN.
    #[must_use]
    pub fn exact_label(&self, seconds: f64) -> String {
        let Some(ns) = self.ns_at(seconds) else { return String::new() };
        let digits = (0..MOST_DECIMALS).find(|d| rounded(ns, *d) == ns).unwrap_or(MOST_DECIMALS);
        match (self.date(seconds), self.count_unit()) {
            (Some(date), _) => format!("{date}T{}Z", self.label(seconds, digits)),
            (None, Some(unit)) => fixed(ns, unit, MOST_DECIMALS).trim_end_matches('0').trim_end_matches('.').to_owned(),
            (None, None) => self.label(seconds, digits),
        }
    }

    /// The date in UTC, `2019-11-11`, where the file tells dates.
    #[must_use]
    pub fn date(&self, seconds: f64) -> Option<String> {
        if !self.is_calendar() {
            return None;
        }
        let date = date_of(self.ns_at(seconds)?)?;
        Some(format!("{:04}-{:02}-{:02}", date.year, date.month, date.day))
    }

    /// Seconds after the origin of the time that a user typed: in the form of the file; for epoch times also as
    /// date and time; where the file tells dates or times of day also as a time of day, which is the first such
    /// time in the record.
    #[must_use]
    pub fn parse(&self, text: &str) -> Option<f64> {
        let text = text.trim();
        let bytes = text.as_bytes();
        let number =
            |unit| match timestamp::count(bytes, unit, false).or_else(|| timestamp::count(bytes, unit, true))? {
                Count::Exact(ns) => Some(self.seconds_at(i128::from(ns))),
                #[expect(clippy::cast_precision_loss, reason = "a typed number with an exponent or ten decimals")]
                Count::Inexact(value) => Some((value * unit as f64 - self.origin_ns as f64) / SECOND as f64),
            };
        let read = || {
            let timing = Timing { zone: self.zone.clone(), ..Timing::of(0, None, self.format.clone()) };
            match timing.read(|_| bytes, false)? {
                Count::Exact(ns) => Some(self.seconds_at(i128::from(ns))),
                Count::Inexact(_) => None,
            }
        };
        let calendar = || {
            let stamp = match self.format {
                TimeFormat::YearLast { day_first } => timestamp::year_last(bytes, day_first),
                _ => None,
            };
            let stamp = stamp.or_else(|| timestamp::iso(bytes)).map(i128::from);
            stamp.or_else(|| self.next_at(timestamp::clock(bytes)?)).map(|ns| self.seconds_at(ns))
        };
        match self.format {
            TimeFormat::SampleNumber | TimeFormat::Seconds => number(SECOND),
            TimeFormat::Elapsed { unit_ns } => number(unit_ns),
            TimeFormat::Epoch { unit_ns } => calendar().or_else(|| number(unit_ns)),
            TimeFormat::Iso | TimeFormat::YearLast { .. } => calendar(),
            TimeFormat::Since { .. } | TimeFormat::DecimalYear | TimeFormat::Stamp { .. } | TimeFormat::Pattern(_) => {
                // The number of the file before a date of which nobody thinks.
                read().or_else(calendar)
            }
            TimeFormat::Duration => super::timing::duration(bytes).map(|ns| self.seconds_at(i128::from(ns))),
            TimeFormat::Parts(_) if self.is_calendar() => calendar(),
            TimeFormat::Parts(_) => self.next_at(super::time::part_clock(bytes)?).map(|ns| self.seconds_at(ns)),
            TimeFormat::Clock => self.next_at(timestamp::clock(bytes)?).map(|ns| self.seconds_at(ns)),
        }
    }

    /// The time `seconds` after the origin as the file would write it: in the form of `sample` (a time cell, or a
    /// date cell where date and time stand apart) with its number of decimals and in its zone. Seconds are added to
    /// a sample that has only minutes where they are needed.
    #[must_use]
    pub fn write_like(&self, seconds: f64, sample: &str) -> String {
        let Some(ns) = self.ns_at(seconds) else { return String::new() };
        let sample = sample.trim();
        if let Some(unit) = self.count_unit() {
            let point = sample.find(['.', ',']);
            let decimals = point.map_or(0, |at| sample[at + 1..].bytes().take_while(u8::is_ascii_digit).count());
            let text = fixed(ns, unit, decimals);
            return if sample.contains(',') { text.replace('.', ",") } else { text };
        }
        let bytes = sample.as_bytes();
        if let Some(text) = self.written(ns, sample) {
            return text;
        }
        match self.format {
            TimeFormat::YearLast { day_first } if timestamp::year_last_parts(bytes).is_some() => {
                like_year_last(ns, sample, day_first)
            }
            _ if timestamp::iso(bytes).is_some() => like_iso(ns, sample),
            _ => like_clock(ns.rem_euclid(i128::from(DAY)), sample),
        }
    }

    /// The time of day of a cell of one of the columns of [`TimeFormat::Parts`], in the form of `sample`.
    #[must_use]
    pub fn write_part(&self, seconds: f64, place: usize, sample: &str) -> String {
        let TimeFormat::Parts(parts) = &self.format else { return String::new() };
        let ns = self.ns_at(seconds).and_then(|ns| i64::try_from(ns).ok());
        let Some((part, ns)) = parts.get(place).zip(ns) else { return String::new() };
        super::time::part_written(*part, parts, sample.trim(), self.local(ns))
    }

    /// How far the clocks of a row are ahead of UTC, in seconds, where a column tells their zone; `cell` gives its cells.
    pub(super) fn row_offset(&self, cell: impl Fn(usize) -> String) -> f64 {
        let TimeFormat::Parts(parts) = &self.format else { return 0.0 };
        let zone = parts.iter().zip(&self.part_columns).find(|(part, _)| **part == Part::Zone);
        let offset = zone.and_then(|(_, column)| super::time::offset_in(&cell(*column), true));
        seconds_of(offset.unwrap_or(0).into())
    }

    /// The time in a form that says by its pieces how it is written.
    fn written(&self, ns: i128, sample: &str) -> Option<String> {
        let ns = i64::try_from(ns).ok()?;
        let bytes = sample.as_bytes();
        let pieces = match &self.format {
            TimeFormat::Stamp { order } => super::time::fields(bytes, *order)?,
            TimeFormat::Pattern(pattern) => pattern.fields(bytes)?,
            TimeFormat::Duration => super::time::fields(bytes, DateOrder::YearFirst)?,
            TimeFormat::Iso | TimeFormat::YearLast { .. } if self.zone.is_some() => {
                let first = matches!(self.format, TimeFormat::YearLast { day_first: true });
                super::time::fields(bytes, if first { DateOrder::DayFirst } else { DateOrder::MonthFirst })?
            }
            TimeFormat::Since { unit_ns, zero } => {
                let decimals = sample.find(['.', ',']).map_or(0, |at| sample.len() - at - 1);
                let text = fixed(i128::from(ns) - i128::from(zero.seconds()) * i128::from(SECOND), *unit_ns, decimals);
                return Some(if sample.contains(',') { text.replace('.', ",") } else { text });
            }
            TimeFormat::DecimalYear => return decimal_year(ns, sample),
            _ => return None,
        };
        let told = pieces.told(bytes)?;
        let local = match told.offset {
            Some(offset) => ns.checked_add(offset)?,
            None => self.local(ns),
        };
        let step = pieces.step();
        let local = local.checked_add(step / 2)?.div_euclid(step).checked_mul(step)?;
        let dated = told.days.is_some();
        Some(if dated {
            pieces.written(sample, Some(local.div_euclid(DAY)), local.rem_euclid(DAY))
        } else {
            pieces.written(sample, None, local)
        })
    }

    /// What clocks of the file show at a moment.
    fn local(&self, ns: i64) -> i64 {
        self.zone.as_ref().map_or(ns, |zone| zone.local(ns))
    }

    /// Nanoseconds in one unit, where the file writes times as numbers.
    fn count_unit(&self) -> Option<i64> {
        match self.format {
            TimeFormat::SampleNumber | TimeFormat::Seconds => Some(SECOND),
            TimeFormat::Elapsed { unit_ns } | TimeFormat::Epoch { unit_ns } => Some(unit_ns),
            _ => None,
        }
    }

    /// As [`Self::count_unit`], but people read epoch times as calendar times.
    fn number_unit(&self) -> Option<i64> {
        self.count_unit().filter(|_| !self.is_calendar())
    }

    /// True where the times are those of a calendar.
    #[must_use]
    pub fn is_calendar(&self) -> bool {
        match &self.format {
            TimeFormat::Epoch { .. }
            | TimeFormat::Iso
            | TimeFormat::YearLast { .. }
            | TimeFormat::Since { .. }
            | TimeFormat::DecimalYear
            | TimeFormat::Stamp { .. } => true,
            TimeFormat::Pattern(pattern) => pattern.has_date(),
            // Seconds that are those since 1970 are a date, and others are counted from a zero of the file's own.
            TimeFormat::Parts(parts) if parts.contains(&Part::Seconds) => {
                self.origin_ns > 315_532_800 * i128::from(SECOND)
            }
            TimeFormat::Parts(parts) => parts.iter().any(|p| p.dates()),
            TimeFormat::SampleNumber
            | TimeFormat::Seconds
            | TimeFormat::Elapsed { .. }
            | TimeFormat::Clock
            | TimeFormat::Duration => false,
        }
    }

    /// A time in nanoseconds after 1970, or after the file's own zero.
    pub(super) fn nanoseconds(&self, seconds: f64) -> Option<i64> {
        self.ns_at(seconds).and_then(|ns| i64::try_from(ns).ok())
    }

    /// True where the numbers of the file are moments, whatever clocks show.
    pub(super) fn is_absolute(&self) -> bool {
        match &self.format {
            TimeFormat::Epoch { .. } | TimeFormat::Since { .. } => true,
            TimeFormat::Parts(parts) => parts.contains(&Part::Zone),
            _ => false,
        }
    }

    /// True where the file counts nanoseconds.
    pub(super) fn counts_nanoseconds(&self) -> bool {
        self.count_unit() == Some(1)
    }

    fn ns_at(&self, seconds: f64) -> Option<i128> {
        #[expect(clippy::cast_possible_truncation, reason = "saturates, and nanoseconds suffice")]
        let ns = (seconds * 1e9).round() as i128;
        seconds.is_finite().then(|| self.origin_ns.saturating_add(ns))
    }

    fn seconds_at(&self, ns: i128) -> f64 {
        seconds_of(ns.saturating_sub(self.origin_ns))
    }

    /// The first time of day `clock` at the origin or after it.
    fn next_at(&self, clock: i64) -> Option<i128> {
        let day = i128::from(DAY);
        let today = self.origin_ns.div_euclid(day).checked_mul(day)?.checked_add(i128::from(clock))?;
        if today < self.origin_ns { today.checked_add(day) } else { Some(today) }
    }
}

/// Nanoseconds to seconds, correctly rounded.
pub(super) fn seconds_of(ns: i128) -> f64 {
    const EXACT: i128 = 1 << 53;
    let (mut ns, mut scale) = (ns, 1e9);
    while ns.unsigned_abs() >= EXACT.unsigned_abs() && ns % 10 == 0 && scale > 1.0 {
        ns /= 10;
        scale /= 10.0;
    }
    #[expect(clippy::cast_precision_loss, reason = "below 2^53, or whole seconds, which round once")]
    if ns.unsigned_abs() < EXACT.unsigned_abs() || scale == 1.0 {
        return ns as f64 / scale;
    }
    // Reading decimal text rounds once.
    format!("{ns}e-{}", scale.log10().round()).parse().unwrap_or(f64::NAN)
}

/// `ns` rounded to `digits` decimals of a second, ties away from zero.
fn rounded(ns: i128, digits: usize) -> i128 {
    let step = 10_i128.pow(9 - u32::try_from(digits.min(MOST_DECIMALS)).unwrap_or(9));
    divided(ns, step).saturating_mul(step)
}

/// The nearest whole quotient, ties away from zero; `b` is positive. (No sum or difference of `a`: it may be the last
/// number that 128 bits hold, where a file has times like 1e300.)
fn divided(a: i128, b: i128) -> i128 {
    let (quotient, rest) = (a / b, a % b);
    if rest.abs() >= b - b / 2 { quotient + a.signum() } else { quotient }
}

/// `ns` in units of `unit` nanoseconds with `digits` decimals.
fn fixed(ns: i128, unit: i64, digits: usize) -> String {
    let digits = digits.min(MOST_DECIMALS);
    let power = 10_i128.pow(u32::try_from(digits).unwrap_or(0));
    let scaled = divided(ns.saturating_mul(power), i128::from(unit));
    let sign = if scaled < 0 { "-" } else { "" };
    let (whole, part) = (scaled.unsigned_abs() / power.unsigned_abs(), scaled.unsigned_abs() % power.unsigned_abs());
    if digits == 0 { format!("{sign}{whole}") } else { format!("{sign}{whole}.{part:0digits$}") }
}

/// A year with as many decimals as `sample` has.
fn decimal_year(ns: i64, sample: &str) -> Option<String> {
    let date = date_of(i128::from(ns))?;
    let start = |year| Date { year, month: 1, day: 1 }.days();
    let (from, to) = (start(date.year)?, start(date.year + 1)?);
    #[expect(clippy::cast_precision_loss, reason = "a year of nanoseconds")]
    let part = (ns - from * DAY) as f64 / ((to - from) * DAY) as f64;
    let decimals = sample.find(['.', ',']).map_or(0, |at| sample.len() - at - 1);
    #[expect(clippy::cast_precision_loss, reason = "a year")]
    let text = format!("{:.decimals$}", date.year as f64 + part);
    Some(if sample.contains(',') { text.replace('.', ",") } else { text })
}

fn date_of(ns: i128) -> Option<Date> {
    Some(Date::of_days(i64::try_from(ns.div_euclid(i128::from(DAY))).ok()?))
}

/// A time of day, already rounded to `digits` decimals.
fn clock_text(of_day: i128, digits: usize, with_seconds: bool, padded: bool) -> String {
    let second = i128::from(SECOND);
    let (seconds, part) = (of_day / second, of_day % second);
    let (hour, minute, seconds) = (seconds / 3600, seconds / 60 % 60, seconds % 60);
    let hour = if padded { format!("{hour:02}") } else { hour.to_string() };
    let mut text = format!("{hour}:{minute:02}");
    if with_seconds || seconds > 0 {
        text.push_str(&format!(":{seconds:02}"));
    }
    if digits > 0 {
        let digits = digits.min(MOST_DECIMALS);
        text.push('.');
        text.extend(format!("{part:09}").chars().take(digits));
    }
    text
}

/// How a sample writes the time of day.
struct ClockForm {
    digits: usize,
    with_seconds: bool,
    padded: bool,
    comma: bool,
}

impl ClockForm {
    fn of(sample: &str) -> Self {
        let point = sample.find(['.', ',']);
        Self {
            digits: point.map_or(0, |at| sample.len() - at - 1).min(MOST_DECIMALS),
            with_seconds: sample.matches(':').count() == 2,
            padded: sample.find(':') != Some(1),
            comma: sample.contains(','),
        }
    }

    fn text(&self, of_day: i128) -> String {
        let text = clock_text(of_day, self.digits, self.with_seconds, self.padded);
        if self.comma { text.replace('.', ",") } else { text }
    }
}

fn like_clock(of_day: i128, sample: &str) -> String {
    let form = ClockForm::of(sample);
    form.text(rounded(of_day, form.digits).rem_euclid(i128::from(DAY)))
}

/// The separator of date and time in a sample, the time, and the zone with any blanks before it.
fn after_date(rest: &str) -> (&str, &str, &str) {
    let time_at = rest.find(|c: char| c.is_ascii_digit()).unwrap_or(rest.len());
    let (mark, rest) = rest.split_at(time_at);
    let zone_at = rest.find(|c: char| !(c.is_ascii_digit() || matches!(c, ':' | '.' | ','))).unwrap_or(rest.len());
    let (time, zone) = rest.split_at(zone_at);
    (mark, time, zone)
}

fn like_dated(ns: i128, rest: &str, date_text: impl Fn(Date) -> String) -> String {
    let (mark, time, zone) = after_date(rest);
    let form = ClockForm::of(time);
    let offset = timestamp::offset(zone.trim().as_bytes()).unwrap_or(0);
    let local = rounded(ns + i128::from(offset), form.digits);
    let date = date_of(local).map(date_text).unwrap_or_default();
    if time.is_empty() {
        return date;
    }
    format!("{date}{mark}{}{zone}", form.text(local.rem_euclid(i128::from(DAY))))
}

fn like_iso(ns: i128, sample: &str) -> String {
    let (date, rest) = sample.split_at_checked(10).unwrap_or((sample, ""));
    let separator = if date.contains('/') { '/' } else { '-' };
    like_dated(ns, rest, |d| format!("{:04}{separator}{:02}{separator}{:02}", d.year, d.month, d.day))
}

fn like_year_last(ns: i128, sample: &str, day_first: bool) -> String {
    let length = sample.find(' ').unwrap_or(sample.len());
    let (date, rest) = sample.split_at(length);
    let separator = if date.contains('/') {
        '/'
    } else if date.contains('.') {
        '.'
    } else {
        '-'
    };
    let padded = date.split(separator).any(|part| part.starts_with('0'));
    like_dated(ns, rest, |d| {
        let (first, second) = if day_first { (d.day, d.month) } else { (d.month, d.day) };
        let year = d.year;
        if padded {
            format!("{first:02}{separator}{second:02}{separator}{year:04}")
        } else {
            format!("{first}{separator}{second}{separator}{year:04}")
        }
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn axis(format: TimeFormat, origin_ns: i128) -> TimeAxis {
        TimeAxis {
            name: "time".into(),
            column: Some(0),
            date_column: None,
            part_columns: Vec::new(),
            zone: None,
            clocks: Clocks::Stated,
            newest_first: false,
            format,
            origin_ns,
            seconds: Vec::new(),
        }
    }

    /// 2019-11-11T17:57:05Z.
    const ORIGIN: i128 = 1_573_495_025_000_000_000;

    #[test]
    fn labels_are_times_of_day_or_the_numbers_of_the_file() {
        let iso = axis(TimeFormat::Iso, ORIGIN);
        assert_eq!(iso.label(0.0, 1), "17:57:05.0");
        assert_eq!(iso.label(54.96, 1), "17:58:00.0");
        assert_eq!(iso.full_label(0.25), "2019-11-11 17:57:05.25 UTC");
        assert_eq!(iso.full_label(7.0 * 3600.0), "2019-11-12 00:57:05 UTC");
        let seconds = axis(TimeFormat::Seconds, -966_000_000);
        assert_eq!((seconds.label(1.0, 3), seconds.label(0.5, 1)), ("0.034".into(), "-0.5".into()));
        assert_eq!((seconds.full_label(0.966), seconds.date(0.0)), ("0 s".into(), None));
        // As many decimals as the numbers of the file need, and as samples that close need.
        let micros = axis(TimeFormat::Elapsed { unit_ns: 1_000 }, 5_012_345_000);
        assert_eq!(
            (micros.full_label(0.000_003), micros.full_label(0.000_000_5)),
            ("5012348".into(), "5012345.5".into())
        );
        let fine = TimeAxis { seconds: vec![0.0, 4e-9], ..axis(TimeFormat::Seconds, 0) };
        assert_eq!(fine.full_label(0.000_001_332), "0.000001332 s");
        let ms = axis(TimeFormat::Elapsed { unit_ns: 1_000_000 }, 0);
        assert_eq!(ms.label(1.5, 0), "1500");
        assert_eq!(axis(TimeFormat::SampleNumber, 0).label(12.0, 0), "12");
        assert_eq!(iso.label(f64::NAN, 1), "");
    }

    #[test]
    fn what_a_user_types_is_read_in_the_form_of_the_file() {
        let iso = axis(TimeFormat::Iso, ORIGIN);
        assert_eq!(iso.parse("2019-11-11T17:57:06.5Z"), Some(1.5));
        assert_eq!(iso.parse(" 17:58:05 "), Some(60.0));
        assert_eq!(iso.parse("17:57:04"), Some(86_399.0));
        assert_eq!(iso.parse("12"), None);
        let epoch = axis(TimeFormat::Epoch { unit_ns: 1_000_000 }, ORIGIN);
        assert_eq!(epoch.parse("1573495025250"), Some(0.25));
        assert_eq!(epoch.parse("2019-11-11 17:57:06"), Some(1.0));
        let seconds = axis(TimeFormat::Seconds, 1_700_000_000_000_000_000);
        assert_eq!(seconds.parse("1700000000.1"), Some(0.1));
        assert_eq!(seconds.parse("1700000000,1"), Some(0.1));
        assert_eq!(axis(TimeFormat::Clock, 64_625 * i128::from(SECOND)).parse("17:57:06"), Some(1.0));
        let us = axis(TimeFormat::YearLast { day_first: false }, ORIGIN);
        assert_eq!(us.parse("11/11/2019 17:57:06"), Some(1.0));
    }

    #[test]
    fn new_times_look_like_their_neighbours() {
        let iso = axis(TimeFormat::Iso, ORIGIN);
        for (seconds, sample, text) in [
            (1.5, "2019-11-11T17:57:05.00Z", "2019-11-11T17:57:06.50Z"),
            (1.0, "2019-11-11 17:57", "2019-11-11 17:57:06"),
            (55.0, "2019-11-11 17:57", "2019-11-11 17:58"),
            (0.9996, "2019-11-11 17:57:05,000", "2019-11-11 17:57:06,000"),
            (0.0, "2019-11-11T12:27:05-05:30", "2019-11-11T12:27:05-05:30"),
            (86_400.0, "2019/11/11", "2019/11/12"),
            (25_200.0, "17:57:05", "00:57:05"),
        ] {
            assert_eq!(iso.write_like(seconds, sample), text, "{sample}");
        }
        let us = axis(TimeFormat::YearLast { day_first: false }, ORIGIN);
        assert_eq!(us.write_like(25_200.0, "11/11/2019 17:57"), "11/12/2019 00:57:05");
        assert_eq!(us.write_like(0.0, "03/01/2005"), "11/11/2019");
        let seconds = axis(TimeFormat::Seconds, 0);
        assert_eq!(seconds.write_like(0.1 + 0.2, "0.10"), "0.30");
        assert_eq!(seconds.write_like(-0.5, "1,000"), "-0,500");
        let ms = axis(TimeFormat::Epoch { unit_ns: 1_000_000 }, ORIGIN);
        assert_eq!(ms.write_like(0.25, "1573495025000"), "1573495025250");
        assert_eq!(axis(TimeFormat::Clock, 0).write_like(25_500.0, "7:04:00"), "7:05:00");
    }

    #[test]
    fn seconds_are_rounded_once() {
        for ns in [100_000_000_i128, 9_007_199_254_740_993, 1_700_000_000_123_456_789, -31_536_000_100_000_000] {
            let text = format!("{ns}e-9");
            assert_eq!(seconds_of(ns).to_bits(), text.parse::<f64>().unwrap().to_bits(), "{ns}");
        }
    }
}
