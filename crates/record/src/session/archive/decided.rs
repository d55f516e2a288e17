//! The decisions of a session on the rows of a track: by time and value.

use std::path::Path;

use super::Rows;
use crate::error::{Error, Result};
use crate::review::{Decision, Decisions, Ruling};
use crate::session::document::WrittenDecision;
use crate::track::{NO_MOMENT, TimeAxis, TimeFormat, moment_of, number_of};

/// The decisions about `column`, by the places of the rows.
///
/// # Errors
/// [`Error::Session`] for one that fits no row, or more than one.
pub(super) fn decisions_at(
    path: &Path,
    (column, rows): (&str, &Rows),
    written: &[WrittenDecision],
) -> Result<Decisions> {
    let mut decisions = Decisions::default();
    for decision in written {
        let fault = |what: &str| Error::Session {
            path: path.to_path_buf(),
            line: decision.line,
            what: format!("{column} at {} with the value {}: {what}", decision.time, decision.value),
            help: "apply the decisions to the track that they were made on, or leave --decisions out".into(),
        };
        let value = number_of(&decision.value).ok_or_else(|| fault("the value cannot be read"))?;
        let moment = moment(&decision.time, rows.unit_ns).ok_or_else(|| fault("the time cannot be read"))?;
        let Some(channel) = rows.channels.iter().find(|c| c.name == column) else { continue };
        let fits = |row: &usize| {
            #[expect(clippy::float_cmp, reason = "the decision was made on this value")]
            let same = channel.values[*row] == value;
            rows.moments[*row] == moment && same
        };
        let mut found = (0..rows.moments.len()).filter(fits);
        let row = found.next().ok_or_else(|| fault("no row of the track has both"))?;
        let ruling = Ruling::of_word(&decision.verdict).ok_or_else(|| fault("the verdict cannot be read"))?;
        let row = u32::try_from(row).map_err(|_| fault("too many rows"))?;
        decisions.set(
            row,
            Some(Decision { ruling, note: decision.note.clone(), said: None, signature: decision.signature() }),
        );
    }
    Ok(decisions)
}

/// The moment that the text of a time cell stands for: a number in units of `unit_ns` nanoseconds, or a date and time.
fn moment(text: &str, unit_ns: i64) -> Option<i64> {
    if let Some(value) = number_of(text) {
        return Some(moment_of(value, unit_ns)).filter(|ns| *ns != NO_MOMENT);
    }
    TimeAxis::moment_of_text(text, &TimeFormat::Iso)
}
