//! What of a result should be looked at before it is trusted.

use std::ops::Range;

use super::{Counts, Detection};
use crate::calibration::HOLDS;
use crate::method::shared::{FLOOR, MAX_GAP};
use crate::method::{Verdict, noise};

/// More than one sample in this many flagged, or not judged, is worth a word.
const SHARE: usize = 20;

/// More flags than wild points explain, more samples without a judgement than go without saying. A line each.
pub(super) fn doubts(detection: &Detection, counts: &Counts) -> Vec<String> {
    many_flagged(detection, counts).into_iter().chain(many_unchecked(detection, counts)).collect()
}

fn many_flagged(detection: &Detection, counts: &Counts) -> Option<String> {
    let (flagged, judged) = (counts.flagged - counts.by_checks, counts.present - counts.unchecked);
    if flagged * SHARE <= judged {
        return None;
    }
    let settings = &detection.setup.settings;
    let has_floor = settings.params().iter().any(|p| p.key == FLOOR.key);
    let cause = match detection.calibration.as_deref() {
        _ if has_floor && !noise::by_calibration(settings) => {
            "the scale assumes white noise on a smooth track; floor = noise measures it instead"
        }
        Some(found) if found.held >= HOLDS => {
            "the record holds values and then jumps, and the jumps may not be outliers: look at the longest runs"
        }
        _ => "a large part is outliers, or the channel moves faster than it is sampled: look at the longest runs",
    };
    Some(format!("{} % are flagged: {cause}", percent(flagged, judged)))
}

fn many_unchecked(detection: &Detection, counts: &Counts) -> Option<String> {
    if counts.unchecked * SHARE <= counts.present {
        return None;
    }
    let verdict = detection.judged.verdict();
    let unjudged = |range: &&Range<usize>| verdict[(*range).clone()].iter().all(|v| *v == Verdict::Unchecked);
    let short: usize = detection.segments.iter().filter(unjudged).map(ExactSizeIterator::len).sum();
    let limit = detection.setup.settings.get(MAX_GAP.key);
    let why = match limit.filter(|_| detection.segments.len() > 1 && 2 * short > counts.unchecked) {
        Some(limit) => {
            format!("stretches between gaps are too short for this method; max_gap above {limit} joins them")
        }
        None => "too few neighbours for this method; another one, or a shorter window, may judge them".to_owned(),
    };
    Some(format!("{} % are not judged: {why}", percent(counts.unchecked, counts.present)))
}

/// A share in per cent, as people write it.
#[expect(clippy::cast_precision_loss, reason = "counts are far below 2^53")]
fn percent(part: usize, whole: usize) -> String {
    format!("{:.0}", 100.0 * part as f64 / whole.max(1) as f64)
}
