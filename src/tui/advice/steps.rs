//! What one step of the active parameter, up or down, does to the flags.

use std::ops::Range;
use std::sync::Arc;

use crate::error::Result;
use crate::math::pieces;
use crate::method::Verdict;
use crate::param::Value;
use crate::review::Decisions;
use crate::session::{Detection, Setup};
use crate::stop::{Stop, Stopped};
use crate::track::{Samples, Track};
use crate::tui::jobs::Judge;
use crate::tui::model::{Knob, Model};

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

/// What one step of a parameter changes, up and down; none where the range ends.
#[derive(Debug, Clone, PartialEq)]
pub struct Steps {
    /// The setup they start from.
    setup: Setup,
    /// The parameter.
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
    /// True when they are those of this parameter under this setup.
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
    track: Arc<Track>,
    channel: usize,
    samples: Arc<Samples>,
    up: Option<(Value, Judge)>,
    down: Option<(Value, Judge)>,
}

impl StepsJob {
    /// The job for the active parameter of a plan; none when the parameter has no bearing on the flags, when there is
    /// no result to compare with, or when the answer is there.
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
        Some(Self {
            setup: setup.clone(),
            key: param.key,
            track: Arc::clone(&model.track),
            channel: state.channel,
            samples: Arc::clone(&state.samples),
            up: judge(1),
            down: judge(-1),
        })
    }

    /// Does it, compared with what the method says `now`.
    pub(in crate::tui) fn run(&self, now: &Detection, stop: &Stop) -> Result<Steps> {
        let step = |to: &Option<(Value, Judge)>| -> Result<Option<Step>> {
            let Some((value, judge)) = to else { return Ok(None) };
            let there = judge.detection(stop)?;
            let (gained, lost) = (self.rows(now, &there, stop)?, self.rows(&there, now, stop)?);
            Ok(Some(Step { value: *value, gained, lost }))
        };
        Ok(Steps { setup: self.setup.clone(), key: self.key, up: step(&self.up)?, down: step(&self.down)? })
    }

    /// Rows of the samples that are flagged in `to` and not in `from`.
    fn rows(&self, from: &Detection, to: &Detection, stop: &Stop) -> std::result::Result<Vec<u32>, Stopped> {
        let series = self.samples.series(&self.track.channels[self.channel], &self.track.time);
        let (from, to) = (from.judged.verdict(), to.judged.verdict());
        let row = |at: usize| u32::try_from(series.row(at)).unwrap_or(u32::MAX);
        let new = |piece: Range<usize>| {
            let new = piece.filter(|&at| from[at] != Verdict::Outlier && to[at] == Verdict::Outlier);
            new.map(row).collect::<Vec<u32>>()
        };
        Ok(pieces::map(from.len().min(to.len()), &|| stop.check(), new)?.concat())
    }
}
