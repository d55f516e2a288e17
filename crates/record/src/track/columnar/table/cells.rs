//! The cells of a text, as values.

use super::super::super::axis::seconds_of;
use super::super::super::number::{Cell, Reading};
use super::super::super::timing::{Moment, Timing};
use super::super::super::tokens::inner;
use super::super::super::{Cells, NewRow, Track};
use super::form::{ColumnForm, Stored};
use super::out::Out;

/// Reads the cells of the record.
pub(super) struct CellReader<'a> {
    track: &'a Track,
    forms: &'a [ColumnForm],
    pub(super) reading: Reading,
    timing: Timing,
    /// For each column that was loaded, its number in each row.
    numbers: Vec<Option<Vec<f64>>>,
}

impl<'a> CellReader<'a> {
    pub(super) fn of(track: &'a Track, forms: &'a [ColumnForm]) -> Self {
        let time = &track.time;
        let timing = Timing {
            columns: time.part_columns.clone(),
            zone: time.zone.clone(),
            ..Timing::of(time.column.unwrap_or_default(), time.date_column, time.format.clone())
        };
        let mut numbers = vec![None; forms.len()];
        for channel in &track.channels {
            let column = numbers[channel.column].get_or_insert_with(|| vec![f64::NAN; track.rows]);
            match &channel.target {
                None => column.copy_from_slice(&channel.values),
                Some(target) => target.rows.iter().zip(&channel.values).for_each(|(row, v)| column[*row as usize] = *v),
            }
        }
        Self {
            track,
            forms,
            reading: Reading::new(track.dialect.decimal_comma, &track.dialect.missing),
            timing,
            numbers,
        }
    }

    pub(super) fn value(&self, place: usize, row: usize, cells: &Cells<'_>) -> Stored {
        let text = cells.text(place);
        match self.forms[place] {
            ColumnForm::Timestamp { nanos, .. } => match self.moment(row, cells) {
                Some(ns) if nanos => Stored::Whole(ns),
                Some(ns) => Stored::Whole(rounded_micros(ns)),
                None => Stored::Nothing,
            },
            ColumnForm::Time => match self.reading.cell(text.trim().as_bytes()) {
                Cell::Number(number) => Stored::Double(number),
                _ => self.moment(row, cells).map_or(Stored::Nothing, |ns| Stored::Double(seconds_of(ns.into()))),
            },
            ColumnForm::Double => match &self.numbers[place] {
                Some(numbers) if numbers[row].is_finite() => Stored::Double(numbers[row]),
                // A row of another track than those that were loaded.
                _ => ColumnForm::Double.value(&text, &self.reading),
            },
            form => form.value(&text, &self.reading),
        }
    }

    /// The time of a row in nanoseconds: what the record takes it for, or else what its cells say.
    fn moment(&self, row: usize, cells: &Cells<'_>) -> Option<i64> {
        const MILLISECOND: i64 = 1_000_000;
        let time = &self.track.time;
        let taken = time.seconds.get(row).and_then(|s| time.nanoseconds(*s));
        let text = |column: usize| trimmed(cells, column);
        let said = match self.timing.read(text, self.track.dialect.decimal_comma) {
            Some(Moment::Exact(ns)) => Some(ns),
            _ => None,
        };
        match (said, taken) {
            // The cell tells more digits than a number of seconds.
            (Some(said), Some(taken)) if said.abs_diff(taken) < MILLISECOND.unsigned_abs() => Some(said),
            (said, taken) => taken.or(said),
        }
    }

    /// A row that the record does not have.
    pub(super) fn new_row(&self, new: &NewRow, texts: &[String], out: &mut Out<'_>) {
        for (place, form) in self.forms.iter().enumerate() {
            let text = texts.get(place).map_or("", String::as_str);
            let ns = || self.track.time.nanoseconds(new.seconds);
            let value = match form {
                ColumnForm::Timestamp { nanos: true, .. } => ns().map_or(Stored::Nothing, Stored::Whole),
                ColumnForm::Timestamp { nanos: false, .. } => {
                    ns().map_or(Stored::Nothing, |ns| Stored::Whole(rounded_micros(ns)))
                }
                ColumnForm::Time => match self.reading.cell(text.trim().as_bytes()) {
                    Cell::Number(number) => Stored::Double(number),
                    _ => ns().map_or(Stored::Nothing, |ns| Stored::Double(seconds_of(ns.into()))),
                },
                form => form.value(text, &self.reading),
            };
            out.columns[place].push(value);
        }
    }
}

/// The bytes of a cell without padding and quotes.
fn trimmed<'a>(cells: &Cells<'a>, column: usize) -> &'a [u8] {
    let raw = cells.raw(column);
    &raw[inner(raw, cells.quote)]
}

fn rounded_micros(ns: i64) -> i64 {
    ns.saturating_add(500).div_euclid(1000)
}
