//! What earlier workbenches left about a record.

use std::fs::File;
use std::io::Read;
use std::path::{Path, PathBuf};
use std::time::SystemTime;

use super::super::words::counted;
use super::files::{self, DRAFT, ENDING, take};
use super::writer::sha256_of;
use crate::review::Decisions;
use crate::session::journal::{Base, Entry, Header, Journal, decode, foreign};
use crate::session::{self, Plan, Session};
use crate::track::{Track, covered, printable};

/// A journal larger than this is none.
const LARGEST: u64 = 1 << 30;

/// The first line is within this many bytes.
const HEAD: u64 = 64 << 10;

/// Journals about other contents that are looked into at most, the newest first: one of them may be about an earlier
/// content of the record.
const MOST: usize = 1000;

/// Work that was not saved, offered to the user.
#[derive(Debug, Clone, PartialEq)]
pub struct Found {
    /// The journal.
    pub path: PathBuf,
    /// When its last change was made.
    pub time: SystemTime,
    /// The same for people.
    pub when: String,
    /// How many changes are in it.
    pub changes: usize,
    /// What takes them back in.
    pub entries: Vec<Entry>,
    /// False when its end is torn or of another version.
    pub complete: bool,
    /// The session file that the work went on from.
    pub session: Option<PathBuf>,
    /// True when that file is not what it was then, or gone.
    pub session_changed: bool,
    /// The plans that this work and the session both began from, one for each of the session.
    pub base: Vec<Plan>,
    /// A channel of it that is not loaded: it cannot be taken in without losing something.
    pub missing: Option<String>,
    /// How many rows were added to the record since.
    pub added: usize,
}

/// What a search has found.
#[derive(Debug, Default)]
pub(super) struct Search {
    /// Journals about this record, the newest first, with what keeps others from taking them.
    pub(super) found: Vec<(Found, File)>,
    /// What the user should know of others.
    pub(super) notes: Vec<String>,
}

/// Looks for journals of ended workbenches about the record that is called `record`, and about `file` if the session
/// was opened from one.
pub(super) fn search(folder: &Path, record: &str, track: &Track, session: &Session, file: Option<PathBuf>) -> Search {
    let mut search = Search::default();
    let wanted = Wanted { record, track, session, file };
    let (own, others): (Vec<_>, Vec<_>) = listed(folder).into_iter().partition(|l| l.is_about(&track.sha256));
    let passed_over = others.len().saturating_sub(MOST);
    for listed in own.into_iter().chain(others.into_iter().take(MOST)) {
        wanted.look_at(listed, &mut search);
    }
    search.found.sort_by(|(a, _), (b, _)| (b.time, &b.path).cmp(&(a.time, &a.path)));
    if passed_over > 0 {
        let what = counted(passed_over, "older journal");
        search.notes.push(format!("{what} of other records in {} were not checked", shown(folder)));
    }
    search
}

/// What is looked for.
struct Wanted<'a> {
    record: &'a str,
    track: &'a Track,
    session: &'a Session,
    /// The file of the session, if it was opened from one.
    file: Option<PathBuf>,
}

impl Wanted<'_> {
    fn concerns(&self, sha256: &str, record: &str) -> bool {
        sha256 == self.track.sha256 || record == self.record
    }

    /// Offers a journal, says why it is not offered, or passes it over when it is about another record.
    fn look_at(&self, listed: Listed, search: &mut Search) {
        let named = listed.is_about(&self.track.sha256);
        // Most are about other records: a look at the first line shows it, and nobody is kept from them meanwhile.
        let head = match File::open(&listed.path).and_then(|file| head(file, HEAD)) {
            Ok(head) => head,
            Err(e) => {
                if named && e.kind() != std::io::ErrorKind::NotFound {
                    search.notes.push(format!("the journal {} cannot be read: {e}", shown(&listed.path)));
                }
                return;
            }
        };
        let Some(header) = decode(&head).map(|journal| journal.header) else {
            search.notes.extend(self.unreadable(&listed, named, &head));
            return;
        };
        if !self.concerns(&header.sha256, &header.record) {
            return;
        }
        // One that is being written is offered by nobody, and need not be: its workbench runs.
        let Some(held) = take(&listed.path) else { return };
        let Some(journal) = read(&held, LARGEST) else { return };
        let changes = journal.changes();
        if changes == 0 {
            // It ended between its first line and its first change: there is nothing in it.
            if journal.complete && journal.header.sha256 == self.track.sha256 {
                let _ = std::fs::remove_file(&listed.path);
            }
            return;
        }
        let what = counted(changes, "unsaved change");
        let are = if changes == 1 { "is" } else { "are" };
        let content = Content::of(&journal, self.track);
        if content == Content::Longer {
            let what = format!("{what} {are} kept that were made with rows added to the record");
            search.notes.push(format!("{what}: :reload takes these in and offers the changes"));
            return;
        }
        if let Some(why) = self.other(&journal, content) {
            search.notes.push(format!("{what} {why} {are} kept in {}", shown(&listed.path)));
            return;
        }
        let added = if let Content::Start { added } = content { added } else { 0 };
        search.found.push((Found { added, ..self.found(listed, journal) }, held));
    }

    /// What to say of a journal that this program cannot read.
    fn unreadable(&self, listed: &Listed, named: bool, head: &[u8]) -> Option<String> {
        let path = shown(&listed.path);
        match foreign(head) {
            Some(of) if named || self.concerns(&of.sha256, &of.record) => Some(format!(
                "unsaved work is kept in {path} by {}, another version than this program, which cannot read it",
                if of.program.is_empty() { "a program".into() } else { printable(&of.program) },
            )),
            None if named => Some(format!("the journal {path} cannot be read: its first line is damaged")),
            _ => None,
        }
    }

    /// To what other work a journal belongs than to what was opened; none when it is offered.
    fn other(&self, journal: &Journal, content: Content) -> Option<String> {
        if content == Content::Other {
            return Some("to an earlier content of this record".into());
        }
        let (file, base) = (self.file.as_ref()?, journal.header.base.as_ref()?);
        // A session that was moved is the same one; one that is gone cannot be opened to get the work back.
        let same = *file == base.path || !base.path.exists() || sha256_of(file) == base.sha256;
        (!same).then(|| format!("to {}, which can be opened to take them in,", shown(&base.path)))
    }

    fn found(&self, listed: Listed, journal: Journal) -> Found {
        let changes = journal.changes();
        let unknown = |channel: &&str| self.session.plans.iter().all(|p| p.channel != *channel);
        let missing = journal.entries.iter().flat_map(Entry::channels).find(unknown).map(str::to_owned);
        let (session, session_changed) = self.session_of(journal.header.base.as_ref());
        let base = self.base(&journal, session.as_deref().filter(|_| !session_changed));
        let Listed { path, time, .. } = listed;
        let (when, complete, entries) = (for_people(time), journal.complete, journal.entries);
        Found { path, time, when, changes, entries, complete, session, session_changed, base, missing, added: 0 }
    }

    /// The session file that the work went on from, as it is called now, and whether it is not what it was then.
    fn session_of(&self, base: Option<&Base>) -> (Option<PathBuf>, bool) {
        let Some(Base { path, sha256 }) = base else { return (None, false) };
        let same = |file: &Path| !sha256.is_empty() && sha256_of(file) == *sha256;
        if same(path) {
            return (Some(path.clone()), false);
        }
        match &self.file {
            Some(file) if same(file) => (Some(file.clone()), false),
            _ => (Some(path.clone()), true),
        }
    }

    /// The plans that the work began from, as far as the session that is open began from them too: as the journal tells
    /// or, when it began with work that was carried over, as they are in the session file, if it is still the same.
    /// Where neither is known, nothing was decided.
    fn base(&self, journal: &Journal, session: Option<&Path>) -> Vec<Plan> {
        let begun = journal.entries.iter().take(journal.header.begun).filter_map(|entry| match entry {
            Entry::Whole(plan) => Some(plan.as_ref().clone()),
            _ => None,
        });
        let known: Vec<Plan> = if journal.header.carried == 0 {
            begun.collect()
        } else {
            session.and_then(|path| session::read(path).ok()).map(|s| s.plans).unwrap_or_default()
        };
        let plan = |opened: &Plan| {
            let mut base = Plan { decisions: Decisions::default(), ..opened.clone() };
            let Some(known) = known.iter().find(|known| known.channel == opened.channel) else { return base };
            // What a session file says that is not open is as good as new here.
            if self.file.is_some() {
                base.setup = known.setup.clone();
            }
            let shared = known.decisions.iter().filter(|(row, _)| opened.decisions.get(*row).is_some());
            shared.for_each(|(row, decision)| base.decisions.set(row, Some(decision.clone())));
            base
        };
        self.session.plans.iter().map(plan).collect()
    }
}

/// How the record of a journal stands to the one that is open.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Content {
    /// It is the same.
    Same,
    /// It is the start of it, to which this many rows were added.
    Start { added: usize },
    /// It has more rows, which are in the file and were not loaded.
    Longer,
    /// It is another one.
    Other,
}

impl Content {
    fn of(journal: &Journal, track: &Track) -> Self {
        let Header { sha256, bytes, rows, .. } = &journal.header;
        if *sha256 == track.sha256 {
            return if *rows == track.rows { Self::Same } else { Self::Other };
        }
        match covered(&track.source, sha256, *bytes) {
            Ok(Some(bytes)) if bytes < track.bytes && *rows <= track.rows => Self::Start { added: track.rows - rows },
            Ok(Some(bytes)) if bytes > track.bytes => Self::Longer,
            _ => Self::Other,
        }
    }
}

/// A file in the folder of journals.
struct Listed {
    path: PathBuf,
    /// When it was changed last.
    time: SystemTime,
}

impl Listed {
    /// Whether its name says that it is about the content with this SHA-256.
    fn is_about(&self, sha256: &str) -> bool {
        let name = self.path.file_name().unwrap_or_default().to_string_lossy();
        name.starts_with(&files::beginning(sha256))
    }
}

/// The journals in a folder, the newest first. Drafts that a workbench has left when it was killed are taken away.
fn listed(folder: &Path) -> Vec<Listed> {
    let Ok(entries) = std::fs::read_dir(folder) else { return Vec::new() };
    let dated = |entry: std::fs::DirEntry| {
        let path = entry.path();
        let about = entry.metadata().ok().filter(std::fs::Metadata::is_file)?;
        if path.extension().is_some_and(|e| e == DRAFT) && take(&path).is_some() {
            let _ = std::fs::remove_file(&path);
        }
        let fits = path.extension().is_some_and(|e| e == ENDING);
        fits.then(|| Some(Listed { path, time: about.modified().ok()? }))?
    };
    let mut journals: Vec<Listed> = entries.flatten().filter_map(dated).collect();
    journals.sort_by(|a, b| (b.time, &b.path).cmp(&(a.time, &a.path)));
    journals
}

fn shown(path: &Path) -> String {
    printable(&path.display().to_string())
}

fn head(file: impl Read, most: u64) -> std::io::Result<Vec<u8>> {
    let mut bytes = Vec::new();
    file.take(most).read_to_end(&mut bytes).map(|_| bytes)
}

fn read(file: impl Read, most: u64) -> Option<Journal> {
    decode(&head(file, most).ok()?)
}

fn for_people(time: SystemTime) -> String {
    let stamp = jiff::Timestamp::try_from(time).unwrap_or(jiff::Timestamp::UNIX_EPOCH);
    stamp.strftime("%Y-%m-%d %H:%M UTC").to_string()
}
