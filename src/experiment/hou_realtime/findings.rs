//! Which statements of \[001\] on real-time methods hold, and on which reading that hangs.

use super::{READINGS, Reading};
use crate::experiment::hou_offline::{FALSE, FOUND, ISOLATED, PATCH, VARYING};
use crate::experiment::{Finding, Runs};

/// A statement that figures decide.
struct Statement {
    id: &'static str,
    text: &'static str,
    /// The figure that is shown, and out of how many it is; false alarms where that is none.
    column: usize,
    of: Option<usize>,
    holds: fn(Runs<'_>, &Reading) -> bool,
}

fn mean(runs: Runs<'_>, label: &str, column: usize) -> f64 {
    runs.mean(label, column)
}

/// Whether the method finds no fewer than each of these.
fn most(runs: Runs<'_>, label: &str, than: &[&str], column: usize) -> bool {
    than.iter().all(|other| mean(runs, label, column) >= mean(runs, other, column))
}

const STATEMENTS: [Statement; 9] = [
    Statement {
        id: "five-point-beats-alpha-beta-gamma",
        text: "Five-point prediction is better than the alpha-beta-gamma filter",
        column: FOUND,
        of: Some(24),
        holds: |runs, r| mean(runs, r.five_point, FOUND) > mean(runs, r.alpha_beta_gamma, FOUND),
    },
    Statement {
        id: "adaptive-finds-more",
        text: "The adaptive limit finds more than a fixed one",
        column: FOUND,
        of: Some(24),
        holds: |runs, r| mean(runs, r.adaptive, FOUND) > mean(runs, r.five_point, FOUND),
    },
    Statement {
        id: "adaptive-fewer-false",
        text: "The adaptive limit gives fewer false alarms than a fixed one",
        column: FALSE,
        of: None,
        holds: |runs, r| mean(runs, r.adaptive, FALSE) < mean(runs, r.five_point, FALSE),
    },
    Statement {
        id: "matched-second",
        text: "Matched measurements come second, after five-point prediction with the adaptive limit",
        column: FOUND,
        of: Some(24),
        holds: |runs, r| {
            most(runs, r.adaptive, &r.labels(), FOUND)
                && most(runs, r.matched, &[r.five_point, r.alpha_beta_gamma], FOUND)
        },
    },
    Statement {
        id: "matched-fewest-false",
        text: "Matched measurements give the fewest false alarms",
        column: FALSE,
        of: None,
        holds: |runs, r| r.labels().iter().all(|l| mean(runs, r.matched, FALSE) <= mean(runs, l, FALSE)),
    },
    Statement {
        id: "all-find-isolated",
        text: "All real-time methods reject isolated outliers effectively",
        column: ISOLATED,
        of: Some(4),
        holds: |runs, r| r.labels().iter().all(|l| mean(runs, l, ISOLATED) >= 0.9 * 4.0),
    },
    Statement {
        id: "adaptive-best-on-patches",
        text: "On patches the adaptive limit is the best",
        column: PATCH,
        of: Some(10),
        holds: |runs, r| most(runs, r.adaptive, &r.labels(), PATCH),
    },
    Statement {
        id: "alpha-beta-gamma-best-on-varying",
        text: "On varying outliers the alpha-beta-gamma filter is the best",
        column: VARYING,
        of: Some(10),
        holds: |runs, r| most(runs, r.alpha_beta_gamma, &r.labels(), VARYING),
    },
    Statement {
        id: "adaptive-best-when-mixed",
        text: "Where all three kinds mix, five-point prediction with the adaptive limit is the best",
        column: FOUND,
        of: Some(24),
        holds: |runs, r| most(runs, r.adaptive, &r.labels(), FOUND),
    },
];

/// All statements: the rules as printed decide, and it is said where another reading decides otherwise.
pub(super) fn findings(runs: Runs<'_>) -> Vec<Finding> {
    let mut findings: Vec<Finding> = STATEMENTS.iter().map(|s| finding(s, runs)).collect();
    findings.push(Finding::untold(
        "cost",
        "Five-point prediction costs the least, matched measurements the most",
        "times depend on the machine: `cargo bench` measures them, and `docs/benchmarks.md` has the table",
    ));
    findings
}

fn finding(statement: &Statement, runs: Runs<'_>) -> Finding {
    let of = |reading: &Reading| (statement.holds)(runs, reading);
    let [printed, at_3, ours, seconds] = &READINGS;
    let part = |label: &&str| format!("{} {:.1}", plain(label), runs.mean(label, statement.column));
    let words = printed.labels().iter().map(part).collect::<Vec<_>>().join(", ");
    let what = statement.of.map_or("false alarms".to_owned(), |n| format!("found of {n}"));
    let others = [(at_3, "the limit of adaptive"), (ours, "the rule that ends a run"), (seconds, "what i counts")];
    let hangs: Vec<&str> = others.iter().filter(|(r, _)| of(r) != of(printed)).map(|(_, on)| *on).collect();
    let hangs = if hangs.is_empty() {
        "no other reading changes that".into()
    } else {
        format!("it hangs on {}", hangs.join(", on "))
    };
    let word = |reading: &Reading| if of(reading) { "holds" } else { "does not" };
    let measured = format!(
        "{what}, as printed: {words}; with adaptive at 3 scales it {}, with the defaults here it {}, with i in seconds it {}: \
         {hangs}",
        word(at_3),
        word(ours),
        word(seconds)
    );
    Finding::new(statement.id, statement.text, of(printed), measured)
}

/// The method of a label.
fn plain(label: &str) -> &str {
    label.split(" (").next().unwrap_or(label)
}
