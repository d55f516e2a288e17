//! The innovation test of several channels together: chi square over those that a sample has.

use std::ops::Range;

use statrs::distribution::{ChiSquared, ContinuousCDF};

use super::filter::{Filter, Tuning};
use super::passes::{self, Record};
use super::single::{Gate, START_SCALES};
use crate::math::pieces;
use crate::method::predictor::{Answer, Engine, Model, Page, Prediction, Sink, passed_over_by_third};
use crate::method::{Judged, Restart, Together, Verdict, Way, exceeds, noise, shared};
use crate::param::Settings;
use crate::series::Series;
use crate::stop::{Stop, Stopped};

/// Judges the channels of a record together (`test = joint`): a sample whose innovations fail the chi-square test is
/// an outlier in all channels that have it. Cuts and the nominal interval are those of the samples that any channel
/// has; a start needs all channels, and when the model is lost all start again. One entry per channel, each over its
/// own present samples.
///
/// # Errors
/// [`Stopped`] as soon as nobody waits for the result any more.
pub fn judge_joint(channels: &[&Series<'_>], settings: &Settings, stop: &Stop) -> Result<Vec<Together>, Stopped> {
    let times = all_times(channels, stop)?;
    let columns: Vec<Vec<f64>> = channels.iter().map(|series| on(&times, series, stop)).collect::<Result<_, _>>()?;
    let together = Series::new(&times, &times);
    let cuts = together.segments_unless(settings.whole_or_off(shared::MAX_GAP.key), &|| stop.check())?;
    let own: Vec<Vec<Range<usize>>> =
        channels.iter().map(|series| cuts.iter().map(|cut| within(series, &times[cut.clone()])).collect()).collect();
    let scales = channels.iter().zip(&own).map(|(series, ranges)| noise::scales(series, ranges, settings, stop));
    let scales: Vec<Vec<noise::Scales>> = scales.collect::<Result<_, _>>()?;
    let mut whole = vec![Judged::default(); channels.len()];
    for (s, cut) in cuts.iter().enumerate() {
        stop.check()?;
        let sigmas: Vec<f64> = scales.iter().map(|of_channel| of_channel[s].sigma).collect();
        let parts = if sigmas.iter().all(|&sigma| sigma > 0.0) {
            let tunings = sigmas.iter().map(|&sigma| Tuning::of(settings, sigma, together.interval)).collect();
            let many = Many {
                t: &times[cut.clone()],
                y: columns.iter().map(|y| &y[cut.clone()]).collect(),
                interval: together.interval,
                tunings,
                limits: (0..=channels.len()).map(|present| limit(settings, present)).collect(),
                max_run: settings.whole(shared::MAX_RUN.key),
            };
            passes::judge(&many, &super::plan(settings), stop)?
        } else {
            let nothing = Judged::unchecked_many(cut.len(), stop)?;
            vec![Judged { own: nothing.expected.clone(), ..nothing }; channels.len()]
        };
        for ((whole, part), y) in whole.iter_mut().zip(parts).zip(&columns) {
            whole.append(present(part, &y[cut.clone()], stop)?, stop)?;
        }
    }
    let parts = whole.into_iter().zip(own).zip(scales).map(|((judged, segments), scales)| {
        let (segments, scales) = segments.into_iter().zip(scales).filter(|(segment, _)| !segment.is_empty()).unzip();
        Together { segments, scales, judged }
    });
    Ok(parts.collect())
}

/// The gate in deviations when this many channels are tested together: for one it is what `c` is for it alone.
pub(super) fn limit(settings: &Settings, channels: usize) -> f64 {
    #[expect(clippy::cast_precision_loss, reason = "a few channels")]
    let freedom = channels.max(1) as f64;
    ChiSquared::new(freedom).map_or(f64::INFINITY, |chi| chi.inverse_cdf(1.0 - settings.real(super::ALPHA.key)).sqrt())
}

/// Every time that any channel has, once, in order.
fn all_times(channels: &[&Series<'_>], stop: &Stop) -> Result<Vec<f64>, Stopped> {
    let longest = channels.iter().map(|series| series.len()).max().unwrap_or(0);
    let mut times: Vec<f64> = Vec::with_capacity(longest);
    // Each channel is in order of time: the earliest that any of them has not given yet is next.
    let mut next = vec![0; channels.len()];
    loop {
        stop.check_at(times.len())?;
        let at = |(series, next): (&&Series<'_>, &usize)| series.t.get(*next).copied();
        let Some(time) = channels.iter().zip(&next).filter_map(at).reduce(f64::min) else { return Ok(times) };
        times.push(time);
        for (series, next) in channels.iter().zip(&mut next) {
            *next += usize::from(series.t.get(*next).is_some_and(|t| *t <= time));
        }
    }
}

/// The values of a channel at all these times; NaN where it has none.
fn on(times: &[f64], series: &Series<'_>, stop: &Stop) -> Result<Vec<f64>, Stopped> {
    let mut own = series.t.iter().zip(series.y.iter()).peekable();
    let mut values = Vec::with_capacity(times.len());
    for (i, time) in times.iter().enumerate() {
        stop.check_at(i)?;
        values.push(own.next_if(|(t, _)| *t == time).map_or(f64::NAN, |(_, y)| *y));
    }
    Ok(values)
}

/// Positions of the channel's samples between the first and the last of these times.
fn within(series: &Series<'_>, times: &[f64]) -> Range<usize> {
    let (Some(&first), Some(&last)) = (times.first(), times.last()) else { return 0..0 };
    series.t.partition_point(|&t| t < first)..series.t.partition_point(|&t| t <= last)
}

/// What is said of the samples that a channel has.
fn present(judged: Judged, y: &[f64], stop: &Stop) -> Result<Judged, Stopped> {
    let check = || stop.check();
    if !pieces::map(y.len(), &check, |piece| y[piece].iter().any(|y| y.is_nan()))?.contains(&true) {
        return Ok(judged);
    }
    let kept = |piece: Range<usize>| piece.filter(|&i| !y[i].is_nan()).collect::<Vec<usize>>();
    let kept = pieces::map(y.len(), &check, kept)?.concat();
    let numbers = |all: &[f64]| pieces::collect(kept.len(), &check, |i| all[kept[i]]);
    let mut verdict = vec![Verdict::Unchecked; kept.len()];
    pieces::over(&mut verdict, &check, |first, verdict| {
        verdict.iter_mut().zip(&kept[first..]).for_each(|(verdict, &i)| *verdict = judged.verdict[i]);
    })?;
    let restart = |r: &Restart| Restart { at: kept.partition_point(|&i| i < r.at), ..*r };
    Ok(Judged {
        verdict,
        expected: numbers(&judged.expected)?,
        tolerance: numbers(&judged.tolerance)?,
        own: numbers(&judged.own)?,
        restarts: judged.restarts.iter().map(restart).collect(),
        ..Judged::default()
    })
}

/// Several channels between two cuts.
struct Many<'a> {
    t: &'a [f64],
    y: Vec<&'a [f64]>,
    interval: f64,
    tunings: Vec<Tuning>,
    /// Gates by the number of channels present.
    limits: Vec<f64>,
    max_run: usize,
}

impl Record for Many<'_> {
    fn times(&self) -> &[f64] {
        self.t
    }

    fn channels(&self) -> Vec<&[f64]> {
        self.y.clone()
    }

    fn run(&self, filled: &[Vec<f64>], way: Way, pages: &mut [Page], stop: &Stop) -> Result<(), Stopped> {
        let n = self.t.len();
        let mut pages = Pages(pages);
        let mut engine = Engine::new(Joint::new(self, filled), self.interval, self.max_run);
        for at in 0..n {
            stop.check_at(at)?;
            match way {
                Way::Forward => engine.push(self.t[at], at, &mut pages),
                Way::Backward => engine.push(-self.t[n - 1 - at], n - 1 - at, &mut pages),
            }
        }
        pages.0.iter_mut().try_for_each(|page| page.complete(stop))
    }
}

/// One page per channel.
struct Pages<'a>(&'a mut [Page]);

impl Sink<Vec<Prediction>> for Pages<'_> {
    fn started(&mut self, group: Range<usize>, again: bool) {
        self.0.iter_mut().for_each(|page| page.started(group.clone(), again));
    }
    fn judged(&mut self, at: usize, answer: Answer, run: usize, predictions: &Vec<Prediction>) {
        for (page, prediction) in self.0.iter_mut().zip(predictions) {
            page.judged(at, answer, run, prediction);
        }
    }
    fn lost(&mut self, run: Range<usize>) {
        self.0.iter_mut().for_each(|page| page.lost(run.clone()));
    }
}

/// One filter per channel, one verdict for all. A sample is a position in the record.
struct Joint<'a> {
    record: &'a Many<'a>,
    filled: &'a [Vec<f64>],
    filters: Vec<Filter>,
    gates: Vec<Gate>,
    predictions: Vec<Prediction>,
    t: f64,
}

impl<'a> Joint<'a> {
    fn new(record: &'a Many<'a>, filled: &'a [Vec<f64>]) -> Self {
        let channels = record.y.len();
        Self {
            record,
            filled,
            filters: vec![Filter::default(); channels],
            gates: vec![Gate::default(); channels],
            predictions: vec![Prediction { expected: f64::NAN, tolerance: f64::NAN }; channels],
            t: f64::NAN,
        }
    }

    /// What was filled in for channel `c` of sample `i`.
    fn fill(&self, c: usize, i: usize) -> Option<f64> {
        self.filled.get(c).and_then(|values| values.get(i).copied()).filter(|value| !value.is_nan())
    }

    fn value(&self, c: usize, i: usize) -> f64 {
        self.fill(c, i).unwrap_or(self.record.y[c][i])
    }

    fn points(&self, c: usize, group: &[(f64, usize)]) -> Vec<(f64, f64)> {
        group.iter().map(|&(t, i)| (t, self.value(c, i))).collect()
    }
}

impl Model for Joint<'_> {
    type Sample = usize;
    type Prediction = Vec<Prediction>;

    fn group(&self) -> usize {
        self.record.tunings.iter().map(Tuning::group).max().unwrap_or(1)
    }

    fn passed_over(&self, group: &[(f64, usize)]) -> usize {
        let of_channel = |(c, tuning): (usize, &Tuning)| {
            let points = self.points(c, group);
            let missing = points.iter().rposition(|(_, y)| y.is_nan());
            missing.map_or_else(|| passed_over_by_third(&points, START_SCALES * tuning.sigma), |at| at + 1)
        };
        self.record.tunings.iter().enumerate().map(of_channel).max().unwrap_or(0)
    }

    fn start(&mut self, group: &[(f64, usize)]) {
        for c in 0..self.filters.len() {
            let &[.., a, b, d, e] = self.points(c, group).as_slice() else { return };
            self.filters[c] = Filter::start(&[a, b, d, e], &self.record.tunings[c]);
            self.t = e.0;
        }
    }

    fn predict(&mut self, t: f64, lost: usize, run: usize) {
        for ((filter, gate), tuning) in self.filters.iter_mut().zip(&mut self.gates).zip(&self.record.tunings) {
            filter.predict(t - self.t, lost.saturating_add(1), tuning);
            gate.open(filter.innovation_variance(tuning).sqrt(), run, tuning.cap);
        }
        self.t = t;
    }

    fn prediction(&self) -> &Vec<Prediction> {
        &self.predictions
    }

    fn answer(&mut self, _: f64, i: usize) -> Answer {
        let present = self.record.y.iter().filter(|y| !y[i].is_nan()).count();
        let limit = self.record.limits[present];
        let mut square = 0.0;
        for c in 0..self.filters.len() {
            let (expected, tolerance) = (self.filters[c].expected(), limit * self.gates[c].deviation);
            self.predictions[c] = Prediction { expected, tolerance };
            let ratio = (self.record.y[c][i] - expected) / tolerance;
            if !ratio.is_nan() {
                square += ratio * ratio;
            }
        }
        let filled = (0..self.filters.len()).any(|c| self.fill(c, i).is_some());
        if !filled && exceeds(square.sqrt(), 1.0) {
            self.gates.iter_mut().for_each(Gate::reject);
            return Answer::Rejects;
        }
        for c in 0..self.filters.len() {
            let y = if filled { self.fill(c, i).unwrap_or(f64::NAN) } else { self.record.y[c][i] };
            if !y.is_nan() {
                self.filters[c].update(y, &self.record.tunings[c]);
            }
        }
        if filled { Answer::Replaces } else { Answer::Accepts }
    }
}
