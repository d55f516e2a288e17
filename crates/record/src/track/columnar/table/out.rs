//! The file as it is written, a group of rows at a time.

use std::sync::Arc;

use parquet::data_type::{ByteArrayType, DataType, DoubleType, Int64Type};
use parquet::errors::Result as ParquetResult;
use parquet::file::metadata::KeyValue;
use parquet::file::properties::WriterProperties;
use parquet::file::writer::{SerializedFileWriter, SerializedRowGroupWriter};
use parquet::schema::types::{ColumnDescPtr, SchemaDescriptor, Type};

use super::super::super::{ColumnKind, Track};
use super::super::encode::{Encoded, Form, encode};
use super::super::flags::{encoded, field};
use super::super::recode::Levelled;
use super::super::write::{FlagTexts, Flags};
use super::form::{ColumnForm, Stored};
use super::{COMPRESSION, WRITER};

/// The values of a column in the rows of a group.
pub(super) struct Values {
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

    pub(super) fn push(&mut self, value: Stored) {
        self.levels.push(i16::from(!matches!(value, Stored::Nothing)));
        match value {
            Stored::Nothing => {}
            Stored::Double(value) => self.doubles.push(value),
            Stored::Whole(value) => self.wholes.push(value),
            Stored::Text(value) => self.texts.push(value),
        }
    }

    /// The chunk of the values, which are gone then.
    fn encoded(&mut self, column: ColumnDescPtr) -> ParquetResult<Encoded> {
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
pub(super) struct Out<'a> {
    writer: SerializedFileWriter<Vec<u8>>,
    descriptor: SchemaDescriptor,
    pub(super) columns: Vec<Values>,
    flags: Option<&'a Flags>,
    /// For each column of flags, those of the rows of the group.
    codes: Vec<Vec<&'a str>>,
    /// Rows of the group.
    pub(super) rows: usize,
}

impl<'a> Out<'a> {
    pub(super) fn of(track: &Track, forms: &[ColumnForm], flags: Option<&'a Flags>) -> ParquetResult<Self> {
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

    pub(super) fn end_row(&mut self, flag: impl Fn(&'a FlagTexts) -> &'a str) {
        let flags = self.flags.into_iter().flat_map(|flags| &flags.columns);
        self.codes.iter_mut().zip(flags).for_each(|(codes, column)| codes.push(flag(column)));
        self.rows += 1;
    }

    pub(super) fn end_group(&mut self) -> ParquetResult<()> {
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

    pub(super) fn finish(mut self) -> ParquetResult<Vec<u8>> {
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
