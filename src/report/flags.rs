//! The audit table: every sample that is not normal or that somebody decided on, with its evidence.

use std::io::Write;

use super::{Walk, cell, time_text, walk, write_row};
use crate::error::{Error, Result};
use crate::method::{Direction, Verdict};
use crate::session::{Analysed, Session};
use crate::track::Track;

/// The columns, in order.
const HEADER: [&str; 17] = [
    "row",
    "time",
    "channel",
    "raw",
    "verdict",
    "kind",
    "run_start",
    "run_length",
    "expected",
    "tolerance",
    "ratio",
    "forward",
    "backward",
    "clean",
    "action",
    "decided_by",
    "note",
];

/// Writes the audit table as CSV. Missing samples are in the diagnostics, filled or not.
///
/// # Errors
/// When the input cannot be read again, or the table cannot be written.
pub fn flags(track: &Track, session: &Session, analysed: &Analysed, out: &mut dyn Write) -> Result<()> {
    let mut writer = csv::Writer::from_writer(out);
    write_row(&mut writer, &HEADER)?;
    walk(track, session, analysed, |row, cells, channel| {
        let fields = channel.position(row).and_then(|position| of_sample(session, channel, row, position));
        let Some(mut fields) = fields else { return Ok(()) };
        fields[1] = time_text(track, row, cells);
        let fields: Vec<&str> = fields.iter().map(String::as_str).collect();
        write_row(&mut writer, &fields)
    })?;
    writer.flush().map_err(Error::io("write", "the flags"))
}

fn of_sample(session: &Session, channel: &Walk<'_>, row: usize, position: usize) -> Option<[String; 17]> {
    let outcome = channel.outcome;
    let judged = &outcome.detection.judged;
    let mark = outcome.mark(position);
    let verdict = outcome.verdict(position);
    if mark.is_none() && verdict != Verdict::Unchecked {
        return None;
    }
    let decision = mark
        .and_then(|m| m.ruling)
        .and_then(|_| u32::try_from(row).ok())
        .and_then(|row| session.plans[channel.plan].decisions.get(row));
    let run = outcome.run(position);
    let raw = channel.series.y[position];
    let expected = judged.expected.get(position).copied().filter(|p| p.is_finite());
    let tolerance = judged.tolerance.get(position).copied().filter(|h| *h > 0.0);
    let directions = judged.directions.get(position);
    let clean = channel.clean(position);
    let action = match (verdict, clean) {
        (Verdict::Outlier, Some(_)) => "repaired",
        (Verdict::Outlier, None) => "removed",
        _ => "kept",
    };
    let word = |d: Option<Direction>| d.map_or("", Direction::word).to_owned();
    Some([
        (row + 1).to_string(),
        String::new(),
        channel.name.to_owned(),
        cell(Some(raw)),
        verdict.word().to_owned(),
        run.map_or("", |r| if r.length == 1 { "isolated" } else { "patch" }).to_owned(),
        run.map(|r| (channel.series.row(r.start) + 1).to_string()).unwrap_or_default(),
        run.map(|r| r.length.to_string()).unwrap_or_default(),
        cell(expected),
        cell(tolerance),
        cell(expected.zip(tolerance).map(|(p, h)| (raw - p).abs() / h)),
        word(directions.and_then(|d| d.forward)),
        word(directions.and_then(|d| d.backward)),
        cell(clean),
        action.to_owned(),
        if decision.is_some() { "analyst" } else { "method" }.to_owned(),
        decision.map(|d| d.note.clone()).unwrap_or_default(),
    ])
}
