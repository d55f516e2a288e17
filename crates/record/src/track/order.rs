//! From moments to a time axis: the origin, seconds after it, and the rows that do not go forward.

use rayon::prelude::*;

use super::Wanted;
use super::axis::seconds_of;
use super::calendar::{DAY, SECOND};
use super::mend::{About, Mended, mend};
use super::multi_track::NOBODY;
use super::timing::is_midnight;

/// The moments of all rows.
#[derive(Debug)]
pub(crate) enum Moments {
    /// Nanoseconds; [`UNREADABLE`] where there is none.
    Exact(Vec<i64>),
    /// Seconds as doubles, for files whose times have more decimals than nanoseconds; NaN where there is none.
    Float(Vec<f64>),
}

/// Stands for a moment that could not be read.
pub(crate) const UNREADABLE: i64 = i64::MIN;

/// Rows whose time is of no use: how many, and the first few.
#[derive(Debug, Default, PartialEq)]
pub(crate) struct Rows {
    pub(crate) count: usize,
    pub(crate) first: Vec<usize>,
}

impl Rows {
    fn add(&mut self, row: usize) {
        self.count += 1;
        if self.first.len() < super::Fault::KEPT {
            self.first.push(row);
        }
    }

    /// Takes rows out that are counted elsewhere.
    pub(crate) fn without(&mut self, rows: &[usize]) {
        self.count = self.count.saturating_sub(rows.len());
        self.first.retain(|row| !rows.contains(row));
    }
}

impl Moments {
    /// Mends them; what is told of doubles is told of their nanoseconds.
    pub(crate) fn mended(&mut self, about: About<'_>) -> Mended {
        match self {
            Self::Exact(moments) => mend(moments, about),
            Self::Float(seconds) => {
                #[expect(clippy::cast_possible_truncation, reason = "saturates, and nanoseconds suffice")]
                let ns = |s: &f64| if s.is_finite() { (s * 1e9) as i64 } else { UNREADABLE };
                let mut moments: Vec<i64> = seconds.iter().map(ns).collect();
                let mended = mend(&mut moments, About { wrap: None, ..about });
                mended.wild.iter().for_each(|row| seconds[*row] = f64::NAN);
                mended
            }
        }
    }

    /// The last first.
    pub(crate) fn reverse(&mut self) {
        match self {
            Self::Exact(moments) => moments.reverse(),
            Self::Float(seconds) => seconds.reverse(),
        }
    }
}

impl Ordered {
    /// The last row first.
    pub(crate) fn reverse(&mut self) {
        let count = self.seconds.len();
        self.seconds.reverse();
        for rows in [&mut self.repeated, &mut self.backward, &mut self.unreadable] {
            rows.first.iter_mut().for_each(|row| *row = count - 1 - *row);
        }
    }
}

/// Moments put in order.
#[derive(Debug, Default)]
pub(crate) struct Ordered {
    pub(crate) origin_ns: i128,
    pub(crate) seconds: Vec<f64>,
    pub(crate) repeated: Rows,
    pub(crate) backward: Rows,
    pub(crate) unreadable: Rows,
}

/// Puts moments in order: the first readable one is the origin, and a row whose moment is not after that of the last
/// usable row gets NaN. With `clock`, moments are times of day, and a step back of more than half a day is midnight.
///
/// With `of_row` (for each row its target, or [`NOBODY`]) every target has times of its own; a row of nobody gets NaN
/// and is no fault. What comes after it is no longer wanted is NaN.
pub(crate) fn order(moments: Moments, clock: bool, of_row: Option<&[u32]>, wanted: Wanted<'_>) -> Ordered {
    match moments {
        Moments::Exact(ns) => exact(ns, clock, &mut Lasts { of_row, lasts: Vec::new(), wanted }),
        Moments::Float(seconds) => float(seconds, &mut Lasts { of_row, lasts: Vec::new(), wanted }),
    }
}

/// Numbers of the samples of each target, counted from 0; NaN for rows of nobody.
pub(crate) fn sample_numbers(of_row: &[u32]) -> Vec<f64> {
    let mut counts: Vec<f64> = Vec::new();
    let number = |&target: &u32| {
        if target == NOBODY {
            return f64::NAN;
        }
        let index = target as usize;
        if counts.len() <= index {
            counts.resize(index + 1, 0.0);
        }
        counts[index] += 1.0;
        counts[index] - 1.0
    };
    of_row.iter().map(number).collect()
}

/// The last usable time of each target.
struct Lasts<'a, T> {
    of_row: Option<&'a [u32]>,
    lasts: Vec<T>,
    /// Asked at every [`STRIDE`]-th row.
    wanted: Wanted<'a>,
}

/// Rows between two looks at whether the record is still wanted.
const STRIDE: usize = 1 << 16;

impl<T: Default + Clone> Lasts<'_, T> {
    /// What is kept for the target of `row`; none for a row of nobody.
    fn of(&mut self, row: usize) -> Option<&mut T> {
        if row.is_multiple_of(STRIDE) && !self.wanted.still() {
            // From here on all rows are those of nobody.
            self.of_row = Some(&[]);
        }
        let target = match self.of_row {
            None => 0,
            Some(of_row) => of_row.get(row).copied().filter(|t| *t != NOBODY)? as usize,
        };
        if self.lasts.len() <= target {
            self.lasts.resize(target + 1, T::default());
        }
        self.lasts.get_mut(target)
    }
}

/// The last usable row: its moment in nanoseconds (none before the first), its seconds, and the midnights passed.
#[derive(Default, Clone)]
struct LastExact {
    moment: Option<i64>,
    seconds: f64,
    days: Days,
}

/// The last usable row: its moment and its seconds after the origin.
#[derive(Clone)]
struct LastFloat {
    moment: f64,
    seconds: f64,
}

impl Default for LastFloat {
    fn default() -> Self {
        Self { moment: f64::NEG_INFINITY, seconds: f64::NEG_INFINITY }
    }
}

/// True where every moment is readable and after the one before, as in nearly every record.
pub(crate) fn increasing(moments: &[i64]) -> bool {
    const PIECE: usize = 1 << 16;
    moments.first().is_none_or(|first| *first != UNREADABLE)
        && (0..moments.len().div_ceil(PIECE)).into_par_iter().all(|piece| {
            let start = piece * PIECE;
            // Pieces share the moment between them.
            let end = (start + PIECE + 1).min(moments.len());
            moments[start..end].windows(2).all(|w| w[0] < w[1])
        })
}

/// The longest span in nanoseconds (92 days) over which doubles of seconds are less than a nanosecond apart: moments that
/// differ have seconds that differ.
const DISTINCT: i64 = 8_000_000_000_000_000;

fn exact(moments: Vec<i64>, clock: bool, lasts: &mut Lasts<'_, LastExact>) -> Ordered {
    if !clock
        && lasts.of_row.is_none()
        && let (Some(&first), Some(&last)) = (moments.first(), moments.last())
        && last.checked_sub(first).is_some_and(|span| span <= DISTINCT)
        && increasing(&moments)
    {
        let mut wanted = true;
        let place = |(row, moment): (usize, i64)| {
            if row.is_multiple_of(STRIDE) {
                wanted = lasts.wanted.still();
            }
            if wanted { since(moment, first) } else { f64::NAN }
        };
        let seconds = moments.into_iter().enumerate().map(place).collect();
        return Ordered { origin_ns: i128::from(first), seconds, ..Ordered::default() };
    }
    let mut ordered = Ordered::default();
    let mut origin: Option<i64> = None;
    let mut place = |row: usize, moment: i64| {
        let Some(last) = lasts.of(row) else { return f64::NAN };
        if moment == UNREADABLE {
            ordered.unreadable.add(row);
            return f64::NAN;
        }
        let now = if clock { last.days.moment(moment, last.moment) } else { moment };
        // Over spans of months a double of seconds is coarser than a nanosecond: the axis must increase all the same.
        let seconds = since(now, *origin.get_or_insert(now));
        let Some(before) = last.moment.filter(|_| seconds <= last.seconds) else {
            last.moment = Some(now);
            last.seconds = seconds;
            return seconds;
        };
        let fault = if now >= before { &mut ordered.repeated } else { &mut ordered.backward };
        fault.add(row);
        f64::NAN
    };
    // Collecting in place of the moments keeps memory at one column.
    let seconds = moments.into_iter().enumerate().map(|(row, moment)| place(row, moment)).collect();
    Ordered { origin_ns: i128::from(origin.unwrap_or(0)), seconds, ..ordered }
}

/// The midnights that a file of times of day has passed.
#[derive(Default, Clone)]
struct Days {
    passed: i64,
}

impl Days {
    fn moment(&mut self, of_day: i64, last: Option<i64>) -> i64 {
        let now = of_day.saturating_add(self.passed);
        match last {
            Some(last) if is_midnight(last, now) => self.passed += DAY,
            // A straggler from before the midnight that was just passed is late, not a day early.
            Some(last) if last - self.passed < 3600 * SECOND && self.passed > 0 && now - last > DAY - 3600 * SECOND => {
                return now - DAY;
            }
            _ => {}
        }
        of_day.saturating_add(self.passed)
    }
}

/// Nanoseconds between two moments in seconds, correctly rounded.
fn since(now: i64, origin: i64) -> f64 {
    const EXACT: i64 = 1 << 53;
    match now.checked_sub(origin) {
        #[expect(clippy::cast_precision_loss, reason = "below 2^53")]
        Some(ns) if ns.abs() < EXACT => ns as f64 / 1e9,
        _ => seconds_of(i128::from(now) - i128::from(origin)),
    }
}

fn float(mut seconds: Vec<f64>, lasts: &mut Lasts<'_, LastFloat>) -> Ordered {
    let mut ordered = Ordered::default();
    let mut origin: Option<f64> = None;
    for (row, moment) in seconds.iter_mut().enumerate() {
        let now = *moment;
        *moment = f64::NAN;
        let Some(last) = lasts.of(row) else { continue };
        if !now.is_finite() {
            ordered.unreadable.add(row);
            continue;
        }
        let after_origin = now - *origin.get_or_insert(now);
        if now < last.moment {
            ordered.backward.add(row);
        } else if after_origin <= last.seconds {
            ordered.repeated.add(row);
        } else {
            *last = LastFloat { moment: now, seconds: after_origin };
            *moment = after_origin;
        }
    }
    #[expect(clippy::cast_possible_truncation, reason = "saturates, and nanoseconds suffice")]
    let origin_ns = (origin.unwrap_or(0.0) * 1e9).round() as i128;
    Ordered { origin_ns, seconds, ..ordered }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn moments_that_increase_are_told_apart_to_the_nanosecond() {
        let count = 200_000;
        let last = DISTINCT - 1;
        let moments: Vec<i64> = (0..count).chain((0..count).map(|i| last - count + i)).map(|m| 7 + m).collect();
        assert!(increasing(&moments));
        let ordered = order(Moments::Exact(moments.clone()), false, None, Wanted::always());
        assert_eq!((ordered.origin_ns, ordered.repeated.count), (7, 0));
        assert!(ordered.seconds.windows(2).all(|w| w[0] < w[1]));
        // Where two pieces meet, too.
        for row in [1, 65_535, 65_536, 65_537, moments.len() - 1] {
            let mut faulty = moments.clone();
            faulty[row] = faulty[row - 1];
            assert!(!increasing(&faulty), "{row}");
        }
        assert!(!increasing(&[UNREADABLE, 1]));
    }

    #[test]
    fn what_does_not_go_forward_is_nan_and_counted() {
        let s = SECOND;
        let ordered = order(
            Moments::Exact(vec![UNREADABLE, 5 * s, 6 * s, 6 * s, 4 * s, 6 * s, 7 * s]),
            false,
            None,
            Wanted::always(),
        );
        assert_eq!(ordered.origin_ns, 5_000_000_000);
        let rows = |first: &[usize]| Rows { count: first.len(), first: first.to_vec() };
        assert_eq!((ordered.unreadable, ordered.repeated, ordered.backward), (rows(&[0]), rows(&[3, 5]), rows(&[4])));
        let usable: Vec<f64> = ordered.seconds.iter().copied().filter(|s| !s.is_nan()).collect();
        assert_eq!((usable, ordered.seconds.len()), (vec![0.0, 1.0, 2.0], 7));
    }

    #[test]
    fn seconds_after_a_large_origin_are_those_after_zero() {
        let tenth = SECOND / 10;
        let large = order(
            Moments::Exact((0..1000).map(|i| 1_700_000_000 * SECOND + i * tenth).collect()),
            false,
            None,
            Wanted::always(),
        );
        let expected: Vec<f64> = (0..1000).map(|i| format!("{}.{}", i / 10, i % 10).parse().unwrap()).collect();
        assert_eq!(large.seconds, expected);
    }

    #[test]
    fn times_of_day_pass_midnight_and_stragglers_stay_behind() {
        let h = 3600 * SECOND;
        let ordered =
            order(Moments::Exact(vec![23 * h, 24 * h - 1, 1, 24 * h - 5, 2, 13 * h, 1]), true, None, Wanted::always());
        let at = |ns: i64| since(ns, 23 * h);
        let expected = [0.0, at(24 * h - 1), at(24 * h + 1), f64::NAN, at(24 * h + 2), at(37 * h), at(48 * h + 1)];
        assert_eq!(format!("{:?}", ordered.seconds), format!("{expected:?}"));
        assert_eq!(ordered.backward.first, [3]);
    }

    #[test]
    fn long_decimals_are_taken_as_doubles() {
        let ordered = order(Moments::Float(vec![0.1, 0.1 + 0.2, f64::NAN, 0.2, 0.5]), false, None, Wanted::always());
        assert_eq!(ordered.seconds[1], (0.1 + 0.2) - 0.1);
        assert_eq!((ordered.unreadable.count, ordered.backward.count, ordered.origin_ns), (1, 1, 100_000_000));
        assert!(ordered.seconds[3].is_nan() && ordered.seconds[4] == 0.4);
    }
}
