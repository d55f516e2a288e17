//! The window methods against a plain twin that works every window out from its samples.

use proptest::prelude::*;

use super::*;
use crate::math::order::{mad_scale_in_place, median, median_in_place};

fn figures(w: &[f64], rule: &Rule) -> (f64, f64) {
    let n = w.len() as f64;
    let p = if rule.center == Center::Mean { w.iter().sum::<f64>() / n } else { median(w) };
    let scale = match rule.spread {
        Spread::Rms => (w.iter().map(|x| (x - p) * (x - p)).sum::<f64>() / (n - 1.0)).sqrt(),
        Spread::Mad => mad_scale_in_place(&mut w.to_vec(), median(w)),
        Spread::Residuals => unreachable!("no window has them by itself"),
    };
    (p, scale)
}

/// The samples of the window around `c`, by the words of the page.
fn window(x: &[f64], c: usize, rule: &Rule) -> Vec<f64> {
    let n = x.len() as i64;
    let first = c as i64 - rule.width as i64 / 2;
    let all = first..first + rule.width as i64;
    let cut: Vec<f64> = all.clone().filter(|i| (0..n).contains(i)).map(|i| x[i as usize]).collect();
    match rule.edge {
        Edge::Shrink if cut.len() >= 3 => cut,
        Edge::Shrink if first <= 0 => x[..3].to_vec(),
        Edge::Shrink => x[x.len() - 3..].to_vec(),
        Edge::Zero => all.map(|i| if (0..n).contains(&i) { x[i as usize] } else { 0.0 }).collect(),
        Edge::Reflect => {
            let mirror = |mut i: i64| {
                while !(0..n).contains(&i) {
                    i = if i < 0 { -i } else { 2 * (n - 1) - i };
                }
                x[i as usize]
            };
            all.map(mirror).collect()
        }
    }
}

/// Verdicts and expected values, without a baseline.
fn plain(y: &[f64], rule: &Rule) -> (Vec<bool>, Vec<f64>) {
    let mut scales: Vec<f64> = (0..y.len()).map(|c| figures(&window(y, c, rule), rule).1).collect();
    let pooled = if rule.pooled { median_in_place(&mut scales) } else { 0.0 };
    let mut x = y.to_vec();
    let (mut flags, mut expected) = (Vec::new(), Vec::new());
    for c in 0..y.len() {
        let (p, scale) = figures(&window(&x, c, rule), rule);
        let scale = scale.max(pooled);
        let flagged = scale > super::super::zero_scale(y) && reaches((x[c] - p).abs(), rule.k * scale);
        if flagged && rule.feedback {
            x[c] = p;
        }
        flags.push(flagged);
        expected.push(p);
    }
    (flags, expected)
}

proptest! {
    #[test]
    fn every_rule_equals_its_plain_twin(
        noise in prop::collection::vec(prop_oneof![8 => -1.0..1.0, 1 => 5.0..40.0, 1 => -40.0..-5.0], 3..120),
        width in 3usize..40,
        mean: bool, rms: bool, pooled: bool, feedback: bool,
        edge in prop_oneof![Just(Edge::Shrink), Just(Edge::Reflect), Just(Edge::Zero)],
    ) {
        let rule = Rule {
            center: if mean { Center::Mean } else { Center::Median },
            spread: if rms { Spread::Rms } else { Spread::Mad },
            width, edge, detrend: false, pooled, feedback, k: 2.5,
        };
        let t: Vec<f64> = (0..noise.len()).map(|i| i as f64).collect();
        let segment = Segment { t: &t, y: &noise, interval: 1.0, sigma: 0.0, floor: 0.0, floors: &[], objections: &[], rate: None };
        let judged = judge(&rule, &segment, &Stop::never()).unwrap();
        let (flags, expected) = plain(&noise, &rule);
        for c in 0..noise.len() {
            prop_assert_eq!(judged.verdict[c] == Verdict::Outlier, flags[c], "sample {}", c);
            prop_assert!((judged.expected[c] - expected[c]).abs() < 1e-11);
        }
    }
}

fn rule() -> Rule {
    Rule {
        center: Center::Median,
        spread: Spread::Mad,
        width: 21,
        edge: Edge::Shrink,
        detrend: true,
        pooled: true,
        feedback: true,
        k: 3.0,
    }
}

#[test]
fn a_large_offset_and_a_slope_change_nothing() {
    // Values on a grid of 2^-17 survive an offset of 2^30 exactly.
    let grid = |v: f64| (v * 131_072.0).round() / 131_072.0;
    let t: Vec<f64> = (0..3000).map(f64::from).collect();
    let noise = |i: usize| grid((i as f64 * 12.9898).sin() * 437.585_453 % 1.0 * 1e-2);
    let y: Vec<f64> = (0..3000).map(|i| noise(i) + if i % 97 == 50 { 0.125 } else { 0.0 }).collect();
    let far: Vec<f64> = y.iter().map(|y| y + 1_073_741_824.0).collect();
    for (spread, center) in [(Spread::Mad, Center::Median), (Spread::Rms, Center::Mean)] {
        let rule = Rule { spread, center, ..rule() };
        let of = |y: &[f64]| {
            let segment =
                Segment { t: &t, y, interval: 1.0, sigma: 0.0, floor: 0.0, floors: &[], objections: &[], rate: None };
            judge(&rule, &segment, &Stop::never()).unwrap()
        };
        let (near, far) = (of(&y), of(&far));
        assert_eq!(near.verdict, far.verdict);
        assert!(near.verdict.iter().filter(|v| **v == Verdict::Outlier).count() >= 30);
        assert!(near.tolerance.iter().zip(&far.tolerance).all(|(a, b)| (a / b - 1.0).abs() < 1e-6));
    }
}

#[test]
fn an_abandoned_judgement_stops() {
    let newest = std::sync::Arc::new(std::sync::atomic::AtomicU64::new(2));
    let y = [1.0; 100];
    let segment =
        Segment { t: &y, y: &y, interval: 1.0, sigma: 0.0, floor: 0.0, floors: &[], objections: &[], rate: None };
    assert_eq!(judge(&rule(), &segment, &Stop::when_superseded(newest, 1)), Err(Stopped));
}

#[test]
fn gating_again_is_judging_again_across_cuts_and_short_segments() {
    use crate::method::{Method, hampel::Hampel, judge_channel, template::Template};
    use crate::param::Value;
    use crate::series::Series;

    // Segments of 60, 2 and 60 samples.
    let t: Vec<f64> =
        (0..122).map(|i| f64::from(i) + if i >= 60 { 50.0 } else { 0.0 } + if i >= 62 { 50.0 } else { 0.0 }).collect();
    let y: Vec<f64> = (0..122).map(|i| (f64::from(i) * 12.9898).sin() + if i % 23 == 5 { 4.0 } else { 0.0 }).collect();
    let series = Series::new(&t, &y);
    for method in [&Hampel as &dyn Method, &Template] {
        let mut settings = Settings::defaults(method.about().params);
        // With a floor for each sample the multiplier does more than gate.
        settings.set_text("it", shared::FLOOR.key, "auto").unwrap();
        if has_feedback(&settings) {
            settings.set("it", shared::FEEDBACK.key, Value::Switch(false)).unwrap();
        }
        let judged = |settings: &Settings| judge_channel(method, &series, None, settings, &Stop::never()).unwrap();
        let mut again = judged(&settings);
        let key = method.gate(&settings).unwrap();
        settings.set("it", key, Value::Real(1.7)).unwrap();
        again.gate(&y, 1.7, &Stop::never()).unwrap();
        let wanted = judged(&settings);
        assert_eq!((again.verdict.len(), &again.verdict), (122, &wanted.verdict));
        let bits = |v: &[f64]| v.iter().map(|h| h.to_bits()).collect::<Vec<_>>();
        assert_eq!(bits(&again.tolerance), bits(&wanted.tolerance));
    }
}

/// Section 3, `edge`: the mean of three at the first sample of 1, 5, 3 is that of 5 1 5 reflected, of 0 1 5 with
/// zeros, of 1 5 3 where the window is cut to the three nearest.
#[test]
fn what_a_window_holds_beyond_the_ends_is_as_the_setting_says() {
    use crate::method::{Method, mean_window::MeanWindow};
    use crate::param::Settings;
    let (t, y) = ([0.0, 1.0, 2.0, 3.0, 4.0], [1.0, 5.0, 3.0, 4.0, 2.0]);
    let segment =
        Segment { t: &t, y: &y, interval: 1.0, sigma: 0.0, floor: 0.0, floors: &[], objections: &[], rate: None };
    for (edge, expected) in [("reflect", 11.0 / 3.0), ("zero", 2.0), ("shrink", 3.0)] {
        let mut settings = Settings::defaults(MeanWindow.about().params);
        for (key, text) in [("edge", edge), ("window", "3"), ("detrend", "off"), ("feedback", "false")] {
            settings.set_text("it", key, text).unwrap();
        }
        let judged = MeanWindow.judge(&segment, &settings, &Stop::never()).unwrap();
        assert!((judged.expected[0] - expected).abs() < 1e-12, "{edge}: {}", judged.expected[0]);
    }
}
