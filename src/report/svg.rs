//! Pictures of a channel in SVG, from the same columns as those of the screen: a flag is never hidden.

use crate::method::Filtered;
use crate::method::shared::MAX_GAP;
use crate::plot::{Axis, Curve, Drawn, FilteredTrack, FlagState, Flags, Span, Trace, View};
use crate::session::Outcome;
use crate::stop::Stop;
use crate::track::{Channel, Series, TimeAxis, Track};

mod axes;
mod chart;
mod close;
mod curve;
mod histogram;
mod marks;
mod picture;

pub(super) use chart::{CURVES, chart};
pub(super) use marks::STATES;

/// A picture with the words under it.
#[derive(Debug)]
pub(super) struct Figure {
    /// What it shows, as text.
    pub(super) caption: String,
    /// The `svg` element; its classes are styled by the page around it.
    pub(super) svg: String,
    /// True for one of several small pictures that stand side by side.
    pub(super) small: bool,
}

/// Size of a picture in units of the SVG.
#[derive(Debug, Clone, Copy)]
struct Size {
    width: u16,
    height: u16,
}

/// What all pictures of a channel share.
struct Subject<'a> {
    time: &'a TimeAxis,
    /// Name of the channel, with its unit.
    channel: String,
    series: Series<'a>,
    drawn: Drawn,
    flags: Flags,
    filtered: Option<FilteredTrack>,
    /// Neighbours further apart than this many seconds are not joined.
    gap: f64,
}

/// The pictures of a channel.
#[derive(Debug, Default)]
pub(super) struct Pictures {
    /// Overview, trace, residual before and after repair, histogram, and the largest flags close up.
    pub(super) figures: Vec<Figure>,
    /// How many of the events are shown close up; empty when all are.
    pub(super) close: String,
}

/// The pictures of a channel, with its filtered track where it is given.
pub(super) fn figures(
    track: &Track,
    channel: &Channel,
    series: Series<'_>,
    outcome: &Outcome,
    filtered: Option<&Filtered>,
) -> Pictures {
    if series.is_empty() {
        return Pictures::default();
    }
    // Nobody stops it.
    let Ok(drawn) = Drawn::new(outcome.clone(), &series, None, &Stop::never()) else { return Pictures::default() };
    let flags = Flags::new(&drawn.flags(&series));
    let filtered = filtered.and_then(|values| FilteredTrack::new(values.clone(), &Stop::never()).ok());
    let gap = series.longest_step(outcome.detection.setup.settings.whole_or_off(MAX_GAP.key));
    let unit = if channel.unit.is_empty() { String::new() } else { format!(" [{}]", channel.unit) };
    let channel = format!("{}{unit}", channel.name);
    let subject = Subject { time: &track.time, channel, series, drawn, flags, filtered, gap };
    let mut figures = vec![
        picture::overview(&subject),
        picture::trace(&subject),
        picture::residual(&subject),
        picture::residual_after(&subject),
        histogram::histogram(&subject),
    ];
    let (close, words) = close::largest(&subject);
    figures.extend(close);
    Pictures { figures, close: words }
}

impl Subject<'_> {
    fn axis(&self) -> Axis<'_> {
        Axis::Time(&self.series.t)
    }

    fn whole(&self) -> View {
        View::whole(self.axis())
    }

    /// Calls `with` with the trace of the channel, as the screen draws it.
    fn with_trace<R>(&self, with: impl FnOnce(&Trace<'_>) -> R) -> R {
        let d = &self.drawn;
        let kept = |i: usize| d.kept_span(&self.series, i);
        let expected = |i: usize| d.expected_span(i);
        let band = |i: usize| d.band_span(i);
        let repaired = |i: usize| d.repaired_span(i);
        let smooth = |i: usize| self.filtered.as_ref().map_or(Span::EMPTY, |track| track.span(i));
        with(&Trace {
            axis: self.axis(),
            kept: Curve { pyramid: &d.kept, span: &kept },
            flags: &self.flags,
            expected: Some(Curve { pyramid: &d.expected, span: &expected }),
            band: Some(Curve { pyramid: &d.band, span: &band }),
            repaired: Some(Curve { pyramid: &d.repaired, span: &repaired }),
            filtered: self.filtered.as_ref().map(|track| Curve { pyramid: &track.pyramid, span: &smooth }),
            gap: self.gap,
        })
    }

    /// Flags in a range of positions with their values.
    fn flags_in(&self, positions: &std::ops::Range<usize>) -> Vec<(usize, FlagState)> {
        let marks = &self.drawn.outcome.marks;
        let from = marks.partition_point(|m| (m.position as usize) < positions.start);
        let to = marks.partition_point(|m| (m.position as usize) < positions.end);
        let of = |m: &crate::session::Mark| crate::plot::state(m).map(|state| (m.position as usize, state));
        marks[from..to].iter().filter_map(of).collect()
    }
}

#[cfg(test)]
mod tests;
