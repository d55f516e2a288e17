//! Grubbs' test of the most deviant sample, one at a time.

use super::trend::{self, Criterion, Critical, OneAtATime};
use super::{About, Judged, Method, Own, Segment, shared};
use crate::param::{Param, Settings};
use crate::stop::{Stop, Stopped};

/// The method `grubbs` of section 2 of `docs/methods.md`.
#[derive(Debug, Clone, Copy)]
pub struct Grubbs;

static PARAMS: [Param; 8] = [
    shared::ALPHA,
    shared::TREND_ORDER,
    shared::REFIT,
    shared::MAX_PASSES,
    shared::BLOCK,
    shared::MAX_GAP,
    shared::FLOOR,
    shared::DOUBT,
];

static ABOUT: About = About {
    id: "grubbs",
    name: "Grubbs",
    family: shared::WHOLE_SEGMENT,
    source: "[001] s.2",
    advice: "Takes out the most deviant sample, again and again, as long as it exceeds the largest that clean data of this size would show. alpha is the chance of one false alarm in a whole block. For 20 to 100 samples with few wild points ([001] calls it the best of its criteria): many of them mask each other, and it then finds hardly any; use gesd.",
    params: &PARAMS,
    own: Own::Remove,
    needs_rate: false,
};

impl Method for Grubbs {
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

fn criterion(settings: &Settings) -> impl Criterion {
    OneAtATime(Critical::new(settings.real(shared::ALPHA.key), true))
}
