//! The audit table: every sample that is not normal or that somebody decided on, with its evidence.

use std::io::Write;

use sha2::{Digest, Sha256};

use super::cleaned::Hashing;
use super::table::{CHANNEL, Column, ROW, TIME, Walk, cell, column, names, time_text, walk, write_row};
use super::{Analysed, Mark, Objected, Run, Session};
use crate::error::{Error, Result};
use crate::method::{Direction, Verdict};
use crate::review::Signature;
use crate::track::{Track, escape_formula};

/// The columns, in order.
pub const COLUMNS: [Column; 17] = [
    ROW,
    TIME,
    CHANNEL,
    column("raw", "measured value"),
    column("verdict", "verdict in effect: `outlier`, `suspect`, `normal` or `unchecked`"),
    column("kind", "`isolated`, or `patch` for a run of two or more outliers"),
    column("run_start", "row in which the run of outliers starts"),
    column("run_length", "number of outliers in the run"),
    column("expected", "value that the method expects"),
    column("tolerance", "distance from the expected value at which a sample is flagged"),
    column("ratio", "distance from the expected value, in tolerances"),
    column("forward", "verdict of the extrapolation from before: `normal` or `abnormal`"),
    column("backward", "verdict of the extrapolation from after"),
    column("clean", "value in the cleaned file"),
    column("action", "`repaired`, `removed` or `kept`"),
    column("decided_by", "`analyst`, `check` or `method`"),
    column("note", "note of the analyst"),
];

/// The columns after those where a check is made before a method: who flagged the sample, and what a check found.
pub const BY_CHECKS: [Column; 2] = [
    column("by", "id of the method or the check that flagged the sample (only with checks)"),
    column("evidence", "what the check found (only with checks)"),
];

/// Writes the audit table as CSV. Missing samples are in the diagnostics, filled or not.
///
/// # Errors
/// When the input cannot be read again, or the table cannot be written.
pub fn flags(track: &Track, session: &Session, analysed: &Analysed, out: &mut dyn Write) -> Result<()> {
    let mut writer = csv::Writer::from_writer(out);
    let checks = session.plans.iter().any(|p| p.setup.preparation.checks_anything());
    let more: &[&str] = if checks { &names(&BY_CHECKS) } else { &[] };
    write_row(&mut writer, &[&names(&COLUMNS), more].concat())?;
    walk(track, session, analysed, |row, cells, channel| {
        let fields = channel.position(row).and_then(|position| of_sample(session, channel, row, position));
        let Some((mut fields, by)) = fields else { return Ok(()) };
        fields[1] = time_text(track, row, cells);
        let by = by.iter().take(more.len());
        let fields: Vec<&str> = fields.iter().chain(by).map(String::as_str).collect();
        write_row(&mut writer, &fields)
    })?;
    writer.flush().map_err(Error::io("write", "the flags"))
}

/// SHA-256 of the audit table, which is not written, in lower-case hexadecimal.
///
/// # Errors
/// As [`flags`].
pub fn flags_sha256(track: &Track, session: &Session, analysed: &Analysed) -> Result<String> {
    let mut nowhere = std::io::sink();
    let mut hashing = Hashing { out: &mut nowhere, hash: Sha256::new() };
    flags(track, session, analysed, &mut hashing)?;
    Ok(crate::track::hex(&hashing.hash.finalize()))
}

/// The columns of a sample, and those of checks.
fn of_sample(
    session: &Session,
    channel: &Walk<'_>,
    row: usize,
    position: usize,
) -> Option<([String; 17], [String; 2])> {
    let e = evidence(session, channel, row, position)?;
    let word = |d: Option<Direction>| d.map_or("", Direction::word).to_owned();
    let fields = [
        e.row.to_string(),
        String::new(),
        escape_formula(channel.name).into_owned(),
        cell(Some(e.raw)),
        e.verdict.word().to_owned(),
        e.run.map_or("", |r| if r.length == 1 { "isolated" } else { "patch" }).to_owned(),
        e.run.map(|r| r.start.to_string()).unwrap_or_default(),
        e.run.map(|r| r.length.to_string()).unwrap_or_default(),
        cell(e.expected.map(|p| channel.outcome.detection.written(p))),
        cell(e.tolerance),
        cell(e.ratio()),
        word(e.forward),
        word(e.backward),
        cell(e.clean),
        e.action().to_owned(),
        e.decided_by().to_owned(),
        escape_formula(&e.note).into_owned(),
    ];
    let evidence = e.objected.as_ref().map(|o| o.evidence.clone()).unwrap_or_default();
    Some((fields, [channel.outcome.detection.by(position).to_owned(), evidence]))
}

/// All that is known about a sample that is not normal or that somebody decided on.
#[derive(Debug, Clone)]
pub struct Evidence {
    /// Data row, from 1.
    pub row: usize,
    /// The measured value.
    pub raw: f64,
    /// What holds.
    pub verdict: Verdict,
    /// How it is marked; none for a sample that nobody marks.
    pub mark: Option<Mark>,
    /// The run of outliers that it belongs to.
    pub run: Option<InRun>,
    /// The expected value.
    pub expected: Option<f64>,
    /// The tolerance; 0 only for a flag (where 0 flags nothing it is none).
    pub tolerance: Option<f64>,
    /// What the extrapolation from before says.
    pub forward: Option<Direction>,
    /// What the extrapolation from after says.
    pub backward: Option<Direction>,
    /// The value in the cleaned file; none where the cell is empty.
    pub clean: Option<f64>,
    /// True when the analyst decided, false when only the method or a check did.
    pub decided: bool,
    /// The check that objects to the sample.
    pub objected: Option<Objected>,
    /// The analyst's note; often empty.
    pub note: String,
    /// By whom and when it was decided; nothing where nobody did.
    pub signature: Signature,
}

/// The place of a sample in a run of outliers.
#[derive(Debug, Clone, Copy)]
pub struct InRun {
    /// Data row (from 1) of the first.
    pub start: usize,
    /// How many they are.
    pub length: usize,
    /// The place of the sample among them, from 1.
    pub place: usize,
}

impl Evidence {
    /// |raw - expected| / tolerance.
    #[must_use]
    pub fn ratio(&self) -> Option<f64> {
        let tolerance = self.tolerance.filter(|h| *h > 0.0);
        self.expected.zip(tolerance).map(|(p, h)| (self.raw - p).abs() / h)
    }

    /// Who has the last word on the sample: `analyst`, `check` or `method`.
    #[must_use]
    pub fn decided_by(&self) -> &'static str {
        match (self.decided, &self.objected) {
            (true, _) => "analyst",
            (false, Some(_)) => "check",
            (false, None) => "method",
        }
    }

    /// What is done with the sample: `repaired`, `removed` or `kept`.
    #[must_use]
    pub fn action(&self) -> &'static str {
        match (self.verdict, self.clean) {
            (Verdict::Outlier, Some(_)) => "repaired",
            (Verdict::Outlier, None) => "removed",
            _ => "kept",
        }
    }
}

/// What is known about the sample of `row` at `position`; none for an undecided normal one.
#[must_use]
pub fn evidence(session: &Session, channel: &Walk<'_>, row: usize, position: usize) -> Option<Evidence> {
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
    let directions = judged.directions().get(position);
    let in_run =
        |r: &Run| InRun { start: channel.series.row(r.start) + 1, length: r.length, place: position - r.start + 1 };
    Some(Evidence {
        row: row + 1,
        raw: channel.series.y[position],
        verdict,
        mark: mark.cloned(),
        run: outcome.run(position).map(in_run),
        expected: judged.expected().get(position).copied().filter(|p| p.is_finite()),
        tolerance: judged.tolerance(position).filter(|h| *h > 0.0 || verdict == Verdict::Outlier),
        forward: directions.and_then(|d| d.forward),
        backward: directions.and_then(|d| d.backward),
        clean: channel.clean(position),
        decided: decision.is_some(),
        objected: outcome.detection.objected(position),
        note: decision.map(|d| d.note.clone()).unwrap_or_default(),
        signature: decision.map(|d| d.signature.clone()).unwrap_or_default(),
    })
}
