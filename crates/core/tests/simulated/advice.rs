//! Whether the method that the advice recommends is the best in truth, on simulated records whose wild points are known.
//! It takes minutes, so it runs only when it is asked for:
//!
//! `cargo test --release -p wildpoint-core --test simulated_records -- --ignored --nocapture`

#![expect(clippy::unwrap_used, reason = "a failed expectation is a failed test")]

use rayon::prelude::*;
use wildpoint_core::analysis::{Detection, Input};
use wildpoint_core::detectability::Study;
use wildpoint_core::method::{Verdict, voting};
use wildpoint_core::series::Series;
use wildpoint_core::setup::{Preset, Setup};
use wildpoint_core::stop::Stop;

use super::{KINDS, Kind, Record};

/// Records of each kind.
const RECORDS: u64 = 6;

/// The recommended method counts as good where it reaches this share of the best.
const NEARLY: f64 = 0.95;

/// What every method is worth on a record in truth, and which is recommended.
struct Trial {
    worth: Vec<f64>,
    recommended: usize,
}

fn setups() -> Vec<Setup> {
    voting().filter(|m| !m.about().needs_rate).map(|method| Setup::new(method, Preset::Default)).collect()
}

/// Wild points of which half of the samples are flagged, as a share of all, less 0.1 for each good sample in a hundred that is
/// flagged: what one that is found is worth, a hundredth of false flags costs a tenth of.
fn worth(record: &Record, verdict: &[Verdict]) -> f64 {
    let flagged = |i: &usize| verdict[*i] == Verdict::Outlier;
    let (mut events, mut found, mut falsely, mut good, mut first) = (0_u32, 0_u32, 0_u32, 0_u32, 0);
    for run in record.wild.chunk_by(|a, b| a == b) {
        let places = first..first + run.len();
        first += run.len();
        let flags = places.filter(flagged).count();
        if run[0] {
            events += 1;
            found += u32::from(2 * flags >= run.len());
        } else {
            good += run.len() as u32;
            falsely += flags as u32;
        }
    }
    f64::from(found) / f64::from(events) - 10.0 * f64::from(falsely) / f64::from(good)
}

fn trial(kind: &Kind, seed: u64) -> Trial {
    let (never, record) = (Stop::never(), kind.record(seed));
    let series = Series::new(&record.t, &record.y);
    let of = |setup: &Setup| {
        let detection = Detection::of(Input::new(&series, None), setup, &never).unwrap();
        worth(&record, detection.judged.verdict())
    };
    let mut study = Study::new((&series).into(), setups(), 1, &never).unwrap();
    while study.advance(&never).unwrap() {}
    let advice = study.advice();
    let recommended = advice.recommended.unwrap_or_else(|| panic!("{}: {:?}", kind.name, advice.unsuitable));
    Trial { worth: setups().iter().map(of).collect(), recommended }
}

#[test]
#[ignore = "takes minutes: it studies 84 records"]
#[expect(clippy::print_stdout, reason = "the table is what it is run for")]
fn the_recommended_method_is_nearly_the_best_in_truth() {
    let names: Vec<&str> = setups().iter().map(|s| s.method.about().id).collect();
    let kinds: Vec<&Kind> = KINDS.iter().filter(|kind| kind.share > 0.0).collect();
    let mut good = 0;
    println!("{:24} {:>6}  {:18} {:>6} {:>6}  recommended", "kind", "worth", "best", "worth", "cost");
    for kind in &kinds {
        let trials: Vec<Trial> = (1..=RECORDS).into_par_iter().map(|seed| trial(kind, seed)).collect();
        let mean = |of: &dyn Fn(&Trial) -> f64| trials.iter().map(of).sum::<f64>() / RECORDS as f64;
        let taken = mean(&|t| t.worth[t.recommended]);
        let each: Vec<f64> = (0..names.len()).map(|m| mean(&|t| t.worth[m])).collect();
        let best = (0..names.len()).max_by(|a, b| each[*a].total_cmp(&each[*b])).unwrap();
        good += usize::from(taken >= NEARLY * each[best]);
        let mut recommended: Vec<&str> = trials.iter().map(|t| names[t.recommended]).collect();
        recommended.sort_unstable();
        recommended.dedup();
        let (name, cost, of) = (kind.name, each[best] - taken, recommended.join(", "));
        println!("{name:24} {taken:6.3}  {:18} {:6.3} {cost:6.3}  {of}", names[best], each[best]);
    }
    println!("the best or within 5 % of it: {good} of {} kinds", kinds.len());
    assert!(10 * good >= 8 * kinds.len(), "{good} of {} kinds", kinds.len());
}
