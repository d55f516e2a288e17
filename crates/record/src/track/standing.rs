//! What has become of a file since it was loaded: recorders go on writing, and people replace files.

use std::fs::File;
use std::io::{self, BufRead, BufReader, Read, Seek, SeekFrom};
use std::path::Path;

use sha2::{Digest, Sha256};

use super::packing::Stream;
use super::rows::Splitter;
use super::text::hex;
use super::tokens::{RecordKind, Records, is_empty};
use super::view::Want;
use super::{Encoding, Source, Track, Worded};
use crate::error::{Error, Result};

/// How a source stands to the record that was loaded from it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Standing {
    /// It is as it was.
    Same,
    /// It begins with what was loaded, and this many data rows follow.
    Grown {
        /// How many.
        rows: usize,
    },
    /// What was loaded cannot be read any more.
    Lost(Lost),
}

/// Why a record cannot be read again.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Lost {
    /// It is not there any more.
    Deleted,
    /// It is shorter than it was.
    Truncated,
    /// It holds something else.
    Replaced,
    /// The system refuses it.
    Unreadable,
}

impl Worded for Lost {
    const WORDS: &'static [(&'static str, Self)] = &[
        ("deleted", Self::Deleted),
        ("truncated", Self::Truncated),
        ("replaced", Self::Replaced),
        ("unreadable", Self::Unreadable),
    ];
}

impl Standing {
    /// Of the source of `track` now.
    #[must_use]
    pub fn of(track: &Track) -> Self {
        let Source::File(path) = &track.source else { return Self::Same };
        Self::of_file(path, track).unwrap_or(Self::Lost(Lost::Unreadable))
    }

    fn of_file(path: &Path, track: &Track) -> io::Result<Self> {
        let length = match path.metadata() {
            Ok(about) if about.is_file() => about.len(),
            Ok(_) => return Ok(Self::Lost(Lost::Replaced)),
            Err(e) if e.kind() == io::ErrorKind::NotFound => return Ok(Self::Lost(Lost::Deleted)),
            Err(e) => return Err(e),
        };
        if length < track.bytes {
            return Ok(Self::Lost(Lost::Truncated));
        }
        if hash_of(path, track.bytes)? != track.sha256 {
            return Ok(Self::Lost(Lost::Replaced));
        }
        match track.dialect.packing {
            _ if length == track.bytes => Ok(Self::Same),
            // Nothing can be appended to an archive: what follows belongs to another one.
            Some(packing) if !packing.joins => Ok(Self::Lost(Lost::Replaced)),
            _ => Ok(Self::Grown { rows: rows_after(path, track)? }),
        }
    }

    /// What happened, in words that follow on the name of the record.
    #[must_use]
    pub fn words(self) -> String {
        match self {
            Self::Same => "is as it was".into(),
            Self::Grown { rows: 1 } => "has 1 row more".into(),
            Self::Grown { rows } => format!("has {rows} rows more"),
            Self::Lost(Lost::Deleted) => "was deleted or renamed".into(),
            Self::Lost(Lost::Truncated) => "was truncated".into(),
            Self::Lost(Lost::Replaced) => "was replaced".into(),
            Self::Lost(Lost::Unreadable) => "can no longer be read".into(),
        }
    }
}

/// How many bytes from the start of `source` have this SHA-256: `bytes` of them, where that is known. None when its
/// start is another one.
///
/// Without `bytes` (in old sessions) every end of a line is tried.
///
/// # Errors
/// [`Error::Io`] when the source cannot be read.
pub fn covered(source: &Source, sha256: &str, bytes: Option<u64>) -> Result<Option<u64>> {
    let Some(path) = source.file() else { return Ok(None) };
    let found = match bytes {
        Some(bytes) => hash_of(path, bytes).map(|found| (found == sha256).then_some(bytes)),
        None => line_end_with(path, sha256),
    };
    found.map_err(Error::io("read", path))
}

/// SHA-256 of the first bytes of a file.
fn hash_of(path: &Path, bytes: u64) -> io::Result<String> {
    let mut hash = Sha256::new();
    let mut file = File::open(path)?.take(bytes);
    let mut part = vec![0; 1 << 20];
    loop {
        match file.read(&mut part)? {
            0 => return Ok(hex(&hash.finalize())),
            n => hash.update(&part[..n]),
        }
    }
}

/// The length of the start of a file that ends with a line, or just before its end, and has this SHA-256.
fn line_end_with(path: &Path, sha256: &str) -> io::Result<Option<u64>> {
    let mut file = BufReader::with_capacity(1 << 20, File::open(path)?);
    let (mut hash, mut length, mut line) = (Sha256::new(), 0_u64, Vec::new());
    loop {
        line.clear();
        if (&mut file).take(LONGEST_LINE).read_until(b'\n', &mut line)? == 0 {
            return Ok(None);
        }
        // Where the line ends, and before that where its end had not been written.
        let bare = line.len() - line.iter().rev().take_while(|b| matches!(b, b'\n' | b'\r')).count();
        for part in [&line[..bare], &line[bare..]] {
            hash.update(part);
            length += part.len() as u64;
            if hex(&hash.clone().finalize()) == sha256 {
                return Ok(Some(length));
            }
        }
    }
}

/// What is longer is looked at in pieces.
const LONGEST_LINE: u64 = 1 << 20;

/// Data rows after those of `track`. Where it ended in the middle of a line, the rest of that line is not a row.
fn rows_after(path: &Path, track: &Track) -> io::Result<usize> {
    let mut file = File::open(path)?;
    let mut before = [b'\n'];
    if let Some(last) = track.bytes.checked_sub(1).filter(|_| track.dialect.packing.is_none()) {
        file.seek(SeekFrom::Start(last))?;
        file.read_exact(&mut before)?;
    }
    file.seek(SeekFrom::Start(track.bytes))?;
    let mut tail: Stream<'_> = match track.dialect.packing {
        Some(packing) => {
            let opened = packing.unpack(Box::new(io::empty()), Box::new(file), Want::default());
            opened.map_err(|e| io::Error::other(e.what))?.text
        }
        None => Box::new(file),
    };
    let (mut rows, mut open, mut first) = (0, Vec::new(), before != [b'\n'] && before != [b'\r'] && before != [0]);
    loop {
        let mut piece = std::mem::take(&mut open);
        let read = (&mut tail).take(1 << 20).read_to_end(&mut piece)?;
        if let Encoding::Utf16 { .. } = track.dialect.encoding {
            // The line ends are what counts here.
            piece.retain(|b| *b != 0);
        }
        let end = if read == 0 { piece.len() } else { piece.iter().rposition(|b| *b == b'\n').map_or(0, |at| at + 1) };
        open = piece.split_off(end);
        let layout = track.dialect.layout(&piece);
        let mut splitter = Splitter::new(layout);
        for record in Records::new(&piece, layout).flatten() {
            let torn = std::mem::take(&mut first);
            if torn || record.kind != RecordKind::Data {
                continue;
            }
            rows += usize::from(!is_empty(record.bytes, splitter.cells(&record), layout));
        }
        if read == 0 {
            return Ok(rows);
        }
    }
}

#[cfg(test)]
mod tests {
    use std::io::Write as _;

    use super::super::{LoadOptions, load};
    use super::*;

    const START: &str = "t,x\n0,1\n1,2\n2,3\n";

    /// A loaded record, and what has become of its file after `change`.
    fn after(start: &[u8], change: impl FnOnce(&Path)) -> Standing {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.csv");
        std::fs::write(&path, start).unwrap();
        let track = load(&Source::File(path.clone()), &LoadOptions::default()).unwrap();
        change(&path);
        Standing::of(&track)
    }

    fn append(path: &Path, bytes: &[u8]) {
        std::fs::OpenOptions::new().append(true).open(path).unwrap().write_all(bytes).unwrap();
    }

    #[test]
    fn what_became_of_a_file_is_told_apart() {
        let start = START.as_bytes();
        assert_eq!(after(start, |_| ()), Standing::Same);
        assert_eq!(after(start, |p| append(p, b"3,4\n4,5\n")), Standing::Grown { rows: 2 });
        assert_eq!(after(start, |p| append(p, b"# a note\n\n3,4")), Standing::Grown { rows: 1 });
        assert_eq!(after(start, |p| std::fs::write(p, "t,x\n0,1\n").unwrap()), Standing::Lost(Lost::Truncated));
        assert_eq!(
            after(start, |p| std::fs::write(p, START.replace('2', "7")).unwrap()),
            Standing::Lost(Lost::Replaced)
        );
        assert_eq!(
            after(start, |p| std::fs::write(p, START.replace("1,2", "1,22")).unwrap()),
            Standing::Lost(Lost::Replaced)
        );
        assert_eq!(after(start, |p| std::fs::remove_file(p).unwrap()), Standing::Lost(Lost::Deleted));
    }

    #[test]
    fn the_rest_of_a_line_is_no_row() {
        assert_eq!(after(b"t,x\n0,1\n1,2\n2,3", |p| append(p, b".5\n3,4\n")), Standing::Grown { rows: 1 });
        assert_eq!(after(b"t,x\n0,1\n1,2\n2,3", |p| append(p, b"\n")), Standing::Grown { rows: 0 });
    }

    #[test]
    fn packed_and_wide_texts_grow_too() {
        let packed = |text: &str| {
            let mut packer = flate2::write::GzEncoder::new(Vec::new(), flate2::Compression::fast());
            packer.write_all(text.as_bytes()).unwrap();
            packer.finish().unwrap()
        };
        assert_eq!(after(&packed(START), |p| append(p, &packed("3,4\n4,5\n"))), Standing::Grown { rows: 2 });
        let wide = |text: &str| text.encode_utf16().flat_map(u16::to_le_bytes).collect::<Vec<u8>>();
        let start = [&[0xff, 0xfe][..], &wide(START)].concat();
        assert_eq!(after(&start, |p| append(p, &wide("3,4\n4,5\n"))), Standing::Grown { rows: 2 });
    }

    #[test]
    fn the_start_with_a_hash_is_found_without_its_length() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.csv");
        std::fs::write(&path, START.to_owned() + "3,4\r\n4,5\r\n").unwrap();
        let source = Source::File(path);
        for end in [START.len(), START.len() + 3, START.len() + 5] {
            let whole = START.to_owned() + "3,4\r\n";
            let sum = hex(&Sha256::digest(&whole.as_bytes()[..end]));
            assert_eq!(covered(&source, &sum, None).unwrap(), Some(end as u64));
            assert_eq!(covered(&source, &sum, Some(end as u64)).unwrap(), Some(end as u64));
        }
        let sum = hex(&Sha256::digest(&START.as_bytes()[..6]));
        assert_eq!(covered(&source, &sum, None).unwrap(), None, "not at the end of a line");
        assert_eq!(covered(&source, &sum, Some(7)).unwrap(), None);
    }
}
