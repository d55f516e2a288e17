//! The first lines of a file as they are, with what the loader takes each for.

use std::io::Read;
use std::path::Path;

use super::feed::Supply;
use super::text::{Text, decoded};
use super::tokens::{RecordKind, kind_of, line_end_of};
use super::view::Want;
use super::{Extent, RowsAt, Source};

/// What a line of a file is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum LinePart {
    /// Text above the table, or a comment.
    Preamble,
    /// The names of the columns.
    Header,
    /// Their units.
    Units,
    /// A row.
    Row,
    /// Text below the rows, or another table.
    Footer,
    /// Nobody knows: the file could not be understood.
    Unknown,
}

/// A line of a file.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct FileLine {
    /// From 1.
    pub number: usize,
    /// Its text, cut where it is long.
    pub text: String,
    /// What it is.
    pub part: LinePart,
}

/// How much of a file is read for its first lines, and how much of a line is kept.
const MOST: u64 = 64 << 10;
const LONGEST: usize = 400;

/// At most `most` lines of `source`: the first, those around the header, where that stands further down, and those below
/// the rows of a short file. Nothing for what cannot be read as text.
#[must_use]
pub fn first_lines(source: &Source, at: Option<&RowsAt>, most: usize) -> Vec<FileLine> {
    let Some(bytes) = beginning(source) else { return Vec::new() };
    let Ok(text) = Text::of(&bytes, Path::new(""), None) else { return Vec::new() };
    let body = text.body();
    let end = line_end_of(body);
    let mut lines = Vec::new();
    let mut start = 0;
    for (i, raw) in body.split(|b| *b == end).enumerate() {
        let bare = raw.strip_suffix(b"\r").unwrap_or(raw);
        let part = at.map_or(LinePart::Unknown, |at| part_of(at, (start, i as u64 + 1), bare));
        let text = decoded(bare, text.encoding).chars().take(LONGEST).collect();
        lines.push(FileLine { number: i + 1, text, part });
        start += raw.len() + 1;
    }
    // What follows the last line end is no line.
    if lines.last().is_some_and(|l| l.text.is_empty()) {
        lines.pop();
    }
    if (bytes.len() as u64) < MOST {
        mark_footer(&mut lines, at.map_or(0, |at| at.footer));
    }
    shortened(lines, most)
}

/// Marks the last `count` lines with text, and what is blank between them.
fn mark_footer(lines: &mut [FileLine], count: usize) {
    let mut left = count;
    for line in lines.iter_mut().rev() {
        if left == 0 {
            break;
        }
        left -= usize::from(!line.text.trim().is_empty());
        line.part = LinePart::Footer;
    }
}

/// Of this many lines those that tell what is what.
fn shortened(mut lines: Vec<FileLine>, most: usize) -> Vec<FileLine> {
    let header = lines.iter().position(|l| matches!(l.part, LinePart::Header | LinePart::Row)).unwrap_or(0);
    let below = lines.iter().filter(|l| l.part == LinePart::Footer).count().min(most / 6);
    let footer = if lines.len() > most { lines.split_off(lines.len() - below) } else { Vec::new() };
    // Little is to be seen of a long preamble but its first lines.
    let above = most / 3;
    if header > most / 2 && header < lines.len() {
        let from = header.saturating_sub(most / 6);
        let rest = lines.split_off(from);
        lines.truncate(above.saturating_sub(1));
        lines.extend(rest);
    }
    lines.truncate(most - footer.len());
    lines.extend(footer);
    lines
}

fn part_of(at: &RowsAt, (start, number): (usize, u64), line: &[u8]) -> LinePart {
    if !at.made_of.is_empty() {
        // Several lines may make a row: what stands after the first of them belongs to one.
        let before = at.made_of.iter().any(|made| *made <= number);
        return if before { LinePart::Row } else { LinePart::Preamble };
    }
    let is = |place: Option<(usize, usize)>| place.is_some_and(|(p, _)| p == start);
    let trimmed = line.trim_ascii();
    match () {
        () if is(at.header) => LinePart::Header,
        () if is(at.units) => LinePart::Units,
        () if at.end.is_some_and(|end| start >= end) => LinePart::Footer,
        () if start < at.start || kind_of(line, at.mark) == RecordKind::Comment => LinePart::Preamble,
        // A header that comes again.
        () if at.repeats.iter().any(|repeat| repeat == trimmed) => LinePart::Preamble,
        () => LinePart::Row,
    }
}

fn beginning(source: &Source) -> Option<Vec<u8>> {
    let mut bytes = Vec::new();
    match source {
        Source::BuiltIn { bytes: all, .. } => bytes.extend(all.iter().take(MOST as usize)),
        Source::File(_) | Source::Input(_) => {
            let path = source.file()?;
            if !path.is_file() {
                return None;
            }
            // Of what is broken, the lines before the fault are shown.
            let _ = Supply::open(path, Extent::All, Want::default()).ok()?.0.take(MOST).read_to_end(&mut bytes);
        }
    }
    if bytes.len() as u64 == MOST {
        // A character may be cut at the end.
        let end = bytes.iter().rposition(|b| matches!(b, b'\n' | b'\r')).map_or(bytes.len(), |at| at + 1);
        bytes.truncate(end + end % 2);
    }
    Some(bytes)
}

#[cfg(test)]
mod tests {
    use super::super::{LoadOptions, load};
    use super::*;

    #[test]
    fn lines_are_told_apart_by_what_the_loader_takes_them_for() {
        let text = b"a title\ntime,alt\ns,m\n0,1.5\n1,2.5\n2,3.5\n";
        let source = Source::BuiltIn { name: "test", bytes: text[..].into() };
        let track = load(&source, &LoadOptions::default()).unwrap();
        let parts: Vec<LinePart> = first_lines(&source, Some(&track.dialect.rows), 5).iter().map(|l| l.part).collect();
        use LinePart::{Header, Preamble, Row, Units};
        assert_eq!(parts, [Preamble, Header, Units, Row, Row]);
        // Records: the first epoch begins in the second line.
        let text =
            b"# a logger\n$GPGGA,100000,4807.038,N,01131.000,E,1,08,0.9,545.4,M,46.9,M,,\n$GPVTG,1,T,,M,2,N,3,K\n";
        let records = Source::BuiltIn { name: "test", bytes: text[..].into() };
        let track = load(&records, &LoadOptions::default()).unwrap();
        let lines = first_lines(&records, Some(&track.dialect.rows), 3);
        assert_eq!(lines.iter().map(|l| l.part).collect::<Vec<_>>(), [Preamble, Row, Row]);
        let text = "a title\rtime;alt\r0;1,5\r1;2,5\r# a word\r2;3,5\r3;4,5\r\rEnd of the report\r";
        let utf16: Vec<u8> = "\u{feff}".encode_utf16().chain(text.encode_utf16()).flat_map(u16::to_le_bytes).collect();
        let other = Source::BuiltIn { name: "test", bytes: utf16.into() };
        let track = load(&other, &LoadOptions::default()).unwrap();
        let lines = first_lines(&other, Some(&track.dialect.rows), 20);
        let parts: Vec<LinePart> = lines.iter().map(|l| l.part).collect();
        assert_eq!(parts, [Preamble, Header, Row, Row, Preamble, Row, Row, Row, LinePart::Footer]);
        assert_eq!(lines[1].text, "time;alt");
        // The last lines of a file are shown where they are no rows.
        let short = first_lines(&other, Some(&track.dialect.rows), 6);
        assert_eq!(short.iter().map(|l| l.number).collect::<Vec<_>>(), [1, 2, 3, 4, 5, 9]);
        assert!(first_lines(&source, None, 2).iter().all(|l| l.part == LinePart::Unknown));
    }
}
