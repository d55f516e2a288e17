//! Filtered values: what a method's model makes of the track once it is settled which samples are wild.

use super::{Damaged, Segment};
use crate::stop::{Stop, Stopped};

mod expected;
mod fits;
mod follow;

pub(super) use expected::Expected;
pub(super) use fits::{Fit, fits};
pub(super) use follow::{Course, Entry, Estimator, follow};

/// A method's model of the track, run with each sample taken in.
pub trait Filter: Sync {
    /// What the values are, in a few words: `state of the filter`.
    fn about(&self) -> &'static str;

    /// One entry for each sample of the segment.
    ///
    /// # Errors
    /// [`Stopped`] as soon as nobody waits for the result any more.
    fn run(&self, settled: &Settled<'_>, stop: &Stop) -> Result<Filtered, Stopped>;
}

/// A segment in which it is settled what is wild.
#[derive(Debug, Clone, Copy)]
pub struct Settled<'a> {
    /// The segment, the settings, what the method said, and the outliers after the analyst's decisions.
    pub damaged: Damaged<'a>,
    /// What the method's own repair puts in place of each of the outliers; NaN where it puts nothing.
    pub own: &'a [f64],
    /// Positions of the samples at which the model was started again, ascending.
    pub restarts: &'a [usize],
}

/// Filtered values, one entry for each sample.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Filtered {
    /// The values, in channel units; NaN where the model has none.
    pub value: Vec<f64>,
    /// Their standard deviations as the model has them, in channel units; NaN where it has none.
    pub deviation: Vec<f64>,
}

impl Filtered {
    /// Nothing for `n` samples.
    #[must_use]
    pub fn none(n: usize) -> Self {
        Self { value: vec![f64::NAN; n], deviation: vec![f64::NAN; n] }
    }

    /// Values without standard deviations.
    pub(super) fn of_values(value: Vec<f64>) -> Self {
        Self { deviation: vec![f64::NAN; value.len()], value }
    }
}

impl Settled<'_> {
    /// True for each sample that is not wild.
    pub(super) fn accepted(&self) -> Vec<bool> {
        let mut accepted = vec![true; self.damaged.segment.len()];
        self.damaged.outliers.iter().for_each(|&i| accepted[i] = false);
        accepted
    }

    /// The values with the own repair in place of each wild one; where it puts nothing, the line between the accepted
    /// samples on both sides, and at the ends the nearest of them. None where all are wild.
    pub(super) fn standing(&self) -> Option<Vec<f64>> {
        let Damaged { segment: Segment { t, y, .. }, outliers, .. } = self.damaged;
        let mut standing = y.to_vec();
        outliers.iter().zip(self.own).for_each(|(&i, own)| standing[i] = *own);
        let known = |i: &usize| standing[*i].is_finite();
        let holes: Vec<usize> = outliers.iter().copied().filter(|i| !known(i)).collect();
        let mut values = Vec::with_capacity(holes.len());
        for run in holes.chunk_by(|a, b| a + 1 == *b) {
            let before = run.first().and_then(|first| first.checked_sub(1));
            let after = run.last().map(|last| last + 1).filter(|after| *after < y.len());
            let value = |i: usize| match (before, after) {
                (Some(a), Some(b)) => standing[a] + (standing[b] - standing[a]) * ((t[i] - t[a]) / (t[b] - t[a])),
                (Some(only), None) | (None, Some(only)) => standing[only],
                (None, None) => f64::NAN,
            };
            values.extend(run.iter().map(|&i| value(i)));
        }
        holes.iter().zip(values).for_each(|(&i, value)| standing[i] = value);
        standing.first().is_some_and(|first| first.is_finite()).then_some(standing)
    }
}

#[cfg(test)]
mod tests;
