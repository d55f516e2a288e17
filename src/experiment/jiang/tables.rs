//! The tables of \[000\] beside what was measured here.

use super::{CUBICS, FALSE, FLAGGED, MISSED, PRINTED_RESIDUALS, READINGS, ROWS, Row, SPLINE};
use crate::experiment::{Cell, Runs, Table};

/// Table 1, with its two columns of shares.
pub(super) fn one(runs: Runs<'_>) -> Table {
    let printed = |column: usize| ROWS.iter().map(|row| row.printed[column]).sum::<f64>();
    let here = |column: usize| ROWS.iter().map(|row| runs.mean(row.label, column)).sum::<f64>();
    let share = |part: f64, of: f64| Cell::number(100.0 * part / of, 2);
    let cells = |row: &Row| {
        let mut cells = vec![Cell::text(row.label)];
        cells.extend(row.printed.iter().map(|n| Cell::number(*n, 0)));
        cells.extend([MISSED, FALSE].map(|c| share(row.printed[c], printed(c))));
        cells.extend([FLAGGED, MISSED, FALSE].map(|c| Cell::number(runs.mean(row.label, c), 1)));
        cells.extend([MISSED, FALSE].map(|c| share(runs.mean(row.label, c), here(c))));
        cells
    };
    Table {
        title: format!(
            "Table 1: flagged, missed and false of 135 outliers; shares of all that the twelve missed ({} there) and \
             flagged falsely ({})",
            printed(MISSED),
            printed(FALSE)
        ),
        columns: vec![
            "model",
            "[000] flagged",
            "missed",
            "false",
            "missed %",
            "false %",
            "here flagged",
            "missed",
            "false",
            "missed %",
            "false %",
        ],
        rows: ROWS.iter().map(cells).collect(),
    }
}

/// Eq. (2) before and after the rejection.
pub(super) fn residuals(runs: Runs<'_>) -> Table {
    let row = |when: &str, printed: f64, column: usize| {
        vec![Cell::text(when), Cell::number(printed, 2), Cell::number(runs.mean(SPLINE, column), 2)]
    };
    Table {
        title: "Residual against a smoothing spline, eq. (2), m/s".into(),
        columns: vec!["", "[000]", "here"],
        rows: vec![row("before the rejection", PRINTED_RESIDUALS[0], 0), row("after it", PRINTED_RESIDUALS[1], 1)],
    }
}

/// What comes out with other readings of what the document leaves open.
pub(super) fn readings(runs: Runs<'_>) -> Table {
    let row = |label: &'static str, printed: [f64; 3]| {
        let mut cells = vec![Cell::text(label)];
        cells.extend(printed.map(|n| Cell::number(n, 0)));
        cells.extend([FLAGGED, MISSED, FALSE].map(|c| Cell::number(runs.mean(label, c), 1)));
        cells
    };
    let of = |label: &str| ROWS.iter().find(|row| row.label == label).map_or([f64::NAN; 3], |row| row.printed);
    let variable = READINGS.iter().map(|(label, _)| row(label, of(super::BEST)));
    let cubic = CUBICS.iter().map(|(label, _)| row(label, of("third order, both")));
    Table {
        title: "Readings tried, variable order in both directions where nothing else is said".into(),
        columns: vec!["reading", "[000] flagged", "missed", "false", "here flagged", "missed", "false"],
        rows: variable.chain(cubic).collect(),
    }
}
