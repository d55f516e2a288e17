//! A result made ready for drawing, on the worker thread.

use std::ops::Range;
use std::sync::Arc;

use super::pyramid::BLOCK;
use super::{Flag, FlagState, Flags, Histogram, Pyramid, Span};
use crate::math::pieces::PIECE;
use crate::method::Verdict;
use crate::param::Value;
use crate::review::Ruling;
use crate::session::{Mark, Outcome};
use crate::stop::{Stop, Stopped};
use crate::track::Series;

/// An outcome with all that a frame needs of it.
#[derive(Debug, Clone)]
pub struct Drawn {
    /// The outcome.
    pub outcome: Arc<Outcome>,
    /// True for each sample that is an outlier: the curve is that of the others.
    pub hidden: Vec<bool>,
    /// Extremes of the kept samples.
    pub kept: Arc<Pyramid>,
    /// The residual in the units of the panel at which a sample is flagged: the multiplier of the scale where the
    /// method has one, and the residual is in scales; otherwise 1, and it is in tolerances.
    pub threshold: f64,
    /// Extremes of the residual in the units of the panel.
    pub ratios: Arc<Pyramid>,
    /// How often which residual occurs, in the units of the panel.
    pub histogram: Histogram,
    /// Extremes of the expected value.
    pub expected: Arc<Pyramid>,
    /// Extremes of the tolerance band.
    pub band: Arc<Pyramid>,
    /// Extremes of the repaired values.
    pub repaired: Arc<Pyramid>,
    /// Extremes of the record after repair.
    pub after: Arc<Pyramid>,
    /// Positions in the order of the queue: outliers, suspects and decisions, by time.
    pub positions: Vec<u32>,
    /// The flags, arranged for drawing.
    pub arranged: Flags,
}

/// What depends on which samples are outliers.
struct Samples {
    hidden: Vec<bool>,
    /// Kept samples, repaired values, and the record after repair.
    pyramids: [Arc<Pyramid>; 3],
    /// Where it is not that of the result before, when it was made from there.
    changed: Option<Vec<Range<usize>>>,
}

impl Drawn {
    /// Arranges `outcome` of `series`. After an earlier result of the same series what did not change is taken from
    /// there.
    ///
    /// # Errors
    /// [`Stopped`] as soon as nobody waits for it any more.
    pub fn new(outcome: Outcome, series: &Series<'_>, previous: Option<&Self>, stop: &Stop) -> Result<Self, Stopped> {
        let previous = previous.filter(|p| p.hidden.len() == series.len());
        let mut drawn = Self {
            threshold: multiplier(&outcome).unwrap_or(1.0),
            hidden: Vec::new(),
            kept: Arc::default(),
            ratios: Arc::default(),
            histogram: Histogram::default(),
            expected: Arc::default(),
            band: Arc::default(),
            repaired: Arc::default(),
            after: Arc::default(),
            positions: outcome.marks.iter().map(|m| m.position).collect(),
            arranged: Flags::default(),
            outcome: Arc::new(outcome),
        };
        let k = |d: &Self| d.outcome.detection.judged.scales().map(|(k, _)| k.to_bits());
        let judged = &drawn.outcome.detection.judged;
        let scored = previous.filter(|p| p.outcome.detection.judged.shares_scores(judged));
        let same_band = scored.filter(|p| k(p) == k(&drawn));
        let in_scales = |d: &Self| d.in_scales() && k(d).is_some();
        let same_residuals = scored.filter(|p| (in_scales(p) && in_scales(&drawn)) || k(p) == k(&drawn));
        let of = &drawn;
        let ((samples, flags), (ratios, (expected, band))) = rayon::join(
            || (of.samples(series, previous, stop), Flags::new_unless(&of.flags(series), stop)),
            || {
                // What is there already, or else is made.
                let or = |there: Option<&Arc<Pyramid>>, make: &dyn Fn() -> Result<Pyramid, Stopped>| {
                    there.map_or_else(|| make().map(Arc::new), |there| Ok(Arc::clone(there)))
                };
                let ratios = or(same_residuals.map(|p| &p.ratios), &|| of.ratios(series, stop));
                let expected = or(scored.map(|p| &p.expected), &|| of.expectation(series, stop));
                (ratios, (expected, or(same_band.map(|p| &p.band), &|| of.band(stop))))
            },
        );
        (drawn.ratios, drawn.expected, drawn.band, drawn.arranged) = (ratios?, expected?, band?, flags?);
        let Samples { hidden, pyramids, changed } = samples?;
        [drawn.kept, drawn.repaired, drawn.after] = pyramids;
        drawn.hidden = hidden;
        drawn.histogram = drawn.counted(series, same_residuals, changed.as_deref(), stop)?;
        Ok(drawn)
    }

    /// The histogram of the residuals; after an earlier result with the same ones, from there, with the samples of
    /// `changed` looked at again.
    fn counted(
        &self,
        series: &Series<'_>,
        same: Option<&Self>,
        changed: Option<&[Range<usize>]>,
        stop: &Stop,
    ) -> Result<Histogram, Stopped> {
        let top = residual_top(self.threshold);
        match (same, changed) {
            (Some(before), Some(changed)) if before.histogram.top().to_bits() == top.to_bits() => {
                let inside = |block: &Range<usize>| block.start..block.end.min(self.hidden.len());
                let turned = changed.iter().flat_map(inside).filter(|&i| self.hidden[i] != before.hidden[i]);
                Ok(before.histogram.turned(turned.map(|i| (self.residual(series, i), self.hidden[i]))))
            }
            _ => Histogram::new(top, |i| self.residual(series, i), &self.hidden, stop),
        }
    }

    fn ratios(&self, series: &Series<'_>, stop: &Stop) -> Result<Pyramid, Stopped> {
        let span = |i: usize| self.residual(series, i).map_or(Span::EMPTY, Span::at);
        Pyramid::build_spans_unless(series.len(), span, stop)
    }

    fn expectation(&self, series: &Series<'_>, stop: &Stop) -> Result<Pyramid, Stopped> {
        Pyramid::build_spans_unless(series.len(), |i| self.expected_span(i), stop)
    }

    /// The pyramid of the tolerance band, which every step of a multiplier moves everywhere.
    fn band(&self, stop: &Stop) -> Result<Pyramid, Stopped> {
        let judged = &self.outcome.detection.judged;
        let Some((k, scale)) = judged.scales() else {
            return Pyramid::build_spans_unless(judged.expected().len(), |i| self.band_span(i), stop);
        };
        let expected = judged.expected();
        let over = |block: Range<usize>| {
            let both = expected[block.clone()].iter().zip(&scale[block]);
            both.fold(Span::EMPTY, |all, (p, s)| all.union(band(*p, k * s)))
        };
        Pyramid::build_blocks(expected.len(), over, stop)
    }

    /// Which samples are outliers, and what depends on that.
    fn samples(&self, series: &Series<'_>, previous: Option<&Self>, stop: &Stop) -> Result<Samples, Stopped> {
        let changed = previous.and_then(|p| Some((p, p.changed_to(&self.outcome)?)));
        let mut hidden = changed.as_ref().map_or_else(|| vec![false; series.len()], |(p, _)| p.hidden.clone());
        let mut hide = |outliers: &[usize], so: bool| {
            outliers.chunks(PIECE).try_for_each(|piece| {
                stop.check()?;
                piece.iter().for_each(|&i| hidden[i] = so);
                Ok(())
            })
        };
        if let Some((previous, _)) = &changed {
            hide(&previous.outcome.outliers, false)?;
        }
        hide(&self.outcome.outliers, true)?;
        let fix = |i: usize| if hidden[i] { span(self.outcome.fix(i)) } else { Span::EMPTY };
        let kept = |i: usize| if hidden[i] { Span::EMPTY } else { span(series.y.get(i).copied()) };
        let after = |i: usize| if hidden[i] { span(self.outcome.fix(i)) } else { span(series.y.get(i).copied()) };
        let pyramids = match &changed {
            Some((previous, blocks)) => {
                let mut pyramids = [&previous.kept, &previous.repaired, &previous.after].map(Arc::clone);
                for (n, block) in blocks.iter().enumerate() {
                    stop.check_at(64 * n)?;
                    Arc::make_mut(&mut pyramids[0]).update_spans(kept, block.clone());
                    Arc::make_mut(&mut pyramids[1]).update_spans(fix, block.clone());
                    Arc::make_mut(&mut pyramids[2]).update_spans(after, block.clone());
                }
                pyramids
            }
            None => {
                let n = series.len();
                let (kept, (repaired, after)) = rayon::join(
                    || Pyramid::build_spans_unless(n, kept, stop),
                    || {
                        let repaired = || Pyramid::build_spans_unless(n, fix, stop);
                        rayon::join(repaired, || Pyramid::build_spans_unless(n, after, stop))
                    },
                );
                [kept?, repaired?, after?].map(Arc::new)
            }
        };
        Ok(Samples { changed: changed.map(|(_, blocks)| blocks), hidden, pyramids })
    }

    /// The blocks in which an outlier, or what takes its place, is another than in `outcome`; none when there are
    /// too many, so that starting from nothing is as quick.
    fn changed_to(&self, outcome: &Outcome) -> Option<Vec<Range<usize>>> {
        let (old, new) = (&self.outcome, outcome);
        // Of a short record even all of them are few.
        let most = (self.hidden.len() / BLOCK / 8).max(64);
        let mut blocks: Vec<usize> = Vec::new();
        let (mut a, mut b) = (0, 0);
        loop {
            let (left, right) = (old.outliers.get(a), new.outliers.get(b));
            let (Some(&position), same) = (match (left, right) {
                (Some(l), Some(r)) if l == r => (Some(l), old.fixes[a].to_bits() == new.fixes[b].to_bits()),
                (Some(l), Some(r)) => (Some(l.min(r)), false),
                (left, right) => (left.or(right), false),
            }) else {
                break;
            };
            a += usize::from(left == Some(&position));
            b += usize::from(right == Some(&position));
            if !same && blocks.last() != Some(&(position / BLOCK)) {
                blocks.push(position / BLOCK);
            }
            if blocks.len() > most {
                return None;
            }
        }
        Some(blocks.into_iter().map(|block| block * BLOCK..(block + 1) * BLOCK).collect())
    }

    /// The expected value of a sample, for drawing.
    #[must_use]
    pub fn expected_span(&self, i: usize) -> Span {
        span(self.outcome.detection.judged.expected().get(i).copied())
    }

    /// Expected value minus tolerance to expected value plus tolerance.
    #[must_use]
    pub fn band_span(&self, i: usize) -> Span {
        let judged = &self.outcome.detection.judged;
        match (judged.expected().get(i), judged.tolerance(i)) {
            (Some(p), Some(h)) => band(*p, h),
            _ => Span::EMPTY,
        }
    }

    /// The value that takes the place of an outlier; nothing for other samples.
    #[must_use]
    pub fn repaired_span(&self, i: usize) -> Span {
        if self.hidden.get(i) == Some(&true) { span(self.outcome.fix(i)) } else { Span::EMPTY }
    }

    /// The sample as the cleaned file has it.
    #[must_use]
    pub fn after_span(&self, series: &Series<'_>, i: usize) -> Span {
        if self.hidden.get(i) == Some(&true) { span(self.outcome.fix(i)) } else { span(series.y.get(i).copied()) }
    }

    /// The sample where it is kept.
    #[must_use]
    pub fn kept_span(&self, series: &Series<'_>, i: usize) -> Span {
        if self.hidden.get(i) == Some(&true) { Span::EMPTY } else { span(series.y.get(i).copied()) }
    }

    /// Residual in tolerances of the sample at `position`, signed; none without a tolerance.
    #[must_use]
    pub fn ratio(&self, series: &Series<'_>, position: usize) -> Option<f64> {
        ratio(&self.outcome, series, position)
    }

    /// Residual of the sample at `position` in the units of the panel, signed; none without a tolerance.
    #[must_use]
    pub fn residual(&self, series: &Series<'_>, position: usize) -> Option<f64> {
        match self.outcome.detection.judged.scales() {
            // In scales it does not depend on the multiplier.
            Some((_, scale)) if self.in_scales() => ratio_of(&self.outcome, series, position, *scale.get(position)?),
            _ => ratio(&self.outcome, series, position).map(|ratio| ratio * self.threshold),
        }
    }

    /// True when the residual is in scales, false when it is in tolerances.
    #[must_use]
    pub fn in_scales(&self) -> bool {
        multiplier(&self.outcome).is_some()
    }

    /// The flags, with the state that the decisions give them.
    #[must_use]
    pub fn flags(&self, series: &Series<'_>) -> Vec<Flag> {
        let of = |m: &Mark| {
            let y = series.y.get(m.position as usize).copied()?;
            state(m).map(|state| Flag { position: m.position, y, state })
        };
        self.outcome.marks.iter().filter_map(of).collect()
    }
}

/// The multiplier of the scale, where the settings have one that matters.
fn multiplier(outcome: &Outcome) -> Option<f64> {
    let settings = &outcome.detection.setup.settings;
    settings.mattering().find_map(|(p, v)| match (p.key, v) {
        ("k" | "c", Value::Real(x)) => Some(x),
        _ => None,
    })
}

fn span(value: Option<f64>) -> Span {
    value.filter(|v| v.is_finite()).map_or(Span::EMPTY, Span::at)
}

fn ratio(outcome: &Outcome, series: &Series<'_>, i: usize) -> Option<f64> {
    ratio_of(outcome, series, i, outcome.detection.judged.tolerance(i)?)
}

/// The deviation of the sample at `i` in units of `of`.
#[inline]
fn ratio_of(outcome: &Outcome, series: &Series<'_>, i: usize, of: f64) -> Option<f64> {
    let ratio = (series.y.get(i)? - outcome.detection.judged.expected().get(i)?) / of;
    (of > 0.0 && ratio.is_finite()).then_some(ratio)
}

/// Around an expected value by a tolerance.
#[inline]
fn band(expected: f64, tolerance: f64) -> Span {
    let (low, high) = (expected - tolerance, expected + tolerance);
    if tolerance > 0.0 && low.is_finite() && high.is_finite() { Span { low, high } } else { Span::EMPTY }
}

/// A good residual for the edge of a plot: the threshold lies between a quarter and half of the way out, and the edge
/// stays put while the threshold moves within a factor of two.
#[must_use]
pub fn residual_top(threshold: f64) -> f64 {
    let octave = (threshold / 2.5).log2().floor();
    let top = 10.0 * octave.exp2();
    if top.is_finite() && top > 0.0 { top } else { 10.0 }
}

/// How a mark is shown.
#[must_use]
pub fn state(mark: &Mark) -> Option<FlagState> {
    match (mark.ruling, mark.verdict) {
        (Some(Ruling::Normal), _) => Some(FlagState::Rejected),
        (Some(Ruling::Outlier), Verdict::Outlier | Verdict::Suspect) => Some(FlagState::Accepted),
        (Some(Ruling::Outlier), _) => Some(FlagState::ByHand),
        (None, Verdict::Outlier) => Some(FlagState::Unreviewed),
        (None, Verdict::Suspect) => Some(FlagState::Suspect),
        (None, _) => None,
    }
}

#[cfg(test)]
mod tests;
