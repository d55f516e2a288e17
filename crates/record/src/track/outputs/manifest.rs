//! What makes the files of a set appear together, whenever the program is killed: their names are in a manifest before
//! the first of them gets its own, and the next run in the folder finishes what the manifest says, or takes it back.
//!
//! A set is committed when its manifest has its name (`.wildpoint-*.set`). Where files get their names in several
//! folders, the others have a manifest that leads to it. While a set is rolled back, the name is `.wildpoint-*.undo`.

use std::ffi::{OsStr, OsString};
use std::fs::File;
use std::io::{self, Read as _, Write as _};
use std::path::{Path, PathBuf};

use serde::{Deserialize, Serialize};

use super::faults::point;
use super::hidden::{self, DRAFT, PREFIX};
use super::identity::{FileId, FileState};
use super::sync;

/// How the name of a manifest ends, and that of one whose set is rolled back.
const SET: &str = ".set";
const UNDO: &str = ".undo";
/// How the second name of an old content ends.
const BACKUP: &str = ".old";

/// A manifest larger than this is none.
const LARGEST: u64 = 16 << 20;

/// What a manifest says.
#[derive(Debug, Serialize, Deserialize)]
enum Content {
    /// The files of the set.
    Set(Vec<Member>),
    /// The manifest of the set is there.
    At(OsString),
}

/// A file of a set.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub(super) struct Member {
    /// Its folder; none for that of the manifest, which may be moved.
    folder: Option<OsString>,
    target: OsString,
    /// What it is called before.
    hidden: OsString,
    /// What the old content is called meanwhile.
    backup: OsString,
    /// What was there before.
    old: Option<FileState>,
    /// The file itself.
    new: Option<FileId>,
}

/// A file to be named by a set: where it is, and what it is to be called.
#[derive(Debug, Clone, Copy)]
pub(super) struct Naming<'a> {
    pub(super) hidden: &'a Path,
    pub(super) target: &'a Path,
}

/// A set that is committed and not finished. Its manifest is held by this process.
#[derive(Debug)]
pub(super) struct Manifest {
    path: PathBuf,
    /// Manifests that lead to it.
    pointers: Vec<PathBuf>,
    members: Vec<Member>,
    _held: Vec<File>,
}

impl Manifest {
    /// Commits a set: from here on it is finished or rolled back, whatever happens.
    pub(super) fn commit(files: &[Naming<'_>]) -> io::Result<Self> {
        let folder = |path: &Path| path.parent().map(Path::to_path_buf).unwrap_or_default();
        let Some(home) = files.first().map(|f| folder(f.target)) else {
            return Err(io::ErrorKind::InvalidInput.into());
        };
        let mut draft = hidden::create(&home)?;
        let path = named(draft.path(), SET);
        let members: Vec<Member> = files.iter().map(|f| Member::new(f, &home)).collect();
        write(draft.as_file_mut(), &Content::Set(members.clone()))?;
        let mut others: Vec<PathBuf> = files.iter().map(|f| folder(f.target)).filter(|f| *f != home).collect();
        others.sort();
        others.dedup();
        let (mut pointers, mut held) = (Vec::new(), Vec::new());
        for other in &others {
            let mut pointer = hidden::create(other)?;
            write(pointer.as_file_mut(), &Content::At(path.clone().into()))?;
            let name = named(pointer.path(), SET);
            point()?;
            held.push(pointer.persist(&name)?);
            pointers.push(name);
            sync(other)?;
        }
        let committed = point().and_then(|()| Ok(draft.persist(&path)?));
        match committed.and_then(|file| sync(&home).map(|()| file)) {
            Ok(file) => held.push(file),
            Err(e) => {
                // As far as it goes: what stays leads to files that are not there.
                pointers.iter().chain([&path]).for_each(|path| drop(std::fs::remove_file(path)));
                return Err(e);
            }
        }
        Ok(Self { path, pointers, members, _held: held })
    }

    /// Gives the old content of a target a second name, where the file system has such.
    pub(super) fn keep(&self, target: &Path) {
        let member = self.members.iter().find(|m| self.place(m, &m.target) == target);
        if let Some(member) = member.filter(|m| m.old.is_some()) {
            let _ = point().and_then(|()| std::fs::hard_link(target, self.place(member, &member.backup)));
        }
    }

    /// Ends it: every file has its name.
    pub(super) fn finish(self) {
        self.members.iter().for_each(|m| drop(std::fs::remove_file(self.place(m, &m.backup))));
        self.remove();
    }

    /// Takes it back: every target is what it was.
    pub(super) fn undo(mut self) {
        let path = named(&self.path, UNDO);
        if std::fs::rename(&self.path, &path).is_ok() {
            self.path = path;
        }
        for member in &self.members {
            let [target, hidden, backup] =
                [&member.target, &member.hidden, &member.backup].map(|n| self.place(member, n));
            // Where files cannot be told apart, the one that has left its first name has the other.
            let renamed = member.new.map_or(!hidden.exists(), |id| FileId::at(&target) == Some(id));
            if backup.exists() {
                if renamed || !target.exists() {
                    let _ = std::fs::rename(&backup, &target);
                }
                let _ = std::fs::remove_file(&backup);
            } else if renamed && member.old.is_none() {
                let _ = std::fs::remove_file(&target);
            }
            let _ = std::fs::remove_file(&hidden);
        }
        self.remove();
    }

    /// Finishes the set of a dead run, or takes it back where somebody has changed a target since.
    fn recover(self) {
        if self.path.extension() == Some(OsStr::new(&UNDO[1..])) || !self.members.iter().all(|m| self.can_finish(m)) {
            return self.undo();
        }
        for member in &self.members {
            let [target, hidden] = [&member.target, &member.hidden].map(|n| self.place(member, n));
            if hidden.exists() && (std::fs::rename(&hidden, &target).is_err()) {
                return self.undo();
            }
            // Two names of one file are left alone by a rename.
            let _ = std::fs::remove_file(&hidden);
        }
        self.finish();
    }

    /// Whether a file has its name, or can be given it without loss.
    fn can_finish(&self, member: &Member) -> bool {
        let [target, hidden] = [&member.target, &member.hidden].map(|n| self.place(member, n));
        let untouched = FileState::at(&target) == member.old;
        !hidden.exists() || untouched || FileId::at(&target).is_some_and(|id| Some(id) == member.new)
    }

    /// The path of one of the names of a member.
    fn place(&self, member: &Member, name: &OsStr) -> PathBuf {
        let home = self.path.parent().map(Path::to_path_buf).unwrap_or_default();
        member.folder.as_ref().map_or(home, PathBuf::from).join(name)
    }

    fn remove(&self) {
        let _ = std::fs::remove_file(&self.path);
        self.pointers.iter().for_each(|path| drop(std::fs::remove_file(path)));
    }
}

impl Member {
    fn new(file: &Naming<'_>, home: &Path) -> Self {
        let folder = file.target.parent().unwrap_or(Path::new(""));
        let name = |path: &Path| path.file_name().unwrap_or_default().to_owned();
        Self {
            folder: (folder != home).then(|| folder.as_os_str().to_owned()),
            target: name(file.target),
            backup: name(&named(file.hidden, BACKUP)),
            hidden: name(file.hidden),
            old: FileState::at(file.target),
            new: FileId::at(file.hidden),
        }
    }

    /// Whether its names are of the kind that this program gives.
    fn is_ours(&self) -> bool {
        let plain = |name: &OsStr| Path::new(name).file_name() == Some(name);
        let hidden = |name: &OsStr| plain(name) && name.as_encoded_bytes().starts_with(PREFIX.as_bytes());
        plain(&self.target) && hidden(&self.hidden) && hidden(&self.backup)
    }
}

/// Finishes or takes back the sets of dead runs that have a manifest in `folder`, and takes away what those left that
/// were killed before they committed. Only files of the user `owner` are touched.
pub(super) fn tidy(folder: &Path, owner: Option<u32>) {
    let names = |ending: &[&str]| -> Vec<PathBuf> {
        let Ok(entries) = std::fs::read_dir(folder) else { return Vec::new() };
        let ours = |name: &OsStr| {
            let name = name.as_encoded_bytes();
            name.starts_with(PREFIX.as_bytes()) && ending.iter().any(|e| name.ends_with(e.as_bytes()))
        };
        entries.flatten().filter(|e| ours(&e.file_name())).map(|e| e.path()).collect()
    };
    let own = |path: &PathBuf| path.symlink_metadata().is_ok_and(|about| about.is_file() && user(&about) == owner);
    names(&[SET, UNDO]).iter().filter(|path| own(path)).for_each(|path| settle(path, owner));
    // What a set still needs is left to whoever can finish it.
    let waiting = !names(&[SET, UNDO]).is_empty();
    for path in names(&[DRAFT]).iter().filter(|path| !waiting && own(path)) {
        if let Some(_held) = hidden::take(path) {
            let _ = std::fs::remove_file(path);
        }
    }
}

/// Finishes or takes back the set of a manifest, if its run is dead.
fn settle(path: &Path, owner: Option<u32>) {
    let Some(held) = hidden::take(path) else { return };
    match read(&held) {
        Some(Content::Set(members)) if members.iter().all(Member::is_ours) => {
            let manifest = Manifest { path: path.to_path_buf(), pointers: Vec::new(), members, _held: vec![held] };
            manifest.recover();
        }
        Some(Content::At(there)) => {
            let set = PathBuf::from(there);
            for set in [named(&set, SET), named(&set, UNDO)] {
                if set.symlink_metadata().is_ok_and(|about| about.is_file() && user(&about) == owner) {
                    settle(&set, owner);
                    if set.exists() {
                        return;
                    }
                }
            }
            let _ = std::fs::remove_file(path);
        }
        // What is not understood, a later version may understand.
        _ => {}
    }
}

fn read(mut file: &File) -> Option<Content> {
    let mut text = Vec::new();
    (&mut file).take(LARGEST).read_to_end(&mut text).ok()?;
    serde_json::from_slice(&text).ok()
}

fn write(file: &mut File, content: &Content) -> io::Result<()> {
    point()?;
    serde_json::to_writer(&mut *file, content)?;
    file.flush()?;
    point()?;
    file.sync_all()
}

/// The same name with another ending.
fn named(path: &Path, ending: &str) -> PathBuf {
    path.with_extension(ending.trim_start_matches('.'))
}

/// The user whose file it is; none where files have none.
#[cfg(unix)]
pub(super) fn user(about: &std::fs::Metadata) -> Option<u32> {
    Some(std::os::unix::fs::MetadataExt::uid(about))
}

#[cfg(not(unix))]
pub(super) fn user(_: &std::fs::Metadata) -> Option<u32> {
    None
}
