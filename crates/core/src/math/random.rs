//! Random numbers that are the same everywhere.

use rand_pcg::Pcg64Mcg;
use rand_pcg::rand_core::{Rng, SeedableRng};

/// A stream of random numbers from a seed: PCG-64 (MCG), whose output is fixed for ever.
#[derive(Debug, Clone)]
pub struct Random(Pcg64Mcg);

impl Random {
    /// The stream of `seed`.
    #[must_use]
    pub fn new(seed: u64) -> Self {
        Self(Pcg64Mcg::seed_from_u64(seed))
    }

    /// Uniform in [0, 1), with 53 bits.
    pub fn uniform(&mut self) -> f64 {
        #[expect(clippy::cast_precision_loss, reason = "53 bits fit a double exactly")]
        let mantissa = (self.0.next_u64() >> 11) as f64;
        mantissa / 9_007_199_254_740_992.0
    }

    /// Uniform in `low .. high`.
    pub fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.uniform()
    }

    /// A whole number in `low ..= high`.
    pub fn whole(&mut self, low: usize, high: usize) -> usize {
        #[expect(
            clippy::cast_precision_loss,
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "small non-negative numbers"
        )]
        let offset = (self.uniform() * (high - low + 1) as f64) as usize;
        low + offset
    }

    /// -1 or 1.
    pub fn sign(&mut self) -> f64 {
        if self.uniform() < 0.5 { -1.0 } else { 1.0 }
    }

    /// Normal with mean 0 and deviation 1, by the polar method of Marsaglia, with a logarithm of its own: that of
    /// the platform may differ in its last bit from machine to machine.
    pub fn normal(&mut self) -> f64 {
        loop {
            let (a, b) = (self.between(-1.0, 1.0), self.between(-1.0, 1.0));
            let r = a * a + b * b;
            if r > 0.0 && r < 1.0 {
                return a * (-2.0 * logarithm(r) / r).sqrt();
            }
        }
    }
}

/// The natural logarithm of a positive normal number, from the four operations alone: with `x = 2^e m` and
/// `s = (m - 1) / (m + 1)`, `ln x = e ln 2 + 2 (s + s^3/3 + s^5/5 + ..)`. For m within sqrt(1/2) .. sqrt(2) the
/// thirteenth term is below 1e-18 of the first.
fn logarithm(x: f64) -> f64 {
    const MANTISSA: u64 = (1 << 52) - 1;
    let bits = x.to_bits();
    #[expect(clippy::cast_precision_loss, reason = "an exponent of eleven bits")]
    let mut exponent = (bits >> 52) as f64 - 1023.0;
    let mut m = f64::from_bits((bits & MANTISSA) | 1.0_f64.to_bits());
    if m > std::f64::consts::SQRT_2 {
        m /= 2.0;
        exponent += 1.0;
    }
    let s = (m - 1.0) / (m + 1.0);
    let series = (0..12).rev().fold(0.0, |sum, k| sum * s * s + 1.0 / f64::from(2 * k + 1));
    exponent * std::f64::consts::LN_2 + 2.0 * s * series
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_logarithm_is_that_of_the_platform_to_its_last_digits() {
        let mut random = Random::new(1);
        for x in (0..2000).map(|_| random.uniform()).chain([1e-300, 0.5, 0.707, 0.7072, 1.0, 1.5, 7e8]) {
            let (ours, theirs) = (logarithm(x), x.ln());
            assert!((ours - theirs).abs() <= 4e-16 * theirs.abs().max(1.0), "{x}: {ours} {theirs}");
        }
    }

    #[test]
    fn normal_numbers_have_the_moments_of_the_normal_distribution() {
        let mut random = Random::new(7);
        let x: Vec<f64> = (0..100_000).map(|_| random.normal()).collect();
        let n = x.len() as f64;
        let moment = |p: i32| x.iter().map(|x| x.powi(p)).sum::<f64>() / n;
        // Four standard errors of each: sqrt(var / n) * 4.
        assert!(moment(1).abs() < 0.0127 && (moment(2) - 1.0).abs() < 0.018 && (moment(4) - 3.0).abs() < 0.124);
        assert!((0..1000).all(|_| (2..=5).contains(&random.whole(2, 5))));
    }
}
