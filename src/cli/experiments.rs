//! What can be typed after `simulate`, `reproduce` and `inject`.

use std::path::PathBuf;

use clap::Args;

use super::Load;
use crate::experiment::Plan;
use crate::experiment::inject::{Amount, Patches, Span, Step};

/// Write the data of a published experiment as CSV.
///
/// Columns: the time, the channel, the same channel before the outliers were added (NAME_clean), a rate where the
/// experiment has one, and the truth (1 marks an outlier). The same seed gives the same bytes on every machine. To see
/// how a method fares: wildpoint simulate jin -o jin.csv, then
/// wildpoint clean jin.csv --channel x --reference x_clean.
#[derive(Debug, Clone, Args)]
pub struct SimulateArgs {
    /// Which: demo, jiang, hou-offline, hou-realtime, jin, jin-gps, qin, gan.
    pub experiment: String,
    /// Seed of the random numbers [default: the experiment's own].
    #[arg(long)]
    pub seed: Option<u64>,
    /// Write this many runs, with the seeds S, S+1, ...: one after the other in time with a gap between (so that methods
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
/// Under each table stand the statements of the document: those that hold in the figures measured here, those that do not,
/// and those that cannot be decided here, with the figures. The documents' data are not public; each experiment
/// describes its stand-in.
/// Runs on all cores.
#[derive(Debug, Clone, Args)]
pub struct ReproduceArgs {
    /// Which: jiang, hou-offline, hou-realtime, jin, jin-gps, qin, gan [default: all].
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
    /// Write an HTML file, a page for each document: its figures drawn from our runs, its tables beside ours, its
    /// statements and whether they hold.
    #[arg(long, value_name = "FILE.html", value_parser = html)]
    pub report: Option<PathBuf>,
    /// Overwrite an existing report.
    #[arg(long)]
    pub force: bool,
}

fn html(text: &str) -> Result<PathBuf, String> {
    let path = PathBuf::from(text);
    let ending = path.extension().and_then(|e| e.to_str()).map(str::to_ascii_lowercase);
    match ending.as_deref() {
        Some("html" | "htm") => Ok(path),
        _ => Err("the report is an HTML file: give it the ending .html".to_owned()),
    }
}

/// Add known outliers to a record, to compare methods on it.
///
/// The channel (the first, or the one named with --channel) gets wild points at random places; everything else stays
/// byte for byte. Two columns are added at the right: CHANNEL_raw, the channel as it was, and CHANNEL_truth, in which 1
/// marks a wild point (and what a truth column of the record marked before). Sizes are in sigma
/// of the channel's noise, measured from third differences. Then: wildpoint clean OUT --channel CHANNEL --reference
/// CHANNEL_raw tells how many a method finds and how close its repair comes (steps are in no CHANNEL_raw).
#[derive(Debug, Clone, Args)]
pub struct InjectArgs {
    /// The record.
    pub file: PathBuf,
    /// How to load it.
    #[command(flatten)]
    pub load: Load,
    /// Seed of the random numbers: the same seed puts in the same points.
    #[arg(long, default_value = "1")]
    pub seed: u64,
    /// Isolated outliers: a number, or a share of the samples.
    #[arg(long, value_name = "N|N%", default_value = "1%")]
    pub isolated: Amount,
    /// Runs of adjacent outliers with about the same error: how many runs, and their lengths.
    #[arg(long, alias = "patches", value_name = "NxLOW..HIGH")]
    pub runs: Option<Patches>,
    /// A lasting change of the level, up or down, at a random place or at a number of seconds after the start; repeatable. It
    /// is real: truth does not mark it, and a method that flags it raises a false alarm.
    #[arg(long, value_name = "SIZE[@SECONDS]", allow_hyphen_values = true)]
    pub step: Vec<Step>,
    /// Sizes of the outliers, up or down, in sigma of the noise.
    #[arg(long, value_name = "LOW..HIGH", default_value = "5..20")]
    pub amplitude: Span,
    /// The noise scale in the channel's units [default: measured].
    #[arg(long, value_name = "NUMBER", value_parser = scale)]
    pub sigma: Option<f64>,
    /// Write the record here.
    #[arg(short, long, value_name = "OUT")]
    pub output: PathBuf,
    /// Overwrite an existing output (never the input).
    #[arg(long)]
    pub force: bool,
    /// Print what was put in as JSON.
    #[arg(long)]
    pub json: bool,
}

impl InjectArgs {
    /// What is to be put in.
    #[must_use]
    pub fn plan(&self) -> Plan {
        Plan {
            seed: self.seed,
            isolated: self.isolated,
            patches: self.runs.unwrap_or_default(),
            steps: self.step.clone(),
            amplitude: self.amplitude,
            sigma: self.sigma,
        }
    }
}

fn scale(text: &str) -> Result<f64, String> {
    text.parse().ok().filter(|x: &f64| x.is_finite() && *x > 0.0).ok_or_else(|| "expected a number above 0".to_owned())
}

fn runs(text: &str) -> Result<usize, String> {
    text.parse().ok().filter(|n| (1..=100_000).contains(n)).ok_or_else(|| "expected 1 to 100000 runs".to_owned())
}
