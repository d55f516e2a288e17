//! What was measured of a channel with wild points of known size, for its section.

use super::Table;
use crate::session::Plan;
use crate::session::detectability::{Detected, two_digits};
use crate::session::measurement::{Comparison, Row};
use crate::track::printable;

/// The methods side by side.
#[derive(Debug)]
pub(in crate::report) struct Compared {
    /// How it was measured, and what is recommended and why.
    pub(in crate::report) lines: Vec<String>,
    /// A row for each method; none where the record could not be asked.
    pub(in crate::report) table: Table,
}

/// The sentence about what the settings of `plan` find; none where it was not measured with them.
pub(super) fn statement(plan: &Plan, unit: &str) -> Option<String> {
    let found = plan.measured.detectability_of(&plan.setup)?;
    let how = format!("measured with wild points put into copies of this record (seed {})", found.seed);
    Some(format!("detectability: {}; {how}", found.in_words(unit)))
}

/// The methods side by side, where they were compared before the session was saved.
pub(super) fn compared(plan: &Plan, unit: &str) -> Option<Compared> {
    let advice = plan.measured.advice.as_deref()?;
    // A record that could not be asked has reasons alone.
    let how = (!advice.rows.is_empty()).then(|| format!("{}; {}", advice.how(), legend(unit)));
    let lines = how.into_iter().chain(advice.reasons.iter().cloned()).collect();
    Some(Compared { lines, table: table(advice) })
}

fn legend(unit: &str) -> String {
    let unit = if unit.is_empty() { "channel units".to_owned() } else { printable(unit) };
    format!(
        "sizes from which on 95 % are found and errors of repair in {unit}; run 2: runs of 2 samples; -: none of the \
         sizes; found: the share of all, weighted by kind; flags: on the record as it is; alone: those \
         that neither half of the methods nor the calibration supports"
    )
}

fn table(advice: &Comparison) -> Table {
    let mut head = vec![("method", false)];
    head.extend(advice.kinds.iter().map(|kind| (kind.short(), true)));
    head.extend([("found", true), ("flags", true), ("alone", true), ("repair", true)]);
    Table { head, rows: advice.rows.iter().map(row).collect(), ..Table::default() }
}

fn row(row: &Row) -> Vec<String> {
    let mut cells = vec![row.method.clone()];
    cells.extend(row.found.iter().map(Detected::cell));
    cells.push(format!("{:.1} %", 100.0 * row.recall));
    cells.extend([row.flagged, row.alone].map(|n| n.to_string()));
    cells.push(row.repair_error.map_or_else(|| "-".to_owned(), two_digits));
    cells
}
