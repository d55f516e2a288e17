//! Five-point linear prediction: section 4 of `docs/methods.md`, \[001\] section 3.

use super::predictor::{self, Answer, Batch, Model, Prediction, RateLimit, Rules, passed_over_by_fourth};
use super::verdict::TIE;
use super::window::LineUpTo;
use super::{About, Filter, Judged, Method, Own, Segment, reaches, shared};
use crate::math::line_of_five::{AHEAD, LANES, LineOfFive};
use crate::param::{Param, Settings, Value};
use crate::stop::{Stop, Stopped};

/// The least-squares line through the last five samples, extended to the next.
pub struct FivePoint;

static PARAMS: &[Param] = &[
    K,
    shared::SIGMA,
    shared::MAX_RUN,
    shared::MAX_RATE,
    shared::LOOK_BACK,
    shared::MAX_GAP,
    shared::FLOOR,
    shared::DOUBT,
];

const K: Param = shared::K.with_default(Value::Real(3.0));

static ABOUT: About = About {
    id: "five-point",
    name: "five-point linear prediction",
    family: "real-time predictor",
    source: "[001] section 3, eqs. (20)-(22)",
    advice: "Isolated outliers in real time, at the least cost: [001] calls it the best choice for them and better \
             than alpha-beta-gamma. Needs five good samples to start and sampling fast enough that five of them lie \
             on a line to within the noise. A run shorter than max_run is found as long as the track stays \
             straight over it; outliers below about 4 sigma that vary from sample to sample are missed.",
    params: PARAMS,
    own: Own::Expected,
    needs_rate: false,
};

impl Method for FivePoint {
    fn about(&self) -> &'static About {
        &ABOUT
    }

    fn judge(&self, segment: &Segment<'_>, settings: &Settings, stop: &Stop) -> Result<Judged, Stopped> {
        if segment.sigma <= 0.0 {
            return Judged::unchecked_many(segment.len(), stop);
        }
        let rules = Rules::of(settings);
        let model = |_| Line::new(segment.sigma, &rules);
        predictor::judge_both_ways(model, segment, rules.max_run, rules.look_back, stop)
    }

    fn filter(&self, _: &Settings) -> Option<&'static dyn Filter> {
        Some(&LineUpTo { points: Some(5), least: 5, deviation: true })
    }

    fn warnings(&self, settings: &Settings) -> Vec<String> {
        predictor::cannot_flag(&Rules::of(settings))
    }
}

/// The model: fed sample by sample by a [`predictor::Engine`].
#[derive(Debug, Clone)]
pub struct Line {
    line: LineOfFive,
    sigma: f64,
    k: f64,
    rate: RateLimit,
    prediction: Prediction,
}

impl Line {
    /// A model that judges by the noise scale `sigma`, in the units of the channel.
    #[must_use]
    pub fn new(sigma: f64, rules: &Rules) -> Self {
        Self {
            line: LineOfFive::default(),
            sigma,
            k: rules.k,
            rate: RateLimit::new(rules.max_rate),
            prediction: Prediction { expected: f64::NAN, tolerance: f64::NAN },
        }
    }
}

impl Model for Line {
    type Sample = f64;
    type Prediction = Prediction;

    fn group(&self) -> usize {
        5
    }

    fn passed_over(&self, group: &[(f64, f64)]) -> usize {
        passed_over_by_fourth(group, shared::START_LIMIT * self.sigma)
    }

    fn start(&mut self, group: &[(f64, f64)]) {
        for &(t, y) in group {
            self.line.push(t, y);
            self.rate.accept(t, y);
        }
    }

    #[inline]
    fn predict(&mut self, t: f64, _: usize, _: usize) {
        let (expected, variance) = self.line.at(t);
        self.prediction = Prediction { expected, tolerance: self.k * self.sigma * (1.0 + variance).sqrt() };
    }

    fn prediction(&self) -> &Prediction {
        &self.prediction
    }

    #[inline]
    fn answer(&mut self, t: f64, y: f64) -> Answer {
        let Prediction { expected, tolerance } = self.prediction;
        if reaches((y - expected).abs(), tolerance) || self.rate.broken(t, y) {
            self.line.push(t, expected);
            return Answer::Rejects;
        }
        self.line.push(t, y);
        self.rate.accept(t, y);
        Answer::Accepts
    }
}

impl Line {
    /// What is predicted of the next this many samples, should each of them be accepted; true when each is for certain.
    #[inline]
    fn all_agree(&self, t: &[f64; AHEAD], y: &[f64; AHEAD], said: &mut [Prediction; AHEAD]) -> bool {
        let scale = self.k * self.sigma;
        // By how much a sample reaches over its limit, at worst: as [`reaches`] for every tolerance that is positive,
        // and never less. To ask what kind of number it is, or to branch, would take the lanes apart.
        let mut worst = [f64::NEG_INFINITY; LANES];
        self.line.ahead(t, y, |s, expected, variance| {
            let mut tolerance = [0.0; LANES];
            for lane in 0..LANES {
                tolerance[lane] = scale * (1.0 + variance[lane]).sqrt();
                let over = (y[5 * lane + s] - expected[lane]).abs() - tolerance[lane] * (1.0 - TIE);
                worst[lane] = if over > worst[lane] { over } else { worst[lane] };
            }
            for lane in 0..LANES {
                said[5 * lane + s] = Prediction { expected: expected[lane], tolerance: tolerance[lane] };
            }
        });
        worst.iter().all(|over| *over < 0.0)
    }
}

impl Batch for Line {
    fn take_in(&mut self, t: &[f64], y: &[f64], _: f64, said: &mut [Prediction]) -> usize {
        if self.rate.is_set() {
            return 0;
        }
        let mut at = 0;
        while at < y.len() {
            let (rest_t, rest_y) = (t[at..].first_chunk::<AHEAD>(), y[at..].first_chunk::<AHEAD>());
            let said_ahead = said[at..].first_chunk_mut::<AHEAD>();
            if let (true, Some(times), Some(values), Some(said)) = (self.line.in_order(), rest_t, rest_y, said_ahead) {
                if self.all_agree(times, values, said) {
                    self.line.push_all(times, values);
                    at += AHEAD;
                    continue;
                }
                let agrees = |(y, p): &(&f64, &Prediction)| !reaches((*y - p.expected).abs(), p.tolerance);
                let taken = values.iter().zip(&*said).take_while(agrees).count();
                (0..taken).for_each(|i| self.line.push(times[i], values[i]));
                return at + taken;
            }
            self.predict(t[at], 0, 0);
            let Prediction { expected, tolerance } = self.prediction;
            if reaches((y[at] - expected).abs(), tolerance) {
                return at;
            }
            said[at] = self.prediction;
            self.line.push(t[at], y[at]);
            at += 1;
        }
        at
    }
}
