//! The head of a file: titles, header, units, and a sample of the rows under them.

use std::path::Path;

use super::cells::Cells;
use super::number::Reading;
use super::sniff::{Look, SAMPLE_BYTES, look, most_frequent, sniff};
use super::text::Text;
use super::tokens::{Layout, OpenQuote, Record, RecordKind, Records, split};
use super::{LoadOptions, names, printable};
use crate::error::{Error, Result};

/// Rows that are looked at.
const SAMPLE: usize = 200;
/// Lines that may stand before the data, besides comments.
const MOST_PREAMBLE: usize = 20;
/// Cells of a units row are shorter than this.
const LONGEST_UNIT: usize = 16;

/// What the first lines tell.
#[derive(Debug)]
pub(crate) struct Head {
    /// How records and cells are told apart.
    pub(crate) layout: Layout,
    /// How cells are read.
    pub(crate) reading: Reading,
    /// Records before the first data row that are neither comments nor blank.
    pub(crate) preamble: usize,
    /// True when a header names the columns.
    pub(crate) header: bool,
    /// The line of the header, or of the first row.
    pub(crate) header_line: u64,
    /// True when a units row follows the header.
    pub(crate) units_row: bool,
    /// The names of the columns, unique.
    pub(crate) names: Vec<String>,
    /// Their units, or empty texts.
    pub(crate) units: Vec<String>,
    /// Numbers of cells that a row may have without being ragged.
    pub(crate) counts: [usize; 2],
    /// Offset of the first data row in the body.
    pub(crate) data_start: usize,
    /// Line of the first data row, from 1.
    pub(crate) data_line: u64,
    /// The cells of the first rows.
    pub(crate) sample: Vec<Vec<String>>,
    /// Mean length of a record of the sample with its line end, in bytes.
    pub(crate) record_bytes: usize,
}

struct Line {
    number: u64,
    start: usize,
    cells: Vec<String>,
}

impl Line {
    fn filled(&self) -> usize {
        self.cells.iter().filter(|c| !c.is_empty()).count()
    }
}

/// The error for a quote that is not closed.
pub(crate) fn open_quote(path: &Path, quote: OpenQuote) -> Error {
    Error::Input {
        path: path.to_path_buf(),
        line: Some(quote.line),
        what: "a quoted cell starts here and does not end within 1000 lines or 1 MiB".into(),
        help: "close the quote, or take it away; where quotes are ordinary characters, use --no-quotes".into(),
    }
}

impl Head {
    /// Reads the head of `text`.
    ///
    /// # Errors
    /// [`Error::Input`] for an open quote, a file without rows, and one without numbers.
    pub(crate) fn of(text: &Text<'_>, options: &LoadOptions, path: &Path) -> Result<Self> {
        let (layout, decimal_comma) = sniff(text.body(), options);
        let reading = Reading::new(decimal_comma, &options.missing);
        let (lines, comments) = first_lines(text, layout).map_err(|q| open_quote(path, q))?;
        let typed = typed_columns(&lines, &reading);
        let found = lines.iter().take(MOST_PREAMBLE + 1).position(|l| is_data(l, &typed, &reading));
        let Some(mut data) = found else { return Err(no_numbers(&lines, path)) };
        match options.header {
            Some(true) if data == 0 => data = 1,
            Some(false) => data = 0,
            _ => {}
        }
        let (before, rows) = lines.split_at(data.min(lines.len()));
        let Some(first) = rows.first() else {
            return Err(no_rows(path, &lines));
        };
        // Of several lines before the data, titles fill fewer cells than the header.
        let header_at = before.iter().enumerate().max_by_key(|(i, l)| (l.filled(), usize::MAX - i)).map(|(i, _)| i);
        let units_at = header_at.map(|h| h + 1).filter(|u| u + 1 == data && is_units(&before[*u]));
        let counts: Vec<usize> = rows.iter().map(|l| l.cells.len()).collect();
        let usual = most_frequent(&counts).map_or(0, |(count, _)| count);
        let commented = match header_at {
            None if options.header != Some(false) => commented_header(&comments, usual, &reading),
            _ => None,
        };
        let header = header_at.map(|h| &before[h]).or(commented.as_ref());
        let width = header.map_or(counts.iter().copied().max().unwrap_or(0), |h| h.cells.len().max(usual));
        let expected = header.map_or(width, |h| h.cells.len());
        let counts = [expected, if usual.abs_diff(expected) == 1 && header.is_some() { usual } else { expected }];
        let mut named = header.map(|h| h.cells.clone()).unwrap_or_default();
        named.resize(width, String::new());
        let units = named.iter().enumerate().map(|(i, name)| {
            let row_unit = units_at.and_then(|u| before[u].cells.get(i)).map(|u| without_brackets(u));
            row_unit.filter(|u| !u.is_empty()).unwrap_or_else(|| names::unit_of(name))
        });
        let last = &rows[rows.len() - 1];
        Ok(Self {
            layout,
            units: units.collect(),
            preamble: data,
            header: header.is_some(),
            header_line: header.map_or(first.number, |h| h.number),
            units_row: units_at.is_some(),
            names: names::unique(named),
            counts,
            data_start: first.start,
            data_line: first.number,
            record_bytes: ((last.start - first.start) / (rows.len() - 1).max(1)).max(2),
            sample: rows.iter().map(|l| l.cells.clone()).collect(),
            reading,
        })
    }

    /// True when the head of `part`, the first whole lines of a longer text, is that of the whole text: nothing of what
    /// it was told from lay near the end.
    pub(crate) fn needs_no_more(&self, part: &[u8]) -> bool {
        let lines = self.preamble + self.sample.len();
        lines == SAMPLE + MOST_PREAMBLE && part.len() > self.data_start + SAMPLE_BYTES
    }

    /// The sampled cells of a column; rows with another number of cells than usual are left out while there are
    /// others, for they may be of another kind.
    pub(crate) fn column(&self, column: usize) -> Vec<&str> {
        let whole = |row: &Vec<String>| self.counts.contains(&row.len());
        let any = self.sample.iter().any(whole);
        let rows = self.sample.iter().filter(|r| !any || whole(r));
        rows.filter_map(|r| r.get(column)).map(String::as_str).collect()
    }
}

/// The first data records that are not empty, and the comments before them.
fn first_lines(text: &Text<'_>, layout: Layout) -> std::result::Result<(Vec<Line>, Vec<Line>), OpenQuote> {
    let mut lines = Vec::new();
    let mut comments = Vec::new();
    for record in Records::new(text.body(), layout) {
        let record = record?;
        match record.kind {
            RecordKind::Data => {
                let line = line_of(&record, layout, text);
                if line.filled() > 0 {
                    lines.push(line);
                }
            }
            RecordKind::Comment if lines.is_empty() => {
                let stripped = record.bytes.trim_ascii_start();
                let marks = stripped.iter().take_while(|b| matches!(b, b'#' | b'%' | b'/')).count();
                comments.push(line_of(&Record { bytes: &stripped[marks..], ..record }, layout, text));
            }
            RecordKind::Comment | RecordKind::Blank => {}
        }
        if lines.len() == SAMPLE + MOST_PREAMBLE {
            break;
        }
    }
    Ok((lines, comments))
}

fn line_of(record: &Record<'_>, layout: Layout, text: &Text<'_>) -> Line {
    let mut spans = Vec::new();
    split(record.bytes, layout, &mut spans);
    let cells =
        Cells { record: record.bytes, spans: &spans, quote: layout.quote, encoding: text.encoding, line: record.line };
    let cells = (0..cells.len()).map(|c| cells.text(c).into_owned()).collect();
    Line { number: record.line, start: record.start, cells }
}

/// For each column: do its cells, in the later half of the lines, read as numbers or times?
fn typed_columns(lines: &[Line], reading: &Reading) -> Vec<bool> {
    let tail = &lines[lines.len() / 2..];
    let width = tail.iter().map(|l| l.cells.len()).max().unwrap_or(0);
    let counts = |column: usize| {
        let looks = tail.iter().filter_map(|l| l.cells.get(column)).map(|c| look(c.as_bytes(), reading));
        looks.fold((0, 0), |(typed, text), look| match look {
            Look::Number | Look::Time => (typed + 1, text),
            Look::Text => (typed, text + 1),
            Look::Empty => (typed, text),
        })
    };
    (0..width).map(counts).map(|(typed, text)| typed > 0 && typed >= text).collect()
}

/// A row of data has numbers where the columns have them. A few may hold text, but not under the name of a time.
fn is_data(line: &Line, typed: &[bool], reading: &Reading) -> bool {
    let (mut read, mut text) = (0, 0);
    for (cell, _) in line.cells.iter().zip(typed).filter(|(_, typed)| **typed) {
        match look(cell.as_bytes(), reading) {
            Look::Number | Look::Time => read += 1,
            Look::Text if names::time_rank(cell) > 1 => return false,
            Look::Text => text += 1,
            Look::Empty => {}
        }
    }
    read > 0 && read >= text
}

fn is_units(line: &Line) -> bool {
    line.cells.iter().all(|c| c.chars().count() < LONGEST_UNIT)
}

fn without_brackets(unit: &str) -> String {
    unit.trim_matches(['(', ')', '[', ']']).trim().to_owned()
}

/// The last comment that has a name for each cell of a row.
fn commented_header(comments: &[Line], usual: usize, reading: &Reading) -> Option<Line> {
    let is_name = |cell: &String| look(cell.as_bytes(), reading) == Look::Text;
    let fits = |line: &&Line| line.cells.len() == usual && usual > 1 && line.cells.iter().all(is_name);
    comments.iter().rev().find(fits).map(|l| Line { number: l.number, start: l.start, cells: l.cells.clone() })
}

fn no_rows(path: &Path, lines: &[Line]) -> Error {
    Error::Input {
        path: path.to_path_buf(),
        line: lines.first().map(|l| l.number),
        what: "a header, and no rows under it".into(),
        help: "name a file with a header and rows of numbers".into(),
    }
}

fn no_numbers(lines: &[Line], path: &Path) -> Error {
    match lines {
        [] => Error::input(path, "no rows: nothing but comments or blank lines", "name a file with rows of numbers"),
        [_] => no_rows(path, lines),
        [first, ..] => Error::Input {
            path: path.to_path_buf(),
            line: Some(first.number),
            what: format!("no column of numbers in the first lines; they start with `{}`", shown(first)),
            help: "expected a header and rows of numbers, in columns parted by comma, semicolon, tab, | or blanks"
                .into(),
        },
    }
}

fn shown(line: &Line) -> String {
    printable(&line.cells.join(" ").chars().take(60).collect::<String>())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn head_with(text: &str, options: &LoadOptions) -> Result<Head> {
        let path = Path::new("x.csv");
        Head::of(&Text::of(text.as_bytes(), path, None)?, options, path)
    }

    fn head(text: &str) -> Head {
        head_with(text, &LoadOptions::default()).unwrap()
    }

    #[test]
    fn header_units_and_titles_are_told_apart() {
        let h = head("time,alt\n0,1\n1,2\n");
        assert_eq!((h.header, h.units_row, h.preamble, h.data_line), (true, false, 1, 2));
        let h = head("time,alt,state\ns,ft,\n0,1,a\n1,2,b\n");
        assert_eq!((h.header, h.units_row, h.preamble), (true, true, 2));
        assert_eq!(h.units, ["s", "ft", ""]);
        let h = head("SpCond,,\nstart,end,gap\n2014-01-24 13:15,2014-02-26 13:30,-20.00\n");
        assert_eq!((h.names.join(" "), h.header_line, h.preamble), ("start end gap".into(), 2, 2));
        let h = head("0,1\n1,2\n");
        assert_eq!((h.header, h.names.join(" "), h.preamble), (false, "column_1 column_2".into(), 0));
        let h = head("time,1,2,3\n0,1,2,3\n1,2,3,4\n");
        assert_eq!((h.header, h.names.join(" ")), (true, "time 1 2 3".into()));
    }

    #[test]
    fn a_comment_with_a_name_for_each_cell_is_a_header() {
        let h = head("# made today, by hand\n#version,time,x\n6,0,1\n6,1,2\n");
        assert_eq!((h.names.join(" "), h.header, h.preamble, h.header_line), ("version time x".into(), true, 0, 2));
        let h = head("# one, two\n1,2,3\n2,3,4\n");
        assert!(!h.header);
    }

    #[test]
    fn options_overrule_what_the_lines_show() {
        let options = |header| LoadOptions { header: Some(header), ..LoadOptions::default() };
        assert_eq!(head_with("1,2\n3,4\n", &options(true)).unwrap().names, ["1", "2"]);
        assert_eq!(head_with("a,b\n3,4\n", &options(false)).unwrap().preamble, 0);
    }

    #[test]
    fn files_without_numbers_are_refused() {
        for (text, what) in [
            ("a,b\n", "a header, and no rows"),
            ("# a\n\n", "no rows"),
            ("a,b\nc,d\ne,f\n", "no column of numbers in the first lines; they start with `a b`"),
            ("a,b\n1,\"2\n3,4\n", "x.csv:2: a quoted cell"),
        ] {
            let e = head_with(text, &LoadOptions::default()).unwrap_err().to_string();
            assert!(e.contains(what), "{e}");
        }
    }
}
