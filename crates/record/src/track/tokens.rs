//! The tokeniser: bytes to records, records to cells. The loader and every second pass over a file go through it, so
//! that a row is the same row everywhere.

use memchr::{memchr, memchr_iter};

use super::Delimiter;

/// How bytes fall into records and cells.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Layout {
    /// The field separator.
    pub(crate) delimiter: Delimiter,
    /// The quote character; none where a quote is a character like any other.
    pub(crate) quote: Option<u8>,
    /// The last byte of a line end: a line feed, or a carriage return in a file without line feeds.
    pub(crate) line_end: u8,
    /// What comments begin with, besides `#`, `%` and `//`.
    pub(crate) mark: Option<Mark>,
}

/// What the comments of a file begin with.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Mark {
    bytes: [u8; Self::LONGEST],
    length: usize,
}

impl Mark {
    /// Bytes of the longest mark.
    const LONGEST: usize = 16;

    /// The mark of these bytes; none where they are none or too many.
    pub(crate) fn new(text: &[u8]) -> Option<Self> {
        let mut bytes = [0; Self::LONGEST];
        bytes.get_mut(..text.len()).filter(|_| !text.is_empty())?.copy_from_slice(text);
        Some(Self { bytes, length: text.len() })
    }

    /// Its bytes.
    pub(crate) fn bytes(&self) -> &[u8] {
        &self.bytes[..self.length]
    }
}

impl Layout {
    /// The same for `text`, but without a quote that does not occur in it: its records need no search for one, and
    /// end at every line end.
    pub(crate) fn without_idle_quote(self, text: &[u8]) -> Self {
        Self { quote: self.quote.filter(|q| memchr(*q, text).is_some()), ..self }
    }
}

/// The line end that `body` uses.
pub(crate) fn line_end_of(body: &[u8]) -> u8 {
    if memchr(b'\n', body).is_none() && memchr(b'\r', body).is_some() { b'\r' } else { b'\n' }
}

/// What a record is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum RecordKind {
    /// Cells.
    Data,
    /// A line that starts with `#`, `%` or `//`, or with the mark of the file.
    Comment,
    /// Nothing but blanks.
    Blank,
}

/// One line of the file, or several where a quoted cell holds line breaks.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Record<'a> {
    /// Number of its first line, from 1.
    pub(crate) line: u64,
    /// Offset of its first byte.
    pub(crate) start: usize,
    /// What it is.
    pub(crate) kind: RecordKind,
    /// Its bytes without the line end.
    pub(crate) bytes: &'a [u8],
    /// Its line end; empty for a last line without one.
    pub(crate) end: &'a [u8],
}

/// A quote that is not closed within [`LONGEST_FIELD`] bytes and [`MOST_LINES`] lines.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct OpenQuote {
    /// The line of the quote, from 1.
    pub(crate) line: u64,
}

const LONGEST_FIELD: usize = 1 << 20;
const MOST_LINES: u64 = 1000;

/// The records of a text, in order.
#[derive(Debug)]
pub(crate) struct Records<'a> {
    body: &'a [u8],
    layout: Layout,
    offset: usize,
    line: u64,
}

impl<'a> Records<'a> {
    /// The records of `body`.
    pub(crate) fn new(body: &'a [u8], layout: Layout) -> Self {
        Self { body, layout, offset: 0, line: 1 }
    }

    /// The records of `body` from `offset` on, where line `line` begins.
    pub(crate) fn from(body: &'a [u8], layout: Layout, offset: usize, line: u64) -> Self {
        Self { body, layout, offset, line }
    }

    /// How many lines have been passed.
    pub(crate) fn lines(&self) -> u64 {
        self.line - 1
    }
}

impl<'a> Iterator for Records<'a> {
    type Item = Result<Record<'a>, OpenQuote>;

    fn next(&mut self) -> Option<Self::Item> {
        let start = self.offset;
        let rest = &self.body[start..];
        if rest.is_empty() {
            return None;
        }
        let mut length = memchr(self.layout.line_end, rest).map_or(rest.len(), |at| at + 1);
        let kind = kind_of(&rest[..length], self.layout.mark);
        let mut lines = 1;
        if let (RecordKind::Data, Some(quote)) = (kind, self.layout.quote)
            && memchr(quote, &rest[..length]).is_some()
        {
            match quoted_length(rest, self.layout, quote) {
                Ok(found) => (length, lines) = found,
                Err(line) => {
                    self.offset = self.body.len();
                    return Some(Err(OpenQuote { line: self.line + line }));
                }
            }
        }
        let line = self.line;
        self.offset += length;
        self.line += lines;
        let (bytes, end) = split_end(&rest[..length], self.layout.line_end);
        Some(Ok(Record { line, start, kind, bytes, end }))
    }
}

/// Is this line cells, a comment or nothing? `line` may carry its line end.
pub(crate) fn kind_of(line: &[u8], mark: Option<Mark>) -> RecordKind {
    match (line.trim_ascii_start(), mark) {
        ([], _) => RecordKind::Blank,
        ([b'#' | b'%', ..] | [b'/', b'/', ..], _) => RecordKind::Comment,
        (text, Some(mark)) if text.starts_with(mark.bytes()) => RecordKind::Comment,
        _ => RecordKind::Data,
    }
}

fn split_end(line: &[u8], line_end: u8) -> (&[u8], &[u8]) {
    let mut length = line.len();
    if line.last() == Some(&line_end) {
        length -= 1;
        if line_end == b'\n' && line[..length].last() == Some(&b'\r') {
            length -= 1;
        }
    }
    line.split_at(length)
}

/// Bytes (with the line end) and lines of the record at the start of `rest`; the line of an open quote, counted from
/// the first, as the error.
fn quoted_length(rest: &[u8], layout: Layout, quote: u8) -> Result<(usize, u64), u64> {
    let mut at = 0;
    let mut lines = 0;
    loop {
        let begin = cell_begin(rest, at, layout);
        if rest.get(begin) == Some(&quote) {
            let opened = lines;
            let (close, inside) = closing(rest, begin, quote, layout.line_end).ok_or(opened)?;
            lines += inside;
            at = close;
        } else {
            at = begin;
        }
        // The rest of the cell, up to the next delimiter or the end of the line.
        loop {
            match rest.get(at) {
                None => return Ok((at, lines + 1)),
                Some(&b) if b == layout.line_end => return Ok((at + 1, lines + 1)),
                Some(&b) if is_delimiter(b, layout.delimiter) => break,
                Some(_) => at += 1,
            }
        }
        at += 1;
    }
}

fn is_delimiter(byte: u8, delimiter: Delimiter) -> bool {
    match delimiter {
        Delimiter::Byte(d) => byte == d,
        Delimiter::Blanks => is_blank(byte),
    }
}

fn is_blank(byte: u8) -> bool {
    byte == b' ' || byte == b'\t'
}

/// Where the text of the cell at `from` begins, after its padding.
fn cell_begin(bytes: &[u8], from: usize, layout: Layout) -> usize {
    let padding = |b: &u8| is_blank(*b) && layout.delimiter != Delimiter::Byte(*b);
    from + bytes.iter().skip(from).take_while(|b| padding(b)).count()
}

/// Position after the quote that closes the one at `open`, and the line ends between them.
fn closing(bytes: &[u8], open: usize, quote: u8, line_end: u8) -> Option<(usize, u64)> {
    let mut at = open + 1;
    loop {
        at += memchr(quote, bytes.get(at..)?)?;
        if bytes.get(at + 1) == Some(&quote) {
            at += 2;
            continue;
        }
        let inside = &bytes[open..at];
        let lines = memchr_iter(line_end, inside).count() as u64;
        return (inside.len() <= LONGEST_FIELD && lines <= MOST_LINES).then_some((at + 1, lines));
    }
}

/// Where a cell lies in its record, from the first byte of padding or quote to the last.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Span {
    /// Its first byte.
    pub(crate) start: u32,
    /// The byte after its last.
    pub(crate) end: u32,
}

impl Span {
    #[expect(clippy::cast_possible_truncation, reason = "a record of 4 GiB is refused as a field that is too long")]
    fn new(start: usize, end: usize) -> Self {
        Self { start: start as u32, end: end as u32 }
    }

    /// The bytes of the cell in its record.
    pub(crate) fn of(self, record: &[u8]) -> &[u8] {
        &record[self.start as usize..self.end as usize]
    }
}

/// The cells of a record, into `spans`.
pub(crate) fn split(record: &[u8], layout: Layout, spans: &mut Vec<Span>) {
    spans.clear();
    let quote = layout.quote.filter(|q| memchr(*q, record).is_some());
    match (layout.delimiter, quote) {
        (Delimiter::Byte(d), None) => {
            let mut start = 0;
            for at in memchr_iter(d, record) {
                spans.push(Span::new(start, at));
                start = at + 1;
            }
            spans.push(Span::new(start, record.len()));
        }
        (Delimiter::Byte(_), Some(quote)) => {
            let mut start = 0;
            loop {
                let end = cell_end(record, start, layout, Some(quote));
                spans.push(Span::new(start, end));
                if end >= record.len() {
                    return;
                }
                start = end + 1;
            }
        }
        (Delimiter::Blanks, quote) => {
            let mut start = cell_begin(record, 0, layout);
            while start < record.len() {
                let end = cell_end(record, start, layout, quote);
                spans.push(Span::new(start, end));
                start = cell_begin(record, end, layout);
            }
        }
    }
}

fn cell_end(record: &[u8], start: usize, layout: Layout, quote: Option<u8>) -> usize {
    let begin = cell_begin(record, start, layout);
    let mut at = begin;
    if let Some(quote) = quote
        && record.get(begin) == Some(&quote)
    {
        // A record holds whole cells; where it was cut from a longer text, the quote runs to its end.
        at = closing(record, begin, quote, layout.line_end).map_or(record.len(), |(close, _)| close);
    }
    at + record[at..].iter().take_while(|b| !is_delimiter(**b, layout.delimiter)).count()
}

/// Where the text of a cell lies in `raw`: without padding, without quotes, without padding inside them.
pub(crate) fn inner(raw: &[u8], quote: Option<u8>) -> std::ops::Range<usize> {
    let trim = |mut start: usize, mut end: usize| {
        while start < end && raw[start].is_ascii_whitespace() {
            start += 1;
        }
        while start < end && raw[end - 1].is_ascii_whitespace() {
            end -= 1;
        }
        start..end
    };
    let outer = trim(0, raw.len());
    match quote {
        Some(q) if outer.len() >= 2 && raw[outer.start] == q && raw[outer.end - 1] == q => {
            trim(outer.start + 1, outer.end - 1)
        }
        _ => outer,
    }
}

/// True for a row of nothing but empty cells.
pub(crate) fn is_empty(record: &[u8], spans: &[Span], layout: Layout) -> bool {
    // A row with a digit at either end is not; that is nearly every row.
    let digit = |b: Option<&u8>| b.is_some_and(u8::is_ascii_digit);
    if digit(record.first()) || digit(record.last()) {
        return false;
    }
    spans.iter().all(|s| inner(s.of(record), layout.quote).is_empty())
}

#[cfg(test)]
mod tests {
    use super::super::Encoding;
    use super::super::cells::Cells;
    use super::*;

    const COMMA: Layout = Layout { delimiter: Delimiter::Byte(b','), quote: Some(b'"'), line_end: b'\n', mark: None };
    const BLANKS: Layout = Layout { delimiter: Delimiter::Blanks, ..COMMA };

    fn cells(record: &str, layout: Layout) -> Vec<String> {
        let mut spans = Vec::new();
        split(record.as_bytes(), layout, &mut spans);
        let encoding = Encoding::Utf8 { bom: false };
        let cells = Cells { record: record.as_bytes(), spans: &spans, quote: layout.quote, encoding, line: 1 };
        (0..cells.len()).map(|c| cells.text(c).into_owned()).collect()
    }

    fn records(text: &str, layout: Layout) -> Result<Vec<(u64, RecordKind, &str, &str)>, OpenQuote> {
        let utf8 = |b| std::str::from_utf8(b).unwrap();
        Records::new(text.as_bytes(), layout).map(|r| r.map(|r| (r.line, r.kind, utf8(r.bytes), utf8(r.end)))).collect()
    }

    #[test]
    fn cells_are_trimmed_and_unquoted() {
        assert_eq!(cells(r#"a, b ,"c, d" ,"e ""f""",,g"h"#, COMMA), ["a", "b", "c, d", r#"e "f""#, "", "g\"h"]);
        assert_eq!(cells("", COMMA), [""]);
        assert_eq!(cells("1,", COMMA), ["1", ""]);
        assert_eq!(cells("  1 \t 2   'x y' ", BLANKS), ["1", "2", "'x", "y'"]);
        let single = Layout { quote: Some(b'\''), ..BLANKS };
        assert_eq!(cells("1 'x  y' 2", single), ["1", "x  y", "2"]);
        let tabs = Layout { delimiter: Delimiter::Byte(b'\t'), ..COMMA };
        assert_eq!(cells("\t1 \t\t", tabs), ["", "1", "", ""]);
    }

    #[test]
    fn records_keep_their_lines_and_line_ends() {
        use RecordKind::{Blank, Comment, Data};
        let text = "# c \"open\n1,2\r\n \n3,\"a\nb\",4\n5";
        assert_eq!(
            records(text, COMMA).unwrap(),
            [
                (1, Comment, "# c \"open", "\n"),
                (2, Data, "1,2", "\r\n"),
                (3, Blank, " ", "\n"),
                (4, Data, "3,\"a\nb\",4", "\n"),
                (6, Data, "5", ""),
            ]
        );
        let layout = Layout { line_end: line_end_of(b"1\r2"), ..COMMA };
        assert_eq!(records("1\r2", layout).unwrap(), [(1, Data, "1", "\r"), (2, Data, "2", "")]);
    }

    #[test]
    fn a_quote_that_is_not_closed_is_named_by_its_line() {
        assert_eq!(records("1,2\n3,\"4\n5,6\n", COMMA), Err(OpenQuote { line: 2 }));
        let far = format!("1,2\n\"a\n{}\",9\n", "1,2\n".repeat(1001));
        assert_eq!(records(&far, COMMA), Err(OpenQuote { line: 2 }));
        let near = format!("1,2\n\"a\n{}\",9\n", "1,2\n".repeat(900));
        assert_eq!(records(&near, COMMA).map(|r| r.len()), Ok(2));
        let long = format!("\"{}\"\n", "x".repeat(LONGEST_FIELD + 1));
        assert_eq!(records(&long, COMMA), Err(OpenQuote { line: 1 }));
        // A quote inside a cell opens nothing.
        assert_eq!(records("1,5\"\n2,3\n", COMMA).map(|r| r.len()), Ok(2));
    }
}
