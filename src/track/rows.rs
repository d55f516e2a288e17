//! Second passes over the rows of a source.

use std::borrow::Cow;

use super::cells::Cells;
use super::head::open_quote;
use super::text::{Text, path_of, sha256, stored};
use super::tokens::{Layout, Record, RecordKind, Records, Span, is_empty, line_end_of, split};
use super::{Dialect, Track};
use crate::error::{Error, Result};

/// Reads the source again and calls `f` with each data row (from 0) and its cells, in order.
///
/// # Errors
/// [`Error::Input`] when the source is no longer the one that was loaded, [`Error::Io`] when it cannot be read, and
/// what `f` gives.
pub fn for_each_row(track: &Track, mut f: impl FnMut(usize, &Cells<'_>) -> Result<()>) -> Result<()> {
    let stored = unchanged(track)?;
    let text = text_of(track, &stored)?;
    walk(track, &text, |row, record, splitter| {
        let cells = Cells {
            record: record.bytes,
            spans: splitter.cells(record),
            quote: track.dialect.quote,
            encoding: text.encoding,
            line: record.line,
        };
        f(row, &cells).map(|()| true)
    })
}

/// The bytes of the source, which are those that were loaded.
///
/// # Errors
/// [`Error::Input`] when they are not.
pub(crate) fn unchanged(track: &Track) -> Result<Cow<'_, [u8]>> {
    let stored = stored(&track.source)?;
    if sha256(&stored) != track.sha256 {
        return Err(Error::input(
            path_of(&track.source),
            "the file changed since it was loaded",
            "load it again, or put the old file back",
        ));
    }
    Ok(stored)
}

/// The text in `stored`, read as it was when the track was loaded.
///
/// # Errors
/// As [`Text::of`].
pub(crate) fn text_of<'a>(track: &Track, stored: &'a [u8]) -> Result<Text<'a>> {
    Text::of(stored, &path_of(&track.source), Some(track.dialect.encoding))
}

impl Dialect {
    /// How `body` falls into records and cells.
    pub(crate) fn layout(&self, body: &[u8]) -> Layout {
        Layout { delimiter: self.delimiter, quote: self.quote, line_end: line_end_of(body) }
    }
}

/// Splits records into cells where somebody wants them.
#[derive(Debug)]
pub(crate) struct Splitter {
    layout: Layout,
    spans: Vec<Span>,
}

impl Splitter {
    /// The cells of `record`.
    pub(crate) fn cells(&mut self, record: &Record<'_>) -> &[Span] {
        split(record.bytes, self.layout, &mut self.spans);
        &self.spans
    }
}

/// Calls `f` with each data row (from 0), its record and what splits it, until `f` gives false.
///
/// # Errors
/// What `f` gives.
pub(crate) fn walk<'a>(
    track: &Track,
    text: &'a Text<'_>,
    mut f: impl FnMut(usize, &Record<'a>, &mut Splitter) -> Result<bool>,
) -> Result<()> {
    let layout = track.dialect.layout(text.body()).without_idle_quote(text.body());
    let mut splitter = Splitter { layout, spans: Vec::new() };
    let mut before = track.dialect.preamble;
    let mut row = 0;
    for record in Records::new(text.body(), layout) {
        if row == track.rows {
            break;
        }
        let record = record.map_err(|q| open_quote(&path_of(&track.source), q))?;
        if record.kind != RecordKind::Data {
            continue;
        }
        // Empty rows before the first data row belong to what stands before it.
        if row == 0 {
            let empty = is_empty(record.bytes, splitter.cells(&record), layout);
            if before > 0 || empty {
                before -= usize::from(!empty);
                continue;
            }
        }
        if !f(row, &record, &mut splitter)? {
            break;
        }
        row += 1;
    }
    Ok(())
}
