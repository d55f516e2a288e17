//! Which file a path leads to. Two paths of one file may have nothing in common: hard links, bind mounts, names that
//! differ in case where the file system does not care.

use std::fs::Metadata;
use std::path::{Path, PathBuf};

use serde::{Deserialize, Serialize};

/// A file, however it is reached.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub(super) struct FileId {
    device: u64,
    inode: u64,
}

impl FileId {
    /// Of the file with this metadata; none where the system does not tell.
    #[cfg(unix)]
    pub(super) fn of(about: &Metadata) -> Option<Self> {
        use std::os::unix::fs::MetadataExt as _;
        Some(Self { device: about.dev(), inode: about.ino() })
    }

    #[cfg(not(unix))]
    pub(super) fn of(_: &Metadata) -> Option<Self> {
        None
    }

    /// Of the file that `path` leads to.
    pub(super) fn at(path: &Path) -> Option<Self> {
        path.metadata().ok().as_ref().and_then(Self::of)
    }
}

/// A file at a moment: the same as long as nobody writes to it or puts another in its place.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub(super) struct FileState {
    id: Option<FileId>,
    bytes: u64,
    /// Nanoseconds since 1970.
    modified: u128,
}

impl FileState {
    pub(super) fn at(path: &Path) -> Option<Self> {
        let about = path.symlink_metadata().ok()?;
        let modified = about.modified().ok()?.duration_since(std::time::UNIX_EPOCH).map_or(0, |t| t.as_nanos());
        Some(Self { id: FileId::of(&about), bytes: about.len(), modified })
    }
}

/// A file that no output may take the place of.
#[derive(Debug, Clone)]
pub(super) struct Protected {
    /// Where it is, or was.
    path: PathBuf,
    id: Option<FileId>,
}

impl Protected {
    pub(super) fn new(path: &Path) -> Self {
        let folder = path.parent().filter(|p| !p.as_os_str().is_empty()).unwrap_or(Path::new("."));
        let named = || Some(folder.canonicalize().ok()?.join(path.file_name()?));
        let whole = path.canonicalize().ok().or_else(named).unwrap_or_else(|| path.to_path_buf());
        Self { id: FileId::at(path), path: whole }
    }

    /// Whether it is this file, which is there or not.
    pub(super) fn is(&self, target: &Path, existing: Option<&Metadata>) -> bool {
        let same = existing.and_then(FileId::of).is_some_and(|id| self.id == Some(id));
        same || self.path == target
    }
}
