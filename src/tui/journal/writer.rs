//! The thread that writes the journal. It writes each entry as it comes; bringing it to the disk is for a second
//! thread, since that takes long and the next entry must not wait for it.
//!
//! What cannot be written (for example because the disk is full) is kept and tried again until it can; the workbench is
//! told when that begins and when it is over.

use std::fs::File;
use std::io::Read;
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

use crossbeam_channel::{Receiver, Sender, bounded, select, unbounded};
use sha2::{Digest, Sha256};

use super::super::message::{JournalNews, Message};
use super::files;
use super::open::Open;
use crate::error::Error;
use crate::session::journal::{Base, Entry, Header};
use crate::track::hex;

/// How often a file goes to the disk at most, and how long after a failure the next attempt is made.
const PERIOD: Duration = Duration::from_secs(1);

/// What the writer is asked to do.
pub(super) enum Order {
    /// Begin anew: what was written before is saved.
    Begin(Box<Begin>),
    /// Write this.
    Add(Entry),
    /// End; with `remove` nothing is kept. What is kept is told, and the channel closed when it is on the disk.
    End { remove: bool, reply: Sender<Kept> },
}

/// How a journal begins. Its file is made with the first change, so that looking leaves nothing behind.
pub(super) struct Begin {
    /// The first line, without the base.
    pub(super) header: Header,
    /// The session that the work goes on from.
    pub(super) session: Option<PathBuf>,
    /// The plans as they are.
    pub(super) entries: Vec<Entry>,
    /// A journal that is in those entries, held until they are on the disk and then removed.
    pub(super) replaces: Option<(PathBuf, File)>,
}

/// What is left of the journal when it ends.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Kept {
    /// The file, if there is one.
    pub journal: Option<PathBuf>,
    /// How many of the changes that are not saved could not be written.
    pub missing: usize,
}

/// What the thread keeps.
pub(super) struct Writer {
    folder: PathBuf,
    results: Sender<Message>,
    acknowledge: Sender<()>,
    /// All that the journal has to hold; none before it has begun.
    content: Option<Box<Begin>>,
    open: Option<Open>,
    /// Journals whose changes are in the content: they go when it is on the disk.
    superseded: Vec<(PathBuf, File)>,
    /// When the last attempt failed; none when nothing is missing.
    failed: Option<Instant>,
    syncer: Syncer,
}

/// The thread that brings files to the disk.
struct Syncer {
    files: Sender<File>,
    /// The error of each file, if there was one.
    done: Receiver<Option<std::io::Error>>,
}

impl Syncer {
    fn start() -> Self {
        let (files, inbox) = bounded::<File>(1);
        let (outbox, done) = unbounded();
        std::thread::spawn(move || inbox.iter().try_for_each(|file| outbox.send(file.sync_data().err())));
        Self { files, done }
    }
}

impl Writer {
    /// A writer of a journal in `folder`, which the workbench knows to have failed already, or not.
    pub(super) fn new(folder: PathBuf, results: Sender<Message>, acknowledge: Sender<()>, failed: bool) -> Self {
        let (open, superseded, syncer) = (None, Vec::new(), Syncer::start());
        let failed = failed.then(Instant::now);
        Self { folder, results, acknowledge, content: None, open, superseded, failed, syncer }
    }

    /// Carries out orders until the last.
    pub(super) fn run(mut self, orders: &Receiver<Order>) {
        let synced = self.syncer.done.clone();
        loop {
            select! {
                recv(orders) -> order => match order {
                    Ok(Order::Begin(begin)) => {
                        self.begin(begin);
                        self.attempt();
                    }
                    Ok(Order::Add(entry)) => {
                        if let Some(content) = &mut self.content {
                            content.entries.push(entry);
                        }
                        // After a failure the next attempt has its time: the screen does not wait for a sick disk.
                        if self.failed.is_none() {
                            self.attempt();
                        }
                        let _ = self.acknowledge.send(());
                    }
                    Ok(Order::End { remove, reply }) => return self.end(remove, &reply),
                    // The workbench has panicked: what it told is kept.
                    Err(_) => return self.end(false, &bounded(1).0),
                },
                recv(synced) -> error => if let Ok(Some(e)) = error {
                    self.lost(e);
                },
                default(self.patience()) => {}
            }
            if self.failed.is_some_and(over) {
                self.attempt();
            }
            self.hand_over();
        }
    }

    /// How long until something is due.
    fn patience(&self) -> Duration {
        let dirty = self.open.as_ref().and_then(|open| open.dirty);
        let due = |since: Instant| PERIOD.saturating_sub(since.elapsed());
        let waits = [dirty, self.failed].into_iter().flatten().map(due).min();
        waits.unwrap_or(Duration::from_secs(3600))
    }

    fn begin(&mut self, mut begin: Box<Begin>) {
        // What is in the file is saved; what was not is in the entries.
        self.set_aside();
        self.superseded.extend(begin.replaces.take());
        self.content = Some(begin);
    }

    /// Writes what is missing, and says when that begins or ceases to fail.
    fn attempt(&mut self) {
        let failed_before = self.failed.is_some();
        match self.write() {
            Ok(()) => {
                self.failed = None;
                self.superseded.drain(..).for_each(|(path, _held)| drop(std::fs::remove_file(path)));
                if failed_before {
                    let _ = self.results.send(Message::Journal(JournalNews::Resumed));
                }
            }
            Err(e) => {
                self.failed = Some(Instant::now());
                if !failed_before {
                    let _ = self.results.send(Message::Journal(JournalNews::Failing(e)));
                }
            }
        }
    }

    fn write(&mut self) -> Result<(), Error> {
        let Some(content) = &self.content else { return Ok(()) };
        if content.changes() == 0 {
            return files::make(&self.folder);
        }
        if self.open.as_ref().is_some_and(|open| !open.is_in_place()) {
            // Somebody has taken the file away.
            self.open = None;
        }
        let written = match &mut self.open {
            Some(open) => open.append(&content.entries),
            None => content.create(&self.folder).map(|open| self.open = Some(open)),
        };
        if written.is_err() && self.open.as_ref().is_some_and(|open| open.torn) {
            self.set_aside();
        }
        written
    }

    /// The file is written anew under another name, and this one goes when that has worked.
    fn set_aside(&mut self) {
        if let Some(Open { path, file, .. }) = self.open.take() {
            self.superseded.push((path, file));
        }
    }

    /// What was written has not come to the disk, and what of it has is not known.
    fn lost(&mut self, error: std::io::Error) {
        let Some(open) = &self.open else { return };
        let error = Error::io("write", &open.path)(error);
        self.set_aside();
        if self.failed.replace(Instant::now()).is_none() {
            let _ = self.results.send(Message::Journal(JournalNews::Failing(error)));
        }
    }

    /// Has the file brought to the disk; when the disk is still busy with the last time, a period later.
    fn hand_over(&mut self) {
        let Some(open) = self.open.as_mut().filter(|open| open.dirty.is_some_and(over)) else { return };
        let sent = open.file.try_clone().is_ok_and(|file| self.syncer.files.try_send(file).is_ok());
        open.dirty = if sent { None } else { Some(Instant::now()) };
    }

    fn end(mut self, remove: bool, reply: &Sender<Kept>) {
        if remove {
            self.set_aside();
            self.superseded.drain(..).for_each(|(path, _held)| drop(std::fs::remove_file(path)));
            let _ = reply.send(Kept::default());
            return;
        }
        self.attempt();
        let content = self.content.as_ref();
        let missing = content.map_or(0, |c| c.missing(self.open.as_ref(), !self.superseded.is_empty()));
        let journal = self.open.as_ref().map(|open| open.path.clone());
        let journal = journal.or_else(|| self.superseded.first().map(|(path, _)| path.clone()));
        let _ = reply.send(Kept { journal, missing });
        if let Some(open) = &self.open {
            let _ = open.file.sync_all();
        }
        // Whoever opens the journal next can take it when nobody holds the file any more, the other thread included.
        drop(self.syncer.files);
        self.syncer.done.iter().for_each(drop);
    }
}

impl Begin {
    /// How many changes are in it that are not saved.
    fn changes(&self) -> usize {
        self.header.carried + self.entries.len().saturating_sub(self.header.begun)
    }

    /// How many of them are not in the file. `elsewhere`: those that were carried over are still in another one.
    fn missing(&self, open: Option<&Open>, elsewhere: bool) -> usize {
        match open {
            Some(open) => self.entries.len().saturating_sub(open.entries),
            None if elsewhere => self.entries.len().saturating_sub(self.header.begun),
            None => self.changes(),
        }
    }

    /// Makes the file with all that there is, whole or not at all.
    fn create(&self, folder: &Path) -> Result<Open, Error> {
        files::make(folder)?;
        let base = self.session.as_ref().map(|path| {
            let path = std::fs::canonicalize(path).unwrap_or_else(|_| path.clone());
            Base { sha256: sha256_of(&path), path }
        });
        let session = base.as_ref().map(|b| hex(&Sha256::digest(b.path.as_os_str().as_encoded_bytes())));
        let path = files::name(folder, &self.header.sha256, &session.unwrap_or_default());
        let header = Header { base, ..self.header.clone() };
        Open::create(path, &header, &self.entries)
    }
}

fn over(since: Instant) -> bool {
    since.elapsed() >= PERIOD
}

/// SHA-256 of a file, empty when it cannot be read.
pub(super) fn sha256_of(path: &Path) -> String {
    let mut sum = Sha256::new();
    let mut part = [0; 1 << 16];
    let mut read = || -> std::io::Result<()> {
        let mut file = File::open(path)?;
        loop {
            match file.read(&mut part)? {
                0 => return Ok(()),
                n => sum.update(part.get(..n).unwrap_or_default()),
            }
        }
    };
    if read().is_err() { String::new() } else { hex(&sum.finalize()) }
}
