//! The flag rail: one row that counts the flags of every column, never hidden.

use std::ops::Range;

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::style::Style;
use ratatui::widgets::Widget;

use super::columns::Columns;
use super::flags::FlagState;
use super::glyphs::Glyphs;
use super::paint::{Paint, right_of_margin};
use crate::tui::theme::Theme;

/// The rail widget: one row under a plot with the same margin. Suspects are no flags: a column with nothing else
/// shows their marker, and they do not add to the height of others.
#[derive(Clone)]
pub struct FlagRail<'a> {
    /// The reduced samples.
    pub columns: &'a Columns,
    /// Styles.
    pub theme: &'a Theme,
    /// Characters.
    pub glyphs: Glyphs,
    /// What stands in the margin.
    pub label: &'a str,
    /// Position of the sample under the cursor.
    pub cursor: Option<usize>,
    /// Selected positions.
    pub selection: Option<Range<usize>>,
}

impl FlagRail<'_> {
    fn mark(&self, column: u16) -> (char, Style) {
        let summary = self.columns.summary(column);
        match summary.worst() {
            None => (self.glyphs.rail(0), self.theme.dim),
            Some(FlagState::Suspect) => (self.glyphs.flag(FlagState::Suspect), self.theme.flag_suspect),
            Some(state) => (self.glyphs.rail(summary.flagged()), self.theme.flag(state)),
        }
    }
}

impl Widget for FlagRail<'_> {
    fn render(self, area: Rect, buffer: &mut Buffer) {
        let area = Rect { height: area.height.min(1), ..area };
        Paint::new(buffer, area).margin(0, &format!("{} ", self.label), ' ', self.theme.dim);
        let mut paint = Paint::new(buffer, right_of_margin(area));
        let cursor = self.cursor.and_then(|position| self.columns.column_of(position));
        for column in 0..paint.width() {
            let (glyph, style) = self.mark(column);
            let selected = self.selection.as_ref().is_some_and(|s| self.columns.selects(column, s));
            let style = if selected { style.patch(self.theme.selection) } else { style };
            let style = if cursor == Some(column) { style.patch(self.theme.cursor) } else { style };
            paint.put(column, 0, glyph, style);
        }
    }
}
