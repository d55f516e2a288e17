//! What is wrong with a Parquet file, and the way out.

use std::path::Path;

use parquet::errors::ParquetError;

use super::super::packing::Unpackable;
use crate::error::Error;

const FETCH: &str = "copy or fetch the file again; if it is still being written, wait until its writer closes it";

/// A file that says what cannot be.
pub(super) fn broken(e: &ParquetError) -> Unpackable {
    let text = match e {
        ParquetError::General(text) | ParquetError::NYI(text) | ParquetError::EOF(text) => text.clone(),
        other => other.to_string(),
    };
    damaged(&text)
}

/// The same in words.
pub(super) fn damaged(what: &str) -> Unpackable {
    let what = super::super::printable(what);
    Unpackable { what: format!("the Parquet file is damaged or cut off: {what}"), help: FETCH.into() }
}

/// A file that is locked.
pub(super) fn encrypted() -> Unpackable {
    Unpackable {
        what: "an encrypted Parquet file".into(),
        help: "write it again without encryption with the program that has its keys".into(),
    }
}

/// A way to pack that is not read.
pub(super) fn unread_codec(column: &str, codec: &str) -> Unpackable {
    let column = super::super::printable(column);
    Unpackable {
        what: format!("a Parquet file whose column `{column}` is packed by {codec}, which is not read"),
        help: "write it again: duckdb -c \"copy (from 'FILE') to 'NEW.parquet' (codec 'zstd')\"".into(),
    }
}

/// An error about the file at `path`.
pub(super) fn of_file(path: &Path) -> impl Fn(Unpackable) -> Error {
    move |e| Error::input(path, e.what, e.help)
}
