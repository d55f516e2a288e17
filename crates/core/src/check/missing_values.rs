//! Numbers that stand for "no value": -9999, 1e20, 99.99.

use super::{About, Check, Objection, Own, Subject};
use crate::error::Error;
use crate::math::pieces;
use crate::method::Verdict;
use crate::param::{Kind, Numbers, Param, Settings, Value, always};
use crate::stop::{Stop, Stopped};

/// The missing values.
#[derive(Debug)]
pub struct MissingValues;

/// Its id.
pub const ID: &str = "missing-values";
/// The key of the list.
pub const VALUES: &str = "values";

static PARAMS: &[Param] = &[Param {
    key: VALUES,
    help: "fill values: a sample exactly equal to one fails",
    unit: "channel units",
    kind: Kind::Numbers,
    default: Value::Numbers(Numbers::NONE),
    paper: None,
    matters: always,
}];

static ABOUT: About = About {
    id: ID,
    help: "fill values (-9999, 1e20, 99.99), compared exactly",
    params: PARAMS,
    own: Own::Remove,
    channels: None,
};

impl Check for MissingValues {
    fn about(&self) -> &'static About {
        &ABOUT
    }

    fn examine(&self, subject: &Subject<'_>, settings: &Settings, stop: &Stop) -> Result<Vec<Objection>, Stopped> {
        let markers = settings.numbers(VALUES);
        let markers = markers.as_slice();
        let objection = |position: usize| {
            let y = subject.y[position];
            // A marker is a text that the file repeats, so that it reads as the same double each time.
            #[expect(clippy::float_cmp, reason = "exact repetition is what is looked for")]
            let marker = markers.iter().find(|m| **m == y);
            marker.map(|&limit| Objection { position, verdict: Verdict::Outlier, found: y, limit })
        };
        let of = |piece: std::ops::Range<usize>| piece.filter_map(objection).collect::<Vec<_>>();
        Ok(pieces::map(subject.y.len(), &|| stop.check(), of)?.concat())
    }

    fn verify(&self, settings: &Settings) -> Result<(), Error> {
        if settings.numbers(VALUES).as_slice().is_empty() {
            let what = "missing-values: needs a value";
            return Err(Error::usage(what, "give the values: missing-values:values=-9999,1e20"));
        }
        Ok(())
    }

    fn evidence(&self, _: &Objection) -> String {
        "stands for no value".into()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_exact_repetitions_of_a_marker_fail() {
        let y = [12.5, -9999.0, -9998.0, 1e20, 99.99];
        let t = [0.0, 1.0, 2.0, 3.0, 4.0];
        let mut settings = Settings::defaults(PARAMS);
        settings.set_text("missing-values", VALUES, "-9999,1e20").unwrap();
        let subject = Subject { t: &t, y: &y, period: None, channels: &[] };
        let found = MissingValues.examine(&subject, &settings, &Stop::never()).unwrap();
        assert_eq!(found.iter().map(|o| o.position).collect::<Vec<_>>(), [1, 3]);
    }
}
