//! How soon work notices that nobody waits for it: what matters is how much it does between two looks.

#![expect(clippy::expect_used, reason = "a test that cannot read its own data may say so by ending")]

use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};
use std::time::{Duration, Instant};

use wildpoint::error::Error;
use wildpoint::method::{METHODS, Method, Rate, judge_segments, noise, segments};
use wildpoint::param::Settings;
use wildpoint::plot::Drawn;
use wildpoint::repair::{REPAIRS, Way};
use wildpoint::review::Decisions;
use wildpoint::session::{Ballot, Detection, Preset, Setup, detect, method_of_id, settle};
use wildpoint::stop::{Stop, Stopped};
use wildpoint::track::{LoadOptions, Samples, Series, Source, Track, Wanted, load, load_while};

#[path = "../benches/record/mod.rs"]
mod record;

use record::Record;

/// Samples in a piece of work: a pass over a record looks before each.
const PIECE: usize = 16_384;

/// Enough pieces that what is looked at besides counts for nothing.
const N: usize = 8 * PIECE;

const PLENTY: u64 = 1 << 40;

/// How often `work` looks. It must end at whichever look says that it is no longer wanted, too.
fn looks<T>(name: &str, work: impl Fn(&Stop) -> Result<T, Stopped>) -> u64 {
    let left = Arc::new(AtomicU64::new(PLENTY));
    assert!(work(&Stop::after_looks(Arc::clone(&left))).is_ok(), "{name}");
    let looks = PLENTY - left.load(Ordering::Relaxed);
    for share in [0, 1, 2, 3] {
        let left = Arc::new(AtomicU64::new(looks * share / 4));
        assert!(work(&Stop::after_looks(left)).is_err(), "{name}: {share}/4 of {looks}");
    }
    looks
}

/// How many times `work` goes over all samples, by its looks; at least `passes`.
fn goes_over(name: &str, passes: u64, work: impl Fn(&Stop) -> Result<(), Stopped>) {
    let seen = looks(name, work) / (N / PIECE) as u64;
    assert!(seen >= passes, "{name}: looks in {seen} passes over the samples, and makes {passes}");
}

/// Judges with scales that are known.
fn judge(record: &Record, method: &dyn Method, stop: &Stop) -> Result<(), Stopped> {
    let settings = Settings::defaults(method.about().params);
    let series = Series::new(&record.t, &record.y);
    let whole = 0..series.len();
    let scales = [noise::Scales { sigma: 1.0, floor: 0.0, floors: None, objections: None }];
    let rate = Rate { t: &record.t, y: &record.rate };
    judge_segments(method, &series, (std::slice::from_ref(&whole), &scales), Some(rate), &settings, stop).map(|_| ())
}

/// Passes that each method makes over this record, by its looks: a stretch that looks no more takes one or more off. A
/// number that falls is a pass that does not look, or one that is no longer made: find out which. What the passes are
/// is said where it can be counted; criteria go on until nothing is new, and a trend of order 2 is fitted in three. The
/// blocks of the predictors are much shorter than a piece, so of theirs only the runs are counted.
const PASSES: [(&str, u64); 20] = [
    // The bound on zero and positions; fit, residuals, moments 2, flags, what is out and 3 lists without it, again and
    // again; trend, mean, tolerances, verdicts, bounds.
    ("wright", 70),
    ("trend-wright", 114),
    ("chauvenet", 94),
    ("romanovsky", 108),
    ("grubbs", 85),
    ("gesd", 94),
    ("odd-even", 135),
    // Slopes 2, rises, their sum, what is left, figures 1 to 2, the bound on zero, the pooled floor, the pass itself 4.
    ("mean-window", 15),
    ("median-window", 14),
    // The same without the last four; expected values, scales, infinities and the gate instead.
    ("hampel", 13),
    // Bound on zero, steps 4, level, replaced, nothing said 2, the windows 16, in order 64, level, own.
    ("poly-window", 93),
    // Points, residuals 16, scales 16, the pooled floor, zero, nothing said 2, the pass itself 4, bounds.
    ("template", 42),
    ("five-point", 64),
    ("alpha-beta-gamma", 64),
    ("adaptive", 64),
    // The integral, what is left, the medians 4, back again, differences, center, spread, zero, scales, infinities, gate.
    ("matched", 15),
    // Once: zero, level, nothing. Each of 2 passes: medians 6, differences, steps, sum, drift 2, center, spread, flags.
    ("diff-median", 34),
    // Two runs of 32, and in each nothing said; the nearer, verdicts, codes, tolerances, bounds.
    ("two-sided", 71),
    ("kalman", 128),
    // What all of these but `matched` do, and once for each to count its votes.
    ("consensus", 1320),
];

#[test]
fn every_method_looks_in_every_pass_and_ends_at_the_first_look_that_says_so() {
    let record = Record::new(N, 7);
    for method in METHODS {
        let id = method.about().id;
        let passes = PASSES.iter().find(|p| p.0 == id).map(|p| p.1).expect("a row of the table");
        goes_over(id, passes, |stop| judge(&record, *method, stop));
    }
}

#[test]
fn cuts_and_scales_are_looked_for_in_pieces() {
    let record = Record::new(N, 7);
    let series = Series::new(&record.t, &record.y);
    let whole = 0..series.len();
    let all = std::slice::from_ref(&whole);
    let mut settings = Settings::defaults(METHODS[0].about().params);
    settings.set_text("wright", "floor", "auto").expect("a legal value");
    goes_over("cuts", 1, |stop| segments(&series, &settings, stop).map(|_| ()));
    // The largest value, and the smallest movement.
    goes_over("floor", 2, |stop| noise::auto_floor(&series, all, stop).map(|_| ()));
    // Losses, differences, their median, that of the distances from it, middle and tail; and among what was picked.
    goes_over("differences", 6, |stop| noise::by_difference(&series, all, stop).map(|_| ()));
    // The elimination twice, the mean, the deviation.
    goes_over("spline", 4, |stop| noise::by_spline(&series, all, stop).map(|_| ()));
}

/// A record of one channel.
fn track() -> Track {
    let record = Record::new(N, 7);
    let mut track = load(&Source::demo(), &LoadOptions::default()).expect("the demonstration record");
    track.rows = N;
    track.time.seconds = record.t;
    track.channels.truncate(1);
    track.channels[0].values = record.y;
    track.truth = None;
    track
}

fn detected(
    track: &Track,
    samples: &Samples,
    setup: &Setup,
    before: Option<&Detection>,
    stop: &Stop,
) -> Option<Detection> {
    match detect(track, &track.channels[0], samples, setup, before, stop) {
        Ok(detection) => Some(detection),
        Err(Error::Stopped) => None,
        Err(e) => panic!("{e}"),
    }
}

#[test]
fn what_follows_the_method_looks_too() {
    let track = track();
    let channel = &track.channels[0];
    let samples = Samples::of(channel, &track.time);
    let series = samples.series(channel, &track.time);
    let mut setup = Setup::new(method_of_id("hampel").expect("it is there"), Preset::Default);
    let found = Arc::new(detected(&track, &samples, &setup, None, &Stop::never()).expect("nobody stops it"));
    let mut turned = setup.clone();
    turned.set_text("k", "4.5").expect("a multiplier");
    goes_over("another multiplier", 1, |stop| {
        detected(&track, &samples, &turned, Some(&found), stop).map(|_| ()).ok_or(Stopped)
    });
    for repair in REPAIRS {
        setup.repair.set_text("repair", "method", repair.id).expect("a repair");
        let found = Arc::new(found.with_repair(&setup));
        // Marks and counts; interpolations need all that are accepted, too.
        let passes = if matches!(repair.way, Way::Interpolate(_)) { 3 } else { 2 };
        let settled = |stop: &Stop| settle(&track, channel, &samples, Arc::clone(&found), &Decisions::default(), stop);
        goes_over(repair.id, passes, |stop| settled(stop).map(|_| ()));
        // Kept, expected, band, repaired, after, residuals, and how often they occur; the upper levels make up for three.
        let outcome = settled(&Stop::never()).expect("nobody stops it");
        goes_over("drawing", 10, |stop| Drawn::new(outcome.clone(), &series, None, stop).map(|_| ()));
    }
    let verdicts = found.judged.verdict();
    goes_over("votes", 5, |stop| {
        let mut ballot = Ballot::new(N);
        ballot.add("hampel", verdicts, stop)?;
        ballot.agreed(1, stop).map(|_| ())
    });
}

#[test]
fn a_loader_looks_before_each_wave_and_ends_at_the_first_look_that_says_so() {
    let folder = tempfile::tempdir().expect("a folder");
    // Of the second the last row has a byte that is not UTF-8, and the third is read whole.
    let rows: String = (0..400_000).map(|i| format!("{i}.5,{}.25\n", i % 977)).collect();
    let rows = "t_s,x_m\n".to_owned() + &rows;
    let wide: Vec<u8> = [0xff, 0xfe].into_iter().chain(rows.encode_utf16().flat_map(u16::to_le_bytes)).collect();
    for (name, bytes) in [
        ("plain.csv", rows.as_bytes().to_vec()),
        ("latin.csv", [rows.as_bytes(), b"1e9,\xb0\n"].concat()),
        ("wide.csv", wide),
    ] {
        let path = folder.path().join(name);
        std::fs::write(&path, &bytes).expect("a file");
        let source = Source::File(path);
        let load = |stop: &Stop| {
            let still = || !stop.requested();
            match load_while(&source, &LoadOptions::default(), Wanted::as_long_as(&still)) {
                Ok(track) => {
                    assert!(track.rows >= 400_000, "{name}");
                    Ok(())
                }
                Err(Error::Stopped) => Err(Stopped),
                Err(e) => panic!("{name}: {e}"),
            }
        };
        let waves = 400_000 * 12 / (4 * rayon_threads() * (256 << 10));
        let rows = 400_000 / (1 << 16);
        let seen = looks(name, load);
        assert!(seen >= (waves + rows) as u64, "{name}: {seen} looks");
    }
}

/// Threads that the waves of a loader are made for.
fn rayon_threads() -> usize {
    std::thread::available_parallelism().map_or(1, std::num::NonZero::get)
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
