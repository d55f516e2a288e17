//! A result made ready for drawing, on the worker thread.

use std::sync::Arc;

use super::{Flag, FlagState, Histogram, Pyramid, Span};
use crate::method::Verdict;
use crate::param::Value;
use crate::review::Ruling;
use crate::session::{Mark, Outcome};
use crate::track::Series;

/// An outcome with all that a frame needs of it.
#[derive(Debug, Clone)]
pub struct Drawn {
    /// The outcome.
    pub outcome: Arc<Outcome>,
    /// True for each sample that is an outlier: the curve is that of the others.
    pub hidden: Vec<bool>,
    /// Extremes of the kept samples.
    pub kept: Pyramid,
    /// The residual in the units of the panel at which a sample is flagged: the multiplier of the scale where the
    /// method has one, and the residual is in scales; otherwise 1, and it is in tolerances.
    pub threshold: f64,
    /// Extremes of the residual in the units of the panel.
    pub ratios: Pyramid,
    /// How often which residual occurs, in the units of the panel.
    pub histogram: Histogram,
    /// Extremes of the expected value.
    pub expected: Pyramid,
    /// Extremes of the tolerance band.
    pub band: Pyramid,
    /// Extremes of the repaired values.
    pub repaired: Pyramid,
    /// Extremes of the record after repair.
    pub after: Pyramid,
    /// Positions in the order of the queue: outliers, suspects and decisions, by time.
    pub positions: Vec<u32>,
}

impl Drawn {
    /// Arranges `outcome` of `series`.
    #[must_use]
    pub fn new(outcome: Outcome, series: &Series<'_>) -> Self {
        let n = series.len();
        let mut hidden = vec![false; n];
        outcome.outliers.iter().for_each(|&i| hidden[i] = true);
        let positions = outcome.marks.iter().map(|m| m.position).collect();
        let empty = Pyramid::default;
        let threshold = multiplier(&outcome).unwrap_or(1.0);
        let mut drawn = Self {
            threshold,
            outcome: Arc::new(outcome),
            hidden,
            kept: empty(),
            ratios: empty(),
            histogram: Histogram::default(),
            expected: empty(),
            band: empty(),
            repaired: empty(),
            after: empty(),
            positions,
        };
        let of = &drawn;
        let ((kept, ratios, histogram), ((expected, band), (repaired, after))) = rayon::join(
            || {
                let kept = Pyramid::build(&series.y, |i| of.hidden[i]);
                let ratios = Pyramid::build_spans(n, |i| of.residual(series, i).map_or(Span::EMPTY, Span::at));
                let histogram = Histogram::new(residual_top(threshold), |i| of.residual(series, i), &of.hidden);
                (kept, ratios, histogram)
            },
            || {
                let expected = Pyramid::build_spans(n, |i| of.expected_span(i));
                let band = Pyramid::build_spans(n, |i| of.band_span(i));
                let repaired = Pyramid::build_spans(n, |i| of.repaired_span(i));
                let after = Pyramid::build_spans(n, |i| of.after_span(series, i));
                ((expected, band), (repaired, after))
            },
        );
        (drawn.kept, drawn.ratios, drawn.histogram) = (kept, ratios, histogram);
        (drawn.expected, drawn.band) = (expected, band);
        (drawn.repaired, drawn.after) = (repaired, after);
        drawn
    }

    /// The expected value of a sample, for drawing.
    #[must_use]
    pub fn expected_span(&self, i: usize) -> Span {
        span(self.outcome.detection.judged.expected.get(i).copied())
    }

    /// Expected value minus tolerance to expected value plus tolerance.
    #[must_use]
    pub fn band_span(&self, i: usize) -> Span {
        let judged = &self.outcome.detection.judged;
        match (judged.expected.get(i), judged.tolerance.get(i)) {
            (Some(p), Some(h)) if *h > 0.0 && (p + h).is_finite() && (p - h).is_finite() => {
                Span { low: p - h, high: p + h }
            }
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
        ratio(&self.outcome, series, position).map(|ratio| ratio * self.threshold)
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
    let judged = &outcome.detection.judged;
    let (p, h) = (*judged.expected.get(i)?, *judged.tolerance.get(i)?);
    let ratio = (series.y.get(i)? - p) / h;
    (h > 0.0 && ratio.is_finite()).then_some(ratio)
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
