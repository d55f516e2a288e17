//! Results that were stepped to against results from nothing.

use super::*;
use crate::review::{Decision, Decisions, Signature};
use crate::session::{Preset, Setup, detect, method_of_id, settle};
use crate::stop::Stop;
use crate::track::{LoadOptions, Samples, Source, Track, load};
use proptest::prelude::*;

/// A slow wave with these disturbances; every seventh of the large ones is a missing cell, and time jumps once.
fn track(disturbances: &[f64]) -> Track {
    let mut text = String::from("t,x\n");
    for (i, d) in disturbances.iter().enumerate() {
        let t = i + if i > 300 { 40 } else { 0 };
        let cell = if i % 7 == 3 && *d > 5.0 { String::new() } else { ((i as f64 * 0.05).sin() + d).to_string() };
        text.push_str(&format!("{t},{cell}\n"));
    }
    let source = Source::BuiltIn { name: "wildpoint:test", bytes: text.into_bytes().into() };
    load(&source, &LoadOptions::default()).unwrap()
}

/// All that a frame is drawn from, exactly.
fn all(drawn: &Drawn) -> [String; 4] {
    let o = &drawn.outcome;
    let tolerance: Vec<_> = (0..drawn.hidden.len()).map(|i| o.detection.judged.tolerance(i)).collect();
    [
        format!("{:?}", (&o.marks, &o.outliers, &o.fixes, &o.runs, &o.fills, &o.counts)),
        format!("{:?}", (o.detection.judged.verdict(), o.detection.judged.expected(), tolerance)),
        format!("{:?} {:?}", drawn.histogram, (&drawn.hidden, drawn.threshold, &drawn.positions, &drawn.arranged)),
        format!("{:?}", [&drawn.kept, &drawn.ratios, &drawn.expected, &drawn.band, &drawn.repaired, &drawn.after]),
    ]
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(40))]
    /// However a result was stepped to, it is the one from nothing.
    #[test]
    fn a_stepped_result_is_a_fresh_one(
        disturbances in proptest::collection::vec(prop_oneof![6 => -0.1..0.1, 1 => -20.0..20.0], 100..700),
        steps in proptest::collection::vec(
            (prop_oneof![Just("k"), Just("window"), Just("method"), Just("decide")], 0..40_u32), 1..7),
        id in prop_oneof![Just("hampel"), Just("median-window"), Just("two-sided")],
    ) {
        let track = track(&disturbances);
        let channel = &track.channels[0];
        let samples = Samples::of(channel, &track.time);
        let series = samples.series(channel, &track.time);
        let mut setup = Setup::new(method_of_id(id).unwrap(), Preset::Default);
        let mut decisions = Decisions::default();
        let result = |setup: &Setup, decisions: &Decisions, before: Option<&Drawn>| {
            let previous = before.map(|d| d.outcome.detection.as_ref());
            let detection = detect(&track, channel, &samples, setup, previous, &Stop::never()).unwrap();
            let outcome = settle(&track, channel, &samples, detection.into(), decisions, &Stop::never()).unwrap();
            Drawn::new(outcome, &series, before, &Stop::never()).unwrap()
        };
        let mut drawn = result(&setup, &decisions, None);
        for (what, amount) in steps {
            match what {
                "k" => setup.set_text("k", &(0.5 + f64::from(amount) * 0.25).to_string()).unwrap(),
                "window" if id != "two-sided" => setup.set_text("window", &(5 + 2 * (amount % 9)).to_string()).unwrap(),
                "decide" => {
                    let ruling = if amount % 2 == 0 { Ruling::Outlier } else { Ruling::Normal };
                    decisions.set(amount * 2, Some(Decision { ruling, note: String::new(), said: None, signature: Signature::default() }));
                }
                _ => {
                    let repairs = ["own", "linear", "polynomial", "remove"];
                    setup.repair.set_text("repair", "method", repairs[amount as usize % 4]).unwrap();
                }
            }
            drawn = result(&setup, &decisions, Some(&drawn));
            prop_assert_eq!(all(&drawn), all(&result(&setup, &decisions, None)));
        }
    }
}
