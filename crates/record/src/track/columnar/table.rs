//! A record of text as a Parquet file.

use std::sync::Arc;

use parquet::basic::{Compression, LogicalType, Repetition, TimeUnit, Type as Physical};
use parquet::data_type::{ByteArrayType, DataType, DoubleType, Int64Type};
use parquet::errors::Result as ParquetResult;
use parquet::file::metadata::KeyValue;
use parquet::file::properties::WriterProperties;
use parquet::file::writer::{SerializedFileWriter, SerializedRowGroupWriter};
use parquet::schema::types::{SchemaDescriptor, Type, TypePtr};

use super::super::axis::seconds_of;
use super::super::number::{Cell, Reading};
use super::super::rewrite::{cell_text, new_row_cells};
use super::super::text::path_of;
use super::super::timing::{Moment, Timing};
use super::super::{Cells, Changes, Column, ColumnKind, NewRow, Track, for_each_row};
use super::encode::{Encoded, Form, encode};
use super::errors::{broken, of_file};
use super::flags::{encoded, field};
use super::recode::Levelled;
use super::write::Flags;
use crate::error::{Error, Result};
use crate::memory::Share;

/// Rows of a group.
const GROUP: usize = 1 << 17;
/// The usual way to pack: quick, and read by everything.
const COMPRESSION: Compression = Compression::SNAPPY;
const WRITER: &str = concat!("wildpoint version ", env!("CARGO_PKG_VERSION"));

/// The record of `track` with `changes` and columns of flags.
///
/// # Errors
/// When the source can no longer be read, or is no longer the one that was loaded; [`Error::Memory`].
pub(super) fn table(track: &Track, changes: &Changes, flags: Option<&Flags>) -> Result<Vec<u8>> {
    let path = path_of(&track.source);
    // The text of a group, and the file.
    let _share = Share::of(2 * track.bytes).map_err(Error::memory(&path))?;
    // Records of several lines have no place for a new row.
    let new_rows = if track.dialect.view.is_some() { &[][..] } else { changes.rows.as_slice() };
    let forms = forms(track)?;
    let new_cells = new_row_cells(track, new_rows)?;
    let of_path = of_file(&path);
    let mut out = Out::of(track, &forms, flags).map_err(|e| of_path(broken(&e)))?;
    let reader = CellReader::of(track, &forms);
    let (mut cells, mut next_new) = (changes.cells.as_slice(), 0);
    for_each_row(track, |row, texts| {
        let mine = cells.iter().take_while(|c| c.row as usize == row).count();
        let (now, later) = cells.split_at(mine);
        cells = later;
        for (place, form) in forms.iter().enumerate() {
            let change = now.iter().find(|c| c.column == place);
            let value = match change {
                Some(change) => {
                    let text = change.value.map(|v| cell_text(track, place, &texts.text(place), Some(v)));
                    text.map_or(Stored::Nothing, |text| form.value(&text, &reader.reading))
                }
                None => reader.value(place, row, texts),
            };
            out.columns[place].push(value);
        }
        out.end_row(|flags| flags.of_row(row));
        while new_rows.get(next_new).is_some_and(|new| new.after_row as usize == row) {
            reader.new_row(&new_rows[next_new], &new_cells[next_new], &mut out);
            out.end_row(|flags| flags.of_new(next_new));
            next_new += 1;
        }
        if out.rows >= GROUP { out.end_group().map_err(|e| of_path(broken(&e))) } else { Ok(()) }
    })?;
    out.finish().map_err(|e| of_path(broken(&e)))
}

/// How a column is stored.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum ColumnForm {
    Double,
    Whole,
    Text,
    /// A time of a calendar.
    Timestamp {
        utc: bool,
        nanos: bool,
    },
    /// Another time, in the file's own numbers or else in seconds.
    Time,
}

/// A value, as it is stored.
enum Stored {
    Nothing,
    Double(f64),
    Whole(i64),
    Text(Vec<u8>),
}

impl ColumnForm {
    fn field(self, name: &str) -> ParquetResult<TypePtr> {
        let (physical, logical) = match self {
            Self::Double | Self::Time => (Physical::DOUBLE, None),
            Self::Whole => (Physical::INT64, None),
            Self::Text => (Physical::BYTE_ARRAY, Some(LogicalType::String)),
            Self::Timestamp { utc, nanos } => {
                let unit = if nanos { TimeUnit::NANOS } else { TimeUnit::MICROS };
                (Physical::INT64, Some(LogicalType::timestamp(utc, unit)))
            }
        };
        let field = Type::primitive_type_builder(name, physical).with_repetition(Repetition::OPTIONAL);
        field.with_logical_type(logical).build().map(Arc::new)
    }

    /// What a text is in the column.
    fn value(self, text: &str, reading: &Reading) -> Stored {
        let cell = || reading.cell(text.trim().as_bytes());
        match self {
            Self::Text if text.is_empty() => Stored::Nothing,
            Self::Text => Stored::Text(text.as_bytes().to_vec()),
            Self::Whole => text.trim().parse().map_or(Stored::Nothing, Stored::Whole),
            Self::Double | Self::Time => match cell() {
                Cell::Number(number) => Stored::Double(number),
                Cell::Missing | Cell::Infinite | Cell::Text => Stored::Nothing,
            },
            Self::Timestamp { .. } => Stored::Nothing,
        }
    }
}

/// How each column is stored, by all its cells.
fn forms(track: &Track) -> Result<Vec<ColumnForm>> {
    let reading = Reading::new(track.dialect.decimal_comma, &track.dialect.missing);
    let mut looks = vec![Looks::default(); track.columns.len()];
    let (mut zoned, mut fine) = (false, false);
    for_each_row(track, |_, cells| {
        for (place, look) in looks.iter_mut().enumerate() {
            look.add(&cells.text(place), &reading);
        }
        if let Some(column) = track.time.column {
            let text = cells.text(column);
            zoned |= text.contains(':') && names_zone(&text);
            fine |= text
                .find(['.', ','])
                .is_some_and(|at| text[at + 1..].bytes().take_while(u8::is_ascii_digit).count() > 6);
        }
        Ok(())
    })?;
    let time = &track.time;
    let absolute = zoned || time.zone.is_some() || time.is_absolute();
    let form = |(place, (column, look)): (usize, (&Column, &Looks))| match column.kind {
        ColumnKind::Time if time.column == Some(place) && time.is_calendar() => {
            ColumnForm::Timestamp { utc: absolute, nanos: fine || time.counts_nanoseconds() }
        }
        ColumnKind::Time if time.column == Some(place) => ColumnForm::Time,
        ColumnKind::Number => ColumnForm::Double,
        _ if look.whole() => ColumnForm::Whole,
        ColumnKind::Aside(_) | ColumnKind::Truth if look.texts == 0 && look.numbers > 0 => ColumnForm::Double,
        _ => ColumnForm::Text,
    };
    Ok(track.columns.iter().zip(&looks).enumerate().map(form).collect())
}

/// True for a time that ends with its zone.
fn names_zone(text: &str) -> bool {
    let clock = text.rsplit_once(':').map_or("", |(_, after)| after);
    let signed = text.rfind(['+', '-']).is_some_and(|at| text[..at].contains(':'));
    signed || clock.trim().ends_with(|c: char| c.is_ascii_alphabetic() && !matches!(c, 'M' | 'm'))
}

/// What the cells of a column look like.
#[derive(Debug, Clone, Default)]
struct Looks {
    /// Whole numbers that are written as short as they can be.
    wholes: usize,
    numbers: usize,
    texts: usize,
}

impl Looks {
    fn add(&mut self, text: &str, reading: &Reading) {
        match reading.cell(text.trim().as_bytes()) {
            Cell::Missing => {}
            Cell::Number(_) if text.parse::<i64>().is_ok_and(|n| n.to_string() == text) => self.wholes += 1,
            // Zeros that no number needs belong to a name.
            Cell::Number(_) if matches!(text.trim().as_bytes(), [b'0', b'0'..=b'9', ..]) => self.texts += 1,
            Cell::Number(_) => self.numbers += 1,
            Cell::Infinite | Cell::Text => self.texts += 1,
        }
    }

    fn whole(&self) -> bool {
        self.wholes > 0 && self.numbers + self.texts == 0
    }
}

/// Reads the cells of the record.
struct CellReader<'a> {
    track: &'a Track,
    forms: &'a [ColumnForm],
    reading: Reading,
    timing: Timing,
    /// For each column that was loaded, its number in each row.
    numbers: Vec<Option<Vec<f64>>>,
}

impl<'a> CellReader<'a> {
    fn of(track: &'a Track, forms: &'a [ColumnForm]) -> Self {
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

    fn value(&self, place: usize, row: usize, cells: &Cells<'_>) -> Stored {
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
    fn new_row(&self, new: &NewRow, texts: &[String], out: &mut Out<'_>) {
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
    &raw[super::super::tokens::inner(raw, cells.quote)]
}

fn rounded_micros(ns: i64) -> i64 {
    ns.saturating_add(500).div_euclid(1000)
}

/// The values of a column in the rows of a group.
struct Values {
    form: ColumnForm,
    levels: Vec<i16>,
    doubles: Vec<f64>,
    wholes: Vec<i64>,
    texts: Vec<Vec<u8>>,
}

impl Values {
    fn of(form: ColumnForm) -> Self {
        Self { form, levels: Vec::new(), doubles: Vec::new(), wholes: Vec::new(), texts: Vec::new() }
    }

    fn push(&mut self, value: Stored) {
        self.levels.push(i16::from(!matches!(value, Stored::Nothing)));
        match value {
            Stored::Nothing => {}
            Stored::Double(value) => self.doubles.push(value),
            Stored::Whole(value) => self.wholes.push(value),
            Stored::Text(value) => self.texts.push(value),
        }
    }

    /// The chunk of the values, which are gone then.
    fn encoded(&mut self, column: parquet::schema::types::ColumnDescPtr) -> ParquetResult<Encoded> {
        let form = Form::usual(COMPRESSION);
        let levels = std::mem::take(&mut self.levels);
        match self.form {
            ColumnForm::Double | ColumnForm::Time => {
                encode(column, &form, &Levelled::<DoubleType>::optional(levels, std::mem::take(&mut self.doubles)))
            }
            ColumnForm::Whole | ColumnForm::Timestamp { .. } => {
                encode(column, &form, &Levelled::<Int64Type>::optional(levels, std::mem::take(&mut self.wholes)))
            }
            ColumnForm::Text => {
                let texts: Vec<<ByteArrayType as DataType>::T> =
                    std::mem::take(&mut self.texts).into_iter().map(Into::into).collect();
                encode(column, &form, &Levelled::<ByteArrayType>::optional(levels, texts))
            }
        }
    }
}

/// The file as it is written.
struct Out<'a> {
    writer: SerializedFileWriter<Vec<u8>>,
    descriptor: SchemaDescriptor,
    columns: Vec<Values>,
    flags: Option<&'a Flags>,
    /// For each column of flags, those of the rows of the group.
    codes: Vec<Vec<&'a str>>,
    /// Rows of the group.
    rows: usize,
}

impl<'a> Out<'a> {
    fn of(track: &Track, forms: &[ColumnForm], flags: Option<&'a Flags>) -> ParquetResult<Self> {
        let mut fields = Vec::new();
        for (column, form) in track.columns.iter().zip(forms) {
            fields.push(form.field(&column.name)?);
        }
        for column in flags.into_iter().flat_map(|flags| &flags.columns) {
            fields.push(field(&column.name, flags.is_some_and(|flags| flags.whole))?);
        }
        let root = Arc::new(Type::group_type_builder("schema").with_fields(fields).build()?);
        let keys: Vec<KeyValue> = units(track)
            .into_iter()
            .chain(flags.into_iter().flat_map(|f| f.about.clone()))
            .map(|(k, v)| KeyValue::new(k, v))
            .collect();
        let properties = WriterProperties::builder()
            .set_created_by(WRITER.to_owned())
            .set_compression(COMPRESSION)
            .set_key_value_metadata(Some(keys).filter(|keys| !keys.is_empty()))
            .build();
        Ok(Self {
            descriptor: SchemaDescriptor::new(Arc::clone(&root)),
            writer: SerializedFileWriter::new(Vec::new(), root, Arc::new(properties))?,
            columns: forms.iter().copied().map(Values::of).collect(),
            codes: vec![Vec::new(); flags.map_or(0, |flags| flags.columns.len())],
            flags,
            rows: 0,
        })
    }

    fn end_row(&mut self, flag: impl Fn(&'a super::write::FlagTexts) -> &'a str) {
        let flags = self.flags.into_iter().flat_map(|flags| &flags.columns);
        self.codes.iter_mut().zip(flags).for_each(|(codes, column)| codes.push(flag(column)));
        self.rows += 1;
    }

    fn end_group(&mut self) -> ParquetResult<()> {
        let mut group = self.writer.next_row_group()?;
        for (i, values) in self.columns.iter_mut().enumerate() {
            append(&mut group, values.encoded(self.descriptor.column(i))?)?;
        }
        for (i, codes) in self.codes.iter_mut().enumerate() {
            let column = self.descriptor.column(self.columns.len() + i);
            let whole = self.flags.is_some_and(|flags| flags.whole);
            append(&mut group, encoded(column, &Form::usual(COMPRESSION), whole, codes.drain(..))?)?;
        }
        group.close()?;
        self.rows = 0;
        Ok(())
    }

    fn finish(mut self) -> ParquetResult<Vec<u8>> {
        if self.rows > 0 {
            self.end_group()?;
        }
        self.writer.into_inner()
    }
}

fn append(group: &mut SerializedRowGroupWriter<'_, Vec<u8>>, encoded: Encoded) -> ParquetResult<()> {
    group.append_column(&encoded.chunk, encoded.close)
}

/// The units of the columns, as the conventions of CF name them.
fn units(track: &Track) -> Vec<(String, String)> {
    let told = track.columns.iter().filter(|column| !column.unit.is_empty() && column.kind == ColumnKind::Number);
    told.map(|column| (format!("{}:units", column.name), column.unit.clone())).collect()
}
