//! The workbench on a terminal: the session's editor.
//!
//! Keys, sizes and results become [`message::Message`]s; [`update::update`] changes the [`model::Model`] and asks
//! for [`message::Effect`]s; [`view::draw`] shows it. This file is the loop between them and the outside.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use crossbeam_channel::{Receiver, select, unbounded};
use ratatui::buffer::Buffer;
use ratatui::crossterm::event::{Event, KeyEventKind, read};
use ratatui::layout::Rect;

use crate::error::Result;
use crate::session::{Opened, Session};
use crate::stop::Stop;
use crate::track::{LoadOptions, Source, Track};
use advice::Advise;
use config::Config;
use effects::{Next, Outside};
use files::Task;
use frame_limiter::Pace;
use input::Normaliser;
use jobs::Judge;
use message::{Effect, Message};
use model::{Model, Tone};
use plot::Glyphs;
pub use signals::Ended;
use signals::{HANG_UP, Signalled};
use terminal::Screen;
use theme::Theme;

pub mod action;
pub mod advice;
pub mod chart_data;
mod clipboard;
pub mod config;
pub mod consensus;
pub mod detectability;
mod effects;
pub mod files;
mod find;
mod frame_limiter;
mod fuzzy;
mod hit_test;
pub mod input;
pub mod jobs;
pub mod journal;
pub mod keys;
pub mod layout;
pub mod message;
pub mod model;
pub mod plot;
pub mod session_guard;
mod signals;
pub mod smoothing;
mod startup;
pub mod survey;
mod terminal;
pub mod theme;
pub mod update;
pub mod view;
pub mod watch;
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

/// A file that could not be understood.
#[derive(Debug)]
pub struct Misread {
    /// The file.
    pub source: Source,
    /// What was told of it.
    pub options: LoadOptions,
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
    /// For each plan, whether that file has it, and goes on having it when it is saved again. Empty: all of them, where
    /// there is a file.
    pub own: Vec<bool>,
}

impl From<(Opened, PathBuf)> for Opening {
    fn from((Opened { track, session, mut notes, own, appended, altered }, file): (Opened, PathBuf)) -> Self {
        notes.extend(appended.map(|grown| format!("{} · :reload takes them in", grown.words())));
        notes.extend(altered.into_iter().flatten());
        Self { track, session, file: Some(file), notes, own }
    }
}

impl Opening {
    /// The model to start with.
    #[must_use]
    pub fn model(self, look: Look) -> Model {
        let mut notes = startup::notes(&self.track);
        notes.extend(self.notes);
        let first = startup::plan(&self.session, &self.track);
        let mut model = Model::new(Arc::new(self.track), self.session, self.file, look.theme, look.glyphs);
        model.channels.iter_mut().zip(&self.own).for_each(|(channel, own)| channel.touched = *own);
        model.shown = self.own.iter().position(|own| *own).unwrap_or(first);
        notes.extend(startup::prepared(&model));
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
    Advise::new(&model, plan).answer(&Stop::never(), |message| drop(update::update(&mut model, message)));
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
///
/// With a `misread` file, the dialog that corrects how it is loaded is open at the start.
pub fn run(
    opening: Opening,
    look: Look,
    config: Config,
    journal: Option<PathBuf>,
    misread: Option<Misread>,
) -> Result<Ended> {
    let mut model = opening.model(look);
    model.keys = config.keys;
    model.analyst = config.analyst;
    (model.mouse, model.review.auto_advance) = (config.screen.mouse, config.screen.auto_advance);
    let signals = signals::listen()?;
    let mut outside = Outside::new(journal, &mut model);
    let mut screen = Screen::take(model.mouse)?;
    let pace = Pace::new(&config.screen);
    let left = work(&mut model, &mut outside, &mut screen, pace, (&signals, misread));
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
        Left::Signalled(signal) => Ended::by(signal, &model, kept.as_ref()),
    })
}

/// Why the loop ended.
enum Left {
    Quit,
    Signalled(i32),
}

/// The loop between the model and the outside.
fn work(
    model: &mut Model,
    outside: &mut Outside,
    screen: &mut Screen,
    mut pace: Pace,
    (signals, misread): (&Receiver<Signalled>, Option<Misread>),
) -> Result<Left> {
    model.size = screen.size()?;
    let mut first = vec![Effect::Analyse(model.shown)];
    let path = model.file.clone().or_else(|| model.track.source.path().map(Path::to_path_buf));
    first.extend(path.map(|path| Effect::Files(Task::Remember(path))));
    if let Some(Misread { source, options }) = misread {
        first.extend(update::misread(model, source, options));
    }
    outside.carry_out(model, screen, first)?;
    let events = listen_for_events();
    let mut normaliser = Normaliser::default();
    let freed = screen.freed();
    screen.draw(model)?;
    loop {
        let mut inbox = Vec::new();
        let free = screen.is_free();
        let written = outside.journal.written();
        select! {
            recv(events) -> event => match event {
                Ok(event) => take_event(event, &mut normaliser, &mut inbox),
                // The terminal is gone: so is the reason to go on.
                Err(_) => return Ok(Left::Signalled(HANG_UP)),
            },
            recv(outside.messages) -> message => inbox.extend(message),
            recv(signals) -> signal => match signal {
                Ok(Signalled::End(signal)) => return Ok(Left::Signalled(signal)),
                Ok(Signalled::Suspend) => screen.suspend()?,
                Ok(Signalled::Resumed) => screen.forget(),
                Ok(Signalled::Resized) => inbox.push(screen.size().map(|(w, h)| Message::Resize(w, h))?),
                Err(_) => {}
            },
            recv(written) -> written => match written {
                Ok(()) => outside.journal.has_written(),
                Err(_) => outside.journal.give_up(model),
            },
            recv(freed) -> _ => {
                screen.check()?;
                if !pace.owes() {
                    continue;
                }
            },
            default(pace.patience(normaliser.waits(), free)) => {
                let due = pace.frame_is_due(free);
                match if due { None } else { normaliser.flush() } {
                    Some(key) => inbox.push(Message::Key(key)),
                    None if due => {}
                    None => continue,
                }
            },
        }
        // A burst of keys is drawn once.
        events.try_iter().for_each(|event| take_event(event, &mut normaliser, &mut inbox));
        inbox.extend(outside.messages.try_iter());
        if take_in(model, outside, screen, &mut pace, inbox)? == Next::Leave {
            return Ok(Left::Quit);
        }
    }
}

/// Takes in what has come, and draws what it changes as soon as the journal has it.
fn take_in(
    model: &mut Model,
    outside: &mut Outside,
    screen: &mut Screen,
    pace: &mut Pace,
    inbox: Vec<Message>,
) -> Result<Next> {
    // Without a message, a frame is due. A result may come in the same turn as advice that nobody sees.
    outside.visible = inbox.is_empty();
    let leaves = outside.take_all(model, screen, inbox)? || outside.await_result(model, screen)?;
    if leaves {
        return Ok(Next::Leave);
    }
    outside.journal.catch_up();
    // The journal tells of a failure before it says that it is done: a frame without the mark is in the journal.
    let news = outside.messages.try_iter().collect();
    if outside.take_all(model, screen, news)? {
        return Ok(Next::Leave);
    }
    model.behind = outside.journal.behind();
    if pace.draws(outside.visible, screen.is_free()) {
        screen.draw(model)?;
    }
    Ok(Next::Stay)
}

fn take_event(event: Event, normaliser: &mut Normaliser, inbox: &mut Vec<Message>) {
    match event {
        Event::Key(key) if key.kind != KeyEventKind::Release => {
            inbox.extend(normaliser.feed(key).into_iter().map(Message::Key));
        }
        Event::Mouse(event) => inbox.push(Message::Mouse(event)),
        Event::Paste(text) => inbox.push(Message::Paste(text)),
        // Elsewhere a signal says so: the reader of events may miss it while keys come.
        #[cfg(not(unix))]
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
