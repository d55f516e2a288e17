//! The settings of the paper are those of the documents: numbers worked out by hand from their formulas.

#![expect(clippy::expect_used, clippy::unwrap_used, reason = "a test that cannot set itself up should fail")]

#[expect(dead_code, reason = "other tests use what this does not")]
mod program;

use program::Folder;
use wildpoint::method::{Judged, METHODS, Verdict, find, judge_channel};
use wildpoint::param::Settings;
use wildpoint::stop::Stop;
use wildpoint::track::Series;

/// What `id` says of values at steps of 1 s under the paper's settings, changed as told.
fn judged(id: &str, y: &[f64], changes: &[(&str, &str)]) -> Judged {
    let method = find(id).expect("a registered method");
    let mut settings = Settings::paper(method.about().params);
    for (key, text) in changes {
        settings.set_text(id, key, text).expect("a legal value");
    }
    let t: Vec<f64> = (0..y.len()).map(|i| i as f64).collect();
    judge_channel(method, &Series::new(&t, y), None, &settings, &Stop::never()).expect("nobody stops it")
}

fn flagged(judged: &Judged) -> Vec<usize> {
    (0..judged.verdict.len()).filter(|&i| judged.verdict[i] == Verdict::Outlier).collect()
}

/// \[001\] replaces what it rejects by the prediction and has no rule that ends a run: behind a step of 100 from a
/// track at 0, the prediction stays 0 and all that follows is rejected. \[004\] has no such rule either.
#[test]
fn no_run_is_too_long_for_the_predictors_of_the_documents() {
    let y: Vec<f64> = (0..80).map(|i| if i < 40 { 0.0 } else { 100.0 }).collect();
    let given = [("sigma", "1"), ("floor", "0")];
    for id in ["five-point", "alpha-beta-gamma", "adaptive"] {
        let all = judged(id, &y, &given);
        assert_eq!(flagged(&all), (40..80).collect::<Vec<_>>(), "{id}");
        assert!(all.restarts.is_empty(), "{id}");
        let five = judged(id, &y, &[&given[..], &[("max_run", "5")]].concat());
        assert_eq!(five.restarts.len(), 1, "{id}: the sixth rejection in a row ends the model");
    }
    let paper = |id: &str, key: &str| Settings::paper(find(id).expect("a method").about().params).get(key);
    assert_eq!(paper("kalman", "max_run").map(|v| v.to_string()).as_deref(), Some("0"));
    // [000] has one, n_rmax, and sets 5 in its example.
    assert_eq!(paper("two-sided", "max_run").map(|v| v.to_string()).as_deref(), Some("5"));
}

/// \[001\] decides at C_H sigma with C_H = 1.5. A residual of the line through five has sqrt(1 + 110 / 100) = 1.44914
/// sigma, eq. (22), so the limit on it is 1.5 * 1.44914 = 2.17371 sigma while the first scale holds.
#[test]
fn the_adaptive_test_decides_at_one_and_a_half_scales() {
    for (value, outlier) in [(2.18, true), (2.16, false)] {
        let mut y = vec![0.0; 15];
        y[9] = value;
        let judged = judged("adaptive", &y, &[("sigma", "1"), ("floor", "0")]);
        assert_eq!(judged.verdict[9] == Verdict::Outlier, outlier, "{value}");
        assert!((judged.tolerance[9] - 2.173_71).abs() < 1e-5, "{}", judged.tolerance[9]);
    }
}

/// Eq. (1) of \[000\] below delta = 3: of 0, 1.5, 0, 0 the third difference is -3 * 1.5 = -4.5, of 1.5, 0, 0, 0 it is
/// 1.5. So the model starts at the second sample; by the robust limit of 9 sigma it would start at the first.
#[test]
fn a_start_group_of_the_two_sided_test_stays_below_delta() {
    let mut y = vec![0.0; 40];
    y[1] = 1.5;
    let given = [("delta", "3"), ("sigma", "1"), ("floor", "0"), ("direction", "forward")];
    let first = |changes: &[(&str, &str)]| judged("two-sided", &y, &[&given[..], changes].concat()).verdict[0];
    assert_eq!(first(&[]), Verdict::Unchecked);
    assert_eq!(first(&[("start_limit", "robust")]), Verdict::Normal);
}

/// Step 4 of \[000\] goes down to the line through two points: behind 0, 0, .., 0, 2 it expects 2 * 2 - 0 = 4. The line on
/// eight, whose newest point weighs 1/8 + 3.5 * 4.5 / 42 = 1/2, expects 1: at delta 3, 4.9 is normal by the former alone.
#[test]
fn the_two_sided_test_goes_down_to_the_line_through_two_points() {
    let mut y = vec![0.0; 30];
    (y[20], y[21]) = (2.0, 4.9);
    let given = [("order", "1"), ("delta", "3"), ("sigma", "1"), ("floor", "0"), ("direction", "forward")];
    let two = judged("two-sided", &y, &given);
    assert_eq!(two.verdict[21], Verdict::Normal);
    assert!((two.expected[21] - 4.0).abs() < 1e-12, "{}", two.expected[21]);
    let without = judged("two-sided", &y, &[&given[..], &[("two_point", "false")]].concat());
    assert_eq!(without.verdict[21], Verdict::Outlier);
    assert!((without.expected[21] - 1.0).abs() < 1e-12, "{}", without.expected[21]);
}

/// m and l are separate in \[000\]: for example a cubic on 6 points, whose weights one step ahead are (-2 4 1 -4 -4 8) / 3
/// (they reproduce 1, x, x^2 and x^3 at 6 from 0 .. 5). Behind 0, .., 0, 1 it expects 8 / 3, and one on 18 points far less.
#[test]
fn an_order_can_have_points_of_its_own() {
    let mut y = vec![0.0; 40];
    (y[20], y[21]) = (1.0, 8.0 / 3.0);
    let given = [
        ("order", "3"),
        ("variable_order", "false"),
        ("points_3", "6"),
        ("delta", "2"),
        ("sigma", "1"),
        ("floor", "0"),
        ("direction", "forward"),
    ];
    let expected = |changes: &[(&str, &str)]| judged("two-sided", &y, &[&given[..], changes].concat()).expected[21];
    assert!((expected(&[]) - 8.0 / 3.0).abs() < 1e-9, "{}", expected(&[]));
    assert!(expected(&[("points_3", "18")]) < 1.5);
}

/// P(g >= G) = alpha, eq. (8) of \[001\], is one-sided: G(15, 0.05) = 2.41 in the tables that it cites. 14 temperatures and
/// 20.353, in hundredths from 20.40: sum 16 - 4.7 = 11.3, mean 0.7533; squares 52 + 22.09 - 15 * 0.7533^2 = 65.58, so
/// s = sqrt(65.58 / 14) = 2.164 and g = (4.7 + 0.7533) / 2.164 = 2.520. With alpha / 2 on either side G is 2.549.
#[test]
fn grubbs_table_is_one_sided() {
    let y = [20.42, 20.43, 20.40, 20.43, 20.42, 20.43, 20.39, 20.353, 20.40, 20.43, 20.42, 20.41, 20.39, 20.39, 20.40];
    let given = [("trend_order", "0"), ("alpha", "0.05"), ("floor", "0")];
    assert_eq!(flagged(&judged("grubbs", &y, &given)), [7]);
    assert!(flagged(&judged("grubbs", &y, &[&given[..], &[("sides", "two")]].concat())).is_empty());
    // The limit itself, on data without an outlier: 8 zeros and 7 ones.
    let flat: Vec<f64> = (0..15).map(|i| f64::from(i % 2)).collect();
    // Mean 7/15; squares 7 * (8/15)^2 + 8 * (7/15)^2 = 56/15, so s = sqrt(56 / 15 / 14) = 0.5164.
    let limit = judged("grubbs", &flat, &given).tolerance[0] / 0.516_398;
    assert!((limit - 2.409).abs() < 5e-4, "{limit}");
}

/// Step 3 of \[003\]: sigma from the predicted and the measured values in the window. A ramp of 10 per sample with 30 on
/// top at t = 20, window 11: the means of the windows around 15 .. 25 all hold the spike and lie 30 / 11 = 2.727 above the
/// ramp, so the residuals are -2.727 ten times and 30 - 2.727 = 27.273 once: sigma = sqrt((743.80 + 74.38) / 10) = 9.045,
/// and 27.273 / 9.045 = 3.015.
#[test]
fn each_sample_of_a_window_has_its_own_prediction() {
    let y: Vec<f64> = (0..41).map(|i| 10.0 * f64::from(i) + if i == 20 { 30.0 } else { 0.0 }).collect();
    let mean = judged("mean-window", &y, &[("window", "11")]);
    assert!(flagged(&mean).contains(&20));
    assert!((mean.tolerance[20] / 3.0 - 9.045).abs() < 5e-4, "{}", mean.tolerance[20] / 3.0);
    assert!(((y[20] - mean.expected[20]) / (mean.tolerance[20] / 3.0) - 3.015).abs() < 5e-4);
    // About the middle's prediction the slope is in the scale, sqrt(2 * 100 (1 + 4 + 9 + 16 + 25) / 10) = 33 and more.
    let middle = judged("mean-window", &y, &[("window", "11"), ("scale", "rms")]);
    assert!(!flagged(&middle).contains(&20));
    // Medians of eleven: the spike of 230 moves that of 20 to 210 (it stands above 210, 220 and 230), that of 21 to 220 and
    // that of 22 to 230, all others are the ramp: residuals 20, -10, -10 and zeros, sigma = sqrt(600 / 10) = 7.746.
    let median = judged("median-window", &y, &[("window", "11")]);
    assert!((median.tolerance[20] / 3.0 - 7.746).abs() < 5e-4, "{}", median.tolerance[20] / 3.0);
}

/// A sample that was replaced by its prediction has no residual in the windows that follow (\[003\] goes on from step 3):
/// around 21 the residuals are -2.727 nine times (16 .. 19 and 21 .. 25) and 0 at 20 and 26, so sigma is
/// 2.727 sqrt(9 / 10) = 2.587.
#[test]
fn a_replaced_sample_has_no_residual_any_more() {
    let y: Vec<f64> = (0..41).map(|i| 10.0 * f64::from(i) + if i == 20 { 30.0 } else { 0.0 }).collect();
    let given = [("window", "11"), ("floor", "0")];
    let with = judged("mean-window", &y, &given);
    assert!((with.tolerance[21] / 3.0 - 2.587).abs() < 5e-4, "{}", with.tolerance[21] / 3.0);
    // Without the feedback its 27.273 stays in: sqrt((743.80 + 9 * 7.438) / 10) = 9.004.
    let without = judged("mean-window", &y, &[&given[..], &[("feedback", "false")]].concat());
    assert!((without.tolerance[21] / 3.0 - 9.004).abs() < 5e-4, "{}", without.tolerance[21] / 3.0);
}

/// A report marks as the paper's what the document gives, and nothing else: \[000\] gives a third order and n_rmax 5, but
/// no number of points and no floor.
#[test]
fn a_report_marks_only_what_the_document_gives() {
    let folder = Folder::with_demo();
    folder.done("clean demo.csv --channel vx_mps --preset paper --report r.md");
    let report = folder.text("r.md");
    let row = |key: &str| {
        let start = format!("| {} |", key.replace('_', "\\_"));
        report.lines().find(|l| l.starts_with(&start)).unwrap_or_else(|| panic!("{key} in {report}")).to_owned()
    };
    for key in ["order", "max_run", "two_point", "start_limit"] {
        assert!(row(key).contains("as in the paper"), "{}", row(key));
    }
    assert!(row("points").contains("| default |"), "{}", row("points"));
    assert!(!row("floor").contains("paper"), "{}", row("floor"));
}

#[test]
fn each_departure_of_a_default_is_told_with_its_reason() {
    let folder = Folder::with_demo();
    for method in METHODS {
        let about = method.about();
        let page = folder.done(&format!("methods {}", about.id));
        for (param, paper) in about.params.iter().filter_map(|p| Some((p, p.paper?))) {
            let line = page.lines().find(|l| l.trim_start().starts_with(param.key) && l.ends_with(paper.why));
            let line = line.unwrap_or_else(|| panic!("{} {}: {page}", about.id, param.key));
            assert!(line.contains(&paper.value.to_string()) && line.contains(&param.default.to_string()), "{line}");
        }
        let digits = |line: &str| line.chars().filter(char::is_ascii_digit).count();
        assert!(page.lines().all(|l| digits(l) < 60), "{}: no line of hundreds of digits", about.id);
    }
}
