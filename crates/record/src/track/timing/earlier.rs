//! The time column as it was recognised before the rules of [`super::super::Rules::Second`]: sessions that were saved
//! then go on meaning what they meant.

use std::path::Path;

use super::super::calendar::SECOND;
use super::super::head::Head;
use super::super::timestamp;
use super::super::{LoadOptions, TimeFormat, TimeUnit, Worded, names, printable};
use super::{Timing, undecided, unitless, unreadable};
use crate::error::Result;

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
        if most(&|c| timestamp::iso_below_24(c).is_some()) {
            Some(Self::Iso { date_only: date_only() })
        } else if most(&|c| timestamp::clock(c).is_some()) {
            Some(Self::Clock)
        } else if most(&|c| {
            [true, false].iter().any(|first| timestamp::year_last(c, *first).is_some() && !timestamp::ends_a_day(c))
        }) {
            Some(Self::YearLast { date_only: date_only() })
        } else if most(&|c| timestamp::count(c, 1, head.reading.decimal_comma).is_some()) {
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
/// [`crate::error::Error::Usage`] for a name that is not there, and for a unit of times that are no numbers; [`crate::error::Error::Input`] where the named column holds no times, and where
/// day and month cannot be told apart.
pub(super) fn choose(head: &Head, options: &LoadOptions, path: &Path) -> Result<Option<Timing>> {
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
    Ok(Some(Timing { below_24: true, ..Timing::of(column, date_column, format) }))
}

fn best(head: &Head) -> Option<(usize, Form)> {
    let scored = head.names.iter().enumerate().filter_map(|(column, name)| {
        let form = Form::of(head, column)?;
        let rank = names::earlier::time_rank(name);
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

/// Seconds, another unit, or time since 1970: by the unit that was told or that of the column, and by the size of its
/// numbers where that and name or steps make dates from 1990 to 2100.
fn number_format(head: &Head, column: usize, told: Option<TimeUnit>) -> TimeFormat {
    let name = &head.names[column];
    let of_column = || {
        names::earlier::time_unit_ns(&head.units[column])
            .or_else(|| names::earlier::time_unit_ns(&names::earlier::unit_of(name)))
    };
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
        let plausible = names::earlier::time_rank(name) > 0 || (1e-6..864_000.0).contains(&step);
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
    let parts: Vec<_> = cells.iter().filter_map(|c| timestamp::year_last_parts(c.as_bytes())).collect();
    let (first, second) = (parts.iter().any(|p| p.first > 12), parts.iter().any(|p| p.second > 12));
    // Only day first is written with points.
    match (first || parts.iter().any(|p| p.separator == b'.'), second) {
        (true, false) => Ok(true),
        (false, true) => Ok(false),
        _ => Err(undecided(head, column, path)),
    }
}
