//! Which column is the time, and how it is written.

use std::path::Path;

use super::calendar::{DAY, SECOND};
use super::head::Head;
use super::stamp::{self, Count};
use super::{LoadOptions, TimeFormat, TimeUnit, Worded, names, printable};
use crate::error::{Error, Result};

/// Times that can be read, in words.
pub(crate) const TIMES: &str = "numbers (seconds, or since 1970), 2019-01-31T12:00:00.5Z, 1/31/2019 or 12:00:00.5";

/// The time of the file: where it stands and how it is read.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct Timing {
    /// The column of the time, or of the time of day.
    pub(crate) column: usize,
    /// The column of the date, where it stands apart.
    pub(crate) date_column: Option<usize>,
    /// How times (with a date column: dates) are written.
    pub(crate) format: TimeFormat,
}

/// A time as read: nanoseconds, or a number of seconds that has no exact nanoseconds.
pub(crate) type Moment = Count;

impl Timing {
    /// The moment in the two cells, trimmed and unquoted; none where it cannot be read.
    #[inline]
    pub(crate) fn read(&self, cell: &[u8], date: &[u8], decimal_comma: bool) -> Option<Moment> {
        if self.date_column.is_some() {
            let midnight = calendar(&self.format, date)?;
            return midnight.checked_add(stamp::clock(cell)?).map(Count::Exact);
        }
        match self.format {
            TimeFormat::SampleNumber => None,
            TimeFormat::Seconds => stamp::count(cell, SECOND, decimal_comma),
            TimeFormat::Elapsed { unit_ns } | TimeFormat::Epoch { unit_ns } => {
                match stamp::count(cell, unit_ns, decimal_comma)? {
                    #[expect(clippy::cast_precision_loss, reason = "a unit is a short number")]
                    Count::Inexact(value) => nanoseconds(value * unit_ns as f64),
                    exact => Some(exact),
                }
            }
            _ => calendar(&self.format, cell).map(Count::Exact),
        }
    }
}

fn calendar(format: &TimeFormat, cell: &[u8]) -> Option<i64> {
    match format {
        TimeFormat::YearLast { day_first } => stamp::year_last(cell, *day_first),
        TimeFormat::Clock => stamp::clock(cell),
        _ => stamp::iso(cell),
    }
}

/// The nearest whole nanosecond, where 64 bits hold it.
pub(crate) fn nanoseconds(ns: f64) -> Option<Moment> {
    #[expect(clippy::cast_possible_truncation, reason = "checked")]
    (ns.abs() < 9.2e18).then(|| Count::Exact(ns.round() as i64))
}

/// What the cells of a column look like, as times.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Form {
    Iso { date_only: bool },
    YearLast { date_only: bool },
    Clock,
    Number,
}

impl Form {
    /// The form of at least half of the cells that are not empty.
    fn of(head: &Head, column: usize) -> Option<Self> {
        let cells: Vec<&[u8]> = head.column(column).into_iter().map(str::as_bytes).collect();
        let cells: Vec<&[u8]> = cells.into_iter().filter(|c| !head.reading.is_marker(c)).collect();
        let most = |reads: &dyn Fn(&[u8]) -> bool| {
            !cells.is_empty() && cells.iter().filter(|c| reads(c)).count() * 2 >= cells.len()
        };
        let date_only = || most(&|c| !c.contains(&b':'));
        if most(&|c| stamp::iso(c).is_some()) {
            Some(Self::Iso { date_only: date_only() })
        } else if most(&|c| stamp::clock(c).is_some()) {
            Some(Self::Clock)
        } else if most(&|c| [true, false].iter().any(|first| stamp::year_last(c, *first).is_some())) {
            Some(Self::YearLast { date_only: date_only() })
        } else if most(&|c| stamp::count(c, 1, head.reading.decimal_comma).is_some()) {
            Some(Self::Number)
        } else {
            None
        }
    }

    fn is_date_only(self) -> bool {
        matches!(self, Self::Iso { date_only: true } | Self::YearLast { date_only: true })
    }
}

/// The time column: the one of the options, otherwise the one that looks most like a time; none for the sample number.
///
/// # Errors
/// [`Error::Usage`] for a name that is not there, and for a unit of times that are no numbers; [`Error::Input`] where the named column holds no times, and where
/// day and month cannot be told apart.
pub(crate) fn choose(head: &Head, options: &LoadOptions, path: &Path) -> Result<Option<Timing>> {
    let chosen = match &options.time {
        Some(name) => {
            let column = names::find(head.names.iter().map(String::as_str), name)?;
            let form = Form::of(head, column).ok_or_else(|| unreadable(head, column, path))?;
            Some((column, form))
        }
        None => best(head),
    };
    let unit = options.time_unit.and_then(Worded::word);
    let Some((column, form)) = chosen else {
        return match unit {
            None => Ok(None),
            Some(word) => Err(unitless("the times are sample numbers", word)),
        };
    };
    let (column, date_column) = paired(head, column, form);
    let dated = date_column.unwrap_or(column);
    let format = Form::of(head, dated).unwrap_or(form);
    if let Some(word) = unit.filter(|_| format != Form::Number) {
        return Err(unitless(&format!("`{}` holds dates or times of day", printable(&head.names[dated])), word));
    }
    let format = match format {
        Form::Iso { .. } => TimeFormat::Iso,
        Form::Clock => TimeFormat::Clock,
        Form::YearLast { .. } => TimeFormat::YearLast { day_first: day_first(head, dated, options, path)? },
        Form::Number => number_format(head, column, options.time_unit),
    };
    Ok(Some(Timing { column, date_column, format }))
}

/// A unit was told that nothing has.
fn unitless(what: &str, word: &str) -> Error {
    Error::usage(format!("{what}, which have no unit ({word})"), "leave out the unit of time, or choose a time column")
}

fn best(head: &Head) -> Option<(usize, Form)> {
    let scored = head.names.iter().enumerate().filter_map(|(column, name)| {
        let form = Form::of(head, column)?;
        let rank = names::time_rank(name);
        let content = match form {
            Form::Iso { .. } => 5,
            Form::Clock | Form::YearLast { .. } if rank > 0 => 3,
            Form::Number if rank == 4 || (rank > 0 && runs_forward(head, column)) => 2,
            _ => return None,
        };
        Some((rank + content, column, form))
    });
    scored.max_by_key(|(score, column, _)| (*score, usize::MAX - column)).map(|(_, column, form)| (column, form))
}

/// Where date and time of day stand apart: the column of the time of day and that of the date.
fn paired(head: &Head, column: usize, form: Form) -> (usize, Option<usize>) {
    let other = |fits: &dyn Fn(Form) -> bool| {
        (0..head.names.len()).filter(|c| *c != column).find(|c| Form::of(head, *c).is_some_and(fits))
    };
    match form {
        Form::Clock => (column, other(&Form::is_date_only)),
        _ if form.is_date_only() => match other(&|f| f == Form::Clock) {
            Some(clock) => (clock, Some(column)),
            None => (column, None),
        },
        _ => (column, None),
    }
}

fn numbers(head: &Head, column: usize) -> Vec<f64> {
    let mut numbers = Vec::new();
    for cell in head.column(column) {
        numbers.extend(head.reading.number(cell.as_bytes()).filter(|v| v.is_finite()));
    }
    numbers
}

/// True when a column whose name says time goes forward as a time does: steps back and repeated stamps are faults of
/// single rows, not a reason to take the times for a measurement.
fn runs_forward(head: &Head, column: usize) -> bool {
    let numbers = numbers(head, column);
    let forward = numbers.windows(2).filter(|w| w[1] > w[0]).count();
    let back = numbers.windows(2).filter(|w| w[1] < w[0]).count();
    forward > 0 && back * 4 <= forward
}

/// True when nine of ten steps go forward.
pub(crate) fn increases(head: &Head, column: usize) -> bool {
    let numbers = numbers(head, column);
    let forward = numbers.windows(2).filter(|w| w[1] > w[0]).count();
    numbers.len() > 1 && forward * 10 >= (numbers.len() - 1) * 9
}

/// Seconds, another unit, or time since 1970: by the unit that was told or that of the column, and by the size of its
/// numbers where that and name or steps make dates from 1990 to 2100.
fn number_format(head: &Head, column: usize, told: Option<TimeUnit>) -> TimeFormat {
    let name = &head.names[column];
    let of_column = || names::time_unit_ns(&head.units[column]).or_else(|| names::time_unit_ns(&names::unit_of(name)));
    let told = told.map(|unit| unit.ns);
    let unit = told.or_else(of_column);
    let mut values = numbers(head, column);
    let steps: Vec<f64> = values.windows(2).map(|w| (w[1] - w[0]).abs()).filter(|s| *s > 0.0).collect();
    let middle = |values: &mut Vec<f64>| {
        values.sort_by(f64::total_cmp);
        values.get(values.len() / 2).copied().unwrap_or(0.0)
    };
    let typical = middle(&mut values);
    let step = middle(&mut { steps });
    // 1990-01-01 and 2100-01-01 in seconds since 1970.
    let dated = |unit_ns: i64| {
        #[expect(clippy::cast_precision_loss, reason = "a power of ten")]
        let unit = unit_ns as f64 / 1e9;
        let (value, step) = (typical * unit, step * unit);
        let plausible = names::time_rank(name) > 0 || (1e-6..864_000.0).contains(&step);
        (631_152_000.0..4_102_444_800.0).contains(&value) && plausible
    };
    // GPS time has another zero and no leap seconds.
    let other_zero = names::words(name).iter().any(|w| matches!(w.to_lowercase().as_str(), "gps" | "tow" | "gnss"));
    let epoch = [SECOND, 1_000_000, 1_000, 1]
        .into_iter()
        .find(|u| told.is_none_or(|told| told == *u) && dated(*u))
        .filter(|_| !other_zero);
    match (unit, epoch) {
        (Some(unit), Some(epoch)) if unit == epoch => TimeFormat::Epoch { unit_ns: epoch },
        (None, Some(epoch)) => TimeFormat::Epoch { unit_ns: epoch },
        (Some(unit), _) if unit != SECOND => TimeFormat::Elapsed { unit_ns: unit },
        _ => TimeFormat::Seconds,
    }
}

/// Does the day stand before the month?
fn day_first(head: &Head, column: usize, options: &LoadOptions, path: &Path) -> Result<bool> {
    if let Some(day_first) = options.day_first {
        return Ok(day_first);
    }
    let cells = head.column(column);
    let parts: Vec<_> = cells.iter().filter_map(|c| stamp::year_last_parts(c.as_bytes())).collect();
    let (first, second) = (parts.iter().any(|p| p.first > 12), parts.iter().any(|p| p.second > 12));
    // Only day first is written with points.
    match (first || parts.iter().any(|p| p.separator == b'.'), second) {
        (true, false) => Ok(true),
        (false, true) => Ok(false),
        _ => Err(Error::Input {
            path: path.to_path_buf(),
            line: Some(head.data_line),
            what: format!(
                "`{}` holds dates like {}: is the day or the month first?",
                printable(&head.names[column]),
                printable(cells.first().unwrap_or(&""))
            ),
            help: "say which (--dates day-first or --dates month-first), choose another time column, or write dates as 2019-01-31".into(),
        }),
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

/// Does this moment lie more than half a day before the last?
pub(crate) fn is_midnight(last: i64, now: i64) -> bool {
    now < last - DAY / 2
}

#[cfg(test)]
mod tests {
    use super::super::text::Text;
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
            ("gps_time,x\n1257530243,1\n1257530244,2\n", "gps_time", TimeFormat::Seconds),
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
