//! What smooths a result, worked out beside the screen: the residual of eq. (2) of \[000\] before and after the repair,
//! and the track that the method's model makes of the channel.

use std::sync::Arc;

use crossbeam_channel::Sender;

use super::message::Message;
use super::model::Model;
use crate::error::Result;
use crate::job::Worker;
use crate::plot::FilteredTrack;
use crate::score::{SplineResidual, spline_residual};
use crate::session::Outcome;
use crate::stop::Stop;
use crate::track::{Samples, Track};

/// What is worked out about a result, and for which one.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Question {
    /// Index of the plan.
    plan: usize,
    /// Number of the result.
    result: u64,
    /// True when the filtered track is wanted too.
    track: bool,
}

/// The answer.
#[derive(Debug, Clone)]
pub struct Smoothed {
    /// What was asked.
    pub question: Question,
    /// The residual before and after the repair; none for a circular channel, or one too short.
    pub residual: Option<SplineResidual>,
    /// The filtered track; none where it was not asked for, or the method has no model.
    pub track: Option<Arc<FilteredTrack>>,
}

impl Question {
    /// What the screen shows of the result of its channel; none where there is no result.
    #[must_use]
    pub fn of(model: &Model) -> Option<Self> {
        let state = model.state();
        state.drawn.as_ref()?;
        Some(Self { plan: model.shown, result: state.results, track: state.layers.filtered })
    }

    /// The index of the plan it is about.
    #[must_use]
    pub fn plan(self) -> usize {
        self.plan
    }

    /// True when the answer says all that `other` asks.
    fn covers(self, other: Self) -> bool {
        self.plan == other.plan && self.result == other.result && (self.track || !other.track)
    }
}

impl Smoothed {
    /// The answer about the result on the screen, if it has come.
    #[must_use]
    pub fn of(model: &Model) -> Option<&Self> {
        let state = model.state();
        state.smoothed.as_ref().filter(|s| s.question.plan == model.shown && s.question.result == state.results)
    }

    /// The filtered track of the result with this number.
    #[must_use]
    pub fn track_of(&self, result: u64) -> Option<&FilteredTrack> {
        self.track.as_deref().filter(|_| self.question.result == result)
    }
}

/// A result to smooth.
#[derive(Debug)]
pub struct Job {
    question: Question,
    track: Arc<Track>,
    channel: usize,
    samples: Arc<Samples>,
    outcome: Arc<Outcome>,
}

impl Job {
    /// What the screen asks, unless it has been asked or answered.
    #[must_use]
    pub fn wanted(model: &mut Model) -> Option<Self> {
        let question = Question::of(model)?;
        let state = model.state();
        let answered = state.smoothed.as_ref().is_some_and(|smoothed| smoothed.question.covers(question));
        if answered || model.smoothing.is_some_and(|asked| asked.covers(question)) {
            return None;
        }
        let job = Self {
            question,
            track: Arc::clone(&model.track),
            channel: state.channel,
            samples: Arc::clone(&state.samples),
            outcome: Arc::clone(&state.drawn.as_ref()?.outcome),
        };
        model.smoothing = Some(question);
        Some(job)
    }

    /// Does it.
    ///
    /// # Errors
    /// [`crate::error::Error::Stopped`] as soon as nobody waits for it any more.
    pub fn run(&self, stop: &Stop) -> Result<Smoothed> {
        let series = self.samples.series(&self.track.channels[self.channel], &self.track.time);
        let residual = spline_residual(&self.outcome, &series, stop)?;
        let track = if self.question.track {
            let values = crate::analysis::filtered(&self.outcome, &series, stop)?;
            values.map(|values| FilteredTrack::new(values, stop)).transpose()?.map(Arc::new)
        } else {
            None
        };
        Ok(Smoothed { question: self.question, residual, track })
    }
}

/// A worker that smooths results and sends what comes out.
#[must_use]
pub fn smooth(results: Sender<Message>) -> Worker<Job> {
    Worker::new(move |_, job: Job, stop: &Stop| {
        // A result that nobody waits for any more is not smoothed.
        if let Ok(smoothed) = job.run(stop) {
            let _ = results.send(Message::Smoothed(Box::new(smoothed)));
        }
    })
}
