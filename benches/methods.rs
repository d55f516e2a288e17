//! Cost of every method at its defaults, and of the sliding ones at other windows: one channel, one segment, a
//! parabola with unit noise and 1 % outliers. `cargo bench --bench methods -- hampel` measures one.

use std::hint::black_box;
use std::time::Duration;

use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use wildpoint::experiment::Random;
use wildpoint::method::{METHODS, Method, Rate, judge_channel};
use wildpoint::param::{Settings, Value};
use wildpoint::stop::Stop;
use wildpoint::track::Series;

struct Record {
    t: Vec<f64>,
    y: Vec<f64>,
    rate: Vec<f64>,
}

impl Record {
    fn new(n: usize) -> Self {
        let mut random = Random::new(1);
        let t: Vec<f64> = (0..n).map(|i| i as f64 * 0.1).collect();
        let end = n as f64 * 0.1;
        let y = t.iter().map(|t| {
            let spike = if random.uniform() < 0.01 { random.sign() * random.between(8.0, 40.0) } else { 0.0 };
            200.0 + 3.0 * t - 1.5 * t * t / end + random.normal() + spike
        });
        let y: Vec<f64> = y.collect();
        let rate = t.iter().map(|t| 3.0 - 3.0 * t / end + 0.1 * random.normal()).collect();
        Self { t, y, rate }
    }

    fn judge(&self, method: &dyn Method, settings: &Settings) -> usize {
        let series = Series::new(&self.t, &self.y);
        let rate = Rate { t: &self.t, y: &self.rate };
        judge_channel(method, &series, Some(rate), settings, &Stop::never()).map_or(0, |j| j.verdict.len())
    }
}

fn defaults(criterion: &mut Criterion) {
    for n in [100_000, 1_000_000] {
        let record = Record::new(n);
        let mut group = criterion.benchmark_group("method at its defaults");
        group.throughput(Throughput::Elements(n as u64));
        for method in METHODS {
            let settings = Settings::defaults(method.about().params);
            group.bench_function(BenchmarkId::new(method.about().id, n), |b| {
                b.iter(|| black_box(record.judge(*method, &settings)));
            });
        }
        group.finish();
    }
}

fn windows(criterion: &mut Criterion) {
    let n = 1_000_000;
    let record = Record::new(n);
    let mut group = criterion.benchmark_group("window");
    group.throughput(Throughput::Elements(n as u64));
    for method in METHODS.iter().filter(|m| m.about().params.iter().any(|p| p.key == "window")) {
        let id = method.about().id;
        for window in [11, 101, 1001] {
            let mut settings = Settings::defaults(method.about().params);
            // Some windows end earlier; those lengths are left out.
            if settings.set(id, "window", Value::Whole(window)).is_ok() {
                group.bench_function(BenchmarkId::new(id, window), |b| {
                    b.iter(|| black_box(record.judge(*method, &settings)));
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
    targets = defaults, windows
}
criterion_main!(benches);
