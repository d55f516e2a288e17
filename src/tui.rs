//! The workbench on a terminal: the session's editor.
//!
//! Keys, sizes and results become [`message::Message`]s; [`update::update`] changes the [`model::Model`] and asks
//! for [`message::Effect`]s; [`view::draw`] shows it. This file is the loop between them and the outside.

use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::time::{Duration, Instant};

use crossbeam_channel::{Receiver, Sender, select, unbounded};
use ratatui::buffer::Buffer;
use ratatui::crossterm::event::{Event, KeyEventKind, read};
use ratatui::layout::Rect;

use crate::error::Result;
use crate::job::Worker;
use crate::session::Session;
use crate::stop::Stop;
use crate::track::Track;
use advice::Advise;
use config::Config;
use consensus::{Poll, Polling};
use files::{Desk, Task};
use input::Normaliser;
use journal::Journal;
use message::{Effect, Message, Written};
use model::{Model, Tone};
use office::{Errand, Judge};
use pace::Pace;
use plot::Glyphs;
pub use signals::Ended;
use signals::{HANG_UP, Signalled};
use terminal::Screen;
use theme::Theme;

pub mod action;
pub mod advice;
mod clipboard;
pub mod config;
pub mod consensus;
pub mod files;
mod find;
mod fuzzy;
mod hit;
pub mod input;
pub mod journal;
pub mod keys;
pub mod layout;
pub mod message;
pub mod model;
pub mod office;
mod pace;
pub mod picture;
pub mod plot;
mod signals;
mod terminal;
pub mod theme;
pub mod update;
pub mod view;
mod wire;
mod words;

/// How the workbench looks.
#[derive(Debug, Clone, Copy)]
pub struct Look {
    /// Styles.
    pub theme: Theme,
    /// Glyphs.
    pub glyphs: Glyphs,
}

/// What is opened: a record, a session on it, and the file of that session.
#[derive(Debug)]
pub struct Opening {
    /// The record.
    pub track: Track,
    /// The session.
    pub session: Session,
    /// The file it was opened from.
    pub file: Option<PathBuf>,
    /// What the user should know at the start.
    pub notes: Vec<String>,
}

impl Opening {
    /// The model to start with.
    #[must_use]
    pub fn model(self, look: Look) -> Model {
        let mut notes = self.track.notes.clone();
        notes.extend(self.notes);
        let mut model = Model::new(Arc::new(self.track), self.session, self.file, look.theme, look.glyphs);
        if !notes.is_empty() {
            model.say(Tone::Warning, notes.join(" · "));
        }
        model
    }
}

/// One frame of the workbench at a size, as text, when all has been computed.
///
/// # Errors
/// What the method cannot do under the settings.
pub fn still(opening: Opening, look: Look, size: (u16, u16)) -> Result<String> {
    let mut model = opening.model(look);
    model.size = size;
    let plan = model.shown;
    let drawn = Judge::new(&model, plan).run(&Stop::never())?;
    model.awaited = Some(0);
    update::update(&mut model, Message::Analysed { generation: 0, plan, result: Ok(Box::new(drawn)) });
    let area = Rect { x: 0, y: 0, width: size.0, height: size.1 };
    let mut buffer = Buffer::empty(area);
    view::draw(&model, area, &mut buffer);
    Ok(text_of(&buffer))
}

/// The text of a buffer, a line each row.
#[must_use]
pub fn text_of(buffer: &Buffer) -> String {
    use unicode_width::UnicodeWidthStr;
    let area = buffer.area;
    let mut text = String::new();
    for y in area.top()..area.bottom() {
        let mut line = String::new();
        let mut x = area.left();
        while x < area.right() {
            let symbol = buffer[(x, y)].symbol();
            line.push_str(symbol);
            x += u16::try_from(symbol.width()).unwrap_or(1).max(1);
        }
        text.push_str(line.trim_end());
        text.push('\n');
    }
    text
}

/// Runs the workbench until the user leaves it, or a signal ends it; keeps a journal in the folder `journal`. Of
/// `config`, glyphs and colours are in `look` already.
///
/// # Errors
/// When the terminal cannot be used.
pub fn run(opening: Opening, look: Look, config: Config, journal: Option<PathBuf>) -> Result<Ended> {
    let mut model = opening.model(look);
    model.keys = config.keys;
    (model.mouse, model.review.auto_advance) = (config.screen.mouse, config.screen.auto_advance);
    let signals = signals::listen()?;
    let mut outside = Outside::new(journal, &mut model);
    let mut screen = Screen::take(model.mouse)?;
    let pace = Pace::new(&config.screen);
    let left = work(&mut model, &mut outside, &mut screen, pace, &signals);
    let left = match left {
        Err(e) if signals::is_gone(&e) => Ok(Left::Signalled(HANG_UP)),
        other => other,
    };
    // The work is safe before anything is tried with a terminal that may be gone.
    let quit = matches!(left, Ok(Left::Quit));
    let kept = outside.journal.end(quit || !model.unsaved());
    drop(screen);
    Ok(match left? {
        Left::Quit => Ended::default(),
        Left::Signalled(signal) => Ended::by(signal, &model, kept.as_deref()),
    })
}

/// Why the loop ended.
enum Left {
    Quit,
    Signalled(i32),
}

/// How long a frame waits for the result of what the user did.
const FRAME: Duration = Duration::from_millis(16);

/// The loop between the model and the outside.
fn work(
    model: &mut Model,
    outside: &mut Outside,
    screen: &mut Screen,
    mut pace: Pace,
    signals: &Receiver<Signalled>,
) -> Result<Left> {
    model.size = screen.size()?;
    let mut first = vec![Effect::Analyse(model.shown)];
    let path = model.file.clone().or_else(|| model.track.source.path().map(Path::to_path_buf));
    first.extend(path.map(|path| Effect::Files(Task::Remember(path))));
    outside.carry_out(model, screen, first)?;
    let events = listen_for_events();
    let mut normaliser = Normaliser::default();
    screen.draw(model)?;
    loop {
        let mut inbox = Vec::new();
        select! {
            recv(events) -> event => match event {
                Ok(event) => take_event(event, &mut normaliser, &mut inbox),
                // The terminal is gone: so is the reason to go on.
                Err(_) => return Ok(Left::Signalled(HANG_UP)),
            },
            recv(outside.messages) -> message => inbox.extend(message),
            recv(signals) -> signal => if let Ok(signal) = signal {
                match signal {
                    Signalled::End(signal) => return Ok(Left::Signalled(signal)),
                    Signalled::Suspend => screen.suspend()?,
                    Signalled::Resumed => screen.forget()?,
                }
            },
            default(pace.patience(normaliser.waits())) => {
                let key = if pace.frame_is_due() { None } else { normaliser.flush() };
                match key {
                    Some(key) => inbox.push(Message::Key(key)),
                    None if pace.frame_is_due() => {}
                    None => continue,
                }
            },
        }
        // A burst of keys is drawn once.
        events.try_iter().for_each(|event| take_event(event, &mut normaliser, &mut inbox));
        inbox.extend(outside.messages.try_iter());
        // Advice that no panel shows changes nothing on the screen: nothing goes over the wire.
        let unseen = |m: &Message| matches!(m, Message::Advised { .. } | Message::NoAdvice);
        let panel = layout::arrange(model).is_some_and(|areas| areas.parameters.is_some());
        let still = !panel && !inbox.is_empty() && inbox.iter().all(unseen);
        let mut anew = false;
        for message in inbox {
            // What the workbench before had asked for is of no use to the one that has taken its place.
            let of_user = matches!(message, Message::Key(_) | Message::Paste(_) | Message::Resize(..));
            if anew && !of_user {
                continue;
            }
            match outside.take(model, screen, message)? {
                Next::Leave => return Ok(Left::Quit),
                Next::Anew => anew = true,
                Next::Stay => {}
            }
        }
        // What is there within a frame's time is drawn with it: one frame goes over the wire, not three.
        let deadline = Instant::now() + FRAME;
        while (model.awaited.is_some() || outside.advising)
            && let Ok(message) = outside.messages.recv_deadline(deadline)
        {
            if outside.take(model, screen, message)? == Next::Leave {
                return Ok(Left::Quit);
            }
        }
        outside.journal.catch_up();
        if pace.draws(!still) {
            screen.draw(model)?;
        }
    }
}

fn take_event(event: Event, normaliser: &mut Normaliser, inbox: &mut Vec<Message>) {
    match event {
        Event::Key(key) if key.kind != KeyEventKind::Release => {
            inbox.extend(normaliser.feed(key).into_iter().map(Message::Key));
        }
        Event::Mouse(event) => inbox.push(Message::Mouse(event)),
        Event::Paste(text) => inbox.push(Message::Paste(text)),
        Event::Resize(width, height) => inbox.push(Message::Resize(width, height)),
        _ => {}
    }
}

fn listen_for_events() -> Receiver<Event> {
    let (sender, events) = unbounded();
    std::thread::spawn(move || {
        while let Ok(event) = read() {
            if sender.send(event).is_err() {
                return;
            }
        }
    });
    events
}

/// Whether the loop goes on.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Next {
    Stay,
    /// Another record has taken the place of the one before.
    Anew,
    Leave,
}

/// What carries out effects.
struct Outside {
    worker: Worker<Judge>,
    advisor: Worker<Advise>,
    /// Whether the advisor has been asked what a step changes, and has not answered.
    advising: bool,
    poller: Worker<Poll>,
    sender: Sender<Message>,
    messages: Receiver<Message>,
    journal: Journal,
    /// The folder of journals.
    folder: Option<PathBuf>,
    desk: Desk,
}

impl Outside {
    /// Workers and a journal for the model, which offers what earlier workbenches left.
    fn new(folder: Option<PathBuf>, model: &mut Model) -> Self {
        let (sender, messages) = unbounded();
        let (worker, advisor) = (office::judge(sender.clone()), advice::advise(sender.clone()));
        let journal = Journal::start(folder.clone(), model, sender.clone());
        let poller = consensus::poll(sender.clone());
        let desk = Desk::new(sender.clone(), folder.as_deref());
        Self { worker, advisor, advising: false, poller, sender, messages, journal, folder, desk }
    }

    /// The same for a model that has taken the place of another, whose work is saved or not wanted.
    fn begin_anew(&mut self, model: &mut Model) {
        self.journal.end(true);
        *self = Self::new(self.folder.take(), model);
        if model.unsaved() {
            self.journal.saved(model);
        }
    }

    /// Has the model take a message in, and does what follows.
    fn take(&mut self, model: &mut Model, screen: &mut Screen, message: Message) -> Result<Next> {
        if matches!(message, Message::Stepped { .. } | Message::Advised { .. } | Message::NoAdvice) {
            self.advising = false;
        }
        let saved = matches!(&message, Message::Written { what, path, result: Ok(_) } if what.session(path).is_some());
        let effects = update::update(model, message);
        self.journal.note(model);
        if saved {
            self.journal.saved(model);
        }
        self.carry_out(model, screen, effects)
    }

    fn carry_out(&mut self, model: &mut Model, screen: &mut Screen, effects: Vec<Effect>) -> Result<Next> {
        let mut next = Next::Stay;
        for effect in effects {
            match effect {
                Effect::Analyse(plan) => {
                    // What the user waits for goes before advice.
                    self.advisor.cancel();
                    self.advising = false;
                    model.awaited = Some(self.worker.submit(Judge::new(model, plan)));
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
                Effect::Cancel => {
                    self.advisor.cancel();
                    self.advising = false;
                    self.worker.cancel();
                }
                Effect::Save { path, overwrite, then_quit } => {
                    let what = Written::Session { revision: model.revision, then_quit };
                    self.write(model, Errand { what, path, overwrite });
                }
                Effect::Export { outputs, overwrite } => {
                    let path = outputs.first().map(|o| o.path.clone()).unwrap_or_default();
                    let what = Written::Exported { outputs, revision: model.revision };
                    self.write(model, Errand { what, path, overwrite });
                }
                Effect::Files(Task::Begin) => {
                    self.begin_anew(model);
                    next = Next::Anew;
                }
                Effect::Files(task) => self.desk.begin(model, task),
                Effect::Offered { path, fate } => self.journal.settle(model, &path, fate),
                Effect::Copy(text) => screen.copy(&text)?,
                Effect::Mouse(on) => screen.mouse(on)?,
                Effect::Redraw => screen.forget()?,
                Effect::Suspend => screen.suspend()?,
                Effect::Quit => return Ok(Next::Leave),
            }
        }
        Ok(next)
    }

    fn write(&self, model: &Model, errand: Errand) {
        office::write(Arc::clone(&model.track), model.document(), errand, self.sender.clone());
    }
}
