//! A coarse test from both sides: each side extrapolates from what it accepted, and coasts over what it did not.

use std::ops::Range;

use rayon::prelude::*;

use super::Record;
use super::residual::line_at;
use crate::math::polyfit::Polynomial;
use crate::stop::{Stop, Stopped};

/// Points of the lines that compete; a sample is accepted when any agrees.
const LINES: [usize; 3] = [4, 8, 16];

/// Points of the parabola.
const PARABOLA: usize = 12;

/// Neighbours that start a side, by their third difference.
const START: usize = 4;

/// After more objections in a row a side starts again at the first of them: a real change.
const MOST: usize = 26;

/// Accepted samples that are remembered.
const REMEMBERED: usize = 20;

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Said {
    Nothing,
    Accepted,
    Objected,
}

/// Masks the samples to which both sides object by their limit, or one where the other has nothing to say.
pub(super) fn coast(record: &Record<'_>, limits: &[f64], masked: &mut [bool], stop: &Stop) -> Result<(), Stopped> {
    let judge = |stretch: &Range<usize>| {
        let forward: Vec<usize> = stretch.clone().collect();
        let backward: Vec<usize> = stretch.clone().rev().collect();
        let (ahead, back) =
            rayon::join(|| one_way(record, &forward, limits, stop), || one_way(record, &backward, limits, stop));
        let (ahead, mut back) = (ahead?, back?);
        back.reverse();
        Ok(ahead.into_iter().zip(back).map(|(a, b)| both(a, b)).collect())
    };
    let found: Vec<Vec<bool>> = record.stretches.par_iter().map(judge).collect::<Result<_, Stopped>>()?;
    for (mask, found) in masked.iter_mut().zip(found.concat()) {
        *mask |= found;
    }
    Ok(())
}

fn both(ahead: Said, back: Said) -> bool {
    use Said::{Accepted, Objected};
    (ahead == Objected && back != Accepted) || (back == Objected && ahead != Accepted)
}

/// What one side says of each sample of `order`.
fn one_way(record: &Record<'_>, order: &[usize], limits: &[f64], stop: &Stop) -> Result<Vec<Said>, Stopped> {
    let mut said = vec![Said::Nothing; order.len()];
    if order.len() < 2 * START {
        return Ok(said);
    }
    let mut accepted: Vec<usize> = Vec::with_capacity(2 * REMEMBERED + 1);
    let (mut at, mut run) = (0, 0);
    while at < order.len() {
        if at % Stop::STRIDE == 0 {
            stop.check()?;
        }
        let i = order[at];
        if accepted.len() < START {
            let Some(group) = order.get(at..at + START) else { break };
            let y = |k: usize| record.y[group[k]];
            if (y(0) - 3.0 * y(1) + 3.0 * y(2) - y(3)).abs() <= 1.5 * limits[i] {
                accepted.clear();
                accepted.extend_from_slice(group);
                said[at..at + START].fill(Said::Accepted);
                (at, run) = (at + START, 0);
            } else {
                at += 1;
            }
            continue;
        }
        if expects(record, &accepted, i, limits[i]) {
            accepted.push(i);
            if accepted.len() > 2 * REMEMBERED {
                accepted.drain(..REMEMBERED);
            }
            said[at] = Said::Accepted;
            run = 0;
        } else {
            said[at] = Said::Objected;
            run += 1;
            if run > MOST {
                accepted.clear();
                at -= run - 1;
                run = 0;
                // The first of the run starts anew; it must not be met again by the same model.
                continue;
            }
        }
        at += 1;
    }
    Ok(said)
}

/// Whether what was accepted lets expect sample `i` within `limit`.
fn expects(record: &Record<'_>, accepted: &[usize], i: usize, limit: f64) -> bool {
    let (t, y) = (record.t[i], record.y[i]);
    let near = |value: f64| (y - value).abs() < limit;
    let last = |points: usize| &accepted[accepted.len() - points..];
    if record.holds && near(record.y[accepted[accepted.len() - 1]]) {
        return true;
    }
    if LINES.into_iter().take_while(|m| *m <= accepted.len()).any(|m| near(line_at(record, last(m), t))) {
        return true;
    }
    if accepted.len() < 8 {
        return false;
    }
    let used = last(accepted.len().min(PARABOLA));
    let times: Vec<f64> = used.iter().map(|&j| record.t[j] - t).collect();
    let values: Vec<f64> = used.iter().map(|&j| record.y[j]).collect();
    near(Polynomial::fit(&times, &values, 2).at(0.0))
}
