//! The example of \[004\]: 50 s of a track with a patch at 11 s and a single outlier at 48 s.

use super::record::{Record, Signal, Wild};
use super::reproduction::{Cell, Figures, Finding, Runs, Table};
use super::shown::{Picture, Shown, show};
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
        pictures,
        charts: super::no_charts,
    }),
};

/// The figures of the document.
const PICTURES: [Picture; 3] = [
    Picture {
        title: "Figures 1 and 2: the track with the outliers, and without them",
        method: "kalman",
        preset: Preset::Paper,
        keys: &[("patch", "1000")],
    },
    Picture {
        title: "Figure 3: the patch filled by the spline and filtered again, with the filtered track",
        method: "kalman",
        preset: Preset::Paper,
        keys: &[],
    },
    Picture {
        title: "Figure 3 with the defaults: the patch filled by the polynomial",
        method: "kalman",
        preset: Preset::Default,
        keys: &[],
    },
];

/// Figure 3 is of the track that the filter makes of the filled samples.
fn pictures(record: &Record) -> Result<Vec<Shown>> {
    let mut shown = show(record, &PICTURES)?;
    shown.iter_mut().skip(1).try_for_each(Shown::filter)?;
    Ok(shown)
}

const SAMPLES: usize = 500;
const INTERVAL: f64 = 0.1;
const NOISE: f64 = 5.0;
const PATCH: std::ops::Range<usize> = 110..118;
/// Good samples that a filter which was led astray by the patch rejects.
const BEHIND: std::ops::Range<usize> = PATCH.end..PATCH.end + 10;
/// Where the filtered track of figure 3 shows what became of the patch.
const SHOWN: std::ops::Range<usize> = PATCH.start..PATCH.end + 10;
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
    let (mut figures, mut singles) = (Vec::new(), Vec::new());
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
            outcome.outliers.iter().filter(|i| BEHIND.contains(i)).count() as f64,
            track_error(record, &trial.filtered(&outcome)?),
        ];
        figures.push((label, values));
        singles.push(outcome.fix(SINGLE).unwrap_or(f64::NAN));
    }
    // Coasting alone, and with the infill.
    figures.push((AT_THE_SINGLE, vec![(singles[1] - singles[2]).abs()]));
    figures.push((INNOVATIONS, innovations(record)?));
    Ok(figures)
}

/// Root mean square of the filtered track minus the truth on the patch and behind it.
fn track_error(record: &Record, track: &[f64]) -> f64 {
    let Some(clean) = &record.signals[0].clean else { return f64::NAN };
    let off: Vec<f64> = SHOWN.filter_map(|i| Some(track.get(i)? - clean[i])).filter(|d| d.is_finite()).collect();
    (off.iter().map(|d| d * d).sum::<f64>() / off.len() as f64).sqrt()
}

/// Label of how far the value put in for the single outlier differs with the infill from that of the usual filter.
const AT_THE_SINGLE: &str = "at the single outlier";
/// Label of what is said of the innovations of a record without outliers.
const INNOVATIONS: &str = "innovations";

/// Of a record without outliers: the share in percent of innovations within two deviations, and of those above minus two.
#[expect(clippy::cast_precision_loss, reason = "500 samples")]
fn innovations(record: &Record) -> Result<Vec<f64>> {
    let mut clean = record.clone();
    if let Some(signal) = clean.signals.first_mut() {
        signal.values = signal.clean.clone().unwrap_or_default();
    }
    clean.wild.fill(None);
    let trial = Trial::of(&clean)?;
    // With so wide a gate nothing is rejected, and the tolerance is a thousand deviations.
    let outcome = trial.judge(&setup("kalman", Preset::Paper, &[("c", "1000"), ("sigma", "5")])?)?;
    let judged = &outcome.detection.judged;
    let deviations = |(i, y): (usize, &f64)| Some((y - judged.expected()[i]) / judged.tolerance(i)? * 1000.0);
    let d: Vec<f64> = trial.series().y.iter().enumerate().filter_map(deviations).filter(|d| d.is_finite()).collect();
    let share = |such: &dyn Fn(f64) -> bool| 100.0 * d.iter().filter(|d| such(**d)).count() as f64 / d.len() as f64;
    Ok(vec![share(&|d| d.abs() < 2.0), share(&|d| d > -2.0)])
}

/// Root mean square of prediction minus truth over the ten samples after the patch: how far the filter has been led
/// astray.
fn after_the_patch(record: &Record, expected: &[f64]) -> f64 {
    let Some(clean) = &record.signals[0].clean else { return f64::NAN };
    let off: Vec<f64> = BEHIND.map(|i| expected[i] - clean[i]).filter(|d| d.is_finite()).collect();
    let n = off.len() as f64;
    (off.iter().map(|d| d * d).sum::<f64>() / n).sqrt()
}

const PATCHED: usize = 0;
const ALONE: usize = 1;
const FALSE: usize = 2;
const REMOVED: usize = 3;
const REPAIR: usize = 4;
const AFTER: usize = 5;
const REJECTED: usize = 6;
const TRACK: usize = 7;

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
            Cell::number(runs.mean(label, TRACK), 1),
        ]
    };
    let table = Table {
        title: "Found of 8 in the patch and 1 alone; errors in m (noise 5 m)".into(),
        columns: vec![
            "filter",
            "patch",
            "alone",
            "false",
            "removed",
            "error on the patch",
            "prediction behind it",
            "filtered track",
        ],
        rows: METHODS.iter().map(row).collect(),
    };
    (vec![table], findings(runs))
}

fn findings(runs: Runs<'_>) -> Vec<Finding> {
    let all = runs.0.len();
    let both = runs.count(|run| run.mean(SPLINE, PATCHED) >= 8.0 && run.mean(SPLINE, ALONE) >= 1.0);
    let stays = |label: &str| runs.count(|run| run.mean(label, REJECTED) < 1.0);
    let nearer = |label: &str| runs.count(|run| run.mean(label, TRACK) < run.mean(COAST, TRACK));
    let [within, above] = [0, 1].map(|column| runs.mean(INNOVATIONS, column));
    let apart = runs.mean(AT_THE_SINGLE, 0);
    vec![
        Finding::new(
            "both-removed",
            "The patch and the single outlier are removed",
            both * 100 >= 95 * all,
            format!("all nine samples flagged in {both} of {all} runs"),
        ),
        Finding::new(
            "single-as-by-the-usual-filter",
            "A single outlier is dealt with as by the usual filter, infill or not",
            runs.mean(COAST, ALONE) >= 1.0 && runs.mean(SPLINE, ALONE) >= 1.0 && apart < 0.1 * NOISE,
            format!("found by both; what is put in its place differs by {apart:.3} m on average, the noise is 5 m"),
        ),
        Finding::new(
            "infill-keeps-the-filter",
            "Filtered over the infill, the track follows the points through the patch better than the usual filter's",
            2 * nearer(SPLINE) > all && runs.mean(SPLINE, TRACK) < runs.mean(COAST, TRACK),
            format!(
                "the filtered track (figure 3) is nearer to the truth on the patch and ten samples behind it in {} of {all} \
                 runs: {:.1} m off on average against {:.1} m, with the polynomial and the defaults {:.1} m, without a test \
                 {:.1} m; where the filter of the document is lost behind the patch it stays lost, for nothing starts it \
                 again (none of ten good samples there rejected in {} runs with the spline, {} when it coasts, {} with the \
                 polynomial and the defaults)",
                nearer(SPLINE),
                runs.mean(SPLINE, TRACK),
                runs.mean(COAST, TRACK),
                runs.mean(POLYNOMIAL, TRACK),
                runs.mean(OFF, TRACK),
                stays(SPLINE),
                stays(COAST),
                stays(POLYNOMIAL),
            ),
        ),
        Finding::new(
            "spline-better-than-prediction",
            "On the patch the spline is better than keeping the prediction of the filter",
            runs.mean(SPLINE, REPAIR) < runs.mean(COAST, REPAIR),
            format!(
                "off by {:.1} m against {:.1} m; the least-squares polynomial {:.1} m",
                runs.mean(SPLINE, REPAIR),
                runs.mean(COAST, REPAIR),
                runs.mean(POLYNOMIAL, REPAIR)
            ),
        ),
        Finding::new(
            "good-samples-pass",
            "A good sample passes a gate of two deviations with a probability of 95.5 %",
            within >= 95.0,
            format!("{within:.1} % of the innovations of the record without outliers lie within two deviations"),
        ),
        Finding::new(
            "outliers-are-found",
            "An outlier two deviations beyond the gate is found with a probability of 95.5 %",
            above >= 95.5,
            format!(
                "found where the innovation without it is above minus two deviations: {above:.1} % (97.7 % of normal \
                 noise; the document counts both tails, and its condition itself is lost)"
            ),
        ),
    ]
}
