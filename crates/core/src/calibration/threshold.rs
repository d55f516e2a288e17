//! Where the residuals of a record end and wild points begin.

/// Samples nearer than this belong to one event.
const NEAR: usize = 3;

/// Looked at from here on: well inside of the noise.
const FROM: f64 = 0.5;

/// A step upwards.
const STEP: f64 = 1.02;

/// The noise has ended where raising the threshold by this …
const RAISED: f64 = 1.4;

/// … loses less than this share of the events (1.4 to the power -0.2).
const KEPT: f64 = 0.935;

/// As many events in a thousand samples (at least two) are taken as they are …
const FEW: f64 = 0.001;

/// … and where no end of the noise is seen, as many are taken for wild, the farthest.
const FARTHEST: f64 = 0.0015;

/// An end of the noise beyond which fewer than this share of the events lie is none.
const ENOUGH: f64 = 0.2;

/// The score at which noise ends, at least 1. `scores`: residuals in limits of normal noise; `weight`: how much
/// heavier than normal the tails are (at least 1), by which all scores are lessened first.
pub(super) fn threshold(scores: &[f64], weight: f64) -> f64 {
    let events = events(scores, weight);
    let above = |t: f64| events.len() - events.partition_point(|x| *x < t);
    let of_all = |share: f64| share * count(scores.len());
    if count(above(1.0)) <= of_all(FEW).max(2.0) {
        return weight;
    }
    let mut end = FROM;
    while above(end) > 0 && count(above(end * RAISED)) < KEPT * count(above(end)) {
        end *= STEP;
    }
    if count(above(end)) >= ENOUGH * count(above(1.0)) {
        return weight * end.max(1.0);
    }
    let mut least = 1.0;
    while count(above(least)) > of_all(FARTHEST).max(2.0) {
        least *= STEP;
    }
    weight * least
}

/// The largest score of each event, ascending, in units of `weight`.
fn events(scores: &[f64], weight: f64) -> Vec<f64> {
    let mut all: Vec<f64> = Vec::new();
    let mut last: Option<usize> = None;
    for (i, score) in scores.iter().map(|s| s / weight).enumerate().filter(|(_, s)| *s >= FROM) {
        match all.last_mut() {
            Some(event) if last.is_some_and(|last| i - last <= NEAR) => *event = event.max(score),
            _ => all.push(score),
        }
        last = Some(i);
    }
    all.sort_unstable_by(f64::total_cmp);
    all
}

#[expect(clippy::cast_precision_loss, reason = "counts of samples are far below 2^53")]
fn count(n: usize) -> f64 {
    n as f64
}

/// 97 % over 85 % quantile of the absolute value of a normal deviate.
const NORMAL: f64 = 1.507;

/// How much heavier than normal the tails of the unmasked residuals are, each in units of what is usual around it
/// (`local`, at least `least`); at least 1.
pub(super) fn tail_weight(r: &[f64], masked: &[bool], local: &[f64], least: f64) -> f64 {
    let own = r.iter().zip(masked).zip(local).filter(|((_, m), l)| !**m && **l > 0.0);
    let mut scaled: Vec<f64> = own.map(|((r, _), l)| r / l.max(least)).collect();
    if scaled.len() < 50 {
        return 1.0;
    }
    let (far, near) = (super::quantile(&mut scaled, 0.97), super::quantile(&mut scaled, 0.85));
    if near > 0.0 { (far / near / NORMAL).max(1.0) } else { 1.0 }
}
