//! Cells back to samples, for the mouse and the cursor. Columns and rows count from the upper left cell of the plot.

use super::columns::{Columns, Trace};
use super::flags::{FlagState, Flags};
use super::view::Axis;

impl Columns {
    /// The column of cells in which a sample is drawn; none when it is out of view.
    #[must_use]
    pub fn column_of(&self, position: usize) -> Option<u16> {
        if !self.in_view().contains(&position) {
            return None;
        }
        let dot_column = self.starts.partition_point(|&start| start <= position) - 1;
        u16::try_from(dot_column / super::dots::DOTS_PER_COLUMN).ok()
    }

    /// The sample to put the cursor on for a column: the middle one of those drawn in it, else the nearest in the
    /// record. None when there is no sample, or the column is outside the grid.
    #[must_use]
    pub fn position_at(&self, axis: Axis<'_>, column: u16) -> Option<usize> {
        let grid = self.grid();
        if column >= grid.width || axis.is_empty() || grid.view.width() == 0.0 {
            return None;
        }
        let here = self.positions(column);
        if !here.is_empty() {
            return Some(here.start + here.len() / 2);
        }
        let x = grid.view.from + grid.view.width() * ((f64::from(column) + 0.5) / f64::from(grid.width));
        let next = here.start.min(axis.len() - 1);
        let last = here.start.saturating_sub(1).min(next);
        Some(if x - axis.x(last) < axis.x(next) - x { last } else { next })
    }

    /// The most urgent flag that is drawn in a cell, or that its arrow stands for; the first of several.
    #[must_use]
    pub fn flag_at(&self, flags: &Flags, column: u16, row: u16) -> Option<usize> {
        let range = self.positions(column);
        let height = self.grid().height;
        let found = |y: f64| {
            self.scale.row(y) == Some(row)
                || (row == 0 && y > self.scale.high())
                || (row + 1 == height && y < self.scale.low())
        };
        FlagState::BY_URGENCY.into_iter().find_map(|state| {
            let list = flags.list(state);
            list.within(&range).find(|&i| found(list.y[i])).map(|i| list.positions[i] as usize)
        })
    }

    /// The first flag of a column, the most urgent state first: what a click on the rail means.
    #[must_use]
    pub fn flag_in(&self, flags: &Flags, column: u16) -> Option<usize> {
        let range = self.positions(column);
        let first = |state| flags.list(state).within(&range).next().map(|i| flags.list(state).positions[i] as usize);
        FlagState::BY_URGENCY.into_iter().find_map(first)
    }

    /// The kept sample of a column that is drawn nearest to a cell: in it, if one is.
    #[must_use]
    pub fn sample_at(&self, trace: &Trace<'_>, column: u16, row: u16) -> Option<usize> {
        let height = i32::from(self.grid().height);
        let distance = |y: f64| match self.scale.row(y) {
            Some(at) => (i32::from(at) - i32::from(row)).abs(),
            None if y > self.scale.high() => i32::from(row) + 1,
            None => height - i32::from(row),
        };
        let kept = self.positions(column).filter_map(|i| {
            let span = (trace.kept.span)(i);
            (!span.is_empty()).then_some((i, span.low))
        });
        kept.min_by_key(|&(_, y)| distance(y)).map(|(i, _)| i)
    }
}
