//! Which missing samples `fill_gaps` wants filled.

use super::{Detection, Place};
use crate::repair;
use crate::track::{Series, Track, lost_samples};

/// The missing samples just before a present one.
pub(super) struct GapPlaces {
    /// Position of the present sample after them.
    pub(super) before: usize,
    /// Where each goes, and its time in seconds.
    pub(super) at: Vec<(Place, f64)>,
}

/// More new rows than this many per row of the file are a mistake in the settings (`max_gap = off`, say), not a
/// record: such a gap is left open.
const MOST_NEW_ROWS: usize = 4;

/// The gaps inside segments that `fill_gaps` wants filled.
pub(super) fn gaps_to_fill(track: &Track, series: &Series<'_>, detection: &Detection) -> Vec<GapPlaces> {
    let with_rows = match detection.setup.repair.word(repair::FILL_GAPS.key) {
        "cells" => false,
        "rows" => true,
        _ => return Vec::new(),
    };
    let seconds = &track.time.seconds;
    let row_interval = Series::new(seconds, seconds).interval;
    let mut room = if with_rows { track.rows.saturating_mul(MOST_NEW_ROWS) } else { 0 };
    let mut gaps = Vec::new();
    for segment in &detection.segments {
        for before in segment.start + 1..segment.end {
            let mut at = Vec::new();
            // Rows with a usable time from the present sample before the gap to the one after it.
            let (first, last) = (series.row(before - 1), series.row(before));
            if last == first + 1 && !with_rows {
                continue;
            }
            let mut from = first;
            for row in (first + 1..=last).filter(|&r| seconds[r].is_finite()) {
                let step = seconds[row] - seconds[from];
                let lost = lost_samples(step, row_interval);
                if with_rows && lost <= room {
                    room -= lost;
                    #[expect(clippy::cast_precision_loss, reason = "counts are far below 2^53")]
                    at.extend((0..lost).map(|k| {
                        let part = (k + 1) as f64 / (lost + 1) as f64;
                        (Place::NewRow(from, k), seconds[from] + step * part)
                    }));
                }
                if row < last {
                    at.push((Place::Cell(row), seconds[row]));
                }
                from = row;
            }
            if !at.is_empty() {
                gaps.push(GapPlaces { before, at });
            }
        }
    }
    gaps
}
