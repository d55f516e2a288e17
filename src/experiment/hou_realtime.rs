//! The real-time comparison of \[001\]: a parabola of 200 samples with the outliers of the off-line experiment, and
//! the predictors of section 3 on it.

use super::hou_offline::{DEVIATION, SAMPLES, figures_of, outliers, outliers_with, rates};
use super::record::{Record, Signal};
use super::reproduction::{Figures, Finding, Runs, Table};
use super::shown::{Picture, show};
use super::trial::{Keys, Trial, setup};
use super::{Experiment, Published, Random};
use crate::error::Result;
use crate::session::Preset;

mod findings;

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
                   the data`); the document gives no window for matched: 31. It makes 10 runs; its tables 3 and 4 are \
                   lost, so its statements are compared, read in four ways. The verdict is that of the rules as printed.",
        trial,
        conclude,
        pictures: |record| show(record, &PICTURES),
        charts: super::no_charts,
    }),
};

/// The figures of the document.
const PICTURES: [Picture; 4] = [
    Picture {
        title: "Figures 2 and 3: five-point, as printed",
        method: "five-point",
        preset: Preset::Paper,
        keys: GIVEN,
    },
    Picture {
        title: "Figures 2 and 3: alpha-beta-gamma, as printed",
        method: "alpha-beta-gamma",
        preset: Preset::Paper,
        keys: GIVEN,
    },
    Picture { title: "Figures 2 and 3: adaptive, as printed", method: "adaptive", preset: Preset::Paper, keys: GIVEN },
    Picture { title: "Figures 2 and 3: matched, as printed", method: "matched", preset: Preset::Paper, keys: MATCHED },
];

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

/// The predictors know the precision of the data.
const GIVEN: Keys = &[("sigma", SIGMA)];
/// And adaptive at three scales.
const AT_3: Keys = &[("sigma", SIGMA), ("k", "3")];
/// The document gives no window for matched measurements.
const MATCHED: Keys = &[("window", "31"), ("repair_rule", "expected")];

/// One way to read the experiment.
struct Reading {
    /// What is read so.
    title: &'static str,
    /// Labels of the figures.
    five_point: &'static str,
    alpha_beta_gamma: &'static str,
    adaptive: &'static str,
    matched: &'static str,
    preset: Preset,
    /// What of adaptive differs from the preset.
    adaptive_keys: Keys,
    /// True where the i of 10 sin(i) is a time in seconds.
    in_seconds: bool,
}

impl Reading {
    fn labels(&self) -> [&'static str; 4] {
        [self.five_point, self.alpha_beta_gamma, self.adaptive, self.matched]
    }
}

/// The labels of a reading: its methods with a word behind.
macro_rules! reading {
    ($word:literal, $title:expr, $preset:expr, $adaptive_keys:expr, $in_seconds:expr) => {
        Reading {
            title: $title,
            five_point: concat!("five-point", $word),
            alpha_beta_gamma: concat!("alpha-beta-gamma", $word),
            adaptive: concat!("adaptive", $word),
            matched: concat!("matched", $word),
            preset: $preset,
            adaptive_keys: $adaptive_keys,
            in_seconds: $in_seconds,
        }
    };
}

/// The readings: as the document prints its rules, with three scales for adaptive as for the fixed limits, with the rules
/// of this program, and as printed with i in seconds.
const READINGS: [Reading; 4] = [
    reading!(
        "",
        "as printed: no rule that ends a run, adaptive at 1.5 scales by eq. (34)",
        Preset::Paper,
        GIVEN,
        false
    ),
    reading!(" (k 3)", "as printed, but adaptive at 3 scales as the fixed limits", Preset::Paper, AT_3, false),
    reading!(
        " (ours)",
        "the defaults here: a run of more than 12 ends the model, adaptive at 3.5 scales",
        Preset::Default,
        GIVEN,
        false
    ),
    reading!(
        " (i in s)",
        "as printed, the varying outliers 10 sin(t) with t in seconds (7.50 .. 7.95)",
        Preset::Paper,
        GIVEN,
        true
    ),
];

/// sin(t) for t = 7.50, 7.55 .. 7.95 s, the times of samples 151 .. 160, written out as those of samples are.
const SINES_OF_SECONDS: [f64; 10] = [
    0.937_999_976_774_738_9,
    0.954_152_266_279_515_1,
    0.967_919_672_031_486_5,
    0.979_267_782_686_2,
    0.988_168_233_877_000_4,
    0.994_598_779_111_176_1,
    0.998_543_345_374_605,
    0.999_992_073_305_918_8,
    0.998_941_341_839_772,
    0.995_393_777_257_619_9,
];

/// The record with the other reading of i.
fn in_seconds(record: &Record) -> Record {
    let mut other = record.clone();
    let (errors, wild) = outliers_with(&SINES_OF_SECONDS);
    if let Some(signal) = other.signals.first_mut()
        && let Some(clean) = &signal.clean
    {
        *signal = Signal::with_errors(signal.name, signal.decimals, clean, &errors);
    }
    other.wild = wild;
    other
}

fn trial(record: &Record) -> Result<Figures> {
    let other = in_seconds(record);
    let (samples, seconds) = (Trial::of(record)?, Trial::of(&other)?);
    let mut figures = Vec::new();
    for reading in &READINGS {
        let trial = if reading.in_seconds { &seconds } else { &samples };
        let methods = ["five-point", "alpha-beta-gamma", "adaptive", "matched"];
        for ((method, label), keys) in
            methods.into_iter().zip(reading.labels()).zip([GIVEN, GIVEN, reading.adaptive_keys, MATCHED])
        {
            let tally = trial.tally(&trial.judge(&setup(method, reading.preset, keys)?)?);
            figures.push((label, figures_of(&tally)));
        }
    }
    Ok(figures)
}

fn conclude(runs: Runs<'_>) -> (Vec<Table>, Vec<Finding>) {
    let table = |reading: &Reading| {
        let title = format!("Rejection rate, eq. (42), and false alarms, {}", reading.title);
        rates(&title, &reading.labels(), runs)
    };
    (READINGS.iter().map(table).collect(), findings::findings(runs))
}
