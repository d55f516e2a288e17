//! Detection: the [`Method`] trait, what a method sees and says, and the registry [`METHODS`].
//!
//! Adding a method: write `method/your_method.rs` with a unit struct that implements [`Method`], and add it to
//! [`METHODS`]. The panel, `--set`, sessions, `wildpoint methods`, the README table and the contract tests follow.

use std::borrow::Cow;
use std::ops::Range;

use rayon::prelude::*;

use crate::param::{Param, Settings};
use crate::stop::{Stop, Stopped};
use crate::track::Series;

pub mod adaptive;
pub mod alpha_beta_gamma;
pub mod chauvenet;
pub mod diff_median;
pub mod five_point;
pub mod gesd;
pub mod grubbs;
pub mod hampel;
pub mod kalman;
pub mod matched;
pub mod mean_window;
pub mod median_window;
pub mod noise;
pub mod odd_even;
pub mod poly_window;
pub mod predictor;
pub mod romanovsky;
pub mod shared;
pub mod template;
mod trend;
pub mod trend_wright;
pub mod two_sided;
mod window;
pub mod wright;

/// Every method, in the order in which lists show them.
pub static METHODS: &[&dyn Method] = &[
    &wright::Wright,
    &trend_wright::TrendWright,
    &chauvenet::Chauvenet,
    &romanovsky::Romanovsky,
    &grubbs::Grubbs,
    &gesd::Gesd,
    &odd_even::OddEven,
    &mean_window::MeanWindow,
    &median_window::MedianWindow,
    &hampel::Hampel,
    &poly_window::PolyWindow,
    &template::Template,
    &five_point::FivePoint,
    &alpha_beta_gamma::AlphaBetaGamma,
    &adaptive::Adaptive,
    &matched::Matched,
    &diff_median::DiffMedian,
    &two_sided::TwoSided,
    &kalman::Kalman,
];

/// The method with this id.
#[must_use]
pub fn find(id: &str) -> Option<&'static dyn Method> {
    METHODS.iter().copied().find(|m| m.about().id == id)
}

/// Where a channel is cut under these settings.
#[must_use]
pub fn segments(series: &Series<'_>, settings: &Settings) -> Vec<Range<usize>> {
    series.segments(settings.whole_or_off(shared::MAX_GAP.key))
}

/// Judges a whole channel, segment by segment: one entry for each sample of `series`, nothing carried over a cut.
///
/// # Errors
/// [`Stopped`] as soon as nobody waits for the result any more.
pub fn judge_channel(
    method: &dyn Method,
    series: &Series<'_>,
    rate: Option<Rate<'_>>,
    settings: &Settings,
    stop: &Stop,
) -> Result<Judged, Stopped> {
    let ranges = segments(series, settings);
    let scales = noise::scales(series, &ranges, settings);
    judge_segments(method, series, (&ranges, &scales), rate, settings, stop)
}

/// [`judge_channel`] where the segments and their scales are known.
///
/// # Errors
/// [`Stopped`] as soon as nobody waits for the result any more.
pub fn judge_segments(
    method: &dyn Method,
    series: &Series<'_>,
    (ranges, scales): (&[Range<usize>], &[noise::Scales]),
    rate: Option<Rate<'_>>,
    settings: &Settings,
    stop: &Stop,
) -> Result<Judged, Stopped> {
    let judge = |(range, scales): (&Range<usize>, &noise::Scales)| {
        stop.check()?;
        method.judge(&Segment::of(series, range, *scales, rate), settings, stop)
    };
    // Segments are judged in any order and put together in theirs: the number of threads changes nothing.
    let parts: Vec<Judged> = ranges.par_iter().zip(scales).map(judge).collect::<Result<_, _>>()?;
    let mut parts = parts.into_iter();
    let mut whole = parts.next().unwrap_or_default();
    parts.for_each(|part| whole.append(part));
    Ok(whole)
}

/// A way to find wild points: a pure function from the samples of one segment and settings to verdicts.
pub trait Method: Sync {
    /// What it is and which knobs it has.
    fn about(&self) -> &'static About;

    /// Judges one segment. The same input gives the same bits, on any number of threads.
    ///
    /// # Errors
    /// [`Stopped`] as soon as nobody waits for the result any more.
    fn judge(&self, segment: &Segment<'_>, settings: &Settings, stop: &Stop) -> Result<Judged, Stopped>;

    /// The key of the multiplier that only gates: with other settings the same, [`Judged::scale`] and
    /// [`Judged::expected`] do not depend on it, and [`Judged::gate`] gives what [`Method::judge`] would.
    fn gate(&self, settings: &Settings) -> Option<&'static str> {
        let _ = settings;
        None
    }

    /// True when, under these settings, it judges the channels of a record together: those that have this method
    /// with these same settings.
    fn together(&self, settings: &Settings) -> bool {
        let _ = settings;
        false
    }

    /// Judges several channels together, where [`Method::together`] says so: one entry for each channel.
    ///
    /// # Errors
    /// [`Stopped`] as soon as nobody waits for the result any more.
    fn judge_together(
        &self,
        channels: &[&Series<'_>],
        settings: &Settings,
        stop: &Stop,
    ) -> Result<Vec<Together>, Stopped> {
        let _ = (channels, settings, stop);
        Ok(Vec::new())
    }

    /// What the method's document puts in place of the outliers (`own` repair): one value for each sample of
    /// `outliers` (positions in the segment, ascending, after the analyst's decisions), NaN where it puts nothing.
    fn own_repair(&self, segment: &Segment<'_>, settings: &Settings, judged: &Judged, outliers: &[usize]) -> Vec<f64> {
        let _ = (segment, settings);
        let own = |&i: &usize| {
            let put_in = judged.own.get(i).copied().filter(|v| v.is_finite());
            put_in.or_else(|| judged.expected.get(i).copied()).unwrap_or(f64::NAN)
        };
        match self.about().own {
            Own::Remove => vec![f64::NAN; outliers.len()],
            Own::Expected => outliers.iter().map(own).collect(),
        }
    }

    /// Facts that help to choose these settings, one line each.
    fn notes(&self, settings: &Settings) -> Vec<String> {
        let _ = settings;
        Vec::new()
    }

    /// What the user should know about these settings: that they cannot flag anything, say. One line each.
    fn warnings(&self, settings: &Settings) -> Vec<String> {
        let _ = settings;
        Vec::new()
    }
}

/// What is said of one of several channels that were judged together.
#[derive(Debug, Clone)]
pub struct Together {
    /// Where the channel is cut, in its own positions: where the channels together are.
    pub segments: Vec<Range<usize>>,
    /// The scales of each segment.
    pub scales: Vec<noise::Scales>,
    /// One entry for each of the channel's own present samples.
    pub judged: Judged,
}

/// What a method is.
#[derive(Debug)]
pub struct About {
    /// The id of `--method` and the session file.
    pub id: &'static str,
    /// Its name in the literature.
    pub name: &'static str,
    /// The group under which lists show it.
    pub family: &'static str,
    /// Document and section or equation it comes from; `beyond` where it is none of the five.
    pub source: &'static str,
    /// What it is for, how many samples it wants, what it misses: a few lines.
    pub advice: &'static str,
    /// Its knobs.
    pub params: &'static [Param],
    /// What its `own` repair is, unless it has one of its own.
    pub own: Own,
    /// True when it needs a second channel that measures the rate of the first.
    pub needs_rate: bool,
}

/// What the default of [`Method::own_repair`] puts in place of an outlier.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Own {
    /// Nothing: the cell stays empty.
    Remove,
    /// The expected value.
    Expected,
}

/// What a method sees: the present samples of one segment, never empty.
#[derive(Debug, Clone, Copy)]
pub struct Segment<'a> {
    /// Times in seconds, strictly increasing.
    pub t: &'a [f64],
    /// Values, finite, as many.
    pub y: &'a [f64],
    /// Nominal interval of the whole channel in seconds; NaN when the channel has one sample.
    pub interval: f64,
    /// Noise scale by the setting `sigma`, at least [`Segment::floor`]; 0 when it counts as zero (section 1 of the
    /// methods page), and for methods without that setting.
    pub sigma: f64,
    /// Lower bound on any scale, by the setting `floor`; 0 when there is none.
    pub floor: f64,
    /// The present samples of the rate channel, over the whole record.
    pub rate: Option<Rate<'a>>,
}

/// The present samples of a channel that measures the rate of the judged one, per second.
#[derive(Debug, Clone, Copy)]
pub struct Rate<'a> {
    /// Times in seconds, strictly increasing.
    pub t: &'a [f64],
    /// Values, finite, as many.
    pub y: &'a [f64],
}

impl<'a> Segment<'a> {
    /// The segment of `series` that `range` names.
    #[must_use]
    pub fn of(series: &'a Series<'_>, range: &Range<usize>, scales: noise::Scales, rate: Option<Rate<'a>>) -> Self {
        Self {
            t: &series.t[range.clone()],
            y: &series.y[range.clone()],
            interval: series.interval,
            sigma: scales.sigma,
            floor: scales.floor,
            rate,
        }
    }

    /// How many samples it has.
    #[must_use]
    pub fn len(&self) -> usize {
        self.y.len()
    }

    /// True when it has none.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.y.is_empty()
    }

    /// Samples lost just before sample `i`; 0 for the first.
    #[must_use]
    pub fn lost_before(&self, i: usize) -> usize {
        if i == 0 { 0 } else { crate::track::lost_samples(self.t[i] - self.t[i - 1], self.interval) }
    }

    /// What counts as a scale of zero here: `8 * 2^-52 * max|y|`.
    #[must_use]
    pub fn zero(&self) -> f64 {
        zero_scale(self.y)
    }

    /// A scale measured in this segment: taken as 0 when it is at most `zero`, and then at least the floor.
    #[must_use]
    #[inline]
    pub fn bounded(&self, scale: f64, zero: f64) -> f64 {
        if scale > zero { scale.max(self.floor) } else { self.floor }
    }
}

/// A scale of at most this counts as zero among such values: what rounding alone leaves of an exact line.
#[must_use]
pub fn zero_scale(y: &[f64]) -> f64 {
    8.0 * f64::EPSILON * y.iter().fold(0.0_f64, |m, v| m.max(v.abs()))
}

/// What is said of one sample.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Verdict {
    /// The target can have produced it.
    Normal,
    /// The target cannot have produced it.
    Outlier,
    /// Only one direction objects: perhaps a real change of the trajectory.
    Suspect,
    /// Too few neighbours to judge.
    Unchecked,
    /// No value, or no time.
    Missing,
}

impl Verdict {
    /// All of them.
    pub const ALL: [Self; 5] = [Self::Normal, Self::Outlier, Self::Suspect, Self::Unchecked, Self::Missing];

    /// Its word in files and on the screen.
    #[must_use]
    pub fn word(self) -> &'static str {
        match self {
            Self::Normal => "normal",
            Self::Outlier => "outlier",
            Self::Suspect => "suspect",
            Self::Unchecked => "unchecked",
            Self::Missing => "missing",
        }
    }
}

/// What one direction of a two-directional test says of a sample.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Direction {
    /// The extrapolation agrees.
    Normal,
    /// It does not.
    Abnormal,
    /// There was no extrapolation.
    Unjudged,
}

impl Direction {
    /// Its word in files and on the screen.
    #[must_use]
    pub fn word(self) -> &'static str {
        match self {
            Self::Normal => "normal",
            Self::Abnormal => "abnormal",
            Self::Unjudged => "unjudged",
        }
    }
}

/// Which way a test runs through the record.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Way {
    /// With time.
    Forward,
    /// Against time.
    Backward,
}

/// A model that was lost and started again: a change of the trajectory, or a patch longer than `max_run`.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Restart {
    /// Position of the first sample of the run at which the model was lost.
    pub at: usize,
    /// The direction it ran in.
    pub way: Way,
}

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

    /// Verdicts from expected values and scales for a multiplier `k`: tolerance `k * scale`; a sample without an
    /// expected value is unchecked, one with a zero scale normal.
    #[must_use]
    pub fn gated(y: &[f64], expected: Vec<f64>, scale: Vec<f64>, k: f64) -> Self {
        let mut judged = Self { expected, scale, ..Self::default() };
        judged.gate(y, k);
        judged
    }

    /// Judges again from [`Judged::scale`] with another multiplier.
    pub fn gate(&mut self, y: &[f64], k: f64) {
        self.tolerance.clear();
        self.tolerance.extend(self.scale.iter().map(|s| k * s));
        self.verdict.clear();
        self.verdict.extend(y.iter().zip(&self.expected).zip(&self.tolerance).map(|((&y, &p), &h)| {
            if p.is_nan() {
                Verdict::Unchecked
            } else if reaches((y - p).abs(), h) {
                Verdict::Outlier
            } else {
                Verdict::Normal
            }
        }));
    }

    /// The same scores gated with another multiplier.
    #[must_use]
    pub fn regated(&self, y: &[f64], k: f64) -> Self {
        let mut judged = Self {
            expected: self.expected.clone(),
            scale: self.scale.clone(),
            directions: self.directions.clone(),
            repair_code: self.repair_code.clone(),
            own: self.own.clone(),
            restarts: self.restarts.clone(),
            warnings: self.warnings.clone(),
            ..Self::default()
        };
        judged.gate(y, k);
        judged
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
        let offset = self.verdict.len();
        self.verdict.append(&mut next.verdict);
        self.expected.append(&mut next.expected);
        self.tolerance.append(&mut next.tolerance);
        self.scale.append(&mut next.scale);
        self.directions.append(&mut next.directions);
        self.repair_code.append(&mut next.repair_code);
        self.own.append(&mut next.own);
        self.restarts.extend(next.restarts.into_iter().map(|r| Restart { at: r.at + offset, ..r }));
        for warning in next.warnings {
            if !self.warnings.contains(&warning) {
                self.warnings.push(warning);
            }
        }
    }
}

fn part<T: Clone>(all: &[T], range: &Range<usize>) -> Vec<T> {
    all.get(range.clone()).map(<[T]>::to_vec).unwrap_or_default()
}

/// Equal to within this fraction of a limit is a tie (values on a grid sit exactly on limits; rounding must not
/// decide).
pub const TIE: f64 = 1e-9;

/// True when `deviation` reaches `limit`: a tie reaches. Never for a limit that is zero, negative or not finite.
#[must_use]
#[inline]
pub fn reaches(deviation: f64, limit: f64) -> bool {
    limit > 0.0 && limit.is_finite() && deviation >= limit * (1.0 - TIE)
}

/// True when `deviation` exceeds `limit`: a tie does not exceed.
#[must_use]
#[inline]
pub fn exceeds(deviation: f64, limit: f64) -> bool {
    deviation > limit * (1.0 + TIE)
}
