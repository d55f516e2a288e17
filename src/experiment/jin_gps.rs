//! The measured example of \[002\]: a GPS position with many outliers, to which the 3-sigma criterion is applied alone and
//! after a least-squares trend has been taken off.

use std::path::Path;

use super::jin::compared::{self, ALONE, Compared, Count, TREND};
use super::record::{Record, Signal, Wild};
use super::reproduction::{Figures, Finding, Runs, Table};
use super::shown::show;
use super::trial::{Trial, setup};
use super::{Experiment, Published, Random};
use crate::error::Result;
use crate::method::{Verdict, hampel, judge_channel};
use crate::param::Settings;
use crate::session::Preset;
use crate::stop::Stop;
use crate::track::{LoadOptions, Source, load};

/// The row of the table.
pub const EXPERIMENT: Experiment = Experiment {
    id: "jin-gps",
    help: "3 sigma alone and after a least-squares trend, on a GPS position with many outliers",
    source: "[002] section 4.2, figures 7 to 12",
    record,
    seed: 2011,
    reproduction: Some(Published {
        runs: 1,
        stand_in: "The document's GPS record of a flight, 50 Hz, is in figures only. Where the working folder has \
                   ../shared/data/gnss_daily_kmin.csv, its north position stands in: 19 years of daily positions with a \
                   drift of 0.85 m; wild is what lies 4 robust deviations or more from the median of 41 days around (ours: the \
                   document calls wild what lies 3 off, which normal noise does 19 times among that number), and there are few of them. \
                   Elsewhere a simulated one: x = 2000 + 150 t - 2 t^2 over 40 s at 50 Hz with noise of 1 m, 5 % of the \
                   samples 10 to 60 m off. Paper settings, one trend for the whole record.",
        trial,
        conclude,
        pictures: |record| show(&judged(record).0, &compared::pictures(&BOTH, &[WHOLE])),
        charts: super::no_charts,
    }),
};

/// What the figures of the document show.
const BOTH: [Compared; 2] = [
    Compared {
        method: ALONE,
        figure: "figure 8",
        said: "hardly an outlier removed, useful data lost",
        title: "Figures 7 and 8: Wright alone",
    },
    Compared {
        method: TREND,
        figure: "figure 11",
        said: "very good",
        title: "Figures 9 to 12: least-squares trend and Wright",
    },
];

/// A real record of positions with wild ones, where it lies beside the working folder.
const REAL: &str = "../shared/data/gnss_daily_kmin.csv";
const CHANNEL: &str = "north_m";

const SAMPLES: usize = 2000;
const INTERVAL: f64 = 0.02;
const OUTLIERS: usize = 100;

fn record(seed: u64) -> Record {
    let mut random = Random::new(seed);
    #[expect(clippy::cast_precision_loss, reason = "2000 samples")]
    let t: Vec<f64> = (0..SAMPLES).map(|i| i as f64 * INTERVAL).collect();
    let clean: Vec<f64> = t.iter().map(|t| 2000.0 + 150.0 * t - 2.0 * t * t + random.normal()).collect();
    let (mut errors, mut wild) = (vec![0.0; SAMPLES], vec![None; SAMPLES]);
    let mut left = OUTLIERS;
    while left > 0 {
        let at = random.whole(0, SAMPLES - 1);
        if wild[at].is_none() {
            wild[at] = Some(Wild::Isolated);
            errors[at] = random.sign() * random.between(10.0, 60.0);
            left -= 1;
        }
    }
    Record::new(Signal::new("t_s", 2, t), vec![Signal::with_errors("x_m", 3, &clean, &errors)], wild)
}

/// What counts as wild on the real record, in robust deviations from the median around. \[002\] calls wild what lies three
/// deviations off or more, which normal noise does 19 times among 7000 samples; at four it does so 0.4 times. The number
/// is ours.
const WILD_FROM: &str = "4";

/// The real record, where it is there and can be read.
fn real(path: &Path) -> Option<Record> {
    if !path.is_file() {
        return None;
    }
    let track = load(&Source::File(path.to_path_buf()), &LoadOptions::default()).ok()?;
    let series = track.channel(CHANNEL)?.series(&track.time);
    let method = &hampel::Hampel;
    let mut settings = Settings::defaults(crate::method::Method::about(method).params);
    for (key, text) in [("window", "41"), ("k", WILD_FROM), ("floor", "auto"), ("max_gap", "off")] {
        settings.set_text("hampel", key, text).ok()?;
    }
    let judged = judge_channel(method, &series, None, &settings, &Stop::never()).ok()?;
    let wild = judged.verdict.iter().map(|v| (*v == Verdict::Outlier).then_some(Wild::Isolated)).collect();
    let first = series.t.first().copied()?;
    let t = series.t.iter().map(|t| t - first).collect();
    Some(Record::new(Signal::new("t_s", 0, t), vec![Signal::new(CHANNEL, 5, series.y.to_vec())], wild))
}

/// The record that is judged.
fn judged(simulated: &Record) -> (Record, bool) {
    real(Path::new(REAL)).map_or_else(|| (simulated.clone(), false), |real| (real, true))
}

const WHOLE: (&str, &str) = ("max_gap", "off");
const WILD: usize = 0;
const FOUND: usize = 1;
const FALSE: usize = 2;
/// Label of whether the record was a real one.
const IS_REAL: &str = "real";

fn trial(simulated: &Record) -> Result<Figures> {
    let (record, is_real) = judged(simulated);
    let mut figures = figures(&record)?;
    figures.push((IS_REAL, vec![f64::from(u8::from(is_real))]));
    Ok(figures)
}

#[expect(clippy::cast_precision_loss, reason = "counts of some thousand samples")]
fn figures(record: &Record) -> Result<Figures> {
    let trial = Trial::of(record)?;
    let figures = |Compared { method, .. }: Compared| {
        let tally = trial.tally(&trial.judge(&setup(method, Preset::Paper, &[WHOLE])?)?);
        let counts = [tally.hits() + tally.missed, tally.hits(), tally.false_alarms].map(|n| n as f64);
        Ok((method, counts.to_vec()))
    };
    BOTH.into_iter().map(figures).collect()
}

fn conclude(runs: Runs<'_>) -> (Vec<Table>, Vec<Finding>) {
    let which = if runs.mean(IS_REAL, 0) > 0.5 { REAL } else { "simulated" };
    let mean = |column: usize| move |runs: Runs<'_>, method: &str| runs.mean(method, column);
    let counts = [
        Count { name: "wild", of: &mean(WILD), decimals: 0 },
        Count { name: "found", of: &mean(FOUND), decimals: 0 },
        Count { name: "others flagged", of: &mean(FALSE), decimals: 0 },
    ];
    let table = compared::table(format!("Figures 8 and 11 as counts, on {which}"), &BOTH, &counts, runs);
    let share = |method: &str| 100.0 * runs.mean(method, FOUND) / runs.mean(method, WILD);
    let findings = vec![
        Finding::new(
            "wright-removes-hardly-any",
            "Wright alone removes hardly any outlier of the measured position",
            share("wright") < 50.0,
            format!("it finds {:.0} % on {which}", share("wright")),
        ),
        Finding::new(
            "wright-loses-data",
            "Wright alone loses a part of the useful data",
            runs.mean("wright", FALSE) >= 1.0,
            format!("{:.0} samples flagged that are not wild", runs.mean("wright", FALSE)),
        ),
        Finding::new(
            "trend-and-wright-very-good",
            "Least-squares trend + Wright has a very good effect",
            share("trend-wright") >= 90.0 && share("trend-wright") > share("wright"),
            format!(
                "it finds {:.0} %, and flags {:.0} others{}",
                share("trend-wright"),
                runs.mean("trend-wright", FALSE),
                if which == REAL { "; a parabola leaves the seasons of 19 years in the residual" } else { "" }
            ),
        ),
    ];
    (vec![table], findings)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::experiment::Held;

    /// A trend of 4,250 m hides 60 m from three deviations; a parabola is taken off exactly.
    #[test]
    fn the_trend_decides_on_the_simulated_record() {
        let figures = figures(&record(1)).unwrap();
        let of = |method: &str| figures.iter().find(|f| f.0 == method).unwrap().1.clone();
        assert_eq!(of("wright")[WILD], 100.0);
        assert!(of("wright")[FOUND] < 5.0 && of("trend-wright")[FOUND] > 90.0, "{figures:?}");
    }

    /// Each statement on the simulated record: what hides in a trend of 4,250 m is found without it. Three deviations of a
    /// parabola (sqrt(5) = 2.236 at its end) cut off none of its useful data.
    #[test]
    fn the_statements_on_the_simulated_record() {
        let mut figures = figures(&record(1)).unwrap();
        figures.push((IS_REAL, vec![0.0]));
        let (_, findings) = conclude(Runs(&[figures]));
        let held: Vec<(&str, Held)> = findings.iter().map(|finding| (finding.id, finding.held)).collect();
        let wanted = [
            ("wright-removes-hardly-any", Held::Yes),
            ("wright-loses-data", Held::No),
            ("trend-and-wright-very-good", Held::Yes),
        ];
        assert_eq!(held, wanted);
    }

    #[test]
    fn without_the_real_record_there_is_none() {
        assert!(real(Path::new("no/such/record.csv")).is_none());
    }
}
