//! Five-point prediction with an adaptive limit: section 4 of `docs/methods.md`, \[001\] eqs. (27)-(34).

use super::predictor::{self, Answer, Batch, Model, Prediction, RateLimit, Rules, passed_over_by_fourth};
use super::window::LineUpTo;
use super::{About, Filter, Judged, Method, Own, Segment, reaches, shared};
use crate::math::huber::{HuberScale, Update};
use crate::math::line_of_five::LineOfFive;
use crate::param::{Kind, Paper, Param, Settings, Step, Value, always};
use crate::stop::{Stop, Stopped};

/// The line through the last five samples, judged by the Huber scale of the latest prediction residuals.
pub struct Adaptive;

static PARAMS: &[Param] = &[
    K,
    WINDOW,
    HUBER_C,
    UPDATE,
    shared::SIGMA,
    shared::MAX_RUN,
    shared::MAX_RATE,
    shared::LOOK_BACK,
    shared::MAX_GAP,
    shared::FLOOR,
    shared::DOUBT,
];

const K: Param = shared::K.with_default(Value::Real(3.5)).with_paper(Some(Paper::printed(
    Value::Real(1.5),
    "[001] decides at its C of 1.5 sigma, which flags one good sample in ten and more",
)));

const WINDOW: Param = Param {
    key: "window",
    help: "how many of the latest prediction residuals make the scale",
    unit: "samples",
    kind: Kind::Whole { min: 16, max: 100, step: 1 },
    default: Value::Whole(30),
    paper: Some(Paper::open(Value::Whole(20), "[001] gives 16 to 30: the upper end has the steadiest scale")),
    matters: always,
};

const HUBER_C: Param = Param {
    key: "huber_c",
    help: "residuals beyond this many sigma are clipped in the scale; k = c gives the printed decision rule, \
           with about 10 % false alarms",
    unit: "sigma",
    kind: Kind::Real { min: 0.5, max: 5.0, step: Step::Add(0.1) },
    default: Value::Real(1.5),
    paper: None,
    matters: always,
};

const UPDATE: Param = Param {
    key: "update",
    help: "winsor: residuals beyond c sigma count as c sigma; printed: eq. (34), biased low, it can stop changing (1.5 \
           to 2 % false alarms on clean noise)",
    unit: "",
    kind: Kind::Choice(&["winsor", "printed"]),
    default: Value::Word("winsor"),
    paper: Some(Paper::printed(Value::Word("printed"), "eq. (34) takes too small a scale, and freezes it")),
    matters: always,
};

static ABOUT: About = About {
    id: "adaptive",
    name: "five-point prediction with adaptive limit",
    family: "real-time predictor",
    source: "[001] section 3, eqs. (27)-(34)",
    advice: "Noise that changes along the track, in real time: the limit follows the latest residuals. [001] finds it \
             most effective on runs and best where isolated, constant and varying outliers mix; in our simulation \
             of its experiment this holds only without a run limit, as printed, and then most good samples are \
             flagged. Needs window good samples before it measures its own scale. \
             A run of outliers raises the scale it is judged by, so the end of a long one is missed.",
    params: PARAMS,
    own: Own::Expected,
    needs_rate: false,
};

impl Method for Adaptive {
    fn about(&self) -> &'static About {
        &ABOUT
    }

    fn judge(&self, segment: &Segment<'_>, settings: &Settings, stop: &Stop) -> Result<Judged, Stopped> {
        if segment.sigma <= 0.0 {
            return Judged::unchecked_many(segment.len(), stop);
        }
        let rules = Rules::of(settings);
        let model = |_| AdaptiveLine::new(segment.sigma, segment.floor, settings, &rules);
        predictor::judge_both_ways(model, segment, rules.max_run, rules.look_back, stop)
    }

    fn filter(&self, _: &Settings) -> Option<&'static dyn Filter> {
        Some(&LineUpTo { points: Some(5), least: 5, deviation: false })
    }

    fn warnings(&self, settings: &Settings) -> Vec<String> {
        let mut lines = predictor::cannot_flag(&Rules::of(settings));
        let (k, c) = (settings.real(shared::K.key), settings.real(HUBER_C.key));
        if k <= c {
            lines.push(format!("k = {k} is not above huber_c = {c}: about one good sample in ten is flagged"));
        }
        lines
    }
}

/// Squared deviation of a five-point prediction residual on even steps: 1 + (16 + 1 + 4 + 25 + 64) / 100.
const EVEN_VARIANCE: f64 = 2.1;

/// The model: fed sample by sample by a [`predictor::Engine`].
#[derive(Debug, Clone)]
pub struct AdaptiveLine {
    line: LineOfFive,
    sigma: f64,
    k: f64,
    rate: RateLimit,
    scale: HuberScale,
    /// What the residual of the sample predicted last is multiplied by to count as one on even steps.
    to_even: f64,
    prediction: Prediction,
}

impl AdaptiveLine {
    /// A model that starts from the noise scale `sigma`; no scale it finds is below `floor`. Both in the units of
    /// the channel.
    #[must_use]
    pub fn new(sigma: f64, floor: f64, settings: &Settings, rules: &Rules) -> Self {
        let update = if settings.word(UPDATE.key) == "printed" { Update::Printed } else { Update::Winsor };
        let even = EVEN_VARIANCE.sqrt();
        Self {
            line: LineOfFive::default(),
            sigma,
            k: rules.k,
            rate: RateLimit::new(rules.max_rate),
            scale: HuberScale::new(
                settings.whole(WINDOW.key),
                settings.real(HUBER_C.key),
                update,
                sigma * even,
                floor * even,
            ),
            to_even: 1.0,
            prediction: Prediction { expected: f64::NAN, tolerance: f64::NAN },
        }
    }
}

impl Model for AdaptiveLine {
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
        self.scale.reset();
    }

    #[inline(always)]
    fn predict(&mut self, t: f64, _: usize, _: usize) {
        let (expected, variance) = self.line.at(t);
        self.to_even = (EVEN_VARIANCE / (1.0 + variance)).sqrt();
        self.prediction = Prediction { expected, tolerance: self.k * self.scale.advance() / self.to_even };
    }

    fn prediction(&self) -> &Prediction {
        &self.prediction
    }

    #[inline(always)]
    fn answer(&mut self, t: f64, y: f64) -> Answer {
        let Prediction { expected, tolerance } = self.prediction;
        let residual = y - expected;
        self.scale.push(residual * self.to_even);
        if reaches(residual.abs(), tolerance) || self.rate.broken(t, y) {
            self.line.push(t, expected);
            return Answer::Rejects;
        }
        self.line.push(t, y);
        self.rate.accept(t, y);
        Answer::Accepts
    }
}

// Each scale comes from the one before: nothing is gained by many at a time.
impl Batch for AdaptiveLine {}
