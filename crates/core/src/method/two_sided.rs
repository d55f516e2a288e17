//! Two-sided variable-order polynomial test: section 6 of `docs/methods.md`, \[000\].

use rayon::prelude::*;

use super::{About, Damaged, Direction, Directions, Filter, Judged, Method, Own, Segment, TIE, Verdict, Way, shared};
use crate::math::pieces::{self, PIECE};
use crate::param::{Choice, Kind, Paper, Param, Settings, Value, always};
use crate::stop::{Stop, Stopped};

mod candidates;
mod direction;
mod filtered;
mod repair;

use candidates::NO_CANDIDATE;
pub use candidates::{Bounded, Candidate, Candidates, Closest, candidates};
pub use direction::{OneWay, run};

/// Extrapolates polynomials of several orders from both sides: a sample that no candidate of either side expects is
/// an outlier; one that only one side objects to is suspect.
pub struct TwoSided;

static PARAMS: &[Param] = &[
    DELTA,
    K,
    SIGMA,
    ORDER,
    VARIABLE_ORDER,
    POINTS,
    TWO_POINT,
    START,
    MAX_RUN,
    DIRECTION,
    REPAIR_RULE,
    shared::MAX_GAP,
    shared::FLOOR,
    shared::DOUBT,
    // What is seldom turned comes last.
    POINTS_2,
    POINTS_3,
    START_LIMIT,
];

const DELTA: Param = Param {
    key: "delta",
    help: "tolerance: auto (k * sigma), or a number in the channel's units",
    unit: "channel units",
    kind: Kind::RealOr { words: &["auto"], min: f64::MIN_POSITIVE, max: 1e300 },
    default: Value::Word("auto"),
    paper: None,
    matters: always,
};

const K: Param = shared::K.with_default(Value::Real(4.0)).with_matters(by_sigma).with_paper(Some(Paper::printed(
    Value::Real(3.0),
    "a prediction errs by more than a sample: by 1.3 sigma one step ahead, by 1.9 four steps ahead",
)));

const SIGMA: Param = shared::SIGMA
    .with_paper(Some(Paper::printed(Value::Word("spline"), "eq. (2) is inflated by the outliers that it counts in")));

const ORDER: Param = Param {
    key: "order",
    help: "highest order of the polynomials",
    unit: "",
    kind: Kind::Whole { min: 1, max: 3, step: 1 },
    default: Value::Whole(2),
    paper: Some(Paper::printed(
        Value::Whole(3),
        "[000] finds its own third order the worst: it bends after a rejection and lets outliers in",
    )),
    matters: always,
};

const VARIABLE_ORDER: Param = Param {
    key: "variable_order",
    help: "lower orders are tried too: a sample is normal when any candidate agrees",
    unit: "",
    kind: Kind::Switch,
    default: Value::Switch(true),
    paper: None,
    matters: |s| s.whole("order") > 1 || s.switch("two_point"),
};

const POINTS: Param = Param {
    key: "points",
    help: "fitting points of the line; order l is fitted to l times as many, unless it has points of its own",
    unit: "samples",
    kind: Kind::Whole { min: 4, max: 30, step: 1 },
    default: Value::Whole(8),
    // [000] gives no number.
    paper: None,
    matters: always,
};

const POINTS_2: Param = Param {
    key: "points_2",
    help: "fitting points of the parabola (off: twice those of the line)",
    unit: "samples",
    kind: Kind::WholeOrOff { min: 4, max: 90 },
    default: Value::Word("off"),
    paper: None,
    matters: |s| takes_part(s, 2),
};

const POINTS_3: Param = Param {
    key: "points_3",
    help: "fitting points of the cubic (off: three times those of the line)",
    unit: "samples",
    kind: Kind::WholeOrOff { min: 5, max: 90 },
    default: Value::Word("off"),
    paper: None,
    matters: |s| takes_part(s, 3),
};

const TWO_POINT: Param = Param {
    key: "two_point",
    help: "the line through the last two is tried too (prediction error 2.45 sigma: it mainly lets outliers in)",
    unit: "",
    kind: Kind::Switch,
    default: Value::Switch(false),
    paper: Some(Paper::printed(
        Value::Switch(true),
        "step 4 of [000] goes down to it, but it errs by 2.45 sigma and mainly lets outliers in",
    )),
    matters: |s| s.switch("variable_order"),
};

const START: Param = Param {
    key: "start",
    help: "consecutive good samples that start a model",
    unit: "samples",
    kind: Kind::Whole { min: 4, max: 200, step: 1 },
    default: Value::Whole(6),
    paper: None,
    matters: always,
};

const START_LIMIT: Param = Param {
    key: "start_limit",
    help: "third differences of a start group stay below this: robust, the larger of delta and 9 sigma (two deviations \
           of a third difference, which has 4.47 sigma); or delta [000]",
    unit: "",
    kind: Kind::Choice(&["robust", "delta"]),
    default: Value::Word("robust"),
    paper: Some(Paper::printed(
        Value::Word("delta"),
        "a third difference has 4.47 sigma: a limit of 4 sigma passes over a third of the good quadruples",
    )),
    matters: always,
};

const MAX_RUN: Param = shared::MAX_RUN.with_default(Value::Whole(10)).with_paper(Some(Paper::printed(
    Value::Whole(5),
    "a run longer than this is taken for a change of the track; [000] sets 5 for its example and leaves it to the case",
)));

const DIRECTION: Param = Param {
    key: "direction",
    help: "which way the test runs; with both, an outlier is abnormal from both",
    unit: "",
    kind: Kind::Choice(&["both", "forward", "backward"]),
    default: Value::Word("both"),
    paper: None,
    matters: always,
};

const REPAIR_RULE: Param = Param {
    key: "repair_rule",
    help: "own repair: best (the candidate that fits both sides best), or matched (only when both directions \
           resume with the same candidate; otherwise removed)",
    unit: "",
    kind: Kind::Choice(&["best", "matched"]),
    default: Value::Word("best"),
    paper: Some(Paper::printed(
        Value::Word("matched"),
        "the directions seldom come back by the same candidate, and what they disagree on is removed",
    )),
    matters: always,
};

static ABOUT: About = About {
    id: "two-sided",
    name: "two-sided variable-order polynomial test",
    family: "two-sided",
    source: "[000] section 2, eqs. (1)-(5)",
    advice: "Recorded tracks with isolated outliers and runs up to max_run samples, lost samples and steps: a step \
             or manoeuvre is suspect, not removed. In [000] it beats either direction alone at every order, and \
             variable order beats any fixed one. Needs start + a few samples on each side; a run longer than \
             max_run is taken for a real change (a restart is listed), and so is a run at the end of a segment \
             that is abnormal from only one direction.",
    params: PARAMS,
    own: Own::Remove,
    needs_rate: false,
};

/// True when polynomials of this order compete.
fn takes_part(settings: &Settings, order: usize) -> bool {
    let highest = settings.whole("order");
    order == highest || (order < highest && settings.switch("variable_order"))
}

fn by_sigma(settings: &Settings) -> bool {
    settings.choice("delta") == Choice::Word("auto")
}

impl Method for TwoSided {
    fn about(&self) -> &'static About {
        &ABOUT
    }

    fn judge(&self, segment: &Segment<'_>, settings: &Settings, stop: &Stop) -> Result<Judged, Stopped> {
        let k = settings.real(shared::K.key);
        let (delta, local) = match settings.choice("delta") {
            Choice::Number(delta) => (delta, &[][..]),
            Choice::Word(_) => (k * segment.sigma, segment.floors),
        };
        if delta <= 0.0 {
            return Judged::unchecked_many(segment.len(), stop);
        }
        // Where each sample has a floor of its own, that is the scale, unless a larger one was asked for.
        let asked = if settings.choice(shared::SIGMA.key) == Choice::Word("auto") { 0.0 } else { segment.sigma };
        let delta = |i: usize| local.get(i).map_or(delta, |floor| k * floor.max(asked));
        let max_run = settings.whole(shared::MAX_RUN.key);
        let one = |way| {
            let model = Candidates::new(settings, segment.sigma, segment.interval);
            run(model, segment, delta, max_run, way, stop)
        };
        let (forward, backward) = match settings.word("direction") {
            "forward" => (Some(one(Way::Forward)?), None),
            "backward" => (None, Some(one(Way::Backward)?)),
            _ => {
                let (forward, backward) = rayon::join(|| one(Way::Forward), || one(Way::Backward));
                (Some(forward?), Some(backward?))
            }
        };
        together(segment, delta, forward, backward, stop)
    }

    fn own_repair(&self, damaged: &Damaged<'_>, stop: &Stop) -> Result<Vec<f64>, Stopped> {
        repair::repair(damaged, stop)
    }

    fn notes(&self, settings: &Settings) -> Vec<String> {
        let figure = |c: &Candidate| format!("{} {:.2} .. {:.2}", c.name(), c.error(1), c.error(4));
        let figures: Vec<String> = candidates(settings).iter().map(figure).collect();
        let limit =
            if by_sigma(settings) { format!("k = {}", settings.real(shared::K.key)) } else { "delta in sigma".into() };
        vec![format!("prediction error in sigma, 1 .. 4 steps ahead: {}; beside {limit}", figures.join(", "))]
    }

    fn warnings(&self, settings: &Settings) -> Vec<String> {
        let mut lines = Vec::new();
        let most = candidates(settings).iter().map(|c| c.error(4)).fold(0.0, f64::max);
        if by_sigma(settings) && most > settings.real(shared::K.key) {
            lines.push(format!(
                "after a few rejections a candidate errs by {most:.1} sigma, more than k: it accepts nearly everything"
            ));
        }
        if settings.word("direction") != "both" && settings.word("repair_rule") == "matched" {
            lines.push("repair_rule = matched needs both directions: everything is removed".into());
        }
        lines
    }

    fn filter(&self, _: &Settings) -> Option<&'static dyn Filter> {
        Some(&filtered::BothSides)
    }
}

/// The verdicts of both directions put together, or of the one that ran.
fn together(
    segment: &Segment<'_>,
    delta: impl Fn(usize) -> f64 + Sync,
    forward: Option<OneWay>,
    backward: Option<OneWay>,
    stop: &Stop,
) -> Result<Judged, Stopped> {
    let (n, check) = (segment.len(), || stop.check());
    let expected = match (&forward, &backward) {
        (Some(f), Some(b)) => {
            pieces::collect(n, &check, |i| nearer(segment.y[i], f.expected[i], b.expected[i], TIE * delta(i)))?
        }
        (Some(one), None) | (None, Some(one)) => pieces::collect(n, &check, |i| one.expected[i])?,
        (None, None) => Vec::new(),
    };
    let said = |one: &Option<OneWay>, i: usize| one.as_ref().map(|one| one.said[i]);
    let code = |one: &Option<OneWay>, i: usize| one.as_ref().map_or(NO_CANDIDATE, |one| one.code[i]);
    let both = |i: usize| Directions { forward: said(&forward, i), backward: said(&backward, i) };
    let (mut verdicts, mut directions) = (vec![Verdict::Unchecked; n], vec![both(0); n]);
    let pieces = verdicts.par_chunks_mut(PIECE).zip(directions.par_chunks_mut(PIECE)).enumerate();
    pieces.try_for_each(|(piece, (verdicts, directions))| {
        check()?;
        for (i, (one, directions)) in (piece * PIECE..).zip(verdicts.iter_mut().zip(directions)) {
            *directions = both(i);
            *one = verdict(directions.forward, directions.backward);
        }
        Ok(())
    })?;
    let mut judged = Judged {
        verdict: verdicts,
        directions,
        repair_code: pieces::collect(n, &check, |i| [code(&forward, i), code(&backward, i)])?,
        tolerance: pieces::collect(n, &check, |i| if expected[i].is_nan() { f64::NAN } else { delta(i) })?,
        expected,
        ..Judged::default()
    };
    for (one, way) in [(forward, Way::Forward), (backward, Way::Backward)] {
        let Some(mut one) = one else { continue };
        debug_assert!(one.restarts.iter().all(|r| r.way == way));
        for i in one.traces {
            if judged.verdict[i] == Verdict::Normal {
                judged.verdict[i] = Verdict::Suspect;
            }
        }
        judged.restarts.append(&mut one.restarts);
    }
    Ok(judged)
}

/// What the directions make of a sample; none for a direction that did not run.
fn verdict(forward: Option<Direction>, backward: Option<Direction>) -> Verdict {
    use Direction::{Abnormal, Normal, Unjudged};
    match (forward, backward) {
        (Some(one), None) | (None, Some(one)) => match one {
            Normal => Verdict::Normal,
            Abnormal => Verdict::Outlier,
            Unjudged => Verdict::Unchecked,
        },
        (Some(Abnormal), Some(Abnormal | Unjudged)) | (Some(Unjudged), Some(Abnormal)) => Verdict::Outlier,
        (Some(Abnormal), Some(Normal)) | (Some(Normal), Some(Abnormal)) => Verdict::Suspect,
        (Some(Unjudged), Some(Unjudged)) | (None, None) => Verdict::Unchecked,
        _ => Verdict::Normal,
    }
}

/// Of two predictions the one nearer to `y`; within `tie` the first; the other where one is NaN.
fn nearer(y: f64, forward: f64, backward: f64, tie: f64) -> f64 {
    if forward.is_nan() || (backward - y).abs() < (forward - y).abs() - tie { backward } else { forward }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::method::judge_channel;
    use crate::series::Series;

    /// A floor bounds a scale from below; it does not replace one that was given.
    #[test]
    fn a_larger_sigma_that_was_given_holds_beside_the_floors_of_the_samples() {
        let t: Vec<f64> = (0..300).map(f64::from).collect();
        let y: Vec<f64> = (0..300).map(|i| f64::from(i * 37 % 11) + if i == 150 { 500.0 } else { 0.0 }).collect();
        let flagged = |sigma: &str| {
            let mut settings = Settings::defaults(PARAMS);
            settings.set_text("two-sided", "sigma", sigma).unwrap();
            let judged = judge_channel(&TwoSided, &Series::new(&t, &y), None, &settings, &Stop::never()).unwrap();
            judged.verdict[150] == Verdict::Outlier
        };
        assert!(flagged("auto") && flagged("1") && !flagged("1000"));
    }
}
