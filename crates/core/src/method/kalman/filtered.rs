//! The filtered track, the final product of \[004\] (figure 3): the state after each sample of the last run.

use super::PATCH;
use super::filter::{Filter, Tuning};
use super::single::START_SCALES;
use crate::method::filtered::{self, Course, Entry, Estimator, Filtered, Settled, follow};
use crate::method::predictor::passed_over_by_third;
use crate::method::{Damaged, shared};
use crate::param::Settings;
use crate::stop::{Stop, Stopped};

/// The model of the method.
pub(super) struct State;

impl filtered::Filter for State {
    fn about(&self) -> &'static str {
        "state of the filter after the sample; runs of outliers that are filled enter by their fill"
    }

    fn run(&self, settled: &Settled<'_>, stop: &Stop) -> Result<Filtered, Stopped> {
        let Damaged { segment, settings, .. } = settled.damaged;
        if segment.sigma <= 0.0 {
            return Ok(Filtered::none(segment.len()));
        }
        let tuning = Tuning::of(settings, segment.sigma, segment.interval);
        let entries = entries(settled, settings);
        let course = Course {
            t: segment.t,
            entries: &entries,
            interval: segment.interval,
            restarts: settled.restarts,
            look_back: settings.switch(shared::LOOK_BACK.key),
        };
        follow(|| Following { tuning, filter: Filter::default(), t: f64::NAN }, &course, stop)
    }
}

/// What the filter gets: the fill of runs of `patch` and more outliers, nothing of the others.
fn entries(settled: &Settled<'_>, settings: &Settings) -> Vec<Entry> {
    let Damaged { segment, outliers, judged, .. } = settled.damaged;
    let mut entries: Vec<Entry> = segment.y.iter().map(|y| Entry::Value(*y)).collect();
    outliers.iter().for_each(|&i| entries[i] = Entry::Nothing);
    let patch = settings.whole(PATCH.key);
    for run in outliers.iter().zip(settled.own).collect::<Vec<_>>().chunk_by(|a, b| a.0 + 1 == *b.0) {
        // A run that grew in the second run of the filter has predictions beside what was filled in.
        let filled = |i: usize, own: f64| own.is_finite() && judged.expected.get(i).is_none_or(|p| *p != own);
        for &(&i, &own) in run.iter().filter(|(i, own)| run.len() >= patch && filled(**i, **own)) {
            entries[i] = Entry::Value(own);
        }
    }
    entries
}

/// A filter that is updated with the samples it is given, and judges none.
struct Following {
    tuning: Tuning,
    filter: Filter,
    t: f64,
}

impl Estimator for Following {
    fn group(&self) -> usize {
        self.tuning.group()
    }

    fn passed_over(&self, group: &[(f64, f64)]) -> usize {
        passed_over_by_third(group, START_SCALES * self.tuning.sigma)
    }

    fn start(&mut self, group: &[(f64, f64)]) {
        let &[.., a, b, c, d] = group else { return };
        self.filter = Filter::start(&[a, b, c, d], &self.tuning);
        self.t = d.0;
    }

    fn predict(&mut self, t: f64, lost: usize) {
        self.filter.predict(t - self.t, lost.saturating_add(1), &self.tuning);
        self.t = t;
    }

    fn take_in(&mut self, y: f64) {
        self.filter.update(y, &self.tuning);
    }

    fn estimate(&self) -> [f64; 2] {
        [self.filter.expected(), self.filter.variance().sqrt()]
    }
}
