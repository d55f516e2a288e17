//! Romanovsky's criterion: Student's t for the most deviant sample, one at a time.

use super::trend::{self, Chance, Criterion, Critical, OneAtATime};
use super::{About, Filter, Judged, Method, Own, Segment, shared};
use crate::param::{Param, Settings};
use crate::stop::{Stop, Stopped};

/// The method `romanovsky` of section 2 of `docs/methods.md`.
#[derive(Debug, Clone, Copy)]
pub struct Romanovsky;

static PARAMS: [Param; 8] = [
    shared::ALPHA,
    shared::TREND_ORDER,
    shared::REFIT,
    shared::MAX_PASSES_OPEN,
    shared::BLOCK,
    shared::MAX_GAP,
    shared::FLOOR,
    shared::DOUBT,
];

static ABOUT: About = About {
    id: "romanovsky",
    name: "Romanovsky (t test)",
    family: shared::WHOLE_SEGMENT,
    source: "[001] s.2",
    advice: "Removes the most deviant sample repeatedly, until Student's t accepts it. For few data without wild points that vary with time ([001]: 4 to 20); alpha is the chance of a false alarm for each sample, so long records lose about 1.6 alpha of their good ones.",
    params: &PARAMS,
    own: Own::Remove,
    needs_rate: false,
};

impl Method for Romanovsky {
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
    OneAtATime(Critical::new(settings.real(shared::ALPHA.key), Chance::Sample))
}
