//! The published experiments: simulated records (the same seed gives the same bytes on every machine), what the
//! documents report of them, and what comes out here; and wild points for records of one's own.
//!
//! Adding an experiment: write `experiment/your_experiment.rs` with an [`Experiment`], and add it to [`EXPERIMENTS`].

use rayon::prelude::*;

use crate::error::{Error, Result, nearest};

pub mod choice;
pub mod demo;
pub mod gan;
pub mod hou_offline;
pub mod hou_realtime;
pub mod inject;
pub mod jiang;
pub mod jin;
pub mod jin_gps;
pub mod qin;
mod random;
pub mod record;
pub mod reproduction;
pub mod shown;
pub mod trial;

pub use choice::{CHOICES, Choice};
pub use inject::{Injection, Plan};
pub use random::Random;
pub use record::{Record, Signal, Wild};
pub use reproduction::{Cell, Figures, Finding, Held, Reproduction, Runs, Table};
pub use shown::{Chart, Curve, Picture, Shown};

/// A record that the program can simulate, and the experiment on it where a document reports one.
#[derive(Debug)]
pub struct Experiment {
    /// Its id on the command line.
    pub id: &'static str,
    /// What it is, in one line.
    pub help: &'static str,
    /// The document it comes from.
    pub source: &'static str,
    /// The record of one run. A run of the experiment with seed `s` has the seeds `s`, `s + 1`, ….
    pub record: fn(seed: u64) -> Record,
    /// The seed when none is given.
    pub seed: u64,
    /// What the document does with the record.
    pub reproduction: Option<Published>,
}

/// The experiment of a document.
#[derive(Debug)]
pub struct Published {
    /// Runs when no number is given.
    pub runs: usize,
    /// What the stand-in for the document's data is, in a few sentences.
    pub stand_in: &'static str,
    /// Judges one run.
    pub trial: fn(&Record) -> Result<Figures>,
    /// Tables and findings from the figures of all runs, in the order of their seeds.
    pub conclude: fn(Runs<'_>) -> (Vec<Table>, Vec<Finding>),
    /// The document's figures from the record of one run.
    pub pictures: fn(&Record) -> Result<Vec<Shown>>,
    /// Its curves from the figures of all runs.
    pub charts: fn(Runs<'_>) -> Vec<Chart>,
}

/// [`Published::charts`] where the document has no curves over runs.
fn no_charts(_: Runs<'_>) -> Vec<Chart> {
    Vec::new()
}

/// Every simulated record.
pub static EXPERIMENTS: &[Experiment] = &[
    demo::EXPERIMENT,
    jiang::EXPERIMENT,
    hou_offline::EXPERIMENT,
    hou_realtime::EXPERIMENT,
    jin::EXPERIMENT,
    jin_gps::EXPERIMENT,
    qin::EXPERIMENT,
    gan::EXPERIMENT,
];

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

impl Experiment {
    /// The records of `runs` runs, the first with `seed`, as a CSV file. One run has no `run` column.
    #[must_use]
    pub fn csv(&self, seed: u64, runs: usize) -> String {
        if runs == 1 {
            return (self.record)(seed).csv();
        }
        let runs: Vec<Record> = seeds(seed, runs).map(self.record).collect();
        record::csv_of_runs(&runs)
    }

    /// Runs the experiment of the document on all cores. `done` is told after each run.
    ///
    /// # Errors
    /// [`Error::Usage`] where no document reports one.
    pub fn reproduce(&self, seed: Option<u64>, runs: Option<usize>, done: &(dyn Fn() + Sync)) -> Result<Reproduction> {
        let Some(published) = &self.reproduction else {
            let ids: Vec<&str> = published().map(|e| e.id).collect();
            let what = format!("{}: no document reports an experiment on it", self.id);
            return Err(Error::usage(what, format!("experiments to reproduce: {}", ids.join(", "))));
        };
        let (seed, runs) = (seed.unwrap_or(self.seed), runs.unwrap_or(published.runs));
        let seeds: Vec<u64> = seeds(seed, runs).collect();
        let run = |&seed: &u64| {
            let figures = (published.trial)(&(self.record)(seed));
            done();
            figures
        };
        // Collected in the order of the seeds: the number of threads changes nothing.
        let figures = seeds.par_iter().map(run).collect::<Result<Vec<_>>>()?;
        let (tables, findings) = (published.conclude)(Runs(&figures));
        Ok(Reproduction {
            id: self.id,
            source: self.source,
            help: self.help,
            stand_in: published.stand_in,
            seed,
            runs,
            tables,
            findings,
            charts: (published.charts)(Runs(&figures)),
        })
    }
}

impl Experiment {
    /// The figures of the document, drawn from the record of this seed.
    ///
    /// # Errors
    /// What judging the record gives.
    pub fn pictures(&self, seed: u64) -> Result<Vec<Shown>> {
        self.reproduction
            .as_ref()
            .map_or_else(|| Ok(Vec::new()), |published| (published.pictures)(&(self.record)(seed)))
    }
}

/// The experiments that documents report.
pub fn published() -> impl Iterator<Item = &'static Experiment> {
    EXPERIMENTS.iter().filter(|e| e.reproduction.is_some())
}

fn seeds(first: u64, runs: usize) -> impl Iterator<Item = u64> {
    (0..runs as u64).map(move |run| first.wrapping_add(run))
}
