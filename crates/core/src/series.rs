//! The present samples of one channel, and where the record is cut.

use std::borrow::Cow;
use std::convert::Infallible;
use std::ops::Range;

use rayon::prelude::*;

use crate::error::Error;
use crate::interval::nominal_interval;

/// Steps in one piece of parallel work.
const CHUNK: usize = 16_384;

/// The samples of a channel that have both a time and a value, in order. Methods, repairs and plots work on
/// positions in this list; [`Series::row`] leads back to the row of the file.
#[derive(Debug, Clone, PartialEq)]
pub struct Series<'a> {
    /// Row of each sample; none when every row is present.
    rows: Option<Cow<'a, [u32]>>,
    /// Times in seconds after the origin of the track, strictly increasing.
    pub t: Cow<'a, [f64]>,
    /// Values, all finite.
    pub y: Cow<'a, [f64]>,
    /// Nominal interval `T`: the median of the steps between neighbours, in seconds; NaN with fewer than two samples.
    pub interval: f64,
}

impl<'a> Series<'a> {
    /// The samples of `rows` (ascending) at which time and value are finite; `seconds` has a time for every row of
    /// the record, `values` one for each of `rows`.
    #[must_use]
    pub fn of_rows(rows: &[u32], seconds: &[f64], values: &[f64]) -> Self {
        Self::of_pairs(rows.iter().copied().zip(values.iter().copied()), seconds)
    }

    /// The same of rows with their values, in the order of their times.
    #[must_use]
    pub fn of_pairs(pairs: impl Iterator<Item = (u32, f64)>, seconds: &[f64]) -> Self {
        let (mut kept, mut t, mut y) = (Vec::new(), Vec::new(), Vec::new());
        for (row, value) in pairs {
            let time = seconds.get(row as usize).copied().unwrap_or(f64::NAN);
            if time.is_finite() && value.is_finite() {
                kept.push(row);
                t.push(time);
                y.push(value);
            }
        }
        let interval = nominal_interval(&t);
        Self { rows: Some(Cow::Owned(kept)), t: Cow::Owned(t), y: Cow::Owned(y), interval }
    }

    /// The samples at which both slices are finite. `t` must increase over them.
    #[must_use]
    pub fn new(t: &'a [f64], y: &'a [f64]) -> Self {
        let present = |i: &usize| t[*i].is_finite() && y[*i].is_finite();
        let n = t.len().min(y.len());
        if (0..n).all(|i| present(&i)) {
            let (t, y) = (&t[..n], &y[..n]);
            return Self { rows: None, t: Cow::Borrowed(t), y: Cow::Borrowed(y), interval: nominal_interval(t) };
        }
        #[expect(clippy::cast_possible_truncation, reason = "the loader refuses files of 2^32 rows and more")]
        let rows: Vec<u32> = (0..n).filter(present).map(|i| i as u32).collect();
        let t: Vec<f64> = rows.iter().map(|&i| t[i as usize]).collect();
        let y = rows.iter().map(|&i| y[i as usize]).collect();
        let interval = nominal_interval(&t);
        Self { rows: Some(Cow::Owned(rows)), t: Cow::Owned(t), y: Cow::Owned(y), interval }
    }

    /// [`Series::new`] of slices that nobody has checked.
    ///
    /// # Errors
    /// [`Error::Usage`] when there are not as many values as times, or when the times do not increase.
    pub fn checked(t: &'a [f64], y: &'a [f64]) -> Result<Self, Error> {
        if t.len() != y.len() {
            let what = format!("{} times and {} values", t.len(), y.len());
            return Err(Error::usage(what, "give one value for each time, NaN where there is none"));
        }
        if u32::try_from(t.len()).is_err() {
            return Err(Error::usage(format!("{} samples", t.len()), "give fewer than 2^32 at a time"));
        }
        let mut last = f64::NEG_INFINITY;
        for (index, &time) in t.iter().enumerate().filter(|(i, time)| time.is_finite() && y[*i].is_finite()) {
            if time <= last {
                let what = format!("the time at index {index}, {time}, does not lie after the one before it, {last}");
                return Err(Error::usage(what, "sort the samples by time and leave repeated times out"));
            }
            last = time;
        }
        Ok(Self::new(t, y))
    }

    /// The same samples, owned; none when every row is present, in which case there is nothing to keep but the
    /// interval.
    #[must_use]
    pub fn kept(self) -> Option<Series<'static>> {
        let rows = self.rows?.into_owned();
        let (t, y) = (self.t.into_owned(), self.y.into_owned());
        Some(Series { rows: Some(Cow::Owned(rows)), t: Cow::Owned(t), y: Cow::Owned(y), interval: self.interval })
    }

    /// The same samples, owned.
    #[must_use]
    pub fn into_owned(self) -> Series<'static> {
        let rows = self.rows.map(|rows| Cow::Owned(rows.into_owned()));
        let (t, y) = (Cow::Owned(self.t.into_owned()), Cow::Owned(self.y.into_owned()));
        Series { rows, t, y, interval: self.interval }
    }

    /// The samples of two slices that are finite throughout, whose nominal interval is known.
    #[must_use]
    #[inline]
    pub fn whole(t: &'a [f64], y: &'a [f64], interval: f64) -> Self {
        let n = t.len().min(y.len());
        Self { rows: None, t: Cow::Borrowed(&t[..n]), y: Cow::Borrowed(&y[..n]), interval }
    }

    /// The same samples, borrowed.
    #[must_use]
    #[inline]
    pub fn borrowed(&self) -> Series<'_> {
        let rows = self.rows.as_deref().map(Cow::Borrowed);
        Series { rows, t: Cow::Borrowed(&self.t), y: Cow::Borrowed(&self.y), interval: self.interval }
    }

    /// The samples at `positions` (ascending; none: all of them), with the values of `y`, one for each sample of this
    /// series, where it is given. Samples that are left out count as missing.
    #[must_use]
    pub fn seen(&'a self, positions: Option<&[u32]>, y: Option<&'a [f64]>) -> Series<'a> {
        let y = y.unwrap_or(&self.y);
        let Some(positions) = positions else {
            let rows = self.rows.as_ref().map(|rows| Cow::Borrowed(rows.as_ref()));
            return Series { rows, t: Cow::Borrowed(&self.t), y: Cow::Borrowed(y), interval: self.interval };
        };
        #[expect(clippy::cast_possible_truncation, reason = "the loader refuses files of 2^32 rows and more")]
        let rows = positions.iter().map(|&p| self.row(p as usize) as u32).collect();
        let t: Vec<f64> = positions.iter().map(|&p| self.t[p as usize]).collect();
        let y = positions.iter().map(|&p| y[p as usize]).collect();
        let interval = nominal_interval(&t);
        Series { rows: Some(Cow::Owned(rows)), t: Cow::Owned(t), y: Cow::Owned(y), interval }
    }

    /// How many samples are present.
    #[must_use]
    #[inline]
    pub fn len(&self) -> usize {
        self.t.len()
    }

    /// True when no sample is present.
    #[must_use]
    #[inline]
    pub fn is_empty(&self) -> bool {
        self.t.is_empty()
    }

    /// Row (from 0) of the sample at `position`.
    #[must_use]
    #[inline]
    pub fn row(&self, position: usize) -> usize {
        self.rows.as_ref().map_or(position, |rows| rows[position] as usize)
    }

    /// Row (from 0) of the sample at `position`, if there is such a sample.
    #[must_use]
    #[inline]
    pub fn row_of(&self, position: usize) -> Option<usize> {
        (position < self.len()).then(|| self.row(position))
    }

    /// Position of the sample of `row` (from 0), if that row is present.
    #[must_use]
    #[inline]
    pub fn position(&self, row: usize) -> Option<usize> {
        match &self.rows {
            None => (row < self.len()).then_some(row),
            Some(rows) => {
                let row = u32::try_from(row).ok()?;
                // The newest row may stand first.
                let newest_first = rows.first() > rows.last();
                let order = |r: &u32| if newest_first { row.cmp(r) } else { r.cmp(&row) };
                rows.binary_search_by(order).ok()
            }
        }
    }

    /// Where a sample at time `t` would stand: how many samples lie before it.
    #[must_use]
    #[inline]
    pub fn before(&self, t: f64) -> usize {
        self.t.partition_point(|x| *x < t)
    }

    /// The longest step in seconds in which at most `max_gap` samples are lost; infinite for none.
    #[must_use]
    #[expect(clippy::cast_precision_loss, reason = "counts are far below 2^53")]
    pub fn longest_step(&self, max_gap: Option<usize>) -> f64 {
        max_gap.map_or(f64::INFINITY, |most| (most as f64 + 1.5 - ROUNDING) * self.interval)
    }

    /// Samples lost between the one at `position` and the one before it; 0 for the first.
    #[must_use]
    #[inline]
    pub fn lost_before(&self, position: usize) -> usize {
        if position == 0 { 0 } else { lost_samples(self.t[position] - self.t[position - 1], self.interval) }
    }

    /// Positions inside `range`, but not its first, before which more than `most` samples are lost, ascending.
    ///
    /// # Errors
    /// What `check` gives, which is asked before each piece of work.
    pub fn losses<E: Send>(
        &self,
        range: Range<usize>,
        most: usize,
        check: &(impl Fn() -> Result<(), E> + Sync),
    ) -> Result<Vec<usize>, E> {
        let steps = self.t.get(range.clone()).unwrap_or_default();
        let piece = |chunk: usize| {
            check()?;
            let begin = chunk * CHUNK;
            let t = &steps[begin..(begin + CHUNK + 1).min(steps.len())];
            // Whether there is one is asked of all first, without a branch: in most pieces there is none.
            let lost = |w: &[f64]| lost_samples(w[1] - w[0], self.interval) > most;
            if !t.windows(2).fold(false, |any, w| any | lost(w)) {
                return Ok(Vec::new());
            }
            let at = (range.start + begin + 1..).zip(t.windows(2));
            Ok(at.filter(|(_, w)| lost(w)).map(|(position, _)| position).collect())
        };
        let pieces = (0..steps.len().saturating_sub(1).div_ceil(CHUNK)).into_par_iter();
        Ok(pieces.map(piece).collect::<Result<Vec<Vec<usize>>, E>>()?.concat())
    }

    /// The stretches between cuts: a cut lies wherever more than `max_gap` samples are lost in a row (none: never).
    #[must_use]
    pub fn segments(&self, max_gap: Option<usize>) -> Vec<Range<usize>> {
        let Ok(segments) = self.segments_unless(max_gap, &|| Ok::<(), Infallible>(()));
        segments
    }

    /// [`Series::segments`] that `check` may end.
    ///
    /// # Errors
    /// What `check` gives, which is asked before each piece of work.
    pub fn segments_unless<E: Send>(
        &self,
        max_gap: Option<usize>,
        check: &(impl Fn() -> Result<(), E> + Sync),
    ) -> Result<Vec<Range<usize>>, E> {
        let cuts = max_gap.map(|max_gap| self.losses(0..self.len(), max_gap, check)).transpose()?;
        let mut segments = Vec::new();
        let mut start = 0;
        for cut in cuts.unwrap_or_default() {
            segments.push(start..cut);
            start = cut;
        }
        if start < self.len() {
            segments.push(start..self.len());
        }
        Ok(segments)
    }
}

/// Keeps a tie a tie when the times of a file are rounded, in nominal intervals.
const ROUNDING: f64 = 1e-6;

/// Samples lost in a step of `dt` seconds at a nominal interval of `interval` seconds.
#[must_use]
#[inline]
pub fn lost_samples(dt: f64, interval: f64) -> usize {
    // The usual step needs no division to show that it has lost nothing.
    if dt < 1.49 * interval {
        return 0;
    }
    let steps = dt / interval + 0.5 + ROUNDING;
    // A cast from float rounds down, saturates, and takes NaN (fewer than two samples) to 0.
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "saturates as wanted")]
    let steps = steps as usize;
    steps.saturating_sub(1)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn missing_samples_are_left_out_and_found_again() {
        let t = [0.0, 1.0, f64::NAN, 3.0, 4.0];
        let y = [5.0, f64::NAN, 7.0, 8.0, 9.0];
        let s = Series::new(&t, &y);
        assert_eq!((s.t.as_ref(), s.y.as_ref()), (&[0.0, 3.0, 4.0][..], &[5.0, 8.0, 9.0][..]));
        assert_eq!((s.row(1), s.position(3), s.position(2)), (3, Some(1), None));
    }

    #[test]
    fn samples_that_are_left_out_are_missing_and_values_can_be_others() {
        let t = [0.0, 1.0, 2.0, f64::NAN, 4.0, 5.0];
        let y = [5.0, 6.0, 7.0, 7.5, 8.0, 9.0];
        let whole = Series::new(&t, &y);
        let part = whole.seen(Some(&[0, 1, 3]), None);
        assert_eq!((part.t.as_ref(), part.y.as_ref()), (&[0.0, 1.0, 4.0][..], &[5.0, 6.0, 8.0][..]));
        assert_eq!((part.row(2), part.position(2), part.interval), (4, None, 2.0));
        let others = [1.0; 5];
        let all = whole.seen(None, Some(&others));
        assert_eq!((all.y.as_ref(), all.row(4), all.interval), (&others[..], 5, whole.interval));
    }

    #[test]
    fn a_cut_lies_where_more_than_max_gap_samples_are_lost() {
        let t = [0.0, 1.0, 2.0, 3.0, 6.0, 7.0, 8.0, 12.5];
        let y = [0.0; 8];
        let s = Series::new(&t, &y);
        assert_eq!((s.interval, s.lost_before(4), s.lost_before(7)), (1.0, 2, 4));
        assert_eq!(s.segments(Some(2)), [0..7, 7..8]);
        assert_eq!(s.segments(Some(1)), [0..4, 4..7, 7..8]);
        assert_eq!(s.segments(None).as_slice(), std::slice::from_ref(&(0..8)));
    }

    #[test]
    fn cuts_are_found_where_pieces_meet_as_anywhere() {
        let gaps = [1, 777, CHUNK - 1, CHUNK, CHUNK + 1, 2 * CHUNK, 40_000 - 1];
        let mut t = Vec::new();
        let mut now = 0.0;
        for i in 0..40_000 {
            now += if gaps.contains(&i) { 9.0 } else { 1.0 };
            t.push(now);
        }
        let y = vec![0.0; t.len()];
        let s = Series::new(&t, &y);
        let losses = |range| s.losses(range, 5, &|| Ok::<(), Infallible>(())).unwrap();
        assert_eq!(losses(0..t.len()), gaps);
        assert_eq!(losses(777..CHUNK + 1), [CHUNK - 1, CHUNK]);
        assert_eq!(s.segments(Some(5)).len(), gaps.len() + 1);
    }

    #[test]
    fn the_longest_step_loses_no_more_than_it_may() {
        let t = [0.0, 0.25, 0.5, 0.75];
        let s = Series::new(&t, &t);
        for most in [0, 1, 5, 1000] {
            let longest = s.longest_step(Some(most));
            assert_eq!(lost_samples(longest * (1.0 - 1e-9), s.interval), most);
            assert_eq!(lost_samples(longest * (1.0 + 1e-9), s.interval), most + 1);
        }
        assert_eq!(s.longest_step(None), f64::INFINITY);
    }

    #[test]
    fn a_step_of_one_and_a_half_intervals_has_lost_one_sample_even_when_rounded() {
        assert_eq!(lost_samples(1.5, 1.0), 1);
        assert_eq!(lost_samples(1.499_999_9, 1.0), 1);
        assert_eq!(lost_samples(1.4, 1.0), 0);
        assert_eq!(lost_samples(1.0, f64::NAN), 0);
    }
}
