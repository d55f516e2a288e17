//! Which statements of \[001\] on criteria after the fact hold.
//!
//! "Fairly good" is taken for two thirds of what an observer finds who knows mean and deviation.

use super::{FALSE, FOUND, ISOLATED, KNOWN_SIGMA, PATCH, VARYING, rate};
use crate::experiment::{Finding, Runs};

/// All statements.
pub(super) fn findings(runs: Runs<'_>) -> Vec<Finding> {
    let rates = Rates(runs);
    let mut findings = of_wright_and_chauvenet(rates);
    findings.extend(of_one_at_a_time(rates));
    findings.extend(of_odd_even(rates));
    findings.extend(of_diff_median(rates));
    findings
}

/// The criteria that give a residual to judge by; the sixth method only gives cleaned data.
const CRITERIA: [&str; 5] = ["wright", "romanovsky", "grubbs", "chauvenet", "odd-even"];

#[derive(Clone, Copy)]
struct Rates<'a>(Runs<'a>);

impl Rates<'_> {
    fn of(self, label: &str, kind: usize) -> f64 {
        rate(self.0, label, kind)
    }

    fn fairly_good(self, label: &str, kind: usize) -> bool {
        self.of(label, kind) >= 2.0 / 3.0 * self.of(KNOWN_SIGMA, kind)
    }

    fn best(self, label: &str, kind: usize) -> bool {
        CRITERIA.iter().all(|l| self.of(label, kind) >= self.of(l, kind))
    }

    /// The rates of some methods in words.
    fn words(self, labels: &[&str], kind: usize) -> String {
        let parts: Vec<String> = labels.iter().map(|l| format!("{l} {:.0} %", self.of(l, kind))).collect();
        parts.join(", ")
    }

    fn falses(self, label: &str) -> f64 {
        self.0.mean(label, FALSE)
    }
}

fn of_wright_and_chauvenet(rates: Rates<'_>) -> Vec<Finding> {
    vec![
        Finding::new(
            "wright-isolated",
            "Wright rejects isolated outliers well where there is much data",
            rates.fairly_good("wright", ISOLATED),
            format!("isolated: {}", rates.words(&["wright", KNOWN_SIGMA], ISOLATED)),
        ),
        Finding::new(
            "wright-patches",
            "Wright rejects patches fairly well where there is much data",
            rates.fairly_good("wright", PATCH),
            format!("patch: {}", rates.words(&["wright", KNOWN_SIGMA], PATCH)),
        ),
        Finding::new(
            "chauvenet-patches",
            "Chauvenet rejects patches fairly well",
            rates.fairly_good("chauvenet", PATCH),
            format!("patch: {}", rates.words(&["chauvenet", KNOWN_SIGMA], PATCH)),
        ),
        Finding::untold(
            "chauvenet-cheap",
            "Chauvenet costs little",
            "all criteria cost about the same in this program, for means and deviations are updated and not worked out anew",
        ),
    ]
}

fn of_one_at_a_time(rates: Rates<'_>) -> Vec<Finding> {
    let both = ["romanovsky", "grubbs"];
    vec![
        Finding::new(
            "romanovsky-good",
            "Romanovsky rejects patches and isolated outliers fairly well",
            rates.fairly_good("romanovsky", PATCH) && rates.fairly_good("romanovsky", ISOLATED),
            format!("isolated {:.0} %, patch {:.0} %", rates.of(both[0], ISOLATED), rates.of(both[0], PATCH)),
        ),
        Finding::untold(
            "romanovsky-slow",
            "Romanovsky does so at the price of computing time",
            "one routine serves it and Grubbs, in which a removal takes the same few operations whatever the length",
        ),
        Finding::new(
            "isolated-effectively",
            "Romanovsky and Grubbs both reject isolated outliers effectively",
            both.iter().all(|l| rates.fairly_good(l, ISOLATED)),
            format!("isolated: {}; one at a time, 24 outliers among 200 mask each other", rates.words(&both, ISOLATED)),
        ),
        Finding::new(
            "grubbs-best",
            "Grubbs rejects isolated outliers and patches best of all",
            rates.best("grubbs", ISOLATED) && rates.best("grubbs", PATCH),
            format!(
                "all outliers: {}; Romanovsky, the same test with alpha per sample, {}",
                rates.words(&CRITERIA, FOUND),
                if rates.best("romanovsky", FOUND) { "finds the most" } else { "does not find the most either" },
            ),
        ),
        Finding::new(
            "grubbs-best-on-patches",
            "On patches Grubbs is the best",
            rates.best("grubbs", PATCH),
            format!("patch: {}", rates.words(&CRITERIA, PATCH)),
        ),
        Finding::new(
            "grubbs-varying",
            "Grubbs rejects varying outliers to some degree",
            rates.of("grubbs", VARYING) >= 10.0,
            format!("varying: {}", rates.words(&["grubbs", KNOWN_SIGMA], VARYING)),
        ),
    ]
}

fn of_odd_even(rates: Rates<'_>) -> Vec<Finding> {
    let label = "odd-even";
    vec![
        Finding::new(
            "odd-even-good",
            "Odd-even extraction rejects patches and varying outliers fairly well",
            rates.fairly_good(label, PATCH) && rates.fairly_good(label, VARYING),
            format!(
                "patch: {}; varying: {}",
                rates.words(&[label, KNOWN_SIGMA], PATCH),
                rates.words(&[label, KNOWN_SIGMA], VARYING)
            ),
        ),
        Finding::new(
            "odd-even-false",
            "Odd-even extraction gives false alarms",
            rates.falses(label) > 0.0,
            format!("{:.2} in 176 good samples; wright {:.2}", rates.falses(label), rates.falses("wright")),
        ),
        Finding::new(
            "odd-even-for-patches",
            "With much data odd-even extraction is the choice for patches and varying outliers",
            rates.best(label, PATCH) && rates.best(label, VARYING),
            format!("patch: {}; varying: {}", rates.words(&CRITERIA, PATCH), rates.words(&CRITERIA, VARYING)),
        ),
    ]
}

fn of_diff_median(rates: Rates<'_>) -> Vec<Finding> {
    let (runs, label) = (rates.0, "diff-median");
    let statement = "The difference-assisted median is unstable when the data fluctuate";
    let spread = runs.spread(label, FOUND);
    let unstable = if spread.is_nan() {
        Finding::untold("diff-median-unstable", statement, "one run does not show how results differ from run to run")
    } else {
        Finding::new(
            "diff-median-unstable",
            statement,
            CRITERIA.iter().all(|l| spread > runs.spread(l, FOUND)),
            format!(
                "found of 24 from run to run: {:.1} ± {spread:.1}, with {:.1} ± {:.1} false; found by the others at most \
                 ± {:.1}",
                runs.mean(label, FOUND),
                runs.mean(label, FALSE),
                runs.spread(label, FALSE),
                CRITERIA.iter().map(|l| runs.spread(l, FOUND)).fold(0.0, f64::max),
            ),
        )
    };
    vec![
        Finding::new(
            "diff-median-some",
            "The difference-assisted median rejects outliers to some degree, patches too",
            rates.of(label, PATCH) >= 10.0,
            format!("all {:.0} %, patch {:.0} %", rates.of(label, FOUND), rates.of(label, PATCH)),
        ),
        unstable,
    ]
}
