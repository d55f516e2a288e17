//! A Parquet file as CSV text: a line of names, and a line for each row. A null is an empty cell.

use std::io::{self, Read};

use parquet::column::reader::{ColumnReader, ColumnReaderImpl};
use parquet::data_type::DataType;

use super::super::packing::{Look, Opened, Stream, Unpackable};
use super::super::view::Want;
use super::access::FileBytes;
use super::errors::{broken, damaged};
use super::kind::Kind;
use super::pages::{column_reader, guarded};
use super::schema::{Flat, Schema};
use super::settle::facts;
use super::thrift::largest_page;
use super::value::Stored;
use crate::memory::{Full, Share};

/// Rows that are made into text at a time.
const BATCH: usize = 1024;

/// True for the first bytes of a Parquet file: no text has the bytes that follow on its mark.
pub(crate) fn known(start: &[u8]) -> bool {
    const LOOKED_AT: usize = 16;
    let binary = |b: &u8| *b < b' ' && !matches!(b, b'\t' | b'\n' | b'\r');
    let marked = start.starts_with(b"PAR1") || start.starts_with(b"PARE");
    marked && start[..start.len().min(LOOKED_AT)].iter().any(binary)
}

/// The text of a file; `packed`, the stream of its bytes, is passed over as far as rows have been given.
pub(crate) fn unpack<'a>(file: Box<dyn Look + 'a>, packed: Stream<'a>, _: Want) -> Result<Opened<'a>, Unpackable> {
    let file = FileBytes::of(file).map_err(|e| damaged(&e.to_string()))?;
    let schema = Schema::of(&file)?;
    let facts = Some(facts(&schema).into());
    let mut text = Text {
        out: Vec::new(),
        given: 0,
        group: 0,
        columns: Vec::new(),
        left: 0,
        rows: 0,
        packed,
        passed: 0,
        share: Share::default(),
        file,
        schema,
    };
    text.names();
    Ok(Opened { text: Box::new(text), facts })
}

/// The text of a file, as it is read.
struct Text<'a> {
    file: FileBytes<'a>,
    schema: Schema,
    /// The row group that comes next.
    group: usize,
    /// The columns of the row group that is being read.
    columns: Vec<Column>,
    /// Rows of it that are left.
    left: usize,
    /// Rows that have been made into text.
    rows: u64,
    /// Text, of which so much has been given.
    out: Vec<u8>,
    given: usize,
    packed: Stream<'a>,
    passed: u64,
    /// The chunks that are being read.
    share: Share,
}

impl Read for Text<'_> {
    fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
        while self.given == self.out.len() && self.fill()? {}
        let n = (&self.out[self.given..]).read(buffer)?;
        self.given += n;
        Ok(n)
    }
}

impl Text<'_> {
    /// The line of names.
    fn names(&mut self) {
        for (i, flat) in self.schema.flat.iter().enumerate() {
            if i > 0 {
                self.out.push(b',');
            }
            self.out.extend_from_slice(name_cell(&flat.name).as_bytes());
        }
        self.out.push(b'\n');
    }

    /// Makes text of the next rows; false where there are none.
    fn fill(&mut self) -> io::Result<bool> {
        if self.left == 0 {
            if self.group == self.schema.metadata.num_row_groups() {
                self.pass(self.file.length())?;
                return Ok(false);
            }
            self.open()?;
            return Ok(true);
        }
        let rows = self.left.min(BATCH);
        guarded(|| self.columns.iter_mut().try_for_each(|column| column.take(rows))).map_err(failed)?;
        self.out.clear();
        self.given = 0;
        for row in 0..rows {
            let from = self.out.len();
            let width = self.columns.len();
            for (i, column) in self.columns.iter().enumerate() {
                let cell = column.cell(row);
                if i == 0 && is_comment(cell) {
                    self.out.push(b'"');
                    self.out.extend_from_slice(cell);
                    self.out.push(b'"');
                } else {
                    self.out.extend_from_slice(cell);
                }
                self.out.push(if i + 1 == width { b'\n' } else { b',' });
            }
            if self.out.len() - from == width {
                // A row of nothing but nulls stays one.
                self.out.splice(from..from, *b"NaN");
            }
        }
        self.left -= rows;
        self.rows += rows as u64;
        let length = u128::from(self.file.length());
        let reached = length * u128::from(self.rows) / u128::from(self.schema.rows().max(1));
        self.pass(u64::try_from(reached).unwrap_or(0))?;
        Ok(true)
    }

    /// Begins the next row group.
    fn open(&mut self) -> io::Result<()> {
        self.columns.clear();
        let group = self.schema.metadata.row_group(self.group);
        let rows = usize::try_from(group.num_rows()).map_err(|_| failed_with("too many rows"))?;
        let bytes: u64 =
            self.schema.flat.iter().map(|flat| group.column(flat.leaf).compressed_size().unsigned_abs()).sum();
        self.share.set(bytes).map_err(full)?;
        if rows > 0 {
            let chunk = |flat: &Flat| self.schema.chunk(&self.file, self.group, flat.leaf);
            let chunks = self.schema.flat.iter().map(chunk).collect::<Result<Vec<_>, _>>();
            let chunks = chunks.map_err(|e| failed_with(&e.what))?;
            // A page of each column is unpacked at a time, whatever its size.
            let pages: u64 = chunks.iter().map(|chunk| largest_page(&chunk.bytes)).fold(0, u64::saturating_add);
            self.share.set(bytes.saturating_add(pages)).map_err(full)?;
            for (flat, chunk) in self.schema.flat.iter().zip(chunks) {
                let reader = guarded(|| column_reader(chunk, group.column(flat.leaf), rows)).map_err(failed)?;
                let nullable = group.column(flat.leaf).column_descr().max_def_level();
                self.columns.push(Column {
                    reader,
                    kind: flat.kind,
                    levels: nullable,
                    text: Vec::new(),
                    ends: Vec::new(),
                });
            }
        }
        self.left = rows;
        self.group += 1;
        Ok(())
    }

    /// Passes over the bytes of the file up to here: who counts them knows how much of it has been read.
    fn pass(&mut self, to: u64) -> io::Result<()> {
        let more = to.saturating_sub(self.passed);
        self.passed += io::copy(&mut (&mut self.packed).take(more), &mut io::sink())?;
        Ok(())
    }
}

/// The name of a column as a cell of the first line.
pub(crate) fn name_cell(name: &str) -> String {
    let shown = name.trim_start_matches('\u{feff}').chars().map(|c| if c.is_control() { ' ' } else { c });
    let name: String = shown.collect();
    let plain = name.trim() == name && !name.contains([',', '"', '\'']) && !is_comment(name.as_bytes());
    if plain { name } else { format!("\"{}\"", name.replace('"', "\"\"")) }
}

/// True for a cell that would make its line a comment.
pub(crate) fn is_comment(cell: &[u8]) -> bool {
    let text = cell.trim_ascii_start();
    text.starts_with(b"#") || text.starts_with(b"%") || text.starts_with(b"//")
}

fn failed(e: parquet::errors::ParquetError) -> io::Error {
    failed_with(&broken(&e).what)
}

fn failed_with(what: &str) -> io::Error {
    io::Error::other(what.to_owned())
}

fn full(full: Full) -> io::Error {
    io::Error::new(io::ErrorKind::OutOfMemory, format!("it needs more than {} bytes of memory", full.limit))
}

/// A column of a row group, with the cells of the rows that were taken last.
struct Column {
    reader: ColumnReader,
    kind: Kind,
    /// The level of a value that is there.
    levels: i16,
    text: Vec<u8>,
    /// Where each cell ends.
    ends: Vec<usize>,
}

impl Column {
    fn cell(&self, row: usize) -> &[u8] {
        let start = row.checked_sub(1).map_or(0, |before| self.ends[before]);
        &self.text[start..self.ends[row]]
    }

    /// Takes the next rows.
    fn take(&mut self, rows: usize) -> parquet::errors::Result<()> {
        self.text.clear();
        self.ends.clear();
        let Self { kind, levels, text, ends, .. } = self;
        let mut cells = Cells { kind: *kind, levels: *levels, rows, text, ends };
        match &mut self.reader {
            ColumnReader::BoolColumnReader(r) => cells.take(r),
            ColumnReader::Int32ColumnReader(r) => cells.take(r),
            ColumnReader::Int64ColumnReader(r) => cells.take(r),
            ColumnReader::Int96ColumnReader(r) => cells.take(r),
            ColumnReader::FloatColumnReader(r) => cells.take(r),
            ColumnReader::DoubleColumnReader(r) => cells.take(r),
            ColumnReader::ByteArrayColumnReader(r) => cells.take(r),
            ColumnReader::FixedLenByteArrayColumnReader(r) => cells.take(r),
        }
    }
}

/// The cells of a column, as they are made.
struct Cells<'a> {
    kind: Kind,
    levels: i16,
    rows: usize,
    text: &'a mut Vec<u8>,
    ends: &'a mut Vec<usize>,
}

impl Cells<'_> {
    fn take<T: DataType>(&mut self, reader: &mut ColumnReaderImpl<T>) -> parquet::errors::Result<()>
    where
        T::T: Stored,
    {
        let (mut values, mut levels) = (Vec::with_capacity(self.rows), Vec::with_capacity(self.rows));
        let mut rows = 0;
        while rows < self.rows {
            let wanted = Some(&mut levels).filter(|_| self.levels > 0);
            let (read, _, _) = reader.read_records(self.rows - rows, wanted, None, &mut values)?;
            if read == 0 {
                return Err(parquet::errors::ParquetError::EOF("a column has fewer rows than its group".into()));
            }
            rows += read;
        }
        let mut values = values.iter();
        for row in 0..self.rows {
            let there = self.levels == 0 || levels.get(row) == Some(&self.levels);
            if there && let Some(value) = values.next() {
                self.kind.write(&value.value(), self.text);
            }
            self.ends.push(self.text.len());
        }
        Ok(())
    }
}
