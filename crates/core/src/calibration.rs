//! Calibration: what the noise of a record is, measured on the record itself before any method judges it.
//!
//! Beyond the documents. Their noise scales assume white noise on a smooth track. Recorded channels are quantised, held,
//! smoothed on board, quiet here and rough there; a scale from differences is then far too small. [`calibrate`] looks
//! at the residuals of the record about its own neighbours instead, and finds for each sample the limit at which a
//! residual stops being noise:
//!
//! 1. `coast`: a coarse test from both sides masks what both object to, so that wild points do not count as noise;
//!    `bridge` masks the patches that this misses, by one parabola over both sides of each.
//! 2. `residual`: the distance of each sample from the median of the interpolations between its neighbours on both
//!    sides, in two windows, with what is left of curvature taken off.
//! 3. `background`: the 95 % quantile of the residuals of the neighbourhood: the limit rises where the noise does.
//! 4. `threshold`: the multiple of it at which the residuals of this record end and wild points begin.
//!
//! Where step 4 sees no such end, by [`Rules::Noise`] no limit lies below the `reach` of the noise of the whole record.
//!
//! Steps 2 to 4 run three times, each time without the samples found so far. A long record is calibrated so in `blocks`
//! that stand for all of it.
//!
//! Before that, [`repeated`], [`stuck`] and [`wrap`] say which checks and which period a record asks for.

use rayon::prelude::*;

use crate::math::difference::third;
use crate::math::order::{MAD_TO_SIGMA, median_in_place};
use crate::series::Series;
use crate::stop::{Stop, Stopped};

mod background;
mod blocks;
mod bridge;
mod coast;
mod reach;
pub mod repeated;
mod residual;
mod resolution;
mod stretches;
pub mod stuck;
mod threshold;
mod words;
pub mod wrap;

use background::background;
use bridge::bridge;
use coast::coast;
pub use reach::Whole;
use reach::reach;
use residual::{Residuals, outside};
use resolution::resolution;
pub use stretches::{local_interval, stretches};
use threshold::{threshold, weight};
pub(crate) use words::amount;

/// The rules of a calibration. Saved results name them, so that they stay what they were.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Rules {
    /// The rules of earlier versions: the length of the record does not matter.
    Record,
    /// Where the record shows no end of its noise, limits are higher in a longer record. An unusual value can be doubtful
    /// in a rough part too. An objection of ten limits from both sides makes an outlier of any sample.
    #[default]
    Noise,
}

/// What is known of a channel before a method judges it.
#[derive(Debug, Clone, PartialEq)]
pub struct Calibration {
    /// The rules that it was made by.
    pub rules: Rules,
    /// What the record is as a whole; none by [`Rules::Record`], and where its noise has no tail to go by.
    pub whole: Option<Whole>,
    /// The smallest step that many neighbours share, in channel units; 0 where values are not on a grid.
    pub resolution: f64,
    /// Share of samples that repeat the value before them, from 0 to 1.
    pub held: f64,
    /// For each present sample the residual at which noise ends, in channel units; infinite where nothing is known.
    pub limits: Vec<f64>,
    /// How much heavier the tails of this record's noise are than normal ones, at least 1; the limits hold the square
    /// of it.
    pub tails: f64,
    /// For each present sample how far it lies outside of all that the neighbours on either side let expect, in channel
    /// units; 0 inside. In a patch the distance from the parabola that bridges it, where that is more. Where only one
    /// side has neighbours, a tenth of that.
    pub objections: Vec<f64>,
}

/// A record holds values when at least this share of its samples repeats the one before.
pub(crate) const HOLDS: f64 = 0.2;

/// More lost samples in a row than this are a gap.
const MAX_GAP: usize = 5;

/// Half lengths of the windows of residuals: 21 and 41 samples.
const WINDOWS: [usize; 2] = [10, 20];

/// Noise is never taken for less than this many deviations of white noise …
const WHITE: f64 = 4.0;

/// … nor for less than this many steps of the resolution: a single step is rounding.
const STEPS: f64 = 1.5;

/// The record as calibration sees it.
struct Record<'a> {
    t: &'a [f64],
    y: &'a [f64],
    stretches: Vec<std::ops::Range<usize>>,
    holds: bool,
    resolution: f64,
    rules: Rules,
}

impl Calibration {
    /// The median of the limits, which is what an analyst would be told; none where nothing is known.
    #[must_use]
    pub fn typical_limit(&self) -> Option<f64> {
        let mut finite: Vec<f64> = self.limits.iter().copied().filter(|l| l.is_finite()).collect();
        (!finite.is_empty()).then(|| median_in_place(&mut finite))
    }

    /// The share of the limit of the sample at `position`, which has this value, that is its limit with tails that weigh
    /// once, where they weigh squared: above 0, at most 1. Less where the value is unusual for the whole record.
    pub(crate) fn lower(&self, position: usize, value: f64) -> f64 {
        let lower = 1.0 / self.tails;
        self.whole.map_or(lower, |whole| whole.doubtful_share(value, self.limits[position], lower))
    }

    /// How many samples stand clear of the noise: those with an objection of twice their limit. 0 where more than one
    /// sample in 20 does, which is no longer a matter of single points.
    #[must_use]
    pub fn clear(&self) -> usize {
        let known = self.objections.iter().zip(&self.limits).filter(|(_, limit)| limit.is_finite() && **limit > 0.0);
        let clear = known.filter(|(objection, limit)| **objection >= 2.0 * **limit).count();
        if clear * 20 <= self.limits.len() { clear } else { 0 }
    }
}

/// Calibrates a channel: a pure function of its times and values and of the rules, the same on any number of threads.
///
/// # Errors
/// [`Stopped`] as soon as nobody waits for the result any more.
pub fn calibrate(series: &Series<'_>, rules: Rules, stop: &Stop) -> Result<Calibration, Stopped> {
    let (t, y) = (series.t.as_ref(), series.y.as_ref());
    let holds = share_held(y) >= HOLDS;
    let record = Record { t, y, stretches: stretches(t, Some(MAX_GAP)), holds, resolution: resolution(y), rules };
    if y.len() > blocks::LONG { blocks::calibrate(&record, stop) } else { calibrate_whole(&record, stop) }
}

/// Calibrates a record, every sample of it in full.
fn calibrate_whole(record: &Record<'_>, stop: &Stop) -> Result<Calibration, Stopped> {
    let mut masked = coarse_mask(record, stop)?;
    let mut residuals = WINDOWS.map(Residuals::new);
    round(record, &mut residuals, &mut masked, Round::First, stop)?;
    round(record, &mut residuals, &mut masked, Round::Further, stop)?;
    let Limits { limits, tails, reach } = round(record, &mut residuals, &mut masked, Round::Last, stop)?;
    coast(record, &limits, &mut masked, stop)?;
    let bridged = bridge(record, &limits, &mut masked, stop)?;
    let mut objections = outside(record, &masked, |_| true, stop)?;
    objections.iter_mut().zip(bridged).for_each(|(o, b)| *o = o.max(b));
    let Record { rules, resolution, .. } = *record;
    let whole = reach.map(|reach| Whole::of(record.y, reach));
    Ok(Calibration { rules, whole, resolution, held: share_held(record.y), limits, tails, objections })
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Round {
    /// The mask is coarse: quantiles that many wild points do not reach.
    First,
    Further,
    Last,
}

/// What both sides object to by a scale from the nearest neighbours, which isolated wild points hardly inflate.
fn coarse_mask(record: &Record<'_>, stop: &Stop) -> Result<Vec<bool>, Stopped> {
    let nothing = vec![false; record.y.len()];
    let mut near = Residuals::new(3);
    let near = near.update(record, &nothing, stop)?;
    let [local] = background(near, &nothing, background::Span { half: 60, middle: 6 }, [0.5], stop)?;
    let floor = (4.0 * quantile_of(near, &nothing, 0.5)).max(STEPS * record.resolution);
    let limits: Vec<f64> = local.iter().map(|scale| (5.5 * scale).max(floor)).collect();
    let mut masked = nothing;
    coast(record, &limits, &mut masked, stop)?;
    bridge(record, &limits, &mut masked, stop)?;
    Ok(masked)
}

/// What a round finds.
struct Limits {
    limits: Vec<f64>,
    tails: f64,
    /// How far the noise of the whole record reaches, in the window in which that is least, where the rules ask.
    reach: Option<f64>,
}

/// One round: limits under the mask, and the mask that they give.
fn round(
    record: &Record<'_>,
    residuals: &mut [Residuals; 2],
    masked: &mut Vec<bool>,
    pass: Round,
    stop: &Stop,
) -> Result<Limits, Stopped> {
    let n = record.y.len();
    let (wide, narrow) = (background::Span { half: 100, middle: 10 }, background::Span { half: 50, middle: 10 });
    let first = pass == Round::First;
    let lower = (STEPS * record.resolution).max(if first { 0.0 } else { WHITE * white_noise(record, masked) });
    let mut least = vec![f64::INFINITY; n];
    let mut scores = vec![f64::INFINITY; n];
    let (mut tails, mut least_reach) = (1.0_f64, None::<f64>);
    for (index, residuals) in residuals.iter_mut().enumerate() {
        let r = residuals.update(record, masked, stop)?;
        // 3.4 medians-and-a-bit and 2 quantiles of 85 %: 2.9 deviations of normal noise either way.
        let base = if first { 3.4 * quantile_of(r, masked, 0.6) } else { 2.0 * quantile_of(r, masked, 0.85) };
        let mut base = base.max(lower);
        if base <= 0.0 {
            base = r.iter().copied().filter(|x| *x > 0.0).fold(f64::INFINITY, f64::min);
        }
        if record.rules == Rules::Noise && !first {
            // Never below what is usual: a few steps of the resolution are no tail.
            let reach = reach(r, masked).map(|reach| reach.max(base));
            least_reach = least_reach.into_iter().chain(reach).reduce(f64::min);
        }
        let limit: Vec<f64> = if first {
            let [local] = background(r, masked, wide, [0.6], stop)?;
            local.iter().map(|x| base.max(1.9 * 2.4 * x)).collect()
        } else {
            let [usual, far] = background(r, masked, wide, [0.9, 0.95], stop)?;
            let [near] = background(r, masked, narrow, [0.95], stop)?;
            if index == 0 {
                tails = threshold::tails(r, masked, &usual, (0.3 * base, record.resolution));
            }
            far.iter().zip(&near).map(|(far, near)| base.max(1.3 * far).max(1.9 * near)).collect()
        };
        scores.iter_mut().zip(r).zip(&limit).for_each(|((s, r), l)| *s = s.min(r / l));
        least.iter_mut().zip(&limit).for_each(|(all, l)| *all = all.min(*l));
    }
    if !first {
        let outside = outside(record, masked, |_| true, stop)?;
        scores.iter_mut().zip(&outside).zip(&least).for_each(|((s, o), l)| *s = s.min(o / (0.5 * l)));
    }
    let end = threshold(&scores, weight(tails));
    let times = end.times;
    // Where the record does not show an end of its noise, the tail says how far the noise reaches.
    let floor = least_reach.filter(|_| !end.shown).map_or(0.0, |reach| reach * weight(tails));
    least.par_iter_mut().for_each(|l| *l = (*l * times).max(floor));
    if pass != Round::Last {
        let low = if first { times } else { 0.6 * times };
        *masked = scores.iter().map(|s| *s >= low).collect();
        let limits: Vec<f64> = least.iter().map(|l| 0.8 * l).collect();
        coast(record, &limits, masked, stop)?;
        bridge(record, &limits, masked, stop)?;
    }
    Ok(Limits { limits: least, tails, reach: least_reach })
}

#[expect(clippy::cast_precision_loss, reason = "counts of samples are far below 2^53")]
fn share_held(y: &[f64]) -> f64 {
    #[expect(clippy::float_cmp, reason = "held values repeat to the bit")]
    let held = y.windows(2).filter(|w| w[0] == w[1]).count();
    held as f64 / y.len().saturating_sub(1).max(1) as f64
}

/// Deviation of white noise from third differences over unmasked neighbours; over the samples that are no repetition
/// where the record holds values.
fn white_noise(record: &Record<'_>, masked: &[bool]) -> f64 {
    #[expect(clippy::float_cmp, reason = "held values repeat to the bit")]
    let fresh = |i: &usize| !masked[*i] && (!record.holds || *i == 0 || record.y[*i] != record.y[*i - 1]);
    let own: Vec<usize> = (0..record.y.len()).filter(fresh).collect();
    let four = |values: &[f64], w: &[usize]| std::array::from_fn(|k| values[w[k]]);
    let third = |w: &[usize]| third(four(record.t, w), four(record.y, w)).abs() / 20_f64.sqrt();
    // Neighbours in the record, so that no wild point and no gap lies between.
    let near = |w: &&[usize]| record.holds || w[3] == w[0] + 3;
    let mut all: Vec<f64> = own.windows(4).filter(near).map(third).collect();
    if all.len() < 8 {
        return 0.0;
    }
    MAD_TO_SIGMA * median_in_place(&mut all)
}

/// Quantile `q` of the unmasked residuals; 0 without any.
fn quantile_of(r: &[f64], masked: &[bool], q: f64) -> f64 {
    let mut own: Vec<f64> = r.iter().zip(masked).filter(|(_, m)| !**m).map(|(r, _)| *r).collect();
    quantile(&mut own, q)
}

/// Quantile `q` of `values`, the one at or below; 0 without any.
fn quantile(values: &mut [f64], q: f64) -> f64 {
    if values.is_empty() {
        return 0.0;
    }
    let at = rank(values.len(), q);
    *values.select_nth_unstable_by(at, f64::total_cmp).1
}

/// The place of quantile `q` among `n` (at least 1) values in ascending order, the one at or below.
#[expect(
    clippy::cast_precision_loss,
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "counts of samples are far below 2^53, and 0 <= q <= 1"
)]
fn rank(n: usize, q: f64) -> usize {
    (q * (n - 1) as f64) as usize
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Noise of deviation close to 1 from a fixed walk: no generator is needed to make it.
    fn noise(i: usize) -> f64 {
        let uniform = |k: usize| ((i * 7919 % 104_729) as f64 * 0.618_033_988_749_895 * (k * k + 1) as f64).fract();
        (1..=12).map(uniform).sum::<f64>() - 6.0
    }

    fn limits(t: &[f64], y: &[f64]) -> Vec<f64> {
        calibrate(&Series::new(t, y), Rules::Noise, &Stop::never()).unwrap().limits
    }

    #[test]
    fn limits_rise_where_the_noise_does() {
        let t: Vec<f64> = (0..4000).map(f64::from).collect();
        let rough = 2000..2300;
        let y: Vec<f64> = (0..4000).map(|i| noise(i) * if rough.contains(&i) { 10.0 } else { 0.1 }).collect();
        let limits = limits(&t, &y);
        // Between three and ten deviations, away from the changes.
        assert!(limits[200..1800].iter().all(|l| (0.3..1.0).contains(l)), "{:?}", &limits[200..210]);
        assert!(limits[2110..2190].iter().all(|l| (30.0..100.0).contains(l)), "{:?}", &limits[2110..2120]);
    }

    #[test]
    fn one_fill_value_changes_no_limit_far_from_it() {
        let t: Vec<f64> = (0..2000).map(f64::from).collect();
        let mut y: Vec<f64> = (0..2000).map(noise).collect();
        let before = limits(&t, &y);
        y[1000] = 1e20;
        let after = limits(&t, &y);
        assert!((0..700).chain(1300..2000).all(|i| (after[i] / before[i] - 1.0).abs() < 0.1));
    }

    #[test]
    fn a_side_without_neighbours_weighs_a_tenth() {
        let t: Vec<f64> = (0..200).map(f64::from).collect();
        let mut y: Vec<f64> = (0..200).map(noise).collect();
        (y[100], y[199]) = (1000.0, 1000.0);
        let found = calibrate(&Series::new(&t, &y), Rules::Noise, &Stop::never()).unwrap();
        assert!(found.objections[100] > 990.0 && (90.0..101.0).contains(&found.objections[199]));
        assert!(found.objections[50] < 5.0);
    }
}
