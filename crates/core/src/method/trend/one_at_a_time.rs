//! Tests that remove the most deviant residual, one at a time: Romanovsky, Grubbs, generalised ESD.

use std::ops::Range;
use std::sync::OnceLock;

use super::{Criterion, Limit, Pass, Survivors};
use crate::math::extremes::Extremes;
use crate::math::moments::Moments;
use crate::math::pieces;
use crate::math::student::student_upper;
use crate::method::exceeds;
use crate::stop::{Stop, Stopped};

/// What `alpha` is the chance of.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(in crate::method) enum Chance {
    /// A false alarm among all residuals of clean data.
    Block,
    /// The same on one side alone: that the largest is one; and likewise the smallest (the tables of Grubbs that
    /// textbooks print).
    OneSide,
    /// A false alarm for each residual.
    Sample,
}

/// Critical values of `max |v - mean| / s` among `n` residuals (Grubbs 1969, eq. of section 2 of `docs/methods.md`).
#[derive(Debug)]
pub(in crate::method) struct Critical {
    alpha: f64,
    chance: Chance,
    /// Those of small samples, which blocks ask for again and again.
    known: Vec<OnceLock<f64>>,
}

impl Critical {
    /// For one false alarm in `1 / alpha` of what `chance` says.
    pub(in crate::method) fn new(alpha: f64, chance: Chance) -> Self {
        Self { alpha, chance, known: (0..2048).map(|_| OnceLock::new()).collect() }
    }

    /// `G = (n - 1) / sqrt(n) * sqrt(t^2 / (n - 2 + t^2))` with t the upper quantile of Student's distribution with
    /// `n - 2` degrees of freedom at `alpha / (2 n)`, at `alpha / n` on one side, or at `alpha / 2` for each sample:
    /// then the test is Romanovsky's, rearranged. `n` is at least 3.
    pub(in crate::method) fn at(&self, n: usize) -> f64 {
        self.known.get(n).map_or_else(|| self.work_out(n), |known| *known.get_or_init(|| self.work_out(n)))
    }

    #[expect(clippy::cast_precision_loss, reason = "counts are far below 2^53")]
    fn work_out(&self, n: usize) -> f64 {
        let n = n as f64;
        let p = match self.chance {
            Chance::Block => self.alpha / (2.0 * n),
            Chance::OneSide => self.alpha / n,
            Chance::Sample => self.alpha / 2.0,
        };
        let t = student_upper(p, n - 2.0);
        (n - 1.0) / n.sqrt() * (t * t / (n - 2.0 + t * t)).sqrt()
    }
}

/// Residuals taken out from the most deviant on, with mean and deviation of those left.
#[derive(Debug)]
pub(in crate::method) struct Removals<'a> {
    residual: &'a [f64],
    extremes: Extremes<'a>,
    /// Taken out so far, in order.
    pub(in crate::method) taken: Vec<usize>,
    /// Of those left.
    pub(in crate::method) left: Moments,
    /// Sum of squares when the moments were last summed from scratch.
    squares: f64,
}

impl<'a> Removals<'a> {
    /// None taken out yet.
    pub(in crate::method) fn new(residual: &'a [f64], stop: &Stop) -> Result<Self, Stopped> {
        let left = Moments::of_long(residual, &|| stop.check())?;
        Ok(Self { residual, extremes: Extremes::new(residual), taken: Vec::new(), left, squares: left.squares })
    }

    /// How many are left.
    pub(in crate::method) fn len(&self) -> usize {
        self.residual.len() - self.taken.len()
    }

    /// Takes out the most deviant and says how far it lies from the mean of those left and itself.
    pub(in crate::method) fn take(&mut self, stop: &Stop) -> Result<Option<f64>, Stopped> {
        let (left, check) = (self.left, || stop.check());
        let Some(i) = self.extremes.next(left.mean, || left.deviation(), &check)? else { return Ok(None) };
        let d = self.residual[i] - self.left.mean;
        self.taken.push(i);
        let n = self.left.count;
        self.left.count -= 1.0;
        self.left.mean -= d / (n - 1.0);
        self.left.squares -= d * d * (n / (n - 1.0));
        // What is left of a sum that a few huge values made up has lost its digits.
        if self.left.squares < 1e-4 * self.squares {
            let mut kept = vec![true; self.residual.len()];
            self.taken.iter().for_each(|&i| kept[i] = false);
            let rest = |piece: Range<usize>| piece.filter(|&i| kept[i]).map(|i| self.residual[i]).collect::<Vec<f64>>();
            let rest = pieces::map(kept.len(), &check, rest)?;
            let mut left = Vec::with_capacity(kept.len());
            rest.iter().try_for_each(|part| pieces::extend(&mut left, part, &check))?;
            self.left = Moments::of_long(&left, &check)?;
            self.squares = self.left.squares;
        }
        Ok(Some(d.abs()))
    }
}

/// Removes the most deviant as long as it exceeds the critical value; stops at the first that does not.
#[derive(Debug)]
pub(in crate::method) struct OneAtATime(pub(in crate::method) Critical);

impl Criterion for OneAtATime {
    fn needed(&self, n: usize) -> f64 {
        self.0.at(n)
    }

    fn pass(&self, survivors: &Survivors<'_>, stop: &Stop) -> Result<Pass, Stopped> {
        let mut removals = Removals::new(survivors.residual, stop)?;
        let mut last = None;
        while removals.len() >= 3 {
            stop.check_at(removals.taken.len())?;
            let mean = removals.left.mean;
            let scale = survivors.bounded(removals.left.deviation());
            let tolerance = self.0.at(removals.len()) * scale;
            last = Some(Limit { mean, scale, tolerance });
            let deviation = removals.take(stop)?;
            if !deviation.is_some_and(|d| tolerance > 0.0 && exceeds(d, tolerance)) {
                // It passed: it stays.
                removals.taken.pop();
                break;
            }
        }
        Ok(Pass { flagged: removals.taken, groups: vec![last] })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn critical_values_grow_with_the_sample_and_so_bracket_each_other() {
        for alpha in [0.5, 0.05, 0.01, 1e-9] {
            let critical = Critical::new(alpha, Chance::Block);
            let values: Vec<f64> = (3..3000).map(|n| critical.at(n)).collect();
            assert!(values.windows(2).all(|w| w[1] >= w[0] * (1.0 - 1e-12)), "{alpha}");
        }
    }

    #[test]
    fn what_is_left_has_the_moments_of_the_definition() {
        let mut v: Vec<f64> = (0..400).map(|i| (f64::from(i) * 12.9898).sin()).collect();
        (v[7], v[90], v[91]) = (1e15, -1e12, 4e6);
        let mut removals = Removals::new(&v, &Stop::never()).unwrap();
        for _ in 0..200 {
            removals.take(&Stop::never()).unwrap();
            let rest: Vec<f64> = (0..400).filter(|i| !removals.taken.contains(i)).map(|i| v[i]).collect();
            let plain = Moments::of(&rest);
            assert!((removals.left.squares / plain.squares - 1.0).abs() < 1e-9, "{}", removals.taken.len());
        }
        assert_eq!(removals.taken[..3], [7, 90, 91]);
    }
}
