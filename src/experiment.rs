//! Simulated records: the same seed gives the same bytes on every machine.

use crate::error::{Error, Result, nearest};

pub mod demo;
mod random;

pub use random::Random;

/// A record that the program can simulate.
#[derive(Debug)]
pub struct Experiment {
    /// Its id on the command line.
    pub id: &'static str,
    /// What it is, in one line.
    pub help: &'static str,
    /// The record as a CSV file.
    pub csv: fn(seed: u64) -> String,
    /// The seed when none is given.
    pub seed: u64,
}

/// Every simulated record.
pub static EXPERIMENTS: &[Experiment] = &[demo::EXPERIMENT];

/// The experiment with this id.
///
/// # Errors
/// [`Error::Usage`] with the experiments there are.
pub fn find(id: &str) -> Result<&'static Experiment> {
    EXPERIMENTS.iter().find(|e| e.id == id).ok_or_else(|| {
        let ids: Vec<&str> = EXPERIMENTS.iter().map(|e| e.id).collect();
        let hint = nearest(id, ids.iter().copied()).map_or(String::new(), |k| format!("did you mean {k}? "));
        Error::usage(format!("{id}: there is no such experiment"), format!("{hint}experiments: {}", ids.join(", ")))
    })
}
