//! Flags to cells: which cells hold a flag, which columns have some beyond the edges, and how many there are.

use std::ops::Range;

use super::columns::{ColumnSummary, Grid};
use super::dots::{DOTS_PER_COLUMN, Dots};
use super::flags::{FlagList, FlagState, Flags};
use super::pyramid::{Span, Visitor};
use super::scale::{DOTS_PER_ROW, YScale};

/// Flags of a grid.
pub(crate) struct Marks {
    pub(crate) summaries: Vec<ColumnSummary>,
    pub(crate) dots: Dots,
    /// The most urgent flag of each cell, row by row.
    pub(crate) cells: Vec<Option<FlagState>>,
    width: usize,
    scale: YScale,
}

impl Marks {
    pub(crate) fn new(flags: &Flags, grid: Grid, starts: &[usize], scale: YScale) -> Self {
        let width = usize::from(grid.width);
        let mut marks = Self {
            summaries: vec![ColumnSummary::default(); width],
            dots: Dots::new(grid.width, grid.height),
            cells: vec![None; width * usize::from(grid.height)],
            width,
            scale,
        };
        // The most urgent first: a cell once claimed keeps its state.
        for state in FlagState::BY_URGENCY {
            let list = flags.list(state);
            if !list.positions.is_empty() {
                marks.add(state, list, starts);
            }
        }
        marks
    }

    fn add(&mut self, state: FlagState, list: &FlagList, starts: &[usize]) {
        let mut first = list.within(&(0..starts[0])).end;
        for (column, edges) in starts.windows(2).enumerate() {
            let end = first + before(&list.positions[first..], edges[1]);
            self.summaries[column / DOTS_PER_COLUMN].counts[state.index()] += (end - first) as u32;
            self.mark(state, list, first..end, column);
            first = end;
        }
    }

    fn mark(&mut self, state: FlagState, list: &FlagList, flags: Range<usize>, column: usize) {
        if flags.is_empty() {
            return;
        }
        let mut marker = Marker {
            state,
            list,
            column,
            summary: &mut self.summaries[column / DOTS_PER_COLUMN],
            dots: &mut self.dots,
            cells: &mut self.cells,
            width: self.width,
            scale: self.scale,
        };
        list.pyramid.walk(flags, &mut marker);
    }
}

/// Marks the flags of one state in one column of dots.
struct Marker<'m> {
    state: FlagState,
    list: &'m FlagList,
    column: usize,
    summary: &'m mut ColumnSummary,
    dots: &'m mut Dots,
    cells: &'m mut [Option<FlagState>],
    width: usize,
    scale: YScale,
}

impl Marker<'_> {
    fn cell(&self, dot_row: i32) -> usize {
        dot_row as usize / DOTS_PER_ROW * self.width + self.column / DOTS_PER_COLUMN
    }

    fn mark(&mut self, y: f64) {
        if self.scale.shows(y) {
            let row = self.scale.dot_row(y);
            self.dots.set(self.column as i32, row);
            let cell = self.cell(row);
            self.cells[cell].get_or_insert(self.state);
        } else if y > self.scale.high() {
            self.summary.above.get_or_insert(self.state);
        } else if y < self.scale.low() {
            self.summary.below.get_or_insert(self.state);
        }
    }
}

impl Marker<'_> {
    /// Would a flag somewhere in this span claim a new cell? (What is out of range shows by the ends of the span.)
    fn is_open(&self, span: Span) -> bool {
        let top = self.scale.dot_row(span.high).max(0);
        let bottom = self.scale.dot_row(span.low).min(self.scale.rows() - 1);
        top <= bottom && (self.cell(top)..=self.cell(bottom)).step_by(self.width).any(|cell| self.cells[cell].is_none())
    }
}

impl Visitor for Marker<'_> {
    /// A node whose cells are all claimed already has nothing to add but dots, of which its extremes stand for all:
    /// millions of flags cost little more than the cells they fill.
    fn enter(&mut self, span: Span) -> bool {
        if span.is_empty() {
            return false;
        }
        let open = self.is_open(span);
        if !open {
            self.mark(span.low);
            self.mark(span.high);
        }
        open
    }

    fn enter_block(&mut self, block: usize, span: Span) -> bool {
        if span.is_empty() {
            return false;
        }
        let (lower, upper) = self.list.inner[block];
        let open =
            self.is_open(Span { low: span.low, high: lower }) || self.is_open(Span { low: upper, high: span.high });
        if !open {
            [span.low, lower, upper, span.high].into_iter().for_each(|y| self.mark(y));
        }
        open
    }

    fn visit(&mut self, position: usize) {
        self.mark(self.list.y[position]);
    }
}

/// How many of the sorted positions lie before `end`, by a search that widens from the front.
fn before(positions: &[u32], end: usize) -> usize {
    let mut width = 16;
    while width < positions.len() && (positions[width] as usize) < end {
        width *= 4;
    }
    positions[..(width + 1).min(positions.len())].partition_point(|&p| (p as usize) < end)
}

#[cfg(test)]
mod tests {
    use super::super::flags::Flag;
    use super::super::view::View;
    use super::*;

    /// 60 000 flags in two bands, and one in a thousand somewhere else, maybe out of range: nodes of every level are
    /// skipped, and none may be that holds something new. The twin looks at every flag.
    #[test]
    fn cells_and_arrows_are_those_of_a_plain_pass_over_all_flags() {
        let mut state = 7_u64;
        let mut random = move || {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            (state >> 33) as f64 / f64::from(1_u32 << 31)
        };
        let flags: Vec<Flag> = (0..60_000_u32)
            .map(|position| {
                let band = if random() < 0.5 { 2.0 + random() } else { -2.0 - random() };
                let y = if random() < 0.001 { 12.0 * random() - 6.0 } else { band };
                let state = if random() < 0.9 { FlagState::Accepted } else { FlagState::ByHand };
                Flag { position, y, state }
            })
            .collect();
        let scale = YScale::new(-5.0, 5.0, 20);
        let grid = Grid { view: View { from: 0.0, to: 1.0 }, y: (-5.0, 5.0), width: 3, height: 20 };
        for starts in [[0, 100, 9_000, 9_500, 20_001, 40_000, 60_000], [5, 5, 5, 30_000, 30_001, 59_990, 59_999]] {
            let marks = Marks::new(&Flags::new(&flags), grid, &starts, scale);
            let mut cells = vec![None; 60];
            let mut summaries = vec![ColumnSummary::default(); 3];
            for state in FlagState::BY_URGENCY {
                for flag in flags.iter().filter(|flag| flag.state == state) {
                    let position = flag.position as usize;
                    if !(starts[0]..starts[6]).contains(&position) {
                        continue;
                    }
                    let column = (0..6).rev().find(|&c| starts[c] <= position).unwrap_or(0) / 2;
                    let summary: &mut ColumnSummary = &mut summaries[column];
                    summary.counts[state.index()] += 1;
                    match scale.row(flag.y) {
                        Some(row) => cells[usize::from(row) * 3 + column].get_or_insert(state),
                        None if flag.y > 0.0 => summary.above.get_or_insert(state),
                        None => summary.below.get_or_insert(state),
                    };
                }
            }
            assert_eq!(marks.summaries, summaries);
            assert_eq!(marks.cells, cells);
        }
    }
}
