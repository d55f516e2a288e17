//! Changed cells of a view, written into their stretches of the source.

use std::collections::HashMap;
use std::ops::Range;

use super::super::number::Reading;
use super::super::printable;
use super::super::rewrite::{Changes, Pen};
use super::super::style::Style;
use super::super::text::{Text, decoded};
use super::super::tokens::line_end_of;
use super::super::{CellChange, Track};
use super::{Nothing, View};
use crate::error::{Error, Result};

/// A stretch of the source and what stands there afterwards.
struct Edit {
    at: Range<usize>,
    text: String,
}

/// Writes the source of `text` with the changed cells of its view.
///
/// # Errors
/// [`Error::Usage`] for a new row, and for a cell that has no place in the source; [`Error::Io`] when the pen fails.
pub(crate) fn rewrite(track: &Track, text: &Text<'_>, view: &View, changes: &Changes, pen: &mut Pen<'_>) -> Result<()> {
    let source = text.source();
    if let Some(new) = changes.rows.first() {
        return Err(Error::usage(
            format!("a new row after row {}: {} has no form for it", u64::from(new.after_row) + 1, view.format.name),
            "leave gaps as they are (`fill_gaps = no`), or repair the record as a table",
        ));
    }
    let reading = Reading::new(track.dialect.decimal_comma, &[]);
    let mut writer = Writer { track, view, source, reading, styles: HashMap::new() };
    let mut edits = changes.cells.iter().map(|change| writer.edit(change)).collect::<Result<Vec<_>>>()?;
    edits.sort_by_key(|e| e.at.start);
    let end = line_end_of(source);
    let mut written = 0;
    let mut left = edits.as_slice();
    while let Some(first) = left.first() {
        let line = line_around(source, &first.at, end);
        let count = left.iter().take_while(|e| e.at.start < line.end.max(first.at.start + 1)).count();
        let (mine, later) = left.split_at(count);
        left = later;
        pen.text(&source[written..line.start])?;
        pen.text(&changed_line(source, &line, mine, view))?;
        written = line.end;
    }
    pen.text(&source[written..])
}

/// The line around a stretch, without its line end; with it, where the stretch reaches over it.
fn line_around(source: &[u8], at: &Range<usize>, end: u8) -> Range<usize> {
    let start = source[..at.start].iter().rposition(|b| *b == end).map_or(0, |p| p + 1);
    let stop = source[at.end..].iter().position(|b| *b == end).map_or(source.len(), |p| at.end + p);
    let within = at.end > at.start && source[at.end - 1] == end;
    let stop = if within { at.end } else { stop };
    let cr = !within && stop > start && source[stop - 1] == b'\r';
    start..(if cr { stop - 1 } else { stop }).max(at.end)
}

fn changed_line(source: &[u8], line: &Range<usize>, edits: &[Edit], view: &View) -> Vec<u8> {
    let mut text = Vec::with_capacity(line.len() + 16);
    let mut done = line.start;
    for edit in edits {
        text.extend_from_slice(&source[done.min(edit.at.start)..edit.at.start]);
        text.extend_from_slice(edit.text.as_bytes());
        done = edit.at.end;
    }
    text.extend_from_slice(&source[done.min(line.end)..line.end]);
    match (view.sheet.mend, std::str::from_utf8(&text)) {
        (Some(mend), Ok(line)) => mend(line).into_bytes(),
        _ => text,
    }
}

/// Writes values into the cells of a view.
struct Writer<'a> {
    track: &'a Track,
    view: &'a View,
    source: &'a [u8],
    reading: Reading,
    /// How numbers are written, by column and track.
    styles: HashMap<(usize, usize), Option<Style>>,
}

impl Writer<'_> {
    fn edit(&mut self, change: &CellChange) -> Result<Edit> {
        let (row, column) = (change.row as usize, change.column);
        let Some(at) = self.view.place(row, column) else { return Err(self.no_place(row, column)) };
        let field = &self.view.sheet.fields[column];
        let old = decoded(&self.source[at.clone()], self.track.dialect.encoding);
        let Some(value) = change.value.filter(|v| v.is_finite()) else {
            return Ok(match &field.nothing {
                Nothing::Text(text) => fitted(self.source, at, text.clone().into_owned(), self.view),
                Nothing::NoLine => Edit { at: whole_line(self.source, &at), text: String::new() },
            });
        };
        let style = || self.view.style((row, column), self.source, &self.reading);
        let style = self.styles.entry((column, self.view.track(row))).or_insert_with(style);
        let text = field.spelling.written(value, &old, style.as_ref(), &self.reading);
        Ok(fitted(self.source, at, text, self.view))
    }

    fn no_place(&self, row: usize, column: usize) -> Error {
        let name = self.track.columns.get(column).map_or("", |c| c.name.as_str());
        let (line, format) = (self.view.line(row as u64 + 2), self.view.format.name);
        Error::usage(
            format!("line {line}: {format} has no place for a value of `{}`", printable(name)),
            "leave missing values as they are (`max_fill = 0`), or repair the record as a table",
        )
    }
}

/// The edit that keeps the width of the cell, where the source has columns of a fixed width: blanks before the number
/// make room, or fill it.
fn fitted(source: &[u8], at: Range<usize>, text: String, view: &View) -> Edit {
    if !view.sheet.fixed_width {
        return Edit { at, text };
    }
    let width = at.len();
    if text.len() < width {
        return Edit { at, text: format!("{text:>width$}") };
    }
    let blanks = source[..at.start].iter().rev().take_while(|b| **b == b' ').count();
    // One blank stays, to part the number from what stands before it.
    let room = (text.len() - width).min(blanks.saturating_sub(1));
    Edit { at: at.start - room..at.end, text }
}

/// The line around a stretch, with its line end.
fn whole_line(source: &[u8], at: &Range<usize>) -> Range<usize> {
    let end = line_end_of(source);
    let start = source[..at.start].iter().rposition(|b| *b == end).map_or(0, |p| p + 1);
    let stop = source[at.end..].iter().position(|b| *b == end).map_or(source.len(), |p| at.end + p + 1);
    start..stop
}
