use super::*;
use crate::error::Error;
use crate::method;
use crate::setup::Preset;

fn points(counts: &[(f64, usize)]) -> Vec<Point> {
    counts.iter().map(|&(value, flagged)| Point { value, flagged, missed: None, false_alarms: None }).collect()
}

fn found(counts: &[(f64, usize)]) -> (Vec<(f64, f64)>, Option<f64>) {
    let sweep = Sweep::of("k", points(counts));
    (sweep.plateaus.iter().map(|p| (p.from, p.to)).collect(), sweep.suggestion)
}

#[test]
fn the_longest_range_of_a_still_count_gives_its_geometric_middle() {
    let counts = [(1.0, 900), (2.0, 300), (4.0, 60), (8.0, 28), (16.0, 28), (32.0, 27), (64.0, 3), (128.0, 0)];
    assert_eq!(found(&counts), (vec![(8.0, 32.0)], Some(16.0)));
}

#[test]
fn a_count_of_zero_is_no_plateau_and_neither_is_a_short_one() {
    assert_eq!(found(&[(1.0, 9), (2.0, 0), (4.0, 0), (8.0, 0)]), (vec![], None));
    assert_eq!(found(&[(1.0, 1), (2.0, 0), (4.0, 0)]), (vec![], None), "one and none differ by one");
    assert_eq!(found(&[(1.0, 9), (1.4, 9), (2.0, 3), (2.9, 0)]), (vec![], None), "1.4 is below a factor of 1.5");
    assert_eq!(found(&[(1.0, 9), (1.5, 9), (2.0, 3), (2.9, 0)]), (vec![(1.0, 1.5)], Some(1.22)));
}

#[test]
fn two_per_cent_or_one_may_come_and_go() {
    assert_eq!(found(&[(1.0, 100), (2.0, 98)]).0, [(1.0, 2.0)]);
    assert_eq!(found(&[(1.0, 100), (2.0, 97)]).0, []);
    assert_eq!(found(&[(1.0, 5), (2.0, 4), (4.0, 3)]).0, [(1.0, 2.0)], "over the whole range, not step by step");
    assert_eq!(found(&[(1.0, 4), (2.0, 5), (4.0, 4)]).0, [(1.0, 4.0)], "a count may also grow");
}

#[test]
fn plateaus_do_not_overlap_and_of_equal_ones_the_first_is_suggested() {
    let counts = [(1.0, 50), (2.0, 50), (4.0, 50), (8.0, 9), (16.0, 9), (32.0, 9), (64.0, 2), (128.0, 2)];
    assert_eq!(found(&counts), (vec![(1.0, 4.0), (8.0, 32.0), (64.0, 128.0)], Some(2.0)));
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
    let sweep = Sweep::of("k", points(&[(1.0, 100), (2.0, 98)]));
    assert_eq!((sweep.plateaus[0].least, sweep.plateaus[0].most), (98, 100));
    assert_eq!(found(&[(0.0, 5), (1.0, 5), (2.0, 5)]).0, [(1.0, 2.0)], "no factor leads away from 0");
}

#[test]
fn the_longest_plateau_is_suggested_wherever_it_stands() {
    let counts = [(1.0, 50), (2.0, 50), (4.0, 9), (8.0, 9), (16.0, 9)];
    assert_eq!(found(&counts), (vec![(1.0, 2.0), (4.0, 16.0)], Some(8.0)));
}
