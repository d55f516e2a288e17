//! All methods at once on one channel, asked one after the other on a thread of its own.

use std::sync::Arc;

use crossbeam_channel::Sender;

use super::message::Message;
use super::model::Model;
use super::plot::{Pyramid, VotesPlot};
use crate::error::{Error, Result, on_one_line};
use crate::job::Worker;
use crate::method::voting;
use crate::session::{Ballot, Detection, Preparation, Preset, Setup, candidates, detect};
use crate::stop::Stop;
use crate::track::{Samples, Track};

/// What the methods were asked with: an answer holds for as long as this stays.
#[derive(Debug, Clone, PartialEq)]
pub struct Question {
    /// Every method has this preset of values: the one in force on the channel.
    pub preset: Preset,
    /// The rate channel, for the methods that need one.
    pub rate: Option<String>,
    /// What is done with the channel before any of them sees it.
    pub preparation: Preparation,
}

/// What all methods say of a channel.
#[derive(Debug, Clone)]
pub struct Consensus {
    /// What they were asked with.
    pub question: Question,
    /// Their votes.
    pub ballot: Ballot,
    /// Extremes of the votes.
    pub pyramid: Pyramid,
    /// Positions that at least half of the methods flag.
    pub agreed: Vec<u32>,
    /// Methods that did not take part, with the reason.
    pub left_out: Vec<(&'static str, String)>,
}

/// How far the methods have been asked.
#[derive(Debug, Clone, PartialEq)]
pub struct Polling {
    /// The job.
    pub generation: u64,
    /// What they are asked with.
    pub question: Question,
    /// Index of the plan.
    pub plan: usize,
    /// How many have answered …
    pub done: usize,
    /// … of how many.
    pub of: usize,
}

/// A channel about which all methods are asked.
#[derive(Debug)]
pub struct Poll {
    track: Arc<Track>,
    plan: usize,
    channel: usize,
    samples: Arc<Samples>,
    question: Question,
}

impl Question {
    /// The question that the setup of a channel leads to: with the paper's values where the channel has them.
    #[must_use]
    pub fn of(setup: &Setup) -> Self {
        let has = |preset: Preset| setup.settings == preset.settings(setup.method);
        let paper = has(Preset::Paper) && !has(Preset::Default);
        Self {
            preset: if paper { Preset::Paper } else { Preset::Default },
            rate: setup.rate.clone(),
            preparation: setup.preparation.clone(),
        }
    }
}

impl Poll {
    /// The job for a plan of the model as it is now.
    #[must_use]
    pub fn new(model: &Model, plan: usize) -> Self {
        let state = &model.channels[plan];
        Self {
            track: Arc::clone(&model.track),
            plan,
            channel: state.channel,
            samples: Arc::clone(&state.samples),
            question: Question::of(&model.session.plans[plan].setup),
        }
    }

    /// What there is to show until the answer comes, when it is the job `generation`.
    #[must_use]
    pub fn started(&self, generation: u64) -> Polling {
        let of = candidates(voting(), self.question.preset, self.question.rate.as_deref()).0.len();
        Polling { generation, question: self.question.clone(), plan: self.plan, done: 0, of }
    }

    /// Asks them; `progress` hears how many have answered.
    ///
    /// # Errors
    /// [`Error::Stopped`].
    pub fn run(&self, stop: &Stop, progress: impl Fn(usize)) -> Result<Consensus> {
        let channel = &self.track.channels[self.channel];
        let samples = self.samples.series(channel, &self.track.time).len();
        let (setups, without_rate) = candidates(voting(), self.question.preset, self.question.rate.as_deref());
        let mut left_out: Vec<_> = without_rate.into_iter().map(|id| (id, "needs a rate channel".to_owned())).collect();
        let mut ballot = Ballot::new(samples);
        // The channel is calibrated for the first of them.
        let mut first: Option<Detection> = None;
        for (done, setup) in setups.iter().enumerate() {
            progress(done);
            let id = setup.method.about().id;
            let setup = setup.clone().prepared(&self.question.preparation);
            match detect(&self.track, channel, &self.samples, &setup, first.as_ref(), stop) {
                Ok(detection) => {
                    ballot.add(id, detection.judged.verdict(), stop)?;
                    first.get_or_insert(detection);
                }
                Err(Error::Stopped) => return Err(Error::Stopped),
                Err(e) => left_out.push((id, on_one_line(&e))),
            }
        }
        let (pyramid, agreed) = (VotesPlot::pyramid(&ballot, stop)?, ballot.agreed(ballot.half(), stop)?);
        Ok(Consensus { question: self.question.clone(), ballot, pyramid, agreed, left_out })
    }
}

/// A worker that asks all methods and sends how far it is and what comes out.
#[must_use]
pub fn poll(results: Sender<Message>) -> Worker<Poll> {
    Worker::new(move |generation, job: Poll, stop: &Stop| {
        let progress = |done: usize| {
            let _ = results.send(Message::Polling { generation, done });
        };
        match job.run(stop, progress) {
            // Who superseded it knows.
            Err(_) => {}
            Ok(consensus) => {
                let consensus = Box::new(consensus);
                let _ = results.send(Message::Polled { generation, plan: job.plan, consensus });
            }
        }
    })
}
