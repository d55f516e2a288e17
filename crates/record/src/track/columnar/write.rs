//! The cleaned copy of a record as a Parquet file.

use std::io::Write;
use std::path::Path;

use super::super::for_each_row;
use super::super::packing::Packing;
use super::super::{Changes, NewColumn, NewRow, Track};
use super::{copy, table};
use crate::error::{Error, Result};

/// How the names of Parquet files end.
const ENDINGS: [&str; 3] = ["parquet", "parq", "pq"];

/// True for a name that ends like those of Parquet files, packed once more or not.
#[must_use]
pub fn names_columns(path: &Path) -> bool {
    let name = path.file_name().map(|n| n.to_string_lossy().to_lowercase()).unwrap_or_default();
    let (name, _) = super::super::unpacked_name(&name);
    name.rsplit_once('.').is_some_and(|(_, ending)| ENDINGS.contains(&ending))
}

/// How the names of files of arrays end.
#[cfg(feature = "hdf5")]
const ARRAYS: [&str; 9] = ["h5", "hdf5", "hdf", "he5", "nc", "nc4", "netcdf", "cdf", "mat"];
#[cfg(not(feature = "hdf5"))]
const ARRAYS: [&str; 0] = [];

/// True for a name that ends like those of files of arrays, which are read and not written.
#[must_use]
pub fn names_arrays(path: &Path) -> bool {
    ending(path).is_some_and(|ending| ARRAYS.contains(&ending.as_str()))
}

fn ending(path: &Path) -> Option<String> {
    path.extension().map(|e| e.to_string_lossy().to_lowercase())
}

/// What a cleaned copy is written as.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum CopyForm {
    /// Text.
    Text,
    /// A Parquet file.
    Columns,
}

/// What the name of a cleaned copy asks for: a Parquet file by its ending, or because it ends like that of the record,
/// which is one; otherwise text.
///
/// # Errors
/// [`Error::Usage`] for the name of a file of arrays where the record is one: such files are not written.
pub fn copy_form(path: &Path, track: &Track) -> Result<CopyForm> {
    let named = path != Path::new(super::super::DASH);
    let packing = track.dialect.packing.filter(|packing| packing.is_columnar() && named);
    let like_own = track.source.path().map(ending) == Some(ending(path));
    match packing {
        _ if names_columns(path) => Ok(CopyForm::Columns),
        Some(packing) if !packing.is_written() && (like_own || names_arrays(path)) => Err(Error::usage(
            format!("{}: {} is read, and not written", path.display(), packing.a_file()),
            "give the cleaned copy a name that ends in .csv or .parquet",
        )),
        Some(packing) if packing.is_written() && like_own => Ok(CopyForm::Columns),
        _ => Ok(CopyForm::Text),
    }
}

/// Columns of flags beside those of a Parquet file.
pub struct FlagForm<'a> {
    /// The columns.
    pub columns: &'a [NewColumn<'a>],
    /// True where all flags are whole numbers.
    pub whole: bool,
    /// What the flags mean, as keys and values.
    pub about: Vec<(String, String)>,
}

/// Writes the record with `changes` (sorted by row and column) and columns of flags as a Parquet file. Of a Parquet file,
/// each part of a column in which nothing changes stays byte for byte, and the others are encoded like before; of text,
/// channels become doubles, times of a calendar timestamps, other whole numbers integers, and what is left strings.
///
/// # Errors
/// [`Error::Input`] when the source is no longer the one that was loaded, and for a change that such a file cannot hold;
/// [`Error::Memory`]; [`Error::Io`] when `out` fails.
pub fn write_columns(
    track: &Track,
    changes: &Changes,
    flags: Option<&FlagForm<'_>>,
    out: &mut dyn Write,
) -> Result<()> {
    let flags = flags.map(|form| Flags::of(track, changes, form)).transpose()?;
    let own = |packing: &Packing| packing.is_columnar() && packing.is_written();
    let bytes = if track.dialect.packing.is_some_and(own) {
        copy::copied(track, changes, flags.as_ref())?
    } else {
        table::table(track, changes, flags.as_ref())?
    };
    out.write_all(&bytes).map_err(Error::io("write the output of", super::super::text::path_of(&track.source)))
}

/// The flags of all rows.
pub(super) struct Flags {
    pub(super) columns: Vec<FlagTexts>,
    pub(super) whole: bool,
    pub(super) about: Vec<(String, String)>,
}

/// The flags of a column.
pub(super) struct FlagTexts {
    pub(super) name: String,
    /// The flags that there are.
    codes: Vec<String>,
    /// For each row, which it is.
    rows: Vec<u8>,
    /// For each new row, which it is.
    new_rows: Vec<u8>,
}

impl FlagTexts {
    fn code(codes: &mut Vec<String>, text: String) -> u8 {
        let at = codes.iter().position(|code| *code == text).unwrap_or(codes.len());
        if at == codes.len() {
            codes.push(text);
        }
        u8::try_from(at).unwrap_or(u8::MAX)
    }

    /// The flag of a row.
    pub(super) fn of_row(&self, row: usize) -> &str {
        &self.codes[self.rows[row] as usize]
    }

    /// The flag of a new row.
    pub(super) fn of_new(&self, index: usize) -> &str {
        &self.codes[self.new_rows[index] as usize]
    }
}

impl Flags {
    fn of(track: &Track, changes: &Changes, form: &FlagForm<'_>) -> Result<Self> {
        let empty = |column: &NewColumn<'_>| FlagTexts {
            name: column.name.clone(),
            codes: Vec::new(),
            rows: Vec::with_capacity(track.rows),
            new_rows: Vec::new(),
        };
        let mut columns: Vec<FlagTexts> = form.columns.iter().map(empty).collect();
        for_each_row(track, |row, cells| {
            for (texts, column) in columns.iter_mut().zip(form.columns) {
                let code = FlagTexts::code(&mut texts.codes, (column.cell)(row, cells));
                texts.rows.push(code);
            }
            Ok(())
        })?;
        let added = |new: &NewRow, columns: &mut Vec<FlagTexts>| {
            for (texts, column) in columns.iter_mut().zip(form.columns) {
                let code = FlagTexts::code(&mut texts.codes, (column.new_row)(new));
                texts.new_rows.push(code);
            }
        };
        changes.rows.iter().for_each(|new| added(new, &mut columns));
        Ok(Self { columns, whole: form.whole, about: form.about.clone() })
    }
}
