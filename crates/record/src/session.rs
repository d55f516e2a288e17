//! The session: all that changes a result, and the pipeline from it to that result. The screen edits it, `replay`
//! renders it; this is the only place where method, review and repair meet.

use std::path::PathBuf;

use crate::review::Decisions;
use crate::track::{LoadOptions, Lost, Source, Track};

mod analysis;
pub mod archive;
mod changed;
mod cleaned;
mod command_line;
mod decisions;
pub mod detectability;
mod digest;
mod document;
mod edit;
mod flag_columns;
pub mod flags;
pub mod journal;
pub mod measurement;
mod output_value;
mod position;
mod replay;
mod save;
mod scheme;
mod signature;
mod suggested;
pub mod sweep;
pub mod table;

pub use analysis::{Member, detect, detect_taught, detect_together, settle};
pub use changed::{CHANGED_COLUMNS, changed};
pub use cleaned::{changes, clean_sha256, write_cleaned};
pub use command_line::{clean_command, quoted, replay_command};
pub use decisions::{DECISION_COLUMNS, decisions};
pub use digest::Digest;
pub use document::{parse, read, render};
pub use edit::Edit;
pub use flag_columns::{FlagColumn, flag_columns, write_flagged, write_flagged_columns};
pub use measurement::Measurement;
pub use output_value::{OutputValue, check_value, filtered, unfiltered};
pub use position::position_check;
pub use replay::{Accepted, Analysed, Appended, Grown, Opened, check, open, open_all};
pub use save::{document, document_without_record};
pub use scheme::{Quality, SCHEMES, Scheme, schemes_table};
pub use signature::signature_words;
pub use suggested::{suggested, suggestions};
pub use wildpoint_core::analysis::{Counts, Detection, Fill, Mark, Objected, Outcome, Place, Run};
pub use wildpoint_core::ballot::{Agreement, Ballot, candidates};
pub use wildpoint_core::preparation::{Preparation, is_period, parse_period};
pub use wildpoint_core::setup::{DEFAULT_METHOD, Preset, Setup, method_of_id};
pub use wildpoint_core::suggestions::{Remedy, Suggestion};

/// A document: which data, what to do with which channel, and what came out when it was saved.
#[derive(Debug, Clone)]
pub struct Session {
    /// The record it belongs to.
    pub data: Data,
    /// One plan for each channel that is worked on.
    pub plans: Vec<Plan>,
    /// Which values the cleaned file has.
    pub value: OutputValue,
    /// What came out when it was saved.
    pub result: Option<Recorded>,
}

/// The record of a session.
#[derive(Debug, Clone)]
pub struct Data {
    /// Where the record is.
    pub source: Source,
    /// SHA-256 of its bytes, lower-case hexadecimal.
    pub sha256: String,
    /// How many bytes those are: rows that were appended to the file later are not of the session. None in sessions of
    /// format 1.
    pub bytes: Option<u64>,
    /// Its data rows.
    pub rows: usize,
    /// Why the record could not be read when the session was saved, if it could not: decisions then have the time and
    /// the value as the program knew them, not the texts of the cells.
    pub record_was: Option<Lost>,
    /// Sums that name the row when a single one has changed; not in sessions written by hand.
    pub row_check: Option<String>,
    /// How to load it.
    pub options: LoadOptions,
}

/// What to do with one channel. Two are equal when they lead to the same result, whatever was measured.
#[derive(Debug, Clone)]
pub struct Plan {
    /// Name of the channel.
    pub channel: String,
    /// The machine's part.
    pub setup: Setup,
    /// The analyst's part.
    pub decisions: Decisions,
    /// What was measured of the channel with wild points of known size.
    pub measured: Measurement,
}

impl PartialEq for Plan {
    fn eq(&self, other: &Self) -> bool {
        self.channel == other.channel && self.setup == other.setup && self.decisions == other.decisions
    }
}

/// What came out when the session was saved.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Recorded {
    /// Outliers in all channels, after the analyst's decisions.
    pub flagged: usize,
    /// SHA-256 of the cleaned file.
    pub clean_sha256: String,
    /// SHA-256 of the audit table; none in sessions of format 1.
    pub flags_sha256: Option<String>,
}

impl Plan {
    /// A plan of a channel of which nothing was measured.
    #[must_use]
    pub fn new(channel: String, setup: Setup, decisions: Decisions) -> Self {
        Self { channel, setup, decisions, measured: Measurement::default() }
    }
}

impl Session {
    /// A session on `track` with one plan for each of its channels.
    #[must_use]
    pub fn new(track: &Track, mut options: LoadOptions, setup: &Setup) -> Self {
        // What was recognised is recorded, so that a later version recognises nothing else.
        options.time.get_or_insert_with(|| match track.time.column {
            Some(_) if !track.time.part_columns.is_empty() => {
                let names: Vec<&str> =
                    track.time.part_columns.iter().map(|c| track.columns[*c].name.as_str()).collect();
                names.join(",")
            }
            Some(column) => track.columns[column].name.clone(),
            None => "sample".into(),
        });
        if let Some(column) = track.track_column() {
            options.track.get_or_insert_with(|| track.columns[column].name.clone());
        }
        let plan = |name: &str| Plan::new(name.to_owned(), setup.clone(), Decisions::default());
        Self {
            data: Data {
                source: track.source.clone(),
                sha256: track.sha256.clone(),
                bytes: Some(track.bytes),
                rows: track.rows,
                record_was: None,
                row_check: None,
                options,
            },
            plans: track.channels.iter().map(|c| plan(&c.name)).collect(),
            value: OutputValue::default(),
            result: None,
        }
    }
}

/// A path without folders that it enters only to leave them again: it is read by people, and from it the names of
/// outputs are made. A link is kept with the `..` after it, which leads to where the link points.
fn tidied(path: &std::path::Path) -> PathBuf {
    use std::path::Component;
    let mut out = PathBuf::new();
    for part in path.components() {
        let entered = matches!(out.components().next_back(), Some(Component::Normal(_)));
        if part == Component::ParentDir && entered && !out.is_symlink() {
            out.pop();
        } else {
            out.push(part);
        }
    }
    if out.as_os_str().is_empty() { PathBuf::from(".") } else { out }
}

/// The folder a path lies in, `.` for a bare name.
#[must_use]
pub fn folder_of(path: &std::path::Path) -> PathBuf {
    match path.parent() {
        Some(p) if !p.as_os_str().is_empty() => p.to_path_buf(),
        _ => PathBuf::from("."),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_path_enters_no_folder_to_leave_it_again() {
        let given = ["/a/b/../../c/d.csv", "../c/d.csv", "a/../d.csv", "d.csv"];
        let made = given.map(|p| tidied(std::path::Path::new(p)).display().to_string());
        assert_eq!(made, ["/c/d.csv", "../c/d.csv", "d.csv", "d.csv"]);
    }
}
