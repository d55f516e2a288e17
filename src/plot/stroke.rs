//! Curves to dots: the extremes of each column of dots, joined into one line that breaks where samples are lost.

use super::columns::{Curve, Grid};
use super::dots::{DOTS_PER_COLUMN, Dots};
use super::pyramid::Span;
use super::scale::YScale;
use super::view::{Axis, View};

/// How far a line is followed out of view for the sample it comes from or goes to.
const OUTSIDE: usize = 64;

/// Draws curves on one grid.
pub(crate) struct Stroke<'a> {
    axis: Axis<'a>,
    view: View,
    starts: &'a [usize],
    scale: YScale,
    gap: f64,
}

impl<'a> Stroke<'a> {
    pub(crate) fn new(axis: Axis<'a>, grid: Grid, starts: &'a [usize], scale: YScale, gap: f64) -> Self {
        Self { axis, view: grid.view, starts, scale, gap }
    }

    /// The span of a curve in each column of dots.
    pub(crate) fn spans(&self, curve: Option<&Curve<'_>>) -> Vec<Span> {
        let Some(curve) = curve else { return Vec::new() };
        self.starts.windows(2).map(|edges| curve.pyramid.span_over(curve.span, edges[0]..edges[1])).collect()
    }

    /// Draws a curve, of whose spans `part` picks the ends that are drawn.
    pub(crate) fn draw(&self, dots: &mut Dots, curve: Option<&Curve<'_>>, spans: &[Span], part: impl Fn(Span) -> Span) {
        let Some(curve) = curve else { return };
        // The column of the last value drawn, with its rows; none at the start and after a gap.
        let mut previous: Option<(usize, i32, i32)> = None;
        let mut broken = false;
        for (column, &span) in spans.iter().enumerate() {
            let start = self.starts[column];
            if start == self.starts[column + 1] {
                continue;
            }
            if self.lost_before(start) {
                (previous, broken) = (None, true);
            }
            let span = part(span);
            if span.is_empty() {
                continue;
            }
            let (top, bottom) = (self.scale.dot_row(span.high), self.scale.dot_row(span.low));
            let (mut fill_top, mut fill_bottom) = (top, bottom);
            match previous {
                Some((last, last_top, last_bottom)) if last + 1 == column => {
                    if last_bottom < top {
                        fill_top = last_bottom + 1;
                    } else if last_top > bottom {
                        fill_bottom = last_top - 1;
                    }
                }
                Some((last, ..)) => self.join(dots, curve, &part, last, column),
                None if !broken => self.enter(dots, curve, &part, column),
                None => {}
            }
            dots.fill(column as i32, fill_top, fill_bottom);
            previous = Some((column, top, bottom));
        }
        if let Some((column, ..)) = previous {
            self.leave(dots, curve, &part, column);
        }
    }

    /// Draws the spans of the columns, not joined.
    pub(crate) fn fill(&self, dots: &mut Dots, spans: &[Span]) {
        for (column, span) in spans.iter().enumerate() {
            if !span.is_empty() {
                dots.fill(column as i32, self.scale.dot_row(span.high), self.scale.dot_row(span.low));
            }
        }
    }

    /// Which columns of cells have values above and below the y range.
    pub(crate) fn beyond(&self, spans: &[Span]) -> Vec<(bool, bool)> {
        let over = |pair: &[Span]| pair.iter().fold(Span::EMPTY, |all, span| all.union(*span));
        let beyond = |span: Span| (span.high > self.scale.high(), span.low < self.scale.low());
        spans.chunks(DOTS_PER_COLUMN).map(|pair| beyond(over(pair))).collect()
    }

    /// Which columns of cells lie in a stretch of lost samples.
    pub(crate) fn gaps(&self) -> Vec<bool> {
        let mut lost = vec![false; self.starts.len().saturating_sub(1)];
        let mut first_empty = 0;
        for column in 0..lost.len() {
            let start = self.starts[column];
            if start < self.starts[column + 1] {
                lost[first_empty..column].fill(self.lost_before(start));
                first_empty = column + 1;
            }
        }
        let after = self.starts.last().copied().unwrap_or(0);
        let lost_at_end = self.view.width() > 0.0 && after < self.axis.len() && self.lost_before(after);
        lost[first_empty..].fill(lost_at_end);
        lost.chunks(DOTS_PER_COLUMN).map(|pair| pair.iter().all(|lost| *lost)).collect()
    }

    /// True when samples are lost between this sample and the one before it.
    fn lost_before(&self, position: usize) -> bool {
        let t = self.axis.times();
        position > 0 && position < t.len() && t[position] - t[position - 1] > self.gap
    }

    /// A line over empty columns, from the last value of one column to the first of another.
    fn join(&self, dots: &mut Dots, curve: &Curve<'_>, part: &impl Fn(Span) -> Span, from: usize, to: usize) {
        let value = |position: usize| (curve.span)(position);
        let last = (self.starts[from]..self.starts[from + 1]).rev().map(value).find(|span| !span.is_empty());
        let first = (self.starts[to]..self.starts[to + 1]).map(value).find(|span| !span.is_empty());
        if let (Some(a), Some(b)) = (last, first) {
            dots.line(self.point(from, part(a)), self.point(to, part(b)));
        }
    }

    /// The line that comes into view from the left.
    fn enter(&self, dots: &mut Dots, curve: &Curve<'_>, part: &impl Fn(Span) -> Span, column: usize) {
        let value = |position: usize| (curve.span)(position);
        let range = self.starts[column]..self.starts[column + 1];
        let Some(first) = range.clone().map(value).find(|span| !span.is_empty()) else { return };
        let outside = self.starts[0];
        let near = (outside.saturating_sub(OUTSIDE)..outside).rev();
        let joined = near.take_while(|&i| !self.lost_before(i + 1));
        if let Some((position, span)) = joined.map(|i| (i, value(i))).find(|(_, span)| !span.is_empty()) {
            dots.line(self.outside(position, part(span)), self.point(column, part(first)));
        }
    }

    /// The line that goes out of view to the right.
    fn leave(&self, dots: &mut Dots, curve: &Curve<'_>, part: &impl Fn(Span) -> Span, column: usize) {
        let value = |position: usize| (curve.span)(position);
        let range = self.starts[column]..self.starts[column + 1];
        let Some(last) = range.rev().map(value).find(|span| !span.is_empty()) else { return };
        let outside = self.starts[self.starts.len() - 1];
        let near = outside..(outside + OUTSIDE).min(self.axis.len().min(curve.pyramid.len()));
        let joined = near.take_while(|&i| !self.lost_before(i));
        if let Some((position, span)) = joined.map(|i| (i, value(i))).find(|(_, span)| !span.is_empty()) {
            dots.line(self.point(column, part(last)), self.outside(position, part(span)));
        }
    }

    /// The middle of the dot of a value in a column of dots.
    fn point(&self, column: usize, span: Span) -> (f64, f64) {
        (column as f64 + 0.5, self.depth(span.low))
    }

    /// Where a sample out of view lies.
    fn outside(&self, position: usize, span: Span) -> (f64, f64) {
        let share = (self.axis.x(position) - self.view.from) / self.view.width();
        (share * (self.starts.len() - 1) as f64, self.depth(span.low))
    }

    fn depth(&self, y: f64) -> f64 {
        // The middle of the dot, so that the line ends on the dot that the value has.
        if self.scale.shows(y) { f64::from(self.scale.dot_row(y)) + 0.5 } else { self.scale.depth(y) }
    }
}
