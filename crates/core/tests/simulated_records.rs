//! The default method on simulated records whose wild points are known: hits and false flags, kind by kind. The bounds
//! are what an analyst is promised; seeds are fixed, so that a change of any figure is a change of the program.

use wildpoint_core::method::{Verdict, find, judge_channel};
use wildpoint_core::param::Settings;
use wildpoint_core::series::Series;
use wildpoint_core::setup::DEFAULT_METHOD;
use wildpoint_core::stop::Stop;

mod simulated;

use simulated::KINDS;

/// Records of each kind.
const RECORDS: u64 = 20;

/// At most this many samples in a hundred are not judged, in a record of two rates too.
const UNCHECKED: f64 = 1.0;

#[test]
#[expect(clippy::print_stdout, reason = "the table, for whoever runs it with --nocapture")]
fn the_default_method_keeps_its_promises_on_every_kind() {
    let method = find(DEFAULT_METHOD).unwrap();
    let settings = Settings::defaults(method.about().params);
    let mut broken = Vec::new();
    println!("{:24} {:>7} {:>7} {:>7} {:>9}", "kind", "found", "seen", "false", "unchecked");
    for kind in KINDS {
        let (mut found, mut seen, mut wild, mut falsely, mut good, mut unchecked) = (0, 0, 0, 0, 0, 0);
        for seed in 1..=RECORDS {
            let record = kind.record(seed);
            let series = Series::new(&record.t, &record.y);
            let judged = judge_channel(method, &series, None, &settings, &Stop::never()).unwrap();
            for (verdict, is_wild) in judged.verdict.iter().zip(&record.wild) {
                let flagged = usize::from(*verdict == Verdict::Outlier);
                if *is_wild {
                    wild += 1;
                    found += flagged;
                    seen += usize::from(matches!(verdict, Verdict::Outlier | Verdict::Suspect));
                } else {
                    good += 1;
                    falsely += flagged;
                }
                unchecked += usize::from(*verdict == Verdict::Unchecked);
            }
        }
        let percent = |part: usize, whole: usize| 100.0 * part as f64 / whole.max(1) as f64;
        let (found, falsely) = (percent(found, wild), percent(falsely, good));
        let (seen, unchecked) = (percent(seen, wild), percent(unchecked, wild + good));
        println!("{:24} {found:7.1} {seen:7.1} {falsely:7.3} {unchecked:9.2}", kind.name);
        if (wild > 0 && found < kind.found) || falsely > kind.falsely || unchecked > UNCHECKED {
            broken.push(format!("{}: {found:.1} % found, {falsely:.3} % false, {unchecked:.1} % unchecked", kind.name));
        }
    }
    assert!(broken.is_empty(), "{}", broken.join("\n"));
}
