//! A table of arrays as CSV text: a line of names, and a line for each row. A value that is missing is an empty cell.

use std::collections::BTreeMap;
use std::collections::btree_map::Entry;
use std::io::{self, Read};

use super::super::columnar::{is_comment, name_cell};
use super::super::facts::Facts;
use super::super::packing::{Opened, Stream};
use super::super::printable;
use super::array::{Bytes, Store};
use super::cells;
use super::cf_time::Stamp;
use super::columns::{Column, Meaning};
use super::errors::Trouble;
use super::matlab::are_datenums;
use super::scalar::Scalar;
use super::tables::Chosen;
use crate::memory::Share;

/// Rows that are made into text at a time.
const BATCH: u64 = 1024;

/// The text of a table; the stream of the bytes of the file is passed over as far as rows have been given.
pub(super) fn text<'a>(
    (store, mut share): (Store, Share),
    chosen: Chosen,
    (packed, length): (Stream<'a>, u64),
) -> Result<Opened<'a>, Trouble> {
    let Chosen { table, mut said } = chosen;
    let mut columns = table.columns;
    let mut stored = BTreeMap::new();
    for column in &columns {
        if let Entry::Vacant(place) = stored.entry(column.place) {
            share.add(store.bytes.length(column.place)?)?;
            place.insert(store.bytes.read(column.place)?);
        }
    }
    for column in &mut columns {
        let stored = stored.get(&column.place).map_or(&[][..], Vec::as_slice);
        if store.is_matlab && column.is_plain_double() && are_datenums(&column.name, numbers(column, stored)) {
            said.push(format!("`{}`: days as Matlab counts them (datenum)", printable(&column.name)));
            column.meaning = Meaning::Moment { stamp: Stamp::datenum(), digits: 9 };
        }
        settle_digits(column, stored);
    }
    let goes_forward = |name: &&String| {
        let column = columns.iter().find(|column| column.name == **name);
        column.is_some_and(|column| goes_forward(column, stored.get(&column.place).map_or(&[][..], Vec::as_slice)))
    };
    let time = table.time.or_else(|| table.called_times.iter().find(goes_forward).cloned());
    columns.sort_by_key(|column| Some(&column.name) != time.as_ref());
    let facts = Facts { columns: columns.iter().map(Column::facts).collect(), time, said };
    let names: Vec<String> = columns.iter().map(|column| name_cell(&column.name)).collect();
    let text = Text {
        out: (names.join(",") + "\n").into_bytes(),
        given: 0,
        columns,
        stored,
        rows: table.rows,
        row: 0,
        file: store.bytes,
        packing: store.packing,
        packed,
        passed: 0,
        length,
        _share: share,
    };
    Ok(Opened { text: Box::new(text), facts: Some(facts.into()) })
}

/// Finds out how many decimals the moments of a column have.
fn settle_digits(column: &mut Column, stored: &[u8]) {
    if let Meaning::Moment { stamp, .. } = column.meaning {
        let digits = stamp.digits(numbers(column, stored));
        column.meaning = Meaning::Moment { stamp, digits };
    }
}

/// True where nine of ten numbers are larger than the one before, and for texts: their cells show what they are.
fn goes_forward(column: &Column, stored: &[u8]) -> bool {
    if !column.kind.is_number() {
        return true;
    }
    let (mut forward, mut steps) = (0_u64, 0_u64);
    let mut before = f64::NAN;
    for number in numbers(column, stored).map(Scalar::as_f64) {
        forward += u64::from(number > before);
        steps += 1;
        before = number;
    }
    steps > 1 && forward * 10 >= (steps - 1) * 9
}

/// The numbers of a column that are there.
fn numbers<'s>(column: &'s Column, stored: &'s [u8]) -> impl Iterator<Item = Scalar> + 's {
    let rows = (0..column.rows).take_while(move |row| column.bytes(stored, *row).is_some());
    rows.filter_map(move |row| column.number(stored, row))
}

/// The text of a table, as it is read.
struct Text<'a> {
    columns: Vec<Column>,
    /// The bytes of arrays, by their places.
    stored: BTreeMap<usize, Vec<u8>>,
    rows: u64,
    /// Rows that have been made into text.
    row: u64,
    /// Text, of which so much has been given.
    out: Vec<u8>,
    given: usize,
    file: Box<dyn Bytes>,
    packing: &'static str,
    packed: Stream<'a>,
    passed: u64,
    length: u64,
    _share: Share,
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
    /// Makes text of the next rows; false where there are none.
    fn fill(&mut self) -> io::Result<bool> {
        if self.row == self.rows {
            self.pass(self.length)?;
            return Ok(false);
        }
        self.out.clear();
        self.given = 0;
        let end = self.rows.min(self.row + BATCH);
        for row in self.row..end {
            self.write(row).map_err(|e| e.of_stream(self.packing))?;
        }
        self.row = end;
        let reached = u128::from(self.length) * u128::from(self.row) / u128::from(self.rows.max(1));
        self.pass(u64::try_from(reached).unwrap_or(0))?;
        Ok(true)
    }

    fn write(&mut self, row: u64) -> Result<(), Trouble> {
        let from = self.out.len();
        let width = self.columns.len();
        for (at, column) in self.columns.iter().enumerate() {
            let start = self.out.len();
            let stored = self.stored.get(&column.place).map_or(&[][..], Vec::as_slice);
            cells::write(column, stored, row, self.file.as_ref(), &mut self.out)?;
            if at == 0 && is_comment(&self.out[start..]) {
                self.out.insert(start, b'"');
                self.out.push(b'"');
            }
            self.out.push(if at + 1 == width { b'\n' } else { b',' });
        }
        if self.out.len() - from == width {
            // A row without any value stays one.
            self.out.splice(from..from, *b"NaN");
        }
        Ok(())
    }

    /// Passes over the bytes of the file up to here: who counts them knows how much of it has been read.
    fn pass(&mut self, to: u64) -> io::Result<()> {
        let more = to.saturating_sub(self.passed);
        self.passed += io::copy(&mut (&mut self.packed).take(more), &mut io::sink())?;
        Ok(())
    }
}
