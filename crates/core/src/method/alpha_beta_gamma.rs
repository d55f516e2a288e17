//! Alpha-beta-gamma filter: section 4 of `docs/methods.md`, \[001\] eqs. (23)-(26).

use super::predictor::{self, Answer, Batch, Model, Prediction, RateLimit, Rules, passed_over_by_fourth};
use super::{About, Filter, Judged, Method, Own, Segment, Way, reaches, shared};
use crate::math::gains::{self, Gains};
use crate::param::{Kind, Param, Settings, Step, Value, always};
use crate::stop::{Stop, Stopped};

mod filtered;
mod spread;

use spread::Spread;

/// A constant-acceleration tracker with growing memory, then steady gains.
pub struct AlphaBetaGamma;

static PARAMS: &[Param] = &[
    K,
    ALPHA,
    shared::SIGMA,
    shared::MAX_RUN,
    shared::MAX_RATE,
    shared::LOOK_BACK,
    shared::MAX_GAP,
    shared::FLOOR,
    shared::DOUBT,
];

const K: Param = shared::K.with_default(Value::Real(3.0));

const ALPHA: Param = Param {
    key: "alpha",
    help: "steady gain of the position: larger follows manoeuvres, smaller smooths and finds smaller outliers",
    unit: "",
    kind: Kind::Real { min: 0.02, max: 0.95, step: Step::Add(0.01) },
    default: Value::Real(0.4),
    paper: None,
    matters: always,
};

static ABOUT: About = About {
    id: "alpha-beta-gamma",
    name: "alpha-beta-gamma filter",
    family: "real-time predictor",
    source: "[001] section 3, eqs. (23)-(26)",
    advice: "Accelerating tracks in real time: it predicts a parabola, so it needs slower sampling than five-point. \
             [001] finds it best of the real-time methods on outliers that vary from sample to sample. Needs about a \
             dozen good samples before its gains are steady. Outliers below k / sqrt(1 - alpha) sigma are missed, and \
             a manoeuvre faster than the gains follow is flagged.",
    params: PARAMS,
    own: Own::Expected,
    needs_rate: false,
};

impl Method for AlphaBetaGamma {
    fn about(&self) -> &'static About {
        &ABOUT
    }

    fn judge(&self, segment: &Segment<'_>, settings: &Settings, stop: &Stop) -> Result<Judged, Stopped> {
        if segment.sigma <= 0.0 {
            return Judged::unchecked_many(segment.len(), stop);
        }
        let rules = Rules::of(settings);
        let model = |way| {
            let mut tracker = Tracker::new(segment.sigma, settings.real(ALPHA.key), &rules);
            tracker.spread_until = last_gap(segment, way);
            tracker
        };
        predictor::judge_both_ways(model, segment, rules.max_run, rules.look_back, stop)
    }

    fn filter(&self, _: &Settings) -> Option<&'static dyn Filter> {
        Some(&filtered::State)
    }

    fn warnings(&self, settings: &Settings) -> Vec<String> {
        predictor::cannot_flag(&Rules::of(settings))
    }
}

/// The time, in the order of the run, of the last sample before which samples are lost.
fn last_gap(segment: &Segment<'_>, way: Way) -> f64 {
    let lost = |i: &usize| segment.lost_before(*i) > 0;
    let gap = match way {
        Way::Forward => (1..segment.len()).rev().find(lost).map(|i| segment.t[i]),
        Way::Backward => (1..segment.len()).find(lost).map(|i| -segment.t[i - 1]),
    };
    gap.unwrap_or(f64::NEG_INFINITY)
}

/// The model: fed sample by sample by a [`predictor::Engine`].
#[derive(Debug, Clone)]
pub struct Tracker {
    sigma: f64,
    k: f64,
    alpha: f64,
    rate: RateLimit,
    t: f64,
    /// Position, velocity and acceleration: estimated, or predicted between `predict` and `answer`.
    state: [f64; 3],
    spread: Spread,
    /// From this time on nothing is lost, and the spread is not asked for.
    spread_until: f64,
    /// Samples taken in, those of the exact parabola included.
    used: usize,
    /// Step to the sample that was predicted last.
    step: f64,
    /// Gains for that sample.
    gains: Gains,
    /// Deviation of the innovation at these gains, in noise scales: 1 / sqrt(1 - a).
    deviation: f64,
    /// Steady already.
    steady: bool,
    prediction: Prediction,
}

impl Tracker {
    /// A model with the steady gain `alpha` that judges by the noise scale `sigma`, in the units of the channel.
    #[must_use]
    pub fn new(sigma: f64, alpha: f64, rules: &Rules) -> Self {
        Self {
            sigma,
            k: rules.k,
            alpha,
            rate: RateLimit::new(rules.max_rate),
            t: f64::NAN,
            state: [0.0; 3],
            spread: Spread::default(),
            spread_until: f64::INFINITY,
            used: 0,
            step: f64::NAN,
            gains: gains::steady(alpha),
            deviation: f64::NAN,
            steady: false,
            prediction: Prediction { expected: f64::NAN, tolerance: f64::NAN },
        }
    }

    #[inline]
    fn coast(&mut self, t: f64) {
        let h = t - self.t;
        let [p, u, s] = self.state;
        let half = 0.5 * h * h;
        self.state = [p + (u * h + s * half), u + s * h, s];
        (self.t, self.step) = (t, h);
        if !self.steady {
            self.gains = gains::at(self.used + 1, self.alpha);
            self.deviation = 1.0 / (1.0 - self.gains.a).sqrt();
            self.steady = self.gains == gains::steady(self.alpha);
        }
    }

    #[inline]
    fn update(&mut self, y: f64) {
        let r = y - self.state[0];
        let per_step = 1.0 / self.step;
        let gain = [self.gains.a, self.gains.b * per_step, self.gains.g * per_step * per_step];
        for (x, k) in self.state.iter_mut().zip(gain) {
            *x += k * r;
        }
        if self.t < self.spread_until {
            self.spread.step(self.step, Some(gain));
        }
        self.used += 1;
    }
}

impl Model for Tracker {
    type Sample = f64;
    type Prediction = Prediction;

    fn group(&self) -> usize {
        5
    }

    fn passed_over(&self, group: &[(f64, f64)]) -> usize {
        passed_over_by_fourth(group, shared::START_LIMIT * self.sigma)
    }

    fn start(&mut self, group: &[(f64, f64)]) {
        let &[first, second, third, ref rest @ ..] = group else { return };
        // The exact parabola through three samples, at the third, by divided differences.
        let (x1, x2) = (first.0 - third.0, second.0 - third.0);
        let (v1, v2) = ((first.1 - third.1) / x1, (second.1 - third.1) / x2);
        let half = (v1 - v2) / (x1 - x2);
        self.state = [third.1, v2 - half * x2, 2.0 * half];
        self.spread = Spread::of_parabola(x1, x2);
        self.t = third.0;
        self.used = 3;
        self.steady = false;
        for &(t, y) in rest {
            self.coast(t);
            self.update(y);
        }
        group.iter().for_each(|&(t, y)| self.rate.accept(t, y));
    }

    #[inline]
    fn predict(&mut self, t: f64, lost: usize, _: usize) {
        self.coast(t);
        let a = self.gains.a;
        let spread = if lost > 0 {
            // The steady gains know nothing of a longer step: the spread they imply has grown over it.
            (1.0 + self.spread.position_after(self.step).max(a / (1.0 - a))).sqrt()
        } else {
            self.deviation
        };
        self.prediction = Prediction { expected: self.state[0], tolerance: self.k * self.sigma * spread };
    }

    fn prediction(&self) -> &Prediction {
        &self.prediction
    }

    #[inline]
    fn answer(&mut self, t: f64, y: f64) -> Answer {
        let Prediction { expected, tolerance } = self.prediction;
        if reaches((y - expected).abs(), tolerance) || self.rate.broken(t, y) {
            self.spread.step(self.step, None);
            return Answer::Rejects;
        }
        self.update(y);
        self.rate.accept(t, y);
        Answer::Accepts
    }
}

impl Batch for Tracker {
    fn take_in(&mut self, t: &[f64], y: &[f64], whole: f64, said: &mut [Prediction]) -> usize {
        if !self.steady || self.rate.is_set() {
            return 0;
        }
        let (Gains { a, b, g }, tolerance) = (self.gains, self.k * self.sigma * self.deviation);
        // In registers: through memory each sample would wait for the one before it to be written.
        let ([mut p, mut u, mut s], mut last) = (self.state, self.t);
        let mut taken = 0;
        for ((&t, &y), said) in t.iter().zip(y).zip(said) {
            let h = t - last;
            let half = 0.5 * h * h;
            let expected = p + (u * h + s * half);
            let r = y - expected;
            if h >= whole || reaches(r.abs(), tolerance) {
                break;
            }
            let per_step = 1.0 / h;
            let gain = [a, b * per_step, g * per_step * per_step];
            (p, u, s) = (expected + gain[0] * r, (u + s * h) + gain[1] * r, s + gain[2] * r);
            if t < self.spread_until {
                self.spread.step(h, Some(gain));
            }
            *said = Prediction { expected, tolerance };
            (last, self.step) = (t, h);
            taken += 1;
        }
        (self.state, self.t) = ([p, u, s], last);
        self.used += taken;
        taken
    }
}
