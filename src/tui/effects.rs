//! What carries out the effects of the workbench: workers, files, the journal and the terminal.

use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::time::{Duration, Instant};

use crossbeam_channel::{Receiver, Sender, unbounded};

use super::advice::{self, Advise};
use super::consensus::{self, Poll, Polling};
use super::detectability::{self, Studying};
use super::files::{Desk, Task};
use super::jobs::{self, Errand, Judge};
use super::journal::Journal;
use super::layout;
use super::message::{Effect, Message, Written};
use super::model::{Model, Overlay};
use super::session_guard::Known;
use super::smoothing;
use super::survey::{self, Survey};
use super::terminal::Screen;
use super::update::update;
use super::watch::Watch;
use crate::clock;
use crate::error::Result;
use crate::job::Worker;

/// How long a frame waits for the result of what the user did: as long as frames are apart by default.
const FRAME: Duration = Duration::from_millis(33);

/// Whether the loop goes on.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Next {
    Stay,
    /// Another record has taken the place of the one before.
    Anew,
    Leave,
}

/// What carries out effects.
pub(super) struct Outside {
    worker: Worker<Judge>,
    advisor: Worker<Advise>,
    /// Whether the advisor has been asked what a step changes, and has not answered.
    advising: bool,
    poller: Worker<Poll>,
    study_worker: Worker<detectability::Job>,
    surveyor: Worker<Survey>,
    smoother: Worker<smoothing::Job>,
    sender: Sender<Message>,
    pub(super) messages: Receiver<Message>,
    pub(super) journal: Journal,
    /// The folder of journals.
    folder: Option<PathBuf>,
    desk: Desk,
    known: Known,
    _watch: Option<Watch>,
    /// Whether a message that was taken in since this was last cleared can change what the screen shows.
    pub(super) visible: bool,
}

/// True for a message that can change what the screen shows. Advice that no panel shows cannot: nothing goes over the
/// wire for it.
fn is_visible(model: &Model, message: &Message) -> bool {
    let advice = matches!(message, Message::Advised { .. } | Message::NoAdvice);
    !advice || layout::arrange(model, model.screen()).is_some_and(|areas| areas.parameters.is_some())
}

impl Outside {
    /// Workers and a journal for the model, which offers what earlier workbenches left.
    pub(super) fn new(folder: Option<PathBuf>, model: &mut Model) -> Self {
        let (sender, messages) = unbounded();
        let (worker, advisor) = (jobs::judge(sender.clone()), advice::advise(sender.clone()));
        let journal = Journal::start(folder.clone(), model, sender.clone());
        let poller = consensus::poll(sender.clone());
        let study_worker = detectability::study(sender.clone());
        let surveyor = survey::survey(sender.clone());
        let smoother = smoothing::smooth(sender.clone());
        let desk = Desk::new(sender.clone(), folder.as_deref());
        let known = Known::default();
        sessions(model).into_iter().for_each(|file| known.read(file));
        let watch = Watch::over(&model.track, sender.clone());
        Self {
            worker,
            advisor,
            advising: false,
            poller,
            study_worker,
            surveyor,
            smoother,
            sender,
            messages,
            journal,
            folder,
            desk,
            known,
            _watch: watch,
            visible: true,
        }
    }

    /// The same for a model that has taken the place of another, whose work is saved or not wanted.
    fn begin_anew(&mut self, model: &mut Model) {
        self.journal.end(true);
        *self = Self::new(self.folder.take(), model);
        if model.unsaved() {
            self.journal.saved(model);
        }
    }

    /// Has the model take in what has come; true when the user leaves.
    pub(super) fn take_all(&mut self, model: &mut Model, screen: &mut Screen, inbox: Vec<Message>) -> Result<bool> {
        let mut anew = false;
        for message in inbox {
            // What the workbench before had asked for is of no use to the one that has taken its place.
            let of_user = matches!(message, Message::Key(_) | Message::Paste(_) | Message::Resize(..));
            if anew && !of_user {
                continue;
            }
            match self.take(model, screen, message)? {
                Next::Leave => return Ok(true),
                Next::Anew => anew = true,
                Next::Stay => {}
            }
        }
        Ok(false)
    }

    /// Takes in what is there within a frame's time, to be drawn together: one frame goes over the wire, not three.
    /// True when the user leaves.
    pub(super) fn await_result(&mut self, model: &mut Model, screen: &mut Screen) -> Result<bool> {
        let deadline = Instant::now() + FRAME;
        while (model.awaited.is_some() || self.advising)
            && let Ok(message) = self.messages.recv_deadline(deadline)
        {
            if self.take(model, screen, message)? == Next::Leave {
                return Ok(true);
            }
        }
        Ok(false)
    }

    /// Has the model take a message in, and does what follows.
    fn take(&mut self, model: &mut Model, screen: &mut Screen, message: Message) -> Result<Next> {
        if matches!(message, Message::Stepped { .. } | Message::Advised { .. } | Message::NoAdvice) {
            self.advising = false;
        }
        self.visible |= is_visible(model, &message);
        let saved = matches!(&message, Message::Written { what, path, result: Ok(_) } if what.session(path).is_some());
        model.now = Some(clock::now().as_second());
        let effects = update(model, message);
        self.journal.note(model);
        if saved {
            self.journal.saved(model);
        }
        let next = self.carry_out(model, screen, effects)?;
        // What the screen shows of a result may have changed with any message.
        if let Some(job) = smoothing::Job::wanted(model) {
            self.smoother.submit(job);
        }
        Ok(next)
    }

    pub(super) fn carry_out(&mut self, model: &mut Model, screen: &mut Screen, effects: Vec<Effect>) -> Result<Next> {
        let mut next = Next::Stay;
        for effect in effects {
            match effect {
                Effect::Analyse(plan) => {
                    // What the user waits for goes before advice.
                    self.advisor.cancel();
                    self.advising = false;
                    self.study_worker.cancel();
                    self.smoother.cancel();
                    model.smoothing = None;
                    model.awaited = Some(self.worker.submit(Judge::new(model, plan).with_steps(model)));
                }
                Effect::Advise(plan) => {
                    let job = Advise::new(model, plan);
                    self.advising = job.has_steps();
                    self.advisor.submit(job);
                }
                Effect::Poll(plan) => {
                    let poll = Poll::new(model, plan);
                    let polling = poll.started(0);
                    let generation = self.poller.submit(poll);
                    model.polling = Some(Polling { generation, ..polling });
                }
                Effect::CancelPoll => self.poller.cancel(),
                Effect::Study(plan, subject) => {
                    let job = detectability::Job::new(model, plan, subject);
                    let studying = job.started(0);
                    let generation = self.study_worker.submit(job);
                    model.studying = Some(Studying { generation, ..studying });
                }
                Effect::Survey(plans) => {
                    model.surveying = Some(self.surveyor.submit(Survey::new(model, &plans)));
                }
                Effect::CancelSurvey => self.surveyor.cancel(),
                Effect::CancelStudy => self.study_worker.cancel(),
                Effect::Cancel => {
                    self.advisor.cancel();
                    self.advising = false;
                    self.worker.cancel();
                }
                Effect::Save { path, overwrite, then_quit } => {
                    let what = Written::Session { revision: model.revision, then_quit };
                    self.write(model, Errand { what, path, overwrite, analyst: model.analyst.clone() });
                }
                Effect::Export { outputs, overwrite } => {
                    let path = outputs.first().map(|o| o.path.clone()).unwrap_or_default();
                    let what = Written::Exported { outputs, revision: model.revision };
                    self.write(model, Errand { what, path, overwrite, analyst: model.analyst.clone() });
                }
                Effect::Files(Task::Begin) => {
                    self.begin_anew(model);
                    next = Next::Anew;
                }
                Effect::Files(task) => self.desk.begin(model, task),
                Effect::Offered { path, fate } => self.journal.settle(model, &path, fate),
                Effect::Copy(text) => screen.copy(&text)?,
                Effect::Mouse(on) => screen.mouse(on)?,
                Effect::Redraw => screen.forget(),
                Effect::Suspend => screen.suspend()?,
                Effect::Quit => return Ok(Next::Leave),
            }
        }
        Ok(next)
    }

    fn write(&self, model: &Model, errand: Errand) {
        jobs::write(Arc::clone(&model.track), model.document(), errand, self.known.clone(), self.sender.clone());
    }
}

/// The session files that the work may go on in: the one that was opened, and those of offered journals that are as
/// they were then.
fn sessions(model: &Model) -> Vec<&Path> {
    let offered = if let Overlay::Recover(found) = &model.overlay { found.as_slice() } else { &[] };
    let unchanged = offered.iter().filter(|found| !found.session_changed).filter_map(|found| found.session.as_deref());
    model.file.as_deref().into_iter().chain(unchanged).collect()
}

#[cfg(test)]
mod tests {
    use super::super::plot::Glyphs;
    use super::super::theme::Theme;
    use super::*;
    use crate::session::{Session, Setup};
    use crate::track::{LoadOptions, Source, load};

    #[test]
    fn advice_is_visible_where_a_panel_shows_it_and_everything_else_always() {
        let track = Arc::new(load(&Source::demo(), &LoadOptions::default()).unwrap());
        let session = Session::new(&track, LoadOptions::default(), &Setup::standard());
        let mut model = Model::new(track, session, None, Theme::mono(), Glyphs::Unicode);
        let polling = Message::Polling { generation: 0, done: 1 };
        for (size, with_parameters) in [((120, 40), true), ((80, 24), false)] {
            model.size = size;
            assert_eq!(layout::arrange(&model, model.screen()).unwrap().parameters.is_some(), with_parameters);
            assert_eq!(is_visible(&model, &Message::NoAdvice), with_parameters);
            assert!(is_visible(&model, &polling));
        }
    }
}
