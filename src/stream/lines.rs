//! Lines of a stream, as they come, of bounded length.

use std::io::{BufRead, BufReader, ErrorKind, Read};

use memchr::memchr;

use crate::error::{Error, Result};

/// A longer line is cut short.
const LONGEST: usize = 1 << 20;

/// The lines of standard input.
pub(super) struct Lines<R> {
    reader: BufReader<R>,
    number: u64,
}

/// A line.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct Line {
    /// Its number, from 1.
    pub(super) number: u64,
    /// Its bytes without the line end.
    pub(super) bytes: Vec<u8>,
    /// True when it was longer than its bytes.
    pub(super) cut: bool,
    /// True when the stream ended before the line did.
    pub(super) open: bool,
}

impl<R: Read> Lines<R> {
    /// The lines of `input`.
    pub(super) fn new(input: R) -> Self {
        Self { reader: BufReader::with_capacity(1 << 16, input), number: 0 }
    }

    /// The next line; none at the end. Calls `wait` before it may have to wait for the sender.
    ///
    /// # Errors
    /// [`Error::Io`], and what `wait` gives.
    pub(super) fn next(&mut self, mut wait: impl FnMut() -> Result<()>) -> Result<Option<Line>> {
        let mut line = Line { number: self.number + 1, bytes: Vec::new(), cut: false, open: true };
        if memchr(b'\n', self.reader.buffer()).is_none() {
            wait()?;
        }
        let mut length = 0;
        while line.open {
            let buffer = match self.reader.fill_buf() {
                Ok(buffer) => buffer,
                Err(e) if e.kind() == ErrorKind::Interrupted => continue,
                Err(e) => return Err(Error::io("read", "standard input")(e)),
            };
            if buffer.is_empty() {
                break;
            }
            let end = memchr(b'\n', buffer);
            let part = &buffer[..end.unwrap_or(buffer.len())];
            let room = LONGEST - line.bytes.len();
            line.bytes.extend_from_slice(&part[..part.len().min(room)]);
            line.cut |= part.len() > room;
            line.open = end.is_none();
            let used = part.len() + usize::from(end.is_some());
            length += used;
            self.reader.consume(used);
        }
        if length == 0 {
            return Ok(None);
        }
        if line.bytes.last() == Some(&b'\r') {
            line.bytes.pop();
        }
        if self.number == 0 && line.bytes.starts_with(b"\xef\xbb\xbf") {
            line.bytes.drain(..3);
        }
        self.number += 1;
        Ok(Some(line))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Gives its pieces one by one, with an interruption between them.
    struct Pieces(Vec<&'static [u8]>, bool);

    impl Read for Pieces {
        fn read(&mut self, out: &mut [u8]) -> std::io::Result<usize> {
            self.1 = !self.1;
            if self.1 {
                return Err(ErrorKind::Interrupted.into());
            }
            if self.0.is_empty() {
                return Ok(0);
            }
            let piece = self.0.remove(0);
            out[..piece.len()].copy_from_slice(piece);
            Ok(piece.len())
        }
    }

    #[test]
    fn lines_are_whole_however_they_arrive() {
        let mut lines = Lines::new(Pieces(vec![b"\xef\xbb\xbft,", b"x\r\n1,2\n3", b",4\n\n5,"], false));
        let mut waits = 0;
        let mut all = Vec::new();
        while let Some(line) = lines
            .next(|| {
                waits += 1;
                Ok(())
            })
            .unwrap()
        {
            all.push((line.number, String::from_utf8(line.bytes).unwrap(), line.open));
        }
        let texts: Vec<&str> = all.iter().map(|l| l.1.as_str()).collect();
        assert_eq!(texts, ["t,x", "1,2", "3,4", "", "5,"]);
        assert_eq!((all[4].0, all[4].2, all[3].2), (5, true, false));
        assert_eq!(waits, 4, "before the first, the third and the fifth line and the end, not where a line was there");
    }

    #[test]
    fn a_line_without_end_does_not_fill_the_memory() {
        let endless = std::io::repeat(b'7').take(3 * LONGEST as u64).chain(&b"\n1\n"[..]);
        let mut lines = Lines::new(endless);
        let line = lines.next(|| Ok(())).unwrap().unwrap();
        assert!(line.cut && line.bytes.len() == LONGEST);
        assert_eq!(lines.next(|| Ok(())).unwrap().unwrap().bytes, b"1");
    }
}
