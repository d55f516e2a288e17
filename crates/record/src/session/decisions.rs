//! The table of decisions: what the analyst said, with what it was said about. It is made from memory, so that it can
//! be written when the record is gone.

use std::io::Write;

use super::Session;
use super::save::known;
use super::signature::at_text;
use super::table::{CHANNEL, Column, ROW, column, names, write_row};
use crate::error::{Error, Result};
use crate::track::{Track, escape_formula};

/// The columns, in order.
pub const DECISION_COLUMNS: [Column; 8] = [
    ROW,
    column("time", "time of the row, as loaded"),
    CHANNEL,
    column("raw", "measured value, as loaded"),
    column("verdict", "`outlier` (accepted) or `normal` (rejected)"),
    column("note", "note of the analyst"),
    column("by", "name of the analyst; empty where the session does not have it"),
    column("at", "when it was decided, as in `2026-12-01T02:15:00Z`; empty where the session does not have it"),
];

/// Writes the decisions as CSV: row (from 1), time and value as the program knows them, verdict, note, and who
/// decided when.
///
/// # Errors
/// [`Error::Io`] when the table cannot be written.
pub fn decisions(track: &Track, session: &Session, out: &mut dyn Write) -> Result<()> {
    let mut writer = csv::Writer::from_writer(out);
    write_row(&mut writer, &names(&DECISION_COLUMNS))?;
    for plan in &session.plans {
        for (row, decision) in plan.decisions.iter() {
            let (time, value) = known(track, &plan.channel, row as usize);
            let time = if track.time.column.is_some() { time } else { row.to_string() };
            let number = (u64::from(row) + 1).to_string();
            let (channel, note) = (escape_formula(&plan.channel), escape_formula(&decision.note));
            let verdict = decision.ruling.verdict().word();
            let by = escape_formula(decision.signature.by.as_deref().unwrap_or_default());
            let at = at_text(&decision.signature).unwrap_or_default();
            write_row(&mut writer, &[&number, &time, &channel, &value, verdict, &note, &by, &at])?;
        }
    }
    writer.flush().map_err(Error::io("write", "the decisions"))
}
