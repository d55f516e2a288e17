//! The hidden files that are being written now, so that a program that is ended in the middle leaves none behind, and
//! no commit half done.

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};
use std::sync::{Mutex, MutexGuard, PoisonError, RwLock, RwLockReadGuard};

static HIDDEN: Mutex<BTreeSet<PathBuf>> = Mutex::new(BTreeSet::new());
/// Read by each commit, of which many may go on side by side, and written by the end of the program.
static COMMITS: RwLock<()> = RwLock::new(());

/// A hidden file, known as long as this lives.
#[derive(Debug)]
pub(super) struct Unfinished(PathBuf);

impl Unfinished {
    pub(super) fn new(path: &Path) -> Self {
        hidden().insert(path.to_path_buf());
        Self(path.to_path_buf())
    }
}

impl Drop for Unfinished {
    fn drop(&mut self) {
        hidden().remove(&self.0);
    }
}

/// Held while files get their names: the program does not end meanwhile.
pub(super) fn commit() -> RwLockReadGuard<'static, ()> {
    COMMITS.read().unwrap_or_else(PoisonError::into_inner)
}

/// Takes the hidden files away, for a program that ends now: waits for the commits that are under way, and lets no other
/// begin.
pub fn take_unfinished_away() {
    std::mem::forget(COMMITS.write().unwrap_or_else(PoisonError::into_inner));
    for path in hidden().iter() {
        // As far as it goes: there is nobody left to tell.
        let _ = std::fs::remove_file(path);
    }
}

fn hidden() -> MutexGuard<'static, BTreeSet<PathBuf>> {
    HIDDEN.lock().unwrap_or_else(PoisonError::into_inner)
}
