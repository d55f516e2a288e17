//! The record on which methods are measured.

use wildpoint::experiment::Random;

/// A parabola with unit noise and 1 % outliers, sampled every tenth of a second, and its measured rate.
pub(crate) struct Record {
    /// Times, s.
    pub(crate) t: Vec<f64>,
    /// Values.
    pub(crate) y: Vec<f64>,
    /// Rates of the values, 1/s.
    pub(crate) rate: Vec<f64>,
}

impl Record {
    /// `n` samples.
    pub(crate) fn new(n: usize, seed: u64) -> Self {
        let mut random = Random::new(seed);
        let t: Vec<f64> = (0..n).map(|i| i as f64 * 0.1).collect();
        let end = n as f64 * 0.1;
        let y = t.iter().map(|t| {
            let spike = if random.uniform() < 0.01 { random.sign() * random.between(8.0, 40.0) } else { 0.0 };
            200.0 + 3.0 * t - 1.5 * t * t / end + random.normal() + spike
        });
        let y = y.collect();
        let rate = t.iter().map(|t| 3.0 - 3.0 * t / end + 0.1 * random.normal()).collect();
        Self { t, y, rate }
    }
}
