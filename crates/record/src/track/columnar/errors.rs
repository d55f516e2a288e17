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
    Unpackable::new(format!("the Parquet file is damaged or cut off: {what}"), FETCH)
}

/// A file that is locked.
pub(super) fn encrypted() -> Unpackable {
    Unpackable::new("an encrypted Parquet file", "write it again without encryption with the program that has its keys")
}

/// A file some of whose columns are locked.
pub(super) fn encrypted_columns(names: &[String]) -> Unpackable {
    const TOLD: usize = 8;
    let told: Vec<String> =
        names.iter().take(TOLD).map(|name| format!("`{}`", super::super::printable(name))).collect();
    let more = if names.len() > TOLD { ", …" } else { "" };
    Unpackable::new(
        format!("a Parquet file with encrypted columns: {}{more}", told.join(", ")),
        "write it again without them, or without encryption, with the program that has its keys",
    )
}

/// A way to pack that is not read.
pub(super) fn unread_codec(column: &str, codec: &str) -> Unpackable {
    let column = super::super::printable(column);
    Unpackable::new(
        format!("a Parquet file whose column `{column}` is packed by {codec}, which is not read"),
        "write it again: duckdb -c \"copy (from 'FILE') to 'NEW.parquet' (codec 'zstd')\"",
    )
}

/// An error about the file at `path`.
pub(super) fn of_file(path: &Path) -> impl Fn(Unpackable) -> Error {
    move |e| e.of_file(path)
}
