//! Second passes over the rows of a source.

use super::cells::Cells;
use super::feed::Feed;
use super::head::open_quote;
use super::text::{Stored, Text, path_of, sha256, stored};
use super::tokens::{Layout, OpenQuote, Record, RecordKind, Records, Span, line_end_of, split};
use super::view::Want;
use super::{Dialect, Extent, Track, Wanted};
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

/// The bytes of the source that were loaded, unchanged; what was appended since is left out.
///
/// # Errors
/// [`Error::Input`] when they are not.
pub(crate) fn unchanged(track: &Track) -> Result<Stored<'_>> {
    let stored = stored(&track.source, Extent::First(track.bytes))?;
    if sha256(&stored, Wanted::always()) != track.sha256 {
        return Err(Error::input(
            path_of(&track.source),
            "the file changed since it was loaded",
            "load it again, or put the old file back; decisions can be saved without it",
        ));
    }
    Ok(stored)
}

/// The text in `stored`, read as it was when the track was loaded.
///
/// # Errors
/// As [`Text::of`].
pub(crate) fn text_of<'a>(track: &Track, stored: &'a [u8]) -> Result<Text<'a>> {
    let path = path_of(&track.source);
    let want = Want { table: track.dialect.rows.table };
    let text = Text::of_table(stored, &path, Some(track.dialect.encoding), want)?;
    match &track.dialect.view {
        Some(viewed) => text.viewed(viewed.format, Want { table: viewed.table }, &path),
        None => Ok(text),
    }
}

impl Dialect {
    /// How `body` falls into records and cells.
    pub(crate) fn layout(&self, body: &[u8]) -> Layout {
        Layout { delimiter: self.delimiter, quote: self.quote, line_end: line_end_of(body), mark: self.rows.mark }
    }

    /// What `read` makes of the cells of one record, which starts in `line` (from 1) and comes without its line end.
    pub fn with_cells<T>(&self, record: &[u8], line: u64, read: impl FnOnce(&Cells<'_>) -> T) -> T {
        let mut spans = Vec::new();
        split(record, self.layout(record), &mut spans);
        read(&Cells { record, spans: &spans, quote: self.quote, encoding: self.encoding, line })
    }
}

/// Splits records into cells where somebody wants them.
#[derive(Debug)]
pub(crate) struct Splitter {
    layout: Layout,
    spans: Vec<Span>,
}

impl Splitter {
    pub(crate) fn new(layout: Layout) -> Self {
        Self { layout, spans: Vec::new() }
    }

    /// The cells of `record`.
    pub(crate) fn cells(&mut self, record: &Record<'_>) -> &[Span] {
        split(record.bytes, self.layout, &mut self.spans);
        &self.spans
    }
}

/// Tells the data rows among the records from the first row on.
struct Walk<'t> {
    /// Lines that are no rows.
    repeats: &'t [Vec<u8>],
    row: usize,
    splitter: Splitter,
}

impl<'t> Walk<'t> {
    fn new(track: &'t Track, layout: Layout) -> Self {
        Self { repeats: &track.dialect.rows.repeats, row: 0, splitter: Splitter::new(layout) }
    }

    /// Calls `f` with a record if it is a data row; false when no more are wanted.
    fn take<'a>(
        &mut self,
        record: &Record<'a>,
        f: &mut impl FnMut(usize, &Record<'a>, &mut Splitter) -> Result<bool>,
    ) -> Result<bool> {
        let repeats = self.repeats;
        if record.kind != RecordKind::Data
            || (!repeats.is_empty() && repeats.iter().any(|r| r == record.bytes.trim_ascii()))
        {
            return Ok(true);
        }
        let more = f(self.row, record, &mut self.splitter)?;
        self.row += 1;
        Ok(more)
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
    let mut walk = Walk::new(track, layout);
    let at = &track.dialect.rows;
    for record in Records::from(text.body(), layout, at.start, at.line) {
        if walk.row == track.rows {
            break;
        }
        let record = record.map_err(|q| open_quote(&path_of(&track.source), q))?;
        let line = text.view.as_ref().map_or(record.line, |view| view.line(record.line));
        if !walk.take(&Record { line, ..record }, &mut f)? {
            break;
        }
    }
    Ok(())
}

/// [`walk`] over a text that is read piece by piece. Offsets of records count from the piece.
///
/// # Errors
/// What `f` gives, and when the text can no longer be read.
pub(crate) fn walk_feed(
    track: &Track,
    feed: &mut Feed<'_>,
    mut f: impl FnMut(usize, &Record<'_>, &mut Splitter) -> Result<bool>,
) -> Result<()> {
    const PIECE: usize = 1 << 20;
    let Dialect { delimiter, quote, .. } = &track.dialect;
    let (delimiter, quote) = (*delimiter, *quote);
    let at = &track.dialect.rows;
    let layout = Layout { delimiter, quote, line_end: feed.line_end(), mark: at.mark };
    feed.peek(at.start).map_err(|_| unreadable(track))?;
    feed.skip(at.start);
    let mut walk = Walk::new(track, layout);
    let (mut piece, mut lines, mut last) = (Vec::new(), at.line.saturating_sub(1), false);
    while !last {
        let mut next = Vec::new();
        last = feed.next(&mut next, PIECE).map_err(|_| unreadable(track))?;
        piece.append(&mut next);
        let (mut done, mut passed) = (0, 0);
        let mut records = Records::new(&piece, layout);
        while let Some(record) = records.next() {
            if walk.row == track.rows {
                return Ok(());
            }
            match record {
                Ok(record) => {
                    if !walk.take(&Record { line: record.line + lines, ..record }, &mut f)? {
                        return Ok(());
                    }
                    done = record.start + record.bytes.len() + record.end.len();
                    passed = records.lines();
                }
                // What does not end here may end in the next piece.
                Err(_) if !last => break,
                Err(q) => return Err(open_quote(&path_of(&track.source), OpenQuote { line: q.line + lines })),
            }
        }
        piece.drain(..done);
        lines += passed;
    }
    Ok(())
}

fn unreadable(track: &Track) -> Error {
    Error::input(path_of(&track.source), "it cannot be read again", "load it again, or put the old file back")
}
