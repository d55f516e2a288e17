//! The generalised extreme studentised deviate test (Rosner 1983): Grubbs' test that many outliers do not mask.

use super::trend::{self, Chance, Criterion, Critical, Limit, Pass, Removals, Survivors};
use super::{About, Filter, Judged, Method, Own, Segment, exceeds, shared};
use crate::math::least_spread::least_squares_of_any;
use crate::math::moments::Moments;
use crate::param::{Kind, Param, Settings, Step, Value, always};
use crate::stop::{Stop, Stopped};

/// The method `gesd` of section 2 of `docs/methods.md` (beyond the documents; Rosner 1983).
#[derive(Debug, Clone, Copy)]
pub struct Gesd;

const MAX_FRACTION: Param = Param {
    key: "max_fraction",
    help: "largest part of the samples of a pass that may be outliers",
    unit: "",
    kind: Kind::Real { min: 0.001, max: 0.5, step: Step::Add(0.05) },
    default: Value::Real(0.35),
    paper: None,
    matters: always,
};

static PARAMS: [Param; 9] = [
    shared::ALPHA.with_default(Value::Real(0.05)),
    MAX_FRACTION,
    shared::TREND_ORDER,
    shared::REFIT.with_paper(None),
    shared::MAX_PASSES.with_paper(None),
    shared::BLOCK,
    shared::MAX_GAP,
    shared::FLOOR,
    shared::DOUBT,
];

static ABOUT: About = About {
    id: "gesd",
    name: "generalised ESD (Rosner)",
    family: shared::WHOLE_SEGMENT,
    source: "beyond (Rosner 1983)",
    advice: "Takes out the most deviant samples up to max_fraction of all and flags those up to the last that exceeds \
             its critical value, so that many wild points cannot mask each other as they do in grubbs. alpha is the \
             chance of one false alarm in a whole block. Needs 25 samples and a trend that follows the data; of wild \
             points that vary with time it misses those inside the noise.",
    params: &PARAMS,
    own: Own::Remove,
    needs_rate: false,
};

impl Method for Gesd {
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
}

fn criterion(settings: &Settings) -> Rosner {
    let critical = Critical::new(settings.real(shared::ALPHA.key), Chance::Block);
    Rosner { critical, max_fraction: settings.real(MAX_FRACTION.key) }
}

struct Rosner {
    critical: Critical,
    max_fraction: f64,
}

impl Criterion for Rosner {
    fn needed(&self, n: usize) -> f64 {
        self.critical.at(n)
    }

    fn pass(&self, survivors: &Survivors<'_>, stop: &Stop) -> Result<Pass, Stopped> {
        let n = survivors.residual.len();
        #[expect(
            clippy::cast_precision_loss,
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "0..n"
        )]
        let most = ((self.max_fraction * n as f64) as usize).max(1);
        let mut removals = Removals::new(survivors.residual, stop)?;
        // Critical values grow with the sample: what does not exceed the smallest needs no other.
        let smallest = self.critical.at(n - (most - 1).min(n.saturating_sub(3)));
        let later = Later::of(survivors, &removals.left, (n.saturating_sub(most), smallest), stop)?;
        // Before each removal the moments, and with it the deviation of what is removed.
        let mut tested: Vec<(Moments, f64)> = Vec::new();
        while tested.len() < most && removals.len() >= 3 {
            stop.check_at(tested.len())?;
            let before = removals.left;
            let Some(deviation) = removals.take(stop)? else { break };
            tested.push((before, deviation));
            if tested.len().is_multiple_of(LOOK) && later.none_exceeds(survivors, &before, deviation) {
                break;
            }
        }
        let scale = |left: &Moments| survivors.bounded(left.deviation());
        let significant = |removed: usize| {
            let (left, deviation) = &tested[removed];
            let scale = scale(left);
            scale > 0.0
                && exceeds(*deviation, smallest * scale)
                && exceeds(*deviation, self.critical.at(n - removed) * scale)
        };
        let mut last = tested.len();
        while last > 0 && !significant(last - 1) {
            last -= 1;
            stop.check_at(last)?;
        }
        let left = tested.get(last).map_or(removals.left, |(left, _)| *left);
        let scale = scale(&left);
        let tolerance = if n - last >= 3 { self.critical.at(n - last) * scale } else { 0.0 };
        removals.taken.truncate(last);
        Ok(Pass { flagged: removals.taken, groups: vec![Some(Limit { mean: left.mean, scale, tolerance })] })
    }
}

/// Removals between two looks at whether any later one can matter.
const LOOK: usize = 256;

/// What is known of all later removals before they are made: nearly always, that none of them can be significant, so
/// that most of the samples up to `max_fraction` need not be put in order.
struct Later {
    /// How many samples are left after the last removal.
    keep: usize,
    /// The sum of squares of those left is never less.
    least: f64,
    /// No critical value is less.
    smallest: f64,
}

impl Later {
    fn of(
        survivors: &Survivors<'_>,
        all: &Moments,
        (keep, smallest): (usize, f64),
        stop: &Stop,
    ) -> Result<Self, Stopped> {
        // Of a few, all are removed before this would pay.
        let least = if survivors.residual.len() < 4 * LOOK {
            0.0
        } else {
            least_squares_of_any(survivors.residual, keep, (all.mean, 3.0 * all.deviation()), &|| stop.check())?
        };
        Ok(Self { keep, least, smallest })
    }

    /// True when, after the removal of a sample `deviation` from the mean of those before it, none can exceed its
    /// critical value. All that are left lie within `deviation` of that mean; the mean of `keep` of `n` values is no
    /// more than `s sqrt((n - keep) / keep)` from that of all; and no scale is less than what `least` leaves to it.
    fn none_exceeds(&self, survivors: &Survivors<'_>, before: &Moments, deviation: f64) -> bool {
        #[expect(clippy::cast_precision_loss, reason = "counts are far below 2^53")]
        let keep = self.keep as f64;
        let drift = before.deviation() * ((before.count - keep) / keep).sqrt();
        let scale = survivors.bounded((self.least / (before.count - 1.0)).sqrt());
        // Moments that were updated over many removals have lost a few digits.
        (deviation + drift) * 1.001 < self.smallest * scale
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::method::noise::Scales;
    use crate::method::{Verdict, judge_channel};
    use crate::series::Series;

    /// Positions flagged among twelve samples of plus and minus one, some of which are 50.
    fn flagged(wild: &[usize], max_fraction: f64) -> Vec<usize> {
        let t: Vec<f64> = (0..12).map(f64::from).collect();
        let mut y: Vec<f64> = (0..12).map(|i| if i % 2 == 0 { 1.0 } else { -1.0 }).collect();
        wild.iter().for_each(|i| y[*i] = 50.0);
        let mut settings = Settings::defaults(&PARAMS);
        settings.set("gesd", "max_fraction", Value::Real(max_fraction)).unwrap();
        settings.set("gesd", "trend_order", Value::Whole(0)).unwrap();
        let judged = judge_channel(&Gesd, &Series::new(&t, &y), None, &settings, &Stop::never()).unwrap();
        (0..12).filter(|i| judged.verdict[*i] == Verdict::Outlier).collect()
    }

    #[test]
    fn so_many_candidates_are_tried_as_the_fraction_allows_and_never_none() {
        // Two of twelve mask each other: R1 is 2.14, the critical value of Grubbs (two-sided, 5 %) 2.41; R2, of eleven,
        // is 3.0 against 2.36. So one candidate finds none of them, and two find both.
        assert_eq!(flagged(&[3, 8], 0.1), [0; 0], "floor(1.2) is one");
        assert_eq!(flagged(&[3, 8], 0.2), [3, 8], "floor(2.4) is two");
        assert_eq!(flagged(&[3], 0.05), [3], "floor(0.6) is none, and one is tried all the same");
    }

    /// What the definition flags: all candidates are taken out one by one, with moments summed anew each time.
    fn plain(residual: &[f64], rosner: &Rosner) -> Vec<usize> {
        let mut left: Vec<usize> = (0..residual.len()).collect();
        let (mut taken, mut last) = (Vec::new(), 0);
        for _ in 0..(rosner.max_fraction * residual.len() as f64) as usize {
            let values: Vec<f64> = left.iter().map(|i| residual[*i]).collect();
            let moments = Moments::of(&values);
            let far = |i: &usize| (residual[*i] - moments.mean).abs();
            let at = (0..left.len()).rev().max_by(|a, b| far(&left[*a]).total_cmp(&far(&left[*b]))).unwrap();
            let significant = far(&left[at]) > rosner.critical.at(left.len()) * moments.deviation();
            taken.push(left.remove(at));
            last = if significant { taken.len() } else { last };
        }
        taken.truncate(last);
        taken.sort_unstable();
        taken
    }

    #[test]
    fn candidates_that_cannot_matter_are_not_tried_and_change_nothing() {
        let wave = |i: usize| (i as f64 * 12.9898).sin() + (i as f64 * 78.233).cos() + (i as f64 * 3.77).sin();
        let shapes: [(&str, &dyn Fn(usize) -> f64); 5] = [
            ("one side", &|i| wave(i) + if i % 40 < 3 { 30.0 } else { 0.0 }),
            ("both", &|i| wave(i) + [0.0, 12.0, -9.0][if i % 50 < 2 { 1 + i % 2 } else { 0 }]),
            ("a third", &|i| wave(i) + if i % 10 < 3 { 50.0 + wave(7 * i) } else { 0.0 }),
            ("tails", &|i| wave(i).powi(5)),
            ("steps", &|i| wave(i).round() + if i % 100 == 7 { 15.0 } else { 0.0 }),
        ];
        let t: Vec<f64> = (0..3000).map(f64::from).collect();
        let rosner = Rosner { critical: Critical::new(0.05, Chance::Block), max_fraction: 0.35 };
        for (name, shape) in shapes {
            let y: Vec<f64> = (0..3000).map(shape).collect();
            let series = Series::new(&t, &y);
            let segment = Segment::of(
                &series,
                &(0..3000),
                &Scales { sigma: 0.0, floor: 0.0, floors: None, objections: None },
                None,
            );
            let survivors = Survivors { residual: &y, position: &[], segment: &segment, zero: 0.0 };
            let mut flagged = rosner.pass(&survivors, &Stop::never()).unwrap().flagged;
            flagged.sort_unstable();
            assert_eq!(flagged, plain(&y, &rosner), "{name}");
        }
    }

    #[test]
    fn a_look_ahead_ends_the_removals_of_ordinary_noise_long_before_the_last() {
        let y: Vec<f64> = (0..4000).map(|i| (1..=12).map(|k| (f64::from(i * k) * 0.618_034).fract()).sum()).collect();
        let t: Vec<f64> = (0..4000).map(f64::from).collect();
        let series = Series::new(&t, &y);
        let segment =
            Segment::of(&series, &(0..4000), &Scales { sigma: 0.0, floor: 0.0, floors: None, objections: None }, None);
        let survivors = Survivors { residual: &y, position: &[], segment: &segment, zero: 0.0 };
        let critical = Critical::new(0.05, Chance::Block).at(2601);
        let mut removals = Removals::new(&y, &Stop::never()).unwrap();
        let later = Later::of(&survivors, &removals.left, (2600, critical), &Stop::never()).unwrap();
        let mut tried = 0;
        while let Some(deviation) = Some(removals.left).and_then(|before| {
            let deviation = removals.take(&Stop::never()).unwrap()?;
            (!later.none_exceeds(&survivors, &before, deviation)).then_some(deviation)
        }) {
            assert!(deviation > 0.0);
            tried += 1;
        }
        assert!((1..900).contains(&tried), "{tried} of 1400");
    }
}
