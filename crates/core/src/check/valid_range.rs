//! Values that the quantity or the instrument cannot have.

use super::{About, Check, Objection, Own, Subject, number, shared};
use crate::error::Error;
use crate::math::pieces;
use crate::method::Verdict;
use crate::param::{Param, Settings};
use crate::stop::{Stop, Stopped};

/// The valid range.
#[derive(Debug)]
pub struct ValidRange;

const LOW: &str = "low";
const HIGH: &str = "high";
const SUSPECT_LOW: &str = "suspect_low";
const SUSPECT_HIGH: &str = "suspect_high";

static PARAMS: &[Param] = &[
    shared::limit(LOW, "smallest value that can be: a smaller one fails", "channel units", -1e300),
    shared::limit(HIGH, "largest value that can be: a larger one fails", "channel units", -1e300),
    shared::limit(SUSPECT_LOW, "smallest usual value: a smaller one is suspect", "channel units", -1e300),
    shared::limit(SUSPECT_HIGH, "largest usual value: a larger one is suspect", "channel units", -1e300),
];

static ABOUT: About = About {
    id: "valid-range",
    help: "values outside the range that the quantity or the instrument can have",
    params: PARAMS,
    own: Own::Line,
    channels: None,
};

impl Check for ValidRange {
    fn about(&self) -> &'static About {
        &ABOUT
    }

    fn examine(&self, subject: &Subject<'_>, settings: &Settings, stop: &Stop) -> Result<Vec<Objection>, Stopped> {
        let of = |key: &str, none: f64| number(settings, key).unwrap_or(none);
        let (none, all) = (f64::NEG_INFINITY, f64::INFINITY);
        let fail = (of(LOW, none), of(HIGH, all));
        let suspect = (of(SUSPECT_LOW, none), of(SUSPECT_HIGH, all));
        let beyond = |y: f64, (low, high): (f64, f64)| match (y < low, y > high) {
            (true, _) => Some(low),
            (_, true) => Some(high),
            _ => None,
        };
        let verdict = |y: f64| {
            let fails = beyond(y, fail).map(|limit| (Verdict::Outlier, limit));
            fails.or_else(|| beyond(y, suspect).map(|limit| (Verdict::Suspect, limit)))
        };
        let objection = |position: usize| {
            let y = subject.y[position];
            verdict(y).map(|(verdict, limit)| Objection { position, verdict, found: y, limit })
        };
        let of = |piece: std::ops::Range<usize>| piece.filter_map(objection).collect::<Vec<_>>();
        Ok(pieces::map(subject.y.len(), &|| stop.check(), of)?.concat())
    }

    fn verify(&self, settings: &Settings) -> Result<(), Error> {
        let limits = [LOW, HIGH, SUSPECT_LOW, SUSPECT_HIGH].map(|key| number(settings, key));
        let [low, high, suspect_low, suspect_high] = limits;
        if limits.iter().all(Option::is_none) {
            let what = "valid-range: needs a limit";
            return Err(Error::usage(what, "set low, high or both: valid-range:low=-40,high=60"));
        }
        // Each of them lies at or below the next.
        let order = [(LOW, low), (SUSPECT_LOW, suspect_low), (SUSPECT_HIGH, suspect_high), (HIGH, high)];
        let set: Vec<(&str, f64)> = order.into_iter().filter_map(|(key, x)| Some((key, x?))).collect();
        match set.windows(2).find(|w| w[0].1 > w[1].1) {
            None => Ok(()),
            Some(w) => Err(Error::usage(
                format!("valid-range: {} = {} lies above {} = {}", w[0].0, w[0].1, w[1].0, w[1].1),
                "low, suspect_low, suspect_high and high must ascend",
            )),
        }
    }

    fn evidence(&self, o: &Objection) -> String {
        let side = if o.found < o.limit { "below" } else { "above" };
        format!("{side} {}", o.limit)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_lies_outside_fails_and_what_is_unusual_is_suspect() {
        let y = [5.0, -41.0, 60.0, 61.0, 45.0, -40.0];
        let t = [0.0, 1.0, 2.0, 3.0, 4.0, 5.0];
        let mut settings = Settings::defaults(PARAMS);
        for (key, value) in [(LOW, "-40"), (HIGH, "60"), (SUSPECT_HIGH, "40")] {
            settings.set_text("valid-range", key, value).unwrap();
        }
        let subject = Subject { t: &t, y: &y, period: None, channels: &[] };
        let found = ValidRange.examine(&subject, &settings, &Stop::never()).unwrap();
        let said: Vec<(usize, Verdict)> = found.iter().map(|o| (o.position, o.verdict)).collect();
        let (fail, suspect) = (Verdict::Outlier, Verdict::Suspect);
        assert_eq!(said, [(1, fail), (2, suspect), (3, fail), (4, suspect)]);
        assert_eq!(ValidRange.evidence(&found[0]), "below -40");
    }
}
