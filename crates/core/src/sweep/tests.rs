use super::*;
use crate::error::Error;
use crate::method;
use crate::setup::Preset;

fn points(counts: &[(f64, usize)]) -> Vec<Point> {
    counts.iter().map(|&(value, flagged)| Point { value, flagged, missed: None, false_alarms: None }).collect()
}

fn plateaus_of(counts: &[(f64, usize)]) -> Vec<(f64, f64)> {
    let sweep = Sweep::of("k", points(counts), 10_000, None);
    sweep.plateaus.iter().map(|p| (p.from, p.to)).collect()
}

#[test]
fn a_count_of_zero_is_no_plateau_and_neither_is_a_short_one() {
    assert_eq!(plateaus_of(&[(1.0, 9), (2.0, 0), (4.0, 0), (8.0, 0)]), []);
    assert_eq!(plateaus_of(&[(1.0, 1), (2.0, 0), (4.0, 0)]), [], "one and none differ by one");
    assert_eq!(plateaus_of(&[(1.0, 9), (1.4, 9), (2.0, 3), (2.9, 0)]), [], "1.4 is below a factor of 1.5");
    assert_eq!(plateaus_of(&[(1.0, 9), (1.5, 9), (2.0, 3), (2.9, 0)]), [(1.0, 1.5)]);
}

#[test]
fn two_per_cent_or_one_may_come_and_go() {
    assert_eq!(plateaus_of(&[(1.0, 100), (2.0, 98)]), [(1.0, 2.0)]);
    assert_eq!(plateaus_of(&[(1.0, 100), (2.0, 97)]), []);
    assert_eq!(plateaus_of(&[(1.0, 5), (2.0, 4), (4.0, 3)]), [(1.0, 2.0)], "over the whole range, not step by step");
    assert_eq!(plateaus_of(&[(1.0, 4), (2.0, 5), (4.0, 4)]), [(1.0, 4.0)], "a count may also grow");
}

#[test]
fn plateaus_do_not_overlap_and_saturation_is_none() {
    let counts = [(1.0, 50), (2.0, 50), (4.0, 50), (8.0, 9), (16.0, 9), (32.0, 9), (64.0, 2), (128.0, 2)];
    assert_eq!(plateaus_of(&counts), [(1.0, 4.0), (8.0, 32.0), (64.0, 128.0)]);
    let sweep = Sweep::of("k", points(&counts), 400, None);
    assert_eq!(sweep.plateaus.first().map(|p| p.from), Some(8.0), "50 of 400 are more than a tenth");
}

#[test]
fn grids_hit_their_ends_and_refuse_what_makes_none() {
    assert_eq!(grid(1.0, 16.0, 5, true).unwrap(), [1.0, 2.0, 4.0, 8.0, 16.0]);
    assert_eq!(grid(-1.0, 1.0, 5, false).unwrap(), [-1.0, -0.5, 0.0, 0.5, 1.0]);
    assert_eq!(grid(FROM, TO, STEPS, true).unwrap().last(), Some(&256.0));
    for (from, to, steps, log) in
        [(2.0, 2.0, 5, true), (0.0, 2.0, 5, true), (1.0, 2.0, 1, true), (1.0, f64::NAN, 5, false)]
    {
        assert!(matches!(grid(from, to, steps, log), Err(Error::Usage { .. })), "{from} {to} {steps}");
    }
}

#[test]
fn methods_without_a_multiplier_say_so() {
    let setup = |id: &str| Setup::new(method::find(id).unwrap(), Preset::Default);
    assert_eq!(multiplier(&setup("hampel")).unwrap().key, "k");
    assert_eq!(multiplier(&setup("kalman")).unwrap().key, "c");
    let e = multiplier(&setup("grubbs")).unwrap_err().to_string();
    assert!(e.contains("grubbs") && e.contains("alpha"), "{e}");
    let mut fixed = setup("two-sided");
    fixed.set_text("delta", "9").unwrap();
    assert!(multiplier(&fixed).is_err(), "k plays no part beside a fixed tolerance");
    assert!(numeric(&setup("hampel"), "scale", 1.0, 2.0).unwrap_err().to_string().contains("mad | rms"));
    assert!(numeric(&setup("hampel"), "window", 1.0, 9.0).is_err(), "a window has at least three samples");
}

/// A track with noise, whose wild points stand clear of it.
fn demo(id: &str) -> (Vec<f64>, Vec<f64>, Setup) {
    let t: Vec<f64> = (0..400).map(f64::from).collect();
    let mut state = 7_u64;
    let mut noise = || {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (state >> 40) as f64 / f64::from(1 << 24) - 0.5
    };
    let wild = |i: usize| if [50, 51, 170, 300].contains(&i) { 40.0 } else { 0.0 };
    let y = t.iter().enumerate().map(|(i, t)| (t / 40.0).sin() * 20.0 + noise() + wild(i)).collect();
    (t, y, Setup::new(method::find(id).unwrap(), Preset::Default))
}

#[test]
fn every_count_is_that_of_the_method_with_that_value() {
    // hampel only gates, two-sided does not, and the window of hampel is a whole number.
    for (id, key, values) in [
        ("hampel", "k", vec![1.0, 3.0, 9.5, 80.0]),
        ("two-sided", "k", vec![2.0, 4.0, 31.0]),
        ("hampel", "window", vec![3.0, 3.2, 9.4, 21.0]),
    ] {
        let (t, y, setup) = demo(id);
        let series = Series::new(&t, &y);
        let input = Input::new(&series, None);
        let param = numeric(&setup, key, values[0], values[values.len() - 1]).unwrap();
        let stop = Stop::never();
        let swept = sweep(input, None, &setup, (param, &values), &stop).unwrap();
        let mut values: Vec<f64> = if key == "window" { values.iter().map(|v| v.round()).collect() } else { values };
        values.dedup();
        assert_eq!(swept.points.iter().map(|p| p.value).collect::<Vec<_>>(), values);
        for point in swept.points {
            let mut one = setup.clone();
            one.set_text(key, &point.value.to_string()).unwrap();
            let alone = Detection::of(input, &one, &stop).unwrap();
            let flagged = alone.judged.verdict().iter().filter(|v| **v == Verdict::Outlier).count();
            assert_eq!(point.flagged, flagged, "{id} {key} = {}", point.value);
        }
    }
}

#[test]
fn a_sweep_nobody_waits_for_ends() {
    let (t, y, setup) = demo("two-sided");
    let series = Series::new(&t, &y);
    let input = Input::new(&series, None);
    let param = multiplier(&setup).unwrap();
    let newest = std::sync::Arc::new(std::sync::atomic::AtomicU64::new(2));
    let stop = Stop::when_superseded(newest, 1);
    let ended = sweep(input, None, &setup, (param, &[1.0, 2.0]), &stop);
    assert!(matches!(ended, Err(Error::Stopped)));
}

#[test]
fn a_plateau_knows_its_counts_and_begins_above_zero() {
    let sweep = Sweep::of("k", points(&[(1.0, 100), (2.0, 98)]), 10_000, None);
    assert_eq!((sweep.plateaus[0].least, sweep.plateaus[0].most), (98, 100));
    assert_eq!(plateaus_of(&[(0.0, 5), (1.0, 5), (2.0, 5)]), [(1.0, 2.0)], "no factor leads away from 0");
}

#[test]
fn the_default_is_among_the_usual_values_and_is_confirmed_where_it_stands_clear() {
    for id in ["hampel", "two-sided", "kalman"] {
        let (t, y, setup) = demo(id);
        let series = Series::new(&t, &y);
        let param = multiplier(&setup).unwrap();
        let values = usual_values(param);
        assert!(values.is_sorted() && values.len() == STEPS + 1, "{id}");
        let swept = sweep(Input::new(&series, None), None, &setup, (param, &values), &Stop::never()).unwrap();
        let Threshold::Suggested { suggestion, range } = swept.threshold else { panic!("{id}: no suggestion") };
        let Value::Real(default) = param.default else { panic!("{id}") };
        assert_eq!((suggestion, range.least), (default, 4), "{id}: the four wild points");
    }
}
