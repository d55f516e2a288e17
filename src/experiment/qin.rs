//! The comparison of \[003\]: four sliding-window methods at eight windows on the height of a ballistic arc.

use super::record::Record;
use super::reproduction::{Cell, Figures, Finding, Runs, Table};
use super::shown::{Picture, show};
use super::trial::{Trial, setup};
use super::{Experiment, Published};
use crate::error::Result;
use crate::session::Preset;

mod charts;
mod data;
mod findings;

/// The row of the table.
pub const EXPERIMENT: Experiment = Experiment {
    id: "qin",
    help: "sliding windows of 7 to 200 samples on the height of a ballistic arc with 10 % outliers",
    source: "[003] section 3, table 1",
    record: data::record,
    seed: 2022,
    reproduction: Some(Published {
        runs: 100,
        stand_in: data::STAND_IN,
        trial,
        conclude,
        pictures: |record| show(record, &PICTURES),
        charts: charts::charts,
    }),
};

/// The figures of the document.
const PICTURES: [Picture; 12] = [
    Picture {
        title: "Figures 1 and 2: poly-window, window 20, defaults",
        method: "poly-window",
        preset: Preset::Default,
        keys: &[("window", "20")],
    },
    Picture {
        title: "Figure 3: template, window 20, defaults",
        method: "template",
        preset: Preset::Default,
        keys: &[("window", "20")],
    },
    Picture {
        title: "Figure 4: mean-window, window 20, defaults",
        method: "mean-window",
        preset: Preset::Default,
        keys: &[("window", "20")],
    },
    Picture {
        title: "Figure 5: median-window, window 20, defaults",
        method: "median-window",
        preset: Preset::Default,
        keys: &[("window", "20")],
    },
    Picture {
        title: "Figure 7: median-window, window 50, defaults",
        method: "median-window",
        preset: Preset::Default,
        keys: &[("window", "50")],
    },
    Picture {
        title: "Figure 8: poly-window, window 50, defaults",
        method: "poly-window",
        preset: Preset::Default,
        keys: &[("window", "50")],
    },
    Picture {
        title: "Figure 9: template, window 50, defaults",
        method: "template",
        preset: Preset::Default,
        keys: &[("window", "50")],
    },
    Picture {
        title: "Figure 10: mean-window, window 50, defaults",
        method: "mean-window",
        preset: Preset::Default,
        keys: &[("window", "50")],
    },
    Picture {
        title: "Figure 12: median-window, window 200, defaults",
        method: "median-window",
        preset: Preset::Default,
        keys: &[("window", "200")],
    },
    Picture {
        title: "Figure 13: poly-window, window 200, defaults",
        method: "poly-window",
        preset: Preset::Default,
        keys: &[("window", "200")],
    },
    Picture {
        title: "Figure 14: template, window 200, defaults",
        method: "template",
        preset: Preset::Default,
        keys: &[("window", "200")],
    },
    Picture {
        title: "Figure 15: mean-window, window 200, defaults",
        method: "mean-window",
        preset: Preset::Default,
        keys: &[("window", "200")],
    },
];

const WINDOWS: [&str; 8] = ["7", "8", "10", "20", "30", "50", "100", "200"];

/// A method of the table: its id, its name there, and the document's final errors in km by window.
struct Line {
    id: &'static str,
    paper: [&'static str; 8],
    default: [&'static str; 8],
    printed: [f64; 8],
}

/// Labels of the figures by window.
macro_rules! labels {
    ($id:literal, $set:literal) => {
        [
            concat!($id, $set, 7),
            concat!($id, $set, 8),
            concat!($id, $set, 10),
            concat!($id, $set, 20),
            concat!($id, $set, 30),
            concat!($id, $set, 50),
            concat!($id, $set, 100),
            concat!($id, $set, 200),
        ]
    };
}

const POLY: usize = 0;
const TEMPLATE: usize = 1;
const MEAN: usize = 2;
const MEDIAN: usize = 3;

/// Table 1 of \[003\].
const LINES: [Line; 4] = [
    Line {
        id: "poly-window",
        paper: labels!("poly-window", " paper "),
        default: labels!("poly-window", " default "),
        printed: [0.4625, 0.3940, 0.3599, 0.3648, 0.3909, 0.4363, 0.4424, 0.3940],
    },
    Line {
        id: "template",
        paper: labels!("template", " paper "),
        default: labels!("template", " default "),
        printed: [0.4935, 0.4311, 0.4507, 0.9086, 2.2398, 8.9670, 57.1955, 0.2898],
    },
    Line {
        id: "mean-window",
        paper: labels!("mean-window", " paper "),
        default: labels!("mean-window", " default "),
        printed: [0.3757, 0.3699, 0.3372, 0.3747, 0.4110, 0.4425, 0.3401, 3.9807],
    },
    Line {
        id: "median-window",
        paper: labels!("median-window", " paper "),
        default: labels!("median-window", " default "),
        printed: [0.4664, 0.3921, 0.3229, 0.2270, 0.2133, 0.2067, 0.2370, 0.2709],
    },
];

fn trial(record: &Record) -> Result<Figures> {
    let trial = Trial::of(record)?;
    let mut figures = Vec::new();
    for line in &LINES {
        for (at, window) in WINDOWS.iter().enumerate() {
            for (preset, label) in [(Preset::Paper, line.paper[at]), (Preset::Default, line.default[at])] {
                let setup = setup(line.id, preset, &[("window", window)])?;
                let outcome = trial.judge(&setup)?;
                let error = trial.final_error(&outcome);
                let tally = trial.tally(&outcome);
                #[expect(clippy::cast_precision_loss, reason = "counts of some thousand samples")]
                let counts =
                    [tally.hits(), tally.false_alarms, error.removed, tally.isolated, tally.patch].map(|n| n as f64);
                let mut values = vec![error.rms.unwrap_or(f64::NAN)];
                values.extend(counts);
                figures.push((label, values));
            }
        }
    }
    Ok(figures)
}

/// Columns of the figures.
const ERROR: usize = 0;
const FOUND: usize = 1;
const FALSE: usize = 2;
const REMOVED: usize = 3;
const ISOLATED: usize = 4;
const PATCH: usize = 5;

fn conclude(runs: Runs<'_>) -> (Vec<Table>, Vec<Finding>) {
    let mut rows = Vec::new();
    for (at, window) in WINDOWS.iter().enumerate() {
        for line in &LINES {
            let (paper, default) = (line.paper[at], line.default[at]);
            rows.push(vec![
                Cell::text(*window),
                Cell::text(line.id),
                Cell::number(line.printed[at], 4),
                Cell::with_spread(runs.mean(paper, ERROR), runs.spread(paper, ERROR), 3),
                Cell::number(runs.mean(paper, FOUND), 0),
                Cell::with_spread(runs.mean(default, ERROR), runs.spread(default, ERROR), 3),
                Cell::number(runs.mean(default, FOUND), 0),
                Cell::number(runs.mean(default, FALSE), 0),
                Cell::number(runs.mean(default, REMOVED), 0),
            ]);
        }
    }
    let table = Table {
        title: "Table 1: final error of the height in km, eq. (2); found of 238 outliers".into(),
        columns: vec![
            "window",
            "method",
            "[003]",
            "paper settings",
            "found",
            "default settings",
            "found",
            "false",
            "removed",
        ],
        rows,
    };
    (vec![table], findings::findings(runs))
}
