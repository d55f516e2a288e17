//! How far samples lie from what their neighbours let expect.

use std::ops::Range;

use rayon::prelude::*;

use super::Record;
use crate::math::line::LineSums;
use crate::math::order::median_in_place;
use crate::math::sliding::Summary;
use crate::stop::{Stop, Stopped};

/// Samples in one piece of parallel work.
const PIECE: usize = 2048;

/// The distance of each sample from the median of the interpolations between the neighbours at equal places before and
/// after it, this many on each side, without the masked; then once more of what is left, which takes curvature off.
/// Nothing is carried over a gap.
pub(super) struct Residuals {
    /// Neighbours on each side.
    half: usize,
    /// What was masked when they were computed; nothing before.
    masked: Vec<bool>,
    /// The distance from the interpolations, with its sign.
    once: Vec<f64>,
    /// What is left of it when curvature is taken off, without a sign.
    pub(super) left: Vec<f64>,
}

impl Residuals {
    pub(super) fn new(half: usize) -> Self {
        Self { half, masked: Vec::new(), once: Vec::new(), left: Vec::new() }
    }

    /// Computes them under this mask: anew where it differs, within reach, from the mask before.
    pub(super) fn update(&mut self, record: &Record<'_>, masked: &[bool], stop: &Stop) -> Result<&[f64], Stopped> {
        let n = record.y.len();
        self.once.resize(n, 0.0);
        self.left.resize(n, 0.0);
        // Near an end an interpolation reaches twice as far as elsewhere.
        let once = near_changes(&self.masked, masked, 2 * self.half);
        let left = near_changes(&self.masked, masked, 3 * self.half);
        for stretch in &record.stretches {
            self.update_stretch(record, stretch, masked, (&once, &left), stop)?;
        }
        self.masked.clear();
        self.masked.extend_from_slice(masked);
        Ok(&self.left)
    }

    fn update_stretch(
        &mut self,
        record: &Record<'_>,
        stretch: &Range<usize>,
        masked: &[bool],
        (stale_once, stale_left): (&[bool], &[bool]),
        stop: &Stop,
    ) -> Result<(), Stopped> {
        let own = || stretch.clone();
        let (t, y, masked, half) = (&record.t[own()], &record.y[own()], &masked[own()], self.half);
        each(&mut self.once[own()], &stale_once[own()], stop, |i, near| {
            interpolations(t, y, masked, (i, half), near);
            if near.is_empty() { 0.0 } else { y[i] - median_in_place(near) }
        })?;
        let once = &self.once[own()];
        each(&mut self.left[own()], &stale_left[own()], stop, |i, near| {
            let reach = i.min(y.len() - 1 - i).min(half).max(2);
            let around = i.saturating_sub(reach)..y.len().min(i + reach + 1);
            near.clear();
            near.extend(around.filter(|j| *j != i && !masked[*j]).map(|j| once[j]));
            (once[i] - if near.len() < 3 { 0.0 } else { median_in_place(near) }).abs()
        })
    }
}

/// Which samples lie within `reach` of one whose mask has changed; all where there was none before.
fn near_changes(before: &[bool], now: &[bool], reach: usize) -> Vec<bool> {
    if before.len() != now.len() {
        return vec![true; now.len()];
    }
    let mut near = vec![false; now.len()];
    let mut done = 0;
    for i in (0..now.len()).filter(|i| before[*i] != now[*i]) {
        let end = now.len().min(i + reach + 1);
        near[i.saturating_sub(reach).max(done)..end].fill(true);
        done = end;
    }
    near
}

/// `value(i, scratch)` for each of the samples that are `stale`, in parallel.
fn each(
    all: &mut [f64],
    stale: &[bool],
    stop: &Stop,
    value: impl Fn(usize, &mut Vec<f64>) -> f64 + Sync,
) -> Result<(), Stopped> {
    all.par_chunks_mut(PIECE).zip(stale.par_chunks(PIECE)).enumerate().try_for_each(|(piece, (out, stale))| {
        stop.check()?;
        let mut scratch = Vec::with_capacity(64);
        for (k, (out, _)) in out.iter_mut().zip(stale).enumerate().filter(|(_, (_, stale))| **stale) {
            *out = value(piece * PIECE + k, &mut scratch);
        }
        Ok(())
    })
}

/// Values at sample `i` of the lines through one neighbour before and one after it, at equal places; near an end
/// through pairs of whatever unmasked neighbours there are.
pub(super) fn interpolations(t: &[f64], y: &[f64], masked: &[bool], (i, half): (usize, usize), found: &mut Vec<f64>) {
    found.clear();
    let between = |a: usize, b: usize| y[a] + (t[i] - t[a]) / (t[b] - t[a]) * (y[b] - y[a]);
    for j in 1..=half.min(i).min(y.len() - 1 - i) {
        if !masked[i - j] && !masked[i + j] {
            found.push(between(i - j, i + j));
        }
    }
    if found.len() >= half.min(3) {
        return;
    }
    found.clear();
    let around = i.saturating_sub(2 * half)..y.len().min(i + 2 * half + 1);
    let own: Vec<usize> = around.filter(|j| *j != i && !masked[*j]).collect();
    if own.len() >= 4 {
        let middle = own.len() / 2;
        found.extend((0..middle).map(|k| between(own[k], own[k + middle])));
    }
}

/// Points of the lines by which a side expects a sample.
const LINES: [usize; 2] = [2, 5];

/// A side that has fewer unmasked samples than this cannot object; the other alone must do so by [`GROSS`] limits.
const SIDE: usize = 2;

/// Where one side alone objects, it must do so by this many times more.
const GROSS: f64 = 10.0;

/// How far each sample lies outside of all that the unmasked neighbours of either side let expect: lines through the
/// nearest two and five of a side, and the nearest value where the record holds values. 0 inside; a tenth of it where
/// only one side can object, and 0 for what is not `asked`.
pub(super) fn outside(
    record: &Record<'_>,
    masked: &[bool],
    asked: impl Fn(usize) -> bool + Sync,
    stop: &Stop,
) -> Result<Vec<f64>, Stopped> {
    let mut all = vec![0.0; record.y.len()];
    for stretch in &record.stretches {
        let own: Vec<usize> = stretch.clone().filter(|i| !masked[*i]).collect();
        if own.len() < 6 {
            continue;
        }
        let first = stretch.start;
        all[stretch.clone()].par_chunks_mut(PIECE).enumerate().try_for_each(|(piece, out)| {
            stop.check()?;
            let from = first + piece * PIECE;
            let mut before = own.partition_point(|j| *j < from);
            for (i, out) in (from..).zip(out) {
                before += usize::from(own.get(before).is_some_and(|j| *j < i));
                if asked(i) {
                    let after = before + usize::from(own.get(before) == Some(&i));
                    *out = outside_of(record, &own[..before], &own[after..], i);
                }
            }
            Ok(())
        })?;
    }
    Ok(all)
}

/// How far sample `i` lies outside of what the samples before and after it let expect.
fn outside_of(record: &Record<'_>, left: &[usize], right: &[usize], i: usize) -> f64 {
    let (mut low, mut high) = (f64::INFINITY, f64::NEG_INFINITY);
    let mut expect = |value: f64| (low, high) = (low.min(value), high.max(value));
    if record.holds {
        left.last().into_iter().chain(right.first()).for_each(|&nearest| expect(record.y[nearest]));
    }
    for points in LINES {
        let nearest = [left.len().checked_sub(points).map(|from| &left[from..]), right.get(..points)];
        nearest.into_iter().flatten().for_each(|used| expect(line_at(record, used, record.t[i])));
    }
    let distance = (record.y[i] - high).max(low - record.y[i]);
    let distance = if distance.is_finite() { distance.max(0.0) } else { 0.0 };
    if left.len() < SIDE || right.len() < SIDE { distance / GROSS } else { distance }
}

/// The value at time `at` of the least-squares line through these samples.
pub(super) fn line_at(record: &Record<'_>, points: &[usize], at: f64) -> f64 {
    let mut line = LineSums::default();
    points.iter().for_each(|&j| line.add([record.t[j], record.y[j]]));
    line.at(at)
}
