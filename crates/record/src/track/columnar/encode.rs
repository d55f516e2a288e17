//! A column chunk, encoded.

use std::sync::Arc;

use parquet::basic::{Compression, Encoding};
use parquet::column::page::{Page, PageWriter};
use parquet::column::writer::{ColumnCloseResult, get_column_writer, get_typed_column_writer};
use parquet::data_type::DataType;
use parquet::errors::Result;
use parquet::file::metadata::ColumnChunkMetaData;
use parquet::file::properties::{WriterProperties, WriterVersion};
use parquet::file::writer::{SerializedPageWriter, TrackedWrite};
use parquet::schema::types::ColumnDescPtr;

use super::access::Chunk;
use super::pages::{ZstdWriter, page_reader};
use super::recode::Levelled;

/// How a chunk is encoded.
#[derive(Debug, Clone, Copy)]
pub(super) struct Form {
    pub(super) compression: Compression,
    /// True where pages are of the second version.
    second: bool,
    dictionary: bool,
    /// The encoding of values that are in no dictionary, where it is not the usual one.
    encoding: Option<Encoding>,
}

/// An encoded chunk.
pub(super) struct Encoded {
    pub(super) chunk: Chunk,
    pub(super) close: ColumnCloseResult,
}

impl Form {
    /// The usual form.
    pub(super) fn usual(compression: Compression) -> Self {
        Self { compression, second: false, dictionary: true, encoding: None }
    }

    /// That of a chunk, by its first pages.
    pub(super) fn of(chunk: &Chunk, about: &ColumnChunkMetaData, rows: usize) -> Result<Self> {
        let mut form = Self { dictionary: false, ..Self::usual(about.compression()) };
        let mut pages = page_reader(chunk.clone(), about, rows)?;
        while let Some(page) = pages.get_next_page()? {
            match &page {
                Page::DictionaryPage { .. } => {
                    form.dictionary = true;
                    continue;
                }
                Page::DataPageV2 { .. } => form.second = true,
                Page::DataPage { .. } => {}
            }
            let kept = matches!(
                page.encoding(),
                Encoding::PLAIN
                    | Encoding::DELTA_BINARY_PACKED
                    | Encoding::DELTA_LENGTH_BYTE_ARRAY
                    | Encoding::DELTA_BYTE_ARRAY
                    | Encoding::BYTE_STREAM_SPLIT
            );
            form.encoding = kept.then(|| page.encoding()).filter(|_| !form.dictionary);
            break;
        }
        Ok(form)
    }

    fn is_zstd(self) -> bool {
        matches!(self.compression, Compression::ZSTD(_))
    }

    fn properties(self) -> WriterProperties {
        let version = if self.second { WriterVersion::PARQUET_2_0 } else { WriterVersion::PARQUET_1_0 };
        let compression = if self.is_zstd() { Compression::UNCOMPRESSED } else { self.compression };
        let mut properties = WriterProperties::builder()
            .set_writer_version(version)
            .set_compression(compression)
            .set_dictionary_enabled(self.dictionary);
        if let Some(encoding) = self.encoding {
            properties = properties.set_encoding(encoding);
        }
        properties.build()
    }
}

/// Encodes the values of a chunk.
pub(super) fn encode<T: DataType>(column: ColumnDescPtr, form: &Form, values: &Levelled<T>) -> Result<Encoded> {
    let mut sink = TrackedWrite::new(Vec::new());
    let plain = SerializedPageWriter::new(&mut sink);
    let pages: Box<dyn PageWriter + '_> =
        if form.is_zstd() { Box::new(ZstdWriter(Box::new(plain))) } else { Box::new(plain) };
    let (nullable, repeated) = (column.max_def_level() > 0, column.max_rep_level() > 0);
    let mut writer = get_typed_column_writer::<T>(get_column_writer(column, Arc::new(form.properties()), pages));
    let definitions = Some(values.definitions.as_slice()).filter(|_| nullable);
    let repetitions = Some(values.repetitions.as_slice()).filter(|_| repeated);
    writer.write_batch(&values.values, definitions, repetitions)?;
    let mut close = writer.close()?;
    if form.is_zstd() {
        close.metadata = close.metadata.into_builder().set_compression(form.compression).build()?;
    }
    Ok(Encoded { chunk: Chunk { start: 0, bytes: sink.into_inner()?.into() }, close })
}
