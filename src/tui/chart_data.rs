//! The picture of a channel: its samples and its result on the way to the columns of a plot. `view` draws it, and
//! `update` asks it what is on the screen.

use std::sync::Arc;

use super::model::{ChannelState, Model, YMode};
use super::plot::{Axis, Columns, Curve, Flags, Grid, Layers, Memo, Pyramid, Span, Trace, View, YFit};
use crate::method::shared::MAX_GAP;
use crate::plot::{Drawn, FilteredTrack, StepColumn, Steps};
use crate::score::Score;
use crate::track::Series;

/// What was reduced for the last frame, for the next one, which mostly shows the same.
#[derive(Debug, Default)]
pub struct Pictures {
    overview: Memo<Key, Columns>,
    trace: Memo<Key, Columns>,
    rail: Memo<Key, Columns>,
    second: Memo<Key, Columns>,
    /// The samples while there is no result yet.
    plain: Memo<(), Pyramid>,
    steps: Memo<(), Steps>,
    score: Memo<u64, Score>,
}

/// All that columns are made of.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Key {
    result: u64,
    layers: Layers,
    after: bool,
    /// Whether there is a filtered track to draw.
    filtered: bool,
    by_number: bool,
    view: View,
    fit: YFit,
    size: (u16, u16),
    gap: f64,
}

/// A channel of the model as it is drawn.
pub(super) struct Picture<'a> {
    state: &'a ChannelState,
    drawn: Option<&'a Drawn>,
    by_number: bool,
    gap: f64,
    max_gap: Option<usize>,
    seconds: &'a [f64],
    no_flags: Flags,
    /// Its present samples.
    pub(super) series: Series<'a>,
}

impl<'a> Picture<'a> {
    /// The picture of the channel of a plan.
    pub(super) fn of(model: &'a Model, plan: usize) -> Self {
        let state = &model.channels[plan];
        let series = state.samples.series(&model.track.channels[state.channel], &model.track.time);
        // Neighbours further apart than this are not joined: the record is cut there.
        let limit = model.session.plans[plan].setup.settings.whole_or_off(MAX_GAP.key);
        let gap = series.longest_step(limit);
        let (drawn, by_number, seconds) = (state.drawn.as_deref(), model.by_number, &model.track.time.seconds);
        Self { state, drawn, by_number, gap, max_gap: limit, seconds, no_flags: Flags::default(), series }
    }

    /// Where the samples lie along x.
    pub(super) fn axis(&self) -> Axis<'_> {
        if self.by_number { Axis::Position(&self.series.t) } else { Axis::Time(&self.series.t) }
    }

    /// The trace in view with the layers that are on.
    pub(super) fn trace(&self, size: (u16, u16)) -> Arc<Columns> {
        let key = self.key(self.state.layers, self.state.view, self.fit(), size);
        self.columns(&self.state.pictures.trace, Key { after: self.state.after, ..key })
    }

    /// The trace over the x range of another channel, by time.
    pub(super) fn beside(&self, other: &Self, size: (u16, u16)) -> Arc<Columns> {
        let mut view = other.state.view;
        if self.by_number {
            view = view.on_other(other.axis()).on_other(self.axis().other());
        }
        self.columns(&self.state.pictures.second, self.key(self.state.layers, view, self.fit(), size))
    }

    /// The flags over the same x range, when the trace shows the record after repair, without them.
    pub(super) fn rail(&self, width: u16) -> Arc<Columns> {
        self.columns(&self.state.pictures.rail, self.key(Layers::NONE, self.state.view, YFit::Kept, (width, 1)))
    }

    /// The whole record: the curve and its flags.
    pub(super) fn overview(&self, size: (u16, u16)) -> Arc<Columns> {
        let whole = View::whole(self.axis());
        self.columns(&self.state.pictures.overview, self.key(Layers::NONE, whole, YFit::Kept, size))
    }

    /// The steps of time of the whole channel.
    pub(super) fn steps(&self) -> Arc<Steps> {
        self.state.pictures.steps.get((), || Steps::of(&self.series, self.seconds))
    }

    /// The steps of time in each of some columns.
    pub(super) fn step_columns(&self, columns: &Columns) -> Vec<StepColumn> {
        self.steps().columns(columns, &self.series, self.max_gap)
    }

    /// The result against the truth; none without a result.
    pub(super) fn score(&self, truth: &[bool]) -> Option<Arc<Score>> {
        let outcome = &self.drawn?.outcome;
        Some(self.state.pictures.score.get(self.state.results, || Score::of(outcome, &self.series, truth)))
    }

    /// The y range of the trace.
    pub(super) fn y_range(&self) -> (f64, f64) {
        self.with_trace(self.state.layers, self.state.after, |trace| self.fit().range(trace, self.state.view))
    }

    fn fit(&self) -> YFit {
        match self.state.y_fit {
            YMode::Kept => YFit::Kept,
            YMode::All => YFit::All,
            YMode::Robust => YFit::Robust,
            YMode::Fixed(low, high) => YFit::Fixed(low, high),
        }
    }

    fn key(&self, layers: Layers, view: View, fit: YFit, size: (u16, u16)) -> Key {
        let (result, by_number, gap) = (self.state.results, self.by_number, self.gap);
        Key { result, layers, after: false, filtered: self.filtered().is_some(), by_number, view, fit, size, gap }
    }

    /// The filtered track of the result, where it has been worked out.
    fn filtered(&self) -> Option<&FilteredTrack> {
        self.state.smoothed.as_ref()?.track_of(self.state.results)
    }

    fn columns(&self, memo: &Memo<Key, Columns>, key: Key) -> Arc<Columns> {
        memo.get(key, || {
            self.with_trace(key.layers, key.after, |trace| {
                let (y, (width, height)) = (key.fit.range(trace, key.view), key.size);
                Columns::new(trace, Grid { view: key.view, y, width, height })
            })
        })
    }

    /// The sample that a cell of a trace points at: the nearest flag at most `near` columns away, else the sample that
    /// is drawn nearest to the cell. `after` when the trace shows the record after repair, without flags.
    pub(super) fn pointed(
        &self,
        columns: &Columns,
        after: bool,
        (column, row): (u16, u16),
        near: u16,
    ) -> Option<usize> {
        let size = (columns.grid().width, columns.grid().height);
        let (first, last) = (column.saturating_sub(near), column.saturating_add(near).min(size.0.saturating_sub(1)));
        let mut cells: Vec<(u16, u16)> = (first..=last).flat_map(|c| (0..size.1).map(move |r| (c, r))).collect();
        // A cell is about twice as high as it is wide.
        cells.sort_by_key(|(c, r)| c.abs_diff(column) + 2 * r.abs_diff(row));
        let flags = if after { &self.no_flags } else { &self.state.flags };
        let flag = cells.into_iter().find_map(|(c, r)| columns.flag_at(flags, c, r));
        flag.or_else(|| self.with_trace(self.state.layers, after, |trace| columns.sample_at(trace, column, row)))
            .or_else(|| columns.position_at(self.axis(), column))
    }

    /// The first flag in a column of the rail, the most urgent state first.
    pub(super) fn first_flag(&self, size: (u16, u16), column: u16) -> Option<usize> {
        self.trace(size).flag_in(&self.state.flags, column)
    }

    /// Calls `draw` with the trace that these layers make.
    fn with_trace<R>(&self, layers: Layers, after: bool, draw: impl FnOnce(&Trace<'_>) -> R) -> R {
        let y = &self.series.y;
        let (axis, gap) = (self.axis(), self.gap);
        let Some(d) = self.drawn else {
            let plain = self.state.pictures.plain.get((), || Pyramid::build(y, |_| false));
            let span = |i: usize| y.get(i).copied().map_or(Span::EMPTY, Span::at);
            let (kept, flags) = (Curve { pyramid: &plain, span: &span }, &self.no_flags);
            return draw(&Trace { axis, kept, flags, expected: None, band: None, repaired: None, filtered: None, gap });
        };
        let kept = |i: usize| d.kept_span(&self.series, i);
        let whole = |i: usize| d.after_span(&self.series, i);
        let expected = |i: usize| d.expected_span(i);
        let band = |i: usize| d.band_span(i);
        let repaired = |i: usize| d.repaired_span(i);
        if after {
            let kept = Curve { pyramid: &d.after, span: &whole };
            let repaired = Some(Curve { pyramid: &d.repaired, span: &repaired });
            return draw(&Trace {
                axis,
                kept,
                flags: &self.no_flags,
                expected: None,
                band: None,
                repaired,
                filtered: None,
                gap,
            });
        }
        let filtered = self.filtered();
        let smooth = |i: usize| filtered.map_or(Span::EMPTY, |track| track.span(i));
        let with = |on: bool, pyramid, span| on.then_some(Curve { pyramid, span });
        draw(&Trace {
            axis,
            kept: Curve { pyramid: &d.kept, span: &kept },
            flags: &self.state.flags,
            expected: with(layers.expected, &d.expected, &expected),
            band: with(layers.band, &d.band, &band),
            repaired: with(layers.repaired, &d.repaired, &repaired),
            filtered: filtered
                .zip(layers.filtered.then_some(()))
                .map(|(track, ())| Curve { pyramid: &track.pyramid, span: &smooth }),
            gap,
        })
    }
}
