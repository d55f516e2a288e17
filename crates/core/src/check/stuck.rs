//! The same value for longer than the channel can hold it.

use super::{About, Check, Limits, Objection, Own, Subject, shared};
use crate::error::Error;
use crate::param::{Kind, Param, Settings, Value, always};
use crate::stop::{Stop, Stopped};

/// The stuck sensor.
#[derive(Debug)]
pub struct Stuck;

/// The key of the limit beyond which a stretch fails.
pub const FAIL: &str = shared::FAIL;
/// The key of the limit beyond which a stretch is suspect.
pub const SUSPECT: &str = shared::SUSPECT;

const WITHIN: &str = "within";

const fn samples(key: &'static str, help: &'static str) -> Param {
    Param {
        key,
        help,
        unit: "samples",
        kind: Kind::WholeOrOff { min: 1, max: 1_000_000_000 },
        default: Value::Word("off"),
        paper: None,
        matters: always,
    }
}

static PARAMS: &[Param] = &[
    samples(SUSPECT, "a value held for more than this many samples is suspect, but for its first sample"),
    samples(FAIL, "a value held for more than this many samples fails, but for its first sample"),
    Param {
        key: WITHIN,
        help: "values count as held while they stay within this of the first",
        unit: "channel units",
        kind: Kind::RealOr { words: &["exactly"], min: 0.0, max: 1e300 },
        default: Value::Word("exactly"),
        paper: None,
        matters: always,
    },
];

static ABOUT: About = About {
    id: "stuck",
    help: "one value repeated for more than this many samples, where the record otherwise moves",
    params: PARAMS,
    own: Own::Remove,
    channels: None,
};

impl Check for Stuck {
    fn about(&self) -> &'static About {
        &ABOUT
    }

    fn examine(&self, subject: &Subject<'_>, settings: &Settings, stop: &Stop) -> Result<Vec<Objection>, Stopped> {
        let limits = Limits::of(settings);
        let within = super::number(settings, WITHIN).unwrap_or(0.0);
        let y = subject.y;
        let mut found = Vec::new();
        let mut start = 0;
        for i in 1..=y.len() {
            stop.check_at(i)?;
            if i < y.len() && (y[i] - y[start]).abs() <= within {
                continue;
            }
            // A record that never moves is not stuck: there is nothing to tell it from a constant.
            let length = i - start;
            #[expect(clippy::cast_precision_loss, reason = "the loader refuses files of 2^32 rows and more")]
            if let Some((verdict, limit)) = limits.verdict(length as f64).filter(|_| length < y.len()) {
                // The first sample may have been measured.
                let of = |position| Objection { position, verdict, found: length as f64, limit };
                found.extend((start + 1..i).map(of));
            }
            start = i;
        }
        Ok(found)
    }

    fn verify(&self, settings: &Settings) -> Result<(), Error> {
        Limits::of(settings).verify("stuck", "stuck:fail=60")
    }

    fn evidence(&self, o: &Objection) -> String {
        format!("{} equal values in a row, more than {}", o.found, o.limit)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::method::Verdict;

    fn examine(y: &[f64], pairs: &[(&str, &str)]) -> Vec<(usize, Verdict)> {
        let mut settings = Settings::defaults(PARAMS);
        pairs.iter().for_each(|(key, value)| settings.set_text("stuck", key, value).unwrap());
        let t: Vec<f64> = (0..y.len()).map(|i| i as f64).collect();
        let subject = Subject { t: &t, y, period: None, channels: &[] };
        let found = Stuck.examine(&subject, &settings, &Stop::never()).unwrap();
        found.iter().map(|o| (o.position, o.verdict)).collect()
    }

    #[test]
    fn a_held_value_is_suspect_and_then_fails_but_for_its_first_sample() {
        let y = [1.0, 2.0, 2.0, 2.0, 3.0, 4.0, 4.0, 4.0, 4.0, 4.0];
        let fail: Vec<(usize, Verdict)> = (6..10).map(|i| (i, Verdict::Outlier)).collect();
        assert_eq!(examine(&y, &[("fail", "4")]), fail);
        let both = examine(&y, &[("fail", "4"), ("suspect", "2")]);
        assert_eq!(both[..2], [(2, Verdict::Suspect), (3, Verdict::Suspect)]);
        assert_eq!(both[2..], fail);
    }

    #[test]
    fn a_record_that_never_moves_is_not_stuck_and_small_changes_can_be_held_too() {
        assert!(examine(&[7.0; 50], &[("fail", "4")]).is_empty());
        let y = [1.0, 2.0, 2.01, 1.99, 2.0, 9.0];
        assert!(examine(&y, &[("fail", "3")]).is_empty());
        assert_eq!(examine(&y, &[("fail", "3"), ("within", "0.05")]).len(), 3);
    }
}
