//! Blocks, and whole criteria against plain twins of the page's words.

use proptest::prelude::*;

use super::*;
use crate::method::{Method, gesd::Gesd, grubbs::Grubbs, romanovsky::Romanovsky, trend_wright::TrendWright};
use crate::param::Value;

#[test]
fn a_short_last_block_joins_the_one_before() {
    assert_eq!(blocks(25, 10), [0..10, 10..20, 20..25]);
    assert_eq!(blocks(24, 10), [0..10, 10..24]);
    for (len, size) in [(4, 10), (24, 0)] {
        let whole = blocks(len, size);
        assert_eq!((whole.len(), &whole[0]), (1, &(0..len)));
    }
}

fn judged(method: &dyn Method, y: &[f64], change: &[(&str, Value)]) -> Judged {
    let t: Vec<f64> = (0..y.len()).map(|i| i as f64).collect();
    let segment = Segment { t: &t, y, interval: 1.0, sigma: 0.0, floor: 0.0, floors: &[], objections: &[], rate: None };
    let mut settings = Settings::defaults(method.about().params);
    change.iter().for_each(|(key, value)| settings.set("it", key, *value).unwrap());
    method.judge(&segment, &settings, &Stop::never()).unwrap()
}

fn outliers(judged: &Judged) -> Vec<usize> {
    (0..judged.verdict.len()).filter(|&i| judged.verdict[i] == Verdict::Outlier).collect()
}

/// Mean, standard deviation and index of the most deviant of those left.
fn most_deviant(y: &[f64], left: &[usize]) -> (f64, f64, usize) {
    let n = left.len() as f64;
    let mean = left.iter().map(|&i| y[i]).sum::<f64>() / n;
    let s = (left.iter().map(|&i| (y[i] - mean).powi(2)).sum::<f64>() / (n - 1.0)).sqrt();
    let far = left.iter().copied().fold(left[0], |f, i| if (y[i] - mean).abs() > (y[f] - mean).abs() { i } else { f });
    (mean, s, far)
}

/// Rosner's test as he writes it, pass after pass, about the mean.
fn rosner(y: &[f64], alpha: f64, fraction: f64) -> Vec<usize> {
    let critical = Critical::new(alpha, Chance::Block);
    let mut all: Vec<usize> = (0..y.len()).collect();
    let mut found = Vec::new();
    while all.len() >= 3 {
        let (mut left, mut order, mut last) = (all.clone(), Vec::new(), 0);
        for i in 1..=((fraction * all.len() as f64) as usize).max(1) {
            if left.len() < 3 {
                break;
            }
            let (mean, s, far) = most_deviant(y, &left);
            order.push(far);
            if (y[far] - mean).abs() / s > critical.at(left.len()) {
                last = i;
            }
            left.retain(|&j| j != far);
        }
        if last == 0 {
            break;
        }
        all.retain(|j| !order[..last].contains(j));
        found.extend(&order[..last]);
    }
    found.sort_unstable();
    found
}

/// Romanovsky's test with m and q of the others, pass after pass, about the mean.
fn romanovsky(y: &[f64], alpha: f64) -> Vec<usize> {
    let mut left: Vec<usize> = (0..y.len()).collect();
    while left.len() >= 3 {
        let (_, _, far) = most_deviant(y, &left);
        let others: Vec<usize> = left.iter().copied().filter(|&j| j != far).collect();
        let (mean, q, _) = most_deviant(y, &others);
        let n = left.len() as f64;
        let k = crate::math::student::student_upper(alpha / 2.0, n - 2.0) * (n / (n - 1.0)).sqrt();
        if (y[far] - mean).abs() <= k * q {
            break;
        }
        left = others;
    }
    (0..y.len()).filter(|i| !left.contains(i)).collect()
}

fn noisy() -> impl Strategy<Value = Vec<f64>> {
    prop::collection::vec(prop_oneof![8 => -1.0..1.0, 1 => 3.0..40.0, 1 => -40.0..-3.0], 6..80)
}

proptest! {
    #[test]
    fn gesd_and_romanovsky_equal_their_plain_twins(y in noisy()) {
        let flat = [("trend_order", Value::Whole(0))];
        prop_assert_eq!(outliers(&judged(&Gesd, &y, &flat)), rosner(&y, 0.05, 0.35));
        prop_assert_eq!(outliers(&judged(&Romanovsky, &y, &flat)), romanovsky(&y, 0.01));
    }

    #[test]
    fn a_trend_of_the_order_and_an_offset_change_no_flag(y in noisy()) {
        // The trend is a parabola on a grid that survives an offset of 2^30.
        let grid = |v: f64| (v * 1024.0).round() / 1024.0;
        let y: Vec<f64> = y.iter().map(|&v| grid(v)).collect();
        let far: Vec<f64> =
            y.iter().enumerate().map(|(i, v)| v + 1_073_741_824.0 + 3.0 * (i * i) as f64 - 50.0 * i as f64).collect();
        for method in [&TrendWright as &dyn Method, &Grubbs] {
            let (near, far) = (judged(method, &y, &[]), judged(method, &far, &[]));
            prop_assert_eq!(outliers(&near), outliers(&far));
        }
    }
}

#[test]
fn a_trend_that_does_not_follow_is_reported() {
    let y: Vec<f64> =
        (0..2000).map(|i| 50.0 * (f64::from(i) / 60.0).sin() + f64::from(i * 7919 % 101) / 50.0).collect();
    assert!(judged(&TrendWright, &y, &[]).warnings[0].contains("does not follow"));
    assert!(judged(&TrendWright, &y, &[("block", Value::Whole(50))]).warnings.is_empty());
    // Few samples in a block say little of the noise: that of the whole segment stands in, and nothing is cried out.
    assert!(judged(&TrendWright, &y, &[("block", Value::Whole(12))]).warnings.iter().all(|w| !w.contains("follow")));
    // The same over more samples than the noise is taken from one by one.
    let y: Vec<f64> =
        (0..40_000).map(|i| 50.0 * (f64::from(i) / 600.0).sin() + f64::from(i * 7919 % 101) / 50.0).collect();
    assert!(judged(&TrendWright, &y, &[]).warnings[0].contains("does not follow"));
}

#[test]
fn too_few_samples_are_unchecked_and_an_exact_parabola_is_normal() {
    assert!(judged(&TrendWright, &[1.0, 5.0, 2.0, 8.0], &[]).verdict.iter().all(|v| *v == Verdict::Unchecked));
    let y: Vec<f64> = (0..50).map(|i| 0.1 * f64::from(i * i) - 7.3).collect();
    for method in [&TrendWright as &dyn Method, &Grubbs, &Gesd, &Romanovsky] {
        let judged = judged(method, &y, &[]);
        assert!(judged.verdict.iter().all(|v| *v == Verdict::Normal) && judged.tolerance.iter().all(|h| *h == 0.0));
    }
}
