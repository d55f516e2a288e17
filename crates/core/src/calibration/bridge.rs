//! Patches: runs that a record jumps into and out of, judged by one parabola over them.
//!
//! Extrapolated over several samples a polynomial errs by more than any limit; from both sides at once it does not.

use super::Record;
use super::residual::line_at;
use crate::math::polyfit::Polynomial;
use crate::stop::{Stop, Stopped};

/// Samples on either side that carry the parabola …
const FLANK: usize = 8;

/// … and the fewest that do.
const FEWEST: usize = 7;

/// The longest patch.
const LONGEST: usize = 25;

/// The flanks stray from their parabola by less than this share of the limit.
const STRAY: f64 = 0.75;

/// Points of the lines by which a side expects the next sample.
const LINES: [usize; 2] = [2, 5];

/// Masks the patches and gives the distance of each of their samples from the parabola; 0 elsewhere.
pub(super) fn bridge(
    record: &Record<'_>,
    limits: &[f64],
    masked: &mut [bool],
    stop: &Stop,
) -> Result<Vec<f64>, Stopped> {
    let mut distance = vec![0.0; record.y.len()];
    let mut left = Vec::with_capacity(FLANK);
    for stretch in &record.stretches {
        let mut i = stretch.start + FEWEST;
        while i + FEWEST < stretch.end {
            if i.is_multiple_of(Stop::STRIDE) {
                stop.check()?;
            }
            left.clear();
            left.extend(flank((stretch.start..i).rev(), masked));
            if left.len() < FEWEST || agrees(record, &left, i, limits[i]) {
                i += 1;
                continue;
            }
            match patch(record, &left, i, stretch.end, limits, masked) {
                Some(found) => {
                    masked[i..i + found.len()].fill(true);
                    distance[i..i + found.len()].copy_from_slice(&found);
                    i += found.len();
                }
                None => i += 1,
            }
        }
    }
    Ok(distance)
}

/// The nearest unmasked samples, the nearest first.
fn flank(near: impl Iterator<Item = usize>, masked: &[bool]) -> impl Iterator<Item = usize> {
    near.take(3 * FLANK).filter(|j| !masked[*j]).take(FLANK)
}

/// Whether a flank lets expect sample `i`.
fn agrees(record: &Record<'_>, flank: &[usize], i: usize, limit: f64) -> bool {
    let near = |value: f64| (record.y[i] - value).abs() < limit;
    near(record.y[flank[0]]) || LINES.into_iter().any(|m| near(line_at(record, &flank[..m], record.t[i])))
}

/// The distances of the samples of the shortest patch that begins at `first`.
fn patch(
    record: &Record<'_>,
    left: &[usize],
    first: usize,
    end: usize,
    limits: &[f64],
    masked: &[bool],
) -> Option<Vec<f64>> {
    (1..=LONGEST).take_while(|length| first + length + FEWEST <= end).find_map(|length| {
        let behind = first + length;
        if masked[behind] {
            return None;
        }
        let right: Vec<usize> = flank(behind..end, masked).collect();
        if right.len() < FEWEST || agrees(record, &right, behind - 1, limits[behind - 1]) {
            return None;
        }
        let carriers: Vec<usize> = left.iter().rev().chain(&right).copied().collect();
        let times: Vec<f64> = carriers.iter().map(|&j| record.t[j] - record.t[first]).collect();
        let values: Vec<f64> = carriers.iter().map(|&j| record.y[j]).collect();
        let fit = Polynomial::fit(&times, &values, 2);
        let residual = |j: usize| record.y[j] - fit.at(record.t[j] - record.t[first]);
        if carriers.iter().any(|&j| residual(j).abs() > STRAY * limits[j]) {
            return None;
        }
        let inside: Vec<f64> = (first..behind).map(residual).collect();
        let side = inside[0].signum();
        let all =
            (first..behind).zip(&inside).all(|(j, r)| (length < 3 && r.abs() >= limits[j]) || r * side >= limits[j]);
        all.then(|| inside.iter().map(|r| r.abs()).collect())
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::calibration::Rules;

    /// A bend of 100 samples with a ripple of 0.3, in limits of 4.
    fn bend() -> Vec<f64> {
        (0..100).map(|i| 0.02 * f64::from((i - 50) * (i - 50)) + 0.3 * f64::from(i * 7 % 5 - 2) / 2.0).collect()
    }

    fn bridged(y: &[f64], masked: &mut [bool]) -> Vec<f64> {
        let t: Vec<f64> = (0..y.len()).map(|i| i as f64).collect();
        let stretches = std::iter::once(0..y.len()).collect();
        let record = Record { t: &t, y, stretches, holds: false, resolution: 0.0, rules: Rules::Noise };
        bridge(&record, &vec![4.0; y.len()], masked, &Stop::never()).unwrap()
    }

    #[test]
    fn a_patch_on_a_bend_is_masked_whole_with_its_distance() {
        for length in [1, 2, 5, 10, 20] {
            let (mut y, mut masked) = (bend(), vec![false; 100]);
            let patch = 40..40 + length;
            y[patch.clone()].iter_mut().for_each(|y| *y += 9.0);
            let distance = bridged(&y, &mut masked);
            assert!((0..100).all(|i| masked[i] == patch.contains(&i)), "{length}");
            assert!((0..100).all(|i| (distance[i] - if masked[i] { 9.0 } else { 0.0 }).abs() < 1.5), "{distance:?}");
        }
    }

    #[test]
    fn half_a_patch_that_is_masked_already_does_not_hide_the_rest() {
        let (mut y, mut masked) = (bend(), vec![false; 100]);
        y[40..50].iter_mut().for_each(|y| *y += 9.0);
        masked[44..50].fill(true);
        bridged(&y, &mut masked);
        assert!((0..100).all(|i| masked[i] == (40..50).contains(&i)));
    }

    #[test]
    fn a_step_and_a_corner_are_no_patches() {
        let step: Vec<f64> = bend().iter().enumerate().map(|(i, y)| y + if i < 50 { 0.0 } else { 30.0 }).collect();
        let corner: Vec<f64> = (0..100).map(|i| 5.0 * f64::from((i - 50_i32).abs())).collect();
        for y in [bend(), step, corner] {
            let mut masked = vec![false; 100];
            assert!(bridged(&y, &mut masked).iter().all(|d| *d == 0.0) && !masked.contains(&true));
        }
    }

    #[test]
    fn between_two_levels_there_is_no_patch() {
        let level = |i: usize| match i {
            0..45 => 0.0,
            45..55 => 30.0,
            _ => -30.0,
        };
        let y: Vec<f64> = (0..100).map(level).collect();
        let mut masked = vec![false; 100];
        assert!(bridged(&y, &mut masked).iter().all(|d| *d == 0.0) && !masked.contains(&true));
    }
}
