//! `simulate` and `reproduce`.

use std::io::{IsTerminal, Write};
use std::sync::Mutex;

use super::{Ending, print, print_json, set_threads};
use crate::cli::{ReproduceArgs, SimulateArgs};
use crate::error::{Error, Result};
use crate::experiment::{self, Experiment, Reproduction};
use crate::report::{Reproduced, reproduced_html, reproduction_text};
use crate::track::Outputs;

pub(super) fn simulate(args: &SimulateArgs, out: &mut dyn Write) -> Result<Ending> {
    let experiment = experiment::find(&args.experiment)?;
    let text = experiment.csv(args.seed.unwrap_or(experiment.seed), args.runs);
    let Some(path) = &args.output else { return print(out, &text) };
    let mut files = Outputs::new(args.force, &[]).or_standard_output();
    files.stage(path, |w| w.write_all(text.as_bytes()).map_err(Error::io("write", path)))?;
    files.commit()?;
    Ok(Ending::Done)
}

pub(super) fn reproduce(args: &ReproduceArgs, out: &mut dyn Write) -> Result<Ending> {
    set_threads(args.threads)?;
    let experiments: Vec<&Experiment> = match &args.experiment {
        Some(id) => vec![experiment::find(id)?],
        None => experiment::published().collect(),
    };
    // What is wrong with the path is told before the runs, not after them.
    if let Some(path) = &args.report {
        Outputs::new(args.force, &[]).stage(path, |_| Ok(()))?;
    }
    let progress = Progress::new(&experiments, args.runs);
    let mut results = Vec::new();
    let mut shown = Vec::new();
    for experiment in experiments {
        let result = experiment.reproduce(args.seed, args.runs, &|| progress.step(experiment.id))?;
        if !args.json {
            progress.clear();
            print(out, &told(&result, results.is_empty()))?;
            out.flush().map_err(Error::io("write", "standard output"))?;
        }
        shown.push(if args.report.is_some() { experiment.pictures(result.seed)? } else { Vec::new() });
        results.push(result);
    }
    progress.clear();
    if args.json {
        print_json(out, &results)?;
    }
    if let Some(path) = &args.report {
        let experiments: Vec<Reproduced> =
            results.into_iter().zip(shown).map(|(result, shown)| Reproduced { result, shown }).collect();
        let page = reproduced_html(&experiments);
        let mut files = Outputs::new(args.force, &[]);
        files.stage(path, |w| w.write_all(page.as_bytes()).map_err(Error::io("write", path)))?;
        files.commit()?;
    }
    Ok(Ending::Done)
}

fn told(result: &Reproduction, first: bool) -> String {
    let text = reproduction_text(result);
    if first { text } else { format!("\n{text}") }
}

/// A line on standard error, where that is a terminal: which experiment, and how many runs of all are done.
struct Progress {
    total: usize,
    done: Option<Mutex<usize>>,
}

impl Progress {
    fn new(experiments: &[&Experiment], runs: Option<usize>) -> Self {
        let of = |e: &&Experiment| runs.or(e.reproduction.as_ref().map(|p| p.runs)).unwrap_or(0);
        let shown = std::io::stderr().is_terminal();
        Self { total: experiments.iter().map(of).sum(), done: shown.then(|| Mutex::new(0)) }
    }

    fn step(&self, id: &str) {
        let Some(done) = &self.done else { return };
        let mut done = done.lock().unwrap_or_else(std::sync::PoisonError::into_inner);
        *done += 1;
        let (filled, width) = (20 * *done / self.total.max(1), 20);
        let _ = write!(
            std::io::stderr(),
            "\r{}{} {}/{} runs, {id}\x1b[K",
            "#".repeat(filled),
            ".".repeat(width - filled.min(width)),
            *done,
            self.total
        );
    }

    fn clear(&self) {
        if self.done.is_some() {
            let _ = write!(std::io::stderr(), "\r\x1b[K");
        }
    }
}
