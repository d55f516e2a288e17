//! Files are written by the library, by its own door, and read back by it.

use std::sync::Arc;

use bytes::Bytes;
use parquet::basic::Compression;
use parquet::column::reader::ColumnReader;
use parquet::column::writer::ColumnWriter;
use parquet::data_type::{ByteArray, FixedLenByteArray, Int96};
use parquet::file::metadata::KeyValue;
use parquet::file::properties::{WriterProperties, WriterPropertiesBuilder, WriterVersion};
use parquet::file::reader::{FileReader, SerializedFileReader};
use parquet::file::writer::SerializedFileWriter;
use parquet::schema::parser::parse_message_type;

use super::super::{CellChange, Changes, LoadOptions, NewRow, Source, Track, load, rewrite};
use super::pages::column_reader;
use super::schema::Schema;
use super::*;

mod copies;
mod errors;
mod tables;
mod texts;

/// What is written into a column: its values, and the levels where not every row has one.
#[derive(Debug, Clone)]
enum Put {
    Bool(Vec<bool>),
    I32(Vec<i32>),
    I64(Vec<i64>),
    I96(Vec<[u32; 3]>),
    F32(Vec<f32>),
    F64(Vec<f64>),
    Bytes(Vec<Vec<u8>>),
    Fixed(Vec<Vec<u8>>),
    /// At these levels of definition and repetition.
    At(Box<Put>, Vec<i16>, Vec<i16>),
}

impl Put {
    /// With nulls where a row has none.
    fn optional(values: &[Option<f64>]) -> Self {
        let levels = values.iter().map(|v| i16::from(v.is_some())).collect();
        Self::At(Box::new(Self::F64(values.iter().copied().flatten().collect())), levels, Vec::new())
    }

    fn texts(values: &[&str]) -> Self {
        Self::Bytes(values.iter().map(|v| v.as_bytes().to_vec()).collect())
    }

    fn write(&self, writer: &mut ColumnWriter<'_>, levels: Option<(&[i16], &[i16])>) {
        let definitions = levels.map(|(d, _)| d);
        let repetitions = levels.map(|(_, r)| r).filter(|r| !r.is_empty());
        macro_rules! written {
            ($w:ident, $values:expr) => {
                $w.write_batch(&$values, definitions, repetitions).map(|_| ()).unwrap()
            };
        }
        match (self, writer) {
            (Self::At(values, d, r), writer) => values.write(writer, Some((d, r))),
            (Self::Bool(v), ColumnWriter::BoolColumnWriter(w)) => written!(w, v),
            (Self::I32(v), ColumnWriter::Int32ColumnWriter(w)) => written!(w, v),
            (Self::I64(v), ColumnWriter::Int64ColumnWriter(w)) => written!(w, v),
            (Self::F32(v), ColumnWriter::FloatColumnWriter(w)) => written!(w, v),
            (Self::F64(v), ColumnWriter::DoubleColumnWriter(w)) => written!(w, v),
            (Self::I96(v), ColumnWriter::Int96ColumnWriter(w)) => {
                let values: Vec<Int96> = v.iter().map(|parts| Int96::from(parts.to_vec())).collect();
                written!(w, values);
            }
            (Self::Bytes(v), ColumnWriter::ByteArrayColumnWriter(w)) => {
                let values: Vec<ByteArray> = v.iter().cloned().map(Into::into).collect();
                written!(w, values);
            }
            (Self::Fixed(v), ColumnWriter::FixedLenByteArrayColumnWriter(w)) => {
                let values: Vec<FixedLenByteArray> = v.iter().cloned().map(Into::into).collect();
                written!(w, values);
            }
            (put, _) => panic!("{put:?} is of another type than its column"),
        }
    }
}

/// A file of this schema and these row groups.
fn file(schema: &str, groups: &[Vec<Put>], form: WriterPropertiesBuilder) -> Vec<u8> {
    let schema = Arc::new(parse_message_type(schema).unwrap());
    let mut writer = SerializedFileWriter::new(Vec::new(), schema, Arc::new(form.build())).unwrap();
    for columns in groups {
        let mut group = writer.next_row_group().unwrap();
        for column in columns {
            let mut writer = group.next_column().unwrap().unwrap();
            column.write(writer.untyped(), None);
            writer.close().unwrap();
        }
        group.close().unwrap();
    }
    writer.into_inner().unwrap()
}

fn plain() -> WriterPropertiesBuilder {
    WriterProperties::builder()
}

fn source(bytes: &[u8]) -> Source {
    Source::BuiltIn { name: "wildpoint:test", bytes: bytes.into() }
}

fn track(bytes: &[u8]) -> Track {
    load(&source(bytes), &LoadOptions::default()).unwrap()
}

/// The record as text.
fn as_text(bytes: &[u8]) -> String {
    let mut out = Vec::new();
    rewrite(&track(bytes), &Changes::default(), &mut out).unwrap();
    String::from_utf8(out).unwrap()
}

fn changed(cells: &[(u32, usize, Option<f64>)]) -> Changes {
    let cells = cells.iter().map(|&(row, column, value)| CellChange { row, column, value }).collect();
    Changes { cells, rows: Vec::new() }
}

fn copy_of(bytes: &[u8], changes: &Changes) -> Vec<u8> {
    let mut out = Vec::new();
    write_columns(&track(bytes), changes, None, &mut out).unwrap();
    out
}

/// The stored bytes of each chunk, by row group and column.
fn chunks(bytes: &[u8]) -> Vec<Vec<Vec<u8>>> {
    let file = access::FileBytes::Memory(bytes);
    let schema = Schema::of(&file).unwrap();
    let chunk = |group: usize, leaf| schema.chunk(&file, group, leaf).unwrap().bytes.to_vec();
    let leaves = schema.metadata.file_metadata().schema_descr().num_columns();
    (0..schema.metadata.num_row_groups()).map(|group| (0..leaves).map(|leaf| chunk(group, leaf)).collect()).collect()
}
