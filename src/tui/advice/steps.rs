//! What one step of the active knob, up or down, does to the flags.

use std::sync::Arc;

use crate::error::Result;
use crate::method::Verdict;
use crate::param::Value;
use crate::review::Decisions;
use crate::session::{Detection, Setup};
use crate::stop::Stop;
use crate::tui::model::{Knob, Model};
use crate::tui::office::Judge;

/// What a step changes.
#[derive(Debug, Clone, PartialEq)]
pub struct Step {
    /// The value it leads to.
    pub value: Value,
    /// Rows (from 0), ascending, of samples that the method flags there and not now.
    gained: Vec<u32>,
    /// Rows (from 0), ascending, of samples that it flags now and not there.
    lost: Vec<u32>,
}

/// What one step of a knob changes, up and down; none where the range ends.
#[derive(Debug, Clone, PartialEq)]
pub struct Steps {
    /// The setup they start from.
    setup: Setup,
    /// The knob.
    key: &'static str,
    /// One step up.
    pub up: Option<Step>,
    /// One step down.
    pub down: Option<Step>,
}

impl Step {
    /// How many flags are gained and lost. A sample that somebody decided on is what it was decided to be, whatever
    /// the method says.
    #[must_use]
    pub fn counts(&self, decisions: &Decisions) -> (usize, usize) {
        let decided = |rows: &[u32]| decisions.iter().filter(|(row, _)| rows.binary_search(row).is_ok()).count();
        (self.gained.len() - decided(&self.gained), self.lost.len() - decided(&self.lost))
    }
}

impl Steps {
    /// True when they are those of this knob under this setup.
    #[must_use]
    pub fn is_for(&self, setup: &Setup, knob: Knob) -> bool {
        matches!(knob, Knob::Detection(p) if p.key == self.key) && self.setup.same_detection(setup)
    }
}

/// The judgements that it takes.
#[derive(Debug)]
pub(in crate::tui) struct StepsJob {
    setup: Setup,
    key: &'static str,
    /// Row of each sample.
    rows: Vec<u32>,
    up: Option<(Value, Judge)>,
    down: Option<(Value, Judge)>,
}

impl StepsJob {
    /// The job for the active knob of a plan; none when the knob has no bearing on the flags, when there is no result
    /// to compare with, or when the answer is there.
    pub(super) fn beside(model: &Model, plan: usize) -> Option<(Self, Arc<Detection>)> {
        let state = &model.channels[plan];
        let now = Arc::clone(&state.drawn.as_ref()?.outcome.detection);
        if state.stale || !now.setup.same_detection(&model.session.plans[plan].setup) {
            return None;
        }
        Self::new(model, plan).map(|job| (job, now))
    }

    /// The same for the result that the settings as they are now will have.
    pub(in crate::tui) fn new(model: &Model, plan: usize) -> Option<Self> {
        let setup = &model.session.plans[plan].setup;
        let state = &model.channels[plan];
        let Knob::Detection(param) = model.knob_of(plan) else { return None };
        if state.steps.as_ref().is_some_and(|s| s.is_for(setup, Knob::Detection(param))) {
            return None;
        }
        let value = setup.settings.get(param.key)?;
        let judge = |steps: i64| {
            let next = param.step(value, steps);
            let mut there = setup.clone();
            there.settings.set(param.key, param.key, next).ok()?;
            (next != value).then(|| (next, Judge::under(model, plan, there)))
        };
        let series = state.samples.series(&model.track.channels[state.channel], &model.track.time);
        let rows = (0..series.len()).map(|i| u32::try_from(series.row(i)).unwrap_or(u32::MAX)).collect();
        Some(Self { setup: setup.clone(), key: param.key, rows, up: judge(1), down: judge(-1) })
    }

    /// Does it, compared with what the method says `now`.
    pub(in crate::tui) fn run(&self, now: &Detection, stop: &Stop) -> Result<Steps> {
        let step = |to: &Option<(Value, Judge)>| -> Result<Option<Step>> {
            let Some((value, judge)) = to else { return Ok(None) };
            let there = judge.detection(stop)?;
            stop.check()?;
            let rows = |from: &Detection, to: &Detection| {
                let pairs = from.judged.verdict().iter().zip(to.judged.verdict()).zip(&self.rows);
                let new = pairs.filter(|((a, b), _)| **a != Verdict::Outlier && **b == Verdict::Outlier);
                new.map(|(_, row)| *row).collect::<Vec<u32>>()
            };
            Ok(Some(Step { value: *value, gained: rows(now, &there), lost: rows(&there, now) }))
        };
        Ok(Steps { setup: self.setup.clone(), key: self.key, up: step(&self.up)?, down: step(&self.down)? })
    }
}
