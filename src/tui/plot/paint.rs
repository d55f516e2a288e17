//! Writing cells into an area of a buffer, and never outside it.

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::style::Style;

use super::GUTTER;

/// An area of a buffer, addressed by columns and rows from its upper left corner.
pub(super) struct Paint<'b> {
    buffer: &'b mut Buffer,
    area: Rect,
}

impl<'b> Paint<'b> {
    /// The part of `area` that the buffer has.
    pub(super) fn new(buffer: &'b mut Buffer, area: Rect) -> Self {
        let area = area.intersection(*buffer.area());
        Self { buffer, area }
    }

    pub(super) fn width(&self) -> u16 {
        self.area.width
    }

    pub(super) fn height(&self) -> u16 {
        self.area.height
    }

    /// Writes a cell, whatever was there before.
    pub(super) fn put(&mut self, column: u16, row: u16, glyph: char, style: Style) {
        if column < self.area.width
            && row < self.area.height
            && let Some(cell) = self.buffer.cell_mut((self.area.x + column, self.area.y + row))
        {
            cell.reset();
            cell.set_char(glyph).set_style(style);
        }
    }

    /// Writes text from `column` on, cut at the right edge.
    pub(super) fn text(&mut self, column: u16, row: u16, text: &str, style: Style) {
        if column < self.area.width && row < self.area.height {
            let room = usize::from(self.area.width - column);
            self.buffer.set_stringn(self.area.x + column, self.area.y + row, text, room, style);
        }
    }

    /// Blanks a row.
    pub(super) fn clear_row(&mut self, row: u16) {
        (0..self.area.width).for_each(|column| self.put(column, row, ' ', Style::new()));
    }

    /// Writes the margin of a row: `text` to the right of its room, then `edge` where the axis is.
    pub(super) fn margin(&mut self, row: u16, text: &str, edge: char, style: Style) {
        let room = usize::from(GUTTER) - 1;
        self.text(0, row, &format!("{text:>room$.room$}"), style);
        self.put(GUTTER - 1, row, edge, style);
    }
}

/// The part of `area` right of the margin.
pub(super) fn right_of_margin(area: Rect) -> Rect {
    let margin = GUTTER.min(area.width);
    Rect { x: area.x.saturating_add(margin), width: area.width - margin, ..area }
}
