//! What a method says of a segment.

use std::ops::Range;

use rayon::prelude::*;

use super::Segment;
use super::local::Sample;
use super::noise::Objection;
use super::verdict::{Direction, Restart, Verdict};
use crate::math::pieces::{self, PIECE};
use crate::param::Settings;
use crate::stop::{Stop, Stopped};

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

/// What a method's own repair needs to know of a segment that was judged: entries as in [`Judged`], each list empty
/// where that has none.
#[derive(Debug, Clone, Copy)]
pub struct Part<'a> {
    /// The verdicts; empty where the multiplier only gates and the scores are all that is known.
    pub verdict: &'a [Verdict],
    /// Expected values; NaN where there is none.
    pub expected: &'a [f64],
    /// What the method's own repair needs to know beyond the rest, coded by the method.
    pub repair_code: &'a [[u8; 2]],
    /// What the method's own repair puts in place of a sample; NaN where nothing.
    pub own: &'a [f64],
}

/// What a method's own repair is given.
#[derive(Debug, Clone, Copy)]
pub struct Damaged<'a> {
    /// The segment as it was measured.
    pub segment: &'a Segment<'a>,
    /// The parameters of the method.
    pub settings: &'a Settings,
    /// What it said of the segment.
    pub judged: Part<'a>,
    /// What is to be replaced: positions in the segment, ascending, after the analyst's decisions.
    pub outliers: &'a [usize],
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

/// What is said of the value `y` where `p` was expected within `tolerance`; with what the calibration has against the
/// sample, and the share from which on it is doubtful.
#[inline]
pub(super) fn gated(y: f64, p: f64, tolerance: f64, record: Option<(Objection, f64)>) -> Verdict {
    match record {
        Some((objection, doubt)) if !p.is_nan() && tolerance.is_finite() => {
            Sample { distance: (y - p).abs(), objection }.gated(tolerance, doubt)
        }
        _ => Verdict::of_deviation(y, p, tolerance),
    }
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

    /// [`Judged::unchecked`] for many samples.
    ///
    /// # Errors
    /// [`Stopped`] as soon as nobody waits for the result any more.
    pub fn unchecked_many(n: usize, stop: &Stop) -> Result<Self, Stopped> {
        let nothing = || pieces::collect(n, &|| stop.check(), |_| f64::NAN);
        let verdict = vec![Verdict::Unchecked; n];
        Ok(Self { verdict, expected: nothing()?, tolerance: nothing()?, ..Self::default() })
    }

    /// Without infinities: where values near the largest double made an expected value or a tolerance overflow, there is
    /// none, and the sample is unchecked, for nothing was found out about it. Nor is a sample an outlier without both.
    ///
    /// # Errors
    /// [`Stopped`] as soon as nobody waits for the result any more.
    pub fn bounded(mut self, stop: &Stop) -> Result<Self, Stopped> {
        if self.scale.len() == self.verdict.len() {
            // [`Judged::gate`] has seen to it.
            return Ok(self);
        }
        let pieces = self.verdict.par_chunks_mut(PIECE).zip(self.expected.par_chunks_mut(PIECE));
        pieces.zip(self.tolerance.par_chunks_mut(PIECE)).try_for_each(|((verdict, expected), tolerance)| {
            stop.check()?;
            for ((verdict, p), h) in verdict.iter_mut().zip(expected).zip(tolerance) {
                bound(verdict, p, h);
            }
            Ok(())
        })?;
        Ok(self)
    }

    /// Verdicts from expected values and scales for a multiplier `k`: tolerance `k * scale`; a sample without an
    /// expected value or with a tolerance that overflows is unchecked, one with a zero scale normal.
    ///
    /// # Errors
    /// [`Stopped`] as soon as nobody waits for the result any more.
    pub fn gated(y: &[f64], mut expected: Vec<f64>, scale: Vec<f64>, k: f64, stop: &Stop) -> Result<Self, Stopped> {
        pieces::over(&mut expected, &|| stop.check(), |_, expected| {
            expected.iter_mut().filter(|p| p.is_infinite()).for_each(|p| *p = f64::NAN);
        })?;
        let mut judged = Self { expected, scale, ..Self::default() };
        judged.gate(y, k, stop)?;
        Ok(judged)
    }

    /// Judges again from [`Judged::scale`] with another multiplier.
    ///
    /// # Errors
    /// [`Stopped`] as soon as nobody waits for the result any more; there are no verdicts then.
    pub fn gate(&mut self, y: &[f64], k: f64, stop: &Stop) -> Result<(), Stopped> {
        self.gate_by(y, k, None, stop)
    }

    /// The same where the calibration has something against each sample, with the share from which on one is doubtful.
    pub(super) fn gate_by(
        &mut self,
        y: &[f64],
        k: f64,
        record: Option<(&[Objection], f64)>,
        stop: &Stop,
    ) -> Result<(), Stopped> {
        let n = self.scale.len();
        (self.tolerance, self.verdict) = (vec![0.0; n], vec![Verdict::Unchecked; n]);
        let scores = self.expected.par_chunks(PIECE).zip(self.scale.par_chunks(PIECE)).zip(y.par_chunks(PIECE));
        let pieces = self.tolerance.par_chunks_mut(PIECE).zip(self.verdict.par_chunks_mut(PIECE)).zip(scores);
        pieces.enumerate().try_for_each(|(piece, ((tolerance, verdict), ((expected, scale), y)))| {
            stop.check()?;
            let said = tolerance.iter_mut().zip(verdict);
            for (i, ((tolerance, verdict), ((&p, &scale), &y))) in
                (piece * PIECE..).zip(said.zip(expected.iter().zip(scale).zip(y)))
            {
                *tolerance = tolerance_of(k, scale);
                let objection = record.map(|(objections, doubt)| (objections[i], doubt));
                *verdict = gated(y, p, *tolerance, objection);
            }
            Ok(())
        })
    }

    /// The part of a channel's judgement that is about one of its segments, or all of it.
    #[must_use]
    pub fn part(&self, range: Range<usize>) -> Part<'_> {
        Part {
            verdict: part(&self.verdict, &range),
            expected: part(&self.expected, &range),
            repair_code: part(&self.repair_code, &range),
            own: part(&self.own, &range),
        }
    }

    /// Appends the judgement of the next segment of the same channel.
    ///
    /// # Errors
    /// [`Stopped`] as soon as nobody waits for the result any more.
    pub fn append(&mut self, next: Self, stop: &Stop) -> Result<(), Stopped> {
        let (offset, added) = (self.verdict.len(), next.verdict.len());
        let check = || stop.check();
        pieces::extend(&mut self.verdict, &next.verdict, &check)?;
        pieces::extend(&mut self.expected, &next.expected, &check)?;
        pieces::extend(&mut self.tolerance, &next.tolerance, &check)?;
        let lengths = (offset, added);
        join(&mut self.scale, &next.scale, lengths, f64::NAN, stop)?;
        join(&mut self.directions, &next.directions, lengths, Directions { forward: None, backward: None }, stop)?;
        join(&mut self.repair_code, &next.repair_code, lengths, [0, 0], stop)?;
        join(&mut self.own, &next.own, lengths, f64::NAN, stop)?;
        self.restarts.extend(next.restarts.into_iter().map(|r| Restart { at: r.at + offset, ..r }));
        for warning in next.warnings {
            if !self.warnings.contains(&warning) {
                self.warnings.push(warning);
            }
        }
        Ok(())
    }
}

/// What [`Judged::bounded`] does with one sample.
#[inline]
fn bound(verdict: &mut Verdict, p: &mut f64, h: &mut f64) {
    if p.is_finite() && h.is_finite() {
        return;
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

/// Appends what a segment has to say where a method says it only of some segments: of `added` samples after the
/// `offset` that are there. Where one side has nothing, `nothing` stands for each of its samples, so that the entries
/// stay with their samples.
fn join<T: Copy>(
    all: &mut Vec<T>,
    next: &[T],
    (offset, added): (usize, usize),
    nothing: T,
    stop: &Stop,
) -> Result<(), Stopped> {
    if all.is_empty() && next.is_empty() {
        return Ok(());
    }
    let check = || stop.check();
    grow(all, offset, nothing, stop)?;
    pieces::extend(all, next, &check)?;
    grow(all, offset + added, nothing, stop)
}

/// Fills a list up to `n` entries.
fn grow<T: Copy>(all: &mut Vec<T>, n: usize, entry: T, stop: &Stop) -> Result<(), Stopped> {
    while all.len() < n {
        stop.check()?;
        all.resize(n.min(all.len() + PIECE), entry);
    }
    Ok(())
}

fn part<'a, T>(all: &'a [T], range: &Range<usize>) -> &'a [T] {
    all.get(range.clone()).unwrap_or_default()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::method::{Direction, Segment, Way};

    #[test]
    fn a_restart_keeps_its_place_when_segments_are_joined() {
        let part = |at| Judged { restarts: vec![Restart { at, way: Way::Forward }], ..Judged::unchecked(10) };
        let mut whole = part(4);
        whole.append(part(3), &Stop::never()).unwrap();
        let at = |judged: &Judged| judged.restarts.iter().map(|r| r.at).collect::<Vec<_>>();
        assert_eq!(at(&whole), [4, 13]);
    }

    #[test]
    fn a_tolerance_or_an_expected_value_that_overflowed_leaves_the_sample_unchecked() {
        let said = |verdict, p, h| {
            let judged = Judged { verdict: vec![verdict], expected: vec![p], tolerance: vec![h], ..Judged::default() };
            let judged = judged.bounded(&Stop::never()).unwrap();
            (judged.verdict[0], judged.expected[0].is_nan(), judged.tolerance[0].is_nan())
        };
        let inf = f64::INFINITY;
        assert_eq!(said(Verdict::Normal, 1.0, inf), (Verdict::Unchecked, false, true));
        assert_eq!(said(Verdict::Normal, -inf, 1.0), (Verdict::Unchecked, true, false));
        assert_eq!(said(Verdict::Normal, f64::NAN, f64::NAN), (Verdict::Normal, true, true), "a start group");
        assert_eq!(said(Verdict::Outlier, 1.0, f64::NAN), (Verdict::Unchecked, false, true));
        assert_eq!(said(Verdict::Outlier, 1.0, 1.0), (Verdict::Outlier, false, false));
    }

    #[test]
    fn words_of_directions_are_those_of_the_table_of_flags() {
        let words = [Direction::Normal, Direction::Abnormal, Direction::Unjudged].map(Direction::word);
        assert_eq!(words, ["normal", "abnormal", "unjudged"]);
    }

    #[test]
    fn samples_lost_before_one_are_counted_from_the_one_before() {
        let t = [0.0, 1.0, 4.0];
        let segment =
            Segment { t: &t, y: &t, interval: 1.0, sigma: 0.0, floor: 0.5, floors: &[], objections: &[], rate: None };
        assert_eq!([0, 1, 2].map(|i| segment.lost_before(i)), [0, 0, 2]);
        assert!(!segment.is_empty() && Segment { t: &[], y: &[], ..segment }.is_empty());
    }
}
