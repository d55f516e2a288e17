//! Chauvenet's criterion: a tolerance that grows with the number of samples.

use super::trend::{self, AtOnce, Criterion, normal_at};
use super::{About, Filter, Judged, Method, Own, Segment, shared};
use crate::param::{Param, Settings};
use crate::stop::{Stop, Stopped};

/// The method `chauvenet` of section 2 of `docs/methods.md`.
#[derive(Debug, Clone, Copy)]
pub struct Chauvenet;

static PARAMS: [Param; 7] = [
    shared::TREND_ORDER,
    shared::REFIT,
    shared::MAX_PASSES_OPEN,
    shared::BLOCK,
    shared::MAX_GAP,
    shared::FLOOR,
    shared::DOUBT,
];

static ABOUT: About = About {
    id: "chauvenet",
    name: "Chauvenet",
    family: shared::WHOLE_SEGMENT,
    source: "[001] s.2",
    advice: "Flags every value of which fewer than half a sample is expected in normal data of this size: k grows with the number of samples, from 1.96 for 10 to 3.48 for 1000. Cheap, for much data with few runs of outliers and no wild points that vary with time. On clean data it flags about one sample in every second block.",
    params: &PARAMS,
    own: Own::Remove,
    needs_rate: false,
};

impl Method for Chauvenet {
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

fn criterion(_: &Settings) -> impl Criterion {
    AtOnce { groups: 1, multiplier: normal_at }
}
