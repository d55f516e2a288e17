//! The off-line comparison of \[001\]: 200 residuals of variance 2 with three kinds of outliers, and the criteria of
//! section 2 on them. The document describes its data completely, so there is no stand-in; its table 1 is lost, so
//! its statements are what can be compared.

use super::record::{Record, Signal, Wild};
use super::reproduction::{Cell, Figures, Finding, Runs, Table};
use super::trial::{Keys, Tally, Trial, setup};
use super::{Experiment, Published, Random};
use crate::error::Result;
use crate::session::Preset;

/// The row of the table.
pub const EXPERIMENT: Experiment = Experiment {
    id: "hou-offline",
    help: "off-line criteria on 200 residuals with isolated, constant-patch and time-varying outliers",
    source: "[001] section 4, tables 1 and 2",
    record,
    seed: 2001,
    reproduction: Some(Published {
        runs: 200,
        stand_in: "None is needed: 200 samples N(0, 2); +10 on 96..105; -15, -10, 15, 12 at 50, 70, 130, 150; \
                   10 sin(i) added on 151..160. The document makes 10 runs; its table of rates is lost, so its \
                   statements are compared. Paper settings, the mean as trend, alpha 0.01. `known sigma` is an \
                   observer who knows mean and deviation and flags at 3: nobody can do better at that rate of false \
                   alarms.",
        trial,
        conclude,
    }),
};

/// Deviation of the noise: the document's variance is 2.
pub(super) const DEVIATION: f64 = std::f64::consts::SQRT_2;
/// Samples.
pub(super) const SAMPLES: usize = 200;

/// sin(i) for i = 151 .. 160 in radians, written out because a platform's sine may differ in its last bit.
const SINES: [f64; 10] = [
    0.202_149_881_415_653_63,
    0.933_320_523_748_862,
    0.806_400_580_775_486_3,
    -0.061_920_337_256_057_31,
    -0.873_311_982_774_647_6,
    -0.881_784_618_814_781_1,
    -0.079_548_542_874_722_1,
    0.795_824_096_527_455_2,
    0.939_519_731_713_148_3,
    0.219_425_258_379_004_73,
];

/// The outliers of \[001\] with their kinds; its positions count from 1.
pub(super) fn outliers() -> (Vec<f64>, Vec<Option<Wild>>) {
    let (mut errors, mut wild) = (vec![0.0; SAMPLES], vec![None; SAMPLES]);
    let mut put = |position: usize, error: f64, kind: Wild| {
        errors[position - 1] = error;
        wild[position - 1] = Some(kind);
    };
    (96..=105).for_each(|i| put(i, 10.0, Wild::Patch));
    for (i, error) in [(50, -15.0), (70, -10.0), (130, 15.0), (150, 12.0)] {
        put(i, error, Wild::Isolated);
    }
    for (i, sine) in (151..=160).zip(SINES) {
        put(i, 10.0 * sine, Wild::Varying);
    }
    (errors, wild)
}

fn record(seed: u64) -> Record {
    let mut random = Random::new(seed);
    let clean: Vec<f64> = (0..SAMPLES).map(|_| DEVIATION * random.normal()).collect();
    let (errors, wild) = outliers();
    #[expect(clippy::cast_precision_loss, reason = "200 samples")]
    let i = (1..=SAMPLES).map(|i| i as f64).collect();
    Record::new(Signal::new("t_s", 0, i), vec![Signal::with_errors("v", 4, &clean, &errors)], wild)
}

/// Method, its label in the table, and the keys that differ from its paper settings.
const METHODS: [(&str, &str, Keys); 6] = [
    ("wright", "wright", &[]),
    ("romanovsky", "romanovsky", &[("trend_order", "0"), ("alpha", "0.01")]),
    ("grubbs", "grubbs", &[("trend_order", "0"), ("alpha", "0.01")]),
    ("chauvenet", "chauvenet", &[("trend_order", "0")]),
    ("odd-even", "odd-even", &[("trend_order", "0")]),
    ("diff-median", "diff-median", &[]),
];

fn trial(record: &Record) -> Result<Figures> {
    let trial = Trial::of(record)?;
    let mut figures = Vec::new();
    for (method, label, keys) in METHODS {
        let tally = trial.tally(&trial.judge(&setup(method, Preset::Paper, keys)?)?);
        figures.push((label, figures_of(&tally)));
    }
    figures.push(("known sigma", figures_of(&known_sigma(record))));
    Ok(figures)
}

/// Found, and found of each kind, then false alarms.
#[expect(clippy::cast_precision_loss, reason = "counts of a few hundred samples")]
pub(super) fn figures_of(tally: &Tally) -> Vec<f64> {
    [tally.hits(), tally.isolated, tally.patch, tally.varying, tally.false_alarms].map(|n| n as f64).to_vec()
}

/// What an observer flags who knows that the noise has mean 0 and this deviation.
fn known_sigma(record: &Record) -> Tally {
    let mut tally = Tally::default();
    for (y, wild) in record.signals[0].values.iter().zip(&record.wild) {
        let flagged = y.abs() >= 3.0 * DEVIATION;
        tally.flagged += usize::from(flagged);
        let part = match wild {
            Some(Wild::Isolated) => &mut tally.isolated,
            Some(Wild::Patch) => &mut tally.patch,
            Some(Wild::Varying) => &mut tally.varying,
            None => &mut tally.false_alarms,
        };
        *part += usize::from(flagged);
        tally.missed += usize::from(wild.is_some() && !flagged);
    }
    tally
}

/// Columns of [`figures_of`].
pub(super) const FOUND: usize = 0;
pub(super) const VARYING: usize = 3;
pub(super) const FALSE: usize = 4;
/// Wild samples of all kinds and of each.
const WILD: [f64; 4] = [24.0, 4.0, 10.0, 10.0];

/// The table of rejection rates and false alarms that both experiments of \[001\] have.
pub(super) fn rates(title: &str, labels: &[&'static str], runs: Runs<'_>) -> Table {
    let row = |label: &&'static str| {
        let rate = |column: usize| Cell::number(100.0 * runs.mean(label, column) / WILD[column], 1);
        let mut cells = vec![Cell::text(*label)];
        cells.extend((0..4).map(rate));
        cells.push(Cell::number(runs.mean(label, FOUND), 1));
        cells.push(Cell::number(runs.mean(label, FALSE), 1));
        cells
    };
    Table {
        title: title.to_owned(),
        columns: vec!["method", "rejected %", "isolated %", "patch %", "varying %", "found of 24", "false"],
        rows: labels.iter().map(row).collect(),
    }
}

fn conclude(runs: Runs<'_>) -> (Vec<Table>, Vec<Finding>) {
    let labels: Vec<&'static str> = METHODS.iter().map(|m| m.1).chain(["known sigma"]).collect();
    let title = "Rejection rate, eq. (42), and false alarms (the document's table 1 is lost)";
    let mut findings = of_tests(runs);
    findings.extend(of_others(runs));
    (vec![rates(title, &labels, runs)], findings)
}

/// The criteria that give a residual to judge by; the sixth method only gives cleaned data.
const CRITERIA: [&str; 5] = ["wright", "romanovsky", "grubbs", "chauvenet", "odd-even"];
const PATCH: usize = 2;

fn rate(runs: Runs<'_>, label: &str, column: usize) -> f64 {
    100.0 * runs.mean(label, column) / WILD[column]
}

/// The rates of some methods in words.
fn rates_of(runs: Runs<'_>, labels: &[&str], column: usize) -> String {
    let parts: Vec<String> = labels.iter().map(|l| format!("{l} {:.0} %", rate(runs, l, column))).collect();
    parts.join(", ")
}

/// What the document says of the tests for one outlier.
fn of_tests(runs: Runs<'_>) -> Vec<Finding> {
    let rate = |label: &str, column: usize| rate(runs, label, column);
    let of_all = |labels: &[&str], column: usize| rates_of(runs, labels, column);
    let best = |than: &str| CRITERIA.iter().all(|l| runs.mean(than, FOUND) >= runs.mean(l, FOUND));
    vec![
        Finding {
            id: "grubbs-best",
            statement: "Grubbs finds the most of isolated and patch outliers",
            holds: best("grubbs"),
            measured: format!(
                "one at a time it is masked by 24 outliers among 200: {}; Romanovsky, the same test with alpha per \
                 sample, {}",
                of_all(&["grubbs"], FOUND),
                if best("romanovsky") { "finds the most" } else { "does not find the most either" },
            ),
        },
        Finding {
            id: "romanovsky-good",
            statement: "Romanovsky rejects patches and isolated outliers well",
            holds: rate("romanovsky", PATCH) >= 80.0 && rate("romanovsky", 1) >= 80.0,
            measured: format!("isolated {:.0} %, patch {:.0} %", rate("romanovsky", 1), rate("romanovsky", PATCH)),
        },
        Finding {
            id: "chauvenet-patches",
            statement: "Chauvenet rejects patches better than Wright",
            holds: rate("chauvenet", PATCH) > rate("wright", PATCH),
            measured: format!("patch: {}", of_all(&["chauvenet", "wright"], PATCH)),
        },
    ]
}

/// What it says of odd-even extraction and the difference-assisted median.
fn of_others(runs: Runs<'_>) -> Vec<Finding> {
    let rate = |label: &str, column: usize| rate(runs, label, column);
    let of_all = |labels: &[&str], column: usize| rates_of(runs, labels, column);
    vec![
        Finding {
            id: "odd-even-false",
            statement: "Odd-even extraction copes with patches and varying outliers, with false alarms",
            holds: rate("odd-even", PATCH) >= rate("wright", PATCH)
                && rate("odd-even", VARYING) >= rate("wright", VARYING)
                && runs.mean("odd-even", FALSE) > runs.mean("wright", FALSE),
            measured: format!(
                "patch: {}; varying: {}; false: {:.1} against {:.1}",
                of_all(&["odd-even", "wright"], PATCH),
                of_all(&["odd-even", "wright"], VARYING),
                runs.mean("odd-even", FALSE),
                runs.mean("wright", FALSE),
            ),
        },
        Finding {
            id: "diff-median-unstable",
            statement: "The difference-assisted median is unstable when the data fluctuate",
            holds: CRITERIA.iter().all(|l| runs.spread("diff-median", FOUND) > runs.spread(l, FOUND)),
            measured: format!(
                "found of 24 from run to run: {:.1} ± {:.1}, with {:.1} ± {:.1} false; found by the others at most ± {:.1}",
                runs.mean("diff-median", FOUND),
                runs.spread("diff-median", FOUND),
                runs.mean("diff-median", FALSE),
                runs.spread("diff-median", FALSE),
                CRITERIA.iter().map(|l| runs.spread(l, FOUND)).fold(0.0, f64::max),
            ),
        },
    ]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_outliers_are_those_of_the_document() {
        let (errors, wild) = outliers();
        for (i, sine) in (151..=160).zip(SINES) {
            assert!((f64::from(i).sin() - sine).abs() < 1e-14, "{i}");
        }
        assert_eq!((errors[94], errors[95], errors[104], errors[105]), (0.0, 10.0, 10.0, 0.0));
        assert_eq!([49, 69, 129, 149].map(|i| errors[i]), [-15.0, -10.0, 15.0, 12.0]);
        assert_eq!(wild.iter().flatten().count(), 24);
    }
}
