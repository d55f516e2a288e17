//! Detection: the [`Method`] trait, what a method sees and says, and the registry [`METHODS`].
//!
//! Adding a method: write `method/your_method.rs` with a unit struct that implements [`Method`], and add it to
//! [`METHODS`]. The panel, `--set`, sessions, `wildpoint methods`, the README table and the contract tests follow.

use std::ops::Range;

use rayon::prelude::*;

use crate::calibration::stretches;
use crate::math::pieces;
use crate::param::{Param, Settings};
use crate::series::Series;
use crate::stop::{Stop, Stopped};

pub mod adaptive;
pub mod alpha_beta_gamma;
pub mod chauvenet;
pub mod consensus;
pub mod diff_median;
pub mod filtered;
pub mod five_point;
mod gated;
pub mod gesd;
pub mod grubbs;
pub mod hampel;
mod judged;
pub mod kalman;
mod local;
pub mod matched;
pub mod mean_window;
pub mod median_window;
pub mod noise;
pub mod odd_even;
pub mod poly_window;
pub mod predictor;
pub mod romanovsky;
mod segment;
pub mod shared;
pub mod template;
mod trend;
pub mod trend_wright;
pub mod two_sided;
mod verdict;
mod window;
pub mod wright;

pub use filtered::{Filter, Filtered, Settled};
pub use gated::{Gated, Record};
pub use judged::{Damaged, Directions, Judged, Part};
pub use segment::{Rate, Segment, zero_scale, zero_scale_of_many};
pub use verdict::{Direction, Restart, TIE, Verdict, Way, exceeds, reaches};

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
    &consensus::Consensus,
];

/// The method with this id.
#[must_use]
pub fn find(id: &str) -> Option<&'static dyn Method> {
    METHODS.iter().copied().find(|m| m.about().id == id)
}

/// The methods that judge by themselves: those that may be asked about one record side by side.
pub fn voting() -> impl Iterator<Item = &'static dyn Method> {
    METHODS.iter().copied().filter(|m| !m.asks_others())
}

/// Where a channel is cut under these settings.
///
/// # Errors
/// [`Stopped`] as soon as nobody waits for it any more.
pub fn segments(series: &Series<'_>, settings: &Settings, stop: &Stop) -> Result<Vec<Range<usize>>, Stopped> {
    let max_gap = settings.whole_or_off(shared::MAX_GAP.key);
    if noise::by_calibration(settings) {
        stop.check()?;
        return Ok(stretches(&series.t, max_gap));
    }
    series.segments_unless(max_gap, &|| stop.check())
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
    let ranges = segments(series, settings, stop)?;
    let scales = noise::scales(series, &ranges, settings, stop)?;
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
        let segment = Segment::of(series, range, scales, rate);
        let counted = settings.has_durations().then(|| settings.at_interval(segment.interval));
        let settings = counted.as_ref().unwrap_or(settings);
        judge_segment(method, &segment, settings, stop)
    };
    // Segments are judged in any order and put together in theirs: the number of threads changes nothing.
    let parts: Vec<Judged> = ranges.par_iter().zip(scales).map(judge).collect::<Result<_, _>>()?;
    let mut parts = parts.into_iter();
    let mut whole = parts.next().unwrap_or_default();
    parts.try_for_each(|part| whole.append(part, stop))?;
    Ok(whole)
}

/// Judges one segment, with no tolerance below the floor of its sample.
fn judge_segment(
    method: &dyn Method,
    segment: &Segment<'_>,
    settings: &Settings,
    stop: &Stop,
) -> Result<Judged, Stopped> {
    let judged = method.judge(segment, settings, stop)?;
    // What others said is bounded.
    let judged = if method.asks_others() { judged } else { local::bounded_below(judged, segment, settings, stop)? };
    judged.bounded(stop)
}

/// A way to find wild points: a pure function from the samples of one segment and settings to verdicts.
pub trait Method: Sync {
    /// What it is and which parameters it has.
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

    /// True when it judges by what other methods say: then it does not vote itself.
    fn asks_others(&self) -> bool {
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

    /// What the method's document puts in place of the outliers (`own` repair): one value for each of
    /// [`Damaged::outliers`], NaN where it puts nothing.
    ///
    /// # Errors
    /// [`Stopped`] as soon as nobody waits for the result any more.
    fn own_repair(&self, damaged: &Damaged<'_>, stop: &Stop) -> Result<Vec<f64>, Stopped> {
        let Damaged { judged, outliers, .. } = *damaged;
        let own = |n: usize| {
            let put_in = judged.own.get(outliers[n]).copied().filter(|v| v.is_finite());
            put_in.or_else(|| judged.expected.get(outliers[n]).copied()).unwrap_or(f64::NAN)
        };
        pieces::collect(outliers.len(), &|| stop.check(), |n| match self.about().own {
            Own::Remove => f64::NAN,
            Own::Expected => own(n),
        })
    }

    /// The model that smooths the track under these settings; none where the method has no model of it.
    fn filter(&self, settings: &Settings) -> Option<&'static dyn Filter> {
        let _ = settings;
        None
    }

    /// What should be known of the `own` repair of these outliers, one line each.
    fn own_notes(&self, damaged: &Damaged<'_>) -> Vec<String> {
        let _ = damaged;
        Vec::new()
    }

    /// Facts that help to choose these settings, one line each.
    fn notes(&self, settings: &Settings) -> Vec<String> {
        let _ = settings;
        Vec::new()
    }

    /// What the user should know about these settings: for example that they cannot flag anything. One line each.
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
    /// Its parameters.
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
