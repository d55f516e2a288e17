//! Which method when: what the documents say of their own comparisons, with the figures measured on the same
//! experiments here.

/// A row of the table.
#[derive(Debug, Clone, Copy)]
pub struct Choice {
    /// Kind of outlier.
    pub outliers: &'static str,
    /// How many in a row.
    pub run: &'static str,
    /// What the record is like: sampling, course, how many samples.
    pub record: &'static str,
    /// True where samples are judged as they arrive.
    pub real_time: bool,
    /// Id of the method.
    pub method: &'static str,
    /// What the document says.
    pub document: &'static str,
    /// What was measured.
    pub measured: &'static [Measured],
}

/// A figure of a table that `reproduce` prints.
#[derive(Debug, Clone, Copy)]
pub struct Measured {
    /// Id of the experiment.
    pub experiment: &'static str,
    /// First cells of the row, the first of its kind in the tables.
    pub row: &'static [&'static str],
    /// Number of the column, from 0.
    pub column: usize,
    /// The figure with the experiment's own number of runs.
    pub value: f64,
    /// What it is, before the figure and behind it.
    pub words: (&'static str, &'static str),
}

impl Measured {
    /// The figure in words.
    #[must_use]
    pub fn text(&self) -> String {
        let (before, behind) = self.words;
        let value = if self.value < 10.0 && self.value.fract() != 0.0 {
            format!("{:.1}", self.value)
        } else {
            format!("{:.0}", self.value)
        };
        format!("{before} {value}{behind}")
    }
}

impl Choice {
    /// What was measured, in words.
    #[must_use]
    pub fn measured(&self) -> String {
        self.measured.iter().map(Measured::text).collect::<Vec<_>>().join(", ")
    }

    /// After the fact, or in real time.
    #[must_use]
    pub fn mode(&self) -> &'static str {
        if self.real_time { "real time" } else { "recorded" }
    }
}

const fn of(
    experiment: &'static str,
    row: &'static [&'static str],
    column: usize,
    value: f64,
    words: (&'static str, &'static str),
) -> Measured {
    Measured { experiment, row, column, value, words }
}

const OFFLINE: &str = "hou-offline";
const REALTIME: &str = "hou-realtime";

/// The table. Columns of the experiments of \[001\]: 2 isolated, 3 patch, 4 varying (percent), 6 false alarms.
pub static CHOICES: &[Choice] = &[
    Choice {
        outliers: "isolated",
        run: "1",
        record: "much data without a trend",
        real_time: false,
        method: "wright",
        document: "[001] simple, good for isolated outliers in much data",
        measured: &[of(OFFLINE, &["wright"], 2, 100.0, ("isolated", " %"))],
    },
    Choice {
        outliers: "isolated",
        run: "1",
        record: "a position with a slow trend",
        real_time: false,
        method: "trend-wright",
        document: "[002] finds nearly all, where Wright alone finds hardly any",
        measured: &[
            of("jin", &["trend-wright"], 4, 100.0, ("found", " %")),
            of("jin", &["wright"], 4, 12.0, ("wright alone", " %")),
        ],
    },
    Choice {
        outliers: "isolated, runs",
        run: "1 .. 10",
        record: "4 to 20 samples, or blocks of them",
        real_time: false,
        method: "romanovsky",
        document: "[001] good for both, needs mean and deviation anew for each sample",
        measured: &[
            of(OFFLINE, &["romanovsky"], 2, 100.0, ("isolated", " %")),
            of(OFFLINE, &["romanovsky"], 3, 100.0, ("patch", " %")),
            of(OFFLINE, &["romanovsky"], 6, 2.3, ("false", " of 176")),
        ],
    },
    Choice {
        outliers: "isolated, runs, varying",
        run: "1 .. 10",
        record: "20 to 100 samples",
        real_time: false,
        method: "grubbs",
        document: "[001] the best of its criteria",
        measured: &[of(
            OFFLINE,
            &["grubbs"],
            1,
            13.0,
            ("found", " % of 24 outliers that mask each other (gesd is made for that)"),
        )],
    },
    Choice {
        outliers: "runs, varying",
        run: "10",
        record: "much data, few isolated ones",
        real_time: false,
        method: "odd-even",
        document: "[001] for runs and varying outliers, with false alarms",
        measured: &[
            of(OFFLINE, &["odd-even"], 3, 89.0, ("patch", " %")),
            of(OFFLINE, &["odd-even"], 4, 50.0, ("varying", " %")),
        ],
    },
    Choice {
        outliers: "isolated, runs",
        run: "up to a third of the window",
        record: "even sampling, windows of 10 to 50",
        real_time: false,
        method: "median-window",
        document: "[003] small errors throughout, good for both kinds",
        measured: &[
            of("qin", &["50", "median-window"], 6, 227.0, ("window 50:", " of 238 found")),
            of("qin", &["50", "poly-window"], 6, 223.0, ("poly-window", "")),
        ],
    },
    Choice {
        outliers: "isolated, runs",
        run: "up to max_run",
        record: "fast sampling, lost samples, steps",
        real_time: false,
        method: "two-sided",
        document: "[000] better than one direction, and than any fixed order",
        measured: &[
            of("jiang", &["variable, both"], 7, 9.0, ("missed", " of 135")),
            of("jiang", &["variable, both"], 8, 33.0, ("false", " of 19150")),
        ],
    },
    Choice {
        outliers: "isolated, runs",
        run: "5 .. 8",
        record: "manoeuvres, one channel or several",
        real_time: false,
        method: "kalman",
        document: "[004] removes both, and the fill keeps the filter through the run",
        measured: &[
            of("gan", &["defaults, polynomial infill"], 1, 8.0, ("patch", " of 8")),
            of("gan", &["defaults, polynomial infill"], 3, 1.2, ("false", " of 491")),
        ],
    },
    Choice {
        outliers: "isolated",
        run: "1",
        record: "five samples lie on a line",
        real_time: true,
        method: "five-point",
        document: "[001] the best for isolated outliers, at the least cost",
        measured: &[
            of(REALTIME, &["five-point (ours)"], 2, 98.0, ("isolated", " %")),
            of(REALTIME, &["five-point (ours)"], 6, 1.6, ("false", " of 176")),
        ],
    },
    Choice {
        outliers: "isolated, runs, varying together",
        run: "1 .. 10",
        record: "noise that changes",
        real_time: true,
        method: "adaptive",
        document: "[001] the best for runs and where all kinds mix",
        measured: &[
            of(REALTIME, &["adaptive (ours)"], 1, 43.0, ("found", " %")),
            of(REALTIME, &["alpha-beta-gamma (ours)"], 1, 75.0, ("alpha-beta-gamma", " %")),
            of(REALTIME, &["adaptive"], 6, 141.0, ("false as printed", " of 176")),
        ],
    },
    Choice {
        outliers: "varying",
        run: "10",
        record: "accelerating tracks",
        real_time: true,
        method: "alpha-beta-gamma",
        document: "[001] the best for varying outliers",
        measured: &[
            of(REALTIME, &["alpha-beta-gamma (ours)"], 4, 53.0, ("varying", " %")),
            of(REALTIME, &["five-point (ours)"], 4, 33.0, ("five-point", " %")),
        ],
    },
    Choice {
        outliers: "isolated, runs, varying",
        run: "up to half the window",
        record: "a second channel measures the rate",
        real_time: true,
        method: "matched",
        document: "[001] next to adaptive, with the fewest false alarms",
        measured: &[
            of(REALTIME, &["matched (ours)"], 1, 83.0, ("found", " %")),
            of(REALTIME, &["matched (ours)"], 6, 0.2, ("false", " of 176")),
        ],
    },
];
