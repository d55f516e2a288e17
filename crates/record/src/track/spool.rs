//! Standard input as a record: it is read once, into a file, because a record is read several times.

use std::io::{BufWriter, Read, Write as _};
use std::path::Path;
use std::sync::Arc;

use tempfile::TempPath;

use super::Source;
use crate::error::{Error, Result};

/// The name of a file that means standard input, and of an output that means standard output.
pub const DASH: &str = "-";

/// What standard input gave, in a file that is removed with the last of these.
#[derive(Debug, Clone)]
pub struct Spool(Arc<TempPath>);

impl Spool {
    /// The file.
    pub(super) fn path(&self) -> &Path {
        &self.0
    }
}

impl PartialEq for Spool {
    fn eq(&self, other: &Self) -> bool {
        self.path() == other.path()
    }
}

impl Eq for Spool {}

impl Source {
    /// The record that a user means by `path`: standard input for `-`, otherwise a file.
    ///
    /// # Errors
    /// [`Error::Io`] when standard input cannot be read, or there is no room for it.
    pub fn of(path: &Path) -> Result<Self> {
        if path != Path::new(DASH) {
            return Ok(Self::File(path.to_path_buf()));
        }
        Self::spooled(&mut std::io::stdin().lock())
    }

    /// All that `input` gives.
    fn spooled(input: &mut dyn Read) -> Result<Self> {
        let folder = std::env::temp_dir();
        let unwritable = || Error::io("write to", &folder);
        let mut file = tempfile::Builder::new().prefix("wildpoint-").tempfile().map_err(unwritable())?;
        let mut part = vec![0; 1 << 16];
        let mut buffer = BufWriter::new(file.as_file_mut());
        loop {
            match input.read(&mut part) {
                Ok(0) => break,
                Ok(n) => buffer.write_all(&part[..n]).map_err(unwritable())?,
                Err(e) if e.kind() == std::io::ErrorKind::Interrupted => {}
                Err(e) => return Err(Error::io("read", "standard input")(e)),
            }
        }
        buffer.flush().map_err(unwritable())?;
        drop(buffer);
        Ok(Self::Input(Spool(Arc::new(file.into_temp_path()))))
    }

    /// The file that its bytes are in, where they are in one.
    pub(super) fn file(&self) -> Option<&Path> {
        match self {
            Self::File(path) => Some(path),
            Self::Input(spool) => Some(spool.path()),
            Self::BuiltIn { .. } => None,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::{LoadOptions, for_each_row, load};
    use super::*;

    #[test]
    fn standard_input_is_a_record_like_any_other_and_leaves_nothing() {
        let source = Source::spooled(&mut &b"t,x\n0,1\n1,2\n2,3\n"[..]).unwrap();
        let file = source.file().unwrap().to_path_buf();
        let track = load(&source, &LoadOptions::default()).unwrap();
        assert_eq!((track.rows, track.source.name(), track.source.path()), (3, "standard input".to_owned(), None));
        let mut rows = 0;
        for_each_row(&track, |_, _| {
            rows += 1;
            Ok(())
        })
        .unwrap();
        assert_eq!(rows, 3);
        assert!(file.exists());
        drop((source, track));
        assert!(!file.exists());
    }
}
