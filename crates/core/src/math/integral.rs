//! The integral of a sampled rate, linear between its samples.

use super::pieces::{Check, PIECE};

/// The integral of `rate` from its first sample to each time of `at`, as a sum of two parts of which the second
/// holds what rounding took from the first; NaN for a time outside the samples of the rate. All times increase.
///
/// # Errors
/// What `check` gives, which is asked before each piece of work.
pub fn to_times<E>(t: &[f64], rate: &[f64], at: &[f64], check: &impl Check<E>) -> Result<Vec<[f64; 2]>, E> {
    let mut result = Vec::with_capacity(at.len());
    let mut sum = Compensated::default();
    // The last sample of the rate at or before the time asked for; `sum` is the integral up to it.
    let mut i = 0;
    for (n, &x) in at.iter().enumerate() {
        if n.is_multiple_of(PIECE) {
            check()?;
        }
        if t.first().is_none_or(|&first| x < first) || t.last().is_none_or(|&last| x > last) {
            result.push([f64::NAN; 2]);
            continue;
        }
        while i + 1 < t.len() && t[i + 1] <= x {
            sum.add(0.5 * (rate[i] + rate[i + 1]) * (t[i + 1] - t[i]));
            i += 1;
            if i.is_multiple_of(PIECE) {
                check()?;
            }
        }
        let mut here = sum;
        if x > t[i] {
            let part = x - t[i];
            let slope = (rate[i + 1] - rate[i]) / (t[i + 1] - t[i]);
            here.add(part * (rate[i] + 0.5 * slope * part));
        }
        result.push([here.sum, here.rest]);
    }
    Ok(result)
}

/// A sum that keeps what rounding takes from it (Neumaier), so that a long integral does not drift.
#[derive(Debug, Clone, Copy, Default)]
struct Compensated {
    sum: f64,
    rest: f64,
}

impl Compensated {
    #[inline]
    fn add(&mut self, x: f64) {
        let sum = self.sum + x;
        self.rest += if self.sum.abs() >= x.abs() { (self.sum - sum) + x } else { (x - sum) + self.sum };
        self.sum = sum;
    }
}

#[cfg(test)]
mod tests {
    use super::super::pieces::{certain, to_the_end};
    use super::*;

    #[test]
    fn a_linear_rate_is_integrated_exactly_between_and_on_its_samples_and_nowhere_else() {
        let t = [1.0, 2.0, 4.0];
        let rate = t.map(|t| 3.0 * t);
        let got = certain(to_times(&t, &rate, &[0.9, 1.0, 1.5, 2.0, 3.0, 4.0, 4.1], &to_the_end));
        let want = |x: f64| 1.5 * (x * x - 1.0);
        for (x, got) in [1.0, 1.5, 2.0, 3.0, 4.0].iter().zip(&got[1..6]) {
            assert!((got[0] + got[1] - want(*x)).abs() < 1e-14);
        }
        assert!(got[0][0].is_nan() && got[6][0].is_nan());
    }

    #[test]
    fn a_long_integral_does_not_drift() {
        // 0.1 summed a million times: the plain sum is off by 1e-6.
        let n = 1_000_000;
        let t: Vec<f64> = (0..=n).map(f64::from).collect();
        let got = certain(to_times(&t, &vec![0.1; t.len()], &[f64::from(n)], &to_the_end));
        assert!((got[0][0] + got[0][1] - 0.1 * f64::from(n)).abs() < 1e-10);
    }
}
