//! Cost of every method at its defaults, of the jobs that have a budget, and of the sliding ones at other windows: one
//! channel, one segment, a parabola with unit noise and 1 % outliers. `cargo bench --bench methods -- hampel` measures
//! one, `-- budget` those with a budget. The record has been loaded and calibrated, as for every result but the first;
//! `-- calibration` measures that, and `-- advice` the advice on a record.

use std::hint::black_box;
use std::time::Duration;

use criterion::measurement::WallTime;
use criterion::{BenchmarkGroup, BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use wildpoint::calibration::{Calibration, Rules, calibrate};
use wildpoint::method::{METHODS, Method, Rate, judge_segments, noise, segments, voting};
use wildpoint::param::{Settings, Value};
use wildpoint::repair::{self, Damage};
use wildpoint::session::detectability::Study;
use wildpoint::session::{Preset, Setup};
use wildpoint::stop::Stop;
use wildpoint::track::Series;

mod record;

use record::Record;

/// A channel that has been calibrated.
struct Channel<'a> {
    record: &'a Record,
    series: Series<'a>,
    calibration: Calibration,
}

impl<'a> Channel<'a> {
    fn new(record: &'a Record) -> Self {
        let series = Series::new(&record.t, &record.y);
        let calibration = calibrate(&series, Rules::default(), &Stop::never()).unwrap_or_else(|e| panic!("{e:?}"));
        Self { record, series, calibration }
    }

    /// How many samples the method has judged.
    fn judge(&self, method: &dyn Method, settings: &Settings) -> usize {
        let (series, stop) = (&self.series, Stop::never());
        let rate = Rate { t: &self.record.t, y: &self.record.rate };
        let judged = segments(series, settings, &stop).and_then(|ranges| {
            let scales = noise::scales_by(series, &ranges, settings, Some(&self.calibration), &stop)?;
            judge_segments(method, series, (&ranges, &scales), Some(rate), settings, &stop)
        });
        judged.map_or(0, |j| j.verdict.len())
    }
}

fn calibrations(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("calibration");
    for n in [1_000_000, 10_000_000] {
        let record = Record::new(n, 1);
        let series = Series::new(&record.t, &record.y);
        group.throughput(Throughput::Elements(n as u64));
        group.bench_function(BenchmarkId::new("of a channel", n), |b| {
            b.iter(|| calibrate(black_box(&series), Rules::default(), &Stop::never()).map_or(0, |c| c.limits.len()));
        });
    }
    group.finish();
}

/// The advice of `wildpoint advise` on all methods that need no rate: until there is a first one, and complete.
fn advice(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("advice");
    for n in [100_000, 10_000_000] {
        let record = Record::new(n, 1);
        let series = Series::new(&record.t, &record.y);
        let measure = |rounds: usize| {
            let own = voting().filter(|m| !m.about().needs_rate);
            let setups = own.map(|method| Setup::new(method, Preset::Default)).collect();
            let stop = Stop::never();
            let mut study = Study::new((&series).into(), setups, 1, &stop).unwrap_or_else(|e| panic!("{e}"));
            let mut goes_on = true;
            while goes_on && study.rounds().done < rounds {
                goes_on = study.advance(&stop).unwrap_or_else(|e| panic!("{e}"));
            }
            study.advice().recommended
        };
        group.bench_function(BenchmarkId::new("first", n), |b| b.iter(|| black_box(measure(1))));
        group.bench_function(BenchmarkId::new("complete", n), |b| b.iter(|| black_box(measure(usize::MAX))));
    }
    group.finish();
}

fn defaults(criterion: &mut Criterion) {
    for n in [100_000, 1_000_000] {
        let record = Record::new(n, 1);
        let channel = Channel::new(&record);
        let mut group = criterion.benchmark_group("method at its defaults");
        group.throughput(Throughput::Elements(n as u64));
        for method in METHODS {
            let settings = Settings::defaults(method.about().params);
            group.bench_function(BenchmarkId::new(method.about().id, n), |b| {
                b.iter(|| black_box(channel.judge(*method, &settings)));
            });
        }
        group.finish();
    }
}

/// Settings that differ from the defaults.
type Changes = &'static [(&'static str, &'static str)];

/// What a plain loop of the literature does: no baseline, no pooled floor, no feedback.
const PLAIN: Changes = &[("detrend", "off"), ("noise_floor", "off"), ("feedback", "false")];

/// Jobs with a budget that are no method at its defaults: method, window, settings that differ, their name.
const BUDGETS: &[(&str, &str, Changes, &str)] = &[
    ("hampel", "501", &[], "hampel, window 501"),
    ("median-window", "11", PLAIN, "median-window, window 11, plain"),
    ("mean-window", "11", PLAIN, "mean-window, window 11, plain"),
    ("poly-window", "21", &[], "poly-window, window 21"),
    ("poly-window", "1001", &[], "poly-window, window 1001"),
    ("matched", "31", &[], "matched, window 31"),
];

fn budgets(criterion: &mut Criterion) {
    let n = 1_000_000;
    let record = Record::new(n, 1);
    let channel = Channel::new(&record);
    let mut group = criterion.benchmark_group("budget");
    group.throughput(Throughput::Elements(n as u64));
    for (id, window, changes, name) in BUDGETS {
        let Some(method) = METHODS.iter().find(|m| m.about().id == *id) else { continue };
        let mut settings = Settings::defaults(method.about().params);
        let rms = [("window", *window), ("scale", if *id == "mean-window" { "rms" } else { "mad" })];
        for (key, value) in
            rms.iter().chain(*changes).filter(|(key, _)| settings.get(key).is_some()).collect::<Vec<_>>()
        {
            settings.set_text(id, key, value).unwrap_or_else(|e| panic!("{id}: {e}"));
        }
        group.bench_function(BenchmarkId::new(*name, n), |b| {
            b.iter(|| black_box(channel.judge(*method, &settings)));
        });
    }
    infill(&mut group, &record);
    group.finish();
}

/// The interpolating repairs of 1 % of the samples, every tenth of them a patch of five.
fn infill(group: &mut BenchmarkGroup<'_, WallTime>, record: &Record) {
    let n = record.t.len();
    let starts = (50..n - 50).step_by(140).enumerate();
    let outliers: Vec<usize> = starts.flat_map(|(i, at)| at..at + if i % 10 == 0 { 5 } else { 1 }).collect();
    let nothing = vec![f64::NAN; outliers.len()];
    let damage = Damage { t: &record.t, y: &record.y, outliers: &outliers, own: &nothing, expected: &nothing };
    for id in ["polynomial", "spline", "linear"] {
        let mut settings = Settings::defaults(repair::PARAMS);
        settings.set_text("repair", "method", id).unwrap_or_else(|e| panic!("{id}: {e}"));
        group.bench_function(BenchmarkId::new(format!("infill, {id}"), n), |b| {
            b.iter(|| black_box(repair::repair(&damage, &settings, &Stop::never()).map(|values| values.len())));
        });
    }
}

/// A few methods on ten million samples: their cost must grow no more than in proportion.
fn long(criterion: &mut Criterion) {
    let n = 10_000_000;
    let record = Record::new(n, 1);
    let channel = Channel::new(&record);
    let mut group = criterion.benchmark_group("method at its defaults");
    group.throughput(Throughput::Elements(n as u64));
    for method in METHODS.iter().filter(|m| ["hampel", "mean-window", "five-point"].contains(&m.about().id)) {
        let settings = Settings::defaults(method.about().params);
        group.bench_function(BenchmarkId::new(method.about().id, n), |b| {
            b.iter(|| black_box(channel.judge(*method, &settings)));
        });
    }
    group.finish();
}

fn windows(criterion: &mut Criterion) {
    let n = 1_000_000;
    let record = Record::new(n, 1);
    let channel = Channel::new(&record);
    let mut group = criterion.benchmark_group("window");
    group.throughput(Throughput::Elements(n as u64));
    for method in METHODS.iter().filter(|m| m.about().params.iter().any(|p| p.key == "window")) {
        let id = method.about().id;
        for window in [11, 101, 1001] {
            let mut settings = Settings::defaults(method.about().params);
            // Some windows end earlier; those lengths are left out.
            if settings.set(id, "window", Value::Whole(window)).is_ok() {
                group.bench_function(BenchmarkId::new(id, window), |b| {
                    b.iter(|| black_box(channel.judge(*method, &settings)));
                });
            }
        }
    }
    group.finish();
}

criterion_group! {
    name = benches;
    config = Criterion::default()
        .sample_size(10)
        .warm_up_time(Duration::from_millis(200))
        .measurement_time(Duration::from_secs(1));
    targets = calibrations, advice, defaults, budgets, windows, long
}
criterion_main!(benches);
