//! The input again, byte for byte, with cells changed and columns added at the right.

use std::io::Write;

use super::cells::Cells;
use super::number::Reading;
use super::rewrite::{NO_VALUE, Pen, patched};
use super::rows::{text_of, unchanged, walk};
use super::text::{Text, path_of};
use super::tokens::{Layout, Span, split};
use super::{CellChange, Delimiter, Track};
use crate::error::{Error, Result};

/// A column that the input does not have.
pub struct NewColumn<'a> {
    /// Its name.
    pub name: String,
    /// The text of its cell in a data row (from 0), which is handed in with its old cells.
    pub cell: &'a dyn Fn(usize, &Cells<'_>) -> String,
}

/// Writes the input of `track` again with `changes` (sorted by row and column, each with a value) and `columns`
/// added at the right: in the header and in every data row; a units row and empty lines of data get empty cells.
/// Everything else stays byte for byte (unpacked, if it is gzipped).
///
/// # Errors
/// [`Error::Input`] when the source is no longer the one that was loaded, or a row has more cells than there are
/// columns; [`Error::Io`] when `out` fails.
pub fn widen(track: &Track, changes: &[CellChange], columns: &[NewColumn<'_>], out: &mut dyn Write) -> Result<()> {
    let stored = unchanged(track)?;
    let text = text_of(track, &stored)?;
    let (body, layout) = (text.body(), track.dialect.layout(text.body()));
    let mut pen = Pen { out, encoding: text.encoding, track };
    let reading = Reading::new(track.dialect.decimal_comma, &[]);
    pen.raw(text.mark())?;
    let mut written = head(track, &text, layout, columns, &mut pen)?;
    let mut left = changes;
    walk(track, &text, |row, record, splitter| {
        let spans = splitter.cells(record);
        if spans.len() > track.columns.len() && !record.bytes[spans[track.columns.len()].start as usize..].is_empty() {
            return Err(Error::Input {
                path: path_of(&track.source),
                line: Some(record.line),
                what: format!("{} cells under {} columns: nothing can be added", spans.len(), track.columns.len()),
                help: "mend the row first".into(),
            });
        }
        let mine = left.iter().take_while(|c| c.row as usize == row).count();
        let (now, later) = left.split_at(mine);
        left = later;
        let cells = Cells {
            record: record.bytes,
            spans,
            quote: track.dialect.quote,
            encoding: text.encoding,
            line: record.line,
        };
        let mut edits: Vec<(usize, String)> =
            now.iter().filter_map(|c| Some((c.column, reading.written(c.value?).into_owned()))).collect();
        for (i, column) in columns.iter().enumerate() {
            edits.push((track.columns.len() + i, filled((column.cell)(row, &cells), layout)));
        }
        pen.text(&body[written..record.start])?;
        pen.text(&patched(record.bytes, spans, (layout, false), &edits))?;
        written = record.start + record.bytes.len();
        Ok(true)
    })?;
    pen.text(&body[written..])
}

/// Writes up to the end of the last line before the data that gets new cells; gives how much has been written.
fn head(track: &Track, text: &Text<'_>, layout: Layout, columns: &[NewColumn<'_>], pen: &mut Pen<'_>) -> Result<usize> {
    let names: Vec<String> = columns.iter().map(|c| quoted(&c.name, track, layout)).collect();
    let nothing: Vec<String> = columns.iter().map(|_| filled(String::new(), layout)).collect();
    let [header, units] = [track.dialect.rows.header, track.dialect.rows.units];
    let mut written = 0;
    for (line, cells) in [(header, names), (units, nothing)] {
        let Some((start, length)) = line else { continue };
        let body = text.body();
        let record = &body[start..start + length];
        let mut spans: Vec<Span> = Vec::new();
        split(record, layout, &mut spans);
        let edits: Vec<(usize, String)> =
            cells.into_iter().enumerate().map(|(i, cell)| (track.columns.len() + i, cell)).collect();
        pen.text(&body[written..start])?;
        pen.text(&patched(record, &spans, (layout, false), &edits))?;
        written = start + length;
    }
    Ok(written)
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
        let columns = [NewColumn { name: "raw, x".into(), cell: &copy }, NewColumn { name: "n".into(), cell: &number }];
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
