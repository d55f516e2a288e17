//! The options of the commands that put methods side by side.

use clap::Args;

use super::{PrepareArgs, PresetArg, pair};

/// Which methods are put side by side, with which settings.
#[derive(Debug, Clone, Args)]
pub struct CandidateArgs {
    /// Channel with the rate of change of the judged one.
    #[arg(long, value_name = "COLUMN")]
    pub rate: Option<String>,
    /// Only this method; repeatable [default: all].
    #[arg(long, value_name = "ID")]
    pub method: Vec<String>,
    /// Parameter values to start from: those that work on real tracks, or those of the source documents.
    #[arg(long, value_enum, default_value_t = PresetArg::Default)]
    pub preset: PresetArg,
    /// A parameter of one method, or (without ID.) of all methods that have it; repeatable.
    #[arg(long, value_name = "[ID.]KEY=VALUE", value_parser = pair)]
    pub set: Vec<(String, String)>,
    /// Cut the record where more than this many samples are lost in a row.
    #[arg(long, value_name = "N|off")]
    pub max_gap: Option<String>,
    /// What is done with the channel before any of the methods sees it.
    #[command(flatten)]
    pub prepare: PrepareArgs,
}
