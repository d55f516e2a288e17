//! A least-squares trend and Wright's criterion on what is left of the data.

use super::trend::{self, AtOnce, Criterion};
use super::{About, Filter, Judged, Method, Own, Segment, shared};
use crate::param::{Param, Settings};
use crate::stop::{Stop, Stopped};

/// The method `trend-wright` of section 2 of `docs/methods.md`.
#[derive(Debug, Clone, Copy)]
pub struct TrendWright;

static PARAMS: [Param; 8] = [
    shared::K,
    shared::TREND_ORDER,
    shared::REFIT,
    shared::MAX_PASSES,
    shared::BLOCK,
    shared::MAX_GAP,
    shared::FLOOR,
    shared::DOUBT,
];

static ABOUT: About = About {
    id: "trend-wright",
    name: "least-squares trend and Wright",
    family: shared::WHOLE_SEGMENT,
    source: "[002]",
    advice: "Subtracts a least-squares polynomial and flags every sample k or more standard deviations from it, pass after pass. For stretches of a track that a polynomial of low order follows; on longer ones set block, or the deviation measures the misfit. Finds isolated wild points and short runs in much data; needs 20 samples in a block at k = 3.",
    params: &PARAMS,
    own: Own::Remove,
    needs_rate: false,
};

impl Method for TrendWright {
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
