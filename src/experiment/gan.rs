//! The example of \[004\]: 50 s of a track with a patch at 11 s and a single outlier at 48 s.

use super::record::{Record, Signal, Wild};
use super::reproduction::{Cell, Figures, Finding, Runs, Table};
use super::trial::{Keys, Trial, setup};
use super::{Experiment, Published, Random};
use crate::error::Result;
use crate::session::Preset;

/// The row of the table.
pub const EXPERIMENT: Experiment = Experiment {
    id: "gan",
    help: "Kalman innovation test with infill on 50 s of a track with a patch and a single outlier",
    source: "[004] example 1, figures 1 to 3",
    record,
    seed: 2021,
    reproduction: Some(Published {
        runs: 200,
        stand_in: "The document takes 50 s of a real track and shows it in a figure. Here: a target at 120 m/s that \
                   speeds up and turns gently, its y coordinate at 10 Hz with noise of 5 m; a patch of 8 samples near \
                   150 m at 11 s (longer ones than the filter can coast over are lost whole in a fifth of the runs) \
                   and one outlier of 100 m at 48 s.",
        trial,
        conclude,
    }),
};

const SAMPLES: usize = 500;
const INTERVAL: f64 = 0.1;
const NOISE: f64 = 5.0;
/// Three deviations: a filter that is further off rejects good samples.
const GATE: f64 = 3.0 * NOISE;
const PATCH: std::ops::Range<usize> = 110..118;
const PATCH_SIZE: f64 = 150.0;
const SINGLE: usize = 480;
const SINGLE_SIZE: f64 = 100.0;

fn record(seed: u64) -> Record {
    let mut random = Random::new(seed);
    #[expect(clippy::cast_precision_loss, reason = "500 samples")]
    let t: Vec<f64> = (0..SAMPLES).map(|i| i as f64 * INTERVAL).collect();
    // An acceleration of 2 m/s2 that falls by 0.06 m/s3: the cubic of a gentle turn.
    let clean: Vec<f64> =
        t.iter().map(|t| 2000.0 + 120.0 * t + 1.0 * t * t - 0.01 * t * t * t + NOISE * random.normal()).collect();
    let (mut errors, mut wild) = (vec![0.0; SAMPLES], vec![None; SAMPLES]);
    for i in PATCH {
        errors[i] = PATCH_SIZE + NOISE * random.normal();
        wild[i] = Some(Wild::Patch);
    }
    errors[SINGLE] = SINGLE_SIZE;
    wild[SINGLE] = Some(Wild::Isolated);
    Record::new(Signal::new("t_s", 1, t), vec![Signal::with_errors("y_m", 2, &clean, &errors)], wild)
}

/// What stands in the table: its label, its preset, and the keys that differ from it.
const METHODS: [(&str, Preset, Keys); 5] = [
    (OFF, Preset::Paper, &[("c", "1000")]),
    (COAST, Preset::Paper, &[("patch", "1000")]),
    (SPLINE, Preset::Paper, &[]),
    (CAPPED, Preset::Default, &[("fill", "spline")]),
    (POLYNOMIAL, Preset::Default, &[]),
];
const OFF: &str = "no test";
const COAST: &str = "paper, prediction put in";
const SPLINE: &str = "paper, spline infill";
const CAPPED: &str = "defaults, spline infill";
const POLYNOMIAL: &str = "defaults, polynomial infill";

#[expect(clippy::cast_precision_loss, reason = "counts of 500 samples")]
fn trial(record: &Record) -> Result<Figures> {
    let trial = Trial::of(record)?;
    let mut figures = Vec::new();
    for (label, preset, keys) in METHODS {
        let outcome = trial.judge(&setup("kalman", preset, keys)?)?;
        let tally = trial.tally(&outcome);
        let error = trial.repair_error(&outcome, Wild::Patch).unwrap_or(f64::NAN);
        let after = after_the_patch(record, outcome.detection.judged.expected());
        let values = vec![
            tally.patch as f64,
            tally.isolated as f64,
            tally.false_alarms as f64,
            outcome.counts.removed as f64,
            error,
            after,
        ];
        figures.push((label, values));
    }
    Ok(figures)
}

/// Root mean square of prediction minus truth over the ten samples after the patch: how far the filter has been led
/// astray.
fn after_the_patch(record: &Record, expected: &[f64]) -> f64 {
    let Some(clean) = &record.signals[0].clean else { return f64::NAN };
    let behind = PATCH.end..PATCH.end + 10;
    let off: Vec<f64> = behind.map(|i| expected[i] - clean[i]).filter(|d| d.is_finite()).collect();
    let n = off.len() as f64;
    (off.iter().map(|d| d * d).sum::<f64>() / n).sqrt()
}

const PATCHED: usize = 0;
const ALONE: usize = 1;
const FALSE: usize = 2;
const REMOVED: usize = 3;
const REPAIR: usize = 4;
const AFTER: usize = 5;

fn conclude(runs: Runs<'_>) -> (Vec<Table>, Vec<Finding>) {
    let row = |&(label, ..): &(&'static str, Preset, Keys)| {
        vec![
            Cell::text(label),
            Cell::number(runs.mean(label, PATCHED), 2),
            Cell::number(runs.mean(label, ALONE), 2),
            Cell::number(runs.mean(label, FALSE), 2),
            Cell::number(runs.mean(label, REMOVED), 2),
            Cell::number(runs.mean(label, REPAIR), 1),
            Cell::number(runs.mean(label, AFTER), 1),
        ]
    };
    let table = Table {
        title: "Found of 8 in the patch and 1 alone; errors in m (noise 5 m)".into(),
        columns: vec!["filter", "patch", "alone", "false", "removed", "error on the patch", "prediction behind it"],
        rows: METHODS.iter().map(row).collect(),
    };
    let all = runs.0.len();
    let both = runs.count(|run| run.mean(SPLINE, PATCHED) >= 8.0 && run.mean(SPLINE, ALONE) >= 1.0);
    let findings = vec![
        Finding {
            id: "both-removed",
            statement: "The patch and the single outlier are removed",
            holds: both * 100 >= 95 * all,
            measured: format!("all nine samples flagged in {both} of {all} runs"),
        },
        Finding {
            id: "infill-keeps-the-filter",
            statement: "With the infill the filter stays on the track through the patch",
            holds: runs.mean(SPLINE, AFTER) < GATE
                && runs.mean(POLYNOMIAL, AFTER) < GATE
                && runs.mean(OFF, AFTER) > GATE,
            measured: format!(
                "prediction behind the patch off by {:.1} m without a test, {:.1} m when it coasts, {:.1} m with the \
                 spline, {:.1} m with the polynomial; the gate is 15 m",
                runs.mean(OFF, AFTER),
                runs.mean(COAST, AFTER),
                runs.mean(SPLINE, AFTER),
                runs.mean(POLYNOMIAL, AFTER)
            ),
        },
        Finding {
            id: "spline-better-than-prediction",
            statement: "On the patch the spline is better than keeping the prediction of the filter",
            holds: runs.mean(SPLINE, REPAIR) < runs.mean(COAST, REPAIR),
            measured: format!(
                "off by {:.1} m against {:.1} m; the least-squares polynomial {:.1} m",
                runs.mean(SPLINE, REPAIR),
                runs.mean(COAST, REPAIR),
                runs.mean(POLYNOMIAL, REPAIR)
            ),
        },
    ];
    (vec![table], findings)
}
