//! Matched measurements: section 4 of `docs/methods.md`, \[001\] eqs. (35)-(41).

use std::ops::Range;

use super::{About, Damaged, Judged, Method, Own, Segment, shared};
use crate::math::order::{MAD_TO_SIGMA, median_of_many};
use crate::math::{integral, leave_one_out, pieces};
use crate::param::{Choice, Kind, Paper, Param, Settings, Value, always};
use crate::stop::{Stop, Stopped};

/// Carries the neighbours' values to the sample by the integral of a second channel that measures the rate.
pub struct Matched;

mod bridge;

static PARAMS: &[Param] = &[K, WINDOW, SIGMA, REPAIR_RULE, shared::MAX_GAP, shared::FLOOR, shared::DOUBT];

/// What takes the place of a run of outliers.
const REPAIR_RULE: Param = Param {
    key: "repair_rule",
    help: "own repair: bridge (what the rate adds up to between the good values on both sides), or the expected value",
    unit: "",
    kind: Kind::Choice(&[BRIDGE, "expected"]),
    default: Value::Word(BRIDGE),
    paper: Some(Paper::printed(
        Value::Word("expected"),
        "the median over a window holds the outliers of the run that is repaired; a bridge holds none",
    )),
    matters: always,
};

const BRIDGE: &str = "bridge";

const K: Param = shared::K.with_default(Value::Real(3.0));

const WINDOW: Param = Param {
    key: "window",
    help: "neighbours projected to each sample; runs up to about window/2 - 4 are seen",
    unit: "samples",
    kind: Kind::Whole { min: 4, max: 1001, step: 2 },
    default: Value::Whole(401),
    paper: Some(Paper::open(Value::Whole(31), "a run of half the window or more is not seen; [001] gives no window")),
    matters: always,
};

const SIGMA: Param = Param {
    key: "sigma",
    help: "noise scale: auto (1.4826 MAD of value - expected over the segment), or a number",
    unit: "channel units",
    kind: Kind::RealOr { words: &["auto"], min: f64::MIN_POSITIVE, max: 1e300 },
    default: Value::Word("auto"),
    paper: None,
    matters: always,
};

static ABOUT: About = About {
    id: "matched",
    name: "matched measurements",
    family: "real-time predictor",
    source: "[001] section 3, eqs. (35)-(41)",
    advice: "A channel with a second one that measures its rate, as range with Doppler: it tells errors of \
             measurement from motion of the target, so manoeuvres are never flagged. [001] finds it next to \
             adaptive, with the fewest false alarms, at a higher cost. Needs a clean rate over the whole segment; \
             misses runs of more than about window/2 - 4 samples, and errors that both channels share.",
    params: PARAMS,
    own: Own::Expected,
    needs_rate: true,
};

impl Method for Matched {
    fn about(&self) -> &'static About {
        &ABOUT
    }

    fn judge(&self, segment: &Segment<'_>, settings: &Settings, stop: &Stop) -> Result<Judged, Stopped> {
        let n = segment.len();
        let Some(rate) = segment.rate else {
            let mut judged = Judged::unchecked_many(n, stop)?;
            judged.warnings.push("matched needs a channel that measures the rate: name it with --rate".into());
            return Ok(judged);
        };
        let check = || stop.check();
        let integral = integral::to_times(rate.t, rate.y, segment.t, &check)?;
        // R(t_k) carried to t_i is (R - I)(t_k) + I(t_i): one sliding median of R - I serves all samples.
        let rest = pieces::collect(n, &check, |i| (segment.y[i] - integral[i][0]) - integral[i][1])?;
        let size = settings.whole(WINDOW.key);
        let mut expected = leave_one_out::medians(&rest, |i| window(i, size, n), LEAST, |i| stop.check_at(i))?;
        pieces::over(&mut expected, &check, |first, expected| {
            for (p, [sum, rest]) in expected.iter_mut().zip(&integral[first..]) {
                *p = (*p + sum) + rest;
            }
        })?;
        let sigma = match settings.choice(SIGMA.key) {
            Choice::Number(sigma) => segment.bounded(sigma, 0.0),
            Choice::Word(_) => residual_scale(segment, &expected, stop)?,
        };
        let own = pieces::collect(n, &check, |i| integral[i][0] + integral[i][1])?;
        let scale = pieces::collect(n, &check, |i| if expected[i].is_nan() { f64::NAN } else { sigma })?;
        Ok(Judged { own, ..Judged::gated(segment.y, expected, scale, settings.real(shared::K.key), stop)? })
    }

    fn own_repair(&self, damaged: &Damaged<'_>, stop: &Stop) -> Result<Vec<f64>, Stopped> {
        if damaged.settings.word(REPAIR_RULE.key) == BRIDGE {
            return bridge::repair(damaged, stop);
        }
        let expected = |n: usize| damaged.judged.expected.get(damaged.outliers[n]).copied().unwrap_or(f64::NAN);
        pieces::collect(damaged.outliers.len(), &|| stop.check(), expected)
    }

    fn own_notes(&self, damaged: &Damaged<'_>) -> Vec<String> {
        let bridges = damaged.settings.word(REPAIR_RULE.key) == BRIDGE;
        bridges.then(|| bridge::closure(damaged)).flatten().into_iter().collect()
    }

    fn gate(&self, _: &Settings) -> Option<&'static str> {
        Some(shared::K.key)
    }

    fn warnings(&self, settings: &Settings) -> Vec<String> {
        let window = settings.whole(WINDOW.key);
        if window < 11 {
            vec![format!("window = {window}: runs of two or more samples are not seen")]
        } else {
            Vec::new()
        }
    }
}

/// With fewer neighbours than this a sample stays unchecked.
const LEAST: usize = 3;

/// The part of the window around `i` that lies inside the segment; with fewer than 3 samples, the 3 nearest the end.
fn window(i: usize, size: usize, n: usize) -> Range<usize> {
    let half = size / 2;
    let to = i - half.min(i)..(i + size - half).min(n);
    if to.len() >= LEAST {
        to
    } else if to.start == 0 {
        0..LEAST.min(n)
    } else {
        n.saturating_sub(LEAST)..n
    }
}

/// `1.4826 MAD` of value minus expected value, at least the floor; 0 when nothing is expected.
fn residual_scale(segment: &Segment<'_>, expected: &[f64], stop: &Stop) -> Result<f64, Stopped> {
    let check = || stop.check();
    let residuals = |piece: Range<usize>| {
        let all = piece.map(|i| segment.y[i] - expected[i]);
        all.filter(|r| !r.is_nan()).collect::<Vec<f64>>()
    };
    let residuals = pieces::map(expected.len(), &check, residuals)?.concat();
    if residuals.is_empty() {
        return Ok(segment.floor);
    }
    let n = residuals.len();
    let center = median_of_many(n, |i| residuals[i], &check)?;
    let scale = MAD_TO_SIGMA * median_of_many(n, |i| (residuals[i] - center).abs(), &check)?;
    Ok(segment.bounded(scale, segment.zero(stop)?))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::method::{Rate, Verdict};

    #[test]
    fn windows_are_cut_at_the_ends() {
        assert_eq!(window(10, 5, 20), 8..13);
        assert_eq!(window(10, 4, 20), 8..12, "even: one more before than after");
        assert_eq!(window(0, 5, 20), 0..3);
        assert_eq!(window(0, 4, 20), 0..3, "0..2 has two samples only");
        assert_eq!(window(19, 4, 20), 17..20);
    }

    #[test]
    fn a_manoeuvre_that_the_rate_shows_is_no_outlier_and_a_jump_that_it_does_not_show_is() -> Result<(), Stopped> {
        let t: Vec<f64> = (0..200).map(|i| 0.5 * f64::from(i)).collect();
        let speed: Vec<f64> = t.iter().map(|t| if *t < 50.0 { 10.0 } else { -40.0 }).collect();
        let noise = |i: usize| ((i * 7919 % 101) as f64 / 50.0 - 1.0) * 0.1;
        let measured = integral::to_times(&t, &speed, &t, &|| Stop::never().check())?;
        let mut y: Vec<f64> = measured.iter().map(|[a, b]| a + b).collect();
        (0..y.len()).for_each(|i| y[i] += 1e6 + noise(i));
        (120..126).for_each(|i| y[i] += 3.0);
        let rate = Some(Rate { t: &t, y: &speed });
        let segment =
            Segment { t: &t, y: &y, interval: 0.5, sigma: 0.0, floor: 0.0, floors: &[], objections: &[], rate };
        let judged = Matched.judge(&segment, &Settings::defaults(PARAMS), &Stop::never())?;
        let flagged: Vec<usize> = (0..y.len()).filter(|&i| judged.verdict[i] == Verdict::Outlier).collect();
        assert_eq!(flagged, (120..126).collect::<Vec<_>>());
        let none = Segment { rate: None, ..segment };
        let judged = Matched.judge(&none, &Settings::defaults(PARAMS), &Stop::never())?;
        assert!(judged.verdict.iter().all(|v| *v == Verdict::Unchecked) && judged.warnings.len() == 1);
        Ok(())
    }
}
