//! Predictors, two-sided test and Kalman filter against numbers of the literature and closed forms.

#![expect(clippy::expect_used, reason = "a test that cannot set itself up should fail")]

use nalgebra::{Matrix3, Vector3};
use wildpoint::math::extrapolate::{even_weights, prediction_error};
use wildpoint::math::gains::{growing, steady};
use wildpoint::math::huber::beta;
use wildpoint::math::line_of_five::LineOfFive;
use wildpoint::math::polyfit::Polynomial;
use wildpoint::method::{Judged, Method, find, judge_channel};
use wildpoint::param::Settings;
use wildpoint::stop::Stop;
use wildpoint::track::Series;

fn close(got: f64, want: f64, within: f64) {
    assert!((got - want).abs() <= within, "{got}, published {want}");
}

fn method(id: &str) -> &'static dyn Method {
    find(id).expect("a registered method")
}

/// Defaults of a method with the floor of the documents, changed as told.
fn settings(id: &str, changes: &[(&str, &str)]) -> Settings {
    let mut settings = Settings::defaults(method(id).about().params);
    if settings.get("floor").is_some() {
        settings.set_text(id, "floor", "auto").expect("a legal value");
    }
    for (key, text) in changes {
        settings.set_text(id, key, text).expect("a legal value");
    }
    settings
}

fn judged(id: &str, t: &[f64], y: &[f64], changes: &[(&str, &str)]) -> Judged {
    let series = Series::new(t, y);
    judge_channel(method(id), &series, None, &settings(id, changes), &Stop::never()).expect("nobody stops it")
}

/// A record on which nothing is an outlier, at even steps of 0.1 s.
fn quiet(n: usize) -> (Vec<f64>, Vec<f64>) {
    let t: Vec<f64> = (0..n).map(|i| i as f64 * 0.1).collect();
    let y = t.iter().map(|t| 220.0 + 5.0 * t + 0.01 * (40.0 * t).sin()).collect();
    (t, y)
}

/// \[001\] eq. (22): (-4 y1 - y2 + 2 y3 + 5 y4 + 8 y5) / 10; the prediction error of white noise is
/// sqrt(1 + (16 + 1 + 4 + 25 + 64) / 100) = 1.449.
#[test]
fn five_point_weights_and_prediction_error() {
    for (i, weight) in [-0.4, -0.1, 0.2, 0.5, 0.8].into_iter().enumerate() {
        let mut line = LineOfFive::default();
        (0..5).for_each(|k| line.push(k as f64, f64::from(u8::from(k == i))));
        let (value, variance) = line.at(5.0);
        close(value, weight, 1e-14);
        close(variance, 1.1, 1e-14);
    }
    let (t, y) = quiet(50);
    let judged = judged("five-point", &t, &y, &[("sigma", "2"), ("k", "3"), ("look_back", "false")]);
    close(judged.tolerance[20] / 6.0, 1.449, 5e-4);
}

/// The gains of a growing memory are the weights of the newest sample in the least-squares parabola through all of
/// them: its value, its first and half its second derivative there (Brookner, Tracking and Kalman Filtering Made
/// Easy, section 7).
#[test]
fn growing_gains_are_those_of_the_least_squares_parabola() {
    for j in 4..60 {
        let t: Vec<f64> = (0..j).map(|i| i as f64).collect();
        let mut y = vec![0.0; j];
        y[j - 1] = 1.0;
        let fit = Polynomial::fit(&t, &y, 2);
        let end = (j - 1) as f64;
        let (before, here, after) = (fit.at(end - 1.0), fit.at(end), fit.at(end + 1.0));
        let gains = growing(j);
        close(gains.a, here, 1e-11);
        close(gains.b, (after - before) / 2.0, 1e-11);
        close(gains.g, after - 2.0 * here + before, 1e-11);
    }
}

/// Gain of the Kalman filter with piecewise-constant acceleration noise in its steady state, at a step and a noise
/// of 1, by iterating the Riccati equation.
fn steady_kalman_gain(tracking_index: f64) -> Vector3<f64> {
    let f = Matrix3::new(1.0, 1.0, 0.5, 0.0, 1.0, 1.0, 0.0, 0.0, 1.0);
    let g = Vector3::new(0.5, 1.0, 1.0);
    let q = g * g.transpose() * tracking_index * tracking_index;
    let mut p = Matrix3::identity();
    let mut gain = Vector3::zeros();
    for _ in 0..20_000 {
        p = f * p * f.transpose() + q;
        gain = p.column(0) / (p[(0, 0)] + 1.0);
        p -= gain * p.row(0);
    }
    gain
}

/// Kalata, The tracking index (IEEE Trans. AES-20, 1984): with x.. updated by g/T^2, the index is g / sqrt(1 - a),
/// and the steady gains follow from a alone.
#[test]
fn steady_gains_are_those_of_the_steady_kalman_filter() {
    for alpha in [0.1, 0.25, 0.4, 0.6, 0.9] {
        let gains = steady(alpha);
        let kalman = steady_kalman_gain(gains.g / (1.0 - alpha).sqrt());
        close(gains.a, kalman[0], 1e-9);
        close(gains.b, kalman[1], 1e-9);
        close(gains.g, kalman[2], 1e-9);
    }
}

/// The steady innovation of both trackers is sigma / sqrt(1 - a) wide; for `kalman` a follows from the tracking
/// index by the relation above.
#[test]
fn steady_tolerances_are_those_of_the_tracking_index() {
    let (t, y) = quiet(2000);
    let abg = judged("alpha-beta-gamma", &t, &y, &[("sigma", "2"), ("alpha", "0.4")]);
    close(abg.tolerance[1500], 6.0 / 0.6_f64.sqrt(), 1e-9);
    let index = 0.02;
    let (mut low, mut high) = (1e-6, 0.95);
    for _ in 0..200 {
        let middle = f64::midpoint(low, high);
        if steady(middle).g / (1.0 - middle).sqrt() < index { low = middle } else { high = middle }
    }
    let kalman = judged("kalman", &t, &y, &[("sigma", "2"), ("tracking_index", "0.02")]);
    close(kalman.tolerance[1500], 6.0 / (1.0 - low).sqrt(), 1e-7);
}

/// 0.0027 is the probability of 3 sigma, and chi square with one degree of freedom is a normal value squared.
#[test]
fn the_joint_gate_of_one_channel_is_three_sigma() {
    let (t, y) = quiet(300);
    let alone = judged("kalman", &t, &y, &[("sigma", "2")]);
    let joint = judged("kalman", &t, &y, &[("sigma", "2"), ("test", "joint")]);
    close(joint.tolerance[200] / alone.tolerance[200], 1.0, 1e-4);
    assert!(joint.tolerance[200].to_bits() != alone.tolerance[200].to_bits());
}

/// \[001\] eq. (31) and the value the text gives for C = 1.5.
#[test]
fn huber_beta() {
    close(beta(1.5), 0.7785, 5e-5);
    // The mean of min(x^2, c^2) over the normal distribution, by quadrature.
    for c in [0.8, 1.5, 3.0] {
        let step = 1e-3;
        let density = |x: f64| (-x * x / 2.0).exp() / std::f64::consts::TAU.sqrt();
        let mean: f64 =
            (-9000..9000).map(|i| (f64::from(i) + 0.5) * step).map(|x| (x * x).min(c * c) * density(x) * step).sum();
        close(beta(c), mean, 1e-6);
    }
}

/// Section 6 of `docs/methods.md`: deviation of (prediction - sample) in sigma, one to four steps ahead.
#[test]
fn prediction_errors_of_the_candidates() {
    let figures = |points, order| [1, 2, 3, 4].map(|ahead| prediction_error(points, order, ahead));
    for (got, want) in figures(8, 1).into_iter().zip([1.27, 1.36, 1.46, 1.57]) {
        close(got, want, 5e-3);
    }
    for (got, want) in figures(16, 2).into_iter().zip([1.32, 1.47, 1.67, 1.90]) {
        close(got, want, 5e-3);
    }
    assert!(prediction_error(24, 3, 1) < 1.4);
    for ((points, order), (one, four)) in [((6, 2), (2.05, 6.7)), ((6, 3), (3.74, 31.0)), ((2, 1), (2.45, 6.5))] {
        close(prediction_error(points, order, 1), one, 5e-3);
        close(prediction_error(points, order, 4), four, 0.06 * four / 6.5);
    }
    // A line on n points one step ahead: 1 + 2 (2n + 1) / (n (n - 1)).
    close(prediction_error(8, 1, 1), (1.0 + 2.0 * 17.0 / 56.0_f64).sqrt(), 1e-12);
    // The line through two points: twice the newer less the older.
    for (got, want) in even_weights(2, 1, 1).into_iter().zip([-1.0, 2.0]) {
        close(got, want, 1e-14);
    }
}

/// The program shows these figures beside k.
#[test]
fn the_two_sided_test_shows_its_candidates_figures() {
    let lines = method("two-sided").notes(&settings("two-sided", &[])).join("\n");
    for part in ["parabola on 16 1.32 .. 1.90", "line on 8 1.27 .. 1.57", "k = 4"] {
        assert!(lines.contains(part), "{lines}");
    }
    let lines = method("two-sided").notes(&Settings::paper(method("two-sided").about().params)).join("\n");
    assert!(
        lines.contains("cubic on 24") && lines.contains("line on 2 2.45 .. 6.48") && lines.contains("k = 3"),
        "{lines}"
    );
}

/// \[001\] eq. (43) with a spike of 15 sigma at each of the first five samples in turn: none is seen without
/// `look_back`, every one with it (section 4 of `docs/methods.md`).
#[test]
fn look_back_sees_the_first_samples() {
    let noise = |i: usize| ((i * 7919 % 997) as f64 / 498.0 - 1.0) * 1.7;
    let t: Vec<f64> = (0..200).map(|i| i as f64 * 0.05).collect();
    let y: Vec<f64> = t.iter().enumerate().map(|(i, t)| 0.4 * t * t + 5.0 * t + 220.0 + noise(i)).collect();
    for id in ["five-point", "alpha-beta-gamma", "adaptive", "kalman"] {
        for at in 0..5 {
            let mut y = y.clone();
            y[at] += 15.0;
            let flagged = |look_back| {
                let judged = judged(id, &t, &y, &[("look_back", look_back), ("sigma", "1")]);
                judged.verdict[at].word()
            };
            assert_eq!(flagged("true"), "outlier", "{id}, spike at {at}");
            // The filter has its own start group, of four samples and with a tighter limit.
            assert!(id == "kalman" || flagged("false") != "outlier", "{id}, spike at {at}");
        }
    }
}
