//! A position of 0, 0: what receivers write before they have a fix.

use super::{About, Check, Objection, Own, Subject};
use crate::error::Error;
use crate::math::order::median_in_place;
use crate::method::Verdict;
use crate::param::{Kind, Param, Settings, Step, Value, always};
use crate::stop::{Stop, Stopped};

/// The position without a fix.
#[derive(Debug)]
pub struct NullIsland;

const APART: &str = "apart";

static PARAMS: &[Param] = &[Param {
    key: APART,
    help: "a position of 0, 0 counts only where the record as a whole is farther than this from 0, 0",
    unit: "channel units",
    kind: Kind::Real { min: 0.0, max: 1e9, step: Step::Add(0.1) },
    default: Value::Real(0.5),
    paper: None,
    matters: always,
}];

static ABOUT: About = About {
    id: "null-island",
    help: "0 in both channels of a position at once, which receivers write without a fix",
    params: PARAMS,
    own: Own::Remove,
    channels: Some((2, 2)),
};

impl Check for NullIsland {
    fn about(&self) -> &'static About {
        &ABOUT
    }

    fn examine(&self, subject: &Subject<'_>, settings: &Settings, stop: &Stop) -> Result<Vec<Objection>, Stopped> {
        let [x, y] = subject.channels else { return Ok(Vec::new()) };
        let mut found = Vec::new();
        let mut distances = Vec::with_capacity(x.len());
        let apart = settings.real(APART);
        for (position, (&x, &y)) in x.iter().zip(y).enumerate() {
            stop.check_at(position)?;
            let distance = x.abs().max(y.abs());
            if distance == 0.0 {
                found.push(Objection { position, verdict: Verdict::Outlier, found: 0.0, limit: apart });
            } else if distance.is_finite() {
                distances.push(distance);
            }
        }
        let middle = median_in_place(&mut distances);
        Ok(if middle > apart { found } else { Vec::new() })
    }

    fn verify(&self, _: &Settings) -> Result<(), Error> {
        Ok(())
    }

    fn evidence(&self, _: &Objection) -> String {
        "0 in both channels of the position".into()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn examine(x: Vec<f64>, y: Vec<f64>) -> Vec<usize> {
        let t: Vec<f64> = (0..x.len()).map(|i| i as f64).collect();
        let subject = Subject { t: &t, y: &x.clone(), period: None, channels: &[x, y] };
        let found = NullIsland.examine(&subject, &Settings::defaults(PARAMS), &Stop::never()).unwrap();
        found.iter().map(|o| o.position).collect()
    }

    #[test]
    fn zero_in_both_fails_where_the_record_lies_elsewhere() {
        assert_eq!(examine(vec![47.1, 0.0, 47.2, 0.0], vec![8.5, 0.0, 0.0, 0.0]), [1, 3]);
        assert!(examine(vec![0.0, 0.1, 0.2, 0.0], vec![0.0, 0.1, 0.1, 0.0]).is_empty(), "a local origin");
        assert!(examine(vec![0.0, f64::NAN], vec![f64::NAN, 0.0]).is_empty());
    }
}
