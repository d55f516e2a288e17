//! The options of `replay` on an archive.

use std::path::PathBuf;

use clap::Args;

use crate::session::archive::{DecisionsFor, Named};

/// Options of `replay` that are about the record of a session.
const NOT_OF_ARCHIVES: [&str; 10] = [
    "output",
    "flag_columns",
    "changed",
    "flags",
    "diagnostics",
    "report",
    "dry_run",
    "force",
    "accept_changed_data",
    "accept_appended",
];

/// An archive, and what is done with its result.
#[derive(Debug, Clone, Default, Args)]
#[command(next_help_heading = "Archives")]
pub struct ArchiveArgs {
    /// Apply the session to every track of the Parquet or CSV files below DIR, and print the digest of the result. The
    /// rows of a track may be spread over several files, in any order.
    #[arg(long, value_name = "DIR", conflicts_with_all = NOT_OF_ARCHIVES)]
    pub archive: Option<PathBuf>,
    /// Write the result into the session, under `[archive]`.
    #[arg(long, requires = "archive", conflicts_with = "check")]
    pub record: bool,
    /// Column that tells the tracks of the archive apart [default: that of the session; without one each file is a track].
    #[arg(long, requires = "archive", value_name = "COLUMN")]
    pub track: Option<String>,
    /// Column of the time in the archive [default: that of the session].
    #[arg(long, requires = "archive", value_name = "COLUMN")]
    pub time: Option<String>,
    /// Apply the decisions of the session, too, to rows of the same track, time and value; TRACK is the id of the track of
    /// channels that name none. Without this option a session with decisions is refused.
    #[arg(long, requires = "archive", value_name = "TRACK", num_args = 0..=1, require_equals = true, default_missing_value = "")]
    pub decisions: Option<String>,
}

impl ArchiveArgs {
    /// What is said of the columns.
    #[must_use]
    pub fn columns(&self) -> Named {
        Named { time: self.time.clone(), track: self.track.clone(), unit_ns: None }
    }

    /// What is done with decisions.
    #[must_use]
    pub fn decisions(&self) -> DecisionsFor {
        self.decisions.clone().map_or(DecisionsFor::Nobody, DecisionsFor::Track)
    }
}
