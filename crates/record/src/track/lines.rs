//! The first lines of a file as they are, with what the loader takes each for.

use std::io::Read;

use super::feed::Supply;
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

/// At most `most` lines of `source`: the first, and those around the header, where that stands further down. Nothing
/// for what cannot be read as text.
#[must_use]
pub fn first_lines(source: &Source, at: Option<&RowsAt>, most: usize) -> Vec<FileLine> {
    let Some(bytes) = beginning(source) else { return Vec::new() };
    let mark = usize::from(bytes.starts_with(&[0xef, 0xbb, 0xbf])) * 3;
    let body = &bytes[mark..];
    let mut lines = Vec::new();
    let mut start = 0;
    for (i, raw) in body.split(|b| *b == b'\n').enumerate() {
        let text: String = String::from_utf8_lossy(raw).trim_end_matches('\r').chars().take(LONGEST).collect();
        let part = at.map_or(LinePart::Unknown, |at| part_of(at, start, i as u64 + 1));
        lines.push(FileLine { number: i + 1, text, part });
        start += raw.len() + 1;
    }
    let header = lines.iter().position(|l| matches!(l.part, LinePart::Header | LinePart::Row)).unwrap_or(0);
    // Little is to be seen of a long preamble but its first lines.
    let above = most / 3;
    if header > most / 2 {
        let from = header.saturating_sub(most / 6);
        let rest = lines.split_off(from);
        lines.truncate(above.saturating_sub(1));
        lines.extend(rest);
    }
    lines.truncate(most);
    lines
}

fn part_of(at: &RowsAt, start: usize, line: u64) -> LinePart {
    if !at.made_of.is_empty() {
        // Several lines may make a row: what stands after the first of them belongs to one.
        let before = at.made_of.iter().any(|made| *made <= line);
        return if before { LinePart::Row } else { LinePart::Preamble };
    }
    let is = |place: Option<(usize, usize)>| place.is_some_and(|(p, _)| p == start);
    match () {
        () if is(at.header) => LinePart::Header,
        () if is(at.units) => LinePart::Units,
        () if start >= at.start => LinePart::Row,
        () => LinePart::Preamble,
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
            let _ = Supply::open(path, Extent::All).ok()?.0.take(MOST).read_to_end(&mut bytes);
        }
    }
    memchr::memchr(0, &bytes).is_none().then_some(bytes)
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
        assert!(first_lines(&source, None, 2).iter().all(|l| l.part == LinePart::Unknown));
    }
}
