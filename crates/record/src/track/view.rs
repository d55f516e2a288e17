//! A table that a format makes of a text of records: rows of cells, each of which is a stretch of the text.
//!
//! A format whose lines are no rows of one table (several kinds of records, a keyword before each value, a block for each
//! epoch) gives a [`Sheet`]. It is loaded as a table between tabs, through the same steps as any other; a changed cell is
//! written into its stretch of the text, and every other byte stays.

use std::borrow::Cow;
use std::collections::HashMap;
use std::ops::Range;

use super::number::Reading;
use super::style::Style;
use super::text::decoded;
use super::{Aside, Encoding, Format, windows_1252};
use crate::error::{Error, Result};

mod edit;
mod source;
mod spelling;
mod tables;

pub(crate) use edit::rewrite;
pub(crate) use source::{Piece, SourceLine, lines};
pub(crate) use spelling::Spelling;
pub(crate) use tables::{Kinds, labels, stamp};

/// What is wanted of a text.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct Want {
    /// Which of several tables, from 1. None: that with the most rows.
    pub(crate) table: Option<usize>,
}

/// A column of a sheet.
#[derive(Debug, Clone)]
pub(crate) struct Field {
    pub(crate) name: String,
    pub(crate) unit: String,
    /// Why it is not a channel, where it is none.
    pub(crate) aside: Option<Aside>,
    pub(crate) spelling: Spelling,
    pub(crate) nothing: Nothing,
}

impl Field {
    /// A column of numbers.
    pub(crate) fn new(name: impl Into<String>, unit: &str) -> Self {
        Self {
            name: name.into(),
            unit: unit.to_owned(),
            aside: None,
            spelling: Spelling::Number,
            nothing: Nothing::text(super::rewrite::NO_VALUE),
        }
    }

    /// The same as no channel.
    pub(crate) fn aside(self, aside: Aside) -> Self {
        Self { aside: Some(aside), ..self }
    }

    /// The same with another way to write no value.
    pub(crate) fn nothing(self, nothing: Nothing) -> Self {
        Self { nothing, ..self }
    }
}

/// How a format writes that there is no value.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) enum Nothing {
    /// This text in the place of the number.
    Text(Cow<'static, str>),
    /// The line of the value is left out.
    NoLine,
}

impl Nothing {
    /// This text in the place of the number.
    pub(crate) fn text(text: &'static str) -> Self {
        Self::Text(Cow::Borrowed(text))
    }
}

/// A cell of a sheet.
#[derive(Debug, Clone)]
pub(crate) enum Cell {
    /// A stretch of the text; an empty one is a cell without a value.
    At(Range<usize>),
    /// A stretch that is a fill value, and can be overwritten by one.
    Missing(Range<usize>),
    /// A text made of others, which no change can reach.
    Made(String),
}

/// A row of a sheet.
#[derive(Debug, Clone, Default)]
pub(crate) struct Row {
    /// Its first line in the text, from 1.
    pub(crate) line: u64,
    /// Its cells with the index of their field, in any order; the first of two for one field holds.
    pub(crate) cells: Vec<(usize, Cell)>,
}

impl Row {
    /// True where there is a cell for this field.
    pub(crate) fn has(&self, field: usize) -> bool {
        self.cells.iter().any(|(f, _)| *f == field)
    }
}

/// What a format makes of a text.
#[derive(Debug, Default)]
pub(crate) struct Sheet {
    /// The columns; the first is the time, where there is one.
    pub(crate) fields: Vec<Field>,
    pub(crate) rows: Vec<Row>,
    /// True where the first column is the time.
    pub(crate) timed: bool,
    /// The column that tells tracks apart.
    pub(crate) track: Option<usize>,
    /// What was assumed, in a line each.
    pub(crate) said: Vec<String>,
    /// True when a comma is the decimal sign.
    pub(crate) decimal_comma: bool,
    /// True where values stand in columns of a fixed width.
    pub(crate) fixed_width: bool,
    /// Makes a line right again that was changed (its checksum).
    pub(crate) mend: Option<fn(&str) -> String>,
}

impl Sheet {
    /// Leaves out the columns of which no row has a cell; the first stays.
    pub(crate) fn without_unused(&mut self) {
        let mut used = vec![false; self.fields.len()];
        self.rows.iter().flat_map(|row| &row.cells).for_each(|(field, _)| used[*field] = true);
        if let Some(first) = used.first_mut() {
            *first = true;
        }
        let mut next = 0;
        let places: Vec<Option<usize>> = used
            .iter()
            .map(|used| {
                next += usize::from(*used);
                used.then(|| next - 1)
            })
            .collect();
        let mut keep = used.iter();
        self.fields.retain(|_| keep.next() == Some(&true));
        self.track = self.track.and_then(|track| places[track]);
        for (field, _) in self.rows.iter_mut().flat_map(|row| &mut row.cells) {
            *field = places[*field].unwrap_or(0);
        }
    }
}

/// A sheet as a table between tabs, with the place of each cell in the source.
#[derive(Debug)]
pub(crate) struct View {
    pub(crate) format: &'static Format,
    /// Names in the first line, rows below it.
    pub(crate) table: Vec<u8>,
    /// The sheet, without its rows.
    pub(crate) sheet: Sheet,
    /// For each row and field the stretch of the source, if it has one.
    places: Vec<Option<Range<usize>>>,
    /// For each row its line in the source, from 1.
    pub(crate) lines: Vec<u64>,
    /// For each row the number of its track; empty where all rows are one.
    tracks: Vec<usize>,
}

/// The number of the track of each row.
fn tracks(rows: &[Row], track: usize, body: &[u8]) -> Vec<usize> {
    let mut known: HashMap<Vec<u8>, usize> = HashMap::new();
    let number = |row: &Row| {
        let text = match row.cells.iter().find(|(field, _)| *field == track) {
            Some((_, Cell::At(at))) => body[at.clone()].to_vec(),
            Some((_, Cell::Made(text))) => text.clone().into_bytes(),
            _ => Vec::new(),
        };
        let next = known.len();
        *known.entry(text).or_insert(next)
    };
    rows.iter().map(number).collect()
}

impl View {
    /// The table that `format` makes of `body`.
    ///
    /// # Errors
    /// What the format says of a text that it cannot read; [`Error::Usage`] for a table that is not there.
    pub(crate) fn of(format: &'static Format, body: &[u8], encoding: Encoding, want: Want) -> Result<Option<Self>> {
        let Some(sheet) = format.sheet else { return Ok(None) };
        let mut sheet = sheet(body, want)?;
        let rows = std::mem::take(&mut sheet.rows);
        if rows.is_empty() {
            return Err(Error::input(
                "",
                format!("no records with measurements in this file, which looks like {}", format.name),
                "name a file with measurements; `wildpoint help formats` says what is read of each format",
            ));
        }
        let width = sheet.fields.len();
        let mut view = Self {
            format,
            table: Vec::with_capacity(rows.len() * width * 8),
            places: vec![None; rows.len() * width],
            lines: rows.iter().map(|r| r.line).collect(),
            tracks: sheet.track.map_or_else(Vec::new, |track| tracks(&rows, track, body)),
            sheet,
        };
        view.write_names(encoding);
        for (index, row) in rows.iter().enumerate() {
            view.write_row(index, row, body, encoding);
        }
        Ok(Some(view))
    }

    fn write_names(&mut self, encoding: Encoding) {
        for (place, field) in self.sheet.fields.iter().enumerate() {
            if place > 0 {
                self.table.push(b'\t');
            }
            let name = field.name.replace(['\t', '\n', '\r'], " ");
            match encoding {
                Encoding::Latin1 => self.table.extend_from_slice(&windows_1252::encode(&name)),
                Encoding::Utf8 { .. } | Encoding::Utf16 { .. } => self.table.extend_from_slice(name.as_bytes()),
            }
        }
        self.table.push(b'\n');
    }

    fn write_row(&mut self, index: usize, row: &Row, body: &[u8], encoding: Encoding) {
        let width = self.sheet.fields.len();
        for place in 0..width {
            if place > 0 {
                self.table.push(b'\t');
            }
            let Some((_, cell)) = row.cells.iter().find(|(field, _)| *field == place) else { continue };
            let from = self.table.len();
            match cell {
                Cell::Made(text) => self.table.extend_from_slice(text.as_bytes()),
                Cell::Missing(at) => self.places[index * width + place] = Some(at.clone()),
                Cell::At(at) => {
                    self.places[index * width + place] = Some(at.clone());
                    match self.sheet.fields[place].spelling {
                        Spelling::Number => self.table.extend_from_slice(&body[at.clone()]),
                        other => {
                            let text = other.read(&decoded(&body[at.clone()], encoding));
                            self.table.extend_from_slice(text.as_bytes());
                        }
                    }
                }
            }
            let cell = &mut self.table[from..];
            cell.iter_mut().filter(|b| matches!(**b, b'\t' | b'\n' | b'\r')).for_each(|b| *b = b' ');
        }
        self.table.push(b'\n');
    }

    /// Where the value of a cell stands in the source.
    fn place(&self, row: usize, column: usize) -> Option<Range<usize>> {
        let width = self.sheet.fields.len();
        self.places.get(row * width + column).filter(|_| column < width)?.clone()
    }

    /// The number of the track of a row.
    fn track(&self, row: usize) -> usize {
        self.tracks.get(row).copied().unwrap_or(0)
    }

    /// How the numbers of a column are written, in the rows of the track of `row`.
    fn style(&self, (row, column): (usize, usize), source: &[u8], reading: &Reading) -> Option<Style> {
        const SAMPLE: usize = 200;
        let of_track = |r: &usize| self.track(*r) == self.track(row);
        let places = (0..self.lines.len()).filter(of_track).filter_map(|r| self.place(r, column));
        let cells: Vec<&str> = places.take(SAMPLE).filter_map(|at| std::str::from_utf8(&source[at]).ok()).collect();
        Style::of(cells.into_iter(), reading)
    }

    /// The line in the source of a line of the table, both from 1; that of the first row for the names.
    pub(crate) fn line(&self, line: u64) -> u64 {
        let row = usize::try_from(line.saturating_sub(2)).unwrap_or(0);
        self.lines.get(row).or(self.lines.last()).copied().unwrap_or(line)
    }

    /// The memory that it takes, in bytes.
    pub(crate) fn bytes(&self) -> u64 {
        (self.table.len()
            + self.places.len() * size_of::<Option<Range<usize>>>()
            + (self.lines.len() + self.tracks.len()) * 8) as u64
    }
}
