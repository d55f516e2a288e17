//! Repair: what takes the place of an outlier. Section 8 of `docs/methods.md`.
//!
//! Detection and repair are separate choices. Adding a repair: a row in [`REPAIRS`] and, where it interpolates, a
//! file `repair/your_repair.rs`.

use std::ops::Range;

use rayon::prelude::*;

use crate::error::{Error, nearest};
use crate::math::pieces;
use crate::param::{Kind, Param, Settings, Value, always};
use crate::stop::{Stop, Stopped};

mod gaps;
mod linear;
mod polynomial;
mod spline;

pub use gaps::{Gap, fill};

/// One way to repair.
#[derive(Debug)]
pub struct Repair {
    /// The id of `--repair` and the session file.
    pub id: &'static str,
    /// One line for lists.
    pub help: &'static str,
    /// How it finds values.
    pub way: Way,
}

/// How a repair finds the values that it puts in.
#[derive(Debug, Clone, Copy)]
pub enum Way {
    /// What the method's document prescribes.
    Own,
    /// It puts nothing in.
    Remove,
    /// The method's expected value.
    Expected,
    /// From the accepted samples on both sides.
    Interpolate(Interpolate),
}

/// Values at the times `at`, which lie between `before` and `after`; none when there are too few samples for it.
pub type Interpolate = fn(around: &Around<'_>, at: &[f64], settings: &Settings) -> Option<Vec<f64>>;

/// The accepted samples (present and not outliers) of a segment on the two sides of a hole, in order of time; neither
/// side is empty.
#[derive(Debug, Clone, Copy)]
pub struct Around<'a> {
    /// Those before it: times and values; the last is the nearest.
    pub before: (&'a [f64], &'a [f64]),
    /// Those after it: times and values; the first is the nearest.
    pub after: (&'a [f64], &'a [f64]),
}

impl Around<'_> {
    /// The nearest `count` samples of each side together, in order of time: times, values, and how many are before.
    #[must_use]
    pub fn nearest(&self, count: usize) -> (Vec<f64>, Vec<f64>, usize) {
        let skip = self.before.0.len().saturating_sub(count);
        let take = self.after.0.len().min(count);
        let t = [&self.before.0[skip..], &self.after.0[..take]].concat();
        let y = [&self.before.1[skip..], &self.after.1[..take]].concat();
        (t, y, self.before.0.len() - skip)
    }
}

/// Every repair, in the order in which lists show them.
pub static REPAIRS: &[Repair] = &[
    Repair { id: "own", help: "the method's own, as its document prescribes", way: Way::Own },
    Repair { id: "remove", help: "an empty cell", way: Way::Remove },
    Repair {
        id: "linear",
        help: "the line between the accepted samples on both sides",
        way: Way::Interpolate(linear::values),
    },
    Repair {
        id: "spline",
        help: "natural cubic spline through `anchors` accepted samples on each side",
        way: Way::Interpolate(spline::values),
    },
    Repair {
        id: "polynomial",
        help: "least-squares polynomial through `repair_points` accepted samples on each side (the least noisy)",
        way: Way::Interpolate(polynomial::values),
    },
    Repair { id: "expected", help: "the method's expected value", way: Way::Expected },
];

/// The ids of [`REPAIRS`]; a test holds the two together.
const IDS: &[&str] = &["own", "remove", "linear", "spline", "polynomial", "expected"];

/// Which repair.
pub const METHOD: Param = Param {
    key: "method",
    help: "replacement of an outlier",
    unit: "",
    kind: Kind::Choice(IDS),
    default: Value::Word("own"),
    paper: None,
    matters: always,
};

/// The longest run that is repaired.
pub const MAX_FILL: Param = Param {
    key: "max_fill",
    help: "longest run of outliers that is repaired; longer ones are removed whole (0: no limit)",
    unit: "samples",
    kind: Kind::Whole { min: 0, max: 1_000_000, step: 1 },
    default: Value::Whole(20),
    paper: None,
    matters: |s| s.word(METHOD.key) != "remove",
};

/// Whether missing samples are filled.
pub const FILL_GAPS: Param = Param {
    key: "fill_gaps",
    help: "fill missing samples too: off, cells (empty cells of existing rows), rows (also new rows for lost samples)",
    unit: "",
    kind: Kind::Choice(&["off", "cells", "rows"]),
    default: Value::Word("off"),
    paper: None,
    matters: always,
};

/// Accepted samples of the spline.
pub const ANCHORS: Param = Param {
    key: "anchors",
    help: "accepted samples on each side through which the spline goes",
    unit: "samples",
    kind: Kind::Whole { min: 1, max: 100, step: 1 },
    default: Value::Whole(8),
    paper: None,
    matters: |s| s.word(METHOD.key) == "spline",
};

/// Order of the polynomial.
pub const REPAIR_ORDER: Param = Param {
    key: "repair_order",
    help: "order of the repairing polynomial",
    unit: "",
    kind: Kind::Whole { min: 0, max: 6, step: 1 },
    default: Value::Whole(3),
    paper: None,
    matters: |s| s.word(METHOD.key) == "polynomial",
};

/// Accepted samples of the polynomial.
pub const REPAIR_POINTS: Param = Param {
    key: "repair_points",
    help: "accepted samples on each side through which the polynomial is fitted (at least 4 must be there)",
    unit: "samples",
    kind: Kind::Whole { min: 4, max: 200, step: 1 },
    default: Value::Whole(12),
    paper: None,
    matters: |s| s.word(METHOD.key) == "polynomial",
};

/// The parameters of repair, in the order of the panel and the session file.
pub static PARAMS: &[Param] = &[METHOD, MAX_FILL, FILL_GAPS, ANCHORS, REPAIR_ORDER, REPAIR_POINTS];

/// The repair with this id.
///
/// # Errors
/// [`Error::Usage`] with the repairs there are and the nearest.
pub fn find(id: &str) -> Result<&'static Repair, Error> {
    REPAIRS.iter().find(|r| r.id == id).ok_or_else(|| {
        let hint = nearest(id, IDS.iter().copied()).map_or(String::new(), |k| format!("did you mean {k}? "));
        Error::usage(format!("{id}: there is no such repair"), format!("{hint}repairs: {}", IDS.join(", ")))
    })
}

/// The repair that these settings choose.
#[must_use]
pub fn chosen(settings: &Settings) -> &'static Repair {
    let id = settings.word(METHOD.key);
    REPAIRS.iter().find(|r| r.id == id).unwrap_or(&REPAIRS[0])
}

/// A segment with its outliers and what the method has to offer for them.
#[derive(Debug, Clone, Copy)]
pub struct Damage<'a> {
    /// Times of the segment's present samples, in seconds.
    pub t: &'a [f64],
    /// Their values.
    pub y: &'a [f64],
    /// Positions of the outliers, ascending.
    pub outliers: &'a [usize],
    /// The method's own repair for each of them; NaN for none.
    pub own: &'a [f64],
    /// The expected value of each of them; NaN for none.
    pub expected: &'a [f64],
}

/// A value for each outlier; NaN where it is removed. A run is repaired whole or removed whole: runs of more than
/// `max_fill` samples, and those for which the repair has no value at one of their samples, are removed.
///
/// # Errors
/// [`Stopped`] as soon as nobody waits for the result any more.
pub fn repair(damage: &Damage<'_>, settings: &Settings, stop: &Stop) -> Result<Vec<f64>, Stopped> {
    /// Runs in one piece of parallel work: each costs some microseconds.
    const PIECE: usize = 64;
    let limit = fill_limit(settings);
    let short = || runs(damage.outliers).filter(|run| run.len() <= limit);
    stop.check()?;
    let mut values = vec![f64::NAN; damage.outliers.len()];
    let mut put_in = |run: Range<usize>, found: &[f64]| {
        if found.iter().all(|v| v.is_finite()) {
            values[run].copy_from_slice(found);
        }
    };
    match chosen(settings).way {
        Way::Remove => {}
        Way::Own => short().for_each(|run| put_in(run.clone(), &damage.own[run])),
        Way::Expected => short().for_each(|run| put_in(run.clone(), &damage.expected[run])),
        Way::Interpolate(interpolate) => {
            let short: Vec<Range<usize>> = short().collect();
            if short.is_empty() {
                return Ok(values);
            }
            let accepted = Accepted::of(damage, stop)?;
            let find = |run: &Range<usize>| {
                let at: Vec<f64> = damage.outliers[run.clone()].iter().map(|&i| damage.t[i]).collect();
                // Before the run lie its first position less the outliers that precede it.
                accepted.around(damage.outliers[run.start] - run.start).and_then(|a| interpolate(&a, &at, settings))
            };
            let found = short.par_chunks(PIECE).map(|runs| {
                stop.check()?;
                Ok(runs.iter().map(find).collect())
            });
            let found: Vec<Vec<Option<Vec<f64>>>> = found.collect::<Result<_, Stopped>>()?;
            for (run, found) in short.into_iter().zip(found.into_iter().flatten()) {
                if let Some(found) = found {
                    put_in(run, &found);
                }
            }
        }
    }
    Ok(values)
}

/// The line between the accepted samples on both sides of each outlier, however long the run; NaN at the ends.
///
/// # Errors
/// [`Stopped`] as soon as nobody waits for the result any more.
pub fn line(damage: &Damage<'_>, stop: &Stop) -> Result<Vec<f64>, Stopped> {
    let accepted = Accepted::of(damage, stop)?;
    let mut values = Vec::with_capacity(damage.outliers.len());
    for run in runs(damage.outliers) {
        stop.check()?;
        let at: Vec<f64> = damage.outliers[run.clone()].iter().map(|&i| damage.t[i]).collect();
        let around = accepted.around(damage.outliers[run.start] - run.start);
        let found = around.and_then(|a| linear::draw(&a, &at)).unwrap_or_else(|| vec![f64::NAN; at.len()]);
        values.extend(found);
    }
    Ok(values)
}

/// `max_fill` as a limit.
fn fill_limit(settings: &Settings) -> usize {
    match settings.whole(MAX_FILL.key) {
        0 => usize::MAX,
        n => n,
    }
}

/// Runs of neighbours among ascending positions, as ranges of indices into them.
pub fn runs(positions: &[usize]) -> impl Iterator<Item = Range<usize>> + '_ {
    let mut start = 0;
    std::iter::from_fn(move || {
        if start >= positions.len() {
            return None;
        }
        let mut end = start + 1;
        while end < positions.len() && positions[end] == positions[end - 1] + 1 {
            end += 1;
        }
        let run = start..end;
        start = end;
        Some(run)
    })
}

/// The accepted samples of a segment.
struct Accepted {
    t: Vec<f64>,
    y: Vec<f64>,
}

impl Accepted {
    fn of(damage: &Damage<'_>, stop: &Stop) -> Result<Self, Stopped> {
        let n = damage.t.len();
        let (mut t, mut y) = (Vec::with_capacity(n), Vec::with_capacity(n));
        let mut outliers = damage.outliers;
        for begin in (0..n).step_by(pieces::PIECE) {
            stop.check()?;
            let end = n.min(begin + pieces::PIECE);
            let (inside, rest) = outliers.split_at(outliers.partition_point(|&i| i < end));
            outliers = rest;
            // The stretches between them.
            let begins = std::iter::once(begin).chain(inside.iter().map(|i| i + 1));
            for stretch in begins.zip(inside.iter().copied().chain(std::iter::once(end))).map(|(a, b)| a..b) {
                t.extend_from_slice(&damage.t[stretch.clone()]);
                y.extend_from_slice(&damage.y[stretch]);
            }
        }
        Ok(Self { t, y })
    }

    /// The two sides of a hole that has `before` accepted samples before it; none when a side is empty.
    fn around(&self, before: usize) -> Option<Around<'_>> {
        let (bt, at) = self.t.split_at_checked(before)?;
        let (by, ay) = self.y.split_at_checked(before)?;
        (!bt.is_empty() && !at.is_empty()).then_some(Around { before: (bt, by), after: (at, ay) })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn settings(pairs: &[(&str, &str)]) -> Settings {
        let mut settings = Settings::defaults(PARAMS);
        pairs.iter().for_each(|(k, v)| settings.set_text("repair", k, v).unwrap());
        settings
    }

    fn cubic(t: f64) -> f64 {
        5.0 - t + 0.3 * t * t - 0.01 * t * t * t
    }

    /// A cubic track with wild values at `outliers`, repaired.
    fn repaired(outliers: &[usize], pairs: &[(&str, &str)]) -> Vec<f64> {
        let t: Vec<f64> = (0..40).map(|i| f64::from(i) * 0.5).collect();
        let mut y: Vec<f64> = t.iter().map(|&t| cubic(t)).collect();
        outliers.iter().for_each(|&i| y[i] += 100.0);
        let (own, expected) = (vec![f64::NAN; outliers.len()], vec![7.0; outliers.len()]);
        repair(&Damage { t: &t, y: &y, outliers, own: &own, expected: &expected }, &settings(pairs), &Stop::never())
            .unwrap()
    }

    #[test]
    fn the_table_and_the_choice_name_the_same_repairs() {
        assert!(REPAIRS.iter().map(|r| r.id).eq(IDS.iter().copied()));
    }

    #[test]
    fn a_line_a_spline_and_a_polynomial_put_back_what_they_can() {
        let outliers = [10, 11, 12, 25];
        let truth = outliers.map(|i| cubic(i as f64 * 0.5));
        let polynomial = repaired(&outliers, &[("method", "polynomial")]);
        assert!(polynomial.iter().zip(truth).all(|(a, b)| (a - b).abs() < 1e-9), "{polynomial:?}");
        let spline = repaired(&outliers, &[("method", "spline")]);
        assert!(spline.iter().zip(truth).all(|(a, b)| (a - b).abs() < 1e-3), "{spline:?}");
        let linear = repaired(&[10, 11], &[("method", "linear")]);
        let (a, b) = (cubic(4.5), cubic(6.0));
        assert!((linear[0] - (a + (b - a) / 3.0)).abs() < 1e-12);
    }

    #[test]
    fn a_run_over_the_limit_is_left_whole_and_none_reaches_past_the_ends() {
        let outliers = [0, 5, 6, 7, 20, 38, 39];
        let got = repaired(&outliers, &[("method", "linear"), ("max_fill", "2")]);
        let filled: Vec<bool> = got.iter().map(|v| v.is_finite()).collect();
        assert_eq!(filled, [false, false, false, false, true, false, false]);
        let all = repaired(&outliers, &[("method", "expected"), ("max_fill", "0")]);
        assert!(all.iter().all(|v| (*v - 7.0).abs() < 1e-15));
        assert!(repaired(&outliers, &[("method", "own")]).iter().all(|v| v.is_nan()));
    }

    #[test]
    fn a_polynomial_needs_four_accepted_samples_on_each_side() {
        let got = repaired(&[3, 4, 30], &[("method", "polynomial")]);
        assert!(got[0].is_nan() && got[1].is_nan() && got[2].is_finite());
        assert!(repaired(&[4], &[("method", "polynomial")])[0].is_finite());
        // 40 samples: three lie after position 36, four after 35.
        assert!(repaired(&[36], &[("method", "polynomial")])[0].is_nan());
        assert!(repaired(&[35], &[("method", "polynomial")])[0].is_finite());
    }

    #[test]
    fn no_repair_extrapolates_past_the_ends() {
        for method in ["linear", "spline", "polynomial"] {
            assert!(repaired(&[0, 1, 38, 39], &[("method", method)]).iter().all(|v| v.is_nan()), "{method}");
        }
    }

    #[test]
    fn a_repair_is_found_by_its_id_and_a_knob_matters_to_those_that_have_it() {
        assert_eq!(find("spline").unwrap().id, "spline");
        assert!(find("splin").unwrap_err().to_string().contains("did you mean spline?"));
        // `docs/methods.md`, section 8: what is removed is not filled; anchors are the spline's, order and points the
        // polynomial's.
        let matter = |method: &str| -> Vec<&str> {
            let settings = settings(&[("method", method)]);
            PARAMS.iter().filter(|p| (p.matters)(&settings)).map(|p| p.key).collect()
        };
        assert_eq!(matter("remove"), ["method", "fill_gaps"]);
        assert_eq!(matter("linear"), ["method", "max_fill", "fill_gaps"]);
        assert_eq!(matter("spline"), ["method", "max_fill", "fill_gaps", "anchors"]);
        assert_eq!(matter("polynomial"), ["method", "max_fill", "fill_gaps", "repair_order", "repair_points"]);
    }
}
