//! Which missing samples `fill_gaps` wants filled.

use super::{Detection, Place, Rows};
use crate::repair;
use crate::series::{Series, lost_samples};
use crate::stop::{Stop, Stopped};

/// The missing samples just before a present one.
pub(super) struct GapPlaces {
    /// Position of the present sample after them.
    pub(super) before: usize,
    /// Where each goes, and its time in seconds.
    pub(super) at: Vec<(Place, f64)>,
}

/// More new rows than this many per row of the file are a mistake in the settings (for example `max_gap = off`), not a
/// record: such a gap is left open.
const MOST_NEW_ROWS: usize = 4;

/// The gaps inside segments that `fill_gaps` wants filled.
pub(super) fn gaps_to_fill(
    rows: Rows<'_>,
    series: &Series<'_>,
    detection: &Detection,
    stop: &Stop,
) -> Result<Vec<GapPlaces>, Stopped> {
    let with_rows = match detection.setup.repair.word(repair::FILL_GAPS.key) {
        "cells" => false,
        "rows" => true,
        _ => return Ok(Vec::new()),
    };
    let room = if with_rows { rows.count().saturating_mul(MOST_NEW_ROWS) } else { 0 };
    let Rows { seconds, own } = rows;
    let mut finder = Finder { seconds, interval: row_interval(seconds, own), with_rows, room };
    let mut gaps = Vec::new();
    for segment in &detection.segments {
        for before in segment.start + 1..segment.end {
            stop.check_at(before)?;
            // Rows (of the target) after the present sample before the gap, up to the one after it.
            let (first, last) = (series.row(before - 1), series.row(before));
            let at = match own {
                None if last < first => finder.places(first, ((last..first).rev(), first - last)),
                None => finder.places(first, (first + 1..=last, last - first)),
                Some(rows) if last < first => {
                    let before = |row: usize| rows.partition_point(|r| (*r as usize) < row);
                    let between = &rows[before(last)..before(first)];
                    finder.places(first, (between.iter().rev().map(|r| *r as usize), between.len()))
                }
                Some(rows) => {
                    let to = |row: usize| rows.partition_point(|r| *r as usize <= row);
                    let between = &rows[to(first)..to(last)];
                    finder.places(first, (between.iter().map(|r| *r as usize), between.len()))
                }
            };
            if !at.is_empty() {
                gaps.push(GapPlaces { before, at });
            }
        }
    }
    Ok(gaps)
}

/// The nominal interval of the rows that have a usable time.
fn row_interval(seconds: &[f64], own: Option<&[u32]>) -> f64 {
    match own {
        None => Series::new(seconds, seconds).interval.abs(),
        Some(rows) => {
            let times: Vec<f64> = rows.iter().map(|r| seconds[*r as usize]).collect();
            Series::new(&times, &times).interval.abs()
        }
    }
}

/// Finds the places in one gap after the other.
struct Finder<'a> {
    seconds: &'a [f64],
    interval: f64,
    with_rows: bool,
    /// New rows that may still be made.
    room: usize,
}

impl Finder<'_> {
    /// The places between the present samples in row `first` and in the last of the `count` rows after it.
    fn places(&mut self, first: usize, (rows, count): (impl Iterator<Item = usize>, usize)) -> Vec<(Place, f64)> {
        let mut at = Vec::new();
        if count == 1 && !self.with_rows {
            return at;
        }
        let seconds = self.seconds;
        let mut from = first;
        for (place, row) in rows.enumerate().filter(|(_, r)| seconds[*r].is_finite()) {
            let step = seconds[row] - seconds[from];
            let lost = lost_samples(step, self.interval);
            if self.with_rows && lost <= self.room {
                self.room -= lost;
                #[expect(clippy::cast_precision_loss, reason = "counts are far below 2^53")]
                at.extend((0..lost).map(|k| {
                    let part = (k + 1) as f64 / (lost + 1) as f64;
                    // A later row stands before it in a file with the newest row first.
                    let place = if row < from { Place::NewRow(row, lost - 1 - k) } else { Place::NewRow(from, k) };
                    (place, seconds[from] + step * part)
                }));
            }
            if place + 1 < count {
                at.push((Place::Cell(row), seconds[row]));
            }
            from = row;
        }
        at
    }
}
