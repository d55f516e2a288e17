//! Lines that check themselves: a sum, a blank, JSON. Each sum covers the line and the sum before it, so that what
//! is read is always what was written from the first line on: up to a torn, changed, lost or foreign one.

use sha2::{Digest, Sha256};

use super::written::{entry_of, entry_text, foreign_of, header_of, header_text};
use super::{Entry, Header};
use crate::track::hex;

/// Hexadecimal digits of a sum: 64 bits against accidents, not against forgers.
const DIGITS: usize = 16;

/// Makes the lines of one journal, in their order.
#[derive(Debug, Clone)]
pub struct Encoder {
    sum: String,
}

/// What can be read of a journal.
#[derive(Debug, Clone, PartialEq)]
pub struct Journal {
    /// Its first line.
    pub header: Header,
    /// The lines after it, up to the first that is torn or not understood.
    pub entries: Vec<Entry>,
    /// True when nothing follows those.
    pub complete: bool,
}

impl Encoder {
    /// An encoder, and the first line with its end.
    #[must_use]
    pub fn new(header: &Header) -> (Self, String) {
        let mut encoder = Self { sum: String::new() };
        let line = encoder.line(&header_text(header));
        (encoder, line)
    }

    /// The line of an entry, with its end.
    #[must_use]
    pub fn entry(&mut self, entry: &Entry) -> String {
        self.line(&entry_text(entry))
    }

    fn line(&mut self, text: &str) -> String {
        self.sum = sum(&self.sum, text);
        format!("{} {text}\n", self.sum)
    }
}

impl Journal {
    /// How many changes are in it that are not saved.
    #[must_use]
    pub fn changes(&self) -> usize {
        self.header.carried + self.entries.len().saturating_sub(self.header.begun)
    }
}

/// Reads a journal, as far as it is whole; none when not even its first line is, or another version wrote it.
#[must_use]
pub fn decode(bytes: &[u8]) -> Option<Journal> {
    let mut before = String::new();
    let mut lines = bytes.split_inclusive(|b| *b == b'\n').map(|line| {
        let text = checked(line, &before)?;
        before = sum(&before, text);
        Some(text)
    });
    let header = header_of(lines.next()??)?;
    let mut entries = Vec::new();
    for line in lines {
        match line.and_then(|text| entry_of(text, header.rows)) {
            Some(entry) => entries.push(entry),
            None => return Some(Journal { header, entries, complete: false }),
        }
    }
    Some(Journal { header, entries, complete: true })
}

/// A journal that another version of the program wrote.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Foreign {
    /// The program, in its own words.
    pub program: String,
    /// The record, as in [`Header`]; empty when it is not understood.
    pub record: String,
    /// SHA-256 of the record; empty when it is not understood.
    pub sha256: String,
}

/// What can be told of a journal that [`decode`] does not read because another version wrote it; none for anything
/// else.
#[must_use]
pub fn foreign(bytes: &[u8]) -> Option<Foreign> {
    let line = bytes.split_inclusive(|b| *b == b'\n').next()?;
    // How another version sums its lines is its own business.
    let text = std::str::from_utf8(line.strip_suffix(b"\n")?).ok()?;
    foreign_of(text.get(text.find('{')?..)?)
}

/// The JSON of a line that is whole.
fn checked<'a>(line: &'a [u8], before: &str) -> Option<&'a str> {
    let line = std::str::from_utf8(line.strip_suffix(b"\n")?).ok()?;
    let (given, text) = line.split_at_checked(DIGITS)?;
    let text = text.strip_prefix(' ')?;
    (given == sum(before, text)).then_some(text)
}

fn sum(before: &str, text: &str) -> String {
    let digest = Sha256::new().chain_update(before).chain_update(text).finalize();
    hex(digest.get(..DIGITS / 2).unwrap_or_default())
}
