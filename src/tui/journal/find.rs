//! What earlier workbenches left about a record.

use std::fs::File;
use std::io::Read;
use std::path::{Path, PathBuf};
use std::time::SystemTime;

use super::super::words::counted;
use super::files::{ENDING, take};
use super::writer::sha256_of;
use crate::session::Session;
use crate::session::journal::{Entry, Header, Journal, decode};
use crate::track::{Track, covered, printable};

/// A journal larger than this is none.
const LARGEST: u64 = 1 << 30;

/// The first line is within so many bytes.
const HEAD: u64 = 16 << 10;

/// Journals that are looked into at most, the newest first.
const MOST: usize = 200;

/// Work that was not saved, offered to the user.
#[derive(Debug, Clone, PartialEq)]
pub struct Found {
    /// The journal.
    pub path: PathBuf,
    /// When its last change was made, for people.
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
    for (path, time) in journals(folder) {
        // Most are about other records: a look at the first line shows it, and nobody is kept from them meanwhile.
        let concerns = |j: &Journal| j.header.sha256 == track.sha256 || j.header.record == record;
        if !File::open(&path).ok().and_then(|file| read(file, HEAD)).is_some_and(|head| concerns(&head)) {
            continue;
        }
        let Some(held) = take(&path) else { continue };
        let Some(journal) = read(&held, LARGEST) else { continue };
        let of_session = journal.header.base.as_ref().map(|b| PathBuf::from(&b.path));
        if file.is_some() && of_session.is_some() && file != of_session {
            continue;
        }
        let changes = journal.changes();
        let content = Content::of(&journal, track);
        if !matches!(content, Content::Same | Content::Start { .. }) {
            if changes > 0 && content == Content::Longer {
                let (what, are) = (counted(changes, "unsaved change"), if changes == 1 { "is" } else { "are" });
                let what = format!("{what} {are} kept that were made with rows added to the record");
                search.notes.push(format!("{what}: :reload takes these in and offers the changes"));
            } else if changes > 0 {
                let (what, are) = (counted(changes, "unsaved change"), if changes == 1 { "is" } else { "are" });
                let what = format!("{what} to an earlier content of this record {are} kept in");
                search.notes.push(format!("{what} {}", printable(&path.display().to_string())));
            }
            continue;
        }
        if changes == 0 {
            // It ended between its first line and its first change: there is nothing in it.
            let _ = std::fs::remove_file(&path);
            continue;
        }
        let added = if let Content::Start { added } = content { added } else { 0 };
        search.found.push((Found { added, ..found(path, time, journal, session) }, held));
    }
    search
}

/// How the record of a journal stands to the one that is open.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Content {
    /// It is the same.
    Same,
    /// It is the start of it, to which so many rows were added.
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

fn found(path: PathBuf, time: SystemTime, journal: Journal, session: &Session) -> Found {
    let changes = journal.changes();
    let unknown = |channel: &&str| session.plans.iter().all(|p| p.channel != *channel);
    let missing = journal.entries.iter().flat_map(Entry::channels).find(unknown).map(str::to_owned);
    let base = journal.header.base;
    let session_changed =
        base.as_ref().is_some_and(|b| b.sha256.is_empty() || sha256_of(Path::new(&b.path)) != b.sha256);
    Found {
        path,
        when: for_people(time),
        changes,
        entries: journal.entries,
        complete: journal.complete,
        session: base.map(|b| PathBuf::from(b.path)),
        session_changed,
        missing,
        added: 0,
    }
}

/// The journals in a folder with the times of their last changes, the newest first.
fn journals(folder: &Path) -> Vec<(PathBuf, SystemTime)> {
    let Ok(entries) = std::fs::read_dir(folder) else { return Vec::new() };
    let dated = |entry: std::fs::DirEntry| {
        let path = entry.path();
        let about = entry.metadata().ok()?;
        let fits = about.is_file() && about.len() <= LARGEST && path.extension().is_some_and(|e| e == ENDING);
        fits.then(|| Some((path, about.modified().ok()?)))?
    };
    let mut journals: Vec<_> = entries.flatten().filter_map(dated).collect();
    journals.sort_by(|a, b| (b.1, &b.0).cmp(&(a.1, &a.0)));
    journals.truncate(MOST);
    journals
}

fn read(file: impl Read, most: u64) -> Option<Journal> {
    let mut bytes = Vec::new();
    file.take(most).read_to_end(&mut bytes).ok()?;
    decode(&bytes)
}

fn for_people(time: SystemTime) -> String {
    let stamp = jiff::Timestamp::try_from(time).unwrap_or(jiff::Timestamp::UNIX_EPOCH);
    stamp.strftime("%Y-%m-%d %H:%M UTC").to_string()
}
