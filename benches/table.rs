//! The table of `docs/benchmarks.md`: what the other benchmarks of this run measured, beside the budgets. It runs last:
//! `WILDPOINT_UPDATE=1 cargo bench` measures everything and writes the table, `cargo bench` shows it.

#![expect(clippy::print_stdout, clippy::print_stderr, reason = "a table is shown")]

use std::path::{Path, PathBuf};

/// A job with its budget.
struct Job {
    /// What is done.
    what: &'static str,
    /// Where its figure lies under `target/criterion`.
    at: &'static str,
    /// What it may take on two cores, in milliseconds.
    budget: f64,
}

const fn job(what: &'static str, at: &'static str, budget: f64) -> Job {
    Job { what, at, budget }
}

/// Every job with a budget, in the order of the table.
const JOBS: &[Job] = &[
    job("load a two-column CSV, 1e6 rows (19 MB)", "file/load/1000000", 40.0),
    job("load by the rules of sessions without `rules = 2`, 1e6 rows", "file/load, first rules/1000000", 40.0),
    job("load, 1e7 rows (205 MB)", "file/load/10000000", 400.0),
    job("load, gzipped, 1e6 rows", "file/load, gzipped/1000000", 120.0),
    job("load, all cells quoted, 1e6 rows", "file/load, quoted/1000000", 80.0),
    job("write the cleaned file, 1e6 rows", "file/write cleaned/1000000", 50.0),
    job("load, `hampel`, repair, write, 1e6 rows", "file/load, hampel, repair, write/1000000", 150.0),
    job("from the file to the first frame, 1e6 rows", "from file to frame/first frame/1000000", 120.0),
    job("from the file to the first frame, 1e7 rows", "from file to frame/first frame/10000000", 500.0),
    job("threshold step of `hampel`, key to frame, 1e6", "from key to frame/step, hampel/1000000", 16.0),
    job("threshold step of `hampel`, key to frame, 1e7", "from key to frame/step, hampel/10000000", 60.0),
    job("threshold step of `two-sided`, key to frame, 1e6", "from key to frame/step, two-sided/1000000", 100.0),
    job("a frame, 1e6 samples, 5 % flagged", "1e6, 5 % flagged/frame_ raw, expected, band, repaired, fit kept", 1.0),
    job("a frame, 1e7 samples, 5 % flagged", "1e7, 5 % flagged/frame_ raw, expected, band, repaired, fit kept", 2.0),
    job("calibration of a channel, 1e6", "calibration/of a channel/1000000", 60.0),
    job("calibration of a channel, 1e7", "calibration/of a channel/10000000", 500.0),
    job("`hampel`, window 21, 1e6, calibrated (as all below)", "method at its defaults/hampel/1000000", 40.0),
    job("`hampel`, window 501", "budget/hampel, window 501/1000000", 160.0),
    job("`median-window`, window 11, plain", "budget/median-window, window 11, plain/1000000", 20.0),
    job("`mean-window`, window 11, plain", "budget/mean-window, window 11, plain/1000000", 10.0),
    job("`poly-window`, window 21", "budget/poly-window, window 21/1000000", 60.0),
    job("`trend-wright`", "method at its defaults/trend-wright/1000000", 50.0),
    job("`romanovsky`", "method at its defaults/romanovsky/1000000", 60.0),
    job("`grubbs`", "method at its defaults/grubbs/1000000", 60.0),
    job("`gesd`", "method at its defaults/gesd/1000000", 60.0),
    job("`five-point`", "method at its defaults/five-point/1000000", 12.0),
    job("`alpha-beta-gamma`", "method at its defaults/alpha-beta-gamma/1000000", 12.0),
    job("`adaptive`", "method at its defaults/adaptive/1000000", 25.0),
    job("`kalman`", "method at its defaults/kalman/1000000", 40.0),
    job("`two-sided`, both directions", "method at its defaults/two-sided/1000000", 40.0),
    job("`diff-median`", "method at its defaults/diff-median/1000000", 120.0),
    job("`matched`, window 31", "budget/matched, window 31/1000000", 250.0),
    job("infill by polynomials", "budget/infill, polynomial/1000000", 12.0),
    job("infill by splines", "budget/infill, spline/1000000", 12.0),
    job("the first advice on all methods, 1e5", "advice/first/100000", 2000.0),
    job("the complete advice, 1e5", "advice/complete/100000", 8000.0),
    job("the complete advice, 1e7 (16 pieces)", "advice/complete/10000000", 20_000.0),
];

/// What the first frame on 1e7 rows may hold in memory at most, in MB.
const MEMORY: f64 = 250.0;

/// The folder in which criterion keeps its figures.
fn figures() -> Option<PathBuf> {
    let program = std::env::current_exe().ok()?;
    program.ancestors().map(|folder| folder.join("criterion")).find(|folder| folder.is_dir())
}

/// The median of a benchmark in milliseconds; none when it was not run.
fn median(figures: &Path, at: &str) -> Option<f64> {
    let text = std::fs::read_to_string(figures.join(at).join("new/estimates.json")).ok()?;
    let estimates: serde_json::Value = serde_json::from_str(&text).ok()?;
    Some(estimates.get("median")?.get("point_estimate")?.as_f64()? / 1e6)
}

/// A figure with three digits, or a dash.
fn text(value: Option<f64>) -> String {
    match value {
        None => "-".into(),
        Some(v) if v >= 99.95 => format!("{v:.0}"),
        Some(v) if v >= 9.995 => format!("{v:.1}"),
        Some(v) => format!("{v:.2}"),
    }
}

fn table(figures: &Path) -> String {
    let cores = std::thread::available_parallelism().map_or(0, usize::from);
    let sum = |how: &str| text(median(figures, &format!("yardstick/sum of 1e6 doubles{how}")));
    let mut table = format!(
        "Medians on {cores} cores of a machine on which one thread sums 1e6 doubles in {} ms one after the other, in {} ms \
         in eight sums side by side.\n\n\
         | job | budget, ms | measured, ms |\n|---|---:|---:|\n",
        sum(""),
        sum(" in lanes")
    );
    for Job { what, at, budget } in JOBS {
        table.push_str(&format!("| {what} | {budget} | {} |\n", text(median(figures, at))));
    }
    let peak = std::fs::read_to_string(figures.join("peak memory in MB")).ok().and_then(|t| t.trim().parse().ok());
    table.push_str(&format!(
        "\nPeak memory from the file to the first frame, 1e7 rows: {} MB (budget {MEMORY} MB).\n",
        text(peak)
    ));
    table
}

fn main() {
    // `cargo test --benches` asks whether it runs.
    if std::env::args().any(|a| a == "--test") {
        return;
    }
    let Some(figures) = figures() else {
        eprintln!("no figures yet: cargo bench measures them");
        return;
    };
    let table = table(&figures);
    println!("{table}");
    if std::env::var_os("WILDPOINT_UPDATE").is_none() {
        return;
    }
    let path = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("docs/benchmarks.md");
    let old = std::fs::read_to_string(&path).unwrap_or_else(|e| panic!("{}: {e}", path.display()));
    let (open, close) = ("<!-- benchmarks -->\n", "<!-- /benchmarks -->");
    let (Some(start), Some(end)) = (old.find(open), old.find(close)) else {
        panic!("{} has no part benchmarks", path.display())
    };
    let new = format!("{}{table}{}", &old[..start + open.len()], &old[end..]);
    std::fs::write(&path, new).unwrap_or_else(|e| panic!("{}: {e}", path.display()));
}
