//! Which statements of \[003\] hold: by the defaults of this program, and it is said where the settings of the paper
//! decide otherwise.

use super::{ERROR, FOUND, ISOLATED, LINES, MEAN, MEDIAN, PATCH, POLY, TEMPLATE, WINDOWS};
use crate::experiment::{Finding, Runs};

/// All statements.
pub(super) fn findings(runs: Runs<'_>) -> Vec<Finding> {
    let mut findings = of_single_windows(runs);
    findings.extend(of_all_windows(runs));
    findings.extend(of_kinds(runs));
    findings.push(of_equation_1(runs));
    findings
}

/// The figures by method and window, with one set of settings.
#[derive(Clone, Copy)]
struct Set<'a> {
    runs: Runs<'a>,
    paper: bool,
}

/// Outliers of each kind in a record.
const OF_KIND: f64 = 119.0;

impl Set<'_> {
    fn value(self, method: usize, at: usize, column: usize) -> f64 {
        let line = &LINES[method];
        self.runs.mean(if self.paper { line.paper[at] } else { line.default[at] }, column)
    }

    /// Final error in km.
    fn error(self, method: usize, at: usize) -> f64 {
        self.value(method, at, ERROR)
    }

    fn spread(self, method: usize, at: usize) -> f64 {
        let line = &LINES[method];
        self.runs.spread(if self.paper { line.paper[at] } else { line.default[at] }, ERROR)
    }

    /// Found of a kind, in percent.
    fn share(self, method: usize, at: usize, kind: usize) -> f64 {
        100.0 * self.value(method, at, kind) / OF_KIND
    }

    fn best(self, method: usize, at: usize) -> bool {
        (0..LINES.len()).all(|m| self.error(method, at) <= self.error(m, at))
    }

    fn worst(self, method: usize, at: usize) -> bool {
        (0..LINES.len()).all(|m| self.error(method, at) >= self.error(m, at))
    }

    /// Whether two methods come before the two others.
    fn before(self, first: [usize; 2], at: usize) -> bool {
        let others = (0..LINES.len()).filter(|m| !first.contains(m));
        others.clone().all(|m| first.iter().all(|&f| self.error(f, at) < self.error(m, at)))
    }

    /// The methods in the order of their mean error over all windows.
    fn mean_error(self, method: usize) -> f64 {
        (0..WINDOWS.len()).map(|at| self.error(method, at)).sum::<f64>() / WINDOWS.len() as f64
    }

    fn by_window(self, method: usize) -> String {
        let part = |(i, w): (usize, &&str)| format!("{w}: {:.3}", self.error(method, i));
        WINDOWS.iter().enumerate().map(part).collect::<Vec<_>>().join(", ")
    }

    fn by_method(self, figure: impl Fn(usize) -> f64, decimals: usize) -> String {
        let part = |(m, l): (usize, &super::Line)| format!("{} {:.decimals$}", l.id, figure(m));
        LINES.iter().enumerate().map(part).collect::<Vec<_>>().join(", ")
    }

    fn errors(self, at: usize) -> String {
        self.by_method(|m| self.error(m, at), 3)
    }

    fn shares(self, at: usize, kind: usize) -> String {
        self.by_method(|m| self.share(m, at, kind), 0)
    }
}

/// A statement, decided by the defaults; the table has the figures of both sets.
fn finding(
    runs: Runs<'_>,
    id: &'static str,
    statement: &'static str,
    holds: impl Fn(Set<'_>) -> bool,
    words: impl Fn(Set<'_>) -> String,
) -> Finding {
    let [ours, paper] = [false, true].map(|paper| Set { runs, paper });
    let paper_word = if holds(paper) { "holds" } else { "does not" };
    let measured = format!("defaults, {}; by the paper settings it {paper_word}", words(ours));
    Finding::new(id, statement, holds(ours), measured)
}

/// Where in [`WINDOWS`] the windows are of which the document speaks.
const AT_10: usize = 2;
const AT_20: usize = 3;
const AT_50: usize = 5;
const AT_100: usize = 6;
const AT_200: usize = 7;

/// What it says below figures 6, 11 and 16, of windows of 20, 50 and 200.
fn of_single_windows(runs: Runs<'_>) -> Vec<Finding> {
    let km = |at: usize| move |set: Set<'_>| format!("km: {}", set.errors(at));
    vec![
        finding(
            runs,
            "median-and-mean-best-at-20",
            "At a window of 20 the sliding median and the sliding mean are the best",
            |set| set.before([MEDIAN, MEAN], AT_20),
            km(AT_20),
        ),
        finding(
            runs,
            "template-inaccurate-at-20",
            "At a window of 20 template convolution is the least accurate over all",
            |set| set.worst(TEMPLATE, AT_20),
            km(AT_20),
        ),
        finding(
            runs,
            "median-and-mean-best-at-50",
            "At a window of 50 the sliding median and the sliding mean are the best",
            |set| set.before([MEDIAN, MEAN], AT_50),
            km(AT_50),
        ),
        finding(
            runs,
            "median-best-at-50",
            "At a window of 50 the sliding median has the smallest error (table 1)",
            |set| set.best(MEDIAN, AT_50),
            km(AT_50),
        ),
        finding(
            runs,
            "template-worst-at-50",
            "At a window of 50 template convolution has the largest error",
            |set| set.worst(TEMPLATE, AT_50),
            km(AT_50),
        ),
        finding(
            runs,
            "median-and-poly-best-at-200",
            "At a window of 200 the sliding median and the polynomial are the best",
            |set| set.before([MEDIAN, POLY], AT_200),
            km(AT_200),
        ),
        finding(
            runs,
            "mean-breaks-at-200",
            "At a window of 200 the sliding mean has the largest error",
            |set| set.worst(MEAN, AT_200),
            km(AT_200),
        ),
    ]
}

/// Its conclusions 1 to 3, and what its table says of them.
fn of_all_windows(runs: Runs<'_>) -> Vec<Finding> {
    let order = |set: Set<'_>| format!("mean error over the windows, km: {}", set.by_method(|m| set.mean_error(m), 3));
    vec![
        finding(
            runs,
            "median-smallest-at-50",
            "The error of the sliding median is smallest at a window of 50 (table 1)",
            |set| (0..WINDOWS.len()).all(|i| set.error(MEDIAN, AT_50) <= set.error(MEDIAN, i)),
            |set| format!("km by window: {}", set.by_window(MEDIAN)),
        ),
        finding(
            runs,
            "template-grows",
            "1) The error of template convolution grows with the window (in table 1 from 8 to 100)",
            |set| (AT_10..=AT_100).all(|i| set.error(TEMPLATE, i - 1) < set.error(TEMPLATE, i)),
            |set| format!("km by window: {}", set.by_window(TEMPLATE)),
        ),
        finding(
            runs,
            "template-worst-then-mean",
            "1) Template convolution is the worst, then come the sliding mean, the polynomial and the sliding median",
            |set| [TEMPLATE, MEAN, POLY, MEDIAN].windows(2).all(|w| set.mean_error(w[0]) >= set.mean_error(w[1])),
            order,
        ),
        finding(
            runs,
            "mean-and-median-best-at-10",
            "2) At a window of about 10 mean and median are the best, then come the polynomial and template convolution",
            |set| set.before([MEDIAN, MEAN], AT_10) && set.error(POLY, AT_10) <= set.error(TEMPLATE, AT_10),
            |set| format!("km: {}", set.errors(AT_10)),
        ),
        finding(
            runs,
            "median-small-throughout",
            "3) The sliding median has small errors throughout, then come polynomial, mean and template convolution",
            |set| [MEDIAN, POLY, MEAN, TEMPLATE].windows(2).all(|w| set.mean_error(w[0]) <= set.mean_error(w[1])),
            order,
        ),
        mean_best_at_20(runs),
    ]
}

fn mean_best_at_20(runs: Runs<'_>) -> Finding {
    let (id, statement) = (
        "mean-steadiest-at-20",
        "3) At a moderate window (20) the sliding mean is the steadiest and the best over all",
    );
    if runs.0.len() < 2 {
        return Finding::untold(id, statement, "one run does not show how steady a method is");
    }
    let steadiest = |set: Set<'_>| (0..LINES.len()).all(|m| set.spread(MEAN, AT_20) <= set.spread(m, AT_20));
    finding(
        runs,
        id,
        statement,
        |set| steadiest(set) && set.best(MEAN, AT_20),
        |set| {
            let spread = set.by_method(|m| set.spread(m, AT_20), 3);
            format!("km: {}, from run to run ± {spread} (table 1 itself: mean 0.375, median 0.227)", set.errors(AT_20))
        },
    )
}

/// Its conclusion 4, and what it says of the kinds of outliers.
fn of_kinds(runs: Runs<'_>) -> Vec<Finding> {
    let both = |at: usize| {
        move |set: Set<'_>| {
            format!("found in percent, isolated: {}; patches: {}", set.shares(at, ISOLATED), set.shares(at, PATCH))
        }
    };
    let good = |set: Set<'_>, method: usize, at: usize| {
        set.share(method, at, ISOLATED) >= 80.0 && set.share(method, at, PATCH) >= 80.0
    };
    vec![
        finding(
            runs,
            "median-good-on-both",
            "4) The sliding median is good on isolated outliers and on patches, then comes the polynomial (at 50)",
            |set| good(set, MEDIAN, AT_50) && good(set, POLY, AT_50) && set.best(MEDIAN, AT_50),
            both(AT_50),
        ),
        finding(
            runs,
            "median-and-mean-on-both-at-20",
            "At a window of 20 median and mean are good on isolated outliers and on patches",
            |set| good(set, MEDIAN, AT_20) && good(set, MEAN, AT_20),
            both(AT_20),
        ),
        finding(
            runs,
            "template-poor-on-isolated",
            "At a window of 20 template convolution is poor on isolated outliers",
            |set| (0..LINES.len()).all(|m| set.share(TEMPLATE, AT_20, ISOLATED) <= set.share(m, AT_20, ISOLATED)),
            both(AT_20),
        ),
        finding(
            runs,
            "poly-poor-on-patches",
            "At a window of 20 the polynomial is worse on patches than median and mean",
            |set| [MEDIAN, MEAN].iter().all(|&m| set.share(POLY, AT_20, PATCH) < set.share(m, AT_20, PATCH)),
            both(AT_20),
        ),
        finding(
            runs,
            "template-leaves-isolated-at-50",
            "At a window of 50 template convolution still leaves some isolated outliers",
            |set| set.share(TEMPLATE, AT_50, ISOLATED) < 100.0,
            |set| format!("isolated found in percent: {}", set.by_method(|m| set.share(m, AT_50, ISOLATED), 0)),
        ),
        finding(
            runs,
            "mean-poor-on-isolated-at-200",
            "4) At too long a window (200) the sliding mean is poor on isolated outliers, template convolution the worst",
            |set| {
                let isolated = |m: usize| set.share(m, AT_200, ISOLATED);
                (0..LINES.len()).all(|m| isolated(TEMPLATE) <= isolated(m))
                    && isolated(MEAN) < isolated(MEDIAN).min(isolated(POLY))
            },
            both(AT_200),
        ),
    ]
}

/// How many outliers the paper settings find at the three smallest windows, all methods together.
fn of_equation_1(runs: Runs<'_>) -> Finding {
    let found: f64 = LINES.iter().flat_map(|l| &l.paper[..3]).map(|label| runs.mean(label, FOUND)).sum();
    Finding::new(
        "eq-1-as-printed",
        "With 3 sigma by eq. (1) the methods remove outliers at windows of 7, 8 and 10",
        found >= 1.0,
        format!(
            "paper settings: {found:.0} found by all four together; a residual test whose scale includes the tested sample \
             reaches at most 2.27, 2.47 and 2.85 scales in windows of 7, 8 and 10"
        ),
    )
}
