//! What a file that stores columns says of its table, where text would have to be looked at.

use std::path::Path;

use super::super::facts::{ColumnFacts, Decimals, Facts};
use super::super::packing::Packing;
use super::super::{Delimiter, LoadOptions, printable};
use super::schema::{Flat, Schema};
use crate::error::{Error, Result};

/// The options with the layout of the text that such a file is read as.
pub(crate) fn with_layout(options: &LoadOptions) -> LoadOptions {
    LoadOptions {
        delimiter: Some(Delimiter::Byte(b',')),
        quotes: Some(true),
        decimal_comma: Some(false),
        header_line: Some(1),
        // It was chosen when the text was made.
        table: None,
        ..options.clone()
    }
}

/// Refuses options that say how text is laid out.
///
/// # Errors
/// [`Error::Usage`] naming the first of them.
pub(crate) fn refuse_layout(options: &LoadOptions, packing: &Packing, path: &Path) -> Result<()> {
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
        ("--table", options.table.is_some() && !packing.holds_tables()),
    ];
    match told.iter().find(|(_, is_told)| *is_told) {
        None => Ok(()),
        Some((option, _)) => Err(Error::usage(
            format!(
                "{option} says how text is laid out, and {} is {}",
                printable(&path.display().to_string()),
                packing.a_file()
            ),
            "leave it out: the file says what its columns are",
        )),
    }
}

/// What a file says of its columns besides their cells.
pub(super) fn facts(schema: &Schema) -> Facts {
    let column = |flat: &Flat| {
        let decimals = match flat.kind.decimals() {
            _ if flat.kind.is_float() => Decimals::AsNeeded,
            Some(decimals) => Decimals::So(decimals),
            None => Decimals::AsShown,
        };
        ColumnFacts { unit: None, decimals, aside: None }
    };
    let names: Vec<String> = schema.nested.iter().map(|name| format!("`{}`", printable(name))).collect();
    let nested = format!("not read, and kept in a copy as Parquet: {} (lists or maps)", names.join(", "));
    let said = if names.is_empty() { Vec::new() } else { vec![nested] };
    Facts { columns: schema.flat.iter().map(column).collect(), time: None, said }
}
