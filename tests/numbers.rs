//! Numbers that break things, in every method with the outermost legal parameters: no panic, no hang, no infinity,
//! and no flag without a finite reason.

#![allow(
    clippy::allow_attributes,
    clippy::allow_attributes_without_reason,
    dead_code,
    reason = "of the fuzz targets only that of the methods is used here"
)]
#![expect(clippy::unwrap_used, reason = "a failed expectation is a failed test")]

mod fuzzing;

use std::panic::AssertUnwindSafe;

use fuzzing::methods::{judged, made_of};
use proptest::prelude::*;
use wildpoint::experiment::Random;
use wildpoint::method::{METHODS, Method};
use wildpoint::param::{Kind, Numbers, Settings, Value, Words};
use wildpoint::repair::{PARAMS, REPAIRS};
use wildpoint::session::{Preset, Session, Setup};
use wildpoint::track::{LoadOptions, Track};

const N: usize = 160;

/// Series by name: what a sensor, a quantiser, a fault or a mean person can write into a column.
fn series() -> Vec<(&'static str, Vec<f64>)> {
    let mut random = Random::new(3);
    let mut noise: Vec<f64> = (0..N).map(|_| random.normal()).collect();
    let walk = noise
        .iter()
        .scan(0.0, |sum: &mut f64, x| {
            *sum += x;
            Some(*sum)
        })
        .collect();
    let mut of = |f: &mut dyn FnMut(usize, f64) -> f64| -> Vec<f64> {
        noise.iter_mut().enumerate().map(|(i, x)| f(i, *x)).collect()
    };
    let all = vec![
        ("huge and of both signs", of(&mut |i, _| if i % 2 == 0 { 1e308 } else { -1e308 })),
        ("the largest doubles", of(&mut |_, x| if x > 0.0 { f64::MAX } else { f64::MIN })),
        ("one huge among small", of(&mut |i, x| if i == 80 { 1.7e308 } else { x })),
        ("denormal", of(&mut |i, _| 5e-324 * (i % 7) as f64)),
        ("denormal steps on one", of(&mut |i, _| 1.0 + f64::EPSILON * (i % 3) as f64)),
        ("constant", of(&mut |_, _| 7.5)),
        ("zero", of(&mut |i, _| if i % 2 == 0 { 0.0 } else { -0.0 })),
        ("quantised", of(&mut |_, x| (x * 2.0).round())),
        ("two values", of(&mut |i, _| (i % 2) as f64)),
        ("held", of(&mut |i, _| (i / 9) as f64)),
        ("three of ten wild", of(&mut |i, x| if i % 10 < 3 { 1e6 * x } else { x })),
        ("half missing", of(&mut |i, x| if i % 2 == 0 { f64::NAN } else { x })),
        ("all missing", of(&mut |_, _| f64::NAN)),
        ("steep", of(&mut |i, _| (i as f64).exp())),
        ("far from zero", of(&mut |_, x| 1e16 + x)),
        ("a walk", walk),
    ];
    all
}

/// Times by name.
fn times() -> Vec<(&'static str, Vec<f64>)> {
    let of = |f: &dyn Fn(usize) -> f64| (0..N).map(f).collect::<Vec<f64>>();
    vec![
        ("even", of(&|i| i as f64)),
        ("gaps of all sizes", of(&|i| (i as f64).powi(3))),
        ("as close as doubles are", of(&|i| f64::from_bits(1.0_f64.to_bits() + i as u64))),
        ("an age apart", of(&|i| 1e15 * i as f64)),
    ]
}

/// Defaults, paper, and each parameter at each of its ends with the others at their defaults.
fn outermost(method: &'static dyn Method) -> Vec<Setup> {
    let mut setups = vec![Setup::new(method, Preset::Default), Setup::new(method, Preset::Paper)];
    let start = setups[0].clone();
    for param in method.about().params {
        for value in ends(param.kind) {
            let mut setup = start.clone();
            setup.settings.set("test", param.key, value).unwrap();
            setups.push(setup);
        }
    }
    for end in [0, 1] {
        let mut setup = start.clone();
        for param in method.about().params {
            let ends = ends(param.kind);
            setup.settings.set("test", param.key, ends[end % ends.len()]).unwrap();
        }
        setups.push(setup);
    }
    setups.iter_mut().for_each(|s| s.rate = Some("rate".into()));
    setups
}

fn ends(kind: Kind) -> Vec<Value> {
    match kind {
        Kind::Whole { min, max, .. } => vec![Value::Whole(min), Value::Whole(max)],
        Kind::Real { min, max, .. } => vec![Value::Real(min), Value::Real(max)],
        Kind::Choice(words) => words.iter().map(|w| Value::Word(w)).collect(),
        Kind::Switch => vec![Value::Switch(false), Value::Switch(true)],
        Kind::RealOr { words, min, max } => {
            let numbers = [Value::Real(min), Value::Real(max)];
            numbers.into_iter().chain(words.iter().map(|w| Value::Word(w))).collect()
        }
        Kind::WholeOrOff { min, max } => vec![Value::Whole(min), Value::Whole(max), Value::Word("off")],
        Kind::Numbers => vec![Value::Numbers(Numbers::NONE)],
        Kind::Words(list) => vec![Value::Words(Words::all(list))],
    }
}

fn run(track: &Track, setup: &Setup, what: &str) {
    let session = Session::new(track, LoadOptions::default(), setup);
    let law = std::panic::catch_unwind(AssertUnwindSafe(|| judged(&session, track)));
    assert!(law.is_ok(), "{what}: {setup:?}");
}

#[test]
fn every_method_at_the_ends_of_its_parameters_bears_every_series() {
    let (all_series, all_times) = (series(), times());
    for method in METHODS {
        for setup in outermost(*method) {
            for (name, values) in &all_series {
                let track = made_of(all_times[0].1.clone(), [("x", values.clone()), ("rate", all_series[7].1.clone())]);
                run(&track, &setup, name);
            }
        }
        for preset in [Preset::Default, Preset::Paper] {
            let mut setup = Setup::new(*method, preset);
            setup.rate = Some("rate".into());
            for (clock, seconds) in &all_times {
                for (name, values) in &all_series {
                    let track = made_of(seconds.clone(), [("x", values.clone()), ("rate", values.clone())]);
                    run(&track, &setup, &format!("{name}, {clock}"));
                }
            }
        }
    }
}

#[test]
fn no_sample_one_sample_and_every_repair() {
    let all = series();
    for method in METHODS {
        for repair in REPAIRS {
            for fill in ["off", "cells", "rows"] {
                let mut setup = Setup::new(*method, Preset::Default);
                setup.rate = Some("rate".into());
                setup.repair = Settings::defaults(PARAMS);
                setup.repair.set_text("repair", "method", repair.id).unwrap();
                setup.repair.set_text("repair", "fill_gaps", fill).unwrap();
                setup.repair.set_text("repair", "max_fill", "0").unwrap();
                for n in [0, 1, 2, 3, N] {
                    for (name, values) in [&all[2], &all[10], &all[11]] {
                        let seconds = (0..n).map(|i| i as f64 * if i > 90 { 1.5 } else { 1.0 }).collect();
                        let values = values[..n].to_vec();
                        let track = made_of(seconds, [("x", values.clone()), ("rate", values)]);
                        run(&track, &setup, &format!("{name}, {n} samples, {} {fill}", repair.id));
                    }
                }
            }
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(60))]

    /// The fuzz target of the methods, each method in its turn, with inputs that shrink.
    #[test]
    fn any_legal_parameters_on_any_samples(bytes in proptest::collection::vec(any::<u8>(), 30..360)) {
        for method in 0..METHODS.len() {
            let mut data = vec![u8::try_from(method).unwrap()];
            data.extend_from_slice(&bytes);
            fuzzing::run("methods", &data);
        }
    }
}
