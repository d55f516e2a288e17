//! What `compare` prints: one row per method, and how far they agree.

use std::fmt::Write as _;

use serde::Serialize;

use super::table::{columns, row};
use crate::score::Score;
use crate::session::{Agreement, Counts};
use crate::track::printable;

/// What one method says of the channel.
#[derive(Debug, Clone, Serialize)]
pub(super) struct Row {
    /// Its id.
    pub(super) method: &'static str,
    /// Outliers.
    pub(super) flagged: usize,
    /// Outliers alone.
    pub(super) isolated: usize,
    /// Runs of two and more.
    pub(super) patches: usize,
    /// Samples that only one direction objects to.
    pub(super) suspects: usize,
    /// Samples that could not be judged.
    pub(super) unchecked: usize,
    /// Time on one core in milliseconds.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) ms: Option<f64>,
    /// Against the truth, where it is known.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) score: Option<Score>,
}

/// A method that does not take part.
#[derive(Debug, Clone, Serialize)]
pub(super) struct Skipped {
    /// Its id.
    pub(super) method: &'static str,
    /// Why not.
    pub(super) why: &'static str,
}

/// A comparison.
#[derive(Debug, Clone, Serialize)]
pub(super) struct Told {
    /// The record.
    pub(super) file: String,
    /// The channel.
    pub(super) channel: String,
    /// Its present samples.
    pub(super) samples: usize,
    /// A row for each method.
    pub(super) methods: Vec<Row>,
    /// Methods that do not take part.
    pub(super) skipped: Vec<Skipped>,
    /// From one method to all of them.
    pub(super) agreement: Vec<Agreement>,
    /// Methods that flag exactly the same samples.
    pub(super) groups: Vec<Vec<&'static str>>,
    /// The consensus, where it was asked for.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) consensus: Option<Row>,
}

impl Row {
    pub(super) fn of(method: &'static str, counts: &Counts, ms: Option<f64>, score: Option<Score>) -> Self {
        Self {
            method,
            flagged: counts.flagged,
            isolated: counts.isolated,
            patches: counts.patches,
            suspects: counts.suspects,
            unchecked: counts.unchecked,
            ms,
            score,
        }
    }

    fn cells(&self) -> Vec<String> {
        let mut cells = vec![self.method.to_owned()];
        cells.extend([self.flagged, self.isolated, self.patches, self.suspects, self.unchecked].map(|n| n.to_string()));
        cells.push(self.ms.map_or(String::new(), |ms| format!("{ms:.1}")));
        if let Some(score) = &self.score {
            let percent = |share: Option<f64>| share.map_or_else(|| "-".to_owned(), |s| format!("{:.1}", 100.0 * s));
            cells.extend([score.missed.to_string(), score.false_alarms.to_string()]);
            cells.extend([percent(score.rejection_rate), percent(score.precision)]);
        }
        cells
    }
}

impl Told {
    /// The tables for people; `note` follows the name of the channel.
    pub(super) fn text(&self, note: &str) -> String {
        let mut out = format!("{}: {} samples{note}\n\n", printable(&self.channel), self.samples);
        let mut header = row(["method", "flagged", "isolated", "runs", "suspects", "unchecked", "ms"]);
        if self.methods.iter().any(|m| m.score.is_some()) {
            header.extend(row(["missed", "false alarms", "recall %", "precision %"]));
        }
        let mut rows = vec![header];
        rows.extend(self.methods.iter().chain(&self.consensus).map(Row::cells));
        out += &columns(&rows);
        for skipped in &self.skipped {
            let _ = writeln!(out, "{}: {}", skipped.method, skipped.why);
        }
        out.push('\n');
        let mut rows = vec![row(["methods that flag a sample", "exactly", "at least"])];
        for a in &self.agreement {
            rows.push(vec![a.methods.to_string(), a.exactly.to_string(), a.at_least.to_string()]);
        }
        out += &columns(&rows);
        for group in &self.groups {
            let _ = writeln!(out, "the same samples: {}", group.join(", "));
        }
        out
    }
}
