//! The laws of a study.

use super::*;
use crate::method::voting;
use crate::setup::Preset;

fn record(n: u32, noise: f64) -> (Vec<f64>, Vec<f64>) {
    let mut random = Random::new(11);
    let t: Vec<f64> = (0..n).map(f64::from).collect();
    let y = t.iter().map(|t| 100.0 * (t / 50.0).sin() + noise * random.normal()).collect();
    (t, y)
}

fn setups() -> Vec<Setup> {
    let own = voting().filter(|m| !m.about().needs_rate);
    own.map(|method| Setup::new(method, Preset::Default)).collect()
}

fn finished(t: &[f64], y: &[f64], setups: Vec<Setup>, seed: u64) -> Advice {
    let series = Series::new(t, y);
    let mut study = Study::new((&series).into(), setups, seed, &Stop::never()).unwrap();
    while study.advance(&Stop::never()).unwrap() {}
    study.advice()
}

/// All that does not depend on the clock.
fn said(advice: &Advice) -> String {
    let rows =
        advice.methods.iter().map(|m| format!("{:?} {:?} {:?} {}\n", m.kinds, m.untouched, m.repair_error, m.merit));
    rows.collect::<String>() + &format!("{:?} {:?}", advice.recommended, advice.runner_up)
}

#[test]
fn a_seed_gives_the_same_on_any_number_of_threads_and_another_seed_something_else() {
    let (t, y) = record(600, 1.0);
    let four = || setups().into_iter().rev().take(4).collect::<Vec<_>>();
    let on = |threads: usize, seed: u64| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| said(&finished(&t, &y, four(), seed)))
    };
    assert_eq!(on(1, 5), on(3, 5));
    assert_ne!(on(1, 5), on(1, 6));
}

#[test]
fn the_record_as_it_is_stays_as_it_is() {
    let (t, mut y) = record(600, 1.0);
    (20..600).step_by(60).for_each(|at| y[at] += 40.0);
    let setups: Vec<Setup> = setups().into_iter().rev().take(4).collect();
    let series = Series::new(&t, &y);
    let alone = |setup: &Setup| {
        let detection = Detection::of((&series).into(), setup, &Stop::never()).unwrap();
        detection.judged.verdict().iter().filter(|v| **v == Verdict::Outlier).count()
    };
    let expected: Vec<usize> = setups.iter().map(alone).collect();
    assert!(expected.iter().any(|flags| *flags > 0), "{expected:?}");
    let flags = |measured: &[Measured]| measured.iter().map(|m| m.untouched.flagged).collect::<Vec<_>>();
    let mut study = Study::new((&series).into(), setups.clone(), 3, &Stop::never()).unwrap();
    while study.advance(&Stop::never()).unwrap() {}
    assert_eq!(flags(&study.advice().methods), expected);
    assert_eq!(flags(&study.measure(&setups, &Stop::never()).unwrap()), expected, "after all copies");
}

#[test]
fn larger_wild_points_are_found_at_least_as_often() {
    let (t, y) = record(1500, 1.0);
    let advice = finished(&t, &y, vec![Setup::standard()], 2);
    for curve in &advice.methods[0].kinds {
        for pair in curve.points.windows(2) {
            let (small, large) = (pair[0].recall().unwrap(), pair[1].recall().unwrap());
            // Two deviations of the difference of two shares of 32.
            assert!(large >= small - 0.25, "{:?}: {small} at {:?}, then {large}", curve.kind, pair[0].limits);
        }
        assert!(curve.points.iter().all(|p| p.events >= EVENTS * 3 / 4), "{:?}", curve.points);
    }
    let single = advice.methods[0].of_kind(Kind::Single).unwrap();
    // The noise ends between three and ten deviations.
    assert!((3.0..20.0).contains(&single.smallest.unwrap()), "{:?}", single.smallest);
}

#[test]
fn twice_the_noise_needs_twice_the_size() {
    let of = |noise: f64| {
        let (t, y) = record(1500, noise);
        let advice = finished(&t, &y, vec![Setup::standard()], 2);
        advice.methods[0].of_kind(Kind::Single).unwrap().smallest.unwrap()
    };
    let ratio = of(2.0) / of(1.0);
    assert!((1.5..2.7).contains(&ratio), "{ratio}");
}

#[test]
fn a_method_that_flags_what_no_other_does_is_not_recommended() {
    let (t, y) = record(2000, 1.0);
    let mut all = setups();
    // Flags one sample in twenty of normal noise.
    let mut eager = Setup::new(crate::method::find("hampel").unwrap(), Preset::Default);
    eager.set_text("floor", "auto").unwrap();
    eager.set_text("k", "2").unwrap();
    all.push(eager);
    let advice = finished(&t, &y, all, 1);
    let eager = advice.methods.last().unwrap();
    assert!(eager.untouched.alone > 20, "{:?}", eager.untouched);
    assert_ne!(advice.recommended, Some(advice.methods.len() - 1));
    let best = advice.best().unwrap();
    assert!(best.untouched.alone * 100 <= 2000 && best.merit > eager.merit, "{}", best.merit);
}

#[test]
fn a_record_that_cannot_be_asked_says_why() {
    let (t, y) = record(40, 1.0);
    let short = finished(&t, &y, vec![Setup::standard()], 1);
    assert_eq!(short.unsuitable, Some(Unsuitable::TooShort { samples: 40 }));
    assert!(short.best().is_none() && short.methods.is_empty());
    // Five samples, then a gap: nowhere three calm neighbours on both sides.
    let t: Vec<f64> = (0..400).map(|i| f64::from(i) + 1000.0 * f64::from(i / 5)).collect();
    let (_, y) = record(400, 1.0);
    let gaps = finished(&t, &y, vec![Setup::standard()], 1);
    assert!(gaps.unsuitable.is_some(), "{gaps:?}");
}

#[test]
fn a_stopped_study_counts_nothing() {
    let (t, y) = record(600, 1.0);
    let series = Series::new(&t, &y);
    let mut study = Study::new((&series).into(), vec![Setup::standard()], 1, &Stop::never()).unwrap();
    let gone = Stop::asking(|| true);
    assert!(matches!(study.advance(&gone), Err(crate::error::Error::Stopped)));
    assert_eq!(study.rounds(), Rounds::default());
    assert!(study.advance(&Stop::never()).unwrap());
    assert_eq!(study.rounds().done, 1);
}
