//! Where two results differ: a row that tells by letters who flags what, and the letters on the trace.

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::style::Style;
use ratatui::widgets::Widget;

use super::columns::Columns;
use super::glyphs::Glyphs;
use super::paint::{Paint, right_of_margin};
use crate::plot::{Side, Sides};
use crate::tui::theme::Theme;

/// The rail of two results: `A` where only A flags samples of a column, `B` where only B does, `&` where each flags
/// some that the other does not, `=` where they flag the same.
#[derive(Clone)]
pub struct SideRail<'a> {
    /// Who flags what.
    pub sides: &'a Sides,
    /// Tells which samples each column holds.
    pub columns: &'a Columns,
    /// Position of the sample under the cursor.
    pub cursor: Option<usize>,
    /// Styles.
    pub theme: &'a Theme,
    /// Characters.
    pub glyphs: Glyphs,
}

/// The letters on the trace: `A` and `B` at the samples that only one of the two flags. They are drawn over the trace,
/// where they are few enough to be told apart; the rail has them all.
#[derive(Clone)]
pub struct SideMarks<'a> {
    /// Who flags what.
    pub sides: &'a Sides,
    /// What the trace below is drawn from.
    pub columns: &'a Columns,
    /// The values of the samples.
    pub y: &'a [f64],
    /// Styles.
    pub theme: &'a Theme,
}

/// How a side looks.
fn look(theme: &Theme, side: Side) -> (char, Style) {
    match side {
        Side::OnlyA => ('A', theme.focus),
        Side::OnlyB => ('B', theme.warning),
        Side::Both => ('=', theme.dim),
    }
}

impl Widget for SideRail<'_> {
    fn render(self, area: Rect, buffer: &mut Buffer) {
        let area = Rect { height: area.height.min(1), ..area };
        Paint::new(buffer, area).margin(0, "A/B ", ' ', self.theme.dim);
        let mut paint = Paint::new(buffer, right_of_margin(area));
        let cursor = self.cursor.and_then(|position| self.columns.column_of(position));
        for column in 0..paint.width() {
            let (glyph, style) = match self.sides.counts_in(&self.columns.positions(column)) {
                [0, 0, 0] => (self.glyphs.rail(0), self.theme.dim),
                [0, 0, _] => look(self.theme, Side::Both),
                [_, 0, _] => look(self.theme, Side::OnlyA),
                [0, _, _] => look(self.theme, Side::OnlyB),
                _ => ('&', self.theme.error),
            };
            let style = if cursor == Some(column) { style.patch(self.theme.cursor) } else { style };
            paint.put(column, 0, glyph, style);
        }
    }
}

impl Widget for SideMarks<'_> {
    fn render(self, area: Rect, buffer: &mut Buffer) {
        let in_view = self.columns.in_view();
        let mut paint = Paint::new(buffer, right_of_margin(area));
        let [a, b, _] = self.sides.counts_in(&in_view);
        if (a + b) * 3 > usize::from(paint.width()) {
            return;
        }
        for (position, side) in self.sides.differences_in(&in_view) {
            let row = self.y.get(position).and_then(|y| self.columns.scale().row(*y));
            if let (Some(column), Some(row)) = (self.columns.column_of(position), row) {
                let (glyph, style) = look(self.theme, side);
                paint.put(column, row, glyph, style);
            }
        }
    }
}
