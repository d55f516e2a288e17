//! How soon a method notices that nobody waits for it: what matters is how much it does between two looks.

use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};
use std::time::{Duration, Instant};

use wildpoint::method::{METHODS, Method, Rate, judge_segments, noise, segments};
use wildpoint::param::Settings;
use wildpoint::stop::{Stop, Stopped};
use wildpoint::track::Series;

#[path = "../benches/record/mod.rs"]
mod record;

use record::Record;

/// More samples than this are not worked on between two looks.
const MOST: u64 = 16_384;

/// Judges with scales that are known, as the worker does after they are.
fn judge(record: &Record, method: &dyn Method, stop: &Stop) -> Result<(), Stopped> {
    let settings = Settings::defaults(method.about().params);
    let series = Series::new(&record.t, &record.y);
    let ranges = segments(&series, &settings, stop)?;
    let scales = noise::scales(&series, &ranges, &settings, stop)?;
    let rate = Rate { t: &record.t, y: &record.rate };
    judge_segments(method, &series, (&ranges, &scales), Some(rate), &settings, stop).map(|_| ())
}

#[test]
fn every_method_looks_often_and_ends_at_the_first_look_that_says_so() {
    const PLENTY: u64 = 1 << 40;
    let n = 100_000;
    let record = Record::new(n, 7);
    for method in METHODS {
        let id = method.about().id;
        let left = Arc::new(AtomicU64::new(PLENTY));
        assert_eq!(judge(&record, *method, &Stop::after_looks(Arc::clone(&left))), Ok(()), "{id}");
        let looks = PLENTY - left.load(Ordering::Relaxed);
        assert!(looks * MOST >= n as u64, "{id}: {looks} looks at {n} samples");
        for share in [0, 1, 2, 3] {
            let left = Arc::new(AtomicU64::new(looks * share / 4));
            assert_eq!(judge(&record, *method, &Stop::after_looks(left)), Err(Stopped), "{id}: {share}/4 of {looks}");
        }
    }
}

/// Prints how long each method goes on after it is told to stop, at ten moments of its work.
#[test]
#[ignore = "prints figures of the machine: cargo test --release --test stopping -- --ignored --nocapture"]
#[expect(clippy::print_stdout, reason = "figures for a person")]
fn how_long_it_takes_to_stop() {
    let n = std::env::var("SAMPLES").ok().and_then(|n| n.parse().ok()).unwrap_or(1_000_000);
    let record = Record::new(n, 7);
    for method in METHODS {
        let begun = Instant::now();
        let settings = Settings::defaults(method.about().params);
        let series = Series::new(&record.t, &record.y);
        let Ok(ranges) = segments(&series, &settings, &Stop::never()) else { continue };
        let Ok(scales) = noise::scales(&series, &ranges, &settings, &Stop::never()) else { continue };
        let rate = Rate { t: &record.t, y: &record.rate };
        let before = begun.elapsed();
        let judge = |stop: &Stop| judge_segments(*method, &series, (&ranges, &scales), Some(rate), &settings, stop);
        let begun = Instant::now();
        assert!(judge(&Stop::never()).is_ok());
        let whole = begun.elapsed();
        let mut latest = Duration::ZERO;
        for tenth in 0..10 {
            let newest = Arc::new(AtomicU64::new(0));
            let stop = Stop::when_superseded(Arc::clone(&newest), 0);
            let told = std::thread::scope(|scope| {
                let teller = scope.spawn(|| {
                    let begun = Instant::now();
                    while begun.elapsed() < whole * tenth / 10 {
                        std::hint::spin_loop();
                    }
                    newest.store(1, Ordering::Relaxed);
                    Instant::now()
                });
                let ended = judge(&stop).is_err().then(Instant::now);
                teller.join().ok().zip(ended)
            });
            if let Some((told, ended)) = told {
                latest = latest.max(ended.saturating_duration_since(told));
            }
        }
        println!(
            "{:18} {n} samples: {before:9.1?} before judging, {whole:9.1?} judging, stops within {latest:9.1?}",
            method.about().id
        );
    }
}
