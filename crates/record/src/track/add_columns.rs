//! The input again, byte for byte, with cells changed and columns added at the right.

use std::io::Write;

use super::cells::Cells;
use super::rewrite::{Form, NO_VALUE, NewRow, Pen, patched, rewrite_as};
use super::text::path_of;
use super::tokens::{Layout, Span, split};
use super::{CellChange, Changes, Delimiter, Track};
use crate::error::{Error, Result};

/// A column that the input does not have.
pub struct NewColumn<'a> {
    /// Its name.
    pub name: String,
    /// The text of its cell in a data row (from 0), which is handed in with its old cells.
    pub cell: &'a dyn Fn(usize, &Cells<'_>) -> String,
    /// The text of its cell in a row that the input does not have.
    pub new_row: &'a dyn Fn(&NewRow) -> String,
}

/// Writes the input of `track` again with `changes` (sorted by row and column, each with a value, which is written to
/// the last bit) and `columns` added at the right: in the header and in every data row; a units row gets empty cells.
/// Everything else stays byte for byte (unpacked, if it is packed).
///
/// # Errors
/// [`Error::Input`] when the source is no longer the one that was loaded, or a row has more cells than there are
/// columns; [`Error::Io`] when `out` fails.
pub fn widen(track: &Track, changes: &[CellChange], columns: &[NewColumn<'_>], out: &mut dyn Write) -> Result<()> {
    let changes = Changes { cells: changes.to_vec(), rows: Vec::new() };
    rewrite_as(track, (&changes, Form::exact()), columns, out)
}

/// [`rewrite`](super::rewrite()) with `columns` added at the right, as [`widen`] adds them.
///
/// # Errors
/// As [`rewrite`](super::rewrite()) and [`widen`].
pub fn rewrite_beside(track: &Track, changes: &Changes, columns: &[NewColumn<'_>], out: &mut dyn Write) -> Result<()> {
    rewrite_as(track, (changes, Form::of(track)), columns, out)
}

/// The columns that are added to a table.
pub(super) struct Beside<'a> {
    pub(super) track: &'a Track,
    /// The text of the input.
    pub(super) body: &'a [u8],
    pub(super) layout: Layout,
    pub(super) columns: &'a [NewColumn<'a>],
}

impl Beside<'_> {
    /// Writes up to the end of the last line before the data that gets new cells; gives how much has been written.
    pub(super) fn head(&self, pen: &mut Pen<'_>) -> Result<usize> {
        let body = self.body;
        let [header, units] = [self.track.dialect.rows.header, self.track.dialect.rows.units];
        let mut written = 0;
        for (line, cells) in [(header, self.names()), (units, self.nothing())] {
            let Some((start, length)) = line else { continue };
            pen.text(&body[written..start])?;
            pen.text(&self.longer(&body[start..start + length], cells))?;
            written = start + length;
        }
        Ok(written)
    }

    /// Writes the lines between two rows: a header that comes again is one that has all names again.
    pub(super) fn between(&self, lines: &[u8], pen: &mut Pen<'_>) -> Result<()> {
        let rows = &self.track.dialect.rows;
        if rows.repeats.is_empty() {
            return pen.text(lines);
        }
        let names = rows.header.map(|(start, length)| self.body[start..start + length].trim_ascii());
        for line in lines.split_inclusive(|b| *b == self.layout.line_end) {
            let bare = line.trim_ascii_end();
            let trimmed = bare.trim_ascii_start();
            if !rows.repeats.iter().any(|repeat| repeat == trimmed) {
                pen.text(line)?;
                continue;
            }
            let cells = if names == Some(trimmed) { self.names() } else { self.nothing() };
            pen.text(&self.longer(bare, cells))?;
            pen.text(&line[bare.len()..])?;
        }
        Ok(())
    }

    /// The new cells of a row.
    pub(super) fn cells(&self, row: usize, cells: &Cells<'_>) -> Result<Vec<(usize, String)>> {
        let columns = self.track.columns.len();
        if cells.len() > columns && !cells.record[cells.spans[columns].start as usize..].is_empty() {
            return Err(Error::Input {
                path: path_of(&self.track.source),
                line: Some(cells.line),
                what: format!("{} cells under {columns} columns: nothing can be added", cells.len()),
                help: "mend the row first".into(),
            });
        }
        Ok(self.placed(self.columns.iter().map(|column| (column.cell)(row, cells))))
    }

    /// The new cells of a row that the input does not have.
    pub(super) fn new_row(&self, row: &NewRow) -> Vec<(usize, String)> {
        self.placed(self.columns.iter().map(|column| (column.new_row)(row)))
    }

    fn placed(&self, texts: impl Iterator<Item = String>) -> Vec<(usize, String)> {
        texts.enumerate().map(|(i, text)| (self.track.columns.len() + i, filled(text, self.layout))).collect()
    }

    fn names(&self) -> Vec<(usize, String)> {
        self.placed(self.columns.iter().map(|c| quoted(&c.name, self.track, self.layout)))
    }

    fn nothing(&self) -> Vec<(usize, String)> {
        self.placed(self.columns.iter().map(|_| String::new()))
    }

    /// A line with cells added.
    fn longer(&self, line: &[u8], cells: Vec<(usize, String)>) -> Vec<u8> {
        let mut spans: Vec<Span> = Vec::new();
        split(line, self.layout, &mut spans);
        patched(line, &spans, (self.layout, false), &cells)
    }
}

/// A cell that is a cell: between blanks an empty one would be none.
fn filled(cell: String, layout: Layout) -> String {
    if cell.is_empty() && layout.delimiter == Delimiter::Blanks { NO_VALUE.to_owned() } else { cell }
}

/// A name as a cell of the header.
fn quoted(name: &str, track: &Track, layout: Layout) -> String {
    let quote = char::from(track.dialect.quote.unwrap_or(b'"'));
    let parts = match layout.delimiter {
        Delimiter::Byte(delimiter) => name.contains(char::from(delimiter)),
        Delimiter::Blanks => name.contains([' ', '\t']),
    };
    if parts || name.contains([quote, '\n', '\r']) {
        format!("{quote}{}{quote}", name.replace(quote, &format!("{quote}{quote}")))
    } else {
        name.to_owned()
    }
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use super::super::{LoadOptions, Source, load};
    use super::*;

    fn widened(text: &str, change: Option<(u32, usize, f64)>) -> Result<String> {
        let source = Source::BuiltIn { name: "wildpoint:test", bytes: Arc::from(text.as_bytes()) };
        let track = load(&source, &LoadOptions::default())?;
        let copy = |_: usize, cells: &Cells<'_>| cells.text(1).into_owned();
        let number = |row: usize, _: &Cells<'_>| row.to_string();
        let new_row = &|_: &NewRow| String::new();
        let columns = [
            NewColumn { name: "raw, x".into(), cell: &copy, new_row },
            NewColumn { name: "n".into(), cell: &number, new_row },
        ];
        let changes: Vec<CellChange> =
            change.map(|(row, column, value)| CellChange { row, column, value: Some(value) }).into_iter().collect();
        let mut out = Vec::new();
        widen(&track, &changes, &columns, &mut out)?;
        Ok(String::from_utf8_lossy(&out).into_owned())
    }

    #[test]
    fn columns_are_added_at_the_right_and_nothing_else_changes() {
        let text = "# c\ntime,x,who\r\n0, 1.50 ,\"a,b\"\n\n# between\n1,2.5,c\n2,,d";
        let expected = "# c\ntime,x,who,\"raw, x\",n\r\n0, 1.50 ,\"a,b\",1.50,0\n\n# between\n1,-3.5,c,2.5,1\n2,,d,,2";
        assert_eq!(widened(text, Some((1, 1, -3.5))).unwrap(), expected);
    }

    #[test]
    fn heads_of_every_kind_get_the_names() {
        let units = "a title,,\ntime,alt,v\ns,ft,\n0,1,2\n1,2,3\n";
        let expected = "a title,,\ntime,alt,v,\"raw, x\",n\ns,ft,,,\n0,1,2,1,0\n1,2,3,2,1\n";
        assert_eq!(widened(units, None).unwrap(), expected);
        assert_eq!(widened("0;1,5\n1;2,5\n", Some((0, 1, 0.25))).unwrap(), "0;0,25;1,5;0\n1;2,5;2,5;1\n");
        let commented = "#version,time,x\n6,0,1\n6,1,2\n";
        assert_eq!(widened(commented, None).unwrap(), "#version,time,x,\"raw, x\",n\n6,0,1,0,0\n6,1,2,1,1\n");
        let blanks = "time x\n0 1\n1 2\n";
        assert_eq!(widened(blanks, None).unwrap(), "time x \"raw, x\" n\n0 1 1 0\n1 2 2 1\n");
    }

    #[test]
    fn short_rows_are_filled_up_and_long_ones_refused() {
        assert_eq!(
            widened("time,x,y\n0,1,2\n1,5\n2,3,4\n", None).unwrap(),
            "time,x,y,\"raw, x\",n\n0,1,2,1,0\n1,5,,5,1\n2,3,4,3,2\n"
        );
        let e = widened("time,x\n0,1\n1,5,6,7\n2,3\n", None).unwrap_err().to_string();
        assert!(e.contains(":3: 4 cells under 2 columns"), "{e}");
    }
}
