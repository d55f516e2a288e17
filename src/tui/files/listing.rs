//! A folder as the picker shows it.

use std::path::{Path, PathBuf};
use std::time::SystemTime;

use super::{is_session, recent};
use crate::error::{Error, Result};
use crate::track::printable;

/// Entries that are listed of one folder.
const MOST: usize = 20_000;
/// Recent files that are offered.
const RECENT: usize = 8;

/// A folder, or the news that it is a file.
#[derive(Debug, PartialEq, Eq)]
pub struct Listing {
    /// The folder; for a file the one it is in.
    pub folder: PathBuf,
    /// The recent files that are still there, the folders, the files.
    pub entries: Vec<FileEntry>,
    /// Set when a file was named instead of a folder.
    pub file: Option<PathBuf>,
    /// What the user should know.
    pub note: Option<String>,
}

/// A line of the picker.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct FileEntry {
    /// The file or folder.
    pub path: PathBuf,
    /// Its name, safe to be shown; for a recent one with its folder.
    pub name: String,
    /// What it is.
    pub kind: FileKind,
    /// Bytes; 0 for a folder.
    pub size: u64,
    /// When it was changed last, in UTC; empty where that is not known.
    pub changed: String,
    /// True for one of the recent files.
    pub recent: bool,
}

/// What a line of the picker is.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum FileKind {
    /// A folder.
    Folder,
    /// A session, by its name.
    Session,
    /// Any other file.
    File,
}

/// Lists `path`; `list` is that of the recent files.
///
/// # Errors
/// [`Error::Io`] when the folder cannot be read.
pub(super) fn list(path: &Path, list: Option<&Path>) -> Result<Listing> {
    let path = path.canonicalize().map_err(Error::io("read", path))?;
    if !path.is_dir() {
        let folder = path.parent().unwrap_or(Path::new("/")).to_path_buf();
        return Ok(Listing { folder, entries: Vec::new(), file: Some(path), note: None });
    }
    let (remembered, mut note) = list.map(recent::read).unwrap_or_default();
    let mut entries: Vec<FileEntry> = remembered.iter().filter_map(|p| entry(p, true)).take(RECENT).collect();
    let mut inside = Vec::new();
    let read = std::fs::read_dir(&path).map_err(Error::io("read", &path))?;
    for (i, found) in read.flatten().enumerate() {
        if i == MOST {
            note = Some(format!("only {MOST} names of this folder are listed; type a path to go on"));
            break;
        }
        inside.extend(entry(&found.path(), false));
    }
    let rank = |e: &FileEntry| (e.kind != FileKind::Folder, e.name.to_lowercase(), e.path.clone());
    inside.sort_by_cached_key(rank);
    entries.extend(inside);
    Ok(Listing { folder: path, entries, file: None, note })
}

/// The line of a file or folder; none where it is neither, or is gone.
fn entry(path: &Path, recent: bool) -> Option<FileEntry> {
    let about = path.metadata().ok()?;
    let kind = if about.is_dir() {
        FileKind::Folder
    } else if !about.is_file() {
        return None;
    } else if is_session(path) {
        FileKind::Session
    } else {
        FileKind::File
    };
    let name = if recent { path.as_os_str() } else { path.file_name()? };
    Some(FileEntry {
        path: path.to_path_buf(),
        name: printable(&name.to_string_lossy()),
        kind,
        size: if kind == FileKind::Folder { 0 } else { about.len() },
        changed: about.modified().ok().map(for_people).unwrap_or_default(),
        recent,
    })
}

fn for_people(time: SystemTime) -> String {
    let stamp = jiff::Timestamp::try_from(time).unwrap_or(jiff::Timestamp::UNIX_EPOCH);
    stamp.strftime("%Y-%m-%d %H:%M").to_string()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn recent_files_come_first_then_folders_then_files() {
        let dir = tempfile::tempdir().unwrap();
        let folder = dir.path().canonicalize().unwrap();
        for name in ["b.csv", "a.toml", "esc\x1b[2J.csv"] {
            std::fs::write(folder.join(name), "t,x\n").unwrap();
        }
        std::fs::create_dir(folder.join("z")).unwrap();
        let state = tempfile::tempdir().unwrap();
        let remembered = state.path().join("recent");
        recent::remember(&remembered, &folder.join("b.csv")).unwrap();
        recent::remember(&remembered, &folder.join("gone.csv")).unwrap();
        let listing = list(&folder, Some(&remembered)).unwrap();
        let names: Vec<&str> = listing.entries.iter().map(|e| e.name.as_str()).collect();
        let whole = folder.join("b.csv").display().to_string();
        assert_eq!(names, [whole.as_str(), "z", "a.toml", "b.csv", "esc\\x1b[2J.csv"]);
        let kinds: Vec<FileKind> = listing.entries.iter().map(|e| e.kind).collect();
        use FileKind::{File, Folder, Session};
        assert_eq!(kinds, [File, Folder, Session, File, File]);
        assert_eq!(listing.entries[3].size, 4);
        let file = list(&folder.join("b.csv"), None).unwrap();
        assert_eq!((file.file, file.folder), (Some(folder.join("b.csv")), folder.clone()));
        assert!(list(&folder.join("none"), None).is_err());
    }
}
