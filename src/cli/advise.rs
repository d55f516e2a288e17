//! The command line of `advise`.

use std::path::PathBuf;

use clap::Args;

use super::{CandidateArgs, Load};
use crate::session::detectability::SEED;

/// The help of `advise`.
pub(super) const ADVISE: &str = "\
     Which method finds most on this record, measured on the record itself.\n\n\
     Copies of the channel receive wild points of known size in calm places: single ones, runs of 2, 5 and 10, and, \
     where the record has such, held values and dropouts; from 1 to 100 times the residual at which its noise ends. Every \
     method judges every copy. The table shows the size from which 95 % are found, for each kind; the share found in \
     all; how many samples of the untouched record are flagged, and how many of those neither half of the methods \
     nor the calibration supports; and how far repaired values are from the original ones. Of a channel with more than 65,536 samples 16 \
     pieces are used.\n\n\
     Kinds weigh in the share as the record itself shows them: a record whose calibration finds many runs of ten asks for \
     runs of ten. The points that are put in are not the record's own wild points: the advice says what would be found, not what is \
     there. Without --channel, the first channel is used, and its name printed.";

/// What `advise` compares.
#[derive(Debug, Clone, Args)]
pub struct AdviseArgs {
    /// The record.
    pub file: PathBuf,
    /// How to load it [default channel: the first].
    #[command(flatten)]
    pub load: Load,
    /// What is compared.
    #[command(flatten)]
    pub candidates: CandidateArgs,
    /// Seed of the random numbers.
    #[arg(long, value_name = "N", default_value_t = SEED)]
    pub seed: u64,
    /// Search settings of this method that find more; threshold and noise scale stay as they are.
    #[arg(long, value_name = "METHOD", conflicts_with = "method")]
    pub tune: Option<String>,
    /// Try no further settings after this many seconds.
    #[arg(long, value_name = "N", default_value_t = 20.0, requires = "tune", value_parser = seconds)]
    pub seconds: f64,
    /// Samples of the untouched record that tuned settings may flag [default: as many as the settings before].
    #[arg(long, value_name = "N", requires = "tune")]
    pub flags: Option<usize>,
    /// Threads to use; all cores by default.
    #[arg(long, value_name = "N")]
    pub threads: Option<usize>,
    /// Print JSON.
    #[arg(long)]
    pub json: bool,
}

fn seconds(text: &str) -> Result<f64, String> {
    let seconds = text.parse().ok().filter(|s: &f64| s.is_finite() && *s > 0.0);
    seconds.ok_or_else(|| "expected a positive number of seconds".to_owned())
}
