//! What a method says of a segment.

use std::borrow::Cow;
use std::ops::Range;

use rayon::prelude::*;

use super::verdict::{Direction, Restart, Verdict};

/// Samples in one piece of parallel work.
const CHUNK: usize = 8192;

/// What a method says of a segment: one entry per sample, in order.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Judged {
    /// The verdicts; never `Missing`.
    pub verdict: Vec<Verdict>,
    /// Expected values; NaN where there is none.
    pub expected: Vec<f64>,
    /// Tolerances, positive; NaN where there is none (0 where the scale is zero and nothing can be flagged).
    pub tolerance: Vec<f64>,
    /// Scales, where the multiplier only gates: the tolerance is the multiplier times this. Empty otherwise.
    pub scale: Vec<f64>,
    /// Verdicts of the two directions, where the method has them. Empty otherwise.
    pub directions: Vec<Directions>,
    /// What the method's own repair needs to know beyond the rest, coded by the method. Empty otherwise.
    pub repair_code: Vec<[u8; 2]>,
    /// What the method's own repair puts in place of a sample that it flagged, where that is not the expected
    /// value; NaN where nothing. Empty otherwise.
    pub own: Vec<f64>,
    /// Where models were started again.
    pub restarts: Vec<Restart>,
    /// What the user should know about this result, one line each.
    pub warnings: Vec<String>,
}

/// What the two directions say of a sample; none for a direction that was not run.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Directions {
    /// With time.
    pub forward: Option<Direction>,
    /// Against time.
    pub backward: Option<Direction>,
}

/// The tolerance `k * scale`; NaN where it overflows, for such a bound says nothing.
#[inline]
pub(super) fn tolerance_of(k: f64, scale: f64) -> f64 {
    let tolerance = k * scale;
    if tolerance.is_infinite() { f64::NAN } else { tolerance }
}

impl Judged {
    /// `n` samples of which nothing can be said.
    #[must_use]
    pub fn unchecked(n: usize) -> Self {
        Self {
            verdict: vec![Verdict::Unchecked; n],
            expected: vec![f64::NAN; n],
            tolerance: vec![f64::NAN; n],
            ..Self::default()
        }
    }

    /// Without infinities: where values near the largest double made an expected value or a tolerance overflow, there is
    /// none, and the sample is unchecked, for nothing was found out about it. Nor is a sample an outlier without both.
    #[must_use]
    pub fn bounded(mut self) -> Self {
        if self.scale.len() == self.verdict.len() {
            // [`Judged::gate`] has seen to it.
            return self;
        }
        for ((verdict, p), h) in self.verdict.iter_mut().zip(&mut self.expected).zip(&mut self.tolerance) {
            if p.is_finite() && h.is_finite() {
                continue;
            }
            if *verdict == Verdict::Outlier || p.is_infinite() || h.is_infinite() {
                *verdict = Verdict::Unchecked;
            }
            for value in [p, h] {
                if value.is_infinite() {
                    *value = f64::NAN;
                }
            }
        }
        self
    }

    /// Verdicts from expected values and scales for a multiplier `k`: tolerance `k * scale`; a sample without an
    /// expected value or with a tolerance that overflows is unchecked, one with a zero scale normal.
    #[must_use]
    pub fn gated(y: &[f64], mut expected: Vec<f64>, scale: Vec<f64>, k: f64) -> Self {
        expected.iter_mut().filter(|p| p.is_infinite()).for_each(|p| *p = f64::NAN);
        let mut judged = Self { expected, scale, ..Self::default() };
        judged.gate(y, k);
        judged
    }

    /// Judges again from [`Judged::scale`] with another multiplier.
    pub fn gate(&mut self, y: &[f64], k: f64) {
        let said = |((&p, &scale), &y): ((&f64, &f64), &f64)| {
            let tolerance = tolerance_of(k, scale);
            (tolerance, Verdict::of_deviation(y, p, tolerance))
        };
        let scores = self.expected.par_iter().zip(&self.scale).zip(y).with_min_len(CHUNK);
        scores.map(said).unzip_into_vecs(&mut self.tolerance, &mut self.verdict);
    }

    /// The part of a channel's judgement that is about one of its segments.
    #[must_use]
    pub fn slice(&self, range: Range<usize>) -> Cow<'_, Self> {
        if range == (0..self.verdict.len()) {
            return Cow::Borrowed(self);
        }
        let inside = |r: &&Restart| range.contains(&r.at);
        Cow::Owned(Self {
            verdict: part(&self.verdict, &range),
            expected: part(&self.expected, &range),
            tolerance: part(&self.tolerance, &range),
            scale: part(&self.scale, &range),
            directions: part(&self.directions, &range),
            repair_code: part(&self.repair_code, &range),
            own: part(&self.own, &range),
            restarts: self.restarts.iter().filter(inside).map(|r| Restart { at: r.at - range.start, ..*r }).collect(),
            warnings: Vec::new(),
        })
    }

    /// Appends the judgement of the next segment of the same channel.
    pub fn append(&mut self, mut next: Self) {
        let (offset, added) = (self.verdict.len(), next.verdict.len());
        self.verdict.append(&mut next.verdict);
        self.expected.append(&mut next.expected);
        self.tolerance.append(&mut next.tolerance);
        let lengths = (offset, added);
        join(&mut self.scale, next.scale, lengths, f64::NAN);
        join(&mut self.directions, next.directions, lengths, Directions { forward: None, backward: None });
        join(&mut self.repair_code, next.repair_code, lengths, [0, 0]);
        join(&mut self.own, next.own, lengths, f64::NAN);
        self.restarts.extend(next.restarts.into_iter().map(|r| Restart { at: r.at + offset, ..r }));
        for warning in next.warnings {
            if !self.warnings.contains(&warning) {
                self.warnings.push(warning);
            }
        }
    }
}

/// Appends what a segment has to say where a method says it only of some segments: of `added` samples after the
/// `offset` that are there. Where one side has nothing, `nothing` stands for each of its samples, so that the entries
/// stay with their samples.
fn join<T: Clone>(all: &mut Vec<T>, mut next: Vec<T>, (offset, added): (usize, usize), nothing: T) {
    if all.is_empty() && next.is_empty() {
        return;
    }
    all.resize(offset, nothing.clone());
    all.append(&mut next);
    all.resize(offset + added, nothing);
}

fn part<T: Clone>(all: &[T], range: &Range<usize>) -> Vec<T> {
    all.get(range.clone()).map(<[T]>::to_vec).unwrap_or_default()
}
