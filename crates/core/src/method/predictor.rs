//! Judging sample by sample from earlier samples only: the start group, the run after which a model is lost, and
//! the restart (sections 4, 6 and 7 of `docs/methods.md`). The model itself is a [`Model`]; what is said goes to a
//! [`Sink`], where a later call may correct what an earlier one said of the same sample.

use std::ops::Range;

use crate::series::lost_samples;

mod batch;
mod look_back;
mod rules;
mod start;

pub use batch::{Batch, feed};
pub use look_back::{First, Page, judge_both_ways};
pub use rules::{RateLimit, Rules, cannot_flag};
pub use start::{passed_over_by_fourth, passed_over_by_third};

/// What a model of this kind says of a sample beside its verdict.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Prediction {
    /// Expected value.
    pub expected: f64,
    /// Tolerance about it.
    pub tolerance: f64,
}

/// What a model does with a sample that it has predicted.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Answer {
    /// It agrees: the sample enters the model.
    Accepts,
    /// It does not: the sample is an outlier and counts towards the run after which the model is lost.
    Rejects,
    /// The sample is known for an outlier and brings a value in its place, which enters the model.
    Replaces,
}

/// Extrapolates from the samples it has taken in.
pub trait Model {
    /// What is measured at one time.
    type Sample: Copy;
    /// What it says of the sample it was asked to predict.
    type Prediction;

    /// How many samples a start group has; at least 1.
    fn group(&self) -> usize;

    /// How many samples at the beginning of this would-be start group must be passed over before another group can
    /// start; 0 when the group will do. No sample is lost inside it.
    fn passed_over(&self, group: &[(f64, Self::Sample)]) -> usize;

    /// Forgets everything and starts from this group.
    fn start(&mut self, group: &[(f64, Self::Sample)]);

    /// Predicts the sample at time `t`, before which `lost` samples are missing and `run` outliers stand.
    fn predict(&mut self, t: f64, lost: usize, run: usize);

    /// What was predicted last.
    fn prediction(&self) -> &Self::Prediction;

    /// Compares the sample with the prediction made for it and takes it in, or goes on without it.
    fn answer(&mut self, t: f64, sample: Self::Sample) -> Answer;
}

/// Takes down what is said of the samples, which are counted from 0 in the order in which they came.
pub trait Sink<P> {
    /// A model has started from these samples; `again` when it is not the first.
    fn started(&mut self, group: Range<usize>, again: bool);

    /// A sample was judged; `run` outliers stand directly before it.
    fn judged(&mut self, at: usize, answer: Answer, run: usize, prediction: &P);

    /// The samples from `at` on were judged and accepted, and no outlier stands before the first of them.
    fn accepted(&mut self, at: usize, predictions: &[P]) {
        for (k, prediction) in predictions.iter().enumerate() {
            self.judged(at + k, Answer::Accepts, 0, prediction);
        }
    }

    /// The model is lost at this run of outliers. They will be judged anew as far as a new model gets hold of them.
    fn lost(&mut self, run: Range<usize>);
}

/// Runs a model over samples that come one at a time.
#[derive(Debug)]
pub struct Engine<M: Model> {
    model: M,
    /// Nominal interval in seconds.
    interval: f64,
    /// More rejected samples in a row than this lose the model; none: never.
    max_run: Option<usize>,
    /// Samples so far.
    count: usize,
    last: f64,
    /// True while there is a model.
    going: bool,
    /// True when the model that goes, or the next one, is not the first.
    again: bool,
    /// Neighbours that may become a start group.
    pending: Vec<(f64, M::Sample)>,
    /// Rejected samples in a row, the newest included.
    run: usize,
    /// Those samples, kept while they may have to be judged anew.
    rejected: Vec<(f64, M::Sample, usize)>,
    spare: Vec<(f64, M::Sample, usize)>,
}

impl<M: Model> Engine<M> {
    /// An engine that has seen nothing. `max_run` of 0 means that no run is too long.
    #[must_use]
    pub fn new(model: M, interval: f64, max_run: usize) -> Self {
        Self {
            model,
            interval,
            max_run: (max_run > 0).then_some(max_run),
            count: 0,
            last: f64::NAN,
            going: false,
            again: false,
            pending: Vec::new(),
            run: 0,
            rejected: Vec::new(),
            spare: Vec::new(),
        }
    }

    /// The model.
    pub fn model(&self) -> &M {
        &self.model
    }

    /// Whether a model goes at present.
    pub fn going(&self) -> bool {
        self.going
    }

    /// Takes the next sample. Nothing is said of a sample that waits for a start group, until there is one.
    #[inline]
    pub fn push(&mut self, t: f64, sample: M::Sample, sink: &mut impl Sink<M::Prediction>) {
        let step = t - self.last;
        let lost = if self.count == 0 { 0 } else { lost_samples(step, self.interval) };
        self.last = t;
        let at = self.count;
        self.count += 1;
        if self.feed(at, t, sample, lost, sink) {
            self.restart(at, sink);
        }
    }

    /// True when the model was lost at this sample.
    #[inline]
    fn feed(&mut self, at: usize, t: f64, sample: M::Sample, lost: usize, sink: &mut impl Sink<M::Prediction>) -> bool {
        if !self.going {
            self.wait(at, t, sample, lost, sink);
            return false;
        }
        self.model.predict(t, lost, self.run);
        let answer = self.model.answer(t, sample);
        sink.judged(at, answer, self.run, self.model.prediction());
        if answer != Answer::Rejects {
            self.run = 0;
            return false;
        }
        let Some(max_run) = self.max_run else {
            self.run += 1;
            return false;
        };
        if self.run == 0 {
            self.rejected.clear();
        }
        self.run += 1;
        self.rejected.push((t, sample, lost));
        self.run > max_run
    }

    /// Adds a sample to the would-be start group.
    fn wait(&mut self, at: usize, t: f64, sample: M::Sample, lost: usize, sink: &mut impl Sink<M::Prediction>) {
        if lost > 0 {
            self.pending.clear();
        }
        self.pending.push((t, sample));
        let size = self.model.group();
        if self.pending.len() < size {
            return;
        }
        let pass = self.model.passed_over(&self.pending);
        if pass > 0 {
            self.pending.drain(..pass.min(size));
            return;
        }
        self.model.start(&self.pending);
        sink.started(at + 1 - size..at + 1, self.again);
        self.pending.clear();
        self.going = true;
        self.run = 0;
    }

    /// Goes back to the first sample of the run that ends at `at`. The new model cannot be lost on the way: fewer
    /// samples are left for it than the run had.
    #[cold]
    fn restart(&mut self, at: usize, sink: &mut impl Sink<M::Prediction>) {
        let first = at + 1 - self.rejected.len();
        sink.lost(first..at + 1);
        self.going = false;
        self.again = true;
        self.run = 0;
        self.pending.clear();
        std::mem::swap(&mut self.rejected, &mut self.spare);
        self.rejected.clear();
        for i in 0..self.spare.len() {
            let (t, sample, lost) = self.spare[i];
            self.feed(first + i, t, sample, lost, sink);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Expects the last accepted value, within 1; a start group is two equal neighbours.
    struct Hold(f64, Prediction);

    impl Model for Hold {
        type Sample = f64;
        type Prediction = Prediction;
        fn group(&self) -> usize {
            2
        }
        fn passed_over(&self, group: &[(f64, f64)]) -> usize {
            usize::from((group[0].1 - group[1].1).abs() > 1.0)
        }
        fn start(&mut self, group: &[(f64, f64)]) {
            self.0 = group[1].1;
        }
        fn predict(&mut self, _: f64, _: usize, _: usize) {
            self.1 = Prediction { expected: self.0, tolerance: 1.0 };
        }
        fn prediction(&self) -> &Prediction {
            &self.1
        }
        fn answer(&mut self, _: f64, y: f64) -> Answer {
            if (y - self.0).abs() < 1.0 {
                self.0 = y;
                Answer::Accepts
            } else {
                Answer::Rejects
            }
        }
    }

    /// One letter for each sample.
    struct Letters(Vec<char>);

    impl Sink<Prediction> for Letters {
        fn started(&mut self, group: Range<usize>, again: bool) {
            group.for_each(|i| self.put(i, if again { 'S' } else { 's' }));
        }
        fn judged(&mut self, at: usize, answer: Answer, _: usize, _: &Prediction) {
            self.put(at, if answer == Answer::Accepts { '.' } else { 'x' });
        }
        fn lost(&mut self, run: Range<usize>) {
            run.for_each(|i| self.put(i, '?'));
        }
    }

    impl Letters {
        fn put(&mut self, at: usize, letter: char) {
            if self.0.len() <= at {
                self.0.resize(at + 1, '?');
            }
            self.0[at] = letter;
        }
    }

    fn said(max_run: usize, samples: &[(f64, f64)]) -> String {
        let mut engine = Engine::new(Hold(0.0, Prediction { expected: 0.0, tolerance: 0.0 }), 1.0, max_run);
        let mut letters = Letters(Vec::new());
        samples.iter().for_each(|&(t, y)| engine.push(t, y, &mut letters));
        letters.put(samples.len(), '|');
        letters.0.into_iter().collect()
    }

    fn even(y: &[f64]) -> Vec<(f64, f64)> {
        y.iter().enumerate().map(|(i, &y)| (i as f64, y)).collect()
    }

    #[test]
    fn a_run_that_is_too_long_is_judged_anew_from_its_first_sample() {
        let y = [9.0, 5.0, 5.0, 5.0, 30.0, 20.0, 20.0, 20.0, 40.0, 20.0];
        assert_eq!(said(3, &even(&y)), "?ss.?SS.x.|", "lost at the fourth rejected sample, index 7");
        assert_eq!(said(4, &even(&y)), "?ss.?SS.x.|", "lost at the fifth, index 8, which the new model rejects too");
        assert_eq!(said(7, &even(&y)), "?ss.xxxxxx|");
        assert_eq!(said(0, &even(&y)), "?ss.xxxxxx|", "0: never");
    }

    #[test]
    fn a_start_group_has_no_lost_sample() {
        let samples = [(0.0, 5.0), (2.0, 5.0), (3.0, 5.0), (6.0, 5.0)];
        assert_eq!(said(3, &samples), "?ss.|", "a gap after the start does no harm");
    }

    #[test]
    fn a_lost_model_without_a_new_start_leaves_the_rest_unjudged() {
        let y = [5.0, 5.0, 10.0, 20.0, 30.0, 40.0, 50.0];
        assert_eq!(said(2, &even(&y)), "ss?????|");
    }
}
