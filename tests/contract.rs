//! Laws that every method of the registry keeps.

#![expect(
    clippy::expect_used,
    clippy::print_stdout,
    reason = "a test that cannot read its own data may say so by ending; what is skipped or measured is printed"
)]

use wildpoint::experiment::Random;
use wildpoint::method::{Direction, Gated, Judged, METHODS, Method, Rate, Verdict, judge_channel};
use wildpoint::param::{Kind, Numbers, Settings, Value, Words};
use wildpoint::repair;
use wildpoint::stop::Stop;
use wildpoint::track::Series;

/// A record with the rate that methods ask for.
#[derive(Clone)]
struct Record {
    t: Vec<f64>,
    y: Vec<f64>,
    rate: Vec<f64>,
}

impl Record {
    /// A track, its rate and unit noise on both, at 10 Hz.
    fn new(n: usize, seed: u64, track: impl Fn(f64) -> f64, rate: impl Fn(f64) -> f64) -> Self {
        let mut random = Random::new(seed);
        let t: Vec<f64> = (0..n).map(|i| i as f64 * 0.1).collect();
        let y = t.iter().map(|&t| track(t) + random.normal()).collect();
        let rate = t.iter().map(|&t| rate(t) + random.normal()).collect();
        Self { t, y, rate }
    }

    fn flat(n: usize, seed: u64) -> Self {
        Self::new(n, seed, |_| 5.0, |_| 0.0)
    }

    fn arc(n: usize, seed: u64) -> Self {
        Self::new(n, seed, |t| 200.0 + 50.0 * t - 0.4 * t * t, |t| 50.0 - 0.8 * t)
    }

    fn judge(&self, method: &dyn Method, settings: &Settings) -> Judged {
        let series = Series::new(&self.t, &self.y);
        let rate = Rate { t: &self.t, y: &self.rate };
        judge_channel(method, &series, Some(rate), settings, &Stop::never()).expect("nobody stops it")
    }
}

fn id(method: &dyn Method) -> &'static str {
    method.about().id
}

fn defaults(method: &dyn Method) -> Settings {
    Settings::defaults(method.about().params)
}

/// Defaults and paper values.
fn presets(method: &dyn Method) -> [Settings; 2] {
    [defaults(method), Settings::paper(method.about().params)]
}

fn outliers(judged: &Judged) -> Vec<usize> {
    (0..judged.verdict.len()).filter(|&i| judged.verdict[i] == Verdict::Outlier).collect()
}

/// Every bit of a judgement.
fn bits(judged: &Judged) -> Vec<u64> {
    let numbers = judged.expected.iter().chain(&judged.tolerance).map(|x| x.to_bits());
    judged.verdict.iter().map(|v| *v as u64).chain(numbers).collect()
}

#[test]
fn ids_and_keys_are_unique_and_every_declared_value_is_legal() {
    let mut ids = Vec::new();
    for method in METHODS.iter().map(|m| m.about()) {
        assert!(!ids.contains(&method.id), "{} comes twice", method.id);
        ids.push(method.id);
        assert!(!method.name.is_empty() && !method.source.is_empty() && method.advice.len() > 40, "{}", method.id);
        let mut keys = Vec::new();
        for param in method.params {
            let of = format!("{}.{}", method.id, param.key);
            assert!(!keys.contains(&param.key), "{of} comes twice");
            keys.push(param.key);
            assert!(param.accepts(param.default), "{of}: default {}", param.default);
            if let Some(paper) = param.paper {
                assert!(param.accepts(paper.value) && paper.value != param.default, "{of}: paper {}", paper.value);
                assert!(
                    !paper.why.is_empty() && !paper.why.ends_with('.'),
                    "{of}: why the default departs, in one line"
                );
            }
            assert!(param.help.len() > 5, "{of} has no help");
            assert_eq!(param.parse(&param.default.to_string()).ok(), Some(param.default), "{of} reads back");
            assert!(repair::PARAMS.iter().all(|p| p.key != param.key), "{of} is a key of repair, too");
        }
        assert!(keys.contains(&"max_gap") && keys.contains(&"floor"), "{}: every method is cut and floored", method.id);
    }
}

#[test]
fn short_constant_and_missing_records_are_judged_without_a_flag() {
    let nan = f64::NAN;
    let values: [&[f64]; 9] = [
        &[],
        &[1.0],
        &[1.0, 2.0],
        &[1.0, 2.0, 4.0],
        &[7.5; 200],
        &[nan; 50],
        &[1.0, nan, nan, nan, 2.0, 3.0],
        &[1e308, -1e308, 1e308, -1e308, 1e308, -1e308, 1e308, -1e308],
        &[5e-324; 40],
    ];
    for method in METHODS {
        for settings in presets(*method) {
            for y in values {
                let t: Vec<f64> = (0..y.len()).map(|i| i as f64).collect();
                let record = Record { t: t.clone(), y: y.to_vec(), rate: vec![0.0; t.len()] };
                let judged = record.judge(*method, &settings);
                let present = y.iter().filter(|v| v.is_finite()).count();
                assert_eq!(judged.verdict.len(), present, "{} {y:?}", id(*method));
                assert_eq!((judged.expected.len(), judged.tolerance.len()), (present, present), "{}", id(*method));
                let constant = y.windows(2).all(|w| w[0] == w[1]);
                assert!(!constant || outliers(&judged).is_empty(), "{} flags a constant", id(*method));
                assert!(judged.verdict.iter().all(|v| *v != Verdict::Missing));
            }
        }
    }
}

#[test]
fn a_run_of_missing_samples_changes_lengths_only() {
    let mut record = Record::arc(600, 3);
    record.y[200..204].fill(f64::NAN);
    record.y[400..430].fill(f64::NAN);
    for method in METHODS {
        let judged = record.judge(*method, &defaults(*method));
        assert_eq!(judged.verdict.len(), 566, "{}", id(*method));
    }
}

/// Share of clean white noise that a method may flag at its defaults, in percent of 20,000 samples: about 1.5
/// times what its test gives on Gaussian noise (0.27 % at 3 sigma one-sided once, more where scales are local).
fn false_alarm_bound(id: &str) -> f64 {
    match id {
        // alpha is per sample for Romanovsky; small windows have noisy scales.
        "romanovsky" => 2.5,
        "odd-even" | "wright" | "trend-wright" => 0.5,
        "chauvenet" | "grubbs" | "gesd" => 0.05,
        "two-sided" => 0.05,
        _ => 1.0,
    }
}

#[test]
fn clean_noise_stays_clean_and_one_spike_is_found() {
    let clean = Record::flat(20_000, 11);
    for method in METHODS {
        let settings = defaults(*method);
        let before = outliers(&clean.judge(*method, &settings));
        let share = 100.0 * before.len() as f64 / 20_000.0;
        println!("{:18} {share:.3} % of clean noise", id(*method));
        assert!(share <= false_alarm_bound(id(*method)), "{}: {share} % false alarms", id(*method));
        let mut spiked = clean.clone();
        spiked.y[10_000] = 25.0;
        let after = outliers(&spiked.judge(*method, &settings));
        assert!(after.contains(&10_000), "{} misses a spike of 20 sigma", id(*method));
        let share = 100.0 * (after.len() - 1) as f64 / 20_000.0;
        assert!(share <= false_alarm_bound(id(*method)), "{}: {share} % besides the spike", id(*method));
    }
}

#[test]
fn the_same_record_gives_the_same_bits_on_any_number_of_threads() {
    let mut record = Record::arc(5000, 5);
    (0..5000).step_by(37).for_each(|i| record.y[i] += 30.0);
    (0..8).for_each(|k| (k * 600..5000).for_each(|i| record.t[i] += 5.0));
    for method in METHODS {
        for settings in presets(*method) {
            let on = |threads: usize| {
                let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("a pool");
                pool.install(|| bits(&record.judge(*method, &settings)))
            };
            assert!(on(1) == on(4) && on(4) == on(4), "{}", id(*method));
        }
    }
}

/// A record with spikes, a patch and a gap.
fn eventful(seed: u64) -> Record {
    let mut record = Record::arc(1500, seed);
    for (i, spike) in [(300, 15.0), (450, -22.0), (700, 40.0), (701, 42.0), (702, 41.0), (1100, 9.0)] {
        record.y[i] += spike;
    }
    (900..1500).for_each(|i| record.t[i] += 0.5);
    record
}

#[test]
fn offsets_of_times_and_values_change_no_flag() {
    let record = eventful(7);
    let mut late = record.clone();
    // Times as a file has them: decimal text, rounded once.
    late.t.iter_mut().for_each(|t| *t = ((*t * 10.0).round() + 1.7e10) / 10.0);
    let mut high = record.clone();
    high.y.iter_mut().for_each(|y| *y += 1e9);
    for method in METHODS {
        let settings = defaults(*method);
        let flags = record.judge(*method, &settings).verdict;
        assert!(late.judge(*method, &settings).verdict == flags, "{}: a time offset of 1.7e9", id(*method));
        assert!(high.judge(*method, &settings).verdict == flags, "{}: a value offset of 1e9", id(*method));
    }
}

#[test]
fn other_units_change_no_flag() {
    let record = eventful(8);
    let mut scaled = record.clone();
    // A power of two is exact, so that every comparison comes out the same to the last bit.
    scaled.y.iter_mut().for_each(|y| *y *= 1024.0);
    scaled.rate.iter_mut().for_each(|y| *y *= 1024.0);
    for method in METHODS {
        let settings = defaults(*method);
        let flags = record.judge(*method, &settings).verdict;
        assert!(scaled.judge(*method, &settings).verdict == flags, "{}", id(*method));
    }
}

#[test]
fn a_tenth_of_outliers_does_not_break_the_robust_methods() {
    let mut record = Record::arc(5000, 9);
    let mut random = Random::new(10);
    let mut wild = Vec::new();
    for i in (20..4980).step_by(10) {
        record.y[i] += random.sign() * random.between(15.0, 60.0);
        wild.push(i);
    }
    for robust in ["median-window", "hampel", "two-sided", "trend-wright", "gesd", "five-point", "kalman", "matched"] {
        let method = wildpoint::method::find(robust).expect("a registered method");
        let found = outliers(&record.judge(method, &defaults(method)));
        let hits = wild.iter().filter(|i| found.binary_search(i).is_ok()).count();
        let false_alarms = found.len() - hits;
        println!("{robust:14} {hits} of {}, {false_alarms} false", wild.len());
        assert!(hits * 100 >= wild.len() * 95, "{robust} finds {hits} of {}", wild.len());
        assert!(false_alarms * 100 <= 5000, "{robust}: {false_alarms} false alarms");
    }
}

#[test]
fn a_step_is_a_suspect_for_two_sided_and_never_removed() {
    let mut record = Record::flat(1000, 12);
    (500..1000).for_each(|i| record.y[i] += 60.0);
    let method = wildpoint::method::find("two-sided").expect("a registered method");
    let judged = record.judge(method, &defaults(method));
    assert!(outliers(&judged).is_empty(), "{:?}", outliers(&judged));
    let suspects: Vec<usize> = (0..1000).filter(|&i| judged.verdict[i] == Verdict::Suspect).collect();
    assert!(suspects.iter().any(|i| (485..=515).contains(i)), "a step leaves a trace: {suspects:?}");
}

#[test]
fn reversing_the_record_swaps_the_directions_of_two_sided() {
    let record = eventful(13);
    let mut reversed = record.clone();
    reversed.y.reverse();
    let end = record.t[record.t.len() - 1];
    reversed.t = record.t.iter().rev().map(|t| end - t).collect();
    let method = wildpoint::method::find("two-sided").expect("a registered method");
    let (a, b) = (record.judge(method, &defaults(method)), reversed.judge(method, &defaults(method)));
    let mut directions = b.directions.clone();
    directions.reverse();
    let swapped = |d: Option<Direction>, e: Option<Direction>| d == e;
    for (i, (x, y)) in a.directions.iter().zip(&directions).enumerate() {
        assert!(swapped(x.forward, y.backward) && swapped(x.backward, y.forward), "sample {i}: {x:?} {y:?}");
    }
}

#[test]
fn gating_again_is_judging_again() {
    let record = eventful(14);
    for method in METHODS {
        for mut settings in presets(*method) {
            // With a floor for each sample the multiplier does more than gate.
            settings.set_text(id(*method), "floor", "auto").expect("a legal value");
            let Some(key) = method.gate(&settings) else { continue };
            let gated = Gated::new(record.judge(*method, &settings), Some(settings.real(key)));
            for k in [1.7, 3.0, 9.5] {
                settings.set(id(*method), key, Value::Real(k)).expect("a legal multiplier");
                let series = Series::new(&record.t, &record.y);
                let again = record.judge(*method, &settings);
                let turned = gated.regated(&series.y, k, &Stop::never()).expect("nobody stops it").expect("it gates");
                let tolerance: Vec<f64> = (0..series.len()).filter_map(|i| turned.tolerance(i)).collect();
                let verdict = turned.verdict().to_vec();
                let turned = Judged { verdict, tolerance, expected: turned.expected().to_vec(), ..Judged::default() };
                assert!(bits(&turned) == bits(&again), "{} at {k}", id(*method));
            }
        }
    }
}

#[test]
fn every_legal_end_of_every_range_is_survived() {
    let record = eventful(15);
    for method in METHODS {
        for param in method.about().params {
            let ends: Vec<Value> = match param.kind {
                Kind::Whole { min, max, .. } => vec![Value::Whole(min), Value::Whole(max)],
                Kind::WholeOrOff { min, max } => vec![Value::Whole(min), Value::Whole(max), Value::Word("off")],
                Kind::Real { min, max, .. } => vec![Value::Real(min), Value::Real(max)],
                Kind::Choice(words) => words.iter().map(|w| Value::Word(w)).collect(),
                Kind::Switch => vec![Value::Switch(false), Value::Switch(true)],
                Kind::Numbers => vec![Value::Numbers(Numbers::NONE)],
                Kind::Words(list) => vec![Value::Words(Words::all(list))],
                Kind::RealOr { words, min, max } => {
                    let words = words.iter().map(|w| Value::Word(w));
                    words.chain([Value::Real(min), Value::Real(max)]).collect()
                }
            };
            for value in ends {
                for mut settings in presets(*method) {
                    settings.set(id(*method), param.key, value).expect("an end of the range is legal");
                    let judged = record.judge(*method, &settings);
                    assert_eq!(judged.verdict.len(), 1500, "{} {}={value}", id(*method), param.key);
                    let _ = method.warnings(&settings);
                }
            }
        }
    }
}

#[test]
fn nobody_waits_for_a_job_that_was_stopped() {
    use std::sync::Arc;
    use std::sync::atomic::AtomicU64;
    let record = Record::arc(50_000, 16);
    let series = Series::new(&record.t, &record.y);
    let stop = Stop::when_superseded(Arc::new(AtomicU64::new(2)), 1);
    for method in METHODS {
        let rate = Rate { t: &record.t, y: &record.rate };
        let judged = judge_channel(*method, &series, Some(rate), &defaults(*method), &stop);
        assert!(judged.is_err(), "{} went on", id(*method));
    }
}

#[test]
fn what_is_said_of_a_sample_stays_with_it_when_other_segments_cannot_be_judged() {
    // Three samples, a gap, a record with spikes, a gap, two samples: a method may have nothing to say of the ends.
    let whole = eventful(17);
    let mut cut = whole.clone();
    (3..1500).for_each(|i| cut.t[i] += 100.0);
    (1498..1500).for_each(|i| cut.t[i] += 100.0);
    // The middle by itself, on the same times.
    let middle = Record { t: cut.t[3..1498].to_vec(), y: cut.y[3..1498].to_vec(), rate: cut.rate[3..1498].to_vec() };
    for method in METHODS.iter().filter(|m| id(**m) != "matched") {
        for mut settings in presets(*method) {
            // A calibration is of the whole record.
            settings.set_text(id(*method), "floor", "auto").expect("a legal value");
            let (all, alone) = (cut.judge(*method, &settings), middle.judge(*method, &settings));
            let name = id(*method);
            assert!(all.verdict[3..1498] == alone.verdict, "{name}: verdicts");
            for (what, length) in [
                ("scale", all.scale.len()),
                ("directions", all.directions.len()),
                ("codes", all.repair_code.len()),
                ("own", all.own.len()),
            ] {
                assert!(length == 0 || length == 1500, "{name}: {length} {what} of 1500 samples");
            }
            if !alone.directions.is_empty() {
                assert!(all.directions[3..1498] == alone.directions, "{name}: directions");
                assert!(all.repair_code[3..1498] == alone.repair_code, "{name}: codes");
            }
            let same = |a: &[f64], b: &[f64]| a.iter().zip(b).all(|(a, b)| a.to_bits() == b.to_bits());
            assert!(alone.own.is_empty() || same(&all.own[3..1498], &alone.own), "{name}: own repair");
            assert!(alone.scale.is_empty() || same(&all.scale[3..1498], &alone.scale), "{name}: scales");
        }
    }
}
