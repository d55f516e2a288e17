//! What a sweep goes along: a numeric parameter, and the values it takes.

use std::ops::RangeInclusive;

use super::{FROM, STEPS, TO};
use crate::error::{Error, Result};
use crate::param::{Kind, Param, Value, find};
use crate::setup::Setup;

/// More values than this are a slip of the finger.
const MOST_STEPS: usize = 10_000;

/// The multiplier that a sweep goes along when no parameter is named.
///
/// # Errors
/// [`Error::Usage`] when the method has none, or when it does not matter under these settings.
pub fn multiplier(setup: &Setup) -> Result<&'static Param> {
    let about = setup.method.about();
    let found = about.params.iter().find(|p| matches!(p.key, "k" | "c"));
    let Some(param) = found else {
        let keys: Vec<&str> = about.params.iter().filter(|p| range(p).is_some()).map(|p| p.key).collect();
        return Err(Error::usage(
            format!("{} has no multiplier of a scale to sweep", about.id),
            format!("name a parameter with --param: {}", keys.join(", ")),
        ));
    };
    if (param.matters)(&setup.settings) {
        return Ok(param);
    }
    Err(Error::usage(
        format!("{} does not matter to {} under these settings", param.key, about.id),
        "leave the tolerance automatic, or name another parameter with --param",
    ))
}

/// The values that a sweep of a multiplier takes when none are named, ascending: a logarithmic grid, and the default,
/// so that a suggestion can confirm it.
#[must_use]
pub fn usual_values(param: &Param) -> Vec<f64> {
    let mut values = logarithmic(FROM, TO, STEPS);
    if let Value::Real(default) = param.default
        && let Err(at) = values.binary_search_by(|v| v.total_cmp(&default))
    {
        values.insert(at, default);
    }
    values
}

/// The numbers that a parameter takes; none when it takes none.
fn range(param: &Param) -> Option<RangeInclusive<f64>> {
    #[expect(clippy::cast_precision_loss, reason = "bounds of parameters are far below 2^53")]
    match param.kind {
        Kind::Whole { min, max, .. } | Kind::WholeOrOff { min, max } => Some(min as f64..=max as f64),
        Kind::Real { min, max, .. } | Kind::RealOr { min, max, .. } => Some(min..=max),
        Kind::Choice(_) | Kind::Switch | Kind::Numbers | Kind::Words(_) => None,
    }
}

/// The numeric parameter `key` of the method, for values from `from` to `to`.
///
/// # Errors
/// [`Error::Usage`] for an unknown key, one that takes no numbers, or values out of its range.
pub fn numeric(setup: &Setup, key: &str, from: f64, to: f64) -> Result<&'static Param> {
    let about = setup.method.about();
    let param = find(about.params, about.id, key)?;
    let Some(range) = range(param) else {
        let what = format!("{key} takes {}: no numbers to sweep", param.range());
        return Err(Error::usage(what, "name a numeric parameter with --param"));
    };
    if range.contains(&from) && range.contains(&to) {
        return Ok(param);
    }
    let what = format!("{key} from {from} to {to}: out of its range");
    Err(Error::usage(what, format!("{key} takes {}: give --from and --to inside", param.range())))
}

/// `steps` values from `from` to `to`, in equal ratios (`log`) or equal steps.
///
/// # Errors
/// [`Error::Usage`] for bounds or numbers that make no grid.
pub fn grid(from: f64, to: f64, steps: usize, log: bool) -> Result<Vec<f64>> {
    if !(from.is_finite() && to.is_finite() && from < to) {
        return Err(Error::usage(format!("from {from} to {to}: no range"), "--from must be smaller than --to"));
    }
    if log && from <= 0.0 {
        return Err(Error::usage(
            format!("from {from}: a logarithmic grid starts above 0"),
            "give a larger --from, or --linear",
        ));
    }
    if !(2..=MOST_STEPS).contains(&steps) {
        return Err(Error::usage(format!("{steps} steps make no sweep"), format!("give --steps 2 .. {MOST_STEPS}")));
    }
    if log {
        return Ok(logarithmic(from, to, steps));
    }
    let last = steps - 1;
    #[expect(clippy::cast_precision_loss, reason = "at most ten thousand")]
    let at = |i: usize| if i == last { to } else { from + (to - from) * (i as f64 / last as f64) };
    Ok((0..steps).map(at).collect())
}

/// `steps` values from `from` to `to` in equal ratios, both ends to the bit.
fn logarithmic(from: f64, to: f64, steps: usize) -> Vec<f64> {
    let last = steps - 1;
    #[expect(clippy::cast_precision_loss, reason = "at most ten thousand")]
    let at = |i: usize| match i {
        0 => from,
        i if i == last => to,
        i => from * (to / from).powf(i as f64 / last as f64),
    };
    (0..steps).map(at).collect()
}
