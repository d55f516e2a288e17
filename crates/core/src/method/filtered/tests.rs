use super::*;
use crate::method::{METHODS, Part, find};
use crate::param::Settings;

/// The filtered values of the method over even steps, with noise of 1 and these samples wild.
fn filtered(id: &str, changes: &[(&str, &str)], y: &[f64], outliers: &[usize], own: &[f64]) -> Filtered {
    let method = find(id).unwrap();
    let mut settings = Settings::defaults(method.about().params);
    changes.iter().for_each(|(key, text)| settings.set_text(id, key, text).unwrap());
    let t: Vec<f64> = (0..y.len()).map(|i| i as f64).collect();
    let segment = Segment { t: &t, y, interval: 1.0, sigma: 1.0, floor: 0.0, floors: &[], objections: &[], rate: None };
    let judged = Part { verdict: &[], expected: &[], repair_code: &[], own: &[] };
    let damaged = Damaged { segment: &segment, settings: &settings, judged, outliers };
    let settled = Settled { damaged, own, restarts: &[] };
    method.filter(&settings).unwrap().run(&settled, &Stop::never()).unwrap()
}

#[track_caller]
fn close(value: f64, wanted: f64) {
    assert!((value - wanted).abs() < 1e-9, "{value}, not {wanted}");
}

/// Without process noise a filter of constant acceleration is the least-squares parabola through all samples so far.
/// Through five, the last weighs 31/35 in its own value, which is its variance too, and 3/35 in that of the first. Left
/// out, it is predicted from four: the innovation variance is 1 / (1 - 31/35), 35/4, so the prediction's 31/4.
#[test]
fn recursive_filters_are_the_parabola_through_what_they_took_in() {
    let y = [0.0, 0.0, 0.0, 0.0, 1.0];
    for (id, changes) in [("kalman", &[("tracking_index", "0.000001")][..]), ("alpha-beta-gamma", &[("alpha", "0.02")])]
    {
        let all = filtered(id, changes, &y, &[], &[]);
        assert!((all.value[4] - 31.0 / 35.0).abs() < 1e-6, "{id}: {}", all.value[4]);
        assert!((all.deviation[4] - (31.0_f64 / 35.0).sqrt()).abs() < 1e-6, "{id}: {}", all.deviation[4]);
        assert!((all.value[0] - 3.0 / 35.0).abs() < 1e-6, "{id}: the first, against time: {}", all.value[0]);
        let mut changes = changes.to_vec();
        changes.push(("look_back", "false"));
        assert!(filtered(id, &changes, &y, &[], &[]).value[0].is_nan(), "{id}");
    }
    let coasted = filtered("kalman", &[("tracking_index", "0.000001")], &y, &[4], &[f64::NAN]);
    close(coasted.value[4], 0.0);
    assert!((coasted.deviation[4] - (31.0_f64 / 4.0).sqrt()).abs() < 1e-6, "{}", coasted.deviation[4]);
}

/// Five outliers make a patch: their fill, here 7 each time, enters the filter, and fewer do not.
#[test]
fn the_filter_takes_in_what_patches_are_filled_with() {
    let y = vec![7.0; 20];
    let wild = |run: std::ops::Range<usize>| {
        let mut y = y.clone();
        y[run.clone()].fill(90.0);
        let outliers: Vec<usize> = run.collect();
        filtered("kalman", &[], &y, &outliers, &vec![7.0; outliers.len()])
    };
    let (patch, short) = (wild(8..13), wild(8..12));
    assert!(patch.value.iter().chain(&short.value).all(|v| (v - 7.0).abs() < 1e-9));
    assert!(patch.deviation[11] < 1.0 && short.deviation[11] > 2.0, "{} {}", patch.deviation[11], short.deviation[11]);
}

/// The other values are weighted means that can be worked out by hand: a spike of 1 shows its own weight.
#[test]
fn windows_lines_and_polynomials_have_the_weights_of_least_squares() {
    let spike = |n: usize, at: usize| (0..n).map(|i| if i == at { 1.0 } else { 0.0 }).collect::<Vec<f64>>();
    let flat = [("window", "5"), ("detrend", "off")];
    close(filtered("mean-window", &flat, &spike(11, 5), &[], &[]).value[5], 0.2);
    close(filtered("median-window", &flat, &spike(11, 5), &[], &[]).value[5], 0.0);
    close(filtered("hampel", &flat, &spike(11, 5), &[], &[]).value[5], 0.0);
    // Savitzky and Golay (1964): (-3 12 17 12 -3) / 35.
    let middle = [("window", "5"), ("order", "2")];
    close(filtered("poly-window", &middle, &spike(11, 5), &[], &[]).value[5], 17.0 / 35.0);
    close(filtered("poly-window", &middle, &spike(11, 5), &[], &[]).value[7], -3.0 / 35.0);
    // The end of the line through five: (-2 0 2 4 6) / 10; through three: (-1 2 5) / 6.
    for id in ["five-point", "adaptive"] {
        let line = filtered(id, &[], &spike(11, 5), &[], &[]);
        for (i, weight) in [(5, 0.6), (6, 0.4), (7, 0.2), (8, 0.0), (9, -0.2), (10, 0.0)] {
            close(line.value[i], weight);
        }
        close(filtered(id, &[], &spike(11, 0), &[], &[]).value[0], 0.6);
    }
    close(filtered("five-point", &[], &spike(11, 5), &[], &[]).deviation[5], 0.6_f64.sqrt());
    close(filtered("template", &[("window", "3")], &spike(11, 5), &[], &[]).value[5], 5.0 / 6.0);
    // A line through four on each side and the sample itself is their mean there.
    let line = [("order", "1"), ("points", "4")];
    let both = filtered("two-sided", &line, &spike(21, 10), &[], &[]);
    close(both.value[10], 1.0 / 9.0);
    close(both.deviation[10], 1.0 / 3.0);
    let without = filtered("two-sided", &line, &spike(21, 10), &[10], &[f64::NAN]);
    close(without.value[10], 0.0);
    close(without.deviation[10], 1.0 / 8.0_f64.sqrt());
}

#[test]
fn a_trend_goes_through_what_is_left_and_a_mean_is_no_model_of_a_track() {
    let mut y: Vec<f64> = (0..40).map(|i| f64::from(i * i) - 3.0 * f64::from(i)).collect();
    let wanted = y.clone();
    y[17] = 1e4;
    for id in ["trend-wright", "chauvenet", "romanovsky", "grubbs", "gesd", "odd-even"] {
        let changes = [("trend_order", "2"), ("block", "0")];
        let trend = filtered(id, &changes, &y, &[17], &[f64::NAN]);
        trend.value.iter().zip(&wanted).for_each(|(value, wanted)| close(*value, *wanted));
    }
    let with = |id: &str| {
        let method = find(id).unwrap();
        method.filter(&Settings::defaults(method.about().params)).is_some()
    };
    let without: Vec<&str> = METHODS.iter().map(|m| m.about().id).filter(|id| !with(id)).collect();
    assert_eq!(without, ["wright", "matched", "consensus"]);
}

/// A hole of the own repair is bridged by the line between its neighbours, and filled from the nearest at an end.
#[test]
fn what_stands_for_wild_samples_is_never_their_own_value() {
    let y = [90.0, 1.0, 2.0, 90.0, 90.0, 5.0, 90.0];
    let settings = Settings::defaults(find("mean-window").unwrap().about().params);
    let t: Vec<f64> = (0..y.len()).map(|i| i as f64).collect();
    let segment =
        Segment { t: &t, y: &y, interval: 1.0, sigma: 1.0, floor: 0.0, floors: &[], objections: &[], rate: None };
    let judged = Part { verdict: &[], expected: &[], repair_code: &[], own: &[] };
    let standing = |outliers: &[usize], own: &[f64]| {
        let damaged = Damaged { segment: &segment, settings: &settings, judged, outliers };
        Settled { damaged, own, restarts: &[] }.standing()
    };
    let nan = f64::NAN;
    assert_eq!(standing(&[0, 3, 4, 6], &[nan; 4]).unwrap(), [1.0, 1.0, 2.0, 3.0, 4.0, 5.0, 5.0]);
    assert_eq!(standing(&[0, 3, 4, 6], &[0.5, 2.5, nan, nan]).unwrap(), [0.5, 1.0, 2.0, 2.5, 3.75, 5.0, 5.0]);
    assert!(standing(&[0, 1, 2, 3, 4, 5, 6], &[nan; 7]).is_none());
}
