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

/// Where the noise of a record ends.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct End {
    /// The score at which it ends, at least 1.
    pub(super) times: f64,
    /// True where the scores show an end: above it hardly any event is lost for a while.
    pub(super) shown: bool,
}

/// The score at which noise ends, at least 1. `scores`: residuals in limits of normal noise; `weight`: how much
/// heavier than normal the tails are (at least 1), by which all scores are lessened first.
pub(super) fn threshold(scores: &[f64], weight: f64) -> End {
    let events = events(scores, weight);
    let above = |t: f64| events.len() - events.partition_point(|x| *x < t);
    let of_all = |share: f64| share * count(scores.len());
    if count(above(1.0)) <= of_all(FEW).max(2.0) {
        return End { times: weight, shown: false };
    }
    let mut end = FROM;
    while above(end) > 0 && count(above(end * RAISED)) < KEPT * count(above(end)) {
        end *= STEP;
    }
    if count(above(end)) >= ENOUGH * count(above(1.0)) {
        return End { times: weight * end.max(1.0), shown: true };
    }
    let mut least = 1.0;
    while count(above(least)) > of_all(FARTHEST).max(2.0) {
        least *= STEP;
    }
    End { times: weight * least, shown: false }
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
pub(super) fn count(n: usize) -> f64 {
    n as f64
}

/// 97 % over 85 % quantile of the absolute value of a normal deviate.
const NORMAL: f64 = 1.507;

/// How much heavier than normal the tails of the unmasked residuals are, at least 1: the 97 % over the 85 % quantile,
/// each residual in units of what is usual around it (`local`, at least `least`) and known to half a step of
/// `resolution`.
pub(super) fn tails(r: &[f64], masked: &[bool], local: &[f64], (least, resolution): (f64, f64)) -> f64 {
    let rounding = 0.5 * resolution;
    let own = r.iter().zip(masked).zip(local).filter(|((_, m), l)| !**m && **l > 0.0);
    let mut scaled: Vec<f64> = own.map(|((r, _), l)| (r + rounding) / (l.max(least) + rounding)).collect();
    if scaled.len() < 50 {
        return 1.0;
    }
    let (far, near) = (super::quantile(&mut scaled, 0.97), super::quantile(&mut scaled, 0.85));
    if near > 0.0 { (far / near / NORMAL).max(1.0) } else { 1.0 }
}

/// How much farther than normal noise residuals with such tails reach where wild points begin, one in ten thousand. Tails
/// of exp(-x) weigh 1.23, and from 97 % to 99.99 % they grow 1.47 times as much as normal ones: about the square.
pub(super) fn weight(tails: f64) -> f64 {
    tails * tails
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The tails of 2,000 residuals at even shares of this distribution.
    fn tails_of(quantile: impl Fn(f64) -> f64, resolution: f64) -> f64 {
        let r: Vec<f64> = (0..2000).map(|i| quantile((f64::from(i) + 0.5) / 2000.0)).collect();
        tails(&r, &[false; 2000], &[1.0; 2000], (0.1, resolution))
    }

    #[test]
    fn tails_are_what_the_quantiles_differ_by_from_normal_ones() {
        // exp(-x): ln(1 / 0.03) / ln(1 / 0.15) = 1.8484, over 1.507.
        let exponential = tails_of(|share| -(1.0 - share).ln(), 0.0);
        assert!((exponential - 1.2266).abs() < 0.005, "{exponential}");
        let even = tails_of(|share| share, 0.0);
        assert!((even - 1.0).abs() < 1e-12, "{even}");
    }

    #[test]
    fn steps_of_the_grid_weigh_less() {
        // The 85 % quantile is one step and that of 97 % two: they differ without any tail.
        let quantised = |share: f64| {
            if share < 0.84 {
                0.01
            } else if share < 0.96 {
                1.0
            } else {
                2.0
            }
        };
        assert!(tails_of(quantised, 0.0) > 1.3);
        // 2.5 over 1.5, over 1.507.
        assert!((tails_of(quantised, 1.0) - 1.106).abs() < 0.001);
    }
}
