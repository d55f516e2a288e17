//! Many inputs at once: they share the cores, and one that fails does not stop the others.

use std::io::Write;
use std::path::PathBuf;
use std::sync::atomic::{AtomicUsize, Ordering};

use serde::Serialize;

use super::progress::Progress;
use super::table::{columns, row};
use super::{Ending, print, print_json};
use crate::cli::OutputArgs;
use crate::error::Result;
use crate::report::Summary;
use crate::track::{printable, printable_lines};

/// Does `work` for each of `items`, as many at a time as there are threads; results in the order of the items. Where
/// standard error is a terminal it shows how far it is, unless `quiet`.
pub(super) fn for_all<T: Sync, R: Send>(items: &[T], quiet: bool, work: impl Fn(&T) -> R + Sync) -> Vec<R> {
    let next = AtomicUsize::new(0);
    let progress = Progress::new(items.len(), quiet);
    let one_after_the_other = || {
        let mut results = Vec::new();
        // Threads of their own, not tasks of the pool: a task that waits for its parts would take up another file
        // meanwhile, and as many records as there are files would be in memory.
        while let Some((at, item)) =
            Some(next.fetch_add(1, Ordering::Relaxed)).and_then(|at| Some((at, items.get(at)?)))
        {
            results.push((at, work(item)));
            progress.done();
        }
        results
    };
    let workers = rayon::current_num_threads().min(items.len());
    let mut results: Vec<(usize, R)> = std::thread::scope(|scope| {
        let threads: Vec<_> = (0..workers).map(|_| scope.spawn(one_after_the_other)).collect();
        let joined = threads.into_iter().map(|t| t.join().unwrap_or_else(|panic| std::panic::resume_unwind(panic)));
        joined.flatten().collect()
    });
    drop(progress);
    results.sort_by_key(|r| r.0);
    results.into_iter().map(|r| r.1).collect()
}

/// One input of several.
#[derive(Debug, Serialize)]
#[serde(untagged)]
enum Told<'a> {
    Done(&'a Summary),
    Failed { file: String, error: String },
}

/// The inputs of a command.
#[derive(Debug, Serialize)]
struct Set<'a> {
    files: Vec<Told<'a>>,
    failed: usize,
}

/// Tells what came out of several inputs: a table on standard output (or JSON), the errors on standard error.
pub(super) fn tell(
    inputs: &[PathBuf],
    results: &[Result<Summary>],
    outputs: &OutputArgs,
    out: &mut dyn Write,
) -> Result<Ending> {
    let failed = results.iter().filter(|r| r.is_err()).count();
    tell_errors(inputs, results);
    let ending = if failed > 0 { Ending::Failed } else { Ending::Done };
    if outputs.json {
        let files = inputs.iter().zip(results).map(|(input, result)| match result {
            Ok(summary) => Told::Done(summary),
            Err(e) => Told::Failed { file: input.display().to_string(), error: e.to_string() },
        });
        print_json(out, &Set { files: files.collect(), failed })?;
    } else if !outputs.quiet {
        print(out, &text(inputs, results))?;
    }
    Ok(ending)
}

/// The errors of several inputs, on standard error.
pub(super) fn tell_errors<T>(inputs: &[PathBuf], results: &[Result<T>]) {
    let mut stderr = std::io::stderr();
    for (input, error) in inputs.iter().zip(results).filter_map(|(i, r)| Some((i, r.as_ref().err()?))) {
        let (input, error) = (input.display().to_string(), error.to_string());
        // Most errors name the file themselves.
        let whose = if error.contains(&input) { String::new() } else { format!("{input}: ") };
        let _ = writeln!(stderr, "{}", printable_lines(&format!("wildpoint: {whose}{error}")));
    }
}

const HEADER: [&str; 10] =
    ["file", "rows", "channels", "flagged", "isolated", "runs", "repaired", "removed", "suspects", "unchecked"];

fn text(inputs: &[PathBuf], results: &[Result<Summary>]) -> String {
    let mut rows = vec![row(HEADER)];
    let (mut all, mut notes) = ([0_usize; 9], String::new());
    for (input, result) in inputs.iter().zip(results) {
        let name = printable(&input.display().to_string());
        let Ok(summary) = result else {
            rows.push(vec![name, "failed".into()]);
            continue;
        };
        let of = |f: fn(&crate::session::Counts) -> usize| summary.channels.iter().map(|c| f(&c.counts)).sum();
        let numbers = [
            summary.rows,
            summary.channels.len(),
            summary.flagged,
            of(|n| n.isolated),
            of(|n| n.patches),
            of(|n| n.repaired),
            of(|n| n.removed),
            of(|n| n.suspects),
            of(|n| n.unchecked),
        ];
        all.iter_mut().zip(numbers).for_each(|(sum, n)| *sum += n);
        notes.extend(summary.notes.iter().map(|note| format!("note: {name}: {}\n", printable(note))));
        for channel in &summary.channels {
            for warning in &channel.warnings {
                notes += &format!("note: {name}, {}: {}\n", printable(&channel.channel), printable(warning));
            }
        }
        rows.push(std::iter::once(name).chain(numbers.map(|n| n.to_string())).collect());
    }
    let failed = results.iter().filter(|r| r.is_err()).count();
    rows.push(std::iter::once("all".to_owned()).chain(all.map(|n| n.to_string())).collect());
    let mut out = columns(&rows) + &notes;
    if failed > 0 {
        out += &format!("{failed} of {} failed\n", inputs.len());
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn results_come_in_the_order_of_the_items() {
        let items: Vec<usize> = (0..100).collect();
        assert_eq!(for_all(&items, true, |i| i * i), items.iter().map(|i| i * i).collect::<Vec<_>>());
    }
}
