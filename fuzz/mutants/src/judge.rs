//! Judging the mutants: each against the tests that enter its unit, until one fails.

use crate::list::Mutant;
use crate::outcome::Outcome;
use crate::plan::{batches, module};
use crate::reach::Test;
use crate::run::{End, Switch, run};
use crate::scheme::Scheme;
use crate::tree::Tree;

/// Processor time of a batch, seconds: this many times what it takes without a mutant, but not less than this.
const TIMES: f64 = 10.0;
const LEAST: f64 = 8.0;

/// What came of the mutant at `index` of the list, and by what: the test that failed, or how many passed.
///
/// # Errors
/// Words that say what could not be run.
pub fn judge(
    tree: &Tree,
    scheme: &Scheme,
    tests: &[Test],
    worker: usize,
    (index, mutant): (usize, &Mutant),
) -> Result<(Outcome, String), String> {
    let Some(unit) = scheme.unit.get(&index) else { return Ok((Outcome::Apart, String::new())) };
    let scratch = tree.scratch.join(worker.to_string());
    let mut passed = 0;
    for batch in batches(tests, *unit, &module(&mutant.file)) {
        let names: Vec<&str> = batch.iter().map(|&at| tests[at].name.as_str()).collect();
        let cost: f64 = batch.iter().map(|&at| tests[at].cost).sum();
        let Some(program) = batch.first().and_then(|&at| scheme.programs.get(tests[at].program)) else { continue };
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "seconds: small and positive")]
        let limit = (TIMES * cost).max(LEAST).ceil() as u64;
        match run(tree, program, &names, Switch::Mutant(index), limit, &scratch)? {
            End::Passed => passed += batch.len(),
            End::Failed(test) => return Ok((Outcome::Killed, format!("{} {test}", program.name))),
            End::TooLong => return Ok((Outcome::TimedOut, format!("{} {}", program.name, names.join(" ")))),
        }
    }
    Ok((Outcome::Survived, format!("{passed} tests")))
}
