//! The real-time comparison of \[001\]: a parabola of 200 samples with the outliers of the off-line experiment, and
//! the predictors of section 3 on it.

use super::hou_offline::{DEVIATION, FALSE, FOUND, SAMPLES, VARYING, figures_of, outliers, rates};
use super::record::{Record, Signal};
use super::reproduction::{Figures, Finding, Runs, Table};
use super::trial::{Keys, Trial, setup};
use super::{Experiment, Published, Random};
use crate::error::Result;
use crate::session::Preset;

/// The row of the table.
pub const EXPERIMENT: Experiment = Experiment {
    id: "hou-realtime",
    help: "real-time predictors on a parabola with isolated, constant-patch and time-varying outliers",
    source: "[001] section 4, tables 3 and 4",
    record,
    seed: 2001,
    reproduction: Some(Published {
        runs: 200,
        stand_in: "y = 0.4 t^2 + 5 t + 220 at 0.05 s, noise and outliers of hou-offline. For the matched \
                   measurements the document has no data: the rate is 0.8 t + 5 with noise of 0.1 per second, good \
                   enough that the rate is not what limits the method. sigma is known (the document's `precision of \
                   the data`); max_run is 12, for the outliers come in runs of 10 and 11. The document makes 10 \
                   runs; its tables are lost, so its statements are compared.",
        trial,
        conclude,
    }),
};

/// Interval in seconds.
const INTERVAL: f64 = 0.05;
/// Deviation of the simulated rate, per second.
const RATE_NOISE: f64 = 0.1;

fn record(seed: u64) -> Record {
    let mut random = Random::new(seed);
    #[expect(clippy::cast_precision_loss, reason = "200 samples")]
    let t: Vec<f64> = (0..SAMPLES).map(|i| i as f64 * INTERVAL).collect();
    let clean: Vec<f64> = t.iter().map(|t| 0.4 * t * t + 5.0 * t + 220.0 + DEVIATION * random.normal()).collect();
    let rate = t.iter().map(|t| 0.8 * t + 5.0 + RATE_NOISE * random.normal()).collect();
    let (errors, wild) = outliers();
    let signals = vec![Signal::with_errors("y", 4, &clean, &errors), Signal::new("y_rate", 4, rate)];
    Record::new(Signal::new("t_s", 2, t), signals, wild)
}

/// The precision of the data, as text for a setting.
const SIGMA: &str = "1.4142135623730951";

/// Method, its label in the table, its preset, and the keys that differ from it.
const METHODS: [(&str, &str, Preset, Keys); 5] = [
    ("five-point", FIVE_POINT, Preset::Default, &[("sigma", SIGMA)]),
    ("alpha-beta-gamma", ALPHA_BETA_GAMMA, Preset::Default, &[("sigma", SIGMA), ("alpha", "0.4")]),
    ("adaptive", ADAPTIVE, Preset::Default, &[("sigma", SIGMA)]),
    ("adaptive", PRINTED, Preset::Paper, &[("sigma", SIGMA), ("max_run", "12")]),
    ("matched", MATCHED, Preset::Default, &[("window", "31"), ("repair_rule", "expected")]),
];
const FIVE_POINT: &str = "five-point";
const ALPHA_BETA_GAMMA: &str = "alpha-beta-gamma";
const ADAPTIVE: &str = "adaptive, winsor";
const PRINTED: &str = "adaptive, as printed";
const MATCHED: &str = "matched";

fn trial(record: &Record) -> Result<Figures> {
    let trial = Trial::of(record)?;
    let judge = |&(method, label, preset, keys): &(&str, &'static str, Preset, Keys)| {
        let tally = trial.tally(&trial.judge(&setup(method, preset, keys)?)?);
        Ok((label, figures_of(&tally)))
    };
    METHODS.iter().map(judge).collect()
}

fn conclude(runs: Runs<'_>) -> (Vec<Table>, Vec<Finding>) {
    let labels: Vec<&'static str> = METHODS.iter().map(|m| m.1).collect();
    let title = "Rejection rate, eq. (42), and false alarms (the document's tables 3 and 4 are lost)";
    let found = |label: &str| format!("{label} {:.1}", runs.mean(label, FOUND));
    let falses = |label: &str| format!("{label} {:.1}", runs.mean(label, FALSE));
    let all = |figure: &dyn Fn(&str) -> String| labels.iter().map(|l| figure(l)).collect::<Vec<_>>().join(", ");
    let beats = |a: &str, b: &str, column: usize| runs.mean(a, column) > runs.mean(b, column);
    let others = |than: &'static str| labels.iter().copied().filter(move |l| *l != than);
    let adaptive = |against: &str| [ADAPTIVE, PRINTED].iter().any(|a| runs.mean(a, FOUND) >= runs.mean(against, FOUND));
    let findings = vec![
        Finding {
            id: "five-point-beats-alpha-beta-gamma",
            statement: "Five-point prediction is better than alpha-beta-gamma: more found, fewer false alarms",
            holds: beats(FIVE_POINT, ALPHA_BETA_GAMMA, FOUND) && !beats(FIVE_POINT, ALPHA_BETA_GAMMA, FALSE),
            measured: format!(
                "found of 24: {}, {}; false: {}, {}",
                found(FIVE_POINT),
                found(ALPHA_BETA_GAMMA),
                falses(FIVE_POINT),
                falses(ALPHA_BETA_GAMMA)
            ),
        },
        Finding {
            id: "adaptive-best-when-mixed",
            statement: "The adaptive tolerance is best when all three kinds mix",
            holds: [FIVE_POINT, ALPHA_BETA_GAMMA, MATCHED].iter().all(|l| adaptive(l)),
            measured: format!("found of 24: {}", all(&found)),
        },
        Finding {
            id: "matched-fewest-false",
            statement: "Matched measurements give the fewest false alarms",
            holds: others(MATCHED).all(|l| runs.mean(MATCHED, FALSE) <= runs.mean(l, FALSE)),
            measured: format!("false: {}", all(&falses)),
        },
        Finding {
            id: "alpha-beta-gamma-best-on-varying",
            statement: "Of the predictors, alpha-beta-gamma is best on the time-varying kind",
            holds: [FIVE_POINT, ADAPTIVE, PRINTED]
                .iter()
                .all(|l| runs.mean(ALPHA_BETA_GAMMA, VARYING) >= runs.mean(l, VARYING)),
            measured: format!(
                "found of 10: {}",
                labels.iter().map(|l| format!("{l} {:.1}", runs.mean(l, VARYING))).collect::<Vec<_>>().join(", ")
            ),
        },
    ];
    (vec![rates(title, &labels, runs)], findings)
}
