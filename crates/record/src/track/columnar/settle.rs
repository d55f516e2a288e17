//! What a file that stores columns says of its table, where text would have to be looked at.

use std::fs::File;
use std::path::Path;

use super::super::style::Style;
use super::super::text::path_of;
use super::super::{Delimiter, LoadOptions, Source, Track, printable};
use super::access::FileBytes;
use super::errors::of_file;
use super::schema::Schema;
use crate::error::{Error, Result};

impl Source {
    /// The bytes of the source, at any place.
    pub(super) fn file_bytes(&self) -> Result<FileBytes<'_>> {
        match (self, self.file()) {
            (Self::BuiltIn { bytes, .. }, _) => Ok(FileBytes::Memory(bytes)),
            (_, path) => {
                let path = path.unwrap_or(Path::new(""));
                let opened = File::open(path).and_then(|file| FileBytes::of(Box::new(file)));
                opened.map_err(Error::io("read", path))
            }
        }
    }
}

/// The options with the layout of the text that such a file is read as.
pub(crate) fn with_layout(options: &LoadOptions) -> LoadOptions {
    LoadOptions {
        delimiter: Some(Delimiter::Byte(b',')),
        quotes: Some(true),
        decimal_comma: Some(false),
        header_line: Some(1),
        ..options.clone()
    }
}

/// Refuses options that say how text is laid out.
///
/// # Errors
/// [`Error::Usage`] naming the first of them.
pub(crate) fn refuse_layout(options: &LoadOptions, path: &Path) -> Result<()> {
    let told = [
        ("--delimiter", options.delimiter.is_some()),
        ("--decimal-comma", options.decimal_comma.is_some()),
        ("--encoding", options.encoding.is_some()),
        ("--no-header", options.header.is_some()),
        ("--no-quotes", options.quotes.is_some()),
        ("--header-line", options.header_line.is_some()),
        ("--skip", options.skip.is_some()),
        ("--units-line", options.units_line.is_some()),
        ("--comment", options.comment.is_some()),
        ("--table", options.table.is_some()),
    ];
    match told.iter().find(|(_, is_told)| *is_told) {
        None => Ok(()),
        Some((option, _)) => Err(Error::usage(
            format!(
                "{option} says how text is laid out, and {} is a Parquet file",
                printable(&path.display().to_string())
            ),
            "leave it out: the file says what its columns are",
        )),
    }
}

/// Completes a track by what its file says of the columns.
///
/// # Errors
/// When the file can no longer be read.
pub(crate) fn settle(track: &mut Track) -> Result<()> {
    let source = track.source.clone();
    let schema = Schema::of(&source.file_bytes()?).map_err(of_file(&path_of(&source)))?;
    for (style, flat) in track.dialect.styles.iter_mut().zip(&schema.flat) {
        if flat.kind.is_float() {
            // No digit of such a number was chosen by somebody.
            *style = None;
        } else if let Some(decimals) = flat.kind.decimals() {
            *style = Some(Style::with_decimals(decimals));
        }
    }
    if !schema.nested.is_empty() {
        let names: Vec<String> = schema.nested.iter().map(|name| format!("`{}`", printable(name))).collect();
        track.notes.push(format!("not read, and kept in a copy as Parquet: {} (lists or maps)", names.join(", ")));
    }
    Ok(())
}
