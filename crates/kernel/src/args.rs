//! The command line.

use std::path::PathBuf;

use clap::{Parser, ValueEnum};
use wildpoint_kernel::Emit;

/// Apply a session to the tracks of an Arrow IPC stream.
///
/// Standard input is a stream with the columns of time, track and channels by name, nulls missing. The rows of a track
/// stand together and in the order of time; rows of the same time may come in any order. Batches may be cut anywhere.
/// Standard output is a stream, too. One track at a time is in memory, and the ids of those that are done.
///
/// Channels that the session does not name are handed on unchanged. Exit status 2: nothing more was written after the
/// error on standard error.
#[derive(Debug, Clone, Parser)]
#[command(name = "wildpoint-kernel", version)]
#[command(before_help = "Example: wildpoint-kernel --session s.toml --track pass --time t < in.arrows > out.arrows")]
pub(crate) struct Args {
    /// The session: which methods with which settings, by the names of channels.
    #[arg(long, value_name = "FILE")]
    pub session: PathBuf,
    /// Column that tells tracks apart [default: that of the session; without one all rows are one track].
    #[arg(long, value_name = "COLUMN")]
    pub track: Option<String>,
    /// Column of the time: a timestamp, or a number [default: that of the session].
    #[arg(long, value_name = "COLUMN")]
    pub time: Option<String>,
    /// Unit of a time that is a number [default: that of the session, or seconds].
    #[arg(long, value_enum, value_name = "UNIT")]
    pub time_unit: Option<Unit>,
    /// What goes out.
    #[arg(long, value_enum, default_value_t = Emit::Samples)]
    pub emit: Emit,
    /// Apply the decisions of the session, too, to rows of the same track, time and value; TRACK is the id of the track
    /// of channels that name none (no id: that of a stream without tracks). Without this option a session with decisions
    /// is refused: they belong to one record.
    #[arg(long, value_name = "TRACK", num_args = 0..=1, require_equals = true, default_missing_value = "")]
    pub decisions: Option<String>,
    /// Threads to use; an engine starts a kernel for each core.
    #[arg(long, value_name = "N", default_value_t = 1)]
    pub threads: usize,
}

/// Units of time.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(crate) enum Unit {
    /// Seconds.
    S,
    /// Milliseconds.
    Ms,
    /// Microseconds.
    Us,
    /// Nanoseconds.
    Ns,
}

impl Unit {
    pub(crate) fn ns(self) -> i64 {
        match self {
            Self::S => 1_000_000_000,
            Self::Ms => 1_000_000,
            Self::Us => 1_000,
            Self::Ns => 1,
        }
    }
}
