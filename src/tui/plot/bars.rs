//! Bars of eighths of a cell.

use ratatui::style::Style;

use super::glyphs::Glyphs;
use super::paint::Paint;
use crate::tui::theme::Theme;

/// A bar of one column.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Bar {
    /// Its part of the height, from 0 to 1; none when there is nothing to show.
    pub(super) share: Option<f64>,
    /// Does it stand for something that is flagged? Beside a line its tip says so, which does not change with the line.
    pub(super) over: bool,
    /// Is it cut at the top?
    pub(super) beyond: bool,
}

/// Columns from one dot of a dotted line to the next. A line that is turned by a parameter moves from row to row, and
/// each of its cells goes over the wire twice then.
const APART: u16 = 4;

/// Whether a dotted line has a dot in a column.
pub(super) fn is_dotted(column: u16) -> bool {
    column.is_multiple_of(APART)
}

/// How bars are drawn.
pub(super) struct Bars<'a> {
    pub(super) theme: &'a Theme,
    pub(super) glyphs: Glyphs,
    /// The row of a dotted line behind the bars ([`is_dotted`]).
    pub(super) line: Option<u16>,
}

impl Bars<'_> {
    /// Draws a column from its top to its bottom.
    pub(super) fn column(&self, paint: &mut Paint<'_>, column: u16, bar: Bar, on_cursor: bool) {
        let height = paint.height();
        // In eighths of a cell; a bar of nothing still shows that there was something.
        let eighths =
            bar.share.map_or(0.0, |share| (share.clamp(0.0, 1.0) * f64::from(height) * 8.0).ceil().max(1.0)) as u32;
        let tip = u32::from(height).saturating_sub(eighths.div_ceil(8));
        for row in 0..height {
            let below = u32::from(height - 1 - row) * 8;
            let fill = eighths.saturating_sub(below).min(8) as u8;
            let over = bar.over && (self.line.is_none() || u32::from(row) == tip);
            let glyph = if over && self.glyphs == Glyphs::Ascii { '#' } else { self.glyphs.bar(fill) };
            let style = if over { self.theme.over } else { self.theme.dim };
            let (glyph, style) = match fill {
                _ if bar.beyond && row == 0 => (self.glyphs.beyond(true, false), self.theme.over),
                0 if Some(row) == self.line && is_dotted(column) => (self.glyphs.threshold(), self.theme.threshold),
                0 => (' ', Style::new()),
                _ => (glyph, style),
            };
            let (glyph, style) = self.with_cursor(glyph, style, on_cursor);
            paint.put(column, row, glyph, style);
        }
    }

    /// Draws the cursor's column through what is empty.
    pub(super) fn with_cursor(&self, glyph: char, style: Style, on_cursor: bool) -> (char, Style) {
        if on_cursor && glyph == ' ' { (self.glyphs.vertical(), self.theme.cursor_line) } else { (glyph, style) }
    }
}
