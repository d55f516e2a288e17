//! The rows of the stream, track by track, wherever its batches are cut.

use std::collections::HashSet;

use arrow_array::RecordBatch;
use wildpoint_kernel::ids;
use wildpoint_record::error::{Error, Result};

/// A track that is complete, in the pieces that it came in.
#[derive(Debug)]
pub(crate) struct Complete {
    pub(crate) id: String,
    pub(crate) pieces: Vec<RecordBatch>,
}

/// Collects the rows of the track that is being read.
#[derive(Debug, Default)]
pub(crate) struct Tracks {
    /// Index of the column of ids.
    column: Option<usize>,
    open: Option<Complete>,
    /// The ids of the tracks that are complete.
    done: HashSet<Box<str>>,
}

impl Tracks {
    pub(crate) fn told_apart_by(column: Option<usize>) -> Self {
        Self { column, ..Self::default() }
    }

    /// Takes a batch, and calls `each` with every track that is complete with it.
    ///
    /// # Errors
    /// [`Error::Usage`] when rows of a track come after those of another; what `each` gives.
    pub(crate) fn take(&mut self, batch: &RecordBatch, mut each: impl FnMut(Complete) -> Result<()>) -> Result<()> {
        let Some(column) = self.column else {
            let whole = Complete { id: String::new(), pieces: Vec::new() };
            self.open.get_or_insert(whole).pieces.push(batch.clone());
            return Ok(());
        };
        let ids = ids(batch.column(column), batch.schema_ref().field(column).name())?;
        let mut start = 0;
        while start < batch.num_rows() {
            let id = ids.value(start);
            let length = (start..batch.num_rows()).take_while(|row| ids.value(*row) == id).count();
            if self.open.as_ref().is_none_or(|open| open.id != id) {
                self.close().map_or(Ok(()), &mut each)?;
                if self.done.contains(id) {
                    let what = format!("track {id}: its rows do not stand together");
                    return Err(Error::usage(what, "sort the rows by track and time, or group them by track"));
                }
                self.open = Some(Complete { id: id.to_owned(), pieces: Vec::new() });
            }
            self.open.iter_mut().for_each(|open| open.pieces.push(batch.slice(start, length)));
            start += length;
        }
        Ok(())
    }

    /// The track that is being read is complete.
    pub(crate) fn close(&mut self) -> Option<Complete> {
        let complete = self.open.take()?;
        self.done.insert(complete.id.as_str().into());
        Some(complete)
    }
}
