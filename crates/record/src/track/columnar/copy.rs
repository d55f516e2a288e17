//! A Parquet file again, with changes: chunks without one are copied byte for byte.

use std::collections::BTreeSet;
use std::ops::Range;
use std::sync::Arc;

use parquet::basic::{Compression, Repetition};
use parquet::bloom_filter::Sbbf;
use parquet::column::writer::ColumnCloseResult;
use parquet::file::metadata::KeyValue;
use parquet::file::properties::{WriterProperties, WriterVersion};
use parquet::file::writer::{SerializedFileWriter, SerializedRowGroupWriter};
use parquet::schema::types::{SchemaDescriptor, Type, TypePtr};

use super::super::packing::Unpackable;
use super::super::rewrite::{cell_text, new_row_cells};
use super::super::rows::unchanged;
use super::super::text::path_of;
use super::super::{Changes, Track};
use super::access::FileBytes;
use super::encode::{Encoded, Form};
use super::errors::{broken, of_file};
use super::flags::{encoded, field};
use super::parse::Storage;
use super::recode::{Edits, Recoding};
use super::schema::{Flat, Schema, dictionary_offset};
use super::write::Flags;
use crate::error::{Error, Result};
use crate::memory::Share;

/// The schema that Arrow keeps beside that of Parquet: it lists every column, and fits no others.
const ARROW_SCHEMA: &str = "ARROW:schema";

/// The file of `track` with `changes` and columns of flags.
///
/// # Errors
/// [`Error::Input`] for a source that has changed, and for a change that the file cannot hold; [`Error::Memory`].
pub(super) fn copied(track: &Track, changes: &Changes, flags: Option<&Flags>) -> Result<Vec<u8>> {
    let path = path_of(&track.source);
    let stored = unchanged(track)?;
    let file = FileBytes::Memory(&stored);
    let schema = Schema::of(&file).map_err(of_file(&path))?;
    let largest = schema.metadata.row_groups().iter().flat_map(|group| group.columns());
    let largest = largest.map(|chunk| chunk.uncompressed_size().unsigned_abs()).max().unwrap_or(0);
    let _share = Share::of(stored.len() as u64 + 3 * largest).map_err(Error::memory(&path))?;
    let cells = new_row_cells(track, &changes.rows)?;
    let copy = Copy { track, changes, flags, file: &file, schema: &schema, new_cells: cells };
    copy.written().map_err(of_file(&path))
}

struct Copy<'a, 'f> {
    track: &'a Track,
    changes: &'a Changes,
    flags: Option<&'a Flags>,
    file: &'a FileBytes<'f>,
    schema: &'a Schema,
    /// The texts of the cells of the new rows.
    new_cells: Vec<Vec<String>>,
}

impl Copy<'_, '_> {
    fn written(&self) -> std::result::Result<Vec<u8>, Unpackable> {
        let root = self.root()?;
        let descriptor = SchemaDescriptor::new(Arc::clone(&root));
        let mut writer =
            SerializedFileWriter::new(Vec::new(), root, Arc::new(self.properties())).map_err(|e| broken(&e))?;
        let mut first = 0;
        for (group, about) in self.schema.metadata.row_groups().iter().enumerate() {
            let rows = usize::try_from(about.num_rows()).unwrap_or(0);
            let mut group_writer = writer.next_row_group().map_err(|e| broken(&e))?;
            for leaf in 0..about.num_columns() {
                let part = Part { group, leaf, rows: first..first + rows };
                self.column(&part, &descriptor, &mut group_writer)?;
            }
            self.flag_columns(&(first..first + rows), &descriptor, &mut group_writer)?;
            group_writer.close().map_err(|e| broken(&e))?;
            first += rows;
        }
        writer.into_inner().map_err(|e| broken(&e))
    }

    /// The schema: columns that get their first nulls may hold them, and flags stand at the end.
    fn root(&self) -> std::result::Result<TypePtr, Unpackable> {
        let descriptor = self.schema.metadata.file_metadata().schema_descr();
        let freed = self.freed();
        if freed.is_empty() && self.flags.is_none() {
            return Ok(descriptor.root_schema_ptr());
        }
        let freed: BTreeSet<usize> = freed.into_iter().map(|leaf| descriptor.get_column_root_idx(leaf)).collect();
        let mut fields = Vec::new();
        for (i, field) in descriptor.root_schema().get_fields().iter().enumerate() {
            fields.push(if freed.contains(&i) { optional(field)? } else { Arc::clone(field) });
        }
        if let Some(flags) = self.flags {
            for column in &flags.columns {
                fields.push(field(&column.name, flags.whole).map_err(|e| broken(&e))?);
            }
        }
        let root = Type::group_type_builder(descriptor.root_schema().name()).with_fields(fields).build();
        root.map(Arc::new).map_err(|e| broken(&e))
    }

    /// The columns that must hold nulls and cannot: all but floats, which have NaN.
    fn freed(&self) -> BTreeSet<usize> {
        let descriptor = self.schema.metadata.file_metadata().schema_descr();
        let cannot = |flat: &Flat| {
            let column = descriptor.column(flat.leaf);
            column.max_def_level() == 0 && column.path().parts().len() == 1 && !flat.kind.is_float()
        };
        let emptied = |place: usize| {
            let none = |c: &&super::super::CellChange| c.column == place && !c.value.is_some_and(f64::is_finite);
            self.changes.cells.iter().any(|c| none(&c))
                || self.new_cells.iter().any(|row| row.get(place).is_none_or(String::is_empty))
        };
        let flat = self.schema.flat.iter().enumerate();
        flat.filter(|(place, flat)| cannot(flat) && emptied(*place)).map(|(_, flat)| flat.leaf).collect()
    }

    fn properties(&self) -> WriterProperties {
        let about = self.schema.metadata.file_metadata();
        let mut keys: Vec<KeyValue> = about.key_value_metadata().cloned().unwrap_or_default();
        if let Some(flags) = self.flags {
            keys.retain(|pair| pair.key != ARROW_SCHEMA);
            keys.extend(flags.about.iter().map(|(key, value)| KeyValue::new(key.clone(), value.clone())));
        }
        let version = if about.version() > 1 { WriterVersion::PARQUET_2_0 } else { WriterVersion::PARQUET_1_0 };
        let mut properties = WriterProperties::builder()
            .set_writer_version(version)
            .set_key_value_metadata(Some(keys).filter(|keys| !keys.is_empty()))
            .set_sorting_columns(self.sorting());
        if let Some(writer) = about.created_by() {
            // Readers know by it what to make of the statistics that are kept.
            properties = properties.set_created_by(writer.to_owned());
        }
        properties.build()
    }

    /// The order of the rows, where the file tells one and it still holds.
    fn sorting(&self) -> Option<Vec<parquet::file::metadata::SortingColumn>> {
        let groups = self.schema.metadata.row_groups();
        let first = groups.first()?.sorting_columns()?;
        let touched = |leaf: i32| {
            let place = self.schema.flat.iter().position(|flat| i32::try_from(flat.leaf) == Ok(leaf));
            self.changes.cells.iter().any(|c| Some(c.column) == place)
        };
        let same = groups.iter().all(|group| group.sorting_columns() == Some(first));
        let holds = self.changes.rows.is_empty() && !first.iter().any(|column| touched(column.column_idx));
        (same && holds).then(|| first.clone())
    }

    /// Writes a column of a row group.
    fn column(
        &self,
        part: &Part,
        descriptor: &SchemaDescriptor,
        writer: &mut SerializedRowGroupWriter<'_, Vec<u8>>,
    ) -> std::result::Result<(), Unpackable> {
        let about = self.schema.metadata.row_group(part.group).column(part.leaf);
        let place = self.schema.flat.iter().position(|flat| flat.leaf == part.leaf);
        let edits = self.edits(place, &part.rows);
        let target = descriptor.column(part.leaf);
        let same = target.max_def_level() == about.column_descr().max_def_level();
        let chunk = self.schema.chunk(self.file, part.group, part.leaf)?;
        if edits.is_empty() && same {
            return writer.append_column(&chunk, self.kept(part)?).map_err(|e| broken(&e));
        }
        let flat = place.map(|place| &self.schema.flat[place]);
        let storage = Storage {
            kind: flat.map_or(super::kind::Kind::Bytes, |flat| flat.kind),
            physical: about.column_type(),
            length: if target.self_type().is_primitive() { target.type_length() } else { 0 },
        };
        let text = |old: &str, value: f64| cell_text(self.track, place.unwrap_or(0), old, Some(value));
        let recoding = Recoding { about, rows: part.rows.len(), storage, target, edits: &edits, text: &text };
        append(writer, recoding.run(chunk)?)
    }

    /// What is known of a chunk that is copied.
    fn kept(&self, part: &Part) -> std::result::Result<ColumnCloseResult, Unpackable> {
        let metadata = &self.schema.metadata;
        let about = metadata.row_group(part.group).column(part.leaf);
        let index = metadata.page_index_for_row_group(part.group);
        let sound = about.clone().into_builder().set_dictionary_page_offset(dictionary_offset(about));
        Ok(ColumnCloseResult {
            bytes_written: about.compressed_size().unsigned_abs(),
            rows_written: part.rows.len() as u64,
            metadata: sound.build().map_err(|e| broken(&e))?,
            // A filter that cannot be read saves others work, and no more.
            bloom_filter: Sbbf::read_from_column_chunk(about, self.file).unwrap_or(None),
            column_index: index.column_index(part.leaf).cloned(),
            offset_index: index.offset_index(part.leaf).cloned(),
        })
    }

    /// What is different in a chunk of these rows.
    fn edits(&self, place: Option<usize>, rows: &Range<usize>) -> Edits {
        let cells = &self.changes.cells;
        let here = cells.partition_point(|c| (c.row as usize) < rows.start)
            ..cells.partition_point(|c| (c.row as usize) < rows.end);
        let cells = cells[here].iter().filter(|c| Some(c.column) == place);
        let text = |index: usize| {
            let text = place.and_then(|place| self.new_cells[index].get(place));
            text.filter(|text| !text.is_empty()).cloned()
        };
        Edits {
            cells: cells.map(|c| (c.row as usize - rows.start, c.value)).collect(),
            rows: self.new_rows(rows).map(|i| (self.after(i) - rows.start, text(i))).collect(),
        }
    }

    /// The new rows that follow one of these rows.
    fn new_rows(&self, rows: &Range<usize>) -> Range<usize> {
        let before = |end: usize| self.changes.rows.partition_point(|new| (new.after_row as usize) < end);
        before(rows.start)..before(rows.end)
    }

    /// The row that a new row follows.
    fn after(&self, index: usize) -> usize {
        self.changes.rows[index].after_row as usize
    }

    /// Writes the flags of the rows of a group.
    fn flag_columns(
        &self,
        rows: &Range<usize>,
        descriptor: &SchemaDescriptor,
        writer: &mut SerializedRowGroupWriter<'_, Vec<u8>>,
    ) -> std::result::Result<(), Unpackable> {
        let Some(flags) = self.flags else { return Ok(()) };
        let form = Form::usual(self.compression());
        let new = self.new_rows(rows);
        let first = descriptor.num_columns() - flags.columns.len();
        for (i, column) in flags.columns.iter().enumerate() {
            let mut added = new.clone().peekable();
            let mut texts = Vec::with_capacity(rows.len() + new.len());
            for row in rows.clone() {
                texts.push(column.of_row(row));
                while let Some(index) = added.next_if(|index| self.after(*index) == row) {
                    texts.push(column.of_new(index));
                }
            }
            let encoded =
                encoded(descriptor.column(first + i), &form, flags.whole, texts.into_iter()).map_err(|e| broken(&e))?;
            append(writer, encoded)?;
        }
        Ok(())
    }

    /// How the first of the columns that are read is packed.
    fn compression(&self) -> Compression {
        let group = self.schema.metadata.row_groups().first();
        let first = group.zip(self.schema.flat.first()).map(|(group, flat)| group.column(flat.leaf).compression());
        first.unwrap_or(Compression::SNAPPY)
    }
}

/// A chunk of the copy.
struct Part {
    group: usize,
    leaf: usize,
    /// Rows of the file.
    rows: Range<usize>,
}

fn append(writer: &mut SerializedRowGroupWriter<'_, Vec<u8>>, encoded: Encoded) -> std::result::Result<(), Unpackable> {
    writer.append_column(&encoded.chunk, encoded.close).map_err(|e| broken(&e))
}

/// The same column, which may hold nulls.
fn optional(field: &TypePtr) -> std::result::Result<TypePtr, Unpackable> {
    let info = field.get_basic_info();
    let Type::PrimitiveType { physical_type, type_length, scale, precision, .. } = field.as_ref() else {
        return Ok(Arc::clone(field));
    };
    let same = Type::primitive_type_builder(info.name(), *physical_type)
        .with_repetition(Repetition::OPTIONAL)
        .with_converted_type(info.converted_type())
        .with_logical_type(info.logical_type_ref().cloned())
        .with_length(*type_length)
        .with_precision(*precision)
        .with_scale(*scale)
        .with_id(info.has_id().then(|| info.id()));
    same.build().map(Arc::new).map_err(|e| broken(&e))
}
