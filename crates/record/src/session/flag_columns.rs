//! Columns of flags beside the channels of the cleaned file.

use std::io::Write;

use sha2::{Digest, Sha256};

use super::cleaned::Hashing;
use super::scheme::{Quality, Scheme};
use super::{Analysed, Outcome, Place};
use crate::error::Result;
use crate::method::Verdict;
use crate::track::{
    Cell, Cells, Changes, Channel, FlagForm, NewColumn, NewRow, Reading, Samples, TimeAxis, Track, hex, rewrite_beside,
    write_columns,
};

/// The flags of one column of the file.
#[derive(Debug)]
pub struct FlagColumn {
    /// Its name: that of the judged column with `_flag` after it, and a number where that is taken.
    pub name: String,
    /// Index of the judged column in [`Track::columns`].
    pub column: usize,
    /// What is known about the cell of each row; none for a row of a track that was not loaded.
    qualities: Vec<Option<Quality>>,
}

impl FlagColumn {
    /// What is known about the cell of a row.
    fn quality(&self, row: usize, cells: &Cells<'_>, reading: &Reading) -> Quality {
        let of_cell = || match reading.cell(cells.text(self.column).trim().as_bytes()) {
            Cell::Number(_) => Quality::Unchecked,
            Cell::Missing | Cell::Infinite | Cell::Text => Quality::Missing,
        };
        self.qualities.get(row).copied().flatten().unwrap_or_else(of_cell)
    }
}

/// A column of flags for each column of the file that is judged.
#[must_use]
pub fn flag_columns(track: &Track, analysed: &Analysed) -> Vec<FlagColumn> {
    let mut columns: Vec<FlagColumn> = Vec::new();
    let mut places: Vec<usize> = analysed.channels.iter().map(|(c, _, _)| track.channels[*c].column).collect();
    places.sort_unstable();
    places.dedup();
    for column in places {
        let taken: Vec<&str> =
            track.columns.iter().map(|c| c.name.as_str()).chain(columns.iter().map(|c| c.name.as_str())).collect();
        let name = free_name(&track.columns[column].name, &taken);
        let mut qualities = vec![None; track.rows];
        for channel in track.channels.iter().filter(|c| c.column == column) {
            unjudged(channel, &mut qualities);
        }
        for (index, samples, outcome) in &analysed.channels {
            let channel = &track.channels[*index];
            if channel.column == column {
                judged(channel, &track.time, (samples, outcome), &mut qualities);
            }
        }
        columns.push(FlagColumn { name, column, qualities });
    }
    columns
}

/// A name that no column has.
fn free_name(column: &str, taken: &[&str]) -> String {
    let name = format!("{column}_flag");
    let numbered = (2..).map(|n| format!("{name}_{n}"));
    let mut names = std::iter::once(name.clone()).chain(numbered);
    names.find(|name| !taken.contains(&name.as_str())).unwrap_or_default()
}

/// The rows of a channel before it is judged.
fn unjudged(channel: &Channel, qualities: &mut [Option<Quality>]) {
    let mut mark = |row: usize, value: f64| {
        let quality = if value.is_finite() { Quality::Unchecked } else { Quality::Missing };
        qualities[row] = Some(quality);
    };
    match &channel.target {
        None => channel.values.iter().enumerate().for_each(|(row, value)| mark(row, *value)),
        Some(target) => target.rows.iter().zip(&channel.values).for_each(|(row, value)| mark(*row as usize, *value)),
    }
}

fn judged(
    channel: &Channel,
    time: &TimeAxis,
    (samples, outcome): (&Samples, &Outcome),
    qualities: &mut [Option<Quality>],
) {
    let series = samples.series(channel, time);
    for position in 0..series.len() {
        let quality = match (outcome.verdict(position), outcome.fix(position)) {
            (Verdict::Outlier, Some(fix)) if fix.is_finite() => Quality::Repaired,
            (Verdict::Outlier, _) => Quality::Removed,
            (Verdict::Suspect, _) => Quality::Suspect,
            (Verdict::Normal, _) => Quality::Normal,
            (Verdict::Unchecked | Verdict::Missing, _) => Quality::Unchecked,
        };
        qualities[series.row(position)] = Some(quality);
    }
    for fill in &outcome.fills {
        if let Place::Cell(row) = fill.place {
            qualities[row] = Some(Quality::Filled);
        }
    }
}

/// Gives the columns of flags to `write`, as they are added to a table.
fn with_columns<T>(
    track: &Track,
    flags: &[FlagColumn],
    scheme: &Scheme,
    write: impl FnOnce(&[NewColumn<'_>]) -> Result<T>,
) -> Result<T> {
    let reading = Reading::new(track.dialect.decimal_comma, &track.dialect.missing);
    let cells: Vec<_> = flags
        .iter()
        .map(|flag| {
            let reading = &reading;
            let cell = move |row: usize, cells: &Cells<'_>| scheme.code(flag.quality(row, cells, reading)).to_owned();
            let new_row = move |new: &NewRow| {
                let filled = new.cells.iter().any(|(column, _)| *column == flag.column);
                scheme.code(if filled { Quality::Filled } else { Quality::Missing }).to_owned()
            };
            (flag.name.clone(), cell, new_row)
        })
        .collect();
    let columns: Vec<NewColumn<'_>> =
        cells.iter().map(|(name, cell, new_row)| NewColumn { name: name.clone(), cell, new_row }).collect();
    write(&columns)
}

/// Writes the cleaned file with columns of flags at its right and gives the SHA-256 of what was written.
///
/// # Errors
/// When the input cannot be read again, is no longer the one that was loaded, or has a row of more cells than columns,
/// or the output cannot be written.
pub fn write_flagged(
    track: &Track,
    (changes, flags): (&Changes, &[FlagColumn]),
    scheme: &Scheme,
    out: &mut dyn Write,
) -> Result<String> {
    let mut hashing = Hashing { out, hash: Sha256::new() };
    with_columns(track, flags, scheme, |columns| rewrite_beside(track, changes, columns, &mut hashing))?;
    Ok(hex(&hashing.hash.finalize()))
}

/// Writes the cleaned record with columns of flags as a Parquet file. What the flags mean stands in its metadata, under
/// the name of the column and of an attribute of CF with a colon between them, as in CDL.
///
/// # Errors
/// As [`write_columns`].
pub fn write_flagged_columns(
    track: &Track,
    (changes, flags): (&Changes, &[FlagColumn]),
    scheme: &Scheme,
    out: &mut dyn Write,
) -> Result<()> {
    let mut about = Vec::new();
    for flag in flags {
        about.push((format!("{}:ancillary_variables", track.columns[flag.column].name), flag.name.clone()));
        about.extend(scheme.attributes().map(|(attribute, value)| (format!("{}:{attribute}", flag.name), value)));
    }
    with_columns(track, flags, scheme, |columns| {
        let form = FlagForm { columns, whole: scheme.is_whole(), about };
        write_columns(track, changes, Some(&form), out)
    })
}
