//! The lines of a text and stretches of them.

use std::ops::Range;

use crate::track::windows_1252;

/// A line of the text, without its line end.
#[derive(Debug, Clone, Copy)]
pub(crate) struct SourceLine<'a> {
    /// From 1.
    pub(crate) number: u64,
    pub(crate) all: Piece<'a>,
}

/// A stretch of a line.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Piece<'a> {
    /// Offset in the text.
    pub(crate) start: usize,
    pub(crate) bytes: &'a [u8],
}

/// The lines of a text, in order.
pub(crate) fn lines(body: &[u8]) -> impl Iterator<Item = SourceLine<'_>> {
    let end = super::super::tokens::line_end_of(body);
    let mut start = 0;
    body.split(move |b| *b == end).zip(1..).map(move |(bytes, number)| {
        let piece = Piece { start, bytes: bytes.strip_suffix(b"\r").unwrap_or(bytes) };
        start += bytes.len() + 1;
        SourceLine { number, all: piece }
    })
}

impl<'a> Piece<'a> {
    /// Its text; empty for what is no UTF-8.
    pub(crate) fn text(self) -> &'a str {
        std::str::from_utf8(self.bytes).unwrap_or("")
    }

    /// Its text, as UTF-8 or else as Windows-1252.
    pub(crate) fn decoded(self) -> String {
        match std::str::from_utf8(self.bytes) {
            Ok(text) => text.to_owned(),
            Err(_) => windows_1252::decode(self.bytes),
        }
    }

    /// Where it stands in the text.
    pub(crate) fn range(self) -> Range<usize> {
        self.start..self.start + self.bytes.len()
    }

    /// Without blanks around it; an empty piece stays where it was.
    pub(crate) fn trimmed(self) -> Self {
        let front = self.bytes.len() - self.bytes.trim_ascii_start().len();
        if front == self.bytes.len() {
            return Self { start: self.start + front, bytes: &[] };
        }
        Self { start: self.start + front, bytes: self.bytes.trim_ascii() }
    }

    /// A part of it, as far as it reaches.
    pub(crate) fn part(self, range: Range<usize>) -> Self {
        let end = range.end.min(self.bytes.len());
        let start = range.start.min(end);
        Self { start: self.start + start, bytes: &self.bytes[start..end] }
    }

    /// What follows the first `count` bytes.
    pub(crate) fn after(self, count: usize) -> Self {
        self.part(count..self.bytes.len())
    }

    /// The parts between bytes of this value, trimmed.
    pub(crate) fn split(self, by: u8) -> Vec<Self> {
        let mut start = self.start;
        let part = |bytes: &'a [u8]| {
            let piece = Self { start, bytes };
            start += bytes.len() + 1;
            piece.trimmed()
        };
        self.bytes.split(move |b| *b == by).map(part).collect()
    }

    /// The words between blanks and tabs.
    pub(crate) fn words(self) -> Vec<Self> {
        let mut words = Vec::new();
        let mut at = 0;
        while at < self.bytes.len() {
            if self.bytes[at].is_ascii_whitespace() {
                at += 1;
                continue;
            }
            let length = self.bytes[at..].iter().take_while(|b| !b.is_ascii_whitespace()).count();
            words.push(self.part(at..at + length));
            at += length;
        }
        words
    }

    /// The number that it is.
    pub(crate) fn number(self) -> Option<f64> {
        self.text().trim().parse().ok().filter(|v: &f64| v.is_finite())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pieces_know_where_they_stand() {
        let text = b"a, bc ,,d\r\n  e\tf \n";
        let all: Vec<SourceLine<'_>> = lines(text).collect();
        assert_eq!(all.iter().map(|l| l.number).collect::<Vec<_>>(), [1, 2, 3]);
        let cells = all[0].all.split(b',');
        assert_eq!(cells.iter().map(|c| c.text()).collect::<Vec<_>>(), ["a", "bc", "", "d"]);
        assert_eq!(&text[cells[3].range()], b"d");
        assert_eq!(cells[2].range(), 7..7);
        let words = all[1].all.words();
        assert_eq!((words.len(), &text[words[1].range()]), (2, &b"f"[..]));
        assert_eq!(all[1].all.part(2..100).text(), "e\tf ");
    }
}
