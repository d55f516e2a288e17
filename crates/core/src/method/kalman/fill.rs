//! What a patch is filled with before the filter runs again.

use crate::math::polyfit::Polynomial;
use crate::math::spline::Natural;

/// A curve through accepted samples on both sides.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Fill {
    /// The least-squares cubic through 12 on each side, at least 4.
    Polynomial,
    /// The natural cubic spline through 8 on each side, at least 1.
    Spline,
}

impl Fill {
    /// A value for each sample of `run` (ascending positions); NaN when a side has too few accepted samples.
    pub(super) fn values(self, t: &[f64], y: &[f64], accepted: impl Fn(usize) -> bool, run: &[usize]) -> Vec<f64> {
        let none = vec![f64::NAN; run.len()];
        let (Some(&first), Some(&last)) = (run.first(), run.last()) else { return none };
        let (most, least) = match self {
            Self::Polynomial => (12, 4),
            Self::Spline => (8, 1),
        };
        let mut at: Vec<usize> = (0..first).rev().filter(|&i| accepted(i)).take(most).collect();
        let before = at.len();
        at.reverse();
        at.extend((last + 1..y.len()).filter(|&i| accepted(i)).take(most));
        if before < least || at.len() - before < least {
            return none;
        }
        let (times, values): (Vec<f64>, Vec<f64>) = at.iter().map(|&i| (t[i], y[i])).unzip();
        match self {
            Self::Polynomial => {
                let fit = Polynomial::fit(&times, &values, 3);
                run.iter().map(|&i| fit.at(t[i])).collect()
            }
            Self::Spline => {
                let spline = Natural::through(&times, &values);
                run.iter().map(|&i| spline.at(t[i])).collect()
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_cubic_is_continued_and_too_few_samples_fill_nothing() {
        let t: Vec<f64> = (0..30).map(|i| 1e6 + f64::from(i) * 0.5).collect();
        let y: Vec<f64> = t
            .iter()
            .map(|t| {
                let x = t - 1e6;
                2.0 - x + 0.1 * x * x - 0.01 * x * x * x
            })
            .collect();
        let run: Vec<usize> = (4..12).collect();
        let accepted = |i: usize| !(4..12).contains(&i);
        let got = Fill::Polynomial.values(&t, &y, accepted, &run);
        assert!(run.iter().zip(&got).all(|(&i, v)| (v - y[i]).abs() < 1e-9));
        let fewer = |i: usize| i != 0 && accepted(i);
        assert!(Fill::Polynomial.values(&t, &y, fewer, &run).iter().all(|v| v.is_nan()), "three on the left");
        assert!(Fill::Spline.values(&t, &y, fewer, &run).iter().all(|v| v.is_finite()));
    }

    #[test]
    fn a_side_of_four_is_enough_after_the_run_as_before_it() {
        let t: Vec<f64> = (0..30).map(f64::from).collect();
        let run: Vec<usize> = (18..26).collect();
        let accepted = |i: usize| !(18..26).contains(&i);
        assert!(Fill::Polynomial.values(&t, &t, accepted, &run).iter().all(|v| v.is_finite()), "26, 27, 28, 29");
        let fewer = |i: usize| i != 29 && accepted(i);
        assert!(Fill::Polynomial.values(&t, &t, fewer, &run).iter().all(|v| v.is_nan()), "three on the right");
    }
}
