//! Advice beside the active parameter, found on a thread of its own: what one step either way changes, and the counts
//! along the multiplier.

use std::sync::Arc;

use crossbeam_channel::Sender;

use super::message::Message;
use super::model::Model;
use crate::error::{Error, Result};
use crate::job::Worker;
use crate::session::sweep::{Sweep, multiplier, sweep, usual_values};
use crate::session::{Detection, Setup};
use crate::stop::Stop;
use crate::track::{Samples, Track};

mod steps;

pub(super) use steps::StepsJob;
pub use steps::{Step, Steps};

/// On records up to this length the advice comes by itself; on longer ones it is asked for, since 48 judgements take
/// a while.
pub const BY_ITSELF: usize = 400_000;

/// Advice that is there, and what it was found for.
#[derive(Debug, Clone, PartialEq)]
pub struct Advice {
    /// The setup; its multiplier does not matter.
    pub setup: Setup,
    /// The counts.
    pub sweep: Sweep,
}

impl Advice {
    /// True when it holds for a setup: the same but for the multiplier and the repair.
    #[must_use]
    pub fn is_for(&self, setup: &Setup) -> bool {
        let mut settings = self.setup.settings.clone();
        let same_multiplier = settings
            .get(self.sweep.key)
            .and(setup.settings.get(self.sweep.key))
            .is_some_and(|v| settings.set(self.sweep.key, self.sweep.key, v).is_ok());
        let own = Setup { settings, ..self.setup.clone() };
        same_multiplier && own.same_detection(setup)
    }
}

/// What to find out: what one step of the active parameter changes, and the sweep where it is wanted.
#[derive(Debug)]
pub struct Advise {
    steps: Option<(StepsJob, Arc<Detection>)>,
    wants_sweep: bool,
    track: Arc<Track>,
    plan: usize,
    channel: usize,
    samples: Arc<Samples>,
    setup: Setup,
}

impl Advise {
    /// The job for a plan of the model as it is now.
    #[must_use]
    pub fn new(model: &Model, plan: usize) -> Self {
        let (state, setup) = (&model.channels[plan], &model.session.plans[plan].setup);
        let known = state.advice.as_ref().is_some_and(|a| a.is_for(setup));
        let cheap = state.drawn.as_ref().is_some_and(|d| d.hidden.len() <= BY_ITSELF);
        Self {
            steps: StepsJob::beside(model, plan),
            wants_sweep: !known && (cheap || state.sweep_asked) && multiplier(setup).is_ok(),
            track: Arc::clone(&model.track),
            plan,
            channel: model.channels[plan].channel,
            samples: Arc::clone(&model.channels[plan].samples),
            setup: model.session.plans[plan].setup.clone(),
        }
    }

    /// Whether it is asked what a step changes.
    #[must_use]
    pub fn has_steps(&self) -> bool {
        self.steps.is_some()
    }

    /// What one step either way changes; none where the active parameter has no bearing on the flags.
    ///
    /// # Errors
    /// [`Error::Stopped`], and what the method cannot do under the settings.
    pub fn steps(&self, stop: &Stop) -> Result<Option<Steps>> {
        self.steps.as_ref().map(|(job, now)| job.run(now, stop)).transpose()
    }

    /// Makes the sweep.
    ///
    /// # Errors
    /// [`Error::Stopped`]; [`Error::Usage`] for a method without a multiplier that matters.
    pub fn run(&self, stop: &Stop) -> Result<Advice> {
        let param = multiplier(&self.setup)?;
        let channel = &self.track.channels[self.channel];
        let sweep = sweep(&self.track, channel, &self.samples, &self.setup, (param, &usual_values(param)), stop)?;
        Ok(Advice { setup: self.setup.clone(), sweep })
    }

    /// Tells what is found as it is found; what cannot be swept is not spoken of.
    pub fn answer(&self, stop: &Stop, mut tell: impl FnMut(Message)) {
        // Whoever waits for an answer gets one.
        match self.steps(stop) {
            Ok(Some(steps)) => tell(Message::Stepped { plan: self.plan, steps: Box::new(steps) }),
            Err(Error::Stopped) => return,
            Err(_) => tell(Message::NoAdvice),
            Ok(None) => {}
        }
        if !self.wants_sweep {
            return;
        }
        match self.run(stop) {
            Ok(advice) => tell(Message::Advised { plan: self.plan, advice: Box::new(advice) }),
            Err(Error::Stopped) => {}
            Err(_) => tell(Message::NoAdvice),
        }
    }
}

/// A worker that finds advice and sends what comes out.
#[must_use]
pub fn advise(results: Sender<Message>) -> Worker<Advise> {
    Worker::new(move |_, job: Advise, stop: &Stop| {
        job.answer(stop, |message| {
            let _ = results.send(message);
        });
    })
}
