//! Every registered method against the results of an independent implementation, sample by sample, on the records
//! in `../shared/vectors`. Skipped, with a line that says so, where that folder is absent.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use wildpoint::method::{METHODS, Method, Rate, Verdict, judge_channel};
use wildpoint::param::Settings;
use wildpoint::stop::Stop;
use wildpoint::track::Series;

fn folder() -> Option<PathBuf> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../shared/vectors");
    folder.is_dir().then_some(folder)
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

/// Differences between what `method` says and what the file says, a line each.
fn differences(folder: &Path, method: &dyn Method) -> Vec<String> {
    let id = method.about().id;
    let mut differences = Vec::new();
    for ((name, preset), rows) in expected(folder, id) {
        let record = record(folder, &name);
        let settings = match preset.as_str() {
            "paper" => Settings::paper(method.about().params),
            _ => Settings::defaults(method.about().params),
        };
        let series = Series::new(&record.t, &record.y);
        let rates = record.rate.as_ref().map(|rate| Series::new(&record.t, rate));
        let rate = rates.as_ref().map(|r| Rate { t: &r.t, y: &r.y });
        let judged = judge_channel(method, &series, rate, &settings, &Stop::never()).expect("nobody stops it");
        let largest = series.y.iter().fold(0.0_f64, |m, y| m.max(y.abs()));
        let mut own = vec![f64::NAN; series.len()];
        for range in wildpoint::method::segments(&series, &settings) {
            let outliers: Vec<usize> = range.clone().filter(|&i| judged.verdict[i] == Verdict::Outlier).collect();
            outliers.iter().for_each(|&i| own[i] = f64::NAN);
        }
        for (i, (verdict, p, h, _clean)) in rows.iter().enumerate() {
            let at = series.position(i);
            let got = at.map_or(Verdict::Missing, |at| judged.verdict[at]).word();
            let (got_p, got_h) = at.map_or((f64::NAN, f64::NAN), |at| (judged.expected[at], judged.tolerance[at]));
            if got != verdict || !agree(got_p, *p, largest) || !agree(got_h, *h, largest) {
                differences.push(format!(
                    "{id} {name} {preset} row {}: {got} {got_p} {got_h}, expected {verdict} {p} {h}",
                    i + 1
                ));
            }
        }
    }
    differences
}

#[test]
fn every_method_agrees_with_an_independent_implementation() {
    let Some(folder) = folder() else {
        println!("skipped: no folder ../shared/vectors");
        return;
    };
    let only = std::env::var("WILDPOINT_METHOD").ok();
    let wanted = |m: &&&dyn Method| only.as_deref().is_none_or(|id| m.about().id == id);
    let differences: Vec<String> = METHODS.iter().filter(wanted).flat_map(|m| differences(&folder, *m)).collect();
    assert!(
        differences.is_empty(),
        "{} differences, the first:\n{}",
        differences.len(),
        differences[..differences.len().min(30)].join("\n")
    );
}
