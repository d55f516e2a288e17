//! Share of wild points of known size that are found: a row of bars for each kind.

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::widgets::Widget;

use super::glyphs::Glyphs;
use super::paint::{Paint, right_of_margin};
use crate::session::detectability::{Curve, OF_ALL, SIZES};
use crate::tui::theme::Theme;

/// The widget of detectability: sizes go to the right on a logarithmic scale, each kind has a row.
#[derive(Debug, Clone)]
pub struct RecallPlot<'a> {
    /// What is found, kind by kind.
    pub curves: &'a [Curve],
    /// What is said of each kind, at the right edge.
    pub words: &'a [String],
    /// The size of one limit of the noise, in channel units.
    pub limit: f64,
    /// Styles.
    pub theme: &'a Theme,
    /// Characters.
    pub glyphs: Glyphs,
}

/// Columns that stay for the bars however long the words are.
const FEWEST: usize = 20;

impl RecallPlot<'_> {
    /// How many columns the bars have of `width`.
    fn bars(&self, width: u16) -> u16 {
        let longest = self.words.iter().map(|words| words.chars().count()).max().unwrap_or(0);
        let room = usize::from(width).saturating_sub(longest + 2);
        let bars = if room < FEWEST { usize::from(width) } else { room };
        u16::try_from(bars).unwrap_or(u16::MAX)
    }

    /// The index in [`SIZES`] of a column, which may lie between two.
    fn at(column: u16, bars: u16) -> f64 {
        f64::from(column) / f64::from(bars.max(2) - 1) * (SIZES.len() - 1) as f64
    }

    /// The column of a size in limits.
    fn column(size: f64, bars: u16) -> u16 {
        let (low, high) = (SIZES[0].ln(), SIZES[SIZES.len() - 1].ln());
        let share = (size.ln() - low) / (high - low);
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a share of a width")]
        let column = (share.clamp(0.0, 1.0) * f64::from(bars.max(1) - 1)).round() as u16;
        column
    }

    fn row(&self, curve: &Curve, row: u16, bars: u16, paint: &mut Paint<'_>) {
        let recall = |index: usize| curve.points.get(index).and_then(|p| p.recall());
        for column in 0..bars {
            let at = Self::at(column, bars);
            #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "an index of a short list")]
            let (left, right) = (at.floor() as usize, at.ceil() as usize);
            let Some((left, right)) = recall(left).zip(recall(right)) else { continue };
            let share = left + (right - left) * at.fract();
            #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "between 0 and 8")]
            let eighths = (share * 8.0).round() as u8;
            let style = if share >= OF_ALL { self.theme.title } else { self.theme.dim };
            if eighths > 0 {
                paint.put(column, row, self.glyphs.bar(eighths), style);
            }
        }
    }

    /// Labels of sizes in channel units below the bars: where they fit beside each other.
    fn sizes(&self, row: u16, bars: u16, paint: &mut Paint<'_>) {
        let mut free = 0;
        for size in [1.0, 2.5, 6.3, 16.0, 40.0, 100.0] {
            let rounded: f64 = format!("{:.1e}", size * self.limit).parse().unwrap_or(size * self.limit);
            let text = rounded.to_string();
            let length = u16::try_from(text.chars().count()).unwrap_or(u16::MAX);
            let middle = Self::column(size, bars);
            let start = middle.saturating_sub(length / 2).min(bars.saturating_sub(length));
            if start >= free {
                paint.text(start, row, &text, self.theme.dim);
                free = start + length + 1;
            }
        }
    }
}

impl Widget for RecallPlot<'_> {
    fn render(self, area: Rect, buffer: &mut Buffer) {
        let area = area.intersection(*buffer.area());
        let mut paint = Paint::new(buffer, area);
        for row in 0..area.height {
            paint.margin(row, "", self.glyphs.vertical(), self.theme.dim);
        }
        let with_sizes = self.curves.iter().filter(|curve| curve.kind.has_sizes());
        let rows: Vec<(&Curve, &String)> = with_sizes.zip(self.words).collect();
        // The last row has the sizes where there is one left.
        let labels = usize::from(area.height) > rows.len();
        for (row, (curve, _)) in (0..area.height).zip(&rows) {
            paint.margin(row, curve.kind.short(), self.glyphs.vertical(), self.theme.text);
        }
        let mut paint = Paint::new(buffer, right_of_margin(area));
        (0..paint.height()).for_each(|row| paint.clear_row(row));
        let width = paint.width();
        let bars = self.bars(width);
        for (row, (curve, words)) in (0..area.height).zip(&rows) {
            self.row(curve, row, bars, &mut paint);
            if bars < width {
                paint.text(bars + 2, row, words, self.theme.text);
            }
        }
        if labels {
            self.sizes(u16::try_from(rows.len()).unwrap_or(u16::MAX), bars, &mut paint);
        }
    }
}
