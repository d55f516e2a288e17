//! The trace: raw curve, expected value and band, repaired values, flags on top.

use std::ops::Range;

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::style::Style;
use ratatui::widgets::Widget;

use super::columns::Columns;
use super::glyphs::Glyphs;
use super::labels::ValueLabels;
use super::paint::{Paint, right_of_margin};
use crate::tui::theme::Theme;

/// Which layers of a trace are shown. Flags always are.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Layers {
    /// The kept raw samples.
    pub raw: bool,
    /// The expected value.
    pub expected: bool,
    /// The edges of the band around it.
    pub band: bool,
    /// Repaired values.
    pub repaired: bool,
    /// The track that the method's model makes of the samples.
    pub filtered: bool,
}

impl Layers {
    /// All of them.
    pub const ALL: Self = Self { filtered: true, ..Self::USUAL };

    /// Those that are shown unless others are asked for.
    pub const USUAL: Self = Self { raw: true, expected: true, band: true, repaired: true, filtered: false };

    /// The curve alone.
    pub const RAW: Self = Self { raw: true, expected: false, band: false, repaired: false, filtered: false };

    /// None of them.
    pub const NONE: Self = Self { raw: false, ..Self::RAW };
}

/// The sample under the cursor.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Cursor {
    /// Its position.
    pub position: usize,
    /// Its value, which tells the row.
    pub y: f64,
}

/// The trace widget. Its rows and the columns right of the margin of [`super::GUTTER`] columns should be those of
/// the grid that `columns` were made for; where they are not, what fits is drawn.
#[derive(Clone)]
pub struct TracePlot<'a> {
    /// The reduced samples.
    pub columns: &'a Columns,
    /// Styles.
    pub theme: &'a Theme,
    /// Characters.
    pub glyphs: Glyphs,
    /// What is shown.
    pub layers: Layers,
    /// The sample under the cursor.
    pub cursor: Option<Cursor>,
    /// Selected positions.
    pub selection: Option<Range<usize>>,
}

impl TracePlot<'_> {
    /// The part of `area` in which the samples are drawn: its size is that of the grid to make columns for.
    #[must_use]
    pub fn plot_area(area: Rect) -> Rect {
        right_of_margin(area)
    }

    /// What turns labels of the y axis into values, for the title of the panel; empty when they are the values.
    #[must_use]
    pub fn y_note(&self) -> String {
        self.labels(self.columns.grid().height).note
    }

    fn labels(&self, height: u16) -> ValueLabels {
        let scale = self.columns.scale();
        ValueLabels::new(scale.low(), scale.high(), (usize::from(height) * 2 / 5).clamp(2, 8))
    }

    fn margin(&self, paint: &mut Paint<'_>) {
        let labels = self.labels(paint.height());
        let mut texts = vec![None; usize::from(paint.height())];
        for (value, text) in &labels.ticks {
            let row = self.columns.scale().row(*value).map(usize::from);
            if let Some(slot) = row.and_then(|row| texts.get_mut(row)) {
                *slot = Some(text.as_str());
            }
        }
        // The note goes to the first free row; the title has it where it does not fit.
        let mut note = Some(labels.note.as_str()).filter(|note| !note.is_empty() && note.len() < 8);
        for (row, text) in (0_u16..).zip(texts) {
            match text {
                Some(text) => paint.margin(row, text, self.glyphs.tick(), self.theme.dim),
                None => paint.margin(row, note.take().unwrap_or(""), self.glyphs.vertical(), self.theme.dim),
            }
        }
    }

    /// The mark of a cell and its style, without cursor and background; none when nothing is there.
    fn mark(&self, column: u16, row: u16, height: u16, at_cursor: bool) -> Option<(char, Style)> {
        let (glyphs, theme, columns) = (self.glyphs, self.theme, self.columns);
        let (c, r) = (usize::from(column), usize::from(row));
        let shown = |on: bool, mask: u8| if on { mask } else { 0 };
        let raw = shown(self.layers.raw, columns.raw.mask(c, r));
        let (top, bottom) = (row == 0, row + 1 == height);

        let summary = columns.summary(column);
        let (above, below) = (summary.above.filter(|_| top), summary.below.filter(|_| bottom));
        if let Some(state) = above.or(below) {
            return Some((glyphs.beyond(above.is_some(), below.is_some()), theme.flag(state)));
        }
        if let Some(state) = columns.flag_cell(c, r) {
            let glyph = match (columns.sparse || glyphs == Glyphs::Ascii, at_cursor) {
                (true, true) => glyphs.flag_at_cursor(state),
                (true, false) => glyphs.flag(state),
                (false, _) => glyphs.dots(raw | columns.flag_dots.mask(c, r)),
            };
            return Some((glyph, theme.flag(state)));
        }
        let repaired = shown(self.layers.repaired, columns.repaired.mask(c, r));
        if repaired != 0 {
            return Some((glyphs.layer(repaired | raw, '='), theme.repaired));
        }
        let filtered = shown(self.layers.filtered, columns.filtered.mask(c, r));
        if filtered != 0 {
            return Some((glyphs.layer(filtered | raw, '~'), theme.filtered));
        }
        if raw != 0 {
            return Some((glyphs.dots(raw), theme.raw));
        }
        let (above, below) = columns.raw_beyond.get(c).copied().unwrap_or_default();
        if self.layers.raw && ((top && above) || (bottom && below)) {
            return Some((glyphs.beyond(top && above, bottom && below), theme.dim));
        }
        let expected = shown(self.layers.expected, columns.expected.mask(c, r));
        if expected != 0 {
            return Some((glyphs.layer(expected, '-'), theme.expected));
        }
        let band = shown(self.layers.band, columns.band.mask(c, r));
        (band != 0).then(|| (glyphs.layer(band, '_'), theme.band))
    }

    /// Is the column selected, or empty between selected samples?
    fn selects(&self, column: u16) -> bool {
        self.selection.as_ref().is_some_and(|selection| self.columns.selects(column, selection))
    }

    /// What is patched over every cell of a column.
    fn background(&self, column: u16) -> Style {
        if self.selects(column) {
            return self.theme.selection;
        }
        let gap = self.columns.gaps.get(usize::from(column)).copied().unwrap_or(false);
        if gap { self.theme.gap } else { Style::new() }
    }
}

impl Widget for TracePlot<'_> {
    fn render(self, area: Rect, buffer: &mut Buffer) {
        self.margin(&mut Paint::new(buffer, area));
        let mut paint = Paint::new(buffer, right_of_margin(area));
        let (height, grid) = (paint.height(), self.columns.grid());
        let cursor_column = self.cursor.and_then(|cursor| self.columns.column_of(cursor.position));
        let cursor_row = self.cursor.map(|cursor| match self.columns.scale().row(cursor.y) {
            Some(row) => row,
            None if cursor.y > self.columns.scale().high() => 0,
            None => height.saturating_sub(1),
        });
        for column in 0..paint.width() {
            let background = self.background(column);
            let on_cursor = cursor_column == Some(column);
            for row in 0..height {
                let at_cursor = on_cursor && cursor_row == Some(row);
                let mark = if column < grid.width { self.mark(column, row, height, at_cursor) } else { None };
                let (glyph, style) = match mark {
                    Some(mark) => mark,
                    None if on_cursor && !at_cursor => (self.glyphs.vertical(), self.theme.cursor_line),
                    None => (' ', Style::new()),
                };
                let style = style.patch(background);
                let style = if at_cursor { style.patch(self.theme.cursor) } else { style };
                paint.put(column, row, glyph, style);
            }
        }
    }
}
