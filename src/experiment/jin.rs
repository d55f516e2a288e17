//! The simulation of \[002\]: a parabola with random outliers, to which the 3-sigma criterion is applied alone and
//! after a least-squares trend has been taken off.

use super::record::{Record, Signal, Wild};
use super::reproduction::{Figures, Finding, Runs, Table};
use super::shown::show;
use super::trial::{Trial, setup};
use super::{Experiment, Published, Random};
use crate::error::Result;
use crate::session::Preset;

pub(super) mod compared;

use compared::{ALONE, Compared, Count, TREND};

/// The row of the table.
pub const EXPERIMENT: Experiment = Experiment {
    id: "jin",
    help: "3 sigma alone and after a least-squares trend, on a parabola with random outliers",
    source: "[002] section 4.1, figures 2 and 5",
    record,
    seed: 2011,
    reproduction: Some(Published {
        runs: 50,
        stand_in: "x = 5 (t/10)^2 over 20 s at 50 Hz, noise at 25 dB below the mean square of x (0.50). The document \
                   shows random outliers in a figure and says neither how many nor how large: 2 % of the samples, 5 \
                   to 15 either way, of which a reader would call none normal. Paper settings: three passes, the \
                   trend fitted once.",
        trial,
        conclude,
        pictures: |record| show(record, &compared::pictures(&BOTH, &[])),
        charts: super::no_charts,
    }),
};

/// What the figures of the document show.
const BOTH: [Compared; 2] = [
    Compared {
        method: ALONE,
        figure: "figure 2",
        said: "the tail of the signal cut, hardly an outlier found",
        title: "Figures 1 and 2: Wright alone",
    },
    Compared {
        method: TREND,
        figure: "figure 5",
        said: "nearly all found",
        title: "Figures 3 to 6: least-squares trend and Wright",
    },
];

const SAMPLES: usize = 1000;
const INTERVAL: f64 = 0.02;
const OUTLIERS: usize = 20;
/// The mean square of x over 0 .. 20 s is 80; 25 dB below it are 80 / 10^2.5.
const POWER: f64 = 80.0;
const RATIO: f64 = 316.227_766_016_837_94;
/// The last tenth of the record, in which figure 2 shows good data cut off.
const TAIL: std::ops::Range<usize> = 900..SAMPLES;

fn record(seed: u64) -> Record {
    let mut random = Random::new(seed);
    let deviation = (POWER / RATIO).sqrt();
    #[expect(clippy::cast_precision_loss, reason = "1000 samples")]
    let t: Vec<f64> = (0..SAMPLES).map(|i| i as f64 * INTERVAL).collect();
    let clean: Vec<f64> = t.iter().map(|t| 0.05 * t * t + deviation * random.normal()).collect();
    let (mut errors, mut wild) = (vec![0.0; SAMPLES], vec![None; SAMPLES]);
    let mut left = OUTLIERS;
    while left > 0 {
        let at = random.whole(0, SAMPLES - 1);
        if wild[at].is_none() {
            wild[at] = Some(Wild::Isolated);
            errors[at] = random.sign() * random.between(5.0, 15.0);
            left -= 1;
        }
    }
    Record::new(Signal::new("t_s", 2, t), vec![Signal::with_errors("x", 4, &clean, &errors)], wild)
}

const FOUND: usize = 0;
const FALSE: usize = 1;
const CUT: usize = 2;

/// The trend and Wright's criterion with this many passes.
const PASSES: [(&str, &str); 4] = [("1 pass", "1"), ("2 passes", "2"), ("3 passes", "3"), ("until nothing new", "0")];

#[expect(clippy::cast_precision_loss, reason = "counts of a thousand samples")]
fn trial(record: &Record) -> Result<Figures> {
    let trial = Trial::of(record)?;
    let mut figures = Vec::new();
    for Compared { method, .. } in BOTH {
        let outcome = trial.judge(&setup(method, Preset::Paper, &[])?)?;
        let tally = trial.tally(&outcome);
        let cut = outcome.outliers.iter().filter(|&&i| TAIL.contains(&i) && record.wild[i].is_none()).count();
        figures.push((method, [tally.hits(), tally.false_alarms, cut].map(|n| n as f64).to_vec()));
    }
    for (label, passes) in PASSES {
        let outcome = trial.judge(&setup("trend-wright", Preset::Paper, &[("max_passes", passes)])?)?;
        let tally = trial.tally(&outcome);
        figures.push((label, [tally.hits(), tally.false_alarms].map(|n| n as f64).to_vec()));
    }
    Ok(figures)
}

fn share(runs: Runs<'_>, label: &str) -> f64 {
    runs.mean(label, FOUND) / 20.0 * 100.0
}

fn conclude(runs: Runs<'_>) -> (Vec<Table>, Vec<Finding>) {
    let mean = |column: usize| move |runs: Runs<'_>, method: &str| runs.mean(method, column);
    let counts = [
        Count { name: "found", of: &mean(FOUND), decimals: 1 },
        Count { name: "found %", of: &share, decimals: 1 },
        Count { name: "false", of: &mean(FALSE), decimals: 1 },
        Count { name: "good in the tail cut", of: &mean(CUT), decimals: 1 },
    ];
    let title = "Figures 2 and 5 as counts: 1000 samples, 20 outliers".into();
    let table = compared::table(title, &BOTH, &counts, runs);
    (vec![table], findings(runs))
}

fn findings(runs: Runs<'_>) -> Vec<Finding> {
    let share = |label: &str| share(runs, label);
    let [one, .., three, all] = PASSES.map(|(label, _)| share(label));
    vec![
        Finding::new(
            "wright-misses",
            "Wright alone hardly finds the outliers of a position record",
            share("wright") < 50.0,
            format!("it finds {:.0} %", share("wright")),
        ),
        Finding::new(
            "wright-cuts-the-tail",
            "Wright alone cuts off the tail of the true signal",
            runs.mean("wright", CUT) >= 1.0,
            format!(
                "{:.1} good samples of the last tenth flagged; the largest |x - mean| / s of a parabola is sqrt(5) = \
                 2.236, so 3 sigma cannot reach its end at any length",
                runs.mean("wright", CUT)
            ),
        ),
        Finding::new(
            "trend-finds-what-wright-leaves",
            "Least-squares trend + Wright removes nearly all outliers and loses no useful data",
            share("trend-wright") >= 95.0
                && runs.mean("trend-wright", FALSE) < 0.01 * 1000.0
                && share("trend-wright") > share("wright"),
            format!(
                "it finds {:.0} % and flags {:.1} of 980 good samples",
                share("trend-wright"),
                runs.mean("trend-wright", FALSE)
            ),
        ),
        Finding::new(
            "two-or-three-passes",
            "Two or three passes of Wright's criterion suffice",
            three >= all - 0.5,
            format!("found in one pass {one:.1} %, in three {three:.1} %, in as many as find something {all:.1} %"),
        ),
        Finding::untold(
            "velocities-need-no-trend",
            "Velocities and accelerations of long records are normal enough for Wright alone",
            "it depends on the course of the flight, of which the document says nothing; a velocity of this parabola \
             rises in a line and has the same trouble",
        ),
    ]
}
