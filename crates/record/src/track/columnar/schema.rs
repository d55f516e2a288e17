//! What a Parquet file holds: the columns that have one value in each row, and those that have not.

use std::collections::BTreeSet;

use parquet::basic::Compression;
use parquet::file::metadata::{ColumnChunkMetaData, PageIndexPolicy, ParquetMetaData, ParquetMetaDataReader};

use super::super::packing::Unpackable;
use super::access::{Chunk, FileBytes};
use super::errors::{broken, damaged, encrypted, encrypted_columns, unread_codec};
use super::kind::Kind;
use super::pages::guarded;
use super::thrift;
use parquet::file::reader::ChunkReader as _;

/// A column of one value in each row.
#[derive(Debug, Clone)]
pub(super) struct Flat {
    /// Its place among the columns that the file stores.
    pub(super) leaf: usize,
    /// Its name; that of a member of a group has the name of the group before it, with a point.
    pub(super) name: String,
    pub(super) kind: Kind,
}

/// What the footer of a file says.
pub(super) struct Schema {
    pub(super) metadata: ParquetMetaData,
    /// The columns that are read.
    pub(super) flat: Vec<Flat>,
    /// The names of those that are not: they hold lists or maps.
    pub(super) nested: Vec<String>,
}

const MAGIC: usize = 4;
const LOCKED: &[u8] = b"PARE";

impl Schema {
    /// Reads the footer.
    ///
    /// # Errors
    /// [`Unpackable`] for a file that is damaged, encrypted, without a column that can be read, or packed in a way
    /// that is not read.
    pub(super) fn of(file: &FileBytes<'_>) -> Result<Self, Unpackable> {
        let length = file.length();
        let ends = |at: u64| file.get_bytes(at, MAGIC).map_err(|e| broken(&e));
        if ends(0)? == LOCKED || ends(length.saturating_sub(MAGIC as u64))? == LOCKED {
            return Err(encrypted());
        }
        let locked = footer(file).map_or_else(Vec::new, |bytes| thrift::encrypted_columns(&bytes));
        if !locked.is_empty() {
            return Err(encrypted_columns(&locked));
        }
        let reader = ParquetMetaDataReader::new().with_page_index_policy(PageIndexPolicy::Optional);
        let metadata = guarded(|| reader.parse_and_finish(file)).map_err(|e| broken(&e))?;
        let (mut flat, mut nested) = (Vec::new(), BTreeSet::new());
        let descriptor = metadata.file_metadata().schema_descr();
        for (leaf, column) in descriptor.columns().iter().enumerate() {
            if column.max_rep_level() > 0 {
                nested.insert(descriptor.get_column_root(leaf).name().to_owned());
                continue;
            }
            flat.push(Flat { leaf, name: column.path().parts().join("."), kind: Kind::of(column) });
        }
        let schema = Self { metadata, flat, nested: nested.into_iter().collect() };
        schema.check(length)?;
        Ok(schema)
    }

    fn check(&self, length: u64) -> Result<(), Unpackable> {
        if self.flat.is_empty() {
            let names = super::super::printable(&self.nested.join(", "));
            let what = match names.as_str() {
                "" => "a Parquet file without columns".to_owned(),
                names => format!("a Parquet file of nested columns alone: {names}"),
            };
            let help = "write it with a column for each value: duckdb -c \"copy (select unnest(COLUMN) from 'FILE') to 'NEW.parquet'\"";
            return Err(Unpackable::new(what, help));
        }
        for group in self.metadata.row_groups() {
            if group.num_rows() < 0 || group.num_columns() != self.metadata.file_metadata().schema_descr().num_columns()
            {
                return Err(damaged("a row group has other columns than the file"));
            }
            for chunk in group.columns() {
                place(chunk, length)?;
            }
            for flat in &self.flat {
                if let Some(codec) = unread(group.column(flat.leaf).compression()) {
                    return Err(unread_codec(&flat.name, codec));
                }
            }
        }
        Ok(())
    }

    /// All rows.
    pub(super) fn rows(&self) -> u64 {
        self.metadata.row_groups().iter().map(|group| group.num_rows().unsigned_abs()).sum()
    }

    /// The chunk of a column in a row group, as it is stored.
    pub(super) fn chunk(&self, file: &FileBytes<'_>, group: usize, leaf: usize) -> Result<Chunk, Unpackable> {
        let (start, length) = place(self.metadata.row_group(group).column(leaf), file.length())?;
        let bytes = file.get_bytes(start, length).map_err(|e| broken(&e))?;
        Ok(Chunk { start, bytes })
    }
}

/// The bytes of the footer, where the end of the file says how many they are.
fn footer(file: &FileBytes<'_>) -> Option<bytes::Bytes> {
    const LENGTH: u64 = 4;
    let end = file.length().checked_sub(LENGTH + MAGIC as u64)?;
    let length = file.get_bytes(end, LENGTH as usize).ok()?;
    let length = u32::from_le_bytes(length.as_ref().try_into().ok()?);
    file.get_bytes(end.checked_sub(length.into())?, length as usize).ok()
}

/// Where a chunk begins, and how long it is.
fn place(chunk: &ColumnChunkMetaData, file: u64) -> Result<(u64, usize), Unpackable> {
    if chunk.file_path().is_some() {
        return Err(damaged("its data stand in another file"));
    }
    let start = dictionary_offset(chunk).unwrap_or_else(|| chunk.data_page_offset());
    let place = u64::try_from(start).ok().zip(u64::try_from(chunk.compressed_size()).ok());
    let within = place.filter(|(start, length)| start.checked_add(*length).is_some_and(|end| end <= file));
    let (start, length) = within.ok_or_else(|| damaged("a column lies outside the file"))?;
    Ok((start, usize::try_from(length).map_err(|_| damaged("a column is too long"))?))
}

/// Where the dictionary stands; some old writers say 0 where there is none.
pub(super) fn dictionary_offset(chunk: &ColumnChunkMetaData) -> Option<i64> {
    chunk.dictionary_page_offset().filter(|at| *at >= MAGIC as i64 && *at < chunk.data_page_offset())
}

/// The name of a way to pack that is not read.
fn unread(codec: Compression) -> Option<&'static str> {
    match codec {
        Compression::BROTLI(_) => Some("Brotli"),
        Compression::LZO => Some("LZO"),
        _ => None,
    }
}
