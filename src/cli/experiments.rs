//! What can be typed after `simulate` and `reproduce`.

use std::path::PathBuf;

use clap::Args;

/// Write the data of a published experiment as CSV.
///
/// Columns: the time, the channel, the same channel before the outliers were added (NAME_clean), a rate where the
/// experiment has one, and the truth (1 marks an outlier). The same seed gives the same bytes on every machine. To see
/// how a method fares: wildpoint simulate jin -o jin.csv, then
/// wildpoint clean jin.csv --channel x --reference x_clean.
#[derive(Debug, Clone, Args)]
pub struct SimulateArgs {
    /// Which: demo, jiang, hou-offline, hou-realtime, jin, qin, gan.
    pub experiment: String,
    /// Seed of the random numbers [default: the experiment's own].
    #[arg(long)]
    pub seed: Option<u64>,
    /// Write so many runs, with the seeds S, S+1, ...: one after the other in time with a gap between (so that methods
    /// cut there), told apart by a column `run`.
    #[arg(long, value_name = "N", default_value = "1", value_parser = runs)]
    pub runs: usize,
    /// Write to this file instead of standard output.
    #[arg(short, long, value_name = "FILE")]
    pub output: Option<PathBuf>,
    /// Overwrite an existing file.
    #[arg(long)]
    pub force: bool,
}

/// Run the published experiments and print their tables beside ours.
///
/// Under each table stand the statements of the document: those that hold in the figures measured here and those
/// that do not, with the figures. The documents' data are not public; what stands in for them is told with each.
/// Runs on all cores.
#[derive(Debug, Clone, Args)]
pub struct ReproduceArgs {
    /// Which: jiang, hou-offline, hou-realtime, jin, qin, gan [default: all].
    pub experiment: Option<String>,
    /// Seed of the first run; the others follow [default: the experiment's own].
    #[arg(long)]
    pub seed: Option<u64>,
    /// Runs [default: the experiment's own number].
    #[arg(long, value_name = "N", value_parser = runs)]
    pub runs: Option<usize>,
    /// Threads to use; all cores by default.
    #[arg(long, value_name = "N")]
    pub threads: Option<usize>,
    /// Print JSON.
    #[arg(long)]
    pub json: bool,
}

fn runs(text: &str) -> Result<usize, String> {
    text.parse().ok().filter(|n| (1..=100_000).contains(n)).ok_or_else(|| "1 to 100000 runs can be made".to_owned())
}
