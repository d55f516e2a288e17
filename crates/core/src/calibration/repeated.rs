//! Values that repeat exactly and lie far from the record: sentinels and fill values.
//!
//! Whether a value is far is asked of the different values of the record, each taken once: a third of the samples at
//! -9999 weighs as little as a single one, and fill values of several sizes hide nothing from each other. A limit of
//! the instrument, a zero at rest and the most frequent value of quantised data lie beside their neighbours and are
//! not far.

use std::collections::HashMap;
use std::collections::hash_map::Entry;

/// A value that stands for "no value", as far as the record shows.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Repeated {
    /// The value.
    pub value: f64,
    /// How many samples have it.
    pub count: usize,
    /// True where the record leaves no doubt: a usual fill value that repeats, or one of an absurd size.
    pub certain: bool,
}

/// This many samples show where the record lies; of a longer record blocks are taken.
const LOOK: usize = 65_536;
/// Samples of a block.
const BLOCK: usize = 256;
/// A value this many widths of the record away from it is far.
const FAR: f64 = 5.0;
/// Different values that are needed for quantiles of them.
const ENOUGH: usize = 20;
/// No quantity has values of this size …
const ABSURD: f64 = 1e15;
/// … where those of the record are smaller by this factor.
const ABSURDLY_LARGER: f64 = 1e6;
/// A usual fill value is certain when it comes so often.
const CERTAIN: usize = 3;
/// Any other far value is offered when it comes so often.
const OFTEN: usize = 5;
/// This many different far values are kept; more are no fill values.
const KEPT: usize = 4096;

/// Fill values beside those of nines: the ends of integer types, and what is written for them in data of this field.
const USUAL: [f64; 8] = [32_767.0, -32_768.0, 65_535.0, 2_147_483_647.0, -2_147_483_648.0, -999.25, -99.0, -99.9];

/// The far values of `y` (finite values in the order of the record) that repeat or are usual fill values, the most
/// frequent first. Linear in the number of samples.
#[must_use]
pub fn repeated(y: &[f64]) -> Vec<Repeated> {
    let Some(range) = Range::of(y) else { return Vec::new() };
    let far = far_values(y, &range);
    let mut values: Vec<f64> = far.keys().map(|bits| f64::from_bits(*bits)).collect();
    values.sort_unstable_by(f64::total_cmp);
    let offered = |(i, &value): (usize, &f64)| {
        let count = far.get(&value.to_bits()).copied().unwrap_or(0);
        let absurd = value.abs() >= ABSURD && value.abs() >= ABSURDLY_LARGER * range.size();
        let usual = is_usual(value);
        let near = range.distance(value) / 10.0;
        let apart = |other: Option<&f64>| other.is_none_or(|o| (o - value).abs() > near || is_usual(*o));
        let lonely = apart(i.checked_sub(1).and_then(|i| values.get(i))) && apart(values.get(i + 1));
        let often = count >= OFTEN && lonely && range.different >= ENOUGH;
        let certain = absurd || (usual && count >= CERTAIN && range.different >= CERTAIN);
        (absurd || usual || often).then_some(Repeated { value, count, certain })
    };
    let mut found: Vec<Repeated> = values.iter().enumerate().filter_map(offered).collect();
    found.sort_by_key(|r| std::cmp::Reverse(r.count));
    found
}

/// A value that is written where there is none: three nines or more and nothing else (-9999, 99.99), or one of a short
/// list of others.
#[must_use]
pub fn is_usual(value: f64) -> bool {
    if USUAL.iter().any(|usual| usual.to_bits() == value.to_bits()) {
        return true;
    }
    let digits = format!("{}", value.abs()).replace('.', "");
    digits.len() >= 3 && digits.bytes().all(|digit| digit == b'9')
}

/// Where the record lies, whatever fill values are in it.
struct Range {
    low: f64,
    high: f64,
    /// How many different values were seen, without fill values.
    different: usize,
}

impl Range {
    fn of(y: &[f64]) -> Option<Self> {
        let mut values = looked_at(y);
        values.sort_unstable_by(f64::total_cmp);
        values.dedup();
        values.retain(|v| !is_usual(*v) && v.abs() < ABSURD);
        let different = values.len();
        // A tenth at either end may be wild; few values are all taken.
        let cut = if different < ENOUGH { 0 } else { different / 10 };
        let (low, high) = (*values.get(cut)?, *values.get(different - 1 - cut)?);
        Some(Self { low, high, different })
    }

    fn width(&self) -> f64 {
        self.high - self.low
    }

    fn size(&self) -> f64 {
        self.low.abs().max(self.high.abs())
    }

    /// How far a value lies outside.
    fn distance(&self, value: f64) -> f64 {
        (self.low - value).max(value - self.high)
    }

    fn is_far(&self, value: f64) -> bool {
        self.distance(value) > FAR * self.width()
    }
}

/// All values, or those of blocks at equal distances.
fn looked_at(y: &[f64]) -> Vec<f64> {
    if y.len() <= LOOK {
        return y.to_vec();
    }
    let blocks = LOOK / BLOCK;
    let block = |k: usize| {
        let start = k * (y.len() - BLOCK) / (blocks - 1);
        &y[start..start + BLOCK]
    };
    (0..blocks).flat_map(block).copied().collect()
}

/// How many samples have each far value, by the bits of the value.
fn far_values(y: &[f64], range: &Range) -> HashMap<u64, usize> {
    let mut counts: HashMap<u64, usize> = HashMap::new();
    for value in y.iter().filter(|value| range.is_far(**value)) {
        let full = counts.len() >= KEPT;
        match counts.entry(value.to_bits()) {
            Entry::Occupied(mut count) => *count.get_mut() += 1,
            Entry::Vacant(place) if !full => {
                place.insert(1);
            }
            Entry::Vacant(_) => {}
        }
    }
    counts
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A wave with noise, of values between 80 and 120.
    fn wave(n: usize) -> Vec<f64> {
        let noise = |i: usize| ((i * 7919) % 101) as f64 / 50.0;
        (0..n).map(|i| ((100.0 + 18.0 * (i as f64 * 0.02).sin() + noise(i)) * 100.0).round() / 100.0).collect()
    }

    fn certain(y: &[f64]) -> Vec<(f64, usize)> {
        repeated(y).iter().filter(|r| r.certain).map(|r| (r.value, r.count)).collect()
    }

    #[test]
    fn a_third_at_a_fill_value_is_certain_and_hides_no_other() {
        let mut y = wave(900);
        (0..900).step_by(3).for_each(|i| y[i] = -9999.0);
        (100..104).for_each(|i| y[i] = 9999.99);
        y[500] = 1e20;
        assert_eq!(certain(&y), [(-9999.0, 299), (9999.99, 4), (1e20, 1)]);
    }

    #[test]
    fn more_than_half_at_a_fill_value_is_found_too_and_a_longer_record_in_blocks() {
        let mut y = wave(400_000);
        (0..400_000).filter(|i| i % 10 < 7).for_each(|i| y[i] = -32_768.0);
        assert_eq!(certain(&y), [(-32_768.0, 280_000)]);
    }

    #[test]
    fn fill_values_near_a_quantised_record_are_found() {
        let mut y: Vec<f64> = (0..300).map(|i| 12.0 + (i * 7 % 9) as f64 / 10.0).collect();
        (40..50).for_each(|i| y[i] = 99.99);
        assert_eq!(certain(&y), [(99.99, 10)]);
    }

    #[test]
    fn a_single_usual_fill_value_is_offered_and_not_certain() {
        let mut y = vec![5.0; 100];
        y[60] = 9999.0;
        assert_eq!(repeated(&y), [Repeated { value: 9999.0, count: 1, certain: false }]);
    }

    #[test]
    fn another_far_value_that_repeats_is_offered() {
        let mut y = wave(500);
        (0..500).step_by(50).for_each(|i| y[i] = -5000.0);
        assert_eq!(repeated(&y), [Repeated { value: -5000.0, count: 10, certain: false }]);
    }

    #[test]
    fn limits_zeros_modes_and_wild_points_are_no_fill_values() {
        let saturated: Vec<f64> = wave(500).iter().map(|v| v.min(110.0)).collect();
        assert!(repeated(&saturated).is_empty());
        // A speed that comes to rest and starts again.
        let speed: Vec<f64> = (0..600).map(|i| (f64::from(i - 300).abs() / 8.0 - 10.0).max(0.0)).collect();
        assert!(repeated(&speed).is_empty());
        let quantised: Vec<f64> = (0..500).map(|i| if i % 7 == 0 { 1.0 } else { 0.0 }).collect();
        assert!(repeated(&quantised).is_empty());
        let mut wild = wave(500);
        (0..25).for_each(|k| wild[k * 20] += 300.0 + 40.0 * k as f64);
        assert!(repeated(&wild).is_empty());
        assert!(repeated(&[]).is_empty() && repeated(&[999.0]).is_empty());
    }

    #[test]
    fn a_counter_passes_through_nines() {
        let y: Vec<f64> = (0..20_000).map(f64::from).collect();
        assert!(repeated(&y).is_empty());
    }

    #[test]
    fn values_of_nines_are_usual() {
        assert!([-9999.0, 999.0, 99.99, 999.9, -999.25, 65_535.0].into_iter().all(is_usual));
        assert!(![9998.0, 99.0, 9.9, 0.0, 1e20, 1999.0].into_iter().any(is_usual));
    }
}
