//! What is wrong with a file of arrays, and the way out.

use std::io;

use super::super::packing::{Packing, Unpackable};
use super::super::printable;
use crate::memory::Full;

/// What is wrong with a file of arrays.
#[derive(Debug)]
pub(super) enum Trouble {
    /// It says what cannot be.
    Damaged(String),
    /// Its arrays make no table: their names with the reasons.
    NoTable(String),
    /// There is no such table: how many there are, and a list of them.
    NoSuchTable { wanted: usize, count: usize, listed: String },
    /// Its values are packed by a filter that is not read.
    Filter(String),
    /// It needs more memory than it may use.
    Full(Full),
}

const FETCH: &str = "copy or fetch the file again; if it is still being written, wait until its writer closes it";

impl Trouble {
    /// In words, with the way out.
    pub(super) fn told(self, packing: &Packing) -> Unpackable {
        let name = packing.name;
        let (what, help) = match self {
            Self::Damaged(what) => {
                (format!("the {name} file is damaged or cut off: {}", printable(&what)), FETCH.to_owned())
            }
            Self::NoTable(arrays) => (
                format!("{} without values along one axis, which make a table{arrays}", packing.a_file()),
                format!("write the variables as columns: {}", packing.tool),
            ),
            Self::NoSuchTable { wanted, count, listed } => (
                format!("there is no table {wanted}: the file holds {count}"),
                format!("tables count from 1: {listed}"),
            ),
            Self::Filter(filter) => (
                format!("{} whose values are packed by {filter}, which is not read", packing.a_file()),
                "pack it again: h5repack -f GZIP=4 FILE NEW (nccopy -d 4 FILE NEW for NetCDF)".to_owned(),
            ),
            Self::Full(full) => {
                return Unpackable::full(full);
            }
        };
        Unpackable::new(what, help)
    }

    /// As an error of a stream.
    pub(super) fn of_stream(self, packing_name: &str) -> io::Error {
        match self {
            Self::Full(full) => full_stream(full),
            Self::Damaged(what) => {
                io::Error::other(format!("the {packing_name} file is damaged or cut off: {}", printable(&what)))
            }
            other => io::Error::other(format!("{other:?}")),
        }
    }
}

/// No memory, as an error of a stream.
fn full_stream(full: Full) -> io::Error {
    io::Error::new(io::ErrorKind::OutOfMemory, format!("it needs more than {} bytes of memory", full.limit))
}

impl From<Full> for Trouble {
    fn from(full: Full) -> Self {
        Self::Full(full)
    }
}

impl From<io::Error> for Trouble {
    fn from(e: io::Error) -> Self {
        Self::Damaged(e.to_string())
    }
}

/// What `read` gives; an error where the library gives up on a file that says what cannot be.
pub(super) fn guarded<T>(read: impl FnOnce() -> Result<T, Trouble>) -> Result<T, Trouble> {
    let read = std::panic::catch_unwind(std::panic::AssertUnwindSafe(read));
    read.unwrap_or_else(|_| Err(Trouble::Damaged("it says what cannot be".into())))
}
