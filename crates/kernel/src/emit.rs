//! What goes out.

use clap::ValueEnum;

/// What goes out.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum Emit {
    /// The rows of the input with `CHANNEL_verdict` and `CHANNEL_clean`.
    Samples,
    /// A row for each sample that is not normal: the columns of `wildpoint clean --flags`.
    Flags,
    /// A row for each track and channel: counts and digest.
    Summary,
}
