//! The sliding mean: each sample against the mean of the window around it.

use super::window::{self, Center, Rule};
use super::{About, Filter, Judged, Method, Own, Segment, shared};
use crate::param::{Param, Settings};
use crate::stop::{Stop, Stopped};

/// The method `mean-window` of section 3 of `docs/methods.md`.
#[derive(Debug, Clone, Copy)]
pub struct MeanWindow;

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
    id: "mean-window",
    name: "sliding mean",
    family: shared::SLIDING_WINDOW,
    source: "[003] eq. (1), sliding mean",
    advice: "Compares each sample with the mean of its window. [003] finds it as good as the median at windows of about 10 and the steadiest at 20; at 200 it misses isolated wild points. A mean follows the wild points in its window, so runs shift it: prefer median-window where there are runs of outliers.",
    params: &PARAMS,
    own: Own::Expected,
    needs_rate: false,
};

impl Method for MeanWindow {
    fn about(&self) -> &'static About {
        &ABOUT
    }

    fn judge(&self, segment: &Segment<'_>, settings: &Settings, stop: &Stop) -> Result<Judged, Stopped> {
        window::judge(&Rule::of(settings, Center::Mean), segment, stop)
    }

    fn gate(&self, settings: &Settings) -> Option<&'static str> {
        window::gate(settings)
    }

    fn filter(&self, _: &Settings) -> Option<&'static dyn Filter> {
        Some(&window::Smooth(Center::Mean))
    }

    fn warnings(&self, settings: &Settings) -> Vec<String> {
        window::warnings(settings, Center::Mean)
    }
}
