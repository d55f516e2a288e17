//! Calibration of long records: in full on pieces of them, elsewhere by the noise of the neighbourhood.
//!
//! 1. `thin`: the residuals of every fourth sample; what is usual around a sample is a quantile of those near it.
//! 2. Pieces of all states of the noise, from the quietest to the roughest, are calibrated in full, as one record with
//!    gaps. They say how many times the usual residual the limit is in each state.
//! 3. A quick look at each sample against its two neighbours finds where a wild point can be. There the limits decide as
//!    they do in the last round of a short record; elsewhere nobody objects.

use std::ops::Range;

use rayon::prelude::*;

use super::bridge::bridge;
use super::coast::coast;
use super::residual::{interpolations, outside};
use super::{Calibration, Record, calibrate_whole, share_held};
use crate::math::order::median_in_place;
use crate::stop::{Stop, Stopped};

/// Every this many samples a thin residual is taken.
const STRIDE: usize = 4;

/// Neighbours on either side of which a thin residual is made, as in the longer window of the whole calibration.
const HALF: usize = 20;

/// Thin residuals on either side of one by which curvature is taken off: half a window.
const CURVED: usize = 3;

/// Thin residuals on either side that say what is usual here: 100 samples, as in the whole calibration.
const NEAR: usize = 25;

/// The quantile of them that is usual. A fifth of all samples may be wild.
const USUAL: f64 = 0.7;

/// This many samples share one usual residual: the noise does not change faster.
const SHARED: usize = 16;

/// Samples in a piece that is calibrated in full, and in one piece of parallel work.
const PIECE: usize = 1024;

/// Pieces that are calibrated in full.
const PIECES: usize = 16;

/// Records with more samples are long: all pieces together are shorter.
pub(super) const LONG: usize = PIECES * PIECE;

/// Pieces that agree on how many times the usual residual the limit is.
const AGREE: usize = 5;

/// A sample is looked at more closely from this share of its limit on: well below what is suspect.
const CLOSER: f64 = 0.4;

/// Samples around such a one on either side that are judged with it: a patch and the flanks that carry its parabola.
const AROUND: usize = 16;

/// Calibrates a long record.
///
/// # Errors
/// [`Stopped`] as soon as nobody waits for the result any more.
pub(super) fn calibrate(record: &Record<'_>, stop: &Stop) -> Result<Calibration, Stopped> {
    let usual = usual(record, &thin(record, stop)?, stop)?;
    let sample = Extract::of(record, pieces_of_all_states(record, &usual));
    let found = calibrate_whole(&sample.record(record), stop)?;
    let Some(limits) = limits(&usual, &sample, &found.limits, record.y.len()) else {
        return calibrate_whole(record, stop);
    };
    let close = far_from_neighbours(record, &limits, stop)?;
    let doubtful = Extract::of(record, surroundings(record, &close));
    let objections = objections(&doubtful, record, (&limits, &close), stop)?;
    Ok(Calibration {
        rules: record.rules,
        whole: found.whole,
        resolution: record.resolution,
        held: share_held(record.y),
        limits,
        tails: found.tails,
        objections,
    })
}

/// Parts of a record, one after the other, as a record with gaps.
struct Extract {
    /// Where the parts are, ascending.
    parts: Vec<Range<usize>>,
    t: Vec<f64>,
    y: Vec<f64>,
    /// Where they are in this one.
    stretches: Vec<Range<usize>>,
}

impl Extract {
    fn of(record: &Record<'_>, parts: Vec<Range<usize>>) -> Self {
        let (t, y) = (gather(&parts, record.t), gather(&parts, record.y));
        let mut end = 0;
        let mut stretch = |part: &Range<usize>| {
            end += part.len();
            end - part.len()..end
        };
        let stretches = parts.iter().map(&mut stretch).collect();
        Self { parts, t, y, stretches }
    }

    /// As a record of the same kind as `whole`.
    fn record(&self, whole: &Record<'_>) -> Record<'_> {
        Record { t: &self.t, y: &self.y, stretches: self.stretches.clone(), ..*whole }
    }
}

/// What lies in the parts, one after the other.
fn gather<T: Copy>(parts: &[Range<usize>], values: &[T]) -> Vec<T> {
    parts.iter().flat_map(|part| &values[part.clone()]).copied().collect()
}

/// A stretch in pieces of at most `length` samples.
fn in_pieces(stretch: &Range<usize>, length: usize) -> impl Iterator<Item = Range<usize>> + use<> {
    let end = stretch.end;
    (stretch.start..end).step_by(length).map(move |from| from..end.min(from + length))
}

/// The residual of every [`STRIDE`]th sample about its neighbours, curvature taken off.
fn thin(record: &Record<'_>, stop: &Stop) -> Result<Vec<f64>, Stopped> {
    let nothing = vec![false; record.y.len()];
    let mut all = vec![0.0; record.y.len().div_ceil(STRIDE)];
    all.par_chunks_mut(PIECE).enumerate().try_for_each(|(piece, out)| {
        stop.check()?;
        let mut near = Vec::with_capacity(2 * HALF);
        let mut stretch = record.stretches.partition_point(|s| s.end <= piece * PIECE * STRIDE);
        for (k, out) in out.iter_mut().enumerate() {
            let at = (piece * PIECE + k) * STRIDE;
            stretch += record.stretches[stretch..].iter().take_while(|s| s.end <= at).count();
            let own = record.stretches[stretch].clone();
            let part = (&record.t[own.clone()], &record.y[own.clone()], &nothing[own.clone()]);
            interpolations(part.0, part.1, part.2, (at - own.start, HALF), &mut near);
            *out = if near.is_empty() { 0.0 } else { record.y[at] - median_in_place(&mut near) };
        }
        Ok(())
    })?;
    let once = all.clone();
    all.par_chunks_mut(PIECE).enumerate().try_for_each(|(piece, out)| {
        stop.check()?;
        let mut near = Vec::with_capacity(2 * CURVED);
        for (k, out) in out.iter_mut().enumerate() {
            let at = piece * PIECE + k;
            near.clear();
            near.extend_from_slice(&once[at.saturating_sub(CURVED)..at]);
            near.extend_from_slice(&once[at + 1..once.len().min(at + 1 + CURVED)]);
            *out = (*out - median_in_place(&mut near)).abs();
        }
        Ok(())
    })?;
    Ok(all)
}

/// The usual residual around each [`SHARED`] samples.
fn usual(record: &Record<'_>, thin: &[f64], stop: &Stop) -> Result<Vec<f64>, Stopped> {
    let mut all = vec![0.0; record.y.len().div_ceil(SHARED)];
    all.par_chunks_mut(PIECE).enumerate().try_for_each(|(piece, out)| {
        stop.check()?;
        let mut near = Vec::with_capacity(2 * NEAR + 1);
        for (k, out) in out.iter_mut().enumerate() {
            let center = ((piece * PIECE + k) * SHARED + SHARED / 2) / STRIDE;
            near.clear();
            near.extend_from_slice(
                &thin[center.min(thin.len()).saturating_sub(NEAR)..thin.len().min(center + NEAR + 1)],
            );
            *out = super::quantile(&mut near, USUAL);
        }
        Ok(())
    })?;
    Ok(all)
}

/// Pieces of the record: of all that lie within a stretch those at even ranks of their noise, in the order of time.
fn pieces_of_all_states(record: &Record<'_>, usual: &[f64]) -> Vec<Range<usize>> {
    let noise = |piece: &Range<usize>| usual[piece.start.midpoint(piece.end) / SHARED];
    let mut all: Vec<Range<usize>> = record.stretches.iter().flat_map(|s| in_pieces(s, PIECE)).collect();
    // Short ones are taken where there is nothing else.
    let long = all.iter().filter(|p| p.len() == PIECE).count();
    if long >= PIECES {
        all.retain(|p| p.len() == PIECE);
    }
    all.sort_by(|a, b| noise(a).total_cmp(&noise(b)).then(a.start.cmp(&b.start)));
    let length = all.iter().map(Range::len).sum::<usize>() / all.len().max(1);
    let wanted = (PIECES * PIECE / length.max(1)).clamp(1, all.len());
    let mut chosen: Vec<Range<usize>> =
        (0..wanted).map(|k| all[(2 * k + 1) * all.len() / (2 * wanted)].clone()).collect();
    chosen.sort_by_key(|p| p.start);
    chosen
}

/// The limit of each sample: this many times the usual residual around it as in the pieces of such noise, and no less
/// than the least limit of all pieces. None where the pieces have no limit, since all of their values are the same.
fn limits(usual: &[f64], sample: &Extract, found: &[f64], n: usize) -> Option<Vec<f64>> {
    let pieces = sample.parts.iter().zip(&sample.stretches);
    let mut states: Vec<State> = pieces.map(|(part, own)| State::of(part, usual, &found[own.clone()])).collect();
    states.sort_by(|a, b| a.usual.total_cmp(&b.usual));
    let least = states.iter().map(|s| s.limit).filter(|l| *l > 0.0).min_by(f64::total_cmp)?;
    let times: Vec<f64> = (0..states.len()).map(|k| times_usual(&states, k)).collect();
    let limit = |usual: &f64| {
        let at = states.partition_point(|s| s.usual < *usual).min(states.len() - 1);
        (times[at] * usual).max(least)
    };
    let shared: Vec<f64> = usual.par_iter().map(limit).collect();
    Some((0..n).into_par_iter().map(|i| shared[i / SHARED]).collect())
}

/// How many times the usual residual the limit is in pieces with as much noise as the `k`th; 0 where it is not known.
fn times_usual(states: &[State], k: usize) -> f64 {
    let from = k.saturating_sub(AGREE / 2).min(states.len().saturating_sub(AGREE));
    let near = states[from..states.len().min(from + AGREE)].iter().filter(|s| s.usual > 0.0);
    let mut ratios: Vec<f64> = near.map(|s| s.limit / s.usual).collect();
    if ratios.is_empty() { 0.0 } else { median_in_place(&mut ratios) }
}

/// A piece: what is usual in it, and its limit.
struct State {
    usual: f64,
    limit: f64,
}

impl State {
    fn of(piece: &Range<usize>, usual: &[f64], limits: &[f64]) -> Self {
        let mut usual: Vec<f64> = piece.clone().step_by(SHARED).map(|i| usual[i / SHARED]).collect();
        let mut limits: Vec<f64> = limits.iter().copied().filter(|l| l.is_finite()).collect();
        let limit = if limits.is_empty() { 0.0 } else { median_in_place(&mut limits) };
        Self { usual: median_in_place(&mut usual), limit }
    }
}

/// Where wild points can be: the samples that lie far from the line between their neighbours and also from what the
/// neighbourhood lets expect, ascending.
fn far_from_neighbours(record: &Record<'_>, limits: &[f64], stop: &Stop) -> Result<Vec<usize>, Stopped> {
    let nothing = vec![false; record.y.len()];
    let in_piece = |(stretch, piece): (&Range<usize>, Range<usize>)| {
        stop.check()?;
        let (t, y) = (&record.t[stretch.clone()], &record.y[stretch.clone()]);
        let mut near = Vec::with_capacity(HALF);
        let is_far = |i: &usize| {
            let (i, least) = (i - stretch.start, CLOSER * limits[*i]);
            if i > 0 && i + 1 < y.len() {
                let share = (t[i] - t[i - 1]) / (t[i + 1] - t[i - 1]);
                if (y[i] - y[i - 1] - share * (y[i + 1] - y[i - 1])).abs() < least {
                    return false;
                }
            }
            interpolations(t, y, &nothing[stretch.clone()], (i, HALF / 2), &mut near);
            near.is_empty() || (y[i] - median_in_place(&mut near)).abs() >= least
        };
        Ok(piece.filter(is_far).collect::<Vec<usize>>())
    };
    let pieces: Vec<_> = record.stretches.iter().flat_map(|s| in_pieces(s, 8 * PIECE).map(move |p| (s, p))).collect();
    let found: Vec<Vec<usize>> = pieces.into_par_iter().map(in_piece).collect::<Result<_, Stopped>>()?;
    Ok(found.concat())
}

/// What lies around these samples, ascending, each part within one stretch.
fn surroundings(record: &Record<'_>, samples: &[usize]) -> Vec<Range<usize>> {
    let mut parts: Vec<Range<usize>> = Vec::new();
    let mut stretches = record.stretches.iter().peekable();
    for &i in samples {
        while stretches.next_if(|s| s.end <= i).is_some() {}
        let Some(stretch) = stretches.peek() else { break };
        let around = stretch.start.max(i.saturating_sub(AROUND))..stretch.end.min(i + AROUND + 1);
        match parts.last_mut() {
            Some(last) if around.start < last.end => last.end = around.end,
            _ => parts.push(around),
        }
    }
    parts
}

/// The objections to the samples of the record: in its doubtful parts to those that lie close or that are masked there,
/// 0 elsewhere.
fn objections(
    doubtful: &Extract,
    whole: &Record<'_>,
    (limits, far): (&[f64], &[usize]),
    stop: &Stop,
) -> Result<Vec<f64>, Stopped> {
    let part = doubtful.record(whole);
    let limits_of_parts = gather(&doubtful.parts, limits);
    let mut masked = vec![false; part.y.len()];
    coast(&part, &limits_of_parts, &mut masked, stop)?;
    let bridged = bridge(&part, &limits_of_parts, &mut masked, stop)?;
    let mut is_far = vec![false; limits.len()];
    far.iter().for_each(|i| is_far[*i] = true);
    let is_far = gather(&doubtful.parts, &is_far);
    let outside = outside(&part, &masked, |i| masked[i] || is_far[i], stop)?;
    let mut all = vec![0.0; limits.len()];
    for (part, stretch) in doubtful.parts.iter().zip(&doubtful.stretches) {
        let found = outside[stretch.clone()].iter().zip(&bridged[stretch.clone()]);
        all[part.clone()].iter_mut().zip(found).for_each(|(all, (outside, bridged))| *all = outside.max(*bridged));
    }
    Ok(all)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::calibration::{self, Rules};
    use crate::series::Series;

    /// Even deviates from 0 to 1: the upper half of Knuth's linear congruential generator.
    fn uniform(mut state: u64) -> impl FnMut() -> f64 {
        move || {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            (state >> 32) as f64 / f64::from(u32::MAX)
        }
    }

    /// White noise of deviation 1.
    fn noise(n: usize) -> Vec<f64> {
        let mut uniform = uniform(17);
        (0..n).map(|_| (0..12).map(|_| uniform()).sum::<f64>() - 6.0).collect()
    }

    fn calibrated(t: &[f64], y: &[f64]) -> Calibration {
        assert!(y.len() > LONG);
        calibration::calibrate(&Series::new(t, y), Rules::Noise, &Stop::never()).unwrap()
    }

    fn times(n: usize) -> Vec<f64> {
        (0..n).map(|i| i as f64).collect()
    }

    #[test]
    fn limits_follow_noise_that_no_piece_may_lie_in() {
        // A swing of 200 samples to a period, quiet but for 300 samples.
        let rough = 30_150..30_450;
        let scale = |i: usize| if rough.contains(&i) { 20.0 } else { 1.0 };
        let white = noise(60_000);
        let y: Vec<f64> = (0..60_000).map(|i| 50.0 * (i as f64 * 0.0314).sin() + scale(i) * white[i]).collect();
        let limits = calibrated(&times(60_000), &y).limits;
        // Three to ten deviations, away from the changes.
        assert!(limits[1000..30_000].iter().chain(&limits[30_600..59_000]).all(|l| (3.0..10.0).contains(l)));
        assert!(limits[30_270..30_330].iter().all(|l| (60.0..200.0).contains(l)), "{:?}", &limits[30_270..30_330]);
    }

    #[test]
    fn wild_points_and_patches_are_objected_to_by_their_size_and_hardly_anything_else() {
        let mut y = noise(60_000);
        let wild: Vec<usize> = (500..60_000).step_by(997).chain(20_100..20_112).collect();
        wild.iter().for_each(|i| y[*i] += 40.0);
        let found = calibrated(&times(60_000), &y);
        assert!(wild.iter().all(|i| (25.0..48.0).contains(&found.objections[*i])));
        let objected =
            found.objections.iter().zip(&found.limits).filter(|(objection, limit)| objection > limit).count();
        // One good sample in a thousand.
        assert!(objected <= wild.len() + 60, "{objected}");
    }

    #[test]
    fn a_fifth_of_wild_points_raises_no_limit_to_their_size() {
        let mut y = noise(40_000);
        let mut uniform = uniform(1);
        y.iter_mut().filter(|_| uniform() < 0.2).for_each(|y| *y += 30.0);
        let found = calibrated(&times(40_000), &y);
        assert!(found.limits.iter().all(|l| *l < 20.0), "{:?}", found.typical_limit());
    }

    #[test]
    fn what_is_constant_but_for_one_sample_is_objected_to() {
        let mut y = vec![5.0; 40_000];
        y[12_345] = 9999.0;
        let found = calibrated(&times(40_000), &y);
        assert!(found.objections[12_345] > 9000.0 && found.limits[12_345].is_finite());
        assert_eq!(found.objections.iter().filter(|o| **o > 0.0).count(), 1);
    }

    #[test]
    fn stretches_shorter_than_any_piece_are_judged() {
        // Passes of 40 samples with long gaps between them.
        let t: Vec<f64> = (0..40_000).map(|i| i as f64 + 5000.0 * (i / 40) as f64).collect();
        let mut y = noise(40_000);
        y[20_020] += 40.0;
        let found = calibrated(&t, &y);
        assert!((3.0..12.0).contains(&found.typical_limit().unwrap()), "{:?}", found.typical_limit());
        assert!(found.objections[20_020] > 25.0);
    }
}
