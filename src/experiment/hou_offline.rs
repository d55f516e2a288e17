//! The off-line comparison of \[001\]: 200 residuals of variance 2 with three kinds of outliers, and the criteria of
//! section 2 on them. The document describes its data completely, so there is no stand-in; the figures of its table 1 are
//! lost, so the text of its table 2 and its statements are what can be compared.

use super::record::{Record, Signal, Wild};
use super::reproduction::{Cell, Figures, Finding, Runs, Table};
use super::shown::{Picture, show};
use super::trial::{Keys, Tally, Trial, setup};
use super::{Experiment, Published, Random};
use crate::error::Result;
use crate::session::Preset;

mod findings;
mod table_2;

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
                   10 sin(i) added on 151..160. The document makes 10 runs; the figures of its table 1 are lost, the text \
                   of its table 2 and its statements are there. Paper settings, the mean as trend, alpha 0.01. `known sigma` is an \
                   observer who knows mean and deviation and flags at 3: nobody can do better at that rate of false \
                   alarms.",
        trial,
        conclude,
        pictures: |record| show(record, &PICTURES),
        charts: super::no_charts,
    }),
};

/// The figures of the document.
const PICTURES: [Picture; 6] = [
    Picture { title: "Figure 1 (a): wright", method: "wright", preset: Preset::Paper, keys: &[] },
    Picture { title: "Figure 1 (b): romanovsky", method: "romanovsky", preset: Preset::Paper, keys: FLAT_AT_001 },
    Picture { title: "Figure 1 (c): grubbs", method: "grubbs", preset: Preset::Paper, keys: FLAT_AT_001 },
    Picture { title: "Figure 1 (d): chauvenet", method: "chauvenet", preset: Preset::Paper, keys: FLAT },
    Picture { title: "Figure 1 (e): odd-even", method: "odd-even", preset: Preset::Paper, keys: FLAT },
    Picture { title: "Figure 1 (f): diff-median", method: "diff-median", preset: Preset::Paper, keys: &[] },
];

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

/// The outliers of \[001\] with their kinds; its positions count from 1. Its i counts samples.
pub(super) fn outliers() -> (Vec<f64>, Vec<Option<Wild>>) {
    outliers_with(&SINES)
}

/// The same with these sines on 151 .. 160.
pub(super) fn outliers_with(sines: &[f64; 10]) -> (Vec<f64>, Vec<Option<Wild>>) {
    let (mut errors, mut wild) = (vec![0.0; SAMPLES], vec![None; SAMPLES]);
    let mut put = |position: usize, error: f64, kind: Wild| {
        errors[position - 1] = error;
        wild[position - 1] = Some(kind);
    };
    (96..=105).for_each(|i| put(i, 10.0, Wild::Patch));
    for (i, error) in [(50, -15.0), (70, -10.0), (130, 15.0), (150, 12.0)] {
        put(i, error, Wild::Isolated);
    }
    for (i, sine) in (151..=160).zip(sines) {
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

/// The mean as trend.
const FLAT: Keys = &[("trend_order", "0")];
/// And the significance level of the document.
const FLAT_AT_001: Keys = &[("trend_order", "0"), ("alpha", "0.01")];

/// Method, its label in the table, and the keys that differ from its paper settings.
const METHODS: [(&str, &str, Keys); 6] = [
    ("wright", "wright", &[]),
    ("romanovsky", "romanovsky", FLAT_AT_001),
    ("grubbs", "grubbs", FLAT_AT_001),
    ("chauvenet", "chauvenet", FLAT),
    ("odd-even", "odd-even", FLAT),
    ("diff-median", "diff-median", &[]),
];

fn trial(record: &Record) -> Result<Figures> {
    let trial = Trial::of(record)?;
    let mut figures = Vec::new();
    for (method, label, keys) in METHODS {
        let tally = trial.tally(&trial.judge(&setup(method, Preset::Paper, keys)?)?);
        figures.push((label, figures_of(&tally)));
    }
    figures.push((KNOWN_SIGMA, figures_of(&known_sigma(record))));
    Ok(figures)
}

/// Found, and found of each kind, then false alarms.
#[expect(clippy::cast_precision_loss, reason = "counts of a few hundred samples")]
pub(super) fn figures_of(tally: &Tally) -> Vec<f64> {
    [tally.hits(), tally.isolated, tally.patch, tally.varying, tally.false_alarms].map(|n| n as f64).to_vec()
}

/// Label of the observer who knows mean and deviation.
const KNOWN_SIGMA: &str = "known sigma";

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
pub(super) const ISOLATED: usize = 1;
pub(super) const PATCH: usize = 2;
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
    let labels: Vec<&'static str> = METHODS.iter().map(|m| m.1).chain([KNOWN_SIGMA]).collect();
    let title = "Rejection rate, eq. (42), and false alarms (the figures of the document's table 1 are lost)";
    (vec![rates(title, &labels, runs), table_2::table(runs)], findings::findings(runs))
}

/// The mean rejection rate of a method, in percent: of all outliers, or of those of one kind.
fn rate(runs: Runs<'_>, label: &str, column: usize) -> f64 {
    100.0 * runs.mean(label, column) / WILD[column]
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
