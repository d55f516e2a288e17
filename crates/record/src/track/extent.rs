//! How much of a source is read. A file that is still being written has one length only if it is measured once.

use super::Source;

/// How much of a source is read, in bytes as they are stored.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Extent {
    /// All there is.
    All,
    /// This many bytes from its start; a source may have been appended to since.
    First(u64),
}

impl Extent {
    /// The extent that stays the same while a file grows: all of it means all of it as it is now.
    pub(super) fn settled(self, source: &Source) -> Self {
        match (self, source.file().and_then(|path| path.metadata().ok())) {
            // Some file systems say 0 for files that they make while they are read.
            (Self::All, Some(about)) if about.is_file() && about.len() > 0 => Self::First(about.len()),
            _ => self,
        }
    }

    /// The most bytes that are read.
    pub(super) fn most(self) -> u64 {
        match self {
            Self::All => u64::MAX,
            Self::First(bytes) => bytes,
        }
    }
}
