//! The state of the tracker after each sample.

use super::{ALPHA, Tracker};
use crate::method::Damaged;
use crate::method::filtered::{Course, Entry, Estimator, Filter, Filtered, Settled, follow};
use crate::method::predictor::{Model, Rules};
use crate::stop::{Stop, Stopped};

/// The model of the method.
pub(super) struct State;

impl Filter for State {
    fn about(&self) -> &'static str {
        "position of the filter after the sample"
    }

    fn run(&self, settled: &Settled<'_>, stop: &Stop) -> Result<Filtered, Stopped> {
        let Damaged { segment, settings, outliers, .. } = settled.damaged;
        if segment.sigma <= 0.0 {
            return Ok(Filtered::none(segment.len()));
        }
        // A flagged sample enters as its prediction: the state stays what was predicted.
        let mut entries: Vec<Entry> = segment.y.iter().map(|y| Entry::Value(*y)).collect();
        outliers.iter().for_each(|&i| entries[i] = Entry::Nothing);
        let rules = Rules::of(settings);
        let course = Course {
            t: segment.t,
            entries: &entries,
            interval: segment.interval,
            restarts: settled.restarts,
            look_back: rules.look_back,
        };
        follow(|| Tracker::new(segment.sigma, settings.real(ALPHA.key), &rules), &course, stop)
    }
}

impl Estimator for Tracker {
    fn group(&self) -> usize {
        Model::group(self)
    }

    fn passed_over(&self, group: &[(f64, f64)]) -> usize {
        Model::passed_over(self, group)
    }

    fn start(&mut self, group: &[(f64, f64)]) {
        Model::start(self, group);
    }

    fn predict(&mut self, t: f64, _: usize) {
        self.coast(t);
    }

    fn take_in(&mut self, y: f64) {
        self.update(y);
    }

    fn pass(&mut self) {
        self.spread.step(self.step, None);
    }

    fn estimate(&self) -> [f64; 2] {
        [self.state[0], self.sigma * self.spread.position_after(0.0).sqrt()]
    }
}
