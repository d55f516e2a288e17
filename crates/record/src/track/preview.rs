//! The first part of a file, loaded: what a picker shows before the whole is read.

use std::io::Read;
use std::path::Path;

use super::columnar::{refuse_layout, with_layout};
use super::feed::Supply;
use super::view::Want;
use super::{Extent, LoadOptions, Source, Track, Wanted, for_each_row, load_while};
use crate::error::{Error, Result};

/// What the loader makes of the first part of a file.
#[derive(Debug)]
pub struct Preview {
    /// The record of that part.
    pub track: Track,
    /// Size of the file in bytes, as it is stored.
    pub size: u64,
    /// How much of the file was read, from 0 to 1; 1 is all of it.
    pub share: f64,
    /// The cells of the first rows, as the loader parts them.
    pub first: Vec<Vec<String>>,
}

/// Rows whose cells are kept.
const FIRST: usize = 20;

impl Preview {
    /// Loads the first `most` bytes of text of the file `path` under `options`.
    ///
    /// # Errors
    /// As [`load_while`].
    pub fn of(path: &Path, options: &LoadOptions, most: u64, wanted: Wanted<'_>) -> Result<Self> {
        // Looked at before it is opened: a pipe would wait for its other end.
        let about = path.metadata().map_err(Error::io("read", path))?;
        if about.is_dir() {
            return Err(Error::input(path, "this is a folder", "name one of the files in it"));
        }
        if !about.is_file() {
            return Err(Error::input(path, "this is no ordinary file", "name a file with a record"));
        }
        let (supply, _) = Supply::open(path, Extent::All, Want { table: options.table })?;
        let columnar = supply.packing().filter(|packing| packing.is_columnar());
        let facts = supply.facts();
        let (mut bytes, share) = beginning(supply, about.len(), most).map_err(Error::io("read", path))?;
        if share < 1.0 {
            whole_lines(&mut bytes);
        }
        let laid_out = if let Some(packing) = columnar {
            refuse_layout(options, packing, path)?;
            let laid_out = with_layout(options);
            &facts.map_or(laid_out.clone(), |facts| facts.with_time(laid_out))
        } else {
            options
        };
        Self::of_bytes(&bytes, laid_out, about.len(), share, wanted).map_err(|e| renamed(e, path))
    }

    /// [`Preview::of`] for a record that is in memory.
    ///
    /// # Errors
    /// As [`load_while`].
    pub fn of_bytes(bytes: &[u8], options: &LoadOptions, size: u64, share: f64, wanted: Wanted<'_>) -> Result<Self> {
        let source = Source::BuiltIn { name: NAME, bytes: bytes.into() };
        let track = load_while(&source, options, wanted)?;
        let mut first = Vec::new();
        let ended = for_each_row(&track, |_, cells| {
            if first.len() == FIRST {
                return Err(Error::Stopped);
            }
            first.push((0..cells.len()).map(|c| cells.text(c).into_owned()).collect());
            Ok(())
        });
        match ended {
            Ok(()) | Err(Error::Stopped) => Ok(Self { track, size, share, first }),
            Err(e) => Err(e),
        }
    }

    /// Rows of the whole file, and whether that is an estimate.
    #[must_use]
    #[expect(
        clippy::cast_precision_loss,
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "an estimate"
    )]
    pub fn rows(&self) -> (usize, bool) {
        if self.share >= 1.0 {
            return (self.track.rows, false);
        }
        ((self.track.rows as f64 / self.share.max(1e-9)) as usize, true)
    }
}

/// What the part is called while it is loaded.
const NAME: &str = "wildpoint:preview";

/// The same error about the file itself.
fn renamed(e: Error, path: &Path) -> Error {
    match e {
        Error::Input { line, what, help, .. } => Error::Input { path: path.to_path_buf(), line, what, help },
        Error::Io { action, source, .. } => Error::Io { action, path: path.to_path_buf(), source },
        other => other,
    }
}

/// The first `most` bytes of text, and their share of the file.
#[expect(clippy::cast_precision_loss, reason = "a share")]
fn beginning(mut supply: Supply<'_>, size: u64, most: u64) -> std::io::Result<(Vec<u8>, f64)> {
    let mut bytes = Vec::new();
    (&mut supply).take(most + 1).read_to_end(&mut bytes)?;
    let whole = bytes.len() as u64 <= most;
    bytes.truncate(usize::try_from(most).unwrap_or(usize::MAX));
    let read = if supply.packing().is_some() { supply.bytes_read() } else { most };
    Ok((bytes, if whole { 1.0 } else { (read as f64 / size.max(1) as f64).min(0.999) }))
}

/// Cuts what follows the last whole line.
fn whole_lines(bytes: &mut Vec<u8>) {
    let end = match bytes.as_slice() {
        [0xff, 0xfe, ..] => pairs_until(bytes, [b'\n', 0]),
        [0xfe, 0xff, ..] => pairs_until(bytes, [0, b'\n']),
        _ => bytes.iter().rposition(|b| *b == b'\n').map(|at| at + 1),
    };
    bytes.truncate(end.unwrap_or(bytes.len()));
}

/// Where the last of these pairs of bytes ends.
fn pairs_until(bytes: &[u8], pair: [u8; 2]) -> Option<usize> {
    let at = bytes.chunks_exact(2).rposition(|p| p == pair)?;
    Some((at + 1) * 2)
}

#[cfg(test)]
mod tests {
    use std::io::Write as _;

    use super::*;

    fn written(name: &str, bytes: &[u8]) -> (tempfile::TempDir, std::path::PathBuf) {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join(name);
        std::fs::write(&path, bytes).unwrap();
        (folder, path)
    }

    fn rows(n: usize) -> String {
        let rows: String = (0..n).map(|i| format!("{i:06},{:03}\n", i % 7)).collect();
        "t,x\n".to_owned() + &rows
    }

    #[test]
    fn a_small_file_is_known_whole_and_a_large_one_by_its_beginning() {
        let (_folder, path) = written("a.csv", rows(1000).as_bytes());
        let preview = Preview::of(&path, &LoadOptions::default(), 1 << 20, Wanted::always()).unwrap();
        assert_eq!((preview.rows(), preview.first.len()), ((1000, false), FIRST));
        assert_eq!(preview.first[2], ["000002", "002"]);
        // Rows of 11 bytes: a tenth of the file is about a tenth of the rows, all of them whole.
        let preview = Preview::of(&path, &LoadOptions::default(), 1100, Wanted::always()).unwrap();
        let (rows, estimated) = preview.rows();
        assert!(estimated && (980..=1020).contains(&rows), "{rows}");
        assert_eq!(preview.track.rows, 99, "the last, which is cut, is no row");
        assert!(preview.track.faults.ragged_rows.count == 0);
    }

    #[test]
    fn packed_and_wide_texts_have_a_beginning_too() {
        let mut packed = flate2::write::GzEncoder::new(Vec::new(), flate2::Compression::default());
        packed.write_all(rows(20_000).as_bytes()).unwrap();
        let (_folder, path) = written("a.csv.gz", &packed.finish().unwrap());
        let preview = Preview::of(&path, &LoadOptions::default(), 30_000, Wanted::always()).unwrap();
        assert!(preview.rows().1 && preview.track.rows > 2000);
        let wide: Vec<u8> =
            [0xff, 0xfe].into_iter().chain(rows(1000).encode_utf16().flat_map(u16::to_le_bytes)).collect();
        let (_folder, path) = written("w.csv", &wide);
        assert_eq!(Preview::of(&path, &LoadOptions::default(), 2_205, Wanted::always()).unwrap().track.rows, 99);
    }

    #[test]
    fn errors_name_the_file() {
        let (folder, path) = written("words.csv", b"a,b\nx,y\nz,w\n");
        let error = |path: &Path| {
            Preview::of(path, &LoadOptions::default(), 1 << 20, Wanted::always()).unwrap_err().to_string()
        };
        assert!(error(&path).contains("words.csv:1"), "{}", error(&path));
        assert!(error(folder.path()).contains("folder"));
        assert!(error(&folder.path().join("gone")).contains("gone: cannot read"));
    }
}
