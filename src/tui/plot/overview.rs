//! The overview, a sparkline of the whole record in a few rows, with its own rail and the part that the trace shows.

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::style::{Modifier, Style};
use ratatui::widgets::Widget;

use super::columns::Columns;
use super::glyphs::Glyphs;
use super::paint::{Paint, right_of_margin};
use super::rail::FlagRail;
use super::view::View;
use crate::tui::theme::Theme;

/// The overview widget. The last row of its area is the rail; the rows above are those of the grid of `columns`,
/// which show the whole record.
#[derive(Clone)]
pub struct Overview<'a> {
    /// The whole record, reduced.
    pub columns: &'a Columns,
    /// The part that the trace shows.
    pub viewport: View,
    /// Styles.
    pub theme: &'a Theme,
    /// Characters.
    pub glyphs: Glyphs,
}

impl Overview<'_> {
    /// The columns of the viewport's two bars; none when it takes in the whole record.
    #[must_use]
    pub fn bars(&self) -> Option<(u16, u16)> {
        let grid = self.columns.grid();
        let whole = grid.view;
        if grid.width == 0 || whole.width() == 0.0 || self.viewport.width() == 0.0 {
            return None;
        }
        if self.viewport.from <= whole.from && self.viewport.to >= whole.to {
            return None;
        }
        // A cast from float saturates, and the bars are kept on the screen.
        let column = |x: f64| ((x - whole.from) / whole.width() * f64::from(grid.width)).floor() as u16;
        let last = grid.width - 1;
        Some((column(self.viewport.from).min(last), column(self.viewport.to).min(last)))
    }

    fn mark(&self, column: u16, row: u16, height: u16, bars: Option<(u16, u16)>) -> (char, Style) {
        let (c, r) = (usize::from(column), usize::from(row));
        let (is_bar, inside) = match bars {
            None => (false, true),
            Some((from, to)) => (column == from || column == to, (from..=to).contains(&column)),
        };
        let (raw, summary) = (self.columns.raw.mask(c, r), self.columns.summary(column));
        let above = summary.above.filter(|_| row == 0);
        let below = summary.below.filter(|_| row + 1 == height);
        let flag = above.or(below).or_else(|| self.columns.flag_cell(c, r));
        if let Some(state) = flag {
            let style = self.theme.flag(state);
            // A bar does not hide a flag: its cell is reversed instead.
            let style = if is_bar { style.add_modifier(Modifier::REVERSED) } else { style };
            let glyph = match (above.is_some(), below.is_some(), self.glyphs) {
                (false, false, Glyphs::Ascii) => self.glyphs.flag(state),
                (false, false, _) => self.glyphs.dots(raw | self.columns.flag_dots.mask(c, r)),
                (above, below, _) => self.glyphs.beyond(above, below),
            };
            return (glyph, style);
        }
        if is_bar {
            return (self.glyphs.viewport(), self.theme.viewport);
        }
        (self.glyphs.dots(raw), if inside { self.theme.raw } else { self.theme.dim })
    }
}

impl Widget for Overview<'_> {
    fn render(self, area: Rect, buffer: &mut Buffer) {
        if area.height == 0 {
            return;
        }
        let (rows, bars) = (area.height - 1, self.bars());
        let curve = Rect { height: rows, ..area };
        let mut paint = Paint::new(buffer, curve);
        for row in 0..paint.height() {
            paint.margin(row, if row == 0 { "all " } else { "" }, ' ', self.theme.dim);
        }
        let mut paint = Paint::new(buffer, right_of_margin(curve));
        for row in 0..paint.height() {
            for column in 0..paint.width() {
                let (glyph, style) = self.mark(column, row, rows, bars);
                paint.put(column, row, glyph, style);
            }
        }
        let rail = Rect { y: area.y.saturating_add(rows), height: 1, ..area };
        let (columns, theme, glyphs) = (self.columns, self.theme, self.glyphs);
        FlagRail { columns, theme, glyphs, label: "flags", cursor: None, selection: None }.render(rail, buffer);
    }
}
