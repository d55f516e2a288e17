//! The histogram of the residuals: what the threshold cuts off, and how far the wild points lie from the rest.

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::widgets::Widget;

use super::bars::{Bar, Bars};
use super::flags::FlagState;
use super::glyphs::Glyphs;
use super::paint::{Paint, right_of_margin};
use super::residual::label;
use crate::plot::{Histogram, Tally};
use crate::tui::theme::Theme;

/// The histogram widget: the residuals of the whole record from edge to edge, the thresholds as vertical lines, the
/// residuals under them in the last row. A column with an outlier has the colour of one and a mark above its bar;
/// what lies beyond an edge is marked in its corner.
#[derive(Clone)]
pub struct HistogramPlot<'a> {
    /// The counts.
    pub histogram: &'a Histogram,
    /// The |residual| from which a sample is flagged.
    pub threshold: f64,
    /// True when heights go with the logarithm of the counts.
    pub log: bool,
    /// The residual of the sample under the cursor.
    pub cursor: Option<f64>,
    /// Styles.
    pub theme: &'a Theme,
    /// Characters.
    pub glyphs: Glyphs,
}

impl HistogramPlot<'_> {
    fn share(&self, count: u32, most: u32) -> Option<f64> {
        let (count, most) = (f64::from(count), f64::from(most));
        let share = if self.log { count.ln_1p() / most.ln_1p() } else { count / most };
        (count > 0.0).then_some(share)
    }

    fn bars(&self, paint: &mut Paint<'_>, columns: &[Tally], most: u32) {
        let (width, height) = (paint.width(), paint.height());
        let cursor = self.cursor.and_then(|r| self.histogram.column_of(r, width));
        let lines = [-self.threshold, self.threshold].map(|r| self.histogram.column_of(r, width));
        let look = Bars { theme: self.theme, glyphs: self.glyphs, line: None };
        let mark = self.glyphs.flag(FlagState::Unreviewed);
        for (column, tally) in (0..width).zip(columns) {
            let over = tally.flagged > 0;
            let share = self.share(tally.all, most);
            look.column(paint, column, Bar { share, over, beyond: false }, cursor == Some(column));
            let top = share.map_or(0, |share| (share * f64::from(height)).ceil().max(1.0) as u16);
            if lines.contains(&Some(column)) && cursor != Some(column) {
                (0..height - top.min(height)).for_each(|row| {
                    paint.put(column, row, self.glyphs.vertical(), self.theme.threshold);
                });
            }
            if over {
                // Above the bar, or in place of its top where it fills the height.
                paint.put(column, height.saturating_sub(top + 1), mark, self.theme.over);
            }
        }
        let corners = [(self.histogram.below, 0, '<'), (self.histogram.above, width.saturating_sub(1), '>')];
        for (tally, column, glyph) in corners.into_iter().filter(|(tally, ..)| tally.all > 0) {
            let style = if tally.flagged > 0 { self.theme.over } else { self.theme.warning };
            paint.put(column, 0, glyph, style);
        }
    }

    fn labels(&self, paint: &mut Paint<'_>) {
        let (width, top) = (paint.width(), self.histogram.top());
        paint.clear_row(0);
        let mut taken: Vec<(usize, usize)> = Vec::new();
        // The thresholds first: they are what the picture is about.
        for value in [-self.threshold, self.threshold, 0.0, -top, top] {
            let Some(column) = self.histogram.column_of(value, width) else { continue };
            let text = label(value);
            let start = usize::from(column).saturating_sub(text.len() / 2);
            let start = start.min(usize::from(width).saturating_sub(text.len()));
            let end = start + text.len();
            if end <= usize::from(width) && taken.iter().all(|&(a, b)| end < a || start > b) {
                paint.text(start as u16, 0, &text, self.theme.dim);
                taken.push((start, end));
            }
        }
    }
}

impl Widget for HistogramPlot<'_> {
    fn render(self, area: Rect, buffer: &mut Buffer) {
        let area = area.intersection(*buffer.area());
        let rows = if area.height >= 3 { area.height - 1 } else { area.height };
        let bars = Rect { height: rows, ..area };
        let columns = self.histogram.columns(right_of_margin(area).width);
        let most = columns.iter().map(|tally| tally.all).max().unwrap_or(0);
        let mut paint = Paint::new(buffer, bars);
        for row in 0..rows {
            let (text, edge) = match row {
                0 if most > 0 => (most.to_string(), self.glyphs.tick()),
                _ if row + 1 == rows && rows > 1 => ("0".to_owned(), self.glyphs.tick()),
                _ => (String::new(), self.glyphs.vertical()),
            };
            paint.margin(row, if text.len() < 8 { &text } else { "" }, edge, self.theme.dim);
        }
        self.bars(&mut Paint::new(buffer, right_of_margin(bars)), &columns, most);
        if rows < area.height {
            let row = Rect { y: area.y + rows, height: 1, ..area };
            Paint::new(buffer, row).clear_row(0);
            self.labels(&mut Paint::new(buffer, right_of_margin(row)));
        }
    }
}
