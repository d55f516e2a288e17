//! How small a wild point the methods find on a channel, measured on a thread of its own.

use std::sync::{Arc, Mutex, PoisonError};
use std::time::{Duration, Instant};

use crossbeam_channel::Sender;

use super::consensus::Question;
use super::message::Message;
use super::model::Model;
use crate::error::{Error, Result, on_one_line};
use crate::job::Worker;
use crate::method::voting;
use crate::session::detectability::{Advice, Budget, Measured, OnChannel, SEED, Study, Tuned};
use crate::session::{Setup, candidates};
use crate::stop::Stop;
use crate::track::{Samples, Track};

/// No further settings are tried after this time.
const TUNING: Duration = Duration::from_secs(20);

/// What is to be measured.
#[derive(Debug, Clone, PartialEq)]
pub enum Subject {
    /// All methods, with a preset of values.
    Methods(Question),
    /// One method with its settings.
    Setting(Box<Setup>),
    /// Other settings of a method that find more.
    Tuning(Box<Setup>),
}

/// What is known of the methods on a channel.
#[derive(Debug, Clone)]
pub struct Studied {
    /// What they were asked with.
    pub question: Question,
    /// What came out so far.
    pub advice: Advice,
}

/// What is known of the settings in force.
#[derive(Debug, Clone)]
pub struct MeasuredSetting {
    /// The method with its settings.
    pub setup: Setup,
    /// What came out so far.
    pub measured: Measured,
    /// The median of the residuals at which noise ends, in channel units.
    pub limit: f64,
    /// False while there are copies left to judge.
    pub is_over: bool,
}

/// A measurement that is under way.
#[derive(Debug, Clone, PartialEq)]
pub struct Studying {
    /// The job.
    pub generation: u64,
    /// Index of the plan.
    pub plan: usize,
    /// What is measured.
    pub subject: Subject,
    /// Rounds that are done, of all.
    pub rounds: [usize; 2],
}

/// What comes of a measurement.
#[derive(Debug)]
pub enum Finding {
    /// About all methods.
    Methods(Box<Studied>),
    /// About the settings in force.
    Setting(Box<MeasuredSetting>),
    /// About settings that find more.
    Tuned(Box<Tuned>),
    /// Nothing: the reason.
    Nothing(String),
}

/// A channel on which methods are measured.
#[derive(Debug)]
pub struct Job {
    track: Arc<Track>,
    plan: usize,
    channel: usize,
    samples: Arc<Samples>,
    subject: Subject,
}

/// The copies of the last study: other settings are measured on them.
#[derive(Debug, Default)]
pub struct Copies(Mutex<Option<Kept>>);

/// A study that is over, with what it holds for.
#[derive(Debug)]
struct Kept {
    track: Arc<Track>,
    channel: usize,
    question: Question,
    study: Study,
}

impl Subject {
    /// All methods, for the channel on the screen as it is now.
    #[must_use]
    pub fn methods(model: &Model) -> Self {
        Self::Methods(Question::of(&model.plan().setup))
    }

    /// The settings of the channel on the screen.
    #[must_use]
    pub fn setting(model: &Model) -> Self {
        Self::Setting(Box::new(model.plan().setup.clone()))
    }

    fn question(&self) -> Question {
        match self {
            Self::Methods(question) => question.clone(),
            Self::Setting(setup) | Self::Tuning(setup) => Question::of(setup),
        }
    }

    /// The setups that are compared.
    fn setups(&self) -> Vec<Setup> {
        match self {
            Self::Methods(question) => {
                let (setups, _) = candidates(voting(), question.preset, question.rate.as_deref());
                setups.into_iter().map(|setup| setup.prepared(&question.preparation)).collect()
            }
            Self::Setting(setup) | Self::Tuning(setup) => vec![Setup::clone(setup)],
        }
    }
}

impl Job {
    /// The job for a plan of the model as it is now.
    #[must_use]
    pub fn new(model: &Model, plan: usize, subject: Subject) -> Self {
        let state = &model.channels[plan];
        let (track, samples) = (Arc::clone(&model.track), Arc::clone(&state.samples));
        Self { track, plan, channel: state.channel, samples, subject }
    }

    /// What there is to show until something comes, when it is the job `generation`.
    #[must_use]
    pub fn started(&self, generation: u64) -> Studying {
        Studying { generation, plan: self.plan, subject: self.subject.clone(), rounds: [0, 0] }
    }

    /// Measures, and tells what is known as it becomes known.
    ///
    /// # Errors
    /// [`Error::Stopped`]; what [`Study::new`] gives.
    pub fn run(&self, Copies(kept): &Copies, stop: &Stop, mut tell: impl FnMut(Finding, [usize; 2])) -> Result<()> {
        let setups = self.subject.setups();
        let before = kept.lock().unwrap_or_else(PoisonError::into_inner).take();
        let (study, again) = match before.filter(|kept| self.is_answered_by(kept)) {
            Some(before) => (before.study, true),
            None => (self.study(setups.clone(), stop, &mut tell)?, false),
        };
        let answered = self.answer(&study, again.then_some(setups.as_slice()), stop);
        let (track, question) = (Arc::clone(&self.track), self.subject.question());
        let study = Kept { track, channel: self.channel, question, study };
        *kept.lock().unwrap_or_else(PoisonError::into_inner) = Some(study);
        if let Some(finding) = answered? {
            tell(finding, [1, 1]);
        }
        Ok(())
    }

    /// Makes the copies and lets every method judge them; tells what is known after each.
    fn study(&self, setups: Vec<Setup>, stop: &Stop, tell: &mut impl FnMut(Finding, [usize; 2])) -> Result<Study> {
        let channel = &self.track.channels[self.channel];
        let on_channel = OnChannel { track: &self.track, channel, samples: &self.samples, seed: SEED };
        let mut study = on_channel.begin(setups, stop)?;
        loop {
            let goes_on = study.advance(stop)?;
            let rounds = study.rounds();
            // What is left to do after the last copy is not over.
            let all = rounds.all + usize::from(matches!(self.subject, Subject::Tuning(_)));
            tell(self.finding(study.advice()), [rounds.done, all]);
            if !goes_on {
                return Ok(study);
            }
        }
    }

    /// What the copies say of `setups`, where they were not made for them; the search for better ones, where that is
    /// asked for.
    fn answer(&self, study: &Study, setups: Option<&[Setup]>, stop: &Stop) -> Result<Option<Finding>> {
        if let Subject::Tuning(setup) = &self.subject {
            let end = Instant::now() + TUNING;
            let budget = Budget { flags: None, is_over: &|| Instant::now() >= end };
            return Ok(study.tune(setup, &budget, stop)?.map(|tuned| Finding::Tuned(Box::new(tuned))));
        }
        Ok(setups.map(|setups| study.compare(setups, stop)).transpose()?.map(|advice| self.finding(advice)))
    }

    /// True where the copies of an earlier study are those of this job: the preset of the methods does not matter to them.
    fn is_answered_by(&self, kept: &Kept) -> bool {
        let question = self.subject.question();
        let same = Arc::ptr_eq(&kept.track, &self.track) && kept.channel == self.channel;
        same && kept.question.preparation == question.preparation && kept.question.rate == question.rate
    }

    fn finding(&self, advice: Advice) -> Finding {
        if let Some(why) = advice.unsuitable {
            return Finding::Nothing(why.to_string());
        }
        match &self.subject {
            Subject::Methods(question) => Finding::Methods(Box::new(Studied { question: question.clone(), advice })),
            Subject::Setting(setup) | Subject::Tuning(setup) => {
                let (limit, is_over) = (advice.limit.unwrap_or(f64::NAN), advice.is_over());
                match advice.methods.into_iter().next() {
                    Some(measured) => Finding::Setting(Box::new(MeasuredSetting {
                        setup: Setup::clone(setup),
                        measured,
                        limit,
                        is_over,
                    })),
                    None => Finding::Nothing("nothing was measured".to_owned()),
                }
            }
        }
    }
}

/// A worker that measures and sends what comes out.
#[must_use]
pub fn study(results: Sender<Message>) -> Worker<Job> {
    let copies = Copies::default();
    Worker::new(move |generation, job: Job, stop: &Stop| {
        let plan = job.plan;
        let tell = |finding: Finding, rounds: [usize; 2]| {
            // Nobody listens any more when the program is about to end.
            let _ = results.send(Message::Studied { generation, plan, finding, rounds });
        };
        match job.run(&copies, stop, tell) {
            Ok(()) | Err(Error::Stopped) => {}
            Err(e) => {
                let finding = Finding::Nothing(on_one_line(&e));
                let _ = results.send(Message::Studied { generation, plan, finding, rounds: [0, 0] });
            }
        }
    })
}
