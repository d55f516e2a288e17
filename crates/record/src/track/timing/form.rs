//! What the cells of a column look like, as times.

use super::super::head::Head;
use super::super::time::{DateOrder, Pattern, fields};
use super::super::timestamp;
use super::duration;

/// What the cells of a column look like, as times.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Form {
    /// A date in ISO order, and perhaps a time of day.
    Iso { date_only: bool },
    /// A date with the year last.
    YearLast { date_only: bool },
    /// A date in another spelling.
    Stamp { date_only: bool },
    /// A time of day with two colons, or one.
    Clock,
    /// A time of day in another spelling.
    OtherClock,
    /// Hours beyond 24, or minutes and seconds.
    Duration,
    /// Numbers.
    Number,
    /// What fits the pattern that was told.
    Told { date_only: bool },
}

impl Form {
    /// The form of at least half of the cells that are not empty.
    pub(crate) fn of(head: &Head, column: usize, pattern: Option<&Pattern>) -> Option<Self> {
        let cells: Vec<&[u8]> = head.column(column).into_iter().map(str::as_bytes).collect();
        let cells: Vec<&[u8]> = cells.into_iter().filter(|c| !head.reading.is_marker(c)).collect();
        let share = |reads: &dyn Fn(&[u8]) -> bool| cells.iter().filter(|c| reads(c)).count();
        let most = |reads: &dyn Fn(&[u8]) -> bool| !cells.is_empty() && share(reads) * 2 >= cells.len();
        let clocked = |c: &[u8]| c.contains(&b':');
        if let Some(pattern) = pattern
            && most(&|c| pattern.fields(c).is_some_and(|p| p.told(c).is_some()))
        {
            return Some(Self::Told {
                date_only: !most(&|c| pattern.fields(c).and_then(|p| p.told(c)).is_some_and(|t| t.clock)),
            });
        }
        // Most columns are numbers, and seen to be so by a few cells.
        let few = &cells[..cells.len().min(8)];
        let number = |c: &[u8]| timestamp::count(c, 1, head.reading.decimal_comma).is_some();
        if !few.is_empty() && few.iter().all(|c| number(c)) && most(&number) {
            return Some(Self::Number);
        }
        let told = |c: &[u8]| DateOrder::ALL.into_iter().find_map(|o| fields(c, o)?.told(c));
        if most(&|c| timestamp::iso(c).is_some()) {
            Some(Self::Iso { date_only: most(&|c| !clocked(c)) })
        } else if most(&|c| [true, false].iter().any(|first| timestamp::year_last(c, *first).is_some())) {
            Some(Self::YearLast { date_only: most(&|c| !clocked(c)) })
        } else if most(&|c| timestamp::clock(c).is_some())
            && !cells.iter().any(|c| c.starts_with(b"24:") || beyond_a_day(c))
        {
            Some(Self::Clock)
        } else if most(&|c| told(c).is_some_and(|t| t.days.is_some())) {
            Some(Self::Stamp { date_only: !most(&|c| told(c).is_some_and(|t| t.clock)) })
        } else if most(&|c| clocked(c) && duration(c).is_some()) {
            let minutes =
                |c: &[u8]| fields(c, DateOrder::YearFirst).is_some_and(|p| !p.has(super::super::time::Field::Hour));
            let long = cells.iter().any(|c| beyond_a_day(c) || c.first() == Some(&b'-')) || most(&minutes);
            Some(if long { Self::Duration } else { Self::OtherClock })
        } else if most(&number) {
            Some(Self::Number)
        } else {
            None
        }
    }

    /// True for a date without a time of day.
    pub(crate) fn is_date_only(self) -> bool {
        matches!(
            self,
            Self::Iso { date_only: true }
                | Self::YearLast { date_only: true }
                | Self::Stamp { date_only: true }
                | Self::Told { date_only: true }
        )
    }

    /// True for what tells a date.
    pub(crate) fn is_dated(self) -> bool {
        matches!(self, Self::Iso { .. } | Self::YearLast { .. } | Self::Stamp { .. } | Self::Told { .. })
    }
}

/// 24 hours and more.
fn beyond_a_day(cell: &[u8]) -> bool {
    duration(cell).is_some_and(|ns| ns >= super::DAY + super::SECOND)
}

/// The numbers of the sampled cells of a column.
pub(crate) fn numbers(head: &Head, column: usize) -> Vec<f64> {
    let mut numbers = Vec::new();
    for cell in head.column(column) {
        numbers.extend(head.reading.number(cell.as_bytes()).filter(|v| v.is_finite()));
    }
    numbers
}
