//! Threshold advice beside the active knob: the counts along the multiplier, found on a thread of its own.

use std::sync::Arc;

use crossbeam_channel::Sender;

use super::message::Message;
use super::model::Model;
use crate::error::{Error, Result};
use crate::job::Worker;
use crate::session::Setup;
use crate::session::sweep::{FROM, STEPS, Sweep, TO, grid, multiplier, sweep};
use crate::stop::Stop;
use crate::track::{Samples, Track};

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

/// A sweep to make.
#[derive(Debug)]
pub struct Advise {
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
        Self {
            track: Arc::clone(&model.track),
            plan,
            channel: model.channels[plan].channel,
            samples: Arc::clone(&model.channels[plan].samples),
            setup: model.session.plans[plan].setup.clone(),
        }
    }

    /// Makes it.
    ///
    /// # Errors
    /// [`Error::Stopped`]; [`Error::Usage`] for a method without a multiplier that matters.
    pub fn run(&self, stop: &Stop) -> Result<Advice> {
        let param = multiplier(&self.setup)?;
        let values = grid(FROM, TO, STEPS, true)?;
        let channel = &self.track.channels[self.channel];
        let sweep = sweep(&self.track, channel, &self.samples, &self.setup, (param, &values), stop)?;
        Ok(Advice { setup: self.setup.clone(), sweep })
    }
}

/// A worker that makes sweeps and sends what comes out; what cannot be swept is not spoken of.
#[must_use]
pub fn advise(results: Sender<Message>) -> Worker<Advise> {
    Worker::new(move |_, job: Advise, stop: &Stop| match job.run(stop) {
        Ok(advice) => {
            let _ = results.send(Message::Advised { plan: job.plan, advice: Box::new(advice) });
        }
        Err(Error::Stopped) => {}
        Err(_) => {
            let _ = results.send(Message::NoAdvice);
        }
    })
}
