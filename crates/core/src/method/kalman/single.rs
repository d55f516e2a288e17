//! The innovation test of one channel, sample by sample (steps 1 to 3 of section 7).

use super::filter::{Filter, Tuning};
use crate::method::exceeds;
use crate::method::predictor::{Answer, Batch, Model, Prediction, passed_over_by_third};

/// A sample, or what stands in its place once it is known for an outlier.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Measured {
    /// The value.
    pub y: f64,
    /// True when the value was filled in.
    pub filled: bool,
}

/// The model: fed sample by sample by a [`crate::method::predictor::Engine`].
#[derive(Debug, Clone)]
pub struct Single {
    tuning: Tuning,
    filter: Filter,
    t: f64,
    gate: Gate,
    prediction: Prediction,
}

/// The deviation by which innovations are judged: that of the filter, held down while outliers follow each other.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Gate {
    /// Deviation for the sample at hand.
    pub(super) deviation: f64,
    /// Deviation at the first outlier of the run.
    first: f64,
    run: usize,
}

impl Gate {
    /// The deviation for a sample before which `run` outliers stand, when the filter's own is `deviation`.
    #[inline]
    pub(super) fn open(&mut self, deviation: f64, run: usize, cap: Option<f64>) {
        self.run = run;
        self.deviation = match cap {
            Some(cap) if run > 0 => deviation.min(cap * self.first),
            _ => deviation,
        };
    }

    /// The sample is an outlier.
    #[inline]
    pub(super) fn reject(&mut self) {
        if self.run == 0 {
            self.first = self.deviation;
        }
    }
}

/// Start groups accept third differences up to this many noise scales.
pub(super) const START_SCALES: f64 = 9.0;

impl Single {
    /// A model of this tuning.
    #[must_use]
    pub fn new(tuning: Tuning) -> Self {
        Self {
            tuning,
            filter: Filter::default(),
            t: f64::NAN,
            gate: Gate::default(),
            prediction: Prediction { expected: f64::NAN, tolerance: f64::NAN },
        }
    }

    /// The estimated value after the sample taken in last.
    #[must_use]
    pub fn estimate(&self) -> f64 {
        self.filter.expected()
    }
}

impl Model for Single {
    type Sample = Measured;
    type Prediction = Prediction;

    fn group(&self) -> usize {
        self.tuning.group()
    }

    fn passed_over(&self, group: &[(f64, Measured)]) -> usize {
        let points: Vec<(f64, f64)> = group.iter().map(|(t, m)| (*t, m.y)).collect();
        passed_over_by_third(&points, START_SCALES * self.tuning.sigma)
    }

    fn start(&mut self, group: &[(f64, Measured)]) {
        let &[a, b, c, d] = group else { return };
        self.filter = Filter::start(&[(a.0, a.1.y), (b.0, b.1.y), (c.0, c.1.y), (d.0, d.1.y)], &self.tuning);
        self.t = d.0;
    }

    #[inline]
    fn predict(&mut self, t: f64, lost: usize, run: usize) {
        self.filter.predict(t - self.t, lost.saturating_add(1), &self.tuning);
        self.t = t;
        self.gate.open(self.filter.innovation_variance(&self.tuning).sqrt(), run, self.tuning.cap);
        self.prediction =
            Prediction { expected: self.filter.expected(), tolerance: self.tuning.c * self.gate.deviation };
    }

    fn prediction(&self) -> &Prediction {
        &self.prediction
    }

    #[inline]
    fn answer(&mut self, _: f64, sample: Measured) -> Answer {
        if sample.filled {
            self.filter.update(sample.y, &self.tuning);
            return Answer::Replaces;
        }
        if exceeds((sample.y - self.prediction.expected).abs(), self.prediction.tolerance) {
            self.gate.reject();
            return Answer::Rejects;
        }
        self.filter.update(sample.y, &self.tuning);
        Answer::Accepts
    }
}

impl Batch for Single {
    fn take_in(&mut self, t: &[f64], samples: &[Measured], whole: f64, said: &mut [Prediction]) -> usize {
        // In registers: through memory each sample would wait for the one before it to be written.
        let (tuning, mut filter, mut last) = (self.tuning, self.filter, self.t);
        let mut taken = 0;
        for ((&t, sample), said) in t.iter().zip(samples).zip(said) {
            let h = t - last;
            let mut ahead = filter;
            ahead.predict(h, 1, &tuning);
            let expected = ahead.expected();
            let tolerance = tuning.c * ahead.innovation_variance(&tuning).sqrt();
            if sample.filled || h >= whole || exceeds((sample.y - expected).abs(), tolerance) {
                break;
            }
            ahead.update(sample.y, &tuning);
            (filter, last) = (ahead, t);
            *said = Prediction { expected, tolerance };
            taken += 1;
        }
        (self.filter, self.t) = (filter, last);
        taken
    }
}
