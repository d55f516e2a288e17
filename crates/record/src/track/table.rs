//! From the first lines of a text to its table: which lines are rows, and what stands above and below them.

use super::Encoding;
use super::cells::Cells;
use super::number::Reading;
use super::sniff::{Look, look, most_frequent};
use super::tokens::{Layout, Mark, OpenQuote, Record, RecordKind, Records, split};
use super::{Delimiter, LoadOptions, names};

mod aligned;
mod header;
mod rows;
mod units;

pub(crate) use header::{Heading, heading, named_cells};
pub(crate) use rows::{Table, tables};

/// A row with more cells is not a row of a table.
pub(crate) const MOST_COLUMNS: usize = 100_000;

/// Why lines are no lines of a table.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum NoTable {
    /// A quoted cell does not end.
    Open(OpenQuote),
    /// A row has more than [`MOST_COLUMNS`] cells.
    Wide {
        /// From 1.
        line: u64,
    },
}

/// A line of the text, with its cells.
#[derive(Debug, Clone)]
pub(crate) struct Line {
    /// From 1.
    pub(crate) number: u64,
    /// Offset of its first byte.
    pub(crate) start: usize,
    /// Length without the line end.
    pub(crate) length: usize,
    /// Offset of the line after it.
    pub(crate) next: usize,
    pub(crate) kind: RecordKind,
    /// Its text (of a comment: without the marks).
    pub(crate) text: String,
    /// Its cells (of a comment: of what follows the marks).
    pub(crate) cells: Vec<String>,
}

impl Line {
    /// How many cells are not empty.
    pub(crate) fn filled(&self) -> usize {
        self.cells.iter().filter(|c| !c.is_empty()).count()
    }

    /// True for a line that can be a row.
    pub(crate) fn is_data(&self) -> bool {
        self.kind == RecordKind::Data && self.filled() > 0
    }
}

/// Where lines are read from.
pub(crate) struct Lines<'a> {
    pub(crate) body: &'a [u8],
    pub(crate) layout: Layout,
    pub(crate) encoding: Encoding,
    /// Lines before which nothing is looked at.
    pub(crate) skip: usize,
}

impl Lines<'_> {
    /// The first lines: until `most` of them can be rows, or this many bytes have been passed.
    ///
    /// # Errors
    /// [`NoTable`] for a quoted cell that does not end, and for a row of too many cells.
    pub(crate) fn first(&self, most: usize, bytes: usize) -> Result<Vec<Line>, NoTable> {
        let (start, line) = self.skipped();
        let mut lines = Vec::new();
        let mut data = 0;
        for record in Records::from(self.body, self.layout, start, line) {
            let record = record.map_err(NoTable::Open)?;
            // Before memory is taken for its cells.
            if self.is_wide(&record) {
                return Err(NoTable::Wide { line: record.line });
            }
            let line = self.line_of(&record);
            data += usize::from(line.is_data());
            let far = line.next > start.saturating_add(bytes);
            lines.push(line);
            if data == most || far {
                break;
            }
        }
        Ok(lines)
    }

    /// Offset and number of the first line that is looked at.
    fn skipped(&self) -> (usize, u64) {
        if self.skip == 0 {
            return (0, 1);
        }
        let end = memchr::memchr_iter(self.layout.line_end, self.body).nth(self.skip - 1);
        end.map_or((self.body.len(), 1), |at| (at + 1, self.skip as u64 + 1))
    }

    fn is_wide(&self, record: &Record<'_>) -> bool {
        let ends = match self.layout.delimiter {
            Delimiter::Byte(delimiter) => memchr::memchr_iter(delimiter, record.bytes).count(),
            Delimiter::Blanks => record.bytes.iter().filter(|b| b.is_ascii_whitespace()).count(),
        };
        ends >= MOST_COLUMNS
    }

    fn line_of(&self, record: &Record<'_>) -> Line {
        let bytes = match record.kind {
            RecordKind::Comment => unmarked(record.bytes, self.layout.mark),
            _ => record.bytes,
        };
        let layout = self.layout;
        Line {
            number: record.line,
            start: record.start,
            length: record.bytes.len(),
            next: record.start + record.bytes.len() + record.end.len(),
            kind: record.kind,
            text: super::text::decoded(bytes, self.encoding).trim().to_owned(),
            cells: self.cells(bytes, layout),
        }
    }

    fn cells(&self, bytes: &[u8], layout: Layout) -> Vec<String> {
        let mut spans = Vec::new();
        split(bytes, layout, &mut spans);
        let cells = Cells { record: bytes, spans: &spans, quote: layout.quote, encoding: self.encoding, line: 0 };
        (0..cells.len()).map(|c| cells.text(c).into_owned()).collect()
    }

    /// The cells of a line as another layout parts them.
    pub(crate) fn parted(&self, line: &Line, layout: Layout) -> Vec<String> {
        self.cells(line.text.as_bytes(), layout)
    }
}

/// A comment without what marks it.
fn unmarked(bytes: &[u8], mark: Option<Mark>) -> &[u8] {
    let stripped = bytes.trim_ascii_start();
    if let Some(mark) = mark
        && let Some(rest) = stripped.strip_prefix(mark.bytes())
    {
        return rest;
    }
    let marks = stripped.iter().take_while(|b| matches!(b, b'#' | b'%' | b'/')).count();
    &stripped[marks..]
}

/// The text that marks the comments of a file, besides `#`, `%` and `//`: what the user tells, or a character with which
/// lines above the table begin, and no row.
pub(crate) fn mark_of(lines: &[Line], first_row: usize, layout: Layout, options: &LoadOptions) -> Option<Mark> {
    if let Some(told) = &options.comment {
        return Mark::new(told.as_bytes());
    }
    const MARKS: &[u8] = b";*!>$&@~?\\^";
    let starts = |line: &Line| line.text.as_bytes().first().copied();
    let (above, rows) = lines.split_at(first_row.min(lines.len()));
    let fits = |mark: &&u8| {
        let delimiter = layout.delimiter == Delimiter::Byte(**mark);
        !delimiter
            && above.iter().any(|l| starts(l) == Some(**mark))
            && !rows.iter().filter(|l| l.is_data()).take(200).any(|l| starts(l) == Some(**mark))
    };
    MARKS.iter().find(fits).and_then(|mark| Mark::new(&[*mark]))
}

/// For each column: do its cells, in the later half of the lines, read as numbers or times?
pub(crate) fn typed_columns(lines: &[&Line], reading: &Reading) -> Vec<bool> {
    let tail = &lines[lines.len() / 2..];
    let tail = &tail[tail.len().saturating_sub(200)..];
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

/// How the cells of a line read, in the columns that hold numbers or times.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct Cast {
    pub(crate) read: usize,
    pub(crate) text: usize,
    /// A cell that is the name of a time.
    pub(crate) names_time: bool,
}

/// How the cells of `line` read.
pub(crate) fn cast(line: &Line, typed: &[bool], reading: &Reading) -> Cast {
    let mut cast = Cast::default();
    for (cell, _) in line.cells.iter().zip(typed).filter(|(_, typed)| **typed) {
        match look(cell.as_bytes(), reading) {
            Look::Number | Look::Time => cast.read += 1,
            Look::Text => {
                cast.names_time |= names::time_rank(cell) > 1;
                cast.text += 1;
            }
            Look::Empty => {}
        }
    }
    cast
}

impl Cast {
    /// A row of data has numbers where the columns have them. A few may hold text, but not under the name of a time.
    pub(crate) fn is_row(self) -> bool {
        self.read > 0 && self.read >= self.text && !self.names_time
    }

    /// A row without text in those columns.
    pub(crate) fn is_clean(self) -> bool {
        self.read > 0 && self.text == 0
    }
}

/// The usual number of cells of rows.
pub(crate) fn usual_width<'a>(rows: impl Iterator<Item = &'a Line>) -> usize {
    let counts: Vec<usize> = rows.map(|l| l.cells.len()).collect();
    most_frequent(&counts).map_or(0, |(count, _)| count)
}
