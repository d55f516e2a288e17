//! The generalised extreme studentised deviate test (Rosner 1983): Grubbs' test that many outliers do not mask.

use super::trend::{self, Criterion, Critical, Limit, Pass, Removals, Survivors};
use super::{About, Judged, Method, Own, Segment, exceeds, shared};
use crate::math::moments::Moments;
use crate::param::{Kind, Param, Settings, Step, Value, always};
use crate::stop::{Stop, Stopped};

/// The method `gesd` of section 2 of the methods page (beyond the documents; Rosner 1983).
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

static PARAMS: [Param; 8] = [
    shared::ALPHA.with_default(Value::Real(0.05)),
    MAX_FRACTION,
    shared::TREND_ORDER,
    shared::REFIT.with_paper(None),
    shared::MAX_PASSES.with_paper(None),
    shared::BLOCK,
    shared::MAX_GAP,
    shared::FLOOR,
];

static ABOUT: About = About {
    id: "gesd",
    name: "generalised ESD (Rosner)",
    family: shared::WHOLE_SEGMENT,
    source: "beyond (Rosner 1983)",
    advice: "Takes out the most deviant samples up to max_fraction of all and flags those up to the last that exceeds \
             its critical value, so that many wild points cannot mask each other as they do in grubbs. alpha is the \
             chance of one false alarm in a whole block. Wants 25 samples and a trend that follows the data; of wild \
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

    fn warnings(&self, settings: &Settings) -> Vec<String> {
        trend::warnings(&criterion(settings), settings)
    }
}

fn criterion(settings: &Settings) -> Rosner {
    let critical = Critical::new(settings.real(shared::ALPHA.key), true);
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
        // Before each removal the moments, and with it the deviation of what is removed.
        let mut tested: Vec<(Moments, f64)> = Vec::with_capacity(most);
        while tested.len() < most && removals.len() >= 3 {
            stop.check_at(tested.len())?;
            let before = removals.left;
            let Some(deviation) = removals.take(stop)? else { break };
            tested.push((before, deviation));
        }
        let scale = |left: &Moments| survivors.bounded(left.deviation());
        // Critical values grow with the sample: what does not exceed the smallest needs no other.
        let smallest = self.critical.at(n - tested.len().saturating_sub(1));
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::method::{Verdict, judge_channel};
    use crate::track::Series;

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
}
