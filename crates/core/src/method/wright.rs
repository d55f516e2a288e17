//! Wright's (PauTa) criterion: three standard deviations from the mean.

use super::trend::{self, AtOnce, Criterion};
use super::{About, Filter, Judged, Method, Own, Segment, shared};
use crate::param::{Param, Settings, Value};
use crate::stop::{Stop, Stopped};

/// The method `wright` of section 2 of `docs/methods.md`.
#[derive(Debug, Clone, Copy)]
pub struct Wright;

static PARAMS: [Param; 8] = [
    shared::K,
    shared::TREND_ORDER.with_default(Value::Whole(0)),
    shared::REFIT,
    shared::MAX_PASSES,
    shared::BLOCK,
    shared::MAX_GAP,
    shared::FLOOR,
    shared::DOUBT,
];

static ABOUT: About = About {
    id: "wright",
    name: "Wright (PauTa) 3-sigma criterion",
    family: shared::WHOLE_SEGMENT,
    source: "[001] s.2, [002]",
    advice: "Flags every sample k or more standard deviations from the mean. Simple and fast, for much data that has no trend of its own (residuals, rates): on a track the deviation reflects the motion, not the noise. Among fewer than 11 samples it cannot flag anything at k = 3. It misses wild points that vary with time and a run large enough to inflate the standard deviation.",
    params: &PARAMS,
    own: Own::Remove,
    needs_rate: false,
};

impl Method for Wright {
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

fn criterion(settings: &Settings) -> impl Criterion {
    let k = settings.real(shared::K.key);
    AtOnce { groups: 1, multiplier: move |_| k }
}
