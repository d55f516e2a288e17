//! How this workbench last read or wrote its session files, so that it does not write over what somebody else, in another
//! workbench perhaps, has put there since.

use std::collections::HashMap;
use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex, PoisonError};

use sha2::{Digest, Sha256};

/// The content of files as it was here last. Clones share it.
#[derive(Debug, Clone, Default)]
pub struct Known(Arc<Mutex<HashMap<PathBuf, [u8; 32]>>>);

impl Known {
    /// Notes what is in the file now; nothing where it cannot be read.
    pub fn read(&self, path: &Path) {
        if let Ok(content) = std::fs::read(path) {
            self.wrote(path, &content);
        }
    }

    /// Notes what was written to the file.
    pub fn wrote(&self, path: &Path, content: &[u8]) {
        self.0.lock().unwrap_or_else(PoisonError::into_inner).insert(whole(path), Sha256::digest(content).into());
    }

    /// True when the file still is as it was here last.
    #[must_use]
    pub fn still(&self, path: &Path) -> bool {
        let then = self.0.lock().unwrap_or_else(PoisonError::into_inner).get(&whole(path)).copied();
        then.is_some_and(|then| std::fs::read(path).is_ok_and(|now| then == <[u8; 32]>::from(Sha256::digest(now))))
    }
}

/// One name for a file, however it is reached.
fn whole(path: &Path) -> PathBuf {
    path.canonicalize().unwrap_or_else(|_| path.to_path_buf())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_file_is_known_until_somebody_changes_it() {
        let folder = tempfile::tempdir().unwrap();
        let file = folder.path().join("a.toml");
        std::fs::write(&file, "one").unwrap();
        let known = Known::default();
        assert!(!known.still(&file));
        known.read(&file);
        assert!(known.still(&file) && known.clone().still(&folder.path().join(".").join("a.toml")));
        std::fs::write(&file, "two").unwrap();
        assert!(!known.still(&file));
        known.wrote(&file, b"two");
        assert!(known.still(&file));
        std::fs::remove_file(&file).unwrap();
        assert!(!known.still(&file));
    }
}
