//! Samples to columns: everything of a trace that depends on data, view and size, so that drawing it is a copy.

use std::ops::Range;

use super::dots::{DOTS_PER_COLUMN, Dots};
use super::flags::{FlagState, Flags};
use super::pyramid::{Pyramid, Span};
use super::scale::YScale;
use super::view::{Axis, View};
use super::{marks, stroke};

/// A quantity along the samples, with its extremes.
#[derive(Clone, Copy)]
pub struct Curve<'a> {
    /// The extremes, built by [`Pyramid::build`] or [`Pyramid::build_spans`] from the same values.
    pub pyramid: &'a Pyramid,
    /// The value of a position ([`Span::at`]), or its span for a band; [`Span::EMPTY`] where there is none.
    pub span: &'a dyn Fn(usize) -> Span,
}

/// What a trace shows of one channel.
#[derive(Clone, Copy)]
pub struct Trace<'a> {
    /// Where the samples lie.
    pub axis: Axis<'a>,
    /// Samples nobody has flagged; empty spans at the others.
    pub kept: Curve<'a>,
    /// Flagged and suspect samples.
    pub flags: &'a Flags,
    /// Expected values.
    pub expected: Option<Curve<'a>>,
    /// The spans from expected value minus tolerance to expected value plus tolerance.
    pub band: Option<Curve<'a>>,
    /// Repaired values at the samples that have one; empty spans at the others.
    pub repaired: Option<Curve<'a>>,
    /// The filtered track.
    pub filtered: Option<Curve<'a>>,
    /// Neighbours further apart than this many seconds are not joined; infinity joins all.
    pub gap: f64,
}

/// The part of the plane that is shown, and the cells it is shown on. With revision numbers of the data, the key
/// under which [`Columns`] may be kept.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Grid {
    /// The x range.
    pub view: View,
    /// The y range, lowest and highest value.
    pub y: (f64, f64),
    /// Columns of cells.
    pub width: u16,
    /// Rows of cells.
    pub height: u16,
}

/// The flags of one column of cells.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct ColumnSummary {
    /// Flags of each state, in the order of [`FlagState::ALL`].
    pub counts: [u32; 5],
    /// The most urgent state of the flags above the y range.
    pub above: Option<FlagState>,
    /// The most urgent state of the flags below the y range.
    pub below: Option<FlagState>,
}

impl ColumnSummary {
    /// How many flags there are that are not mere suspects.
    #[must_use]
    pub fn flagged(&self) -> u32 {
        self.counts.iter().sum::<u32>() - self.suspects()
    }

    /// How many suspects there are.
    #[must_use]
    pub fn suspects(&self) -> u32 {
        self.counts[FlagState::Suspect.index()]
    }

    /// The most urgent state there is, suspects only where there is nothing else.
    #[must_use]
    pub fn worst(&self) -> Option<FlagState> {
        let has = |state: &FlagState| self.counts[state.index()] > 0;
        let flagged = FlagState::BY_URGENCY.into_iter().filter(|s| *s != FlagState::Suspect).find(has);
        flagged.or_else(|| has(&FlagState::Suspect).then_some(FlagState::Suspect))
    }
}

/// A trace reduced to the columns and dots of a grid. Cursor, selection and styles are not part of it: they can move
/// while it stays.
#[derive(Debug, Clone, PartialEq)]
pub struct Columns {
    pub(crate) grid: Grid,
    pub(crate) scale: YScale,
    /// First position of each column of dots, and the end of the last one.
    pub(crate) starts: Vec<usize>,
    pub(crate) summaries: Vec<ColumnSummary>,
    /// Columns of cells that lie in a stretch of lost samples.
    pub(crate) gaps: Vec<bool>,
    /// Columns of cells with kept samples above and below the y range.
    pub(crate) raw_beyond: Vec<(bool, bool)>,
    pub(crate) raw: Dots,
    pub(crate) expected: Dots,
    pub(crate) band: Dots,
    pub(crate) repaired: Dots,
    pub(crate) filtered: Dots,
    pub(crate) flag_dots: Dots,
    /// The most urgent flag drawn in each cell, row by row.
    pub(crate) flag_cells: Vec<Option<FlagState>>,
    /// True when flags are so few that each cell with one shows a marker.
    pub(crate) sparse: bool,
}

impl Columns {
    /// Reduces `trace` to `grid`. Nothing is drawn where the view is reversed, empty or not finite.
    #[must_use]
    pub fn new(trace: &Trace<'_>, grid: Grid) -> Self {
        let starts = column_starts(trace.axis, grid.view, grid.width);
        let scale = YScale::new(grid.y.0, grid.y.1, grid.height);
        let stroke = stroke::Stroke::new(trace.axis, grid, &starts, scale, trace.gap);
        let blank = || Dots::new(grid.width, grid.height);
        let [mut raw, mut expected, mut band, mut repaired, mut filtered] = std::array::from_fn(|_| blank());
        let kept = stroke.spans(Some(&trace.kept));
        stroke.draw(&mut raw, Some(&trace.kept), &kept, |span| span);
        let spans = stroke.spans(trace.expected.as_ref());
        stroke.draw(&mut expected, trace.expected.as_ref(), &spans, |span| span);
        let spans = stroke.spans(trace.filtered.as_ref());
        stroke.draw(&mut filtered, trace.filtered.as_ref(), &spans, |span| span);
        let spans = stroke.spans(trace.band.as_ref());
        // The edges of nothing are nothing.
        let edge = |span: Span, value: f64| if span.is_empty() { Span::EMPTY } else { Span::at(value) };
        stroke.draw(&mut band, trace.band.as_ref(), &spans, |span| edge(span, span.high));
        stroke.draw(&mut band, trace.band.as_ref(), &spans, |span| edge(span, span.low));
        stroke.fill(&mut repaired, &stroke.spans(trace.repaired.as_ref()));
        let gaps = stroke.gaps();
        let in_view = starts.first().zip(starts.last()).map_or(0..0, |(&first, &end)| first..end);
        let marks = marks::Marks::new(trace.flags, grid, &starts, scale);
        Self {
            grid,
            scale,
            summaries: marks.summaries,
            gaps,
            raw_beyond: stroke.beyond(&kept),
            raw,
            expected,
            band,
            repaired,
            filtered,
            flag_dots: marks.dots,
            flag_cells: marks.cells,
            sparse: trace.flags.count_in(&in_view) * 3 <= usize::from(grid.width),
            starts,
        }
    }

    /// What it was made for.
    #[must_use]
    pub fn grid(&self) -> Grid {
        self.grid
    }

    /// The y axis.
    #[must_use]
    pub fn scale(&self) -> YScale {
        self.scale
    }

    /// The flags of a column of cells; none outside the grid.
    #[must_use]
    pub fn summary(&self, column: u16) -> ColumnSummary {
        self.summaries.get(usize::from(column)).copied().unwrap_or_default()
    }

    /// The positions in view.
    #[must_use]
    pub fn in_view(&self) -> Range<usize> {
        self.starts.first().zip(self.starts.last()).map_or(0..0, |(&first, &end)| first..end)
    }

    /// The positions in a column of cells; empty outside the grid.
    #[must_use]
    pub fn positions(&self, column: u16) -> Range<usize> {
        let first = usize::from(column) * DOTS_PER_COLUMN;
        match (self.starts.get(first), self.starts.get(first + DOTS_PER_COLUMN)) {
            (Some(&start), Some(&end)) => start..end,
            _ => 0..0,
        }
    }

    /// Whether a column shows selected positions, or is empty between some.
    #[must_use]
    pub fn selects(&self, column: u16, selection: &Range<usize>) -> bool {
        let here = self.positions(column);
        if here.is_empty() {
            return selection.start < here.start && here.start < selection.end;
        }
        here.start.max(selection.start) < here.end.min(selection.end)
    }

    /// The positions in each column of dots, half a column of cells wide, from left to right.
    #[must_use]
    pub fn dot_columns(&self) -> Vec<Range<usize>> {
        self.starts.windows(2).map(|edges| edges[0]..edges[1]).collect()
    }

    /// For each column of cells, whether it lies in a stretch of lost samples.
    #[must_use]
    pub fn gap_columns(&self) -> &[bool] {
        &self.gaps
    }

    /// The flag drawn in a cell.
    pub(crate) fn flag_cell(&self, column: usize, row: usize) -> Option<FlagState> {
        if column >= usize::from(self.grid.width) {
            return None;
        }
        self.flag_cells.get(row * usize::from(self.grid.width) + column).copied().flatten()
    }
}

/// First position of each column of dots over `view`, and the end of the last, which holds the right edge too.
pub(crate) fn column_starts(axis: Axis<'_>, view: View, width: u16) -> Vec<usize> {
    let columns = usize::from(width) * DOTS_PER_COLUMN;
    let span = view.width();
    if columns == 0 || span == 0.0 {
        return vec![0; columns + 1];
    }
    let mut starts = Vec::with_capacity(columns + 1);
    let mut start = axis.first_at(view.from);
    starts.push(start);
    for column in 1..columns {
        let edge = view.from + span * (column as f64 / columns as f64);
        start = axis.first_where(edge, start, |x| x < edge);
        starts.push(start);
    }
    starts.push(axis.first_where(view.to, start, |x| x <= view.to));
    starts
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn suspects_are_counted_apart_and_outranked_by_any_flag() {
        let summary = |counts| ColumnSummary { counts, ..ColumnSummary::default() };
        let mixed = summary([0, 0, 1, 0, 5]);
        assert_eq!((mixed.flagged(), mixed.suspects(), mixed.worst()), (1, 5, Some(FlagState::Rejected)));
        let suspects = summary([0, 0, 0, 0, 2]);
        assert_eq!((suspects.flagged(), suspects.worst()), (0, Some(FlagState::Suspect)));
        assert_eq!(summary([0, 3, 0, 1, 0]).worst(), Some(FlagState::ByHand));
        assert_eq!(summary([0; 5]).worst(), None);
    }

    #[test]
    fn columns_share_out_the_view_with_both_ends() {
        let t = [0.0, 1.0, 2.0, 3.0, 4.0];
        // Four columns of dots over 0 to 4: one sample each, and the last takes the right end too.
        assert_eq!(column_starts(Axis::Time(&t), View { from: 0.0, to: 4.0 }, 2), [0, 1, 2, 3, 5]);
        assert_eq!(column_starts(Axis::Time(&t), View { from: 0.5, to: 3.5 }, 1), [1, 2, 4]);
        assert_eq!(column_starts(Axis::Time(&t), View { from: 3.0, to: 1.0 }, 1), [0, 0, 0]);
    }
}
