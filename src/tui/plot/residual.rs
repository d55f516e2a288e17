//! The residual in units of the scale or the tolerance: each sample where there is room, else the worst of each
//! column.

use std::ops::Range;

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::style::Style;
use ratatui::widgets::Widget;

use super::bars::{Bar, Bars, is_dotted};
use super::columns::Columns;
use super::dots::{DOTS_PER_COLUMN, Dots};
use super::flags::FlagState;
use super::glyphs::Glyphs;
use super::paint::{Paint, right_of_margin};
use super::pyramid::{Pyramid, Span};
use super::scale::YScale;
use crate::method::TIE;
use crate::plot::residual_top;
use crate::track::without_signed_zero;
use crate::tui::theme::Theme;

/// Samples per column of cells up to which each is drawn with its sign.
const SIGNED_UP_TO: usize = 4;

/// Parts of the height at which the threshold may stand before the scale is changed.
const ROOM: std::ops::RangeInclusive<f64> = 0.15..=0.8;

/// The residual widget: the ratio (raw value minus expected value) / unit, with a dotted line at the threshold from
/// which samples are flagged. Where the unit is the scale that the threshold multiplies, turning the threshold moves
/// the line and leaves the rest. Samples without a ratio leave a gap.
#[derive(Clone)]
pub struct ResidualPlot<'a> {
    /// Tells which samples each column holds; the same that the trace above is drawn from.
    pub columns: &'a Columns,
    /// Signed ratio of a position; none where there is nothing to compare with.
    pub ratio: &'a dyn Fn(usize) -> Option<f64>,
    /// The extremes of the ratio, from [`ResidualPlot::pyramid`].
    pub pyramid: &'a Pyramid,
    /// The |ratio| from which a sample is flagged.
    pub threshold: f64,
    /// The ratio at the upper edge; larger ones are cut and marked.
    pub top: f64,
    /// True when heights go with the logarithm of the ratio, so that large ones fit beside the threshold.
    pub log: bool,
    /// Styles.
    pub theme: &'a Theme,
    /// Characters.
    pub glyphs: Glyphs,
    /// Position of the sample under the cursor.
    pub cursor: Option<usize>,
}

impl ResidualPlot<'_> {
    /// A good ratio for the upper edge ([`residual_top`]).
    #[must_use]
    pub fn top_for(threshold: f64) -> f64 {
        residual_top(threshold)
    }

    /// The ratio for the upper edge after another: the same as long as the threshold has room under it and is not
    /// lost at the bottom, so that turning the threshold moves the line and not everything else.
    #[must_use]
    pub fn top_after(held: f64, threshold: f64) -> f64 {
        if ROOM.contains(&(threshold / held)) { held } else { Self::top_for(threshold) }
    }

    /// The extremes of `len` ratios.
    #[must_use]
    pub fn pyramid(len: usize, ratio: impl Fn(usize) -> Option<f64> + Sync) -> Pyramid {
        Pyramid::build_spans(len, |i| span(ratio(i)))
    }

    /// True when each sample is drawn with its sign, false when each column shows its worst.
    #[must_use]
    pub fn is_signed(&self) -> bool {
        self.columns.in_view().len() <= SIGNED_UP_TO * usize::from(self.columns.grid().width)
    }

    /// A tie reaches the threshold.
    fn reaches(&self, ratio: f64) -> bool {
        ratio.abs() >= self.threshold * (1.0 - TIE)
    }

    fn top(&self) -> f64 {
        if self.top > 0.0 && self.top.is_finite() { self.top } else { Self::top_for(self.threshold) }
    }

    /// What the height goes with: the ratio, or a logarithm of it that is even, zero at zero, and nearly the ratio
    /// itself far below the threshold.
    fn height(&self, ratio: f64) -> f64 {
        let unit = self.threshold / 10.0;
        if self.log && unit > 0.0 { ratio.signum() * (ratio.abs() / unit).ln_1p() } else { ratio }
    }

    /// The largest |ratio| of some positions; none when none has a tolerance.
    fn worst(&self, positions: Range<usize>) -> Option<f64> {
        let all = self.pyramid.span_over(|i| span((self.ratio)(i)), positions);
        (!all.is_empty()).then(|| all.high.abs().max(all.low.abs()))
    }

    fn margin(&self, paint: &mut Paint<'_>, scale: YScale) {
        let height = paint.height();
        let top = self.top();
        for row in 0..height {
            paint.margin(row, "", self.glyphs.vertical(), self.theme.dim);
        }
        let bottom = if self.is_signed() { -top } else { 0.0 };
        for value in [bottom, top, 0.0, self.threshold] {
            if let Some(row) = scale.row(self.height(value)) {
                paint.margin(row, &label(value), self.glyphs.tick(), self.theme.dim);
            }
        }
    }

    fn bars(&self, paint: &mut Paint<'_>, scale: YScale) {
        let threshold = scale.row(self.height(self.threshold));
        let cursor = self.cursor.and_then(|position| self.columns.column_of(position));
        let look = Bars { theme: self.theme, glyphs: self.glyphs, line: threshold };
        for column in 0..paint.width().min(self.columns.grid().width) {
            let worst = self.worst(self.columns.positions(column));
            let bar = Bar {
                share: worst.map(|worst| self.height(worst.min(self.top())) / self.height(self.top())),
                over: worst.is_some_and(|worst| self.reaches(worst)),
                beyond: worst.is_some_and(|worst| worst > self.top()),
            };
            look.column(paint, column, bar, cursor == Some(column));
        }
    }

    fn points(&self, paint: &mut Paint<'_>, scale: YScale) {
        let grid = self.columns.grid();
        let (width, height) = (paint.width().min(grid.width), paint.height());
        let mut dots = Dots::new(width, height);
        let mut over = vec![false; usize::from(width) * usize::from(height)];
        let mut beyond = vec![(false, false); usize::from(width)];
        for (dot_column, edges) in self.columns.starts.windows(2).enumerate().take(usize::from(width) * DOTS_PER_COLUMN)
        {
            let column = dot_column / DOTS_PER_COLUMN;
            for ratio in (edges[0]..edges[1]).filter_map(self.ratio) {
                let height = self.height(ratio);
                match scale.row(height) {
                    Some(row) => {
                        dots.set(dot_column as i32, scale.dot_row(height));
                        over[usize::from(row) * usize::from(width) + column] |= self.reaches(ratio);
                    }
                    None => {
                        beyond[column].0 |= ratio > 0.0;
                        beyond[column].1 |= ratio < 0.0;
                    }
                }
            }
        }
        let cursor = self.cursor.and_then(|position| self.columns.column_of(position));
        let lines = [self.threshold, -self.threshold].map(|at| scale.row(self.height(at)));
        for column in 0..width {
            let (above, below) = beyond[usize::from(column)];
            for row in 0..height {
                let (above, below) = (above && row == 0, below && row + 1 == height);
                let mask = dots.mask(usize::from(column), usize::from(row));
                let (glyph, style) = if above || below {
                    (self.glyphs.beyond(above, below), self.theme.over)
                } else if over[usize::from(row) * usize::from(width) + usize::from(column)] {
                    (self.glyphs.flag(FlagState::Unreviewed), self.theme.over)
                } else if mask != 0 {
                    (self.glyphs.dots(mask), self.theme.raw)
                } else if lines.contains(&Some(row)) && is_dotted(column) {
                    (self.glyphs.threshold(), self.theme.threshold)
                } else {
                    (' ', Style::new())
                };
                let look = Bars { theme: self.theme, glyphs: self.glyphs, line: None };
                let (glyph, style) = look.with_cursor(glyph, style, cursor == Some(column));
                paint.put(column, row, glyph, style);
            }
        }
    }
}

/// A ratio in few columns.
pub(super) fn label(value: f64) -> String {
    without_signed_zero(if value.abs() < 1000.0 { format!("{value:.1}") } else { format!("{value:.0}") })
}

fn span(ratio: Option<f64>) -> Span {
    ratio.map_or(Span::EMPTY, Span::at)
}

impl Widget for ResidualPlot<'_> {
    fn render(self, area: Rect, buffer: &mut Buffer) {
        let signed = self.is_signed();
        let area = area.intersection(*buffer.area());
        let top = self.height(self.top());
        let scale = YScale::new(if signed { -top } else { 0.0 }, top, area.height);
        self.margin(&mut Paint::new(buffer, area), scale);
        let mut paint = Paint::new(buffer, right_of_margin(area));
        for row in 0..paint.height() {
            paint.clear_row(row);
        }
        if signed { self.points(&mut paint, scale) } else { self.bars(&mut paint, scale) }
    }
}
