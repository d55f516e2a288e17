//! What the terminal shows, as far as it is cheap to write again.

use std::ops::Range;

use unicode_width::UnicodeWidthStr;

use super::pen::{PLAIN, Pen};

/// Characters of one byte and how they look, cell by cell; none for all others.
#[derive(Debug, Default)]
pub(super) struct Shown {
    columns: u16,
    cells: Vec<Option<(u8, Pen)>>,
}

const BLANK: Option<(u8, Pen)> = Some((b' ', PLAIN));

impl Shown {
    /// A terminal of a size that has been cleared: ratatui takes it for blank, too.
    pub(super) fn of(columns: u16, rows: u16) -> Self {
        Self { columns, cells: vec![BLANK; usize::from(columns) * usize::from(rows)] }
    }

    /// Makes it a cleared one of another size; leaves it as it is at the same size.
    pub(super) fn resize(&mut self, columns: u16, rows: u16) {
        if self.columns != columns || self.cells.len() != usize::from(columns) * usize::from(rows) {
            *self = Self::of(columns, rows);
        }
    }

    /// It was cleared.
    pub(super) fn clear(&mut self) {
        self.cells.fill(BLANK);
    }

    /// Columns of the terminal.
    pub(super) fn columns(&self) -> u16 {
        self.columns
    }

    /// A symbol was put.
    pub(super) fn put(&mut self, x: u16, y: u16, symbol: &str, pen: Pen) {
        let known = match symbol.as_bytes() {
            [byte] => Some((*byte, pen)),
            _ => None,
        };
        for at in x..x.saturating_add(u16::try_from(symbol.width()).unwrap_or(1).max(1)).min(self.columns) {
            let at = usize::from(y) * usize::from(self.columns) + usize::from(at);
            if let Some(cell) = self.cells.get_mut(at) {
                *cell = known;
            }
        }
    }

    /// How many cells there are from a column to the end of its row, when all of them are blank and look plain; else 0.
    pub(super) fn blank_from(&self, x: u16, y: u16) -> u16 {
        let row = usize::from(y) * usize::from(self.columns);
        let rest = self.cells.get(row + usize::from(x)..row + usize::from(self.columns)).unwrap_or_default();
        let blank = |(byte, pen): (u8, Pen)| byte == b' ' && pen.bg == PLAIN.bg && pen.hides_foreground();
        if rest.iter().all(|cell| cell.is_some_and(blank)) { rest.len() as u16 } else { 0 }
    }

    /// The text in some columns of a row, where it can be written again with this pen and look the same.
    pub(super) fn text(&self, columns: Range<u16>, y: u16, pen: Pen) -> Option<String> {
        let same = |byte: u8, own: Pen| {
            let blank = byte == b' ' && own.bg == pen.bg && own.hides_foreground() && pen.hides_foreground();
            (own == pen || blank).then_some(char::from(byte))
        };
        let row = usize::from(y) * usize::from(self.columns);
        columns.map(|x| self.cells.get(row + usize::from(x)).copied().flatten().and_then(|(b, p)| same(b, p))).collect()
    }
}
