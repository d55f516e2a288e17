//! How good a result is, where the truth is known.

use crate::analysis::Outcome;
use crate::method::Verdict;
use crate::series::Series;

mod detail;
mod residual;

pub use detail::{Events, FinalError, Part, RunLength, Scores, final_error};
pub use residual::{SplineResidual, spline_residual};

/// Hits and misses against a truth column, over all rows that it marks. Section 1 of `docs/methods.md`.
#[derive(Debug, Clone, Copy, PartialEq, serde::Serialize)]
pub struct Score {
    /// Samples that the truth marks.
    pub wild: usize,
    /// Of those, flagged.
    pub hits: usize,
    /// Of those, not flagged (漏判).
    pub missed: usize,
    /// Flagged, but not marked (误判).
    pub false_alarms: usize,
    /// Rejection rate, eq. (42) of \[001\]: hits / wild, which is also the recall. None when nothing is wild.
    pub rejection_rate: Option<f64>,
    /// Hits / flagged. None when nothing is flagged.
    pub precision: Option<f64>,
}

impl Score {
    /// The score of `outcome`, where `truth` marks the rows that are really wild.
    #[must_use]
    pub fn of(outcome: &Outcome, series: &Series<'_>, truth: &[bool]) -> Self {
        let wild = |position: usize| truth.get(series.row(position)).copied().unwrap_or(false);
        // A marked row without a value cannot be flagged: it counts as missed all the same.
        let all = truth.iter().filter(|t| **t).count();
        let hits = outcome.outliers.iter().filter(|&&i| wild(i)).count();
        debug_assert!(outcome.outliers.iter().all(|&i| outcome.verdict(i) == Verdict::Outlier));
        let flagged = outcome.outliers.len();
        Self {
            wild: all,
            hits,
            missed: all - hits,
            false_alarms: flagged - hits,
            rejection_rate: ratio(hits, all),
            precision: ratio(hits, flagged),
        }
    }
}

/// `a / b`; none when `b` is 0.
#[must_use]
pub fn ratio(a: usize, b: usize) -> Option<f64> {
    #[expect(clippy::cast_precision_loss, reason = "counts are far below 2^53")]
    let ratio = a as f64 / b as f64;
    (b > 0).then_some(ratio)
}
