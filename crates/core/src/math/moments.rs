//! Mean and sum of squares of values, also of those in a sliding window.

use rayon::prelude::*;

use super::pieces::Check;
use super::sliding::Summary;

/// Values in one piece of parallel work.
const CHUNK: usize = 8192;

/// Count, mean and centred sum of squares of some values.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Moments {
    /// How many values.
    pub count: f64,
    /// Their mean; 0 when there are none.
    pub mean: f64,
    /// `sum (x - mean)^2`.
    pub squares: f64,
}

impl Moments {
    /// Takes in one more value (Welford 1962).
    #[inline]
    pub fn push(&mut self, x: f64) {
        self.count += 1.0;
        let d = x - self.mean;
        self.mean += d / self.count;
        self.squares += d * (x - self.mean);
    }

    /// The moments of both sets together (Chan, Golub and LeVeque 1979).
    #[must_use]
    #[inline]
    pub fn merge(&self, other: &Self) -> Self {
        if self.count == 0.0 {
            return *other;
        }
        let count = self.count + other.count;
        let d = other.mean - self.mean;
        let share = other.count / count;
        Self {
            count,
            mean: self.mean + d * share,
            squares: self.squares + other.squares + d * d * (self.count * share),
        }
    }

    /// The moments of these values.
    #[must_use]
    pub fn of(values: &[f64]) -> Self {
        let mut moments = Self::default();
        values.iter().for_each(|&x| moments.push(x));
        moments
    }

    /// The moments of many values: in parallel, in pieces that do not depend on the number of threads.
    ///
    /// # Errors
    /// What `check` gives, which is asked before each piece.
    pub fn of_long<E: Send>(values: &[f64], check: &impl Check<E>) -> Result<Self, E> {
        let piece = |v: &[f64]| {
            let (count, origin) = (v.len() as f64, v[0]);
            let mean = origin + lanes(v, |x| x - origin) / count;
            Self { count, mean, squares: lanes(v, |x| (x - mean) * (x - mean)) }
        };
        let pieces = values.par_chunks(CHUNK).map(|v| check().map(|()| piece(v)));
        let pieces = pieces.collect::<Result<Vec<Self>, E>>()?;
        Ok(pieces.iter().fold(Self::default(), |sum, piece| sum.merge(piece)))
    }

    /// The sample standard deviation: divisor n - 1, NaN for fewer than two values.
    #[must_use]
    #[inline]
    pub fn deviation(&self) -> f64 {
        if self.count < 2.0 { f64::NAN } else { (self.squares.max(0.0) / (self.count - 1.0)).sqrt() }
    }

    /// `sum (x - center)^2` about another centre than the mean.
    #[must_use]
    #[inline]
    pub fn squares_about(&self, center: f64) -> f64 {
        self.squares + self.count * (self.mean - center) * (self.mean - center)
    }
}

/// A sum with eight running at a time, so that the compiler may use vector instructions.
#[inline]
fn lanes(values: &[f64], term: impl Fn(f64) -> f64) -> f64 {
    let mut sums = [0.0; 8];
    let mut eights = values.chunks_exact(8);
    for eight in &mut eights {
        for (sum, &x) in sums.iter_mut().zip(eight) {
            *sum += term(x);
        }
    }
    eights.remainder().iter().map(|&x| term(x)).sum::<f64>() + sums.iter().sum::<f64>()
}

impl Summary for Moments {
    type Item = f64;

    #[inline]
    fn add(&mut self, x: f64) {
        self.push(x);
    }

    #[inline]
    fn joined(&self, other: &Self) -> Self {
        self.merge(other)
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;
    use crate::math::pieces::{certain, to_the_end};
    use crate::math::sliding::Sliding;

    /// Straight from the definition, about an exact centre.
    fn plain(x: &[f64]) -> (f64, f64) {
        let origin = x[0];
        let mean = x.iter().map(|v| v - origin).sum::<f64>() / x.len() as f64;
        (origin + mean, x.iter().map(|v| (v - origin - mean) * (v - origin - mean)).sum())
    }

    proptest! {
        #[test]
        fn it_equals_its_plain_twin(
            x in prop::collection::vec(-9.0..9.0, 1..120), width in 1usize..50, step in 1usize..4,
        ) {
            let mut window = Sliding::<Moments>::default();
            for c in (0..x.len()).step_by(step) {
                let range = c.saturating_sub(width / 2)..(c + width - width / 2).min(x.len());
                window.move_to(&x, range.clone());
                let (mean, squares) = plain(&x[range.clone()]);
                let got = window.get();
                prop_assert!((got.mean - mean).abs() < 1e-12 && (got.squares - squares).abs() < 1e-10);
                prop_assert_eq!(got.count as usize, range.len());
                let about = x[range].iter().map(|v| (v - 1.5) * (v - 1.5)).sum::<f64>();
                prop_assert!((got.squares_about(1.5) - about).abs() < 1e-9);
            }
        }
    }

    #[test]
    fn many_values_have_the_moments_of_the_definition() {
        for n in [1usize, 7, 8, 9, 30_001] {
            let x: Vec<f64> = (0..n).map(|i| 1e9 + (i * 7919 % 1013) as f64 * 1e-3).collect();
            let (mean, squares) = plain(&x);
            let got = certain(Moments::of_long(&x, &to_the_end));
            assert!((got.mean - mean).abs() < 1e-6 && (got.squares - squares).abs() <= 1e-8 * squares);
        }
    }

    #[test]
    fn a_huge_value_leaves_no_trace_and_a_long_run_does_not_drift() {
        let x: Vec<f64> = (0..50_000).map(|i| if i == 40 { 1e15 } else { f64::from(i * 7919 % 13) * 1e-5 }).collect();
        let mut window = Sliding::<Moments>::default();
        for start in 0..x.len() - 21 {
            window.move_to(&x, start..start + 21);
        }
        let (mean, squares) = plain(&x[x.len() - 22..x.len() - 1]);
        let got = window.get();
        assert!((got.mean / mean - 1.0).abs() < 1e-12 && (got.squares / squares - 1.0).abs() < 1e-12);
        window.move_to(&x, 50..71);
        assert!(window.get().squares < 1e-6);
    }
}
