//! Which column is the time, and how it is written.

use std::path::Path;

use super::calendar::DAY;
use super::calendar::SECOND;
use super::head::Head;
use super::time::{DateOrder, Part, Pieces, Zone, fields, parts_moment};
use super::timestamp::{self, Count};
use super::{Clocks, LoadOptions, Rules, TimeFormat, printable};
use crate::error::{Error, Result};

mod candidates;
mod columns;
mod earlier;
mod form;
mod zones;

pub(crate) use candidates::Candidates;
pub(crate) use form::Form;

/// Times that can be read, in words.
pub(crate) const TIMES: &str = "numbers (seconds, or since 1970), 2019-01-31T12:00:00.5Z, 1/31/2019 10:00 AM, 31 Jan 2019 or 12:00:00.5; \
                                what else they look like can be said: --time-format '%d.%m.%Y %H:%M'";

/// The time of the file: where it stands and how it is read.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct Timing {
    /// The column of the time, or of the time of day, or of the finest part.
    pub(crate) column: usize,
    /// The column of the date, where it stands apart.
    pub(crate) date_column: Option<usize>,
    /// The columns of [`TimeFormat::Parts`], in their order.
    pub(crate) columns: Vec<usize>,
    /// How times (with a date column: dates) are written.
    pub(crate) format: TimeFormat,
    /// The zone of clocks that write none.
    pub(crate) zone: Option<Zone>,
    /// Whether anything tells the zone.
    pub(crate) clocks: Clocks,
    /// What was assumed, in a line each.
    pub(crate) said: Vec<String>,
    /// True for seconds of the week alone.
    pub(crate) of_week: bool,
    /// True for minutes and seconds alone.
    pub(crate) of_hour: bool,
    /// True where the time of day `24:00` after a date is none.
    pub(crate) below_24: bool,
}

/// A time as read: nanoseconds, or a number of seconds that has no exact nanoseconds.
pub(crate) type Moment = Count;

impl Timing {
    /// Every column that a time is read from.
    pub(crate) fn all_columns(&self) -> impl Iterator<Item = usize> {
        self.date_column.into_iter().chain([self.column]).chain(self.columns.iter().copied())
    }

    /// A time in one column, or in two where the date stands apart.
    pub(crate) fn of(column: usize, date_column: Option<usize>, format: TimeFormat) -> Self {
        Self {
            column,
            date_column,
            columns: Vec::new(),
            format,
            zone: None,
            clocks: Clocks::Stated,
            said: Vec::new(),
            of_week: false,
            of_hour: false,
            below_24: false,
        }
    }

    /// A time in several columns.
    pub(crate) fn of_parts(columns: Vec<usize>, parts: Vec<Part>) -> Self {
        let column = columns.last().copied().unwrap_or(0);
        Self { columns, ..Self::of(column, None, TimeFormat::Parts(parts)) }
    }

    /// True for a column that is, or is part of, the time.
    pub(crate) fn has(&self, column: usize) -> bool {
        self.column == column || self.date_column == Some(column) || self.columns.contains(&column)
    }

    /// True where times are those of a day alone: a step back is midnight.
    pub(crate) fn is_of_day(&self) -> bool {
        match &self.format {
            TimeFormat::Clock => true,
            TimeFormat::Parts(parts) => parts.contains(&Part::Clock) && !parts.iter().any(|p| p.dates()),
            TimeFormat::Pattern(pattern) => !pattern.has_date(),
            _ => false,
        }
    }

    /// After how many nanoseconds a counter begins again: 32 bits of its unit, or a week of seconds of the week.
    pub(crate) fn wraps_after(&self) -> Option<i64> {
        match self.format {
            _ if self.of_week => Some(7 * DAY),
            TimeFormat::Elapsed { unit_ns } if unit_ns < SECOND => (1_i64 << 32).checked_mul(unit_ns),
            TimeFormat::Duration => Some(3600 * SECOND).filter(|_| self.of_hour),
            _ => None,
        }
    }

    /// True where the time stands in one column.
    pub(crate) fn is_single(&self) -> bool {
        self.date_column.is_none() && self.columns.len() < 2
    }

    /// The moment in the cells of a row, which `cell` gives trimmed and unquoted; none where it cannot be read.
    #[inline]
    pub(crate) fn read<'a>(&self, cell: impl Fn(usize) -> &'a [u8], decimal_comma: bool) -> Option<Moment> {
        if let Some(date) = self.date_column {
            let midnight = calendar(&self.format, cell(date))?;
            let local = midnight.checked_add(timestamp::clock(cell(self.column))?)?;
            return self.in_zone(local, false).map(Count::Exact);
        }
        let single = || cell(self.column);
        match &self.format {
            TimeFormat::SampleNumber => None,
            TimeFormat::Seconds => timestamp::count(single(), SECOND, decimal_comma),
            TimeFormat::Elapsed { unit_ns } | TimeFormat::Epoch { unit_ns } => {
                match timestamp::count(single(), *unit_ns, decimal_comma)? {
                    #[expect(clippy::cast_precision_loss, reason = "a unit is a short number")]
                    Count::Inexact(value) => nanoseconds(value * *unit_ns as f64),
                    exact => Some(exact),
                }
            }
            TimeFormat::Iso | TimeFormat::YearLast { .. } | TimeFormat::Clock if self.zone.is_none() => {
                let told = calendar(&self.format, single())?;
                (!self.below_24 || !timestamp::ends_a_day(single())).then_some(Count::Exact(told))
            }
            _ => self.other(&cell, decimal_comma).map(Count::Exact),
        }
    }

    /// The moment in a form that is not read in the quickest way.
    fn other<'a>(&self, cell: &impl Fn(usize) -> &'a [u8], decimal_comma: bool) -> Option<i64> {
        let text = cell(self.column);
        let told = |pieces: Option<Pieces>| {
            let told = pieces?.told(text)?;
            let local = told.days?.checked_mul(DAY)?.checked_add(told.of_day)?;
            match told.offset {
                Some(offset) => local.checked_sub(offset),
                None => self.in_zone(local, false),
            }
        };
        match &self.format {
            TimeFormat::Iso => told(fields(text, DateOrder::YearFirst)),
            TimeFormat::YearLast { day_first: true } => told(fields(text, DateOrder::DayFirst)),
            TimeFormat::YearLast { day_first: false } => told(fields(text, DateOrder::MonthFirst)),
            TimeFormat::Stamp { order } => told(fields(text, *order)),
            TimeFormat::Pattern(pattern) if pattern.has_date() => told(pattern.fields(text)),
            TimeFormat::Pattern(pattern) => pattern.fields(text)?.told(text).map(|t| t.of_day),
            TimeFormat::Duration => duration(text),
            TimeFormat::Since { unit_ns, zero } => since(text, *unit_ns, zero.seconds(), decimal_comma),
            TimeFormat::DecimalYear => decimal_year(text, decimal_comma),
            TimeFormat::Parts(parts) => {
                let columns = self.columns.as_slice();
                let moment = parts_moment(parts, |i| columns.get(i).map_or(&[][..], |c| cell(*c)), decimal_comma)?;
                let apart = parts.iter().any(|p| matches!(p, Part::Seconds | Part::GpsWeek | Part::Zone))
                    || !parts.iter().any(|p| p.dates());
                self.in_zone(moment, apart)
            }
            TimeFormat::Clock => timestamp::clock(text),
            _ => None,
        }
    }

    /// A local time in UTC; as it is for what tells no local time.
    fn in_zone(&self, local: i64, absolute: bool) -> Option<i64> {
        match &self.zone {
            Some(zone) if !absolute => zone.utc(local),
            _ => Some(local),
        }
    }
}

fn calendar(format: &TimeFormat, cell: &[u8]) -> Option<i64> {
    match format {
        TimeFormat::YearLast { day_first } => timestamp::year_last(cell, *day_first),
        TimeFormat::Clock => timestamp::clock(cell),
        _ => timestamp::iso(cell),
    }
}

/// Time elapsed, with colons: `26:03:00`, `03:07.5`, `-00:00:10`.
pub(crate) fn duration(text: &[u8]) -> Option<i64> {
    let (sign, text) = match text {
        [b'-', rest @ ..] => (-1, rest),
        [b'+', rest @ ..] => (1, rest),
        _ => (1, text),
    };
    let told = fields(text, DateOrder::YearFirst)?.told(text)?;
    told.days.is_none().then_some(sign * told.of_day)
}

/// A number of units after a zero that lies this many seconds after 1970.
fn since(text: &[u8], unit_ns: i64, zero_s: i64, decimal_comma: bool) -> Option<i64> {
    #[expect(clippy::cast_precision_loss, clippy::cast_possible_truncation, reason = "seconds of a calendar")]
    match timestamp::count(text, unit_ns, decimal_comma) {
        Some(Count::Exact(ns)) => ns.checked_add(zero_s.checked_mul(SECOND)?),
        Some(Count::Inexact(value)) => {
            // More decimals than nanoseconds have, or days from far away: whole units apart from their decimals.
            let whole = value.trunc();
            let zero = i128::from(zero_s) * i128::from(SECOND);
            let units = (whole as i128).checked_mul(i128::from(unit_ns))?.checked_add(zero)?;
            let part = ((value - whole) * unit_ns as f64 / 1e3).round() as i128 * 1000;
            i64::try_from(units.checked_add(part)?).ok()
        }
        None => None,
    }
}

/// A year with decimals, to the nearest second.
fn decimal_year(text: &[u8], decimal_comma: bool) -> Option<i64> {
    let text = std::str::from_utf8(text).ok()?;
    let value: f64 = if decimal_comma { text.replacen(',', ".", 1).parse() } else { text.parse() }.ok()?;
    if !(1.0..9999.0).contains(&value) {
        return None;
    }
    #[expect(clippy::cast_possible_truncation, reason = "a year")]
    let year = value.floor() as i64;
    let start = |year| super::calendar::Date { year, month: 1, day: 1 }.days();
    let (from, to) = (start(year)?, start(year + 1)?);
    #[expect(clippy::cast_possible_truncation, clippy::cast_precision_loss, reason = "a year of seconds")]
    let seconds = ((value - value.floor()) * ((to - from) * 86_400) as f64).round() as i64;
    from.checked_mul(DAY)?.checked_add(seconds.checked_mul(SECOND)?)
}

/// The nearest whole nanosecond, where 64 bits hold it.
pub(crate) fn nanoseconds(ns: f64) -> Option<Moment> {
    #[expect(clippy::cast_possible_truncation, reason = "checked")]
    (ns.abs() < 9.2e18).then(|| Count::Exact(ns.round() as i64))
}

/// The time column: the one of the options, otherwise the one that looks most like a time; none for the sample number.
///
/// # Errors
/// [`Error::Usage`] for a name that is not there, and for a unit of times that are no numbers; [`Error::Input`] where
/// the named column holds no times, and where day and month cannot be told apart.
pub(crate) fn choose(head: &Head, options: &LoadOptions, path: &Path) -> Result<Option<Timing>> {
    let chosen = match options.rules {
        Rules::First => earlier::choose(head, options, path),
        Rules::Second => Candidates::of(head, options).choose(path),
    }?;
    Ok(chosen.map(|timing| Timing { clocks: zones::clocks(head, &timing), ..timing }))
}

/// A unit was told that nothing has.
fn unitless(what: &str, word: &str) -> Error {
    Error::usage(format!("{what}, which have no unit ({word})"), "leave out the unit of time, or choose a time column")
}

/// Nothing in the dates of a column tells whether the day or the month stands first.
fn undecided(head: &Head, column: usize, path: &Path) -> Error {
    let cells = head.column(column);
    Error::Input {
        path: path.to_path_buf(),
        line: Some(head.data_line),
        what: format!(
            "`{}` holds dates like {}: is the day or the month first?",
            printable(&head.names[column]),
            printable(cells.first().unwrap_or(&""))
        ),
        help:
            "say which (--dates day-first or --dates month-first, or all of it with --time-format '%y/%m/%d'), choose \
               another time column, or write dates as 2019-01-31"
                .into(),
    }
}

fn unreadable(head: &Head, column: usize, path: &Path) -> Error {
    let cells = head.column(column);
    let example = cells.iter().find(|c| !c.is_empty());
    Error::Input {
        path: path.to_path_buf(),
        line: Some(head.data_line),
        what: match example {
            Some(cell) => {
                format!("`{}` holds no times that can be read: {}", printable(&head.names[column]), printable(cell))
            }
            None => format!("`{}` is empty", printable(&head.names[column])),
        },
        help: format!("times are {TIMES}"),
    }
}

/// True when nine of ten steps go forward.
pub(crate) fn increases(head: &Head, column: usize) -> bool {
    let numbers = form::numbers(head, column);
    let forward = numbers.windows(2).filter(|w| w[1] > w[0]).count();
    numbers.len() > 1 && forward * 10 >= (numbers.len() - 1) * 9
}

/// Does this moment lie more than half a day before the last?
pub(crate) fn is_midnight(last: i64, now: i64) -> bool {
    now < last - DAY / 2
}

#[cfg(test)]
mod tests {
    use super::super::text::Text;
    use super::super::{TimeUnit, Worded};
    use super::*;

    fn chosen_with(text: &str, options: &LoadOptions) -> Result<Option<(String, Option<usize>, TimeFormat)>> {
        let path = Path::new("x.csv");
        let head = Head::of(&Text::of(text.as_bytes(), path, None)?, options, path)?;
        Ok(choose(&head, options, path)?.map(|t| (head.names[t.column].clone(), t.date_column, t.format)))
    }

    fn chosen(text: &str) -> Option<(String, Option<usize>, TimeFormat)> {
        chosen_with(text, &LoadOptions::default()).unwrap()
    }

    #[test]
    fn the_column_that_looks_most_like_time_is_taken() {
        for (text, name, format) in [
            ("x,time_s\n1,0\n2,1\n", "time_s", TimeFormat::Seconds),
            ("x,when\n1,2019-01-01 00:00\n2,2019-01-01 00:15\n", "when", TimeFormat::Iso),
            ("t,x\n0,1\n1,2\n2,3\n", "t", TimeFormat::Seconds),
            ("time_ms,x\n0,1\n10,2\n", "time_ms", TimeFormat::Elapsed { unit_ns: 1_000_000 }),
            ("timestamp,x\n1573495025250,1\n1573495025260,2\n", "timestamp", TimeFormat::Epoch { unit_ns: 1_000_000 }),
            ("epoch,x\n1573495025,1\n1573495026,2\n", "epoch", TimeFormat::Epoch { unit_ns: SECOND }),
            ("time_ns,x\n1573495025250000000,1\n1573495025250000001,2\n", "time_ns", TimeFormat::Epoch { unit_ns: 1 }),
            (
                "gps_time,x\n1257530243,1\n1257530244,2\n",
                "gps_time",
                TimeFormat::Since { unit_ns: SECOND, zero: super::super::Zero::Gps },
            ),
            ("time,x\n17:57:05.25,1\n17:57:06.25,2\n", "time", TimeFormat::Clock),
            ("time,x\n3/23/2005,1\n3/24/2005,2\n", "time", TimeFormat::YearLast { day_first: false }),
            ("time;x\n23.03.2005 10:00;1,5\n24.03.2005 11:00;2,5\n", "time", TimeFormat::YearLast { day_first: true }),
        ] {
            assert_eq!(chosen(text), Some((name.into(), None, format)), "{text}");
        }
        assert_eq!(chosen("x,T\n1,20.5\n2,20.1\n3,20.6\n"), None);
        assert_eq!(chosen("0.0,1\n0.1,2\n"), None);
    }

    #[test]
    fn date_and_time_of_day_that_stand_apart_are_put_together() {
        let apart = Some(("Time".into(), Some(0), TimeFormat::YearLast { day_first: false }));
        assert_eq!(chosen("Date,Time,x\n3/23/2005,17:00:00,1\n3/23/2005,18:00:00,2\n"), apart);
        assert_eq!(
            chosen("2019-01-01 00:00 5.0\n2019-01-01 00:15 6.0\n"),
            Some(("column_2".into(), Some(0), TimeFormat::Iso))
        );
    }

    #[test]
    fn day_and_month_that_cannot_be_told_apart_are_refused() {
        let text = "time,x\n1/2/2005,1\n1/3/2005,2\n";
        let e = chosen_with(text, &LoadOptions::default()).unwrap_err().to_string();
        assert!(e.contains("x.csv:2: `time` holds dates like 1/2/2005"), "{e}");
        let told = LoadOptions { day_first: Some(true), ..LoadOptions::default() };
        assert_eq!(chosen_with(text, &told).unwrap().map(|c| c.2), Some(TimeFormat::YearLast { day_first: true }));
    }

    #[test]
    fn a_unit_that_is_told_goes_before_that_of_the_column() {
        let told = |text: &str, word: &str| {
            let options = LoadOptions { time_unit: TimeUnit::of_word(word), ..LoadOptions::default() };
            chosen_with(text, &options).map(|c| c.map(|c| c.2))
        };
        let ms = Some(TimeFormat::Elapsed { unit_ns: 1_000_000 });
        assert_eq!(told("t,x\n0,1\n10,2\n20,3\n", "ms").unwrap(), ms);
        assert_eq!(told("time_us,x\n0,1\n10,2\n", "ms").unwrap(), ms);
        assert_eq!(told("time_us,x\n0,1\n10,2\n", "s").unwrap(), Some(TimeFormat::Seconds));
        // A number that is a date in the unit that was told, and one that would be a date in another.
        let epoch = "timestamp,x\n1573495025250,1\n1573495025260,2\n";
        assert_eq!(told(epoch, "ms").unwrap(), Some(TimeFormat::Epoch { unit_ns: 1_000_000 }));
        assert_eq!(told(epoch, "us").unwrap(), Some(TimeFormat::Elapsed { unit_ns: 1_000 }));
        for text in ["x,when\n1,2019-01-01 00:00\n2,2019-01-01 00:15\n", "0.0,1\n0.1,2\n"] {
            let e = told(text, "ms").unwrap_err().to_string();
            assert!(e.contains("have no unit (ms)") && e.contains("leave out the unit"), "{e}");
        }
    }

    #[test]
    fn a_named_column_must_hold_times() {
        let named = |time: &str| LoadOptions { time: Some(time.into()), ..LoadOptions::default() };
        let text = "t,x,who\n0,1,a\n1,2,b\n";
        assert_eq!(chosen_with(text, &named("#2")).unwrap().map(|c| c.0), Some("x".into()));
        let e = chosen_with(text, &named("who")).unwrap_err().to_string();
        assert!(e.contains("`who` holds no times that can be read: a"), "{e}");
    }
}
