//! Odd-even extraction: Wright's criterion within groups of samples that are not neighbours.

use super::trend::{self, AtOnce, Criterion};
use super::{About, Damaged, Filter, Judged, Method, Own, Segment, shared};
use crate::math::pieces;
use crate::param::{Kind, Param, Settings, Value, always};
use crate::stop::{Stop, Stopped};

/// The method `odd-even` of section 2 of `docs/methods.md`.
#[derive(Debug, Clone, Copy)]
pub struct OddEven;

const SPLITS: Param = Param {
    key: "m",
    help: "splits: the samples of a block form 2^m groups; neighbours are in different groups",
    unit: "",
    kind: Kind::Whole { min: 1, max: 8, step: 1 },
    default: Value::Whole(2),
    paper: None,
    matters: always,
};

static PARAMS: [Param; 9] = [
    shared::K,
    SPLITS,
    shared::TREND_ORDER,
    shared::REFIT,
    shared::MAX_PASSES_OPEN,
    shared::BLOCK,
    shared::MAX_GAP,
    shared::FLOOR,
    shared::DOUBT,
];

static ABOUT: About = About {
    id: "odd-even",
    name: "odd-even extraction",
    family: shared::WHOLE_SEGMENT,
    source: "[001] s.2",
    advice: "Splits the samples into 2^m groups, so that a run becomes a few isolated wild points in each, and \
             judges each group by Wright's criterion. For much data with runs and wild points that vary with time, \
             few of them isolated; it gives false alarms. Needs some 20 samples in every group at k = 3.",
    params: &PARAMS,
    own: Own::Remove,
    needs_rate: false,
};

impl Method for OddEven {
    fn about(&self) -> &'static About {
        &ABOUT
    }

    fn judge(&self, segment: &Segment<'_>, settings: &Settings, stop: &Stop) -> Result<Judged, Stopped> {
        trend::judge(&criterion(settings), segment, settings, stop)
    }

    fn filter(&self, settings: &Settings) -> Option<&'static dyn Filter> {
        trend::filter(settings)
    }

    fn warnings(&self, settings: &Settings) -> Vec<String> {
        trend::warnings(&criterion(settings), settings)
    }

    /// The trend at the sample plus the residual of the previous normal sample of its group; where there is none, of
    /// the next one (\[001\]: "the second replaces the first").
    fn own_repair(&self, damaged: &Damaged<'_>, stop: &Stop) -> Result<Vec<f64>, Stopped> {
        let Damaged { segment, settings, judged, outliers } = *damaged;
        let groups = groups(settings);
        let mut normal = vec![true; segment.len()];
        outliers.iter().for_each(|&i| normal[i] = false);
        let blocks = trend::blocks(segment.len(), settings.whole(shared::BLOCK.key));
        let replaced = |n: usize| {
            let i = outliers[n];
            let at = blocks.partition_point(|block| block.end <= i);
            let Some(block) = blocks.get(at) else { return f64::NAN };
            let before = (block.start..i).rev().skip(groups - 1).step_by(groups).find(|&j| normal[j]);
            let after = || (i + groups..block.end).step_by(groups).find(|&j| normal[j]);
            // The mean residual of the group is in both expected values and cancels.
            before.or_else(after).map_or(f64::NAN, |j| judged.expected[i] + (segment.y[j] - judged.expected[j]))
        };
        pieces::collect(outliers.len(), &|| stop.check(), replaced)
    }
}

fn criterion(settings: &Settings) -> impl Criterion {
    let k = settings.real(shared::K.key);
    AtOnce { groups: groups(settings), multiplier: move |_| k }
}

fn groups(settings: &Settings) -> usize {
    1 << settings.whole(SPLITS.key)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::method::Verdict;

    #[test]
    fn a_replaced_sample_has_the_residual_of_its_neighbour_in_the_group() {
        let y: Vec<f64> = (0..40).map(|i| f64::from(i % 5)).collect();
        let segment =
            Segment { t: &y, y: &y, interval: 1.0, sigma: 0.0, floor: 0.0, floors: &[], objections: &[], rate: None };
        let mut settings = Settings::defaults(&PARAMS);
        settings.set("odd-even", "block", Value::Whole(20)).unwrap();
        let judged = Judged {
            verdict: vec![Verdict::Normal; 40],
            expected: (0..40).map(|i| 100.0 * f64::from(i)).collect(),
            ..Judged::default()
        };
        // 9 follows 5; 2 starts its group and 6 is an outlier too, so 10 stands in; 20 starts the second block.
        let got = {
            let (segment, settings, outliers) = (&segment, &settings, &[2, 6, 9, 20]);
            let damaged = Damaged { segment, settings, judged: judged.part(0..40), outliers };
            OddEven.own_repair(&damaged, &Stop::never()).unwrap()
        };
        let from = |i: usize, j: usize| 100.0 * i as f64 + y[j] - 100.0 * j as f64;
        assert_eq!(got, [from(2, 10), from(6, 10), from(9, 5), from(20, 24)]);
    }
}
