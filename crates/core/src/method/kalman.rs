//! Kalman innovation test with infill: section 7 of `docs/methods.md`, \[004\].

use super::predictor::{Engine, Page, feed};
use super::{About, Damaged, Judged, Method, Own, Segment, Together, Verdict, Way, shared};
use crate::param::{Kind, Paper, Param, Settings, Step, Value, always};
use crate::series::Series;
use crate::stop::{Stop, Stopped};

mod fill;
mod filter;
mod filtered;
mod joint;
mod passes;
mod single;

use fill::Fill;
pub use filter::{Filter, Tuning};
pub use joint::judge_joint;
use passes::{Plan, Record};
pub use single::{Measured, Single};

/// A Kalman filter whose innovations are tested; patches are filled and the filter runs again.
pub struct Kalman;

static PARAMS: &[Param] = &[
    C,
    MODEL,
    TRACKING_INDEX,
    shared::SIGMA,
    TEST,
    ALPHA,
    GATE_CAP,
    PATCH,
    FILL,
    MAX_RUN,
    shared::LOOK_BACK,
    shared::MAX_GAP,
    shared::FLOOR,
    shared::DOUBT,
];

const C: Param = shared::C.with_matters(|s| !joint(s));

const MODEL: Param = Param {
    key: "model",
    help: "what stays constant: ca, the acceleration; cv, the velocity",
    unit: "",
    kind: Kind::Choice(&["ca", "cv"]),
    default: Value::Word("ca"),
    paper: None,
    matters: always,
};

const TRACKING_INDEX: Param = Param {
    key: "tracking_index",
    help: "process noise per step times T^2 / sigma: larger follows manoeuvres; 0.1 opens the gate in two or three \
           samples and flags the good ones behind a run",
    unit: "",
    kind: Kind::Real { min: 1e-6, max: 10.0, step: Step::Times(1.122) },
    default: Value::Real(0.02),
    paper: None,
    matters: always,
};

const TEST: Param = Param {
    key: "test",
    help: "component: each channel separately; joint: all channels of a sample together, by chi square",
    unit: "",
    kind: Kind::Choice(&["component", "joint"]),
    default: Value::Word("component"),
    paper: None,
    matters: always,
};

const ALPHA: Param = Param {
    key: "alpha",
    help: "joint test: probability that a good sample is flagged",
    unit: "",
    kind: Kind::Real { min: 1e-9, max: 0.5, step: Step::Times(1.122) },
    default: Value::Real(0.0027),
    paper: None,
    matters: joint,
};

const GATE_CAP: Param = Param {
    key: "gate_cap",
    help: "while outliers follow each other the gate opens to at most this many times its width at the first \
           outlier (off: no limit)",
    unit: "",
    kind: Kind::RealOr { words: &["off"], min: 1.0, max: 1000.0 },
    default: Value::Real(2.0),
    paper: Some(Paper::printed(
        Value::Word("off"),
        "the gate of a filter that coasts opens until the run of outliers itself is let in",
    )),
    matters: always,
};

const PATCH: Param = Param {
    key: "patch",
    help: "a run of at least this many outliers is filled before the filter runs again; a shorter one keeps the prediction",
    unit: "samples",
    kind: Kind::Whole { min: 1, max: 1000, step: 1 },
    default: Value::Whole(5),
    paper: None,
    matters: always,
};

const FILL: Param = Param {
    key: "fill",
    help: "polynomial: least-squares cubic through 12 accepted samples on each side (0.5 sigma on runs of 5); \
           spline: natural cubic through 8 on each side (2.3 sigma)",
    unit: "",
    kind: Kind::Choice(&["polynomial", "spline"]),
    default: Value::Word("polynomial"),
    paper: Some(Paper::printed(Value::Word("spline"), "a spline goes through noisy samples: 2.3 sigma against 0.5")),
    matters: always,
};

const MAX_RUN: Param = shared::MAX_RUN.with_default(Value::Whole(25));

static ABOUT: About = About {
    id: "kalman",
    name: "Kalman innovation test with infill",
    family: "state estimation",
    source: "[004] steps 1-3, eqs. (1-1)-(1-6)",
    advice: "Manoeuvring tracks with isolated outliers and runs, one channel or several that fail together (test = \
             joint): [004] reports that both kinds are removed and that the fill keeps the filter on the track through a run. Needs \
             four good samples to start and a dozen on each side of a run. Outliers below c deviations are missed, \
             and runs too long to predict across (about 8) are missed entirely in a fifth of the cases.",
    params: PARAMS,
    own: Own::Expected,
    needs_rate: false,
};

fn joint(settings: &Settings) -> bool {
    settings.word("test") == "joint"
}

fn plan(settings: &Settings) -> Plan {
    Plan {
        patch: settings.whole(PATCH.key),
        fill: if settings.word(FILL.key) == "spline" { Fill::Spline } else { Fill::Polynomial },
        look_back: settings.switch(shared::LOOK_BACK.key),
    }
}

impl Method for Kalman {
    fn about(&self) -> &'static About {
        &ABOUT
    }

    fn judge(&self, segment: &Segment<'_>, settings: &Settings, stop: &Stop) -> Result<Judged, Stopped> {
        if segment.sigma <= 0.0 {
            return Judged::unchecked_many(segment.len(), stop);
        }
        let mut tuning = Tuning::of(settings, segment.sigma, segment.interval);
        if joint(settings) {
            tuning.c = joint::limit(settings, 1);
        }
        let one = One { segment, tuning, max_run: settings.whole(shared::MAX_RUN.key) };
        Ok(passes::judge(&one, &plan(settings), stop)?.pop().unwrap_or_default())
    }

    fn together(&self, settings: &Settings) -> bool {
        joint(settings)
    }

    fn judge_together(
        &self,
        channels: &[&Series<'_>],
        settings: &Settings,
        stop: &Stop,
    ) -> Result<Vec<Together>, Stopped> {
        judge_joint(channels, settings, stop)
    }

    fn own_repair(&self, damaged: &Damaged<'_>, stop: &Stop) -> Result<Vec<f64>, Stopped> {
        let Damaged { segment, settings, judged, outliers } = *damaged;
        let fill = plan(settings).fill;
        let mut accepted = vec![true; segment.len()];
        for &i in outliers {
            accepted[i] = false;
        }
        let flagged = |i: Option<usize>| i.is_some_and(|i| judged.verdict.get(i) == Some(&Verdict::Outlier));
        let mut values = Vec::with_capacity(outliers.len());
        for (n, run) in outliers.chunk_by(|a, b| a + 1 == *b).enumerate() {
            stop.check_at(4 * n)?;
            let (first, last) = (run.first().copied(), run.last().copied());
            // A run that the analyst has changed is not the one the filter went over: it is filled anew.
            let as_judged = run.iter().all(|&i| flagged(Some(i)))
                && !flagged(first.and_then(|i| i.checked_sub(1)))
                && !flagged(last.map(|i| i + 1));
            if as_judged {
                values.extend(run.iter().map(|&i| judged.own.get(i).copied().unwrap_or(f64::NAN)));
            } else {
                values.extend(fill.values(segment.t, segment.y, |i| accepted[i], run));
            }
        }
        Ok(values)
    }

    fn filter(&self, _: &Settings) -> Option<&'static dyn super::Filter> {
        Some(&filtered::State)
    }

    fn warnings(&self, settings: &Settings) -> Vec<String> {
        let mut lines = Vec::new();
        if settings.get(GATE_CAP.key) == Some(Value::Word("off")) && settings.real(TRACKING_INDEX.key) >= 0.1 {
            lines.push("gate_cap is off and tracking_index at least 0.1: the gate opens within a few samples".into());
        }
        if !settings.switch(shared::LOOK_BACK.key) {
            lines.push("look_back is off: outliers among the first four samples are not seen".into());
        }
        lines
    }
}

/// A single channel.
struct One<'a> {
    segment: &'a Segment<'a>,
    tuning: Tuning,
    max_run: usize,
}

impl Record for One<'_> {
    fn times(&self) -> &[f64] {
        self.segment.t
    }

    fn channels(&self) -> Vec<&[f64]> {
        vec![self.segment.y]
    }

    fn run(&self, filled: &[Vec<f64>], way: Way, pages: &mut [Page], stop: &Stop) -> Result<(), Stopped> {
        let y = self.segment.y;
        let Some(page) = pages.first_mut() else { return Ok(()) };
        let filled: &[f64] = filled.first().map_or(&[], Vec::as_slice);
        let sample = |i: usize| match filled.get(i).copied() {
            Some(value) if !value.is_nan() => Measured { y: value, filled: true },
            _ => Measured { y: y[i], filled: false },
        };
        let mut engine = Engine::new(Single::new(self.tuning), self.segment.interval, self.max_run);
        feed(&mut engine, self.segment.t, sample, way, page, stop)?;
        page.complete(stop)
    }
}
