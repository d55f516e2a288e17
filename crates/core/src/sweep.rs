//! Threshold advice: how many samples a method flags along one of its parameters, and where that count stands still
//! (section 8a of `docs/methods.md`). True wild points stand far off: between the noise and them lies a range of
//! thresholds that all flag the same samples.

use std::fmt;
use std::ops::Range;

use rayon::prelude::*;

use crate::analysis::{Detection, Input};
use crate::error::Result;
use crate::math::pieces;
use crate::method::Verdict;
use crate::param::{Kind, Param, Value};
use crate::series::Series;
use crate::setup::Setup;
use crate::stop::{Stop, Stopped};

mod range;
mod threshold;

pub use range::{grid, multiplier, numeric, usual_values};
pub use threshold::{NoSuggestion, Threshold};

/// Values of a sweep when none are named: this many besides the default, from …
pub const STEPS: usize = 48;
/// … this …
pub const FROM: f64 = 1.0;
/// … to this, on a logarithmic grid.
pub const TO: f64 = 256.0;

/// The counts stand still where they change by no more than this fraction, or by one.
const STILL: f64 = 0.02;

/// A plateau is at least so long: its last value over its first.
const LENGTH: f64 = 1.5;

/// Where more than one sample in this many is flagged, the method objects to the record and not to wild points.
const LARGEST_SHARE: usize = 10;

/// What a method flags with one value of the parameter.
#[derive(Debug, Clone, Copy, PartialEq, serde::Serialize)]
pub struct Point {
    /// The value.
    pub value: f64,
    /// Outliers by the method; those by checks before it are the same for every value.
    pub flagged: usize,
    /// Real outliers that are not flagged, where the truth is known (漏判).
    #[serde(skip_serializing_if = "Option::is_none")]
    pub missed: Option<usize>,
    /// Flagged samples that are none, where the truth is known (误判).
    #[serde(rename = "false", skip_serializing_if = "Option::is_none")]
    pub false_alarms: Option<usize>,
}

/// A stretch of the parameter over which the count stands still.
#[derive(Debug, Clone, Copy, PartialEq, serde::Serialize)]
pub struct Plateau {
    /// Its first value.
    pub from: f64,
    /// Its last value.
    pub to: f64,
    /// The smallest count in it.
    pub least: usize,
    /// The largest count in it.
    pub most: usize,
}

/// The counts along a parameter, and what follows from them.
#[derive(Debug, Clone, PartialEq, serde::Serialize)]
pub struct Sweep {
    /// The parameter.
    pub key: &'static str,
    /// The counts, by ascending value.
    pub points: Vec<Point>,
    /// Where they stand still with few enough flagged, by ascending value; none overlaps another.
    pub plateaus: Vec<Plateau>,
    /// The value to take, or the reason why there is none.
    #[serde(flatten)]
    pub threshold: Threshold,
}

impl Plateau {
    /// Its last value over its first.
    #[must_use]
    pub fn factor(&self) -> f64 {
        self.to / self.from
    }
}

impl fmt::Display for Plateau {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if self.least != self.most {
            write!(f, "{} to ", self.least)?;
        }
        write!(f, "{} flagged", self.most)
    }
}

impl Sweep {
    /// The plateaus and the suggestion for these counts, which must be by ascending value, of a channel with `judged`
    /// samples. A value below `from`, the default of the parameter, is never suggested.
    #[must_use]
    pub fn of(key: &'static str, points: Vec<Point>, judged: usize, from: Option<f64>) -> Self {
        let few = |n: usize| n <= judged / LARGEST_SHARE;
        let plateaus = plateaus(&points).into_iter().filter(|p| few(p.most)).collect();
        let threshold = threshold::threshold(&points, few, from);
        Self { key, points, plateaus, threshold }
    }
}

/// Counts what the method of `setup` flags for each of `values` (ascending) of its parameter `param`. Values of a
/// whole-number parameter are rounded, and each is taken once. Where the parameter only gates, the scores are
/// computed once; otherwise the values share all cores. The decisions of the analyst play no part. `truth` says for
/// each row of the record whether it is really wild, where that is known.
///
/// # Errors
/// [`crate::error::Error::Stopped`]; [`crate::error::Error::Usage`] for a value that the parameter does not take; what
/// [`Detection::of`] gives.
pub fn sweep(
    input: Input<'_>,
    truth: Option<&[bool]>,
    setup: &Setup,
    (param, values): (&'static Param, &[f64]),
    stop: &Stop,
) -> Result<Sweep> {
    let id = setup.method.about().id;
    let mut setups: Vec<(f64, Setup)> = Vec::with_capacity(values.len());
    for &value in values {
        let (value, as_set) = match param.kind {
            #[expect(clippy::cast_possible_truncation, reason = "in the range of the parameter, or refused by it")]
            Kind::Whole { .. } | Kind::WholeOrOff { .. } => (value.round(), Value::Whole(value.round() as i64)),
            _ => (value, Value::Real(value)),
        };
        if setups.last().is_some_and(|(before, _)| *before >= value) {
            continue;
        }
        let mut one = setup.clone();
        one.settings.set(id, param.key, as_set)?;
        setups.push((value, one));
    }
    let series = input.series;
    let from = match param.default {
        Value::Real(x) => Some(x),
        #[expect(clippy::cast_precision_loss, reason = "defaults are small")]
        Value::Whole(n) => Some(n as f64),
        _ => None,
    };
    let Some((first_value, first)) = setups.first() else { return Ok(Sweep::of(param.key, Vec::new(), 0, from)) };
    let base = Detection::of(input, first, stop)?;
    let rest = setups[1..].par_iter().map(|(value, one)| {
        let detection = match base.regated(input, one, stop)? {
            Some(detection) => detection,
            None => Detection::calibrated(input, one, Some(&base), stop)?,
        };
        Ok(count(*value, &detection, series, truth, stop)?)
    });
    let rest: Vec<Point> = rest.collect::<Result<_>>()?;
    let mut points = vec![count(*first_value, &base, series, truth, stop)?];
    points.extend(rest);
    Ok(Sweep::of(param.key, points, series.len(), from))
}

fn count(
    value: f64,
    detection: &Detection,
    series: &Series<'_>,
    truth: Option<&[bool]>,
    stop: &Stop,
) -> std::result::Result<Point, Stopped> {
    let verdict = detection.judged.verdict();
    let count = |counts: &(dyn Fn(usize) -> bool + Sync)| {
        let piece = |piece: Range<usize>| piece.filter(|&at| counts(at)).count();
        Ok(pieces::map(verdict.len(), &|| stop.check(), piece)?.into_iter().sum::<usize>())
    };
    let flagged = |at: usize| verdict[at] == Verdict::Outlier;
    let wild = |truth: &[bool], at: usize| truth.get(series.row(at)).copied().unwrap_or(false);
    let all = count(&flagged)?;
    // What checks flag does not depend on any parameter of the method.
    let by_checks = detection.objections().filter(|(_, verdict)| *verdict == Verdict::Outlier).count();
    let mut point = Point { value, flagged: all - by_checks, missed: None, false_alarms: None };
    if let Some(truth) = truth {
        let hits = count(&|at| flagged(at) && wild(truth, at))?;
        point.missed = Some(count(&|at| wild(truth, at))? - hits);
        point.false_alarms = Some(all - hits);
    }
    Ok(point)
}

/// The longest of some plateaus; of equally long ones (to within the rounding of the grid) the first, which flags
/// more.
fn longest(plateaus: &[Plateau]) -> Option<&Plateau> {
    plateaus.iter().fold(None, |best: Option<&Plateau>, p| match best {
        Some(b) if p.factor() <= b.factor() * (1.0 + 1e-9) => Some(b),
        _ => Some(p),
    })
}

/// The longest plateau, then the longest of what lies on either side of it, and so on.
fn plateaus(points: &[Point]) -> Vec<Plateau> {
    let mut all: Vec<Plateau> = (0..points.len()).filter_map(|start| from(&points[start..])).collect();
    let mut kept: Vec<Plateau> = Vec::new();
    while let Some(&best) = longest(&all) {
        kept.push(best);
        all.retain(|p| p.to < best.from || p.from > best.to);
    }
    kept.sort_by(|a, b| a.from.total_cmp(&b.from));
    kept
}

/// The plateau that starts with the first of `points` and goes as far as it can, if it is long enough.
fn from(points: &[Point]) -> Option<Plateau> {
    let first = points.first().filter(|p| p.flagged > 0 && p.value > 0.0)?;
    let mut plateau = Plateau { from: first.value, to: first.value, least: first.flagged, most: first.flagged };
    for point in points {
        let (least, most) = (plateau.least.min(point.flagged), plateau.most.max(point.flagged));
        #[expect(clippy::cast_precision_loss, reason = "counts are far below 2^53")]
        let still = (most - least) as f64 <= (STILL * most as f64).max(1.0);
        if least == 0 || !still {
            break;
        }
        plateau = Plateau { to: point.value, least, most, ..plateau };
    }
    // A grid that was computed may end a rounding short of the factor.
    (plateau.factor() >= LENGTH * (1.0 - 1e-9)).then_some(plateau)
}

#[cfg(test)]
mod tests;
