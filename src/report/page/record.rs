//! What a report says of the record and of the result as a whole.

use std::path::Path;

use super::super::{Inspection, Summary};
use super::Table;

/// What came out, in a line.
pub(super) fn outcome(summary: &Summary) -> String {
    let sum = |of: fn(&crate::session::Counts) -> usize| summary.channels.iter().map(|c| of(&c.counts)).sum::<usize>();
    let channels = summary.channels.len();
    let mut line = format!(
        "{} flagged in {channels} channel{}: {} repaired, {} removed",
        summary.flagged,
        if channels == 1 { "" } else { "s" },
        sum(|c| c.repaired),
        sum(|c| c.removed),
    );
    let more = [
        (sum(|c| c.suspects), "suspect"),
        (sum(|c| c.unchecked), "unchecked"),
        (sum(|c| c.filled), "filled"),
        (sum(|c| c.decisions), "decided by the analyst"),
        (sum(|c| c.conflicts), "of those against the method"),
    ];
    for (count, what) in more.into_iter().filter(|(count, _)| *count > 0) {
        line.push_str(&format!(", {count} {what}"));
    }
    line
}

/// Names and values about record and program.
pub(super) fn facts(inspection: &Inspection, summary: &Summary, clean_sha256: &str) -> Vec<(&'static str, String)> {
    let range = inspection.time_range.as_ref().map_or("no usable time".to_owned(), |(a, b)| format!("{a} to {b}"));
    let lasts = inspection.duration_s.map_or(String::new(), |d| format!(" ({} s)", super::super::inspection::short(d)));
    vec![
        ("record", plain(Path::new(&inspection.file))),
        ("layout", inspection.layout.clone()),
        ("rows", inspection.rows.to_string()),
        ("time", format!("{} ({})", inspection.time, inspection.time_words())),
        ("from, to", range + &lasts),
        ("SHA-256 of the record", summary.sha256.clone()),
        ("SHA-256 of the cleaned file", clean_sha256.to_owned()),
        ("made by", summary.program.to_owned()),
    ]
}

/// The columns of the record; what is a channel has its step, losses and noise.
pub(super) fn columns(inspection: &Inspection) -> Table {
    let head = vec![
        ("column", false),
        ("kind", false),
        ("unit", false),
        ("missing", true),
        ("interval / s", true),
        ("lost", true),
        ("segments", true),
        ("lowest", true),
        ("highest", true),
        ("noise", true),
    ];
    let short = |x: Option<f64>| x.map(super::super::inspection::short).unwrap_or_default();
    let row = |c: &super::super::inspection::ColumnFacts| {
        let channel = inspection.channels.iter().find(|f| f.name == c.name);
        let of = |text: &dyn Fn(&super::super::ChannelFacts) -> String| channel.map(text).unwrap_or_default();
        vec![
            c.name.clone(),
            c.kind.to_owned(),
            c.unit.clone(),
            c.missing.to_string(),
            of(&|f| short(f.interval_s)),
            of(&|f| f.lost.to_string()),
            of(&|f| f.segments.to_string()),
            of(&|f| short(f.range.map(|r| r.0))),
            of(&|f| short(f.range.map(|r| r.1))),
            of(&|f| short(f.noise_difference)),
        ]
    };
    Table { head, rows: inspection.columns.iter().map(row).collect(), marks: Vec::new() }
}

/// What could not be used, and what the loader remarked.
pub(super) fn notes(inspection: &Inspection) -> Vec<String> {
    let fault = super::super::inspection::FaultFacts::text;
    inspection.faults.iter().map(fault).chain(inspection.notes.iter().cloned()).collect()
}

/// What is to be known about the command; `alone` when it needs no session.
pub(super) fn command_note(alone: bool) -> String {
    if alone {
        return "Run where the record is found under this name; the cleaned file then has the SHA-256 above.".into();
    }
    "What an analyst decided, and channels that are set up differently, are in a session only: save the one below as \
     session.toml in the folder of this report; the cleaned file then has the SHA-256 above."
        .into()
}

/// A path without the `./` that a session beside its record puts before it.
pub(super) fn plain(path: &Path) -> String {
    path.strip_prefix(".").unwrap_or(path).to_string_lossy().into_owned()
}
