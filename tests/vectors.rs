//! Every registered method against the results of an independent implementation, sample by sample, on the records
//! in `tests/vectors`.

#![expect(clippy::expect_used, reason = "a test that cannot read its own data may say so by ending")]

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use wildpoint::method::{Damaged, Method, Rate, Segment, Verdict, judge_channel, noise, segments, voting};
use wildpoint::param::Settings;
use wildpoint::stop::Stop;
use wildpoint::track::Series;

fn folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/vectors")
}

struct Record {
    t: Vec<f64>,
    y: Vec<f64>,
    rate: Option<Vec<f64>>,
}

fn number(text: &str) -> f64 {
    if text.is_empty() { f64::NAN } else { text.parse().expect("a number") }
}

fn record(folder: &Path, name: &str) -> Record {
    let mut reader = csv::Reader::from_path(folder.join(format!("{name}.csv"))).expect("the record opens");
    let has_rate = reader.headers().expect("a header").iter().any(|h| h == "rate");
    let (mut t, mut y, mut rate) = (Vec::new(), Vec::new(), Vec::new());
    for row in reader.records() {
        let row = row.expect("a row");
        t.push(number(&row[0]));
        y.push(number(&row[1]));
        if has_rate {
            rate.push(number(&row[2]));
        }
    }
    Record { t, y, rate: has_rate.then_some(rate) }
}

/// Rows by record and preset: verdict, expected, tolerance, clean.
type Expected = BTreeMap<(String, String), Vec<(String, f64, f64, f64)>>;

fn expected(folder: &Path, id: &str) -> Expected {
    let mut reader = csv::Reader::from_path(folder.join(format!("expected.{id}.csv"))).expect("the file opens");
    let mut expected = Expected::new();
    for row in reader.records() {
        let row = row.expect("a row");
        expected.entry((row[0].into(), row[1].into())).or_default().push((
            row[3].into(),
            number(&row[4]),
            number(&row[5]),
            number(&row[6]),
        ));
    }
    expected
}

fn agree(a: f64, b: f64, largest: f64) -> bool {
    (a.is_nan() && b.is_nan()) || (a - b).abs() <= 1e-9 * b.abs() + 1e-9 * largest
}

/// `max_fill` of the repairs: a longer run of outliers is removed whole.
const MAX_FILL: usize = 20;

/// The values after the own repair of the method; NaN where a sample is removed.
fn cleaned(method: &dyn Method, series: &Series<'_>, rate: Option<Rate<'_>>, settings: &Settings) -> Vec<f64> {
    let mut clean = series.y.to_vec();
    let stop = Stop::never();
    let ranges = segments(series, settings, &stop).expect("nobody stops it");
    let scales = noise::scales(series, &ranges, settings, &stop).expect("nobody stops it");
    for (range, scales) in ranges.iter().zip(&scales) {
        let segment = Segment::of(series, range, scales, rate);
        let part = method.judge(&segment, settings, &stop).expect("nobody stops it");
        let outliers: Vec<usize> = (0..segment.len()).filter(|&i| part.verdict[i] == Verdict::Outlier).collect();
        let judged = part.part(0..segment.len());
        let damaged = Damaged { segment: &segment, settings, judged, outliers: &outliers };
        let own = method.own_repair(&damaged, &stop).expect("nobody stops it");
        let mut own = own.into_iter();
        for run in outliers.chunk_by(|a, b| a + 1 == *b) {
            for (at, value) in run.iter().zip(&mut own) {
                clean[range.start + at] = if run.len() > MAX_FILL { f64::NAN } else { value };
            }
        }
    }
    clean
}

/// The defaults, with the floor of section 1 of the methods page, which the vectors are made with.
fn documented(method: &dyn Method) -> Settings {
    let mut settings = Settings::defaults(method.about().params);
    if settings.get("floor").is_some() {
        settings.set_text(method.about().id, "floor", "auto").expect("a legal value");
    }
    // The page as it was: the defaults are others now.
    if method.about().id == "matched" {
        settings.set_text("matched", "window", "31").expect("a legal value");
        settings.set_text("matched", "repair_rule", "expected").expect("a legal value");
    }
    settings
}

/// What the page took for the paper's settings when the vectors were made. The documents have other values now where they
/// were misread; a vector is reproduced with the settings it was made with.
const PAPER_AS_IT_WAS: [(&str, &[(&str, &str)]); 8] = [
    ("five-point", &[("max_run", "5")]),
    ("alpha-beta-gamma", &[("max_run", "5")]),
    ("adaptive", &[("max_run", "5"), ("k", "3")]),
    ("two-sided", &[("points", "6"), ("two_point", "false"), ("start_limit", "robust")]),
    ("grubbs", &[("sides", "two")]),
    ("mean-window", &[("scale", "rms")]),
    ("median-window", &[("scale", "rms")]),
    ("kalman", &[("max_run", "25")]),
];

fn paper_as_it_was(method: &dyn Method) -> Settings {
    let id = method.about().id;
    let mut settings = Settings::paper(method.about().params);
    for (key, value) in PAPER_AS_IT_WAS.iter().filter(|(of, _)| *of == id).flat_map(|(_, pairs)| *pairs) {
        settings.set_text(id, key, value).expect("a legal value");
    }
    settings
}

/// Differences between what `method` says and what the file says, a line each.
fn differences(folder: &Path, method: &dyn Method) -> Vec<String> {
    let id = method.about().id;
    let mut differences = Vec::new();
    for ((name, preset), rows) in expected(folder, id) {
        let record = record(folder, &name);
        let settings = match preset.as_str() {
            "paper" => paper_as_it_was(method),
            _ => documented(method),
        };
        let series = Series::new(&record.t, &record.y);
        let rates = record.rate.as_ref().map(|rate| Series::new(&record.t, rate));
        let rate = rates.as_ref().map(|r| Rate { t: &r.t, y: &r.y });
        let judged = judge_channel(method, &series, rate, &settings, &Stop::never()).expect("nobody stops it");
        let largest = series.y.iter().fold(0.0_f64, |m, y| m.max(y.abs()));
        let own = cleaned(method, &series, rate, &settings);
        for (i, (verdict, p, h, clean)) in rows.iter().enumerate() {
            let at = series.position(i);
            let got = at.map_or(Verdict::Missing, |at| judged.verdict[at]).word();
            let (got_p, got_h) = at.map_or((f64::NAN, f64::NAN), |at| (judged.expected[at], judged.tolerance[at]));
            let got_clean = at.map_or(f64::NAN, |at| own[at]);
            let numbers = [(got_p, *p), (got_h, *h), (got_clean, *clean)];
            if got != verdict || numbers.iter().any(|(got, want)| !agree(*got, *want, largest)) {
                differences.push(format!(
                    "{id} {name} {preset} row {}: {got} {got_p} {got_h} {got_clean}, expected {verdict} {p} {h} {clean}",
                    i + 1
                ));
            }
        }
    }
    differences
}

#[test]
fn every_method_agrees_with_an_independent_implementation() {
    let folder = folder();
    let only = std::env::var("WILDPOINT_METHOD").ok();
    let wanted = |m: &&dyn Method| only.as_deref().is_none_or(|id| m.about().id == id);
    let differences: Vec<String> = voting().filter(wanted).flat_map(|m| differences(&folder, m)).collect();
    assert!(
        differences.is_empty(),
        "{} differences, the first:\n{}",
        differences.len(),
        differences[..differences.len().min(30)].join("\n")
    );
}
