//! The Hampel identifier: a sliding median without feedback, judged by the window's median absolute deviation.

use super::window::{self, Center, Rule};
use super::{About, Filter, Judged, Method, Own, Segment, shared};
use crate::param::{Param, Settings};
use crate::stop::{Stop, Stopped};

/// The method `hampel` of section 3 of `docs/methods.md` (beyond the documents; Hampel 1974).
#[derive(Debug, Clone, Copy)]
pub struct Hampel;

static PARAMS: [Param; 9] = [
    shared::WINDOW.with_paper(None),
    shared::K,
    shared::AROUND_SCALE.with_paper(None),
    shared::EDGE.with_paper(None),
    shared::DETREND.with_paper(None),
    shared::NOISE_FLOOR.with_paper(None),
    shared::MAX_GAP,
    shared::FLOOR,
    shared::DOUBT,
];

static ABOUT: About = About {
    id: "hampel",
    name: "Hampel identifier",
    family: shared::SLIDING_WINDOW,
    source: "beyond (Hampel 1974); the sliding median of [003]",
    advice: "Compares each sample with the median of its window; a flag does not affect other samples, so changing k \
             needs no new computation. Robust against isolated wild points up to nearly half of a \
             window. A window of 21 does not see runs of more than about a third of it: lengthen the window for \
             long runs, shorten it for rapid manoeuvres.",
    params: &PARAMS,
    own: Own::Expected,
    needs_rate: false,
};

impl Method for Hampel {
    fn about(&self) -> &'static About {
        &ABOUT
    }

    fn judge(&self, segment: &Segment<'_>, settings: &Settings, stop: &Stop) -> Result<Judged, Stopped> {
        window::judge(&Rule::of(settings, Center::Median), segment, stop)
    }

    fn gate(&self, settings: &Settings) -> Option<&'static str> {
        window::gate(settings)
    }

    fn filter(&self, _: &Settings) -> Option<&'static dyn Filter> {
        Some(&window::Smooth(Center::Median))
    }

    fn warnings(&self, settings: &Settings) -> Vec<String> {
        window::warnings(settings, Center::Median)
    }
}
