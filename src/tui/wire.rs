//! Cells as few bytes: the way to the terminal over a slow line.
//!
//! Everything but the drawing of cells is that of crossterm's backend. Cells are written with one sequence for all
//! attributes that change and with the shortest move, about two thirds of what that backend writes.

use std::io::{self, Write};

use ratatui::backend::{Backend, ClearType, CrosstermBackend, WindowSize};
use ratatui::buffer::Cell;
use ratatui::layout::{Position, Size};

mod encode;
mod moves;
mod order;
mod pen;
mod shown;

use encode::encoded;
pub(super) use encode::plain_blanks;
use shown::Shown;

/// What is drawn on at most: a terminal may say that it has 65,535 columns and rows, which no memory holds.
const LARGEST: Size = Size { width: 1000, height: 500 };

/// A backend that writes few bytes.
pub(super) struct Wire<W: Write> {
    inner: CrosstermBackend<W>,
    /// Whether the cursor is hidden, which then need not be said again with every frame.
    hidden: bool,
    /// Size of the terminal, as it last said, as far as it is drawn on.
    size: std::cell::Cell<Size>,
    /// What it shows.
    shown: Shown,
}

impl<W: Write> Wire<W> {
    /// A backend that writes to `writer`, to a terminal whose cursor has been hidden.
    pub(super) fn new(writer: W) -> Self {
        Self {
            inner: CrosstermBackend::new(writer),
            hidden: true,
            size: std::cell::Cell::default(),
            shown: Shown::default(),
        }
    }
}

impl<W: Write> Write for Wire<W> {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.inner.write(bytes)
    }

    fn flush(&mut self) -> io::Result<()> {
        Write::flush(&mut self.inner)
    }
}

impl<W: Write> Backend for Wire<W> {
    type Error = io::Error;

    fn draw<'a, I>(&mut self, content: I) -> io::Result<()>
    where
        I: Iterator<Item = (u16, u16, &'a Cell)>,
    {
        let Size { width, height } = self.size.get();
        self.shown.resize(width, height);
        self.inner.write_all(encoded(content, &mut self.shown).as_bytes())
    }

    fn hide_cursor(&mut self) -> io::Result<()> {
        if std::mem::replace(&mut self.hidden, true) { Ok(()) } else { self.inner.hide_cursor() }
    }

    fn show_cursor(&mut self) -> io::Result<()> {
        self.hidden = false;
        self.inner.show_cursor()
    }

    fn get_cursor_position(&mut self) -> io::Result<Position> {
        self.inner.get_cursor_position()
    }

    fn set_cursor_position<P: Into<Position>>(&mut self, position: P) -> io::Result<()> {
        self.inner.set_cursor_position(position)
    }

    fn clear(&mut self) -> io::Result<()> {
        self.shown.clear();
        self.inner.clear()
    }

    fn clear_region(&mut self, clear_type: ClearType) -> io::Result<()> {
        // The workbench clears all or nothing.
        self.shown.clear();
        self.inner.clear_region(clear_type)
    }

    fn size(&self) -> io::Result<Size> {
        let Size { width, height } = self.inner.size()?;
        let size = Size { width: width.min(LARGEST.width), height: height.min(LARGEST.height) };
        self.size.set(size);
        Ok(size)
    }

    fn window_size(&mut self) -> io::Result<WindowSize> {
        self.inner.window_size()
    }

    fn flush(&mut self) -> io::Result<()> {
        Backend::flush(&mut self.inner)
    }
}
