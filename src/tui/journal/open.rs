//! The file of a journal that is being written.

use std::fs::File;
use std::io::{Seek, SeekFrom, Write};
use std::path::PathBuf;
use std::time::Instant;

use super::files;
use crate::error::Error;
use crate::session::journal::{Encoder, Entry, Header};

/// A journal's file, which ends with a whole line.
pub(super) struct Open {
    pub(super) path: PathBuf,
    pub(super) file: File,
    encoder: Encoder,
    /// Its length.
    bytes: u64,
    /// How many entries are in it.
    pub(super) entries: usize,
    /// True when its end is not a whole line after all, and could not be cut off.
    pub(super) torn: bool,
    /// Since when something is not on the disk.
    pub(super) dirty: Option<Instant>,
}

impl Open {
    /// Makes the file with all that it begins with, whole or not at all.
    ///
    /// # Errors
    /// [`Error::Io`]; nothing is left behind then.
    pub(super) fn create(path: PathBuf, header: &Header, entries: &[Entry]) -> Result<Self, Error> {
        let (mut encoder, mut text) = Encoder::new(header);
        entries.iter().for_each(|entry| text.push_str(&encoder.entry(entry)));
        let folder = path.parent().map(std::path::Path::to_path_buf).unwrap_or_default();
        let made = files::create(&path).and_then(|(mut file, draft)| {
            let whole = (|| {
                file.write_all(text.as_bytes())?;
                file.sync_data()?;
                std::fs::rename(&draft, &path)?;
                files::sync(&folder)
            })();
            if whole.is_err() {
                let _ = std::fs::remove_file(&draft);
            }
            whole.map(|()| file)
        });
        let file = made.map_err(Error::io("write", &path))?;
        let (bytes, entries) = (text.len() as u64, entries.len());
        Ok(Self { path, file, encoder, bytes, entries, torn: false, dirty: None })
    }

    /// Writes those of `all` entries that are not in the file yet.
    ///
    /// # Errors
    /// [`Error::Io`]; the file is as it was then, unless it is `torn`.
    pub(super) fn append(&mut self, all: &[Entry]) -> Result<(), Error> {
        let missing = all.get(self.entries..).unwrap_or_default();
        if missing.is_empty() {
            return Ok(());
        }
        let mut encoder = self.encoder.clone();
        let text: String = missing.iter().map(|entry| encoder.entry(entry)).collect();
        // One write without a buffer: it is in the system's hands when this returns, whatever becomes of us.
        if let Err(e) = self.file.write_all(text.as_bytes()) {
            let cut = self.file.set_len(self.bytes).and_then(|()| self.file.seek(SeekFrom::Start(self.bytes)));
            self.torn = cut.is_err();
            return Err(Error::io("write", &self.path)(e));
        }
        self.encoder = encoder;
        self.bytes += text.len() as u64;
        self.entries = all.len();
        self.dirty.get_or_insert_with(Instant::now);
        Ok(())
    }

    /// False when the file is no longer what lies under its name: it was removed, or another took its place.
    pub(super) fn is_in_place(&self) -> bool {
        let (Ok(there), Ok(own)) = (std::fs::symlink_metadata(&self.path), self.file.metadata()) else { return false };
        same_file(&there, &own)
    }
}

#[cfg(unix)]
fn same_file(a: &std::fs::Metadata, b: &std::fs::Metadata) -> bool {
    use std::os::unix::fs::MetadataExt as _;
    (a.dev(), a.ino()) == (b.dev(), b.ino())
}

#[cfg(not(unix))]
fn same_file(_: &std::fs::Metadata, _: &std::fs::Metadata) -> bool {
    true
}
