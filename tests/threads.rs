//! Same bytes in, same bytes out, whatever the number of threads.

use wildpoint::method::{METHODS, Rate, judge_channel};
use wildpoint::param::Settings;
use wildpoint::stop::Stop;
use wildpoint::track::Series;

#[test]
fn every_method_gives_the_same_bits_on_one_thread_and_on_three() {
    // Long enough for several pieces of parallel work, with spikes, a patch and a gap.
    let n = 30_000;
    let t: Vec<f64> = (0..n).map(|i| f64::from(i) * 0.1 + if i > 21_000 { 30.0 } else { 0.0 }).collect();
    let hash = |i: i32| (f64::from(i) * 12.9898).sin() * 43_758.545_3 % 1.0;
    let wild = |i: i32| if i % 41 == 7 || (9000..9006).contains(&i) { 25.0 } else { 0.0 };
    let y: Vec<f64> = (0..n).map(|i| 40.0 * (f64::from(i) / 900.0).sin() + hash(i) + wild(i)).collect();
    let rate: Vec<f64> = (0..n).map(|i| 0.444 * (f64::from(i) / 900.0).cos()).collect();
    let series = Series::new(&t, &y);
    for method in METHODS {
        let params = method.about().params;
        for settings in [Settings::defaults(params), Settings::paper(params)] {
            let on = |threads| {
                let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("a pool");
                let rate = Some(Rate { t: &t, y: &rate });
                let judged = pool
                    .install(|| judge_channel(*method, &series, rate, &settings, &Stop::never()))
                    .expect("nobody stops it");
                let bits = |values: &[f64]| values.iter().map(|v| v.to_bits()).collect::<Vec<u64>>();
                let numbers = [&judged.expected, &judged.tolerance, &judged.scale, &judged.own].map(|v| bits(v));
                (judged.verdict, numbers)
            };
            assert!(on(1) == on(3), "{}", method.about().id);
        }
    }
}
