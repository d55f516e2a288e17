//! Which test enters which unit, and what a test costs: every test runs once alone, without a mutant.

use std::collections::BTreeSet;
use std::fs;
use std::process::Command;
use std::time::Instant;

use crate::compile::Program;
use crate::pool::pool;
use crate::run::{End, Switch, run};
use crate::tree::{Tree, fault};

/// A test, with what is known of it.
#[derive(Clone, PartialEq, Debug)]
pub struct Test {
    /// Place of its program in the list of programs.
    pub program: usize,
    /// Its whole name.
    pub name: String,
    /// Seconds it took.
    pub cost: f64,
    /// The units it enters.
    pub units: BTreeSet<usize>,
}

/// Processor time that a test may use when nothing is changed, seconds.
const LONG: u64 = 120;

/// All tests of `programs`, on `jobs` threads.
///
/// # Errors
/// Words: a test that fails without a mutant, or what could not be run or read.
pub fn tests(tree: &Tree, programs: &[Program], jobs: usize) -> Result<Vec<Test>, String> {
    let mut names = Vec::new();
    for (at, program) in programs.iter().enumerate() {
        names.extend(listed(tree, program)?.into_iter().map(|name| (at, name)));
    }
    let tests = pool(&names, jobs, |worker, (at, name)| {
        let scratch = tree.scratch.join(worker.to_string());
        let reached = tree.scratch.join(format!("{worker}.reached"));
        fs::write(&reached, "").map_err(fault(&reached))?;
        let begin = Instant::now();
        let end = run(tree, &programs[*at], &[name], Switch::Record(&reached), LONG, &scratch)?;
        let cost = begin.elapsed().as_secs_f64();
        if end != End::Passed {
            return Err(format!("{} of {} fails with no mutant in force: {end:?}", name, programs[*at].name));
        }
        let text = fs::read_to_string(&reached).map_err(fault(&reached))?;
        let units = text.lines().filter_map(|line| line.parse().ok()).collect();
        Ok(Test { program: *at, name: name.clone(), cost, units })
    });
    tests.into_iter().collect()
}

/// The names of the tests of a program that are not ignored.
fn listed(tree: &Tree, program: &Program) -> Result<Vec<String>, String> {
    fs::create_dir_all(&tree.scratch).map_err(fault(&tree.scratch))?;
    let list = |more: &[&str]| -> Result<BTreeSet<String>, String> {
        let mut command = Command::new(&program.path);
        command.args(["--list", "--format", "terse"]).args(more).current_dir(&tree.copy);
        let output = command.output().map_err(|e| format!("{}: {e}", program.path.display()))?;
        let text = String::from_utf8_lossy(&output.stdout).into_owned();
        Ok(text.lines().filter_map(|line| line.strip_suffix(": test")).map(str::to_owned).collect())
    };
    let (all, ignored) = (list(&[])?, list(&["--ignored"])?);
    Ok(all.difference(&ignored).cloned().collect())
}
