//! The cleaned file: the input again, with the repaired and removed cells changed and nothing else.

use std::collections::BTreeMap;
use std::io::Write;

use sha2::{Digest, Sha256};

use super::{Outcome, Place};
use crate::error::Result;
use crate::method::Filtered;
use crate::track::{CellChange, Changes, NewRow, Samples, Track, hex, rewrite};

/// What the outcomes change in the file. Each outcome belongs to the channel of that index in the track; `filtered` are the
/// values that the file has in place of the measured ones, for each outcome.
#[must_use]
pub fn changes(track: &Track, outcomes: &[(usize, &Samples, &Outcome)], filtered: &[Option<&Filtered>]) -> Changes {
    let mut cells = Vec::new();
    let mut rows: BTreeMap<Place, NewRow> = BTreeMap::new();
    let filtered = filtered.iter().copied().chain(std::iter::repeat(None));
    for (&(channel, samples, outcome), filtered) in outcomes.iter().zip(filtered) {
        let channel = &track.channels[channel];
        let series = samples.series(channel, &track.time);
        let column = channel.column;
        let mut change = |row: usize, value: Option<f64>| {
            #[expect(clippy::cast_possible_truncation, reason = "the loader refuses files of 2^32 rows and more")]
            cells.push(CellChange { row: row as u32, column, value });
        };
        for (&position, &fix) in outcome.outliers.iter().zip(&outcome.fixes) {
            let filtered = filtered.and_then(|f| f.value.get(position).copied()).filter(|value| value.is_finite());
            change(series.row(position), filtered.or(fix.is_finite().then_some(fix)));
        }
        for (position, &value) in filtered.map_or(&[][..], |f| &f.value).iter().enumerate() {
            if value.is_finite() && outcome.outliers.binary_search(&position).is_err() {
                change(series.row(position), Some(value));
            }
        }
        for fill in &outcome.fills {
            match fill.place {
                Place::Cell(row) => change(row, Some(fill.value)),
                #[expect(clippy::cast_possible_truncation, reason = "the loader refuses files of 2^32 rows and more")]
                Place::NewRow(after, _) => rows
                    .entry(fill.place)
                    .or_insert_with(|| NewRow { after_row: after as u32, seconds: fill.seconds, cells: Vec::new() })
                    .cells
                    .push((column, fill.value)),
            }
        }
    }
    cells.sort_by_key(|c| (c.row, c.column));
    let mut rows: Vec<NewRow> = rows.into_values().collect();
    rows.iter_mut().for_each(|r| r.cells.sort_by_key(|c| c.0));
    Changes { cells, rows }
}

/// Writes the cleaned file and gives the SHA-256 of what was written.
///
/// # Errors
/// When the input cannot be read again or is no longer the one that was loaded, or the output cannot be written.
pub fn write_cleaned(track: &Track, changes: &Changes, out: &mut dyn Write) -> Result<String> {
    let mut hashing = Hashing { out, hash: Sha256::new() };
    rewrite(track, changes, &mut hashing)?;
    Ok(hex(&hashing.hash.finalize()))
}

/// SHA-256 of the cleaned file, which is not written.
///
/// # Errors
/// As [`write_cleaned`].
pub fn clean_sha256(track: &Track, changes: &Changes) -> Result<String> {
    write_cleaned(track, changes, &mut std::io::sink())
}

/// A writer that hashes what passes.
pub(super) struct Hashing<'a> {
    pub(super) out: &'a mut dyn Write,
    pub(super) hash: Sha256,
}

impl Write for Hashing<'_> {
    fn write(&mut self, bytes: &[u8]) -> std::io::Result<usize> {
        let n = self.out.write(bytes)?;
        self.hash.update(&bytes[..n]);
        Ok(n)
    }

    fn flush(&mut self) -> std::io::Result<()> {
        self.out.flush()
    }
}
