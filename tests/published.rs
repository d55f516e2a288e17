//! Numbers that the literature prints, each with its source.

#![expect(clippy::expect_used, reason = "a test that cannot read its own data may say so by ending")]

use wildpoint::method::{self, Judged, Segment, Verdict};
use wildpoint::param::Settings;
use wildpoint::stop::Stop;

/// What `id` says of values at even steps under its defaults, with the floor of the documents, and these settings.
fn judged(id: &str, y: &[f64], settings: &[(&str, &str)]) -> Judged {
    let method = method::find(id).expect("a registered method");
    let mut chosen = Settings::defaults(method.about().params);
    if chosen.get("floor").is_some() {
        chosen.set_text(id, "floor", "auto").expect("a legal setting");
    }
    for (key, value) in settings {
        chosen.set_text(id, key, value).expect("a legal setting");
    }
    let t: Vec<f64> = (0..y.len()).map(|i| i as f64).collect();
    let segment = Segment { t: &t, y, interval: 1.0, sigma: 0.0, floor: 0.0, floors: &[], objections: &[], rate: None };
    method.judge(&segment, &chosen, &Stop::never()).expect("nobody stops it")
}

/// The values that were flagged.
fn flagged(id: &str, y: &[f64], settings: &[(&str, &str)]) -> Vec<f64> {
    let judged = judged(id, y, settings);
    y.iter().zip(judged.verdict).filter(|(_, v)| *v == Verdict::Outlier).map(|(y, _)| *y).collect()
}

fn mean_and_deviation(y: &[f64]) -> (f64, f64) {
    let n = y.len() as f64;
    let mean = y.iter().sum::<f64>() / n;
    (mean, (y.iter().map(|v| (v - mean) * (v - mean)).sum::<f64>() / (n - 1.0)).sqrt())
}

/// Tolerance in standard deviations on data in which nothing is flagged: the largest of a ramp is 1.73 away.
fn limit(id: &str, n: usize, settings: &[(&str, &str)]) -> f64 {
    let ramp: Vec<f64> = (0..n).map(|i| i as f64).collect();
    let settings: Vec<_> = [("trend_order", "0")].iter().chain(settings).copied().collect();
    let judged = judged(id, &ramp, &settings);
    assert!(judged.verdict.iter().all(|v| *v == Verdict::Normal));
    judged.tolerance[0] / mean_and_deviation(&ramp).1
}

#[test]
fn the_uranium_example_of_grubbs() {
    // NIST/SEMATECH e-Handbook 1.3.5.17.1, from Tietjen and Moore 1972: G = 2.4687, and 245.57 is an outlier.
    let y = [199.31, 199.53, 200.19, 200.82, 201.92, 201.95, 202.18, 245.57];
    let (mean, s) = mean_and_deviation(&y);
    assert!(((245.57 - mean) / s - 2.46876).abs() < 1e-5);
    assert_eq!(flagged("grubbs", &y, &[("trend_order", "0"), ("alpha", "0.05")]), [245.57]);
}

/// NIST/SEMATECH e-Handbook 1.3.5.17.3: the data of Rosner 1983.
const ROSNER: [f64; 54] = [
    -0.25, 0.68, 0.94, 1.15, 1.20, 1.26, 1.26, 1.34, 1.38, 1.43, 1.49, 1.49, 1.55, 1.56, 1.58, 1.65, 1.69, 1.70, 1.76,
    1.77, 1.81, 1.91, 1.94, 1.96, 1.99, 2.06, 2.09, 2.10, 2.14, 2.15, 2.23, 2.24, 2.26, 2.35, 2.37, 2.40, 2.47, 2.54,
    2.62, 2.64, 2.90, 2.92, 2.92, 2.93, 3.21, 3.26, 3.30, 3.59, 3.68, 4.30, 4.64, 5.34, 5.42, 6.01,
];

#[test]
fn three_outliers_in_the_data_of_rosner() {
    // The handbook tests up to 10 and finds three, though neither the first nor the second alone is significant.
    for fraction in ["0.2", "0.35"] {
        let settings = [("trend_order", "0"), ("max_fraction", fraction)];
        assert_eq!(flagged("gesd", &ROSNER, &settings), [5.34, 5.42, 6.01]);
        // Its table: the critical value after the third is 3.136.
        let s = mean_and_deviation(&ROSNER[..51]).1;
        assert!((judged("gesd", &ROSNER, &settings).tolerance[0] / s - 3.136).abs() < 0.0006);
    }
    // R1 = 3.118 stays below 3.158 (printed cut off): one at a time, the three mask each other.
    assert_eq!(flagged("grubbs", &ROSNER, &[("trend_order", "0"), ("alpha", "0.05")]), [0.0; 0]);
    assert!((limit("grubbs", 54, &[("alpha", "0.05")]) - 3.158).abs() < 0.001);
}

#[test]
fn the_fifteen_temperatures() {
    // The example of the textbooks on measurement errors, from which [001] takes its criteria: all reject 20.30 and
    // nothing else; then the mean is 20.411 and the deviation 0.016.
    let y = [20.42, 20.43, 20.40, 20.43, 20.42, 20.43, 20.39, 20.30, 20.40, 20.43, 20.42, 20.41, 20.39, 20.39, 20.40];
    let flat = ("trend_order", "0");
    assert_eq!(flagged("wright", &y, &[flat]), [20.30]);
    assert_eq!(flagged("romanovsky", &y, &[flat, ("alpha", "0.05")]), [20.30]);
    // The table of Grubbs that the textbooks print (2.41 for 15) is one-sided: alpha 0.05 there is 0.1 here.
    assert_eq!(flagged("grubbs", &y, &[flat, ("alpha", "0.1")]), [20.30]);
    assert_eq!(flagged("grubbs", &y, &[flat, ("alpha", "0.05")]), [20.30]);
    let judged = judged("wright", &y, &[flat]);
    assert!((judged.expected[0] - 20.411).abs() < 0.0005 && (judged.tolerance[0] / 3.0 - 0.016).abs() < 0.0005);
}

#[test]
fn chauvenets_table() {
    // Coleman and Steele, Experimentation and Uncertainty Analysis, table 2.3; 1.96 for 10 and 2.81 for 100 everywhere.
    for (n, k) in [(10, 1.96), (15, 2.13), (20, 2.24), (25, 2.33), (50, 2.57), (100, 2.81), (1000, 3.48)] {
        assert!((limit("chauvenet", n, &[]) - k).abs() < 0.0075, "{n}");
    }
}

#[test]
fn the_table_of_grubbs() {
    // Grubbs and Beck 1972: one-sided 2.5 % and 0.5 %, so 5 % and 1 % for both sides.
    for (n, five, one) in
        [(10, 2.290, 2.482), (20, 2.709, 3.001), (30, 2.908, 3.236), (50, 3.128, 3.483), (100, 3.383, 3.754)]
    {
        assert!((limit("grubbs", n, &[("alpha", "0.05")]) - five).abs() < 0.0015, "{n}");
        assert!((limit("grubbs", n, &[("alpha", "0.01")]) - one).abs() < 0.0015, "{n}");
    }
    // One-sided 5 %, as the textbooks print it.
    assert!((limit("grubbs", 15, &[("alpha", "0.1")]) - 2.409).abs() < 0.001);
    assert!((limit("grubbs", 20, &[("alpha", "0.1")]) - 2.557).abs() < 0.001);
}

#[test]
fn the_table_of_romanovsky() {
    // K(n, alpha) as the textbooks on measurement errors print it: K = t sqrt(n / (n - 1)). The limit here is on the
    // deviation from the mean of all, so t is recovered from it.
    for (n, five, one) in [(8, 2.62, 3.96), (10, 2.43, 3.54), (15, 2.24, 3.12), (20, 2.16, 2.95)] {
        for (alpha, wanted) in [("0.05", five), ("0.01", one)] {
            let (g, count) = (limit("romanovsky", n, &[("alpha", alpha)]), n as f64);
            let t = ((count - 2.0) * g * g / ((count - 1.0) * (count - 1.0) / count - g * g)).sqrt();
            assert!((t * (count / (count - 1.0)).sqrt() - wanted).abs() < 0.0055, "{n} {alpha}");
        }
    }
}

/// The multiplier up to which a lone spike at `at` among `n` zeros is flagged, to a thousandth.
fn reach(id: &str, n: usize, at: usize, settings: &[(&str, &str)]) -> f64 {
    let mut y = vec![0.0; n];
    y[at] = 1.0;
    let found = |k: f64| {
        let k = k.to_string();
        let settings: Vec<_> = settings.iter().copied().chain([("k", k.as_str())]).collect();
        !flagged(id, &y, &settings).is_empty()
    };
    let (mut low, mut high) = (0.5, 50.0);
    while high - low > 1e-4 {
        let middle = f64::midpoint(low, high);
        if found(middle) { low = middle } else { high = middle }
    }
    low
}

#[test]
fn a_lone_spike_reaches_no_more_scales_than_the_root_mean_square_allows() {
    // (n - 1) / sqrt(n): no sample can lie further from the mean of its set (Samuelson 1968).
    for (window, wanted) in [("7", 2.268), ("8", 2.475), ("10", 2.846), ("11", 3.015)] {
        let settings =
            [("window", window), ("scale", "rms"), ("detrend", "off"), ("noise_floor", "off"), ("feedback", "false")];
        assert!((reach("mean-window", 60, 30, &settings) - wanted).abs() < 6e-4, "{window}");
    }
    // sqrt((n - 1) (1 - leverage)) of a parabola over 11: nowhere more than 2.88.
    let best = (0..11).map(|at| reach("poly-window", 11, at, &[("window", "11")])).fold(0.0, f64::max);
    assert!((best - 2.88).abs() < 0.005, "{best}");
    // The same with a mean over all: 3 sigma flags nothing among 10 samples, and something among 11.
    assert!((reach("wright", 10, 4, &[("max_passes", "1")]) - 2.846).abs() < 6e-4);
    assert!((reach("wright", 11, 4, &[("max_passes", "1")]) - 3.015).abs() < 6e-4);
}

#[test]
fn three_sigma_cannot_cut_the_tail_of_a_parabola() {
    // The farthest value of x = t^2 lies sqrt(5) = 2.236 standard deviations from the mean: whatever figure 2 of [002]
    // shows, Wright alone does not reject it.
    let y: Vec<f64> = (0..=20_000).map(|i| f64::from(i) * f64::from(i)).collect();
    assert!(flagged("wright", &y, &[("k", "2.24"), ("max_passes", "1")]).is_empty());
    assert!(!flagged("wright", &y, &[("k", "2.23"), ("max_passes", "1")]).is_empty());
}
