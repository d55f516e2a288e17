//! The thread that writes the journal. It writes each entry as it comes; bringing it to the disk is for a second
//! thread, since that takes long and the next entry must not wait for it.

use std::fs::File;
use std::io::{Read, Write};
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

use crossbeam_channel::{Receiver, Sender, bounded};
use sha2::{Digest, Sha256};

use super::super::message::Message;
use super::files;
use crate::error::Error;
use crate::session::journal::{Base, Encoder, Entry, Header};
use crate::track::hex;

/// How often a file goes to the disk at most.
const PERIOD: Duration = Duration::from_secs(1);

/// What the writer is asked to do.
pub(super) enum Order {
    /// Begin anew: what was written before is saved.
    Begin(Box<Begin>),
    /// Write this.
    Add(Entry),
    /// End; with `remove` nothing is kept.
    End { remove: bool },
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

/// What the thread keeps.
pub(super) struct Writer {
    folder: PathBuf,
    results: Sender<Message>,
    acknowledge: Sender<()>,
    begin: Option<Box<Begin>>,
    open: Option<Open>,
    /// True after an error: what follows a torn line could not be read.
    failed: bool,
}

struct Open {
    path: PathBuf,
    file: File,
    encoder: Encoder,
    /// Since when something is not on the disk.
    dirty: Option<Instant>,
}

impl Writer {
    pub(super) fn new(folder: PathBuf, results: Sender<Message>, acknowledge: Sender<()>) -> Self {
        Self { folder, results, acknowledge, begin: None, open: None, failed: false }
    }

    /// Carries out orders until the last; gives the file that is kept.
    pub(super) fn run(mut self, orders: &Receiver<Order>) -> Option<PathBuf> {
        let (sync, files) = bounded::<File>(1);
        let syncer = std::thread::spawn(move || files.iter().for_each(|file| drop(file.sync_data())));
        let remove = loop {
            let due = self.open.as_ref().and_then(|o| o.dirty).map(|since| since + PERIOD);
            let order = match due {
                Some(due) => orders.recv_deadline(due).map_err(|e| e.is_disconnected()),
                None => orders.recv().map_err(|_| true),
            };
            match order {
                Ok(Order::Begin(begin)) => self.begin(begin),
                Ok(Order::Add(entry)) => {
                    self.attempt(|w| w.add(&entry));
                    let _ = self.acknowledge.send(());
                }
                Ok(Order::End { remove }) => break remove,
                Err(true) => break false,
                Err(false) => {}
            }
            if due.is_some_and(|due| due <= Instant::now()) {
                self.hand_over(&sync);
            }
        };
        drop(sync);
        let _ = syncer.join();
        self.end(remove)
    }

    fn begin(&mut self, mut begin: Box<Begin>) {
        // What is in the file is saved; what was not is in the entries.
        let old = self.open.take().map(|o| (o.path, o.file));
        let replaces = begin.replaces.take();
        let at_once = begin.header.carried > 0;
        self.begin = Some(begin);
        self.failed = false;
        if at_once && !self.attempt(Self::create) {
            return;
        }
        for (path, _held) in old.into_iter().chain(replaces) {
            let _ = std::fs::remove_file(path);
        }
    }

    /// Does something once, unless something has failed before; says what fails.
    fn attempt(&mut self, what: impl FnOnce(&mut Self) -> Result<(), Error>) -> bool {
        if self.failed {
            return false;
        }
        if let Err(e) = what(self) {
            self.failed = true;
            let _ = self.results.send(Message::Unjournalled(e));
        }
        !self.failed
    }

    /// Makes the file with all that it begins with, whole or not at all.
    fn create(&mut self) -> Result<(), Error> {
        let Some(begin) = self.begin.take() else { return Ok(()) };
        let Begin { mut header, session, entries, .. } = *begin;
        header.base = session.map(|path| {
            let whole = std::fs::canonicalize(&path).unwrap_or(path);
            Base { sha256: sha256_of(&whole), path: whole.to_string_lossy().into_owned() }
        });
        let session = header.base.as_ref().map(|b| hex(&Sha256::digest(&b.path))).unwrap_or_default();
        let path = files::name(&self.folder, &header.sha256, &session);
        let (mut encoder, mut text) = Encoder::new(&header);
        entries.iter().for_each(|entry| text.push_str(&encoder.entry(entry)));
        let made = files::create(&path).and_then(|(mut file, draft)| {
            file.write_all(text.as_bytes())?;
            file.sync_data()?;
            std::fs::rename(draft, &path)?;
            files::sync(&self.folder)?;
            Ok(file)
        });
        let file = made.map_err(Error::io("write", &path))?;
        self.open = Some(Open { path, file, encoder, dirty: None });
        Ok(())
    }

    fn add(&mut self, entry: &Entry) -> Result<(), Error> {
        if self.open.is_none() {
            self.create()?;
        }
        let Some(open) = &mut self.open else { return Ok(()) };
        let line = open.encoder.entry(entry);
        // One write without a buffer: it is in the system's hands when this returns, whatever becomes of us.
        open.file.write_all(line.as_bytes()).map_err(Error::io("write", &open.path))?;
        open.dirty.get_or_insert_with(Instant::now);
        Ok(())
    }

    /// Has the file brought to the disk; when the disk is still busy with the last time, a period later.
    fn hand_over(&mut self, sync: &Sender<File>) {
        let Some(open) = &mut self.open else { return };
        let sent = open.file.try_clone().is_ok_and(|file| sync.try_send(file).is_ok());
        open.dirty = if sent { None } else { Some(Instant::now()) };
    }

    fn end(self, remove: bool) -> Option<PathBuf> {
        let open = self.open?;
        if remove {
            let _ = std::fs::remove_file(&open.path);
            return None;
        }
        let _ = open.file.sync_all();
        Some(open.path)
    }
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
