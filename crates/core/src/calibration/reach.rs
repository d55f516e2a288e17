//! How far the noise of a whole record reaches, and where its values usually lie.

use super::quantile_of;
use crate::math::order::median_in_place;

/// The quantiles of the residuals that show how their tail falls off: 85 % and 97 %.
const QUANTILES: [f64; 2] = [0.85, 0.97];

/// This many samples of the record are expected beyond the reach. The position of a single one would be chance.
const BEYOND: f64 = 3.0;

/// Exponents of the tail: from a little heavier than exponential (1) to that of a normal deviate between the two
/// quantiles. A tail that looks heavier still is noise of two
/// states, and the local limits follow those.
const EXPONENT: [f64; 2] = [0.85, 1.498];

/// Values are usual within this quantile of the distances from their median …
const USUAL: f64 = 0.95;

/// … and unusual beyond this multiple of that distance.
const UNUSUAL: f64 = 2.0;

/// What a record is as a whole, whatever the state of a part of it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Whole {
    /// The median of the values, in channel units.
    pub middle: f64,
    /// 95 % of the values lie within this distance of it.
    pub spread: f64,
    /// The residual that about three samples of such noise exceed, in channel units.
    pub reach: f64,
}

impl Whole {
    pub(super) fn of(y: &[f64], reach: f64) -> Self {
        let middle = median_in_place(&mut y.to_vec());
        let mut distances: Vec<f64> = y.iter().map(|y| (y - middle).abs()).collect();
        Self { middle, spread: super::quantile(&mut distances, USUAL), reach }
    }

    /// The share of `limit` that counts for the doubt about a sample of this value, at most `otherwise`: of a value that
    /// the record hardly takes elsewhere no more than the reach, however rough the record is around it.
    pub(super) fn doubtful_share(&self, value: f64, limit: f64, otherwise: f64) -> f64 {
        let unusual = (value - self.middle).abs() > UNUSUAL * self.spread;
        if unusual && limit > 0.0 && limit.is_finite() { otherwise.min(self.reach / limit) } else { otherwise }
    }
}

/// The residual that about three of the unmasked samples would exceed if the tail falls off as it does between two
/// quantiles of `r`, as exp(-x^c): the more samples, the farther noise reaches. None where the nearer quantile is 0, as in
/// records that hardly move: such residuals have no tail to go by.
pub(super) fn reach(r: &[f64], masked: &[bool]) -> Option<f64> {
    let [near, far] = QUANTILES.map(|q| quantile_of(r, masked, q));
    let [log_near, log_far] = QUANTILES.map(|q| -(1.0 - q).ln());
    let exponent = ((log_far / log_near).ln() / (far / near).ln()).clamp(EXPONENT[0], EXPONENT[1]);
    let samples = super::threshold::count(masked.iter().filter(|m| !**m).count());
    let farther = ((samples / BEYOND).ln() / log_near).max(1.0).powf(exponent.recip());
    (near > 0.0).then_some(near * farther)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// `n` residuals at even shares of a distribution.
    fn residuals(n: u32, quantile: impl Fn(f64) -> f64) -> Vec<f64> {
        (0..n).map(|i| quantile((f64::from(i) + 0.5) / f64::from(n))).collect()
    }

    #[test]
    fn exponential_tails_reach_as_far_as_their_logarithm() {
        // exp(-x) = 3 / 20,000.
        let r = residuals(20_000, |share| -(1.0 - share).ln());
        let found = reach(&r, &vec![false; r.len()]).unwrap();
        assert!((found / (20_000.0_f64 / 3.0).ln() - 1.0).abs() < 0.005, "{found}");
    }

    #[test]
    fn even_residuals_reach_farther_only_by_the_normal_exponent_and_masked_ones_do_not_count() {
        let mut r = residuals(1000, |share| share);
        let mut masked = vec![false; 1000];
        // 0.85 (ln (1000 / 3) / ln (1 / 0.15))^(1 / 1.498).
        let wanted = 0.85 * ((1000.0_f64 / 3.0).ln() / -0.15_f64.ln()).powf(1.0 / 1.498);
        assert!((reach(&r, &masked).unwrap() / wanted - 1.0).abs() < 0.005);
        r.extend([50.0; 100]);
        masked.extend([true; 100]);
        assert!((reach(&r, &masked).unwrap() / wanted - 1.0).abs() < 0.005);
        let held: Vec<f64> = residuals(100, |share| if share < 0.9 { 0.0 } else { 1.0 });
        assert_eq!(reach(&held, &[false; 100]), None);
    }

    #[test]
    fn only_an_unusual_value_is_doubtful_where_it_is_rough() {
        let values: Vec<f64> = (0..1000).map(|i| f64::from(i % 21 - 10)).collect();
        let whole = Whole::of(&values, 5.0);
        assert_eq!((whole.middle, whole.spread), (0.0, 10.0));
        assert_eq!(whole.doubtful_share(19.0, 60.0, 0.5), 0.5);
        assert_eq!(whole.doubtful_share(-21.0, 50.0, 0.5), 0.1);
        assert_eq!(whole.doubtful_share(-21.0, 3.0, 0.5), 0.5);
        // Where nothing is known of the noise, nothing is doubtful.
        assert_eq!(whole.doubtful_share(-21.0, f64::INFINITY, 0.5), 0.5);
    }
}
