//! What predictors, two-sided test and Kalman filter do on small records whose truth is known.

#![expect(clippy::expect_used, reason = "a test that cannot set itself up should fail")]

use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};

use wildpoint::method::kalman::judge_joint;
use wildpoint::method::{Damaged, Direction, Judged, METHODS, Method, Rate, Segment, Verdict, Way, find, noise};
use wildpoint::param::Settings;
use wildpoint::stop::{Stop, Stopped};
use wildpoint::track::Series;

const MINE: [&str; 6] = ["five-point", "alpha-beta-gamma", "adaptive", "matched", "two-sided", "kalman"];

fn method(id: &str) -> &'static dyn Method {
    find(id).expect("a registered method")
}

fn settings(id: &str, changes: &[(&str, &str)]) -> Settings {
    let mut settings = Settings::defaults(method(id).about().params);
    // What the methods page says of a model is about one scale for all samples.
    settings.set_text(id, "floor", "auto").expect("a legal value");
    for (key, text) in changes {
        settings.set_text(id, key, text).expect("a legal value");
    }
    settings
}

/// Noise of deviation 1 in steps of 2^-10, so that large offsets do not round it: the sum of twelve uniform values
/// from a multiplicative hash.
fn noise_at(i: usize) -> f64 {
    let uniform = |k: u64| {
        let x = (i as u64 * 12 + k + 1).wrapping_mul(0x9E37_79B9_7F4A_7C15);
        ((x ^ (x >> 31)).wrapping_mul(0xBF58_476D_1CE4_E5B9) >> 40) as f64 / f64::from(1 << 24)
    };
    (((0..12).map(uniform).sum::<f64>() - 6.0) * 1024.0).round() / 1024.0
}

/// A parabola with noise of 1 at even steps of 1/8 s, and the rate.
struct Record {
    t: Vec<f64>,
    truth: Vec<f64>,
    y: Vec<f64>,
    rate: Vec<f64>,
}

fn record(n: usize) -> Record {
    let t: Vec<f64> = (0..n).map(|i| i as f64 * 0.125).collect();
    let truth: Vec<f64> = t.iter().map(|t| 0.5 * t * t - 4.0 * t).collect();
    let y = truth.iter().enumerate().map(|(i, y)| y + noise_at(i)).collect();
    let rate = t.iter().map(|t| t - 4.0).collect();
    Record { t, truth, y, rate }
}

impl Record {
    fn with(mut self, at: impl IntoIterator<Item = usize>, by: f64) -> Self {
        at.into_iter().for_each(|i| self.y[i] += by);
        self
    }

    fn segment(&self) -> Segment<'_> {
        let rate = Some(Rate { t: &self.t, y: &self.rate });
        Segment { t: &self.t, y: &self.y, interval: 0.125, sigma: 1.0, floor: 0.0, floors: &[], objections: &[], rate }
    }

    fn judged(&self, id: &str, changes: &[(&str, &str)]) -> Judged {
        method(id).judge(&self.segment(), &settings(id, changes), &Stop::never()).expect("nobody stops it")
    }

    fn repaired(&self, id: &str, changes: &[(&str, &str)], outliers: &[usize]) -> Vec<f64> {
        let judged = self.judged(id, changes);
        let judged = judged.part(0..self.y.len());
        let (segment, settings) = (&self.segment(), &settings(id, changes));
        let damaged = Damaged { segment, settings, judged, outliers };
        method(id).own_repair(&damaged, &Stop::never()).expect("nobody stops it")
    }
}

fn positions(judged: &Judged, verdict: Verdict) -> Vec<usize> {
    (0..judged.verdict.len()).filter(|&i| judged.verdict[i] == verdict).collect()
}

/// Spikes and a patch that every method of this part finds.
fn spiked() -> Record {
    record(400).with([50, 130, 390], 30.0).with(200..204, -40.0)
}

const SPIKES: [usize; 7] = [50, 130, 200, 201, 202, 203, 390];

#[test]
fn large_spikes_and_a_short_patch_are_found_by_all() {
    for id in MINE {
        let judged = spiked().judged(id, &if id == "kalman" { [("c", "6")] } else { [("k", "6")] });
        assert_eq!(positions(&judged, Verdict::Outlier), SPIKES, "{id}");
    }
}

#[test]
fn offsets_of_times_and_values_change_no_verdict() {
    let plain = spiked();
    for id in MINE {
        let here = plain.judged(id, &[]);
        let far = Record {
            t: plain.t.iter().map(|t| t + 1.7e9).collect(),
            y: plain.y.iter().map(|y| y + 1e9).collect(),
            truth: Vec::new(),
            rate: plain.rate.clone(),
        };
        assert_eq!(far.judged(id, &[]).verdict, here.verdict, "{id}");
    }
}

#[test]
fn the_number_of_threads_changes_no_bit() {
    let record = spiked();
    let bits = |judged: Judged| -> (Vec<Verdict>, Vec<u64>) {
        let numbers = judged.expected.iter().chain(&judged.tolerance).chain(&judged.own);
        (judged.verdict.clone(), numbers.map(|x| x.to_bits()).collect())
    };
    for id in MINE {
        let with = |threads: usize| {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("a pool");
            pool.install(|| bits(record.judged(id, &[])))
        };
        assert_eq!(with(1), with(4), "{id}");
    }
}

#[test]
fn superseded_work_stops() {
    let newest = Arc::new(AtomicU64::new(1));
    let stop = Stop::when_superseded(Arc::clone(&newest), 1);
    newest.store(2, Ordering::Relaxed);
    let record = record(100);
    for id in MINE {
        let got = method(id).judge(&record.segment(), &settings(id, &[]), &stop);
        assert_eq!(got, Err(Stopped), "{id}");
    }
}

#[test]
fn without_noise_nothing_starts_unless_the_tolerance_is_given() {
    let record = record(100);
    let exact = Segment { y: &record.truth, sigma: 0.0, ..record.segment() };
    for id in MINE.into_iter().filter(|id| *id != "matched") {
        let judged = method(id).judge(&exact, &settings(id, &[]), &Stop::never()).expect("nobody stops it");
        assert_eq!(positions(&judged, Verdict::Unchecked).len(), 100, "{id}");
    }
    let given = settings("two-sided", &[("delta", "0.5")]);
    let judged = method("two-sided").judge(&exact, &given, &Stop::never()).expect("nobody stops it");
    assert_eq!(positions(&judged, Verdict::Normal).len(), 100);
}

#[test]
fn segments_of_a_few_samples_are_unchecked_and_do_no_harm() {
    for id in MINE {
        for n in 1..8 {
            let record = record(n);
            let judged = record.judged(id, &[]);
            assert_eq!((judged.verdict.len(), judged.expected.len(), judged.tolerance.len()), (n, n, n), "{id}");
            let all: Vec<usize> = (0..n).collect();
            assert_eq!(record.repaired(id, &[], &all).len(), n, "{id}");
        }
    }
}

#[test]
fn a_change_faster_than_max_rate_is_an_outlier_whatever_the_tolerance() {
    let mut record = record(100);
    record.y.clone_from(&record.truth);
    let record = record.with([60], 5.0);
    let loose = [("k", "100")];
    assert!(positions(&record.judged("five-point", &loose), Verdict::Outlier).is_empty());
    // 5 units in 1/8 s are 40 per second, to which the track adds 3.4; elsewhere it makes 8.4 at most.
    let strict = record.judged("five-point", &[("k", "100"), ("max_rate", "38")]);
    assert_eq!(positions(&strict, Verdict::Outlier), [60]);
}

#[test]
fn a_step_is_suspect_and_listed_and_nothing_is_removed() {
    let record = record(200).with(100..200, 60.0);
    let judged = record.judged("two-sided", &[]);
    assert!(positions(&judged, Verdict::Outlier).is_empty());
    // Backwards the last sample before the step is the first that disagrees.
    assert_eq!(positions(&judged, Verdict::Suspect), [99, 100]);
    let restarts: Vec<(usize, Way)> = judged.restarts.iter().map(|r| (r.at, r.way)).collect();
    assert_eq!(restarts, [(100, Way::Forward), (99, Way::Backward)]);
    let five = record.judged("five-point", &[("look_back", "false")]);
    assert_eq!(five.verdict[100], Verdict::Suspect);
    assert_eq!(five.restarts.iter().map(|r| r.at).collect::<Vec<_>>(), [100]);
}

#[test]
fn a_patch_of_max_run_is_found_and_a_longer_one_is_taken_for_a_change() {
    for (length, found) in [(10, 10), (11, 0)] {
        let record = record(200).with(100..100 + length, 60.0);
        let judged = record.judged("two-sided", &[("max_run", "10")]);
        assert_eq!(positions(&judged, Verdict::Outlier).len(), found, "{length}");
        assert_eq!(judged.restarts.is_empty(), found > 0, "{length}");
    }
}

#[test]
fn one_direction_judges_alone() {
    let record = record(200).with([80], 30.0).with([0, 199], 30.0);
    let forward = record.judged("two-sided", &[("direction", "forward")]);
    assert_eq!(positions(&forward, Verdict::Outlier), [80, 199]);
    assert_eq!(positions(&forward, Verdict::Unchecked), [0]);
    assert!(forward.directions.iter().all(|d| d.backward.is_none()));
    let both = record.judged("two-sided", &[]);
    assert_eq!(positions(&both, Verdict::Outlier), [0, 80, 199]);
    assert_eq!(both.directions[0].forward, Some(Direction::Unjudged));
    assert_eq!(both.directions[0].backward, Some(Direction::Abnormal));
}

#[test]
fn the_two_sided_test_is_the_same_on_the_mirrored_record() {
    let record = spiked();
    let judged = record.judged("two-sided", &[]);
    let mirrored = Record {
        t: record.t.iter().rev().map(|t| -t).collect(),
        y: record.y.iter().rev().copied().collect(),
        truth: Vec::new(),
        rate: record.rate.clone(),
    };
    let mut back = mirrored.judged("two-sided", &[]).verdict;
    back.reverse();
    assert_eq!(back, judged.verdict);
}

#[test]
fn the_best_repair_follows_the_track_also_where_only_the_analyst_objects() {
    let record = spiked();
    let outliers = [50, 130, 200, 201, 202, 203, 300, 301, 390, 399];
    let repaired = record.repaired("two-sided", &[], &outliers);
    for (&i, value) in outliers.iter().zip(&repaired).take(9) {
        // 2 * 16 samples around: well under one noise scale.
        assert!((value - record.truth[i]).abs() < 0.9, "{i}: {value}, truth {}", record.truth[i]);
    }
    assert!(repaired[9].is_nan(), "no accepted sample after the last");
    assert!(record.repaired("two-sided", &[], &[3])[0].is_nan(), "fewer than 8 accepted samples before");
}

#[test]
fn the_matched_repair_wants_both_directions_to_agree() {
    let record = spiked();
    let matched = [("repair_rule", "matched")];
    let judged = record.judged("two-sided", &matched);
    let repaired = record.repaired("two-sided", &matched, &SPIKES);
    let runs = [(50, 50), (130, 130), (200, 203), (390, 390)];
    let mut at = 0;
    for (first, last) in runs {
        let agree = judged.repair_code[last][0] == judged.repair_code[first][1];
        for value in &repaired[at..at + last - first + 1] {
            // 390: 9 samples are left, enough for the line on 8 only.
            let room = first != 390 || judged.repair_code[first][1] == 1;
            assert_eq!(value.is_finite(), agree && room, "run {first}..{last}");
        }
        at += last - first + 1;
    }
    let by_analyst = record.repaired("two-sided", &matched, &[300]);
    assert!(by_analyst[0].is_nan(), "no direction remembers a candidate there");
    let one_way = [("repair_rule", "matched"), ("direction", "forward")];
    assert!(record.repaired("two-sided", &one_way, &SPIKES).iter().all(|v| v.is_nan()));
}

#[test]
fn predictors_repair_with_the_expected_value() {
    let record = spiked();
    let printed = [("repair_rule", "expected")];
    for (id, keys) in [("five-point", &[][..]), ("alpha-beta-gamma", &[]), ("adaptive", &[]), ("matched", &printed)] {
        let judged = record.judged(id, keys);
        assert_eq!(record.repaired(id, keys, &[50, 300]), [judged.expected[50], judged.expected[300]], "{id}");
    }
}

#[test]
fn the_filter_fills_a_patch_and_removes_what_it_cannot_fill() {
    let record = record(300).with(100..106, 40.0).with(297..300, 40.0);
    let judged = record.judged("kalman", &[("c", "5")]);
    let outliers = positions(&judged, Verdict::Outlier);
    assert_eq!(outliers, [100, 101, 102, 103, 104, 105, 297, 298, 299]);
    let repaired = record.repaired("kalman", &[("c", "5")], &outliers);
    for (&i, value) in outliers.iter().zip(&repaired).take(6) {
        assert!((value - record.truth[i]).abs() < 1.5, "{i}: {value}, truth {}", record.truth[i]);
    }
    assert!(repaired[6..].iter().all(|v| v.is_nan()), "a run that ends the segment is removed");
    let changed = record.repaired("kalman", &[("c", "5")], &[99, 100, 101, 102, 103, 104, 105]);
    assert!((changed[0] - record.truth[99]).abs() < 1.5, "a run that the analyst made longer is filled anew");
}

fn together(channels: &[&Series<'_>], settings: &Settings) -> Vec<Judged> {
    let found = judge_joint(channels, settings, &Stop::never()).expect("nobody stops it");
    found.into_iter().map(|part| part.judged).collect()
}

#[test]
fn joint_channels_are_flagged_together_where_they_are_present() {
    let a = record(200).with([80, 120], 30.0);
    let mut b = record(200);
    b.y.iter_mut().enumerate().for_each(|(i, y)| *y = 2.0 * noise_at(i + 5000));
    b.y[120] = f64::NAN;
    let (one, two) = (Series::new(&a.t, &a.y), Series::new(&b.t, &b.y));
    let joint = settings("kalman", &[("test", "joint"), ("alpha", "1e-6")]);
    let judged = together(&[&one, &two], &joint);
    assert_eq!(positions(&judged[0], Verdict::Outlier), [80, 120]);
    assert_eq!((judged[1].verdict.len(), positions(&judged[1], Verdict::Outlier)), (199, vec![80]));
    // By itself the second channel has nothing wrong at 80.
    let alone = together(&[&two], &joint);
    assert!(positions(&alone[0], Verdict::Outlier).is_empty());
}

/// A record with a single spike, a patch to be filled in, and a leap after which the model is lost.
fn troubled() -> Record {
    let mut record = record(300).with([60, 101, 102, 103], 30.0);
    record.y[200..].iter_mut().for_each(|y| *y += 500.0);
    record
}

fn same(a: &[f64], b: &[f64]) -> bool {
    let near = |(a, b): (&f64, &f64)| (a - b).abs() < 1e-9 || (a.is_nan() && b.is_nan());
    a.len() == b.len() && a.iter().zip(b).all(near)
}

#[test]
fn one_channel_jointly_is_the_single_test_with_the_gate_of_chi_square() {
    let record = troubled();
    let series = Series::new(&record.t, &record.y);
    let joint = settings("kalman", &[("test", "joint")]);
    let several = together(&[&series], &joint);
    let cuts = series.segments(Some(5));
    let scales = noise::scales(&series, &cuts, &joint, &Stop::never()).expect("nobody stops it");
    let segment = Segment::of(&series, &cuts[0], &scales[0], None);
    let single = method("kalman").judge(&segment, &joint, &Stop::never()).expect("nobody stops it");
    assert!([60, 101, 102, 103].iter().all(|&i| single.verdict[i] == Verdict::Outlier), "{:?}", single.verdict);
    assert!(!single.restarts.is_empty() && single.own.iter().any(|own| own.is_finite()));
    assert_eq!((&several[0].verdict, &several[0].restarts), (&single.verdict, &single.restarts));
    for (a, b) in [
        (&several[0].expected, &single.expected),
        (&several[0].tolerance, &single.tolerance),
        (&several[0].own, &single.own),
    ] {
        assert!(same(a, b), "{a:?}\n{b:?}");
    }
}

/// A channel that lacks some samples is told of the same moments as the one that has them all.
#[test]
fn a_joint_restart_has_the_place_of_its_sample_in_each_channel() {
    let (whole, mut part) = (troubled(), troubled());
    let lacking = [20, 21, 150];
    lacking.iter().for_each(|&i| part.y[i] = f64::NAN);
    let (one, two) = (Series::new(&whole.t, &whole.y), Series::new(&part.t, &part.y));
    let judged = together(&[&one, &two], &settings("kalman", &[("test", "joint")]));
    assert!(!judged[0].restarts.is_empty() && judged[0].restarts.iter().all(|r| r.at > 150));
    let moved: Vec<usize> = judged[0].restarts.iter().map(|r| r.at - lacking.len()).collect();
    assert_eq!(judged[1].restarts.iter().map(|r| r.at).collect::<Vec<_>>(), moved);
    let kept = |values: &[f64]| {
        let own = values.iter().enumerate().filter(|(i, _)| !lacking.contains(i)).map(|(_, v)| *v);
        own.collect::<Vec<f64>>()
    };
    // Both measure the same: from a while after what one of them lacks on, the same is expected of them.
    let late = |values: &[f64]| values[220..].to_vec();
    assert!(same(&late(&kept(&judged[0].expected)), &late(&judged[1].expected)));
    assert_eq!(judged[1].own.len(), 297);
}

#[test]
fn every_knob_of_this_part_is_read() {
    // A parameter that is declared and never read, or read under another kind, would show here.
    for method in METHODS.iter().filter(|m| MINE.contains(&m.about().id)) {
        let record = record(60);
        for base in [Settings::defaults(method.about().params), Settings::paper(method.about().params)] {
            for (param, value) in base.iter() {
                for steps in [-3, 1, 3] {
                    let mut changed = base.clone();
                    let id = method.about().id;
                    changed.set(id, param.key, param.step(value, steps)).expect("a step stays legal");
                    let judged = method.judge(&record.segment(), &changed, &Stop::never()).expect("nobody stops it");
                    assert_eq!(judged.verdict.len(), 60, "{id} {} {steps}", param.key);
                    assert!(method.warnings(&changed).iter().all(|line| !line.is_empty()));
                }
            }
        }
    }
}

/// The whole path: two channels with the same joint settings are one group in a session.
#[test]
fn a_session_judges_the_channels_that_share_joint_settings_together() {
    use wildpoint::session::{Analysed, Preset, Session, Setup};
    use wildpoint::track::{LoadOptions, Source, load};
    let mut text = String::from("t_s,a_m,b_m\n");
    for i in 0..200 {
        let spike = if i == 80 { 30.0 } else { 0.0 };
        text.push_str(&format!("{i},{:.6},{:.6}\n", noise_at(i) + spike, 2.0 * noise_at(i + 5000)));
    }
    let source = Source::BuiltIn { name: "test", bytes: text.into_bytes().into() };
    let track = load(&source, &LoadOptions::default()).expect("it loads");
    let mut setup = Setup::new(method("kalman"), Preset::Default);
    let flagged = |setup: &Setup| {
        let session = Session::new(&track, LoadOptions::default(), setup);
        let analysed = Analysed::of(&session, &track, &Stop::never()).expect("it runs");
        analysed.channels.iter().map(|(_, _, o)| o.outliers.contains(&80)).collect::<Vec<_>>()
    };
    setup.set_text("alpha", "1e-6").expect("a legal value");
    assert_eq!(flagged(&setup), [true, false], "each by itself");
    setup.set_text("test", "joint").expect("a legal value");
    assert_eq!(flagged(&setup), [true, true], "together");
}
