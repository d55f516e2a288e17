//! Table 2 of \[001\], whose text survives, with what was measured here beside it.

use super::{FALSE, ISOLATED, PATCH, VARYING, rate};
use crate::experiment::{Cell, Runs, Table};

/// Method, limit, performance and use, as the document has them.
const ROWS: [[&str; 4]; 6] = [
    ["wright", "3 sigma", "simple; good on isolated outliers in much data", "much data, none that vary, in haste"],
    [
        "romanovsky",
        "K(n, alpha) sigma",
        "good, but mean and deviation for each sample",
        "4 to 20 samples, none that vary",
    ],
    ["grubbs", "G(n, alpha) sigma", "the best", "20 to 100 samples, varying ones too"],
    ["chauvenet", "k sigma", "good, at a fairly low cost", "much data, few patches, none that vary"],
    ["odd-even", "3 sigma of the group", "rejects patches; false alarms", "much data, few isolated, varying ones too"],
    ["diff-median", "none", "some effect, patches too; unstable", "data that fluctuate little, varying ones too"],
];

/// The table.
pub(super) fn table(runs: Runs<'_>) -> Table {
    let row = |[method, limit, performance, range]: &[&'static str; 4]| {
        let mut cells: Vec<Cell> = [method, limit, performance, range].map(|text| Cell::text(*text)).to_vec();
        cells.extend([ISOLATED, PATCH, VARYING].map(|kind| Cell::number(rate(runs, method, kind), 0)));
        cells.push(Cell::number(runs.mean(method, FALSE), 1));
        cells
    };
    Table {
        title: "Table 2: what the document says of each criterion, and the rates measured here".into(),
        columns: vec![
            "method",
            "limit",
            "performance",
            "to be used for",
            "isolated %",
            "patch %",
            "varying %",
            "false",
        ],
        rows: ROWS.iter().map(row).collect(),
    }
}
