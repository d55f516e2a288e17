//! The consensus of several methods, so that it can be repaired and written like the result of one.

use crate::method::{About, Judged, Method, Own, Segment, shared};
use crate::param::{Kind, Param, Settings, Value, always};
use crate::stop::{Stop, Stopped};

/// Stands for "at least so many methods flag it" in a result. It is none of the methods that can be chosen: by
/// itself it judges nothing.
pub(super) struct Consensus;

pub(super) const VOTES: Param = Param {
    key: "votes",
    help: "a sample is an outlier when at least so many methods flag it",
    unit: "methods",
    kind: Kind::Whole { min: 1, max: 1000, step: 1 },
    default: Value::Whole(1),
    paper: None,
    matters: always,
};

static PARAMS: &[Param] = &[VOTES, shared::MAX_GAP];

static ABOUT: About = About {
    id: "consensus",
    name: "consensus of several methods",
    family: "consensus",
    source: "beyond",
    advice: "What at least so many methods agree on.",
    params: PARAMS,
    own: Own::Remove,
    needs_rate: false,
};

impl Method for Consensus {
    fn about(&self) -> &'static About {
        &ABOUT
    }

    fn judge(&self, segment: &Segment<'_>, _: &Settings, _: &Stop) -> Result<Judged, Stopped> {
        Ok(Judged::unchecked(segment.len()))
    }
}
