//! The sliding median: each sample against the median of the window around it.

use super::window::{self, Center, Rule};
use super::{About, Filter, Judged, Method, Own, Segment, shared};
use crate::param::{Param, Settings};
use crate::stop::{Stop, Stopped};

/// The method `median-window` of section 3 of `docs/methods.md`.
#[derive(Debug, Clone, Copy)]
pub struct MedianWindow;

static PARAMS: [Param; 10] = [
    shared::WINDOW,
    shared::K,
    shared::AROUND_SCALE,
    shared::FEEDBACK,
    shared::EDGE,
    shared::DETREND,
    shared::NOISE_FLOOR,
    shared::MAX_GAP,
    shared::FLOOR,
    shared::DOUBT,
];

static ABOUT: About = About {
    id: "median-window",
    name: "sliding median",
    family: shared::SLIDING_WINDOW,
    source: "[003] eq. (1), sliding median",
    advice: "Compares each sample with the median of its window and replaces a flagged one before the window moves on. Of the four methods of [003] it has small errors (in its table 1 the smallest at windows of 10 to 100; at 7 and 8 the mean's are smaller) and copes with isolated wild points and runs; 10 or 20 samples are usual there. A window of 21 does not see runs of more than about a third of it.",
    params: &PARAMS,
    own: Own::Expected,
    needs_rate: false,
};

impl Method for MedianWindow {
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
