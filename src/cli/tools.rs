//! The command lines of `sweep`, `compare` and `stream`.

use std::path::PathBuf;

use clap::{Args, ValueEnum};

use super::{CandidateArgs, Load, OutputArgs, PrepareArgs, PresetArg, Shared, pair};
use crate::error::Result;
use crate::session::sweep::{FROM, STEPS, TO};
use crate::session::{DEFAULT_METHOD, Preset, Setup};

/// The help of `sweep`.
pub(super) const SWEEP: &str = "\
     Count the outliers of a method along one of its parameters, and suggest a threshold.\n\n\
     True wild points lie far from the noise: between them is a range of thresholds that all flag the \
     same samples. The table shows the count for each value of the parameter (the multiplier k or c when none \
     is named). A plateau is a range of at least a factor of 1.5 over which the count is above 0, at most a tenth \
     of the samples, and changes by no more than 1 or 2 %. The suggestion is the first value from the default \
     upwards from which the count stays above 85 % of itself up to 1.4 times the value; it is often the default. \
     Without such a value the command says why. With a truth \
     column the table also shows what is missed and what is flagged falsely. Decisions are ignored. \
     Without --channel, the first channel is used, and its name printed.";

/// What `sweep` goes along.
#[derive(Debug, Clone, Args)]
pub struct SweepArgs {
    /// The record.
    pub file: PathBuf,
    /// How to load it [default channel: the first].
    #[command(flatten)]
    pub load: Load,
    /// What judges it.
    #[command(flatten)]
    pub judge: JudgeArgs,
    /// The parameter [default: k, or c for kalman].
    #[arg(long, value_name = "KEY")]
    pub param: Option<String>,
    /// First value.
    #[arg(long, value_name = "X", default_value_t = FROM, allow_negative_numbers = true)]
    pub from: f64,
    /// Last value.
    #[arg(long, value_name = "X", default_value_t = TO, allow_negative_numbers = true)]
    pub to: f64,
    /// How many values.
    #[arg(long, value_name = "N", default_value_t = STEPS)]
    pub steps: usize,
    /// Values in equal ratios (the default).
    #[arg(long, conflicts_with = "linear")]
    pub log: bool,
    /// Values in equal steps.
    #[arg(long)]
    pub linear: bool,
    /// Threads to use; all cores by default.
    #[arg(long, value_name = "N")]
    pub threads: Option<usize>,
    /// Print JSON.
    #[arg(long)]
    pub json: bool,
}

/// A method with its settings.
#[derive(Debug, Clone, Args)]
pub struct JudgeArgs {
    /// Method (see `wildpoint methods`).
    #[arg(long, value_name = "ID", default_value = DEFAULT_METHOD)]
    pub method: String,
    /// Channel with the rate of change of the judged one, for methods that need it.
    #[arg(long, value_name = "COLUMN")]
    pub rate: Option<String>,
    /// Parameter values to start from: those that work on real tracks, or those of the source documents.
    #[arg(long, value_enum, default_value_t = PresetArg::Default)]
    pub preset: PresetArg,
    /// A parameter of the method; repeatable (see `wildpoint methods ID`).
    #[arg(long, value_name = "KEY=VALUE", value_parser = pair)]
    pub set: Vec<(String, String)>,
    /// What is done with the channel before.
    #[command(flatten)]
    pub prepare: PrepareArgs,
    /// Cut the record where more than this many samples are lost in a row.
    #[arg(long, value_name = "N|off")]
    pub max_gap: Option<String>,
}

/// The help of `compare`.
pub(super) const COMPARE: &str = "\
     Run every applicable method on one channel and put the results side by side.\n\n\
     The table has a row for each method: what it flags (isolated, in runs), its suspects, the samples it \
     could not check, the time it took on one core, and, with a truth column, how much of the truth it found. \
     Below it is the agreement: how many samples are flagged by how many methods. Methods that need a rate \
     channel take part with --rate.\n\n\
     With --votes K a sample is an outlier when at least K of the methods flag it; -o, --flags and \
     --diagnostics write that consensus, repaired by --repair.\n\n\
     Without --channel, the first channel is used, and its name printed.";

/// What `compare` puts side by side.
#[derive(Debug, Clone, Args)]
pub struct CompareArgs {
    /// The record.
    pub file: PathBuf,
    /// How to load it [default channel: the first].
    #[command(flatten)]
    pub load: Load,
    /// What is compared.
    #[command(flatten)]
    pub candidates: CandidateArgs,
    /// A sample is an outlier when at least this many methods flag it.
    #[arg(long, value_name = "K")]
    pub votes: Option<usize>,
    /// Replacement of an outlier of the consensus: linear, remove, spline, polynomial [default: linear].
    #[arg(long, value_name = "ID", requires = "votes")]
    pub repair: Option<String>,
    /// Longest run of outliers that is repaired (0: no limit).
    #[arg(long, value_name = "N", requires = "votes")]
    pub max_fill: Option<String>,
    /// What to write.
    #[command(flatten)]
    pub outputs: OutputArgs,
    /// Threads to use; all cores by default.
    #[arg(long, value_name = "N")]
    pub threads: Option<usize>,
}

/// The help of `stream`.
pub(super) const STREAM: &str = "\
     Judge samples from standard input as they arrive.\n\n\
     One line is written for every sample line that comes in, at once: row, time, value, verdict, expected value \
     and tolerance. Methods: five-point, alpha-beta-gamma, adaptive, template, kalman (without infill), \
     two-sided (forward only). Anything that needs later samples or the whole record is off: look_back, the \
     pooled noise floor, the second direction, the fill of runs; `sigma`, the noise scale, must be a number (the \
     precision of the instrument; `wildpoint inspect` measures it on a record), except for template; `floor` \
     is 0 unless it is a number.\n\n\
     A sample that waits for a model to start is `unchecked` at first. When a start group is complete, and \
     when a run of more than max_run outliers makes the model start again (told on standard error), earlier \
     verdicts are written again in lines with `correction` in the last column (JSON: \"correction\": \
     true). The last line about a row is what the method says of it when it runs over the whole record with \
     these settings and this interval.\n\n\
     Lines that cannot be read get the verdict `unreadable`, those without a value, and those whose \
     time does not lie after the one before, `missing`; both are counted on standard error. Blank lines \
     and comments (# % //) are skipped. Without --interval the nominal interval is the median of the first \
     9 steps; without --time the first three rows are used to find the time column. Output waits until then. Without --channel, the first column of numbers is judged, and its name printed on standard error.";

/// How `stream` reads and judges.
#[derive(Debug, Clone, Args)]
pub struct StreamArgs {
    /// Method: five-point, alpha-beta-gamma, adaptive, template, kalman, two-sided.
    #[arg(long, value_name = "ID", required_unless_present = "session")]
    pub method: Option<String>,
    /// Take method, settings and channel from a saved session.
    #[arg(long, value_name = "SESSION", conflicts_with_all = ["method", "preset"])]
    pub session: Option<PathBuf>,
    /// Parameter values to start from: those that work on real tracks, or those of the source documents.
    #[arg(long, value_enum, default_value_t = PresetArg::Default)]
    pub preset: PresetArg,
    /// A parameter of the method; repeatable (see `wildpoint methods ID`).
    #[arg(long, value_name = "KEY=VALUE", value_parser = pair)]
    pub set: Vec<(String, String)>,
    /// Start again after a gap of more than this many lost samples.
    #[arg(long, value_name = "N|off")]
    pub max_gap: Option<String>,
    /// Nominal interval between samples in seconds [default: the median of the first 9 steps].
    #[arg(long, value_name = "SECONDS")]
    pub interval: Option<f64>,
    /// How lines are written, in and out [default: jsonl when the first line starts with {, else csv].
    #[arg(long, value_enum, value_name = "FORMAT")]
    pub format: Option<FormatArg>,
    /// How to read the lines [default channel: the first].
    #[command(flatten)]
    pub load: Load,
    /// Report nothing on standard error but what ends the stream.
    #[arg(short, long)]
    pub quiet: bool,
}

/// How the lines of a stream are written.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum FormatArg {
    /// Cells with a delimiter, with or without a header.
    Csv,
    /// A JSON object on each line.
    Jsonl,
}

impl JudgeArgs {
    /// Method and settings.
    ///
    /// # Errors
    /// [`crate::error::Error::Usage`] for a name or value that does not fit.
    pub fn setup(&self) -> Result<Setup> {
        let shared = Shared {
            method: self.method.clone(),
            rate: self.rate.clone(),
            preset: self.preset,
            set: self.set.clone(),
            max_gap: self.max_gap.clone(),
            ..Shared::default()
        };
        shared.setup()
    }
}

impl From<PresetArg> for Preset {
    fn from(arg: PresetArg) -> Self {
        match arg {
            PresetArg::Default => Self::Default,
            PresetArg::Paper => Self::Paper,
        }
    }
}
