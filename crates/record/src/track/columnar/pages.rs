//! The pages of a column chunk. Zstandard is unpacked and packed here, by a library without C.

use std::sync::Arc;

use bytes::Bytes;
use parquet::basic::{Compression, Encoding};
use parquet::column::page::{CompressedPage, Page, PageMetadata, PageReader, PageWriteSpec, PageWriter};
use parquet::column::reader::{ColumnReader, get_column_reader};
use parquet::errors::{ParquetError, Result};
use parquet::file::metadata::ColumnChunkMetaData;
use parquet::file::serialized_reader::SerializedPageReader;

use super::super::packing::{zstd_packed, zstd_unpacked};
use super::access::Chunk;
use super::schema::dictionary_offset;

/// The values of a chunk.
pub(super) fn column_reader(chunk: Chunk, about: &ColumnChunkMetaData, rows: usize) -> Result<ColumnReader> {
    Ok(get_column_reader(about.column_descr_ptr(), page_reader(chunk, about, rows)?))
}

/// The pages of a chunk.
pub(super) fn page_reader(chunk: Chunk, about: &ColumnChunkMetaData, rows: usize) -> Result<Box<dyn PageReader>> {
    let zstd = matches!(about.compression(), Compression::ZSTD(_));
    let mut builder = about.clone().into_builder().set_dictionary_page_offset(dictionary_offset(about));
    if zstd {
        builder = builder.set_compression(Compression::UNCOMPRESSED);
    }
    let pages = SerializedPageReader::new(Arc::new(chunk), &builder.build()?, rows, None)?;
    let most = u64::try_from(about.uncompressed_size())?;
    Ok(Box::new(Pages { pages: Box::new(pages), zstd: zstd.then_some(most), dictionary: false }))
}

/// What `read` gives; an error where the library gives up on a file that says what cannot be.
pub(super) fn guarded<T>(read: impl FnOnce() -> Result<T>) -> Result<T> {
    let read = std::panic::catch_unwind(std::panic::AssertUnwindSafe(read));
    read.unwrap_or_else(|_| Err(ParquetError::General("it says what cannot be".into())))
}

/// The pages of a chunk, looked at before they are read.
struct Pages {
    pages: Box<dyn PageReader>,
    /// Where pages are packed by Zstandard: no page has more bytes.
    zstd: Option<u64>,
    /// True when the dictionary has been met.
    dictionary: bool,
}

impl Pages {
    fn checked(&mut self, page: &Page) -> Result<()> {
        let coded = matches!(page.encoding(), Encoding::PLAIN_DICTIONARY | Encoding::RLE_DICTIONARY);
        match page {
            Page::DictionaryPage { .. } if self.dictionary => Err(ParquetError::General("two dictionaries".into())),
            Page::DictionaryPage { .. } => {
                self.dictionary = true;
                Ok(())
            }
            _ if coded && !self.dictionary => Err(ParquetError::General("a dictionary is missing".into())),
            _ => Ok(()),
        }
    }

    fn unpacked(&self, page: Page, most: u64) -> Result<Page> {
        let unpack = |packed: &[u8], levels: &[u8]| -> Result<Bytes> {
            let mut bytes = levels.to_vec();
            if !packed.is_empty() {
                bytes.extend(zstd_unpacked(packed, most)?);
            }
            Ok(bytes.into())
        };
        Ok(match page {
            Page::DataPage { buf, num_values, encoding, def_level_encoding, rep_level_encoding, statistics } => {
                let buf = unpack(&buf, &[])?;
                Page::DataPage { buf, num_values, encoding, def_level_encoding, rep_level_encoding, statistics }
            }
            Page::DictionaryPage { buf, num_values, encoding, is_sorted } => {
                Page::DictionaryPage { buf: unpack(&buf, &[])?, num_values, encoding, is_sorted }
            }
            Page::DataPageV2 {
                buf,
                num_values,
                encoding,
                num_nulls,
                num_rows,
                def_levels_byte_len,
                rep_levels_byte_len,
                is_compressed: true,
                statistics,
            } => {
                let (levels, values) = parted(&buf, def_levels_byte_len, rep_levels_byte_len)?;
                let buf = unpack(values, levels)?;
                Page::DataPageV2 {
                    buf,
                    num_values,
                    encoding,
                    num_nulls,
                    num_rows,
                    def_levels_byte_len,
                    rep_levels_byte_len,
                    is_compressed: false,
                    statistics,
                }
            }
            plain => plain,
        })
    }
}

/// The levels of a page of the second version, which are never packed, and its values.
fn parted(page: &[u8], def_levels: u32, rep_levels: u32) -> Result<(&[u8], &[u8])> {
    let levels = def_levels as usize + rep_levels as usize;
    page.split_at_checked(levels).ok_or_else(|| ParquetError::General("a page is shorter than its levels".into()))
}

impl Iterator for Pages {
    type Item = Result<Page>;

    fn next(&mut self) -> Option<Self::Item> {
        self.get_next_page().transpose()
    }
}

impl PageReader for Pages {
    fn get_next_page(&mut self) -> Result<Option<Page>> {
        let Some(page) = self.pages.get_next_page()? else { return Ok(None) };
        self.checked(&page)?;
        self.zstd.map_or(Ok(page.clone()), |most| self.unpacked(page, most)).map(Some)
    }

    fn peek_next_page(&mut self) -> Result<Option<PageMetadata>> {
        self.pages.peek_next_page()
    }

    fn skip_next_page(&mut self) -> Result<()> {
        self.pages.skip_next_page()
    }

    fn at_record_boundary(&mut self) -> Result<bool> {
        self.pages.at_record_boundary()
    }
}

/// Packs the pages that go to another writer by Zstandard.
pub(super) struct ZstdWriter<'a>(pub(super) Box<dyn PageWriter + 'a>);

impl PageWriter for ZstdWriter<'_> {
    fn write_page(&mut self, page: CompressedPage) -> Result<PageWriteSpec> {
        let uncompressed = page.uncompressed_size();
        let packed = match page.compressed_page().clone() {
            Page::DataPage { buf, num_values, encoding, def_level_encoding, rep_level_encoding, statistics } => {
                let buf = zstd_packed(&buf).into();
                Page::DataPage { buf, num_values, encoding, def_level_encoding, rep_level_encoding, statistics }
            }
            Page::DictionaryPage { buf, num_values, encoding, is_sorted } => {
                Page::DictionaryPage { buf: zstd_packed(&buf).into(), num_values, encoding, is_sorted }
            }
            Page::DataPageV2 {
                buf,
                num_values,
                encoding,
                num_nulls,
                num_rows,
                def_levels_byte_len,
                rep_levels_byte_len,
                statistics,
                ..
            } => {
                let (levels, values) = parted(&buf, def_levels_byte_len, rep_levels_byte_len)?;
                let is_compressed = !values.is_empty();
                let values = if is_compressed { zstd_packed(values) } else { Vec::new() };
                Page::DataPageV2 {
                    buf: [levels, &values].concat().into(),
                    num_values,
                    encoding,
                    num_nulls,
                    num_rows,
                    def_levels_byte_len,
                    rep_levels_byte_len,
                    is_compressed,
                    statistics,
                }
            }
        };
        self.0.write_page(CompressedPage::new(packed, uncompressed))
    }

    fn close(&mut self) -> Result<()> {
        self.0.close()
    }
}
