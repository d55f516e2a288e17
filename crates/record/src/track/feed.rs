//! A text read piece by piece, cut at line ends, so that memory never holds the whole of it.

use std::fmt;
use std::fs::File;
use std::io::{self, Read};
use std::path::Path;
use std::sync::{Arc, Mutex, PoisonError};

use memchr::{memchr, memrchr};
use sha2::{Digest, Sha256};

use super::facts::Facts;
use super::packing::{Packing, Stream};
use super::text::hex;
use super::view::Want;
use super::{Extent, Wanted};
use crate::error::{Error, Result as Outcome};
use crate::memory::{Full, Share};

/// Why a text cannot be read piece by piece.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Unfit {
    /// It is not the UTF-8 that it was taken for.
    NotUtf8,
    /// It cannot be read, or it is not a text file: reading it whole tells what and where.
    Unreadable,
    /// A line is longer than there is memory.
    Full(Full),
}

impl From<io::Error> for Unfit {
    fn from(_: io::Error) -> Self {
        Self::Unreadable
    }
}

/// Where the bytes of a text come from.
#[derive(Debug)]
pub(crate) enum Supply<'a> {
    /// Memory.
    Bytes(&'a [u8]),
    /// A file as it is.
    Plain(Hashed),
    /// A packed file.
    Packed(Unpacked),
}

/// The text of a packed file.
pub(crate) struct Unpacked {
    packing: &'static Packing,
    text: Stream<'static>,
    facts: Option<Arc<Facts>>,
    file: Arc<Mutex<Hashed>>,
}

impl fmt::Debug for Unpacked {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Unpacked").field("packing", &self.packing).finish_non_exhaustive()
    }
}

/// What unpacks a file reads it through this.
struct Shared(Arc<Mutex<Hashed>>);

impl Read for Shared {
    fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner).read(buffer)
    }
}

/// A file whose bytes are hashed as they pass.
#[derive(Debug)]
pub(crate) struct Hashed {
    file: io::Take<File>,
    bytes: u64,
    hash: Sha256,
}

impl Read for Hashed {
    fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
        let read = self.file.read(buffer)?;
        self.hash.update(&buffer[..read]);
        self.bytes += read as u64;
        Ok(read)
    }
}

impl Read for Supply<'_> {
    fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
        match self {
            Self::Bytes(bytes) => bytes.read(buffer),
            Self::Plain(file) => file.read(buffer),
            Self::Packed(file) => file.text.read(buffer),
        }
    }
}

impl Supply<'static> {
    /// The text of the file at `path`, of so much of it, unpacked if it is packed, and about how many bytes it has; of
    /// several tables that it stores the wanted one.
    ///
    /// # Errors
    /// [`Error::Io`] when it cannot be opened, [`Error::Input`] when it cannot be unpacked.
    pub(crate) fn open(path: &Path, extent: Extent, want: Want) -> Outcome<(Self, u64)> {
        let unreadable = || Error::io("read", path);
        let mut file = File::open(path).map_err(unreadable())?;
        let length = file.metadata().map_err(unreadable())?.len().min(extent.most());
        let packing = Packing::of_file(&mut file).map_err(unreadable())?;
        let hashed = Hashed { file: file.take(extent.most()), bytes: 0, hash: Sha256::new() };
        let Some(packing) = packing else { return Ok((Self::Plain(hashed), length)) };
        let file = Arc::new(Mutex::new(hashed));
        let directory = File::open(path).map_err(unreadable())?;
        let opened = packing.unpack(Box::new(directory), Box::new(Shared(Arc::clone(&file))), want);
        let opened = opened.map_err(|e| e.of_file(path))?;
        // Decimal numbers pack to a third or a quarter; what is wrong with the guess costs nothing but address space.
        let unpacked = Unpacked { packing, text: opened.text, facts: opened.facts, file };
        Ok((Self::Packed(unpacked), length.saturating_mul(4)))
    }
}

impl Supply<'_> {
    /// How the file is packed.
    pub(crate) fn packing(&self) -> Option<&'static Packing> {
        match self {
            Self::Packed(file) => Some(file.packing),
            Self::Bytes(_) | Self::Plain(_) => None,
        }
    }

    /// What the file says of its columns, where it stores such.
    pub(crate) fn facts(&self) -> Option<Arc<Facts>> {
        match self {
            Self::Packed(file) => file.facts.clone(),
            Self::Bytes(_) | Self::Plain(_) => None,
        }
    }

    /// How many bytes of the file, as they are stored, have been read.
    pub(crate) fn bytes_read(&self) -> u64 {
        match self {
            Self::Bytes(_) => 0,
            Self::Plain(file) => file.bytes,
            Self::Packed(file) => file.file.lock().unwrap_or_else(PoisonError::into_inner).bytes,
        }
    }

    /// SHA-256 of the bytes as they are stored, of all of them, and how many they are: what has not been read yet is
    /// read for it.
    pub(crate) fn sha256(self) -> io::Result<(String, u64)> {
        let finished = |hashed: &mut Hashed| {
            io::copy(hashed, &mut io::sink())?;
            Ok((hex(&hashed.hash.clone().finalize()), hashed.bytes))
        };
        match self {
            Self::Bytes(bytes) => Ok((hex(&Sha256::digest(bytes)), bytes.len() as u64)),
            Self::Plain(mut file) => finished(&mut file),
            Self::Packed(file) => finished(&mut file.file.lock().unwrap_or_else(PoisonError::into_inner)),
        }
    }
}

/// Cuts a text into waves that end at line ends.
#[derive(Debug)]
pub(crate) struct Feed<'a> {
    supply: Supply<'a>,
    /// What has been read and not been given yet.
    tail: Vec<u8>,
    line_end: u8,
    /// Whether the text is to be looked at for bytes that are not text, and whether it must be UTF-8.
    check: Option<Check>,
    ended: bool,
    /// Asked before each read.
    wanted: Wanted<'a>,
    /// What a line takes that is longer than a wave.
    share: Share,
}

/// What a text must be.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Check {
    /// UTF-8 without NUL.
    Utf8,
    /// Anything without NUL.
    Bytes,
}

impl Check {
    /// Looks at whole lines: a line end is no part of a longer character.
    pub(crate) fn of(self, lines: &[u8]) -> Result<(), Unfit> {
        match self {
            _ if memchr(0, lines).is_some() => Err(Unfit::Unreadable),
            Self::Utf8 if std::str::from_utf8(lines).is_err() => Err(Unfit::NotUtf8),
            _ => Ok(()),
        }
    }
}

impl<'a> Feed<'a> {
    /// A text from memory, which was checked before.
    pub(crate) fn of(text: &'a [u8], line_end: u8) -> Self {
        let wanted = Wanted::always();
        Self {
            supply: Supply::Bytes(text),
            tail: Vec::new(),
            line_end,
            check: None,
            ended: false,
            wanted,
            share: Share::default(),
        }
    }

    /// A text whose lines end with a line feed.
    pub(crate) fn new(supply: Supply<'a>, check: Check) -> Self {
        let wanted = Wanted::always();
        Self {
            supply,
            tail: Vec::new(),
            line_end: b'\n',
            check: Some(check),
            ended: false,
            wanted,
            share: Share::default(),
        }
    }

    /// The same, read only for as long as it is wanted.
    pub(crate) fn while_wanted(self, wanted: Wanted<'a>) -> Self {
        Self { wanted, ..self }
    }

    /// Reads at least this many bytes, if there are as many, that the next wave will start with.
    pub(crate) fn peek(&mut self, size: usize) -> Result<&[u8], Unfit> {
        let more = size.saturating_sub(self.tail.len());
        self.ended |= (&mut self.supply).take(more as u64).read_to_end(&mut self.tail)? < more;
        Ok(&self.tail)
    }

    /// Passes over the first bytes of what [`Feed::peek`] gave.
    pub(crate) fn skip(&mut self, bytes: usize) {
        self.tail.drain(..bytes.min(self.tail.len()));
    }

    /// Puts the next wave of `size` bytes or a little more into `wave`; true for the last one. It ends with a line
    /// end, unless it is the last. Fails when it is no longer wanted: who asks for the record knows.
    pub(crate) fn next(&mut self, wave: &mut Vec<u8>, size: usize) -> Result<bool, Unfit> {
        if !self.wanted.still() {
            return Err(Unfit::Unreadable);
        }
        wave.clear();
        wave.append(&mut self.tail);
        let mut wanted = size;
        let end = loop {
            let more = wanted.saturating_sub(wave.len());
            wave.reserve(more + 1);
            if !self.ended {
                self.ended = (&mut self.supply).take(more as u64).read_to_end(wave)? < more;
            }
            if self.ended {
                break wave.len();
            }
            match memrchr(self.line_end, wave) {
                Some(at) => break at + 1,
                None => {
                    wanted = wave.len() + size;
                    // This wave, and the next while it is read.
                    self.share.set(2 * wanted as u64).map_err(Unfit::Full)?;
                }
            }
        };
        self.tail.extend_from_slice(&wave[end..]);
        wave.truncate(end);
        self.check.map_or(Ok(()), |check| check.of(wave))?;
        Ok(self.ended && self.tail.is_empty())
    }

    /// The last byte of a line end.
    pub(crate) fn line_end(&self) -> u8 {
        self.line_end
    }

    /// What it was read from.
    pub(crate) fn into_supply(self) -> Supply<'a> {
        self.supply
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    /// All waves of `size`.
    fn waves(feed: &mut Feed<'_>, size: usize) -> Result<Vec<Vec<u8>>, Unfit> {
        let mut all = Vec::new();
        loop {
            let mut wave = Vec::new();
            let last = feed.next(&mut wave, size)?;
            all.push(wave);
            if last {
                return Ok(all);
            }
        }
    }

    proptest! {
        #[test]
        fn waves_together_are_the_text_and_end_at_line_ends(text in "[ab\n]{0,60}", size in 1..20_usize, ahead in 0..30_usize) {
            let mut feed = Feed::of(text.as_bytes(), b'\n');
            let peeked = feed.peek(ahead).unwrap().to_vec();
            prop_assert_eq!(&peeked, &text.as_bytes()[..text.len().min(ahead)]);
            let skipped = peeked.len() / 2;
            feed.skip(skipped);
            let waves = waves(&mut feed, size).unwrap();
            prop_assert_eq!(waves.concat(), text.as_bytes()[skipped..].to_vec());
            let (_, ends) = waves.split_last().unwrap();
            prop_assert!(ends.iter().all(|w| w.ends_with(b"\n")));
        }
    }

    #[test]
    fn what_is_no_text_is_found_in_any_wave() {
        let text = |bytes: &[u8], check| {
            waves(&mut Feed { check: Some(check), ..Feed::of(bytes, b'\n') }, 4).map(|w| w.concat().len())
        };
        assert_eq!(text(b"abc\nabc\nab\0\n", Check::Bytes), Err(Unfit::Unreadable));
        assert_eq!(text(b"abc\nabc\n\xb0C\n", Check::Utf8), Err(Unfit::NotUtf8));
        assert_eq!(text(b"abc\nabc\n\xb0C\n", Check::Bytes), Ok(11));
        // A character of several bytes across the border of a read.
        assert_eq!(text("abc\n°°°°\n".as_bytes(), Check::Utf8), Ok(13));
    }

    #[test]
    fn a_file_gives_its_text_and_the_hash_of_what_is_stored() {
        use std::io::Write;
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.csv.gz");
        let mut packer = flate2::write::GzEncoder::new(Vec::new(), flate2::Compression::fast());
        packer.write_all(b"1,2\n3,4\n").unwrap();
        let packed = packer.finish().unwrap();
        for (bytes, packing) in [(&b"1,2\n3,4\n"[..], None), (&packed, Some("gzip"))] {
            std::fs::write(&path, bytes).unwrap();
            let (supply, _) = Supply::open(&path, Extent::All, Want::default()).unwrap();
            assert_eq!(supply.packing().map(|p| p.name), packing);
            let mut feed = Feed::new(supply, Check::Utf8);
            assert_eq!(waves(&mut feed, 2).unwrap().concat(), b"1,2\n3,4\n");
            let expected = (super::super::text::sha256(bytes, Wanted::always()), bytes.len() as u64);
            assert_eq!(feed.into_supply().sha256().unwrap(), expected);
        }
    }
}
