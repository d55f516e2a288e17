//! The input again, byte for byte, except for the cells that change and the rows that are new.

use std::io::Write;

use super::add_columns::{Beside, NewColumn};
use super::cells::Cells;
use super::number::Reading;
use super::rows::{text_of, unchanged, walk};
use super::style::Style;
use super::text::{Text, decoded, path_of};
use super::tokens::{Layout, Record, Span, inner};
use super::{Delimiter, Encoding, Format, Track};
use crate::error::{Error, Result};

/// What is different in the output.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Changes {
    /// Cells with another value, sorted by row and column.
    pub cells: Vec<CellChange>,
    /// Rows that the input does not have, sorted by the row they follow and by time.
    pub rows: Vec<NewRow>,
}

/// A cell with another value.
#[derive(Debug, Clone, PartialEq)]
pub struct CellChange {
    /// Data row, from 0.
    pub row: u32,
    /// Index in [`Track::columns`].
    pub column: usize,
    /// The value; none (or one that is not finite) for an empty cell.
    pub value: Option<f64>,
}

/// A row that the input does not have.
#[derive(Debug, Clone, PartialEq)]
pub struct NewRow {
    /// The data row that it follows, from 0.
    pub after_row: u32,
    /// Its time in seconds after the origin of the track.
    pub seconds: f64,
    /// Its values by column, sorted. Its other cells are empty.
    pub cells: Vec<(usize, f64)>,
}

/// What is written where an empty cell would be no cell: between blanks, and in a row that would be empty.
pub(super) const NO_VALUE: &str = "NaN";

/// Writes the input of `track` again with `changes`: same columns, rows, order, quotes, padding, line ends, comments,
/// byte order mark and encoding (unpacked, if it is packed). A row too short for a changed cell is filled up to it.
/// A new row looks like the row it follows, with the time in the file's own form.
///
/// # Errors
/// [`Error::Input`] when the source is no longer the one that was loaded; [`Error::Usage`] when a change is for a row
/// that is not there or out of order; [`Error::Io`] when `out` fails.
pub fn rewrite(track: &Track, changes: &Changes, out: &mut dyn Write) -> Result<()> {
    rewrite_as(track, (changes, Form::of(track)), &[], out)
}

/// How the numbers of changed cells are written.
#[derive(Debug, Clone, Copy)]
pub(super) struct Form<'a> {
    /// For each column, how its numbers are written; none where they are written as shortly as they can be.
    styles: &'a [Option<Style>],
    /// True where cells keep their width.
    fixed_width: bool,
}

impl<'a> Form<'a> {
    /// Like the other cells of their columns.
    pub(super) fn of(track: &'a Track) -> Self {
        Self { styles: &track.dialect.styles, fixed_width: track.dialect.fixed_width }
    }

    /// To the last bit.
    pub(super) fn exact() -> Self {
        Self { styles: &[], fixed_width: false }
    }
}

/// The text of the cell that takes the place of `old` in [`rewrite`]: `value` as its column writes numbers.
#[must_use]
pub fn cell_text(track: &Track, column: usize, old: &str, value: Option<f64>) -> String {
    let reading = Reading::new(track.dialect.decimal_comma, &[]);
    number(Form::of(track), &reading, (column, old), value).unwrap_or_default()
}

/// A value as the column writes it, in place of the cell `old`; none for no value.
fn number(form: Form<'_>, reading: &Reading, (column, old): (usize, &str), value: Option<f64>) -> Option<String> {
    let value = value.filter(|v| v.is_finite())?;
    Some(match form.styles.get(column) {
        Some(Some(style)) => style.written(value, old, reading),
        _ => reading.written(value).into_owned(),
    })
}

/// [`rewrite`] with numbers in this form and `columns` added at the right.
pub(super) fn rewrite_as(
    track: &Track,
    (changes, form): (&Changes, Form<'_>),
    columns: &[NewColumn<'_>],
    out: &mut dyn Write,
) -> Result<()> {
    let stored = unchanged(track)?;
    let text = text_of(track, &stored)?;
    let mut pen = Pen { out, encoding: text.encoding, track };
    pen.raw(text.mark())?;
    let records = track.dialect.view.as_ref().map(|viewed| viewed.format);
    if let Some(format) = records.or(track.dialect.rows.closed).filter(|_| !columns.is_empty()) {
        return Err(no_place(format));
    }
    if let Some(view) = &text.view {
        return super::view::rewrite(track, &text, view, changes, &mut pen);
    }
    let mut editor = Editor::of(track, &text, (changes, form), columns);
    let written = editor.run(&text, &mut pen)?;
    editor.between(&text.body()[written..], &mut pen)?;
    let left = editor.cells.first().map(|c| c.row).or(editor.rows.first().map(|r| r.after_row));
    match left {
        None => Ok(()),
        Some(row) => Err(Error::usage(
            format!("row {}: a change to a row that is not there, or out of order", u64::from(row) + 1),
            format!("the record has {} rows; changes are sorted by row and column", track.rows),
        )),
    }
}

/// A file of this format cannot have more columns.
fn no_place(format: &Format) -> Error {
    Error::usage(
        format!("{} has no place for columns beside its own", format.name),
        "have them in a table of their own (--flags writes one), or write the record as CSV first",
    )
}

/// Writes text in the encoding of the file.
pub(super) struct Pen<'a> {
    pub(super) out: &'a mut dyn Write,
    pub(super) encoding: Encoding,
    pub(super) track: &'a Track,
}

impl Pen<'_> {
    pub(super) fn raw(&mut self, bytes: &[u8]) -> Result<()> {
        self.out.write_all(bytes).map_err(Error::io("write the output of", path_of(&self.track.source)))
    }

    pub(super) fn text(&mut self, bytes: &[u8]) -> Result<()> {
        let Encoding::Utf16 { big_endian } = self.encoding else { return self.raw(bytes) };
        let text = String::from_utf8_lossy(bytes);
        let mut buffer = Vec::with_capacity(bytes.len() * 2);
        for unit in text.encode_utf16() {
            buffer.extend(if big_endian { unit.to_be_bytes() } else { unit.to_le_bytes() });
        }
        self.raw(&buffer)
    }
}

/// Walks over the rows with the changes that are still to be made.
struct Editor<'a> {
    track: &'a Track,
    form: Form<'a>,
    /// The columns that are added, where there are any.
    beside: Option<Beside<'a>>,
    layout: Layout,
    encoding: Encoding,
    reading: Reading,
    cells: &'a [CellChange],
    rows: &'a [NewRow],
    /// The time cell with the most decimals so far: `0` and `1` stand in a file of steps of 0.05 too.
    time_sample: String,
    line_end: &'a [u8],
}

impl<'a> Editor<'a> {
    fn of(
        track: &'a Track,
        text: &'a Text<'_>,
        (changes, form): (&'a Changes, Form<'a>),
        columns: &'a [NewColumn<'a>],
    ) -> Self {
        let layout = track.dialect.layout(text.body());
        Self {
            track,
            form,
            beside: (!columns.is_empty()).then(|| Beside { track, body: text.body(), layout, columns }),
            layout,
            encoding: text.encoding,
            reading: Reading::new(track.dialect.decimal_comma, &[]),
            cells: &changes.cells,
            rows: &changes.rows,
            time_sample: String::new(),
            line_end: b"\n",
        }
    }

    /// Writes up to the last change; gives how much of the body has been written.
    fn run(&mut self, text: &'a Text<'_>, pen: &mut Pen<'_>) -> Result<usize> {
        let body = text.body();
        let mut written = 0;
        let every_row = self.beside.is_some();
        if self.cells.is_empty() && self.rows.is_empty() && !every_row {
            return Ok(0);
        }
        if let Some(beside) = &self.beside {
            written = beside.head(pen)?;
        }
        walk(self.track, text, |row, record, splitter| {
            let mine = self.cells.iter().take_while(|c| c.row as usize == row).count();
            if mine > 0 || every_row {
                let (now, later) = self.cells.split_at(mine);
                self.cells = later;
                self.between(&body[written..record.start], pen)?;
                pen.text(&self.changed(row, record, splitter.cells(record), now)?)?;
                written = record.start + record.bytes.len();
            }
            if self.rows.is_empty() {
                return Ok(every_row || !self.cells.is_empty());
            }
            let spans = splitter.cells(record);
            self.note_form(row, record, spans);
            let mine = self.rows.iter().take_while(|r| r.after_row as usize == row).count();
            if mine > 0 {
                let (now, later) = self.rows.split_at(mine);
                self.rows = later;
                let end = record.start + record.bytes.len() + record.end.len();
                pen.text(&body[written..end])?;
                written = end;
                for new in now {
                    let line = self.new_row(record, spans, new);
                    // A last line without a line end stays one.
                    let (before, after) =
                        if record.end.is_empty() { (self.line_end, &b""[..]) } else { (&b""[..], record.end) };
                    pen.text(&[before, &line, after].concat())?;
                }
            }
            Ok(every_row || !(self.cells.is_empty() && self.rows.is_empty()))
        })?;
        Ok(written)
    }

    /// The separator between two rows, or before the first.
    fn between(&self, lines: &[u8], pen: &mut Pen<'_>) -> Result<()> {
        match &self.beside {
            Some(beside) => beside.between(lines, pen),
            None => pen.text(lines),
        }
    }

    /// Remembers how times and line ends look.
    fn note_form(&mut self, row: usize, record: &Record<'a>, spans: &[Span]) {
        if !record.end.is_empty() {
            self.line_end = record.end;
        }
        let usable = self.track.time.seconds.get(row).is_some_and(|s| s.is_finite());
        if let Some(column) = self.track.time.column.filter(|_| usable) {
            let time = self.cell(record, spans, column);
            let precision = |t: &str| (t.matches(':').count(), t.find(['.', ',']).map_or(0, |at| t.len() - at));
            if self.time_sample.is_empty() || precision(&time) > precision(&self.time_sample) {
                self.time_sample = time;
            }
        }
    }

    fn cell(&self, record: &Record<'_>, spans: &[Span], column: usize) -> String {
        let raw = spans.get(column).map_or(&[][..], |s| s.of(record.bytes));
        decoded(&raw[inner(raw, self.layout.quote)], self.encoding).into_owned()
    }

    fn number(&self, column: usize, old: &str, value: Option<f64>) -> Option<String> {
        number(self.form, &self.reading, (column, old), value)
    }

    fn changed(&self, row: usize, record: &Record<'_>, spans: &[Span], changes: &[CellChange]) -> Result<Vec<u8>> {
        let mut edits: Vec<(usize, String)> = Vec::with_capacity(changes.len());
        for change in changes {
            match self.number(change.column, &self.cell(record, spans, change.column), change.value) {
                Some(number) => edits.push((change.column, number)),
                None if change.column < spans.len() => edits.push((change.column, self.nothing())),
                // The cell of a short row has no value as it is.
                None => {}
            }
        }
        let keeps = |c: usize| !edits.iter().any(|(column, text)| *column == c && text.is_empty());
        let edited = edits.iter().any(|(_, text)| !text.is_empty());
        let emptied = !edited && (0..spans.len()).all(|c| !keeps(c) || self.cell(record, spans, c).is_empty());
        if emptied && let Some((_, text)) = edits.first_mut() {
            NO_VALUE.clone_into(text);
        }
        if let Some(beside) = &self.beside {
            let cells = Cells {
                record: record.bytes,
                spans,
                quote: self.track.dialect.quote,
                encoding: self.encoding,
                line: record.line,
            };
            edits.extend(beside.cells(row, &cells)?);
        }
        Ok(patched(record.bytes, spans, (self.layout, self.form.fixed_width), &edits))
    }

    fn nothing(&self) -> String {
        if self.layout.delimiter == Delimiter::Blanks { NO_VALUE.into() } else { String::new() }
    }

    /// A row in the form of `record`.
    fn new_row(&self, record: &Record<'_>, spans: &[Span], new: &NewRow) -> Vec<u8> {
        let mut edits = self.new_cells(record, spans, new);
        edits.extend(self.beside.iter().flat_map(|beside| beside.new_row(new)));
        patched(record.bytes, spans, (self.layout, self.form.fixed_width), &edits)
    }

    /// The texts of the cells of a row in the form of `record`.
    fn new_cells(&self, record: &Record<'_>, spans: &[Span], new: &NewRow) -> Vec<(usize, String)> {
        let time = &self.track.time;
        let mut width = spans.len().max(new.cells.last().map_or(0, |(c, _)| c + 1));
        if self.beside.is_some() {
            width = width.min(self.track.columns.len());
        }
        let local = new.seconds + time.row_offset(|column| self.cell(record, spans, column));
        let text = |column: usize| {
            if let Some(place) = time.part_columns.iter().position(|c| *c == column) {
                return time.write_part(local, place, &self.cell(record, spans, column));
            }
            if time.column == Some(column) {
                return time.write_like(new.seconds, &self.time_sample);
            }
            if time.date_column == Some(column) {
                return time.write_like(new.seconds, &self.cell(record, spans, column));
            }
            if self.track.track_column() == Some(column) {
                return self.cell(record, spans, column);
            }
            let value = new.cells.iter().find(|(c, _)| *c == column).map(|(_, v)| *v);
            self.number(column, "", value).unwrap_or_else(|| self.nothing())
        };
        (0..width).map(|c| (c, text(c))).collect()
    }
}

/// The texts of the cells of rows that the input does not have, as [`rewrite`] writes them.
///
/// # Errors
/// As [`rewrite`].
pub(super) fn new_row_cells(track: &Track, rows: &[NewRow]) -> Result<Vec<Vec<String>>> {
    if rows.is_empty() {
        return Ok(Vec::new());
    }
    let stored = unchanged(track)?;
    let text = text_of(track, &stored)?;
    let changes = Changes { cells: Vec::new(), rows: rows.to_vec() };
    let mut editor = Editor::of(track, &text, (&changes, Form::of(track)), &[]);
    let mut all = Vec::with_capacity(rows.len());
    walk(track, &text, |row, record, splitter| {
        let spans = splitter.cells(record);
        editor.note_form(row, record, spans);
        let mine = editor.rows.iter().take_while(|r| r.after_row as usize == row).count();
        let (now, later) = editor.rows.split_at(mine);
        editor.rows = later;
        all.extend(
            now.iter()
                .map(|new| editor.new_cells(record, spans, new).into_iter().map(|(_, text)| text).collect::<Vec<_>>()),
        );
        Ok(!editor.rows.is_empty())
    })?;
    Ok(all)
}

/// `record` with the text of some cells replaced; quotes stay, and so does the width of cells padded with blanks (of all
/// cells, where the table has a `fixed_width`).
pub(super) fn patched(
    record: &[u8],
    spans: &[Span],
    (layout, fixed_width): (Layout, bool),
    edits: &[(usize, String)],
) -> Vec<u8> {
    let mut line = Vec::with_capacity(record.len() + 16 * edits.len());
    let mut done = 0;
    let mut count = spans.len();
    for (column, text) in edits {
        let Some(span) = spans.get(*column) else {
            line.extend_from_slice(&record[done..]);
            done = record.len();
            while count <= *column {
                match layout.delimiter {
                    Delimiter::Byte(delimiter) => line.push(delimiter),
                    Delimiter::Blanks => line.push(b' '),
                }
                if layout.delimiter == Delimiter::Blanks && count < *column {
                    line.extend_from_slice(NO_VALUE.as_bytes());
                }
                count += 1;
            }
            put(&mut line, text, layout, true);
            continue;
        };
        let within = inner(span.of(record), layout.quote);
        let (start, end) = (span.start as usize + within.start, span.start as usize + within.end);
        let at = line.len() + span.start as usize - done;
        line.extend_from_slice(&record[done..start]);
        align(&mut line, end - start, text.len(), fixed_width);
        let bare = span.of(record).trim_ascii().len() == end - start;
        // A quote is one at the start of a cell or after blanks, not after a stray carriage return.
        let padding = &span.of(record)[..within.start];
        if bare && padding.iter().any(|b| !matches!(b, b' ' | b'\t')) && wants_quotes(text, layout).is_some() {
            line.truncate(at);
        }
        put(&mut line, text, layout, bare);
        done = end;
        // What did not fit before the cell is taken from the blanks after it.
        let longer = (line.len() + spans_start(record, done)).saturating_sub(record.len());
        let room = record[done..].iter().take_while(|b| **b == b' ').count().saturating_sub(1);
        if fixed_width && longer > 0 {
            done += longer.min(room);
        }
    }
    line.extend_from_slice(&record[done..]);
    line
}

/// Bytes of the record that are still to be written.
fn spans_start(record: &[u8], done: usize) -> usize {
    record.len() - done
}

/// Adds the text of a cell: in quotes where it has none yet and a decimal comma would part it.
fn put(line: &mut Vec<u8>, text: &str, layout: Layout, bare: bool) {
    match wants_quotes(text, layout).filter(|_| bare) {
        Some(quote) => line.extend([&[quote], text.as_bytes(), &[quote]].concat()),
        None => line.extend_from_slice(text.as_bytes()),
    }
}

/// The quote that a text needs to be one cell, and does not have.
fn wants_quotes(text: &str, layout: Layout) -> Option<u8> {
    let Delimiter::Byte(delimiter) = layout.delimiter else { return None };
    let text = text.as_bytes();
    layout.quote.filter(|quote| text.contains(&delimiter) && text.first() != Some(quote))
}

/// Keeps cells aligned to the right: takes or adds blanks before one whose length changes, where two or more are.
fn align(line: &mut Vec<u8>, old: usize, new: usize, fixed_width: bool) {
    let blanks = line.iter().rev().take_while(|b| **b == b' ').count();
    if blanks < 2 && !(fixed_width && new <= old) {
        return;
    }
    let wanted = (blanks + old).saturating_sub(new).max(1);
    line.resize(line.len() - blanks, b' ');
    line.resize(line.len() + wanted, b' ');
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use super::super::{LoadOptions, Source, load};
    use super::*;

    fn track(text: &[u8]) -> Track {
        let source = Source::BuiltIn { name: "wildpoint:test", bytes: Arc::from(text) };
        load(&source, &LoadOptions::default()).unwrap()
    }

    fn rewritten(text: &str, cells: &[(u32, usize, Option<f64>)], rows: &[(u32, f64, usize, f64)]) -> String {
        let cells = cells.iter().map(|&(row, column, value)| CellChange { row, column, value }).collect();
        let rows = rows.iter().map(|&(after_row, seconds, c, v)| NewRow { after_row, seconds, cells: vec![(c, v)] });
        let mut out = Vec::new();
        rewrite(&track(text.as_bytes()), &Changes { cells, rows: rows.collect() }, &mut out).unwrap();
        String::from_utf8(out).unwrap()
    }

    #[test]
    fn only_the_changed_cells_change() {
        let text = "# c\ntime,x,who\r\n0, 1.50 ,\"a,b\"\n# between\n1,\"2.5\",c\n2,7,d";
        let changes = [(0, 1, Some(1.25)), (1, 1, Some(3.0)), (2, 1, None)];
        let expected = "# c\ntime,x,who\r\n0, 1.25 ,\"a,b\"\n# between\n1,\"3.00\",c\n2,,d";
        assert_eq!(rewritten(text, &changes, &[]), expected);
        assert_eq!(rewritten(text, &[(1, 1, None)], &[]), text.replace("\"2.5\"", "\"\""));
    }

    #[test]
    fn decimal_commas_and_widths_are_kept() {
        assert_eq!(rewritten("t;x\n0;1,5\n1;2,5\n", &[(1, 1, Some(-0.5))], &[]), "t;x\n0;1,5\n1;-0,5\n");
        let wide = "time x y\n 0.0   1.5  7\n 1.0  22.5  8\n";
        let expected = "time x y\n 0.0 -11.5  7\n 1.0   NaN  8\n";
        assert_eq!(rewritten(wide, &[(0, 1, Some(-11.5)), (1, 1, None)], &[]), expected);
    }

    #[test]
    fn a_row_never_becomes_one_that_is_no_row() {
        assert_eq!(rewritten("x\n1\n2\n3\n", &[(1, 0, None)], &[]), "x\n1\nNaN\n3\n");
        assert_eq!(rewritten("x,y\n1,2\n2,\n", &[(1, 0, None)], &[]), "x,y\n1,2\nNaN,\n");
        assert_eq!(rewritten("x,y\n1,2\n2,3\n", &[(1, 0, None), (1, 1, None)], &[]), "x,y\n1,2\nNaN,\n");
    }

    #[test]
    fn a_short_row_is_filled_up_to_the_cell() {
        let text = "time,x,y\n0,1,2\n1\n2,3,4\n";
        assert_eq!(rewritten(text, &[(1, 2, Some(4.0))], &[]), "time,x,y\n0,1,2\n1,,4\n2,3,4\n");
        assert_eq!(rewritten(text, &[(1, 2, None)], &[]), text);
        let blanks = "time x y\n0 1 2\n1\n2 3 4\n";
        assert_eq!(rewritten(blanks, &[(1, 2, Some(4.0))], &[]), "time x y\n0 1 2\n1 NaN 4\n2 3 4\n");
    }

    #[test]
    fn new_rows_look_like_the_rows_before_them() {
        let text = "time,x,who\n0,1,a\r\n0.05,2,b\r\n0.15,3,c";
        let new = [(1, 0.1, 1, 7.0), (2, 0.2, 1, 8.0)];
        let expected = "time,x,who\n0,1,a\r\n0.05,2,b\r\n0.10,7,\r\n0.15,3,c\r\n0.20,8,";
        assert_eq!(rewritten(text, &[], &new), expected);
        let text = "'when', x\n'2019-01-01 00:00', 1\n'2019-01-01 00:30', 3\n";
        let new = [(0, 900.0, 1, 2.0)];
        let expected = "'when', x\n'2019-01-01 00:00', 1\n'2019-01-01 00:15', 2\n'2019-01-01 00:30', 3\n";
        assert_eq!(rewritten(text, &[], &new), expected);
        let text = "Date;Time;x\n23.03.2005;23:00;1,5\n24.03.2005;01:00;2,5\n";
        let new = [(0, 3600.0, 2, 2.0)];
        let expected = "Date;Time;x\n23.03.2005;23:00;1,5\n24.03.2005;00:00;2,0\n24.03.2005;01:00;2,5\n";
        assert_eq!(rewritten(text, &[], &new), expected);
    }

    #[test]
    fn encodings_are_kept() {
        let utf16 = |text: &str| -> Vec<u8> {
            let bom = [0xfe, 0xff];
            bom.into_iter().chain(text.encode_utf16().flat_map(u16::to_be_bytes)).collect()
        };
        let cells = vec![CellChange { row: 0, column: 1, value: Some(5.0) }];
        let changes = Changes { cells, rows: Vec::new() };
        let mut out = Vec::new();
        rewrite(&track(&utf16("t,x°\n0,9\n1,2\n")), &changes, &mut out).unwrap();
        assert_eq!(out, utf16("t,x°\n0,5\n1,2\n"));
        out.clear();
        rewrite(&track(b"t,x\xb0\n0,9\n1,2\n"), &changes, &mut out).unwrap();
        assert_eq!(out, b"t,x\xb0\n0,5\n1,2\n");
    }

    #[test]
    fn a_decimal_comma_between_commas_is_quoted() {
        let source = Source::BuiltIn { name: "wildpoint:test", bytes: Arc::from(&b"t,x\n0,\"1,5\"\n1,2\n2\n"[..]) };
        let track = load(&source, &LoadOptions { decimal_comma: Some(true), ..LoadOptions::default() }).unwrap();
        let cell = |row| CellChange { row, column: 1, value: Some(2.5) };
        let mut out = Vec::new();
        rewrite(&track, &Changes { cells: vec![cell(0), cell(1), cell(2)], rows: Vec::new() }, &mut out).unwrap();
        assert_eq!(String::from_utf8(out).unwrap(), "t,x\n0,\"2,5\"\n1,\"2,5\"\n2,\"2,5\"\n");
    }

    #[test]
    fn unusable_times_are_no_pattern_for_new_ones() {
        let text = "time,x\n0,1\nnoon-0.123:4:5,2\n2,3\n";
        assert_eq!(rewritten(text, &[], &[(2, 3.0, 1, 4.0)]), format!("{text}3,4\n"));
    }

    #[test]
    fn changes_that_cannot_be_made_are_told() {
        let cells = vec![CellChange { row: 2, column: 1, value: None }];
        let e = rewrite(&track(b"t,x\n0,9\n1,2\n"), &Changes { cells, rows: Vec::new() }, &mut Vec::new()).unwrap_err();
        assert!(e.to_string().starts_with("row 3: a change to a row that is not there"), "{e}");
    }
}
