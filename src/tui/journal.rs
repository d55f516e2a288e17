//! The journal beside the screen: every change is written as it is made, by a thread of its own, and what an earlier
//! workbench left is found when the record is opened again.

use std::fs::File;
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

use crossbeam_channel::{Receiver, Sender, unbounded};

use super::message::{Fate, Message};
use super::model::{Model, Overlay, Tone};
use crate::error::on_one_line;
use crate::session::journal::{Header, Scribe};
use crate::track::Source;
use writer::{Begin, Order, Writer};

mod files;
mod find;
mod writer;

pub use files::folder;
pub use find::Found;

/// How long a frame may wait for the disk: what the screen shows has been written, unless that takes longer.
const PATIENCE: Duration = Duration::from_millis(100);

/// The journal of a running workbench.
pub(super) struct Journal {
    desk: Option<Desk>,
    scribe: Scribe,
    /// Journals that are offered, locked so that no other workbench offers them too.
    held: Vec<(PathBuf, File)>,
}

/// The way to the writing thread.
struct Desk {
    orders: Sender<Order>,
    /// One for each entry that has been written.
    written: Receiver<()>,
    awaited: usize,
    thread: std::thread::JoinHandle<Option<PathBuf>>,
}

impl Journal {
    /// A journal that is kept in `folder`, nowhere with none. What earlier workbenches left there about the same
    /// record is offered by the model; errors go to `results`.
    pub(super) fn start(folder: Option<PathBuf>, model: &mut Model, results: Sender<Message>) -> Self {
        let mut journal = Self { desk: None, scribe: Scribe::default(), held: Vec::new() };
        let Some(folder) = folder else { return journal };
        if let Err(e) = files::make(&folder) {
            let text = on_one_line(&e);
            model.say(Tone::Warning, format!("no journal: {text}; only what is saved is safe"));
            return journal;
        }
        let whole = |path: &Path| std::fs::canonicalize(path).unwrap_or_else(|_| path.to_path_buf());
        let session = model.file.as_deref().map(whole);
        let search = find::search(&folder, &record(&model.track.source), &model.track, &model.session, session);
        if let Some(note) = search.notes.first() {
            model.say(Tone::Warning, note.clone());
        }
        let (found, held) = search.found.into_iter().unzip::<_, _, Vec<Found>, Vec<File>>();
        journal.held = found.iter().map(|f| f.path.clone()).zip(held).collect();
        if !found.is_empty() {
            model.overlay = Overlay::Recover(found);
        }
        let (orders, inbox) = unbounded();
        let (acknowledge, written) = unbounded();
        let writer = Writer::new(folder, results, acknowledge);
        let thread = std::thread::spawn(move || writer.run(&inbox));
        journal.desk = Some(Desk { orders, written, awaited: 0, thread });
        journal.begin(model, 0, None);
        journal
    }

    /// Begins anew: with the plans as they are, of which `carried` changes are not saved, in place of a journal that
    /// they were taken from.
    fn begin(&mut self, model: &Model, carried: usize, replaces: Option<(PathBuf, File)>) {
        let Some(desk) = &self.desk else { return };
        let touched = model.session.plans.iter().zip(&model.channels).filter(|(_, c)| c.touched);
        let (scribe, entries) = Scribe::beginning(touched.map(|(plan, _)| plan));
        self.scribe = scribe;
        let header = Header {
            record: record(&model.track.source),
            sha256: model.track.sha256.clone(),
            rows: model.track.rows,
            base: None,
            begun: entries.len(),
            carried,
        };
        // The writer can only be gone when it has panicked, and then the panic has been reported.
        let _ =
            desk.orders.send(Order::Begin(Box::new(Begin { header, session: model.file.clone(), entries, replaces })));
    }

    /// Takes down what has changed since the last call.
    pub(super) fn note(&mut self, model: &mut Model) {
        for touched in std::mem::take(&mut model.unjournalled) {
            let Some(desk) = &mut self.desk else { continue };
            let Some(entry) = self.scribe.entry(&model.session.plans, &touched) else { continue };
            desk.awaited += usize::from(desk.orders.send(Order::Add(entry)).is_ok());
        }
    }

    /// The session has been saved: what is in it need not be kept any more.
    pub(super) fn saved(&mut self, model: &Model) {
        let newer = model.revision.saturating_sub(model.saved_revision);
        self.begin(model, usize::try_from(newer).unwrap_or(usize::MAX), None);
    }

    /// Does with a journal that was offered what the user has decided.
    pub(super) fn settle(&mut self, model: &Model, path: &Path, fate: Fate) {
        let at = self.held.iter().position(|(held, _)| held == path);
        let held = at.map(|at| self.held.remove(at));
        match fate {
            Fate::Taken { changes } => self.begin(model, changes, held),
            // Already gone is as good.
            Fate::Dropped => drop(std::fs::remove_file(path)),
            Fate::Left => {}
        }
    }

    /// Waits until what the screen is about to show has been written, but not long.
    pub(super) fn catch_up(&mut self) {
        let Some(desk) = &mut self.desk else { return };
        let deadline = Instant::now() + PATIENCE;
        while desk.awaited > 0 && desk.written.recv_deadline(deadline).is_ok() {
            desk.awaited -= 1;
        }
    }

    /// Ends it, with all of it on the disk, or with none of it left; gives the file that is kept.
    pub(super) fn end(&mut self, remove: bool) -> Option<PathBuf> {
        let desk = self.desk.take()?;
        let _ = desk.orders.send(Order::End { remove });
        desk.thread.join().ok().flatten()
    }
}

impl Drop for Journal {
    fn drop(&mut self) {
        // However the workbench ends: what it was told is on the disk.
        self.end(false);
    }
}

/// The name of a record in a journal.
fn record(source: &Source) -> String {
    match source.path() {
        Some(path) => std::fs::canonicalize(path).unwrap_or_else(|_| path.to_path_buf()).to_string_lossy().into_owned(),
        None => source.name(),
    }
}

#[cfg(test)]
mod tests;
