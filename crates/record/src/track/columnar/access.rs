//! The bytes of a file, at any place of it.

use std::io::{self, Cursor, SeekFrom};
use std::sync::{Mutex, PoisonError};

use bytes::Bytes;
use parquet::errors::{ParquetError, Result};
use parquet::file::reader::{ChunkReader, Length};

use super::super::packing::Look;

/// A file that can be read at any place.
pub(super) enum FileBytes<'a> {
    /// In memory.
    Memory(&'a [u8]),
    /// On the disk.
    File { file: Mutex<Box<dyn Look + 'a>>, length: u64 },
}

impl<'a> FileBytes<'a> {
    /// Of a file.
    pub(super) fn of(mut file: Box<dyn Look + 'a>) -> io::Result<Self> {
        let length = file.seek(SeekFrom::End(0))?;
        Ok(Self::File { file: Mutex::new(file), length })
    }

    /// How many bytes there are.
    pub(super) fn length(&self) -> u64 {
        match self {
            Self::Memory(bytes) => bytes.len() as u64,
            Self::File { length, .. } => *length,
        }
    }
}

impl Length for FileBytes<'_> {
    fn len(&self) -> u64 {
        self.length()
    }
}

fn cut_off() -> ParquetError {
    ParquetError::EOF("it ends before its parts do".into())
}

impl ChunkReader for FileBytes<'_> {
    type T = Cursor<Bytes>;

    fn get_read(&self, start: u64) -> Result<Self::T> {
        let rest = self.length().checked_sub(start).ok_or_else(cut_off)?;
        self.get_bytes(start, usize::try_from(rest)?).map(Cursor::new)
    }

    fn get_bytes(&self, start: u64, length: usize) -> Result<Bytes> {
        let end = start.checked_add(length as u64).filter(|end| *end <= self.length()).ok_or_else(cut_off)?;
        match self {
            Self::Memory(bytes) => Ok(Bytes::copy_from_slice(&bytes[usize::try_from(start)?..usize::try_from(end)?])),
            Self::File { file, .. } => {
                let mut file = file.lock().unwrap_or_else(PoisonError::into_inner);
                file.seek(SeekFrom::Start(start))?;
                let mut buffer = vec![0; length];
                io::Read::read_exact(&mut **file, &mut buffer)?;
                Ok(buffer.into())
            }
        }
    }
}

/// The bytes of a column chunk, at the place where they stand in the file.
#[derive(Clone)]
pub(super) struct Chunk {
    pub(super) start: u64,
    pub(super) bytes: Bytes,
}

impl Length for Chunk {
    fn len(&self) -> u64 {
        self.start + self.bytes.len() as u64
    }
}

impl ChunkReader for Chunk {
    type T = Cursor<Bytes>;

    fn get_read(&self, start: u64) -> Result<Self::T> {
        let rest = self.len().checked_sub(start).ok_or_else(cut_off)?;
        self.get_bytes(start, usize::try_from(rest)?).map(Cursor::new)
    }

    fn get_bytes(&self, start: u64, length: usize) -> Result<Bytes> {
        let from = usize::try_from(start.checked_sub(self.start).ok_or_else(cut_off)?)?;
        let end = from.checked_add(length).filter(|end| *end <= self.bytes.len()).ok_or_else(cut_off)?;
        Ok(self.bytes.slice(from..end))
    }
}
