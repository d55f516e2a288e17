//! The steps of time from sample to sample, on a logarithmic scale.

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::style::Style;
use ratatui::widgets::Widget;

use super::columns::Columns;
use super::glyphs::Glyphs;
use super::paint::{Paint, right_of_margin};
use super::pyramid::Span;
use super::scale::YScale;
use crate::plot::StepColumn;
use crate::track::SECONDS_PER_DAY;
use crate::tui::theme::Theme;

/// The widget of step sizes: the shortest to the longest step of each column. A column in which samples are lost has
/// a mark at its longest step, one in which the record is cut a line as well, one with rows without a usable time an
/// exclamation mark. The dotted line is 1.5 intervals, from where on samples are lost.
#[derive(Clone)]
pub struct StepPlot<'a> {
    /// The steps of each column.
    pub steps: &'a [StepColumn],
    /// Tells which samples each column holds.
    pub columns: &'a Columns,
    /// The nominal interval in seconds.
    pub interval: f64,
    /// Styles.
    pub theme: &'a Theme,
    /// Characters.
    pub glyphs: Glyphs,
    /// Position of the sample under the cursor.
    pub cursor: Option<usize>,
}

impl StepPlot<'_> {
    /// The steps of all columns, and what tells whether samples are lost.
    fn range(&self) -> (f64, f64) {
        let nominal = Span { low: self.interval * 0.7, high: self.interval * 2.0 };
        let nominal = if self.interval > 0.0 { nominal } else { Span::EMPTY };
        let all = self.steps.iter().fold(nominal, |all, column| all.union(column.span));
        if all.is_empty() { (-1.0, 1.0) } else { (all.low.log10(), all.high.log10()) }
    }

    fn margin(&self, paint: &mut Paint<'_>, scale: YScale) {
        let height = paint.height();
        for row in 0..height {
            paint.margin(row, "", self.glyphs.vertical(), self.theme.dim);
        }
        let (low, high) = (10_f64.powf(scale.low()), 10_f64.powf(scale.high()));
        for value in [low, high, self.interval] {
            if let Some(row) = scale.row(value.log10()) {
                paint.margin(row, &seconds(value), self.glyphs.tick(), self.theme.dim);
            }
        }
    }

    fn column(&self, paint: &mut Paint<'_>, scale: YScale, column: u16, step: &StepColumn, on_cursor: bool) {
        let height = paint.height();
        let row_of = |value: f64| scale.row(value.log10()).unwrap_or(0);
        let limit = scale.row((self.interval * 1.5).log10());
        let (top, bottom) = (row_of(step.span.high), row_of(step.span.low));
        let is_mark = |row: u16| step.lost && row == top;
        // A mark of lost samples gives way to nothing: the fault goes to the other edge, or between.
        let fault_row = if is_mark(height.saturating_sub(1)) { 0 } else { height.saturating_sub(1) };
        for row in 0..height {
            let inside = !step.span.is_empty() && (top..=bottom).contains(&row);
            let (glyph, style) = if is_mark(row) {
                (self.glyphs.lost(), if step.cut { self.theme.over } else { self.theme.warning })
            } else if step.fault && row == fault_row {
                ('!', self.theme.error)
            } else if step.cut {
                (self.glyphs.viewport(), self.theme.over)
            } else if inside {
                let mask = scale_mask(scale, step.span, row);
                (self.glyphs.dots(mask), self.theme.raw)
            } else if on_cursor {
                (self.glyphs.vertical(), self.theme.cursor_line)
            } else if Some(row) == limit {
                (self.glyphs.threshold(), self.theme.threshold)
            } else {
                (' ', Style::new())
            };
            let style = if on_cursor && (inside || is_mark(row)) { style.patch(self.theme.cursor) } else { style };
            paint.put(column, row, glyph, style);
        }
    }
}

/// The dots of a span of seconds in one row of cells, over the whole width of the cell.
fn scale_mask(scale: YScale, span: Span, row: u16) -> u8 {
    const ROWS: [u8; 4] = [0x09, 0x12, 0x24, 0xc0];
    let (top, bottom) = (scale.dot_row(span.high.log10()), scale.dot_row(span.low.log10()));
    let first = i32::from(row) * 4;
    (0..4).filter(|dot| (top..=bottom).contains(&(first + dot))).fold(0, |mask, dot| mask | ROWS[dot as usize])
}

/// A number of seconds in at most seven columns.
fn seconds(value: f64) -> String {
    let text = match value {
        v if v >= SECONDS_PER_DAY * 2.0 => format!("{:.1} d", v / SECONDS_PER_DAY),
        v if v >= 7200.0 => format!("{:.1} h", v / 3600.0),
        v if v >= 100.0 => format!("{v:.0} s"),
        v if v >= 0.1 => format!("{v:.2} s"),
        v if v >= 1e-4 => format!("{:.2} ms", v * 1e3),
        v => format!("{:.2} us", v * 1e6),
    };
    if text.len() <= 7 { text } else { format!("{value:.0e}") }
}

impl Widget for StepPlot<'_> {
    fn render(self, area: Rect, buffer: &mut Buffer) {
        let area = area.intersection(*buffer.area());
        let (low, high) = self.range();
        let scale = YScale::new(low, high, area.height);
        self.margin(&mut Paint::new(buffer, area), scale);
        let mut paint = Paint::new(buffer, right_of_margin(area));
        (0..paint.height()).for_each(|row| paint.clear_row(row));
        let cursor = self.cursor.and_then(|position| self.columns.column_of(position));
        for (column, step) in (0..paint.width()).zip(self.steps) {
            self.column(&mut paint, scale, column, step, cursor == Some(column));
        }
    }
}
