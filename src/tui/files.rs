//! Files beside the screen: folders are listed, files looked into, records loaded and outputs written on threads, and
//! what comes of it is sent as messages.

use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};

use crossbeam_channel::Sender;

use super::Look;
use super::message::Message;
use super::model::Model;
use crate::error::Result;
use crate::job::Worker;
use crate::stop::Stop;
use crate::track::{FileLine, LoadOptions, Source, first_lines};

mod complete;
mod listing;
mod look;
mod open;
mod recent;

pub use listing::{FileEntry, FileKind, Listing};
pub(super) use look::faults;
pub use look::{Glance, Seen};

/// A record or a session to open.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Request {
    /// Where it is; a session file opens the record that it names.
    pub source: Source,
    /// How a record is loaded.
    pub options: LoadOptions,
    /// What becomes of the work on the record that is open.
    pub purpose: Purpose,
}

/// What becomes of the work on the record that is open.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Purpose {
    /// It makes room for something else.
    Other,
    /// The record is loaded in another way: setup and decisions stay where they still fit.
    Correct,
    /// Rows that were added to the record are taken in: everything stays.
    TakeIn,
}

impl Request {
    /// For a file, with everything recognised.
    #[must_use]
    pub fn file(path: PathBuf) -> Self {
        Self { source: Source::File(path), options: LoadOptions::default(), purpose: Purpose::Other }
    }
}

/// Work with files that is asked for.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Task {
    /// List a folder; report that a file is one.
    List(PathBuf),
    /// Look into a file.
    Look(Glance),
    /// Open a record or a session.
    Open {
        /// By which the answer is known.
        ticket: u64,
        /// What.
        request: Request,
    },
    /// Nobody waits for what is being opened any more.
    Abandon,
    /// The new model is in place: workers and journal begin anew.
    Begin,
    /// Say which of these are there.
    Check(Vec<PathBuf>),
    /// Complete a path as far as it is clear.
    Complete(String),
    /// Put a file at the top of the recent ones.
    Remember(PathBuf),
}

/// What came of it.
#[expect(clippy::large_enum_variant, reason = "there are few of them, and each is moved a few times")]
#[derive(Debug)]
pub enum News {
    /// A folder was listed.
    Listed(Result<Listing>),
    /// A file was looked into.
    Seen {
        /// What was asked for.
        glance: Glance,
        /// What was seen.
        result: Result<Seen>,
        /// The first lines of the file.
        lines: Vec<FileLine>,
    },
    /// A record is loaded, with all that the screen needs of it.
    Opened {
        /// By which the answer is known.
        ticket: u64,
        /// The workbench on it.
        result: Result<Box<Model>>,
    },
    /// Which files are there.
    Checked(Vec<(PathBuf, bool)>),
    /// A path was completed.
    Completed {
        /// What had been typed.
        typed: String,
        /// What it became; the same when it is not clear how it goes on.
        completed: String,
    },
}

/// First lines of a file that are shown.
const LINES: usize = 9;

/// Sessions are told from records by their name.
#[must_use]
pub fn is_session(path: &Path) -> bool {
    path.extension().is_some_and(|e| e.eq_ignore_ascii_case("toml"))
}

/// What does the work.
pub(super) struct Desk {
    looker: Worker<Glance>,
    results: Sender<Message>,
    /// Which opening is awaited, by its ticket: any other is abandoned.
    awaited: Arc<AtomicU64>,
    /// The list of recent files; none where no journal is kept either.
    recent: Option<PathBuf>,
}

impl Desk {
    /// A desk that sends to `results`; `journal` is the folder of journals, beside which the recent files are kept.
    pub(super) fn new(results: Sender<Message>, journal: Option<&Path>) -> Self {
        let sender = results.clone();
        let looker = Worker::new(move |_, glance: Glance, stop: &Stop| {
            let result = glance.look(stop);
            let at = result.as_ref().ok().and_then(|seen| seen.rows_at.as_ref());
            let lines = first_lines(&glance.source, at, LINES);
            // Nobody listens any more when the program is about to end.
            let _ = sender.send(Message::Files(News::Seen { glance, result, lines }));
        });
        let recent = journal.and_then(Path::parent).map(|state| state.join("recent"));
        Self { looker, results, awaited: Arc::default(), recent }
    }

    /// Begins a task; what comes of it is sent.
    pub(super) fn begin(&self, model: &Model, task: Task) {
        let recent = self.recent.clone();
        match task {
            Task::List(path) => self.answer(move || Some(News::Listed(listing::list(&path, recent.as_deref())))),
            Task::Look(glance) => {
                self.looker.submit(glance);
            }
            Task::Open { ticket, request } => {
                self.awaited.store(ticket, Ordering::Relaxed);
                let stop = Stop::when_superseded(Arc::clone(&self.awaited), ticket);
                let keep = (request.purpose != Purpose::Other).then(|| open::Keep::of(model));
                let look = Look { theme: model.theme, glyphs: model.glyphs };
                self.answer(move || {
                    Some(News::Opened { ticket, result: open::open(request, keep, look, &stop).map(Box::new) })
                });
            }
            Task::Check(paths) => self.answer(move || {
                Some(News::Checked(paths.into_iter().map(|p| (p.clone(), p.symlink_metadata().is_ok())).collect()))
            }),
            Task::Complete(typed) => self.answer(move || {
                let completed = complete::path(&typed);
                Some(News::Completed { typed, completed })
            }),
            Task::Remember(path) => self.answer(move || {
                // A list that cannot be written is only shorter next time.
                let _ = recent::remember(recent.as_deref()?, &path);
                None
            }),
            Task::Abandon => self.awaited.store(0, Ordering::Relaxed),
            // The loop does it, which owns workers and journal.
            Task::Begin => {}
        }
    }

    fn answer(&self, work: impl FnOnce() -> Option<News> + Send + 'static) {
        let results = self.results.clone();
        std::thread::spawn(move || {
            if let Some(news) = work() {
                let _ = results.send(Message::Files(news));
            }
        });
    }
}
