//! Cells as few bytes: the way to the terminal over a slow line.
//!
//! Everything but the drawing of cells is that of crossterm's backend. Cells are written with one sequence for all
//! attributes that change and with the shortest move, about two thirds of what that backend writes.

use std::fmt::Write as _;
use std::io::{self, Write};

use ratatui::backend::{Backend, ClearType, CrosstermBackend, WindowSize};
use ratatui::buffer::Cell;
use ratatui::layout::{Position, Size};
use ratatui::style::{Color, Modifier};
use unicode_width::UnicodeWidthStr;

/// A backend that writes few bytes.
pub(super) struct Wire<W: Write> {
    inner: CrosstermBackend<W>,
    /// Whether the cursor is hidden, which then need not be said again with every frame.
    hidden: bool,
}

impl<W: Write> Wire<W> {
    /// A backend that writes to `writer`, to a terminal whose cursor has been hidden.
    pub(super) fn new(writer: W) -> Self {
        Self { inner: CrosstermBackend::new(writer), hidden: true }
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
        self.inner.write_all(encoded(content).as_bytes())
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
        self.inner.clear()
    }

    fn clear_region(&mut self, clear_type: ClearType) -> io::Result<()> {
        self.inner.clear_region(clear_type)
    }

    fn size(&self) -> io::Result<Size> {
        self.inner.size()
    }

    fn window_size(&mut self) -> io::Result<WindowSize> {
        self.inner.window_size()
    }

    fn flush(&mut self) -> io::Result<()> {
        Backend::flush(&mut self.inner)
    }
}

/// How a cell looks.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
struct Pen {
    fg: Color,
    bg: Color,
    line: Color,
    modifier: Modifier,
}

const PLAIN: Pen = Pen { fg: Color::Reset, bg: Color::Reset, line: Color::Reset, modifier: Modifier::empty() };

impl Pen {
    fn of(cell: &Cell) -> Self {
        Self { fg: cell.fg, bg: cell.bg, line: cell.underline_color, modifier: cell.modifier }
    }
}

/// The bytes that put cells (column, row, both from 0) on a terminal whose attributes are reset, and leave them reset:
/// row by row, or look by look where that is shorter, since a few changes here and there take more attributes than
/// moves.
fn encoded<'a>(content: impl Iterator<Item = (u16, u16, &'a Cell)>) -> String {
    let mut cells: Vec<_> = content.collect();
    let by_row = in_order(&cells);
    let mut looks: Vec<Pen> = Vec::new();
    for (_, _, cell) in &cells {
        let pen = Pen::of(cell);
        if !looks.contains(&pen) {
            looks.push(pen);
        }
    }
    // Plain cells first: they need no attributes at all.
    cells.sort_by_key(|(_, _, cell)| {
        let pen = Pen::of(cell);
        if pen == PLAIN { None } else { looks.iter().position(|look| *look == pen) }
    });
    let by_look = in_order(&cells);
    if by_look.len() < by_row.len() { by_look } else { by_row }
}

fn in_order(content: &[(u16, u16, &Cell)]) -> String {
    let mut out = String::new();
    let mut pen = PLAIN;
    let mut at: Option<(u16, u16)> = None;
    for &(x, y, cell) in content {
        if at != Some((x, y)) {
            step(&mut out, at, (x, y));
        }
        let next = Pen::of(cell);
        if next != pen {
            change(&mut out, pen, next);
            pen = next;
        }
        out.push_str(cell.symbol());
        let width = u16::try_from(cell.symbol().width()).unwrap_or(1).max(1);
        at = Some((x.saturating_add(width), y));
    }
    if pen != PLAIN {
        out.push_str("\x1b[0m");
    }
    out
}

/// Moves the cursor. Only to the right is it moved by steps: at the right edge a terminal may not be where it seems.
fn step(out: &mut String, from: Option<(u16, u16)>, (x, y): (u16, u16)) {
    let _ = match from {
        Some((at, row)) if row == y && x == at + 1 => write!(out, "\x1b[C"),
        Some((at, row)) if row == y && x > at => write!(out, "\x1b[{}C", x - at),
        _ if x == 0 => write!(out, "\x1b[{}H", u32::from(y) + 1),
        _ => write!(out, "\x1b[{};{}H", u32::from(y) + 1, u32::from(x) + 1),
    };
}

/// What a modifier switches on and off. Bold and dim go off together.
const SWITCHES: [(Modifier, u8, u8); 9] = [
    (Modifier::BOLD, 1, 22),
    (Modifier::DIM, 2, 22),
    (Modifier::ITALIC, 3, 23),
    (Modifier::UNDERLINED, 4, 24),
    (Modifier::SLOW_BLINK, 5, 25),
    (Modifier::RAPID_BLINK, 6, 25),
    (Modifier::REVERSED, 7, 27),
    (Modifier::HIDDEN, 8, 28),
    (Modifier::CROSSED_OUT, 9, 29),
];

/// The shorter of two sequences: one that changes what differs, one that begins anew.
fn change(out: &mut String, from: Pen, to: Pen) {
    let anew = parameters(PLAIN, to);
    let anew = if anew.is_empty() { "0".to_owned() } else { format!("0;{anew}") };
    let differing = parameters(from, to);
    let shorter = if anew.len() < differing.len() { anew } else { differing };
    let _ = write!(out, "\x1b[{shorter}m");
}

fn parameters(from: Pen, to: Pen) -> String {
    let mut all: Vec<String> = Vec::new();
    let mut held = from.modifier;
    for (modifier, _, off) in SWITCHES {
        if held.contains(modifier) && !to.modifier.contains(modifier) {
            all.push(off.to_string());
            SWITCHES.iter().filter(|s| s.2 == off).for_each(|s| held.remove(s.0));
        }
    }
    let on = SWITCHES.iter().filter(|s| to.modifier.contains(s.0) && !held.contains(s.0));
    all.extend(on.map(|s| s.1.to_string()));
    for (before, after, base) in [(from.fg, to.fg, 38), (from.bg, to.bg, 48), (from.line, to.line, 58)] {
        if before != after {
            all.push(color(after, base));
        }
    }
    all.join(";")
}

/// The parameters of a colour; `base` is 38 for the foreground, 48 for the background, 58 for the underline.
fn color(color: Color, base: u8) -> String {
    let named = |n: u8| match (base, n) {
        (58, _) => format!("58;5;{n}"),
        (_, 0..8) => (base - 8 + n).to_string(),
        _ => (base + 52 + n - 8).to_string(),
    };
    match color {
        Color::Reset => (base + 1).to_string(),
        Color::Black => named(0),
        Color::Red => named(1),
        Color::Green => named(2),
        Color::Yellow => named(3),
        Color::Blue => named(4),
        Color::Magenta => named(5),
        Color::Cyan => named(6),
        Color::Gray => named(7),
        Color::DarkGray => named(8),
        Color::LightRed => named(9),
        Color::LightGreen => named(10),
        Color::LightYellow => named(11),
        Color::LightBlue => named(12),
        Color::LightMagenta => named(13),
        Color::LightCyan => named(14),
        Color::White => named(15),
        Color::Indexed(n) => format!("{base};5;{n}"),
        Color::Rgb(r, g, b) => format!("{base};2;{r};{g};{b}"),
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;
    use ratatui::buffer::Buffer;
    use ratatui::layout::Rect;
    use ratatui::style::Style;

    use super::*;

    const AREA: Rect = Rect { x: 0, y: 0, width: 30, height: 6 };

    fn colors() -> impl Strategy<Value = Color> {
        prop_oneof![
            Just(Color::Reset),
            Just(Color::Red),
            Just(Color::LightCyan),
            any::<u8>().prop_map(Color::Indexed),
            any::<[u8; 3]>().prop_map(|[r, g, b]| Color::Rgb(r, g, b)),
        ]
    }

    fn cells() -> impl Strategy<Value = Vec<(usize, char, Style)>> {
        let modifiers = vec![
            Modifier::empty(),
            Modifier::BOLD,
            Modifier::DIM,
            Modifier::REVERSED,
            Modifier::ITALIC | Modifier::BOLD,
            Modifier::UNDERLINED | Modifier::DIM,
        ];
        let style = (colors(), colors(), prop::sample::select(modifiers))
            .prop_map(|(fg, bg, m)| Style::new().fg(fg).bg(bg).add_modifier(m));
        prop::collection::vec((0..180_usize, prop::sample::select(vec!['a', '⣿', '●', ' ']), style), 0..60)
    }

    /// What a terminal makes of a colour.
    fn seen(color: Color) -> vt100::Color {
        match color {
            Color::Reset => vt100::Color::Default,
            Color::Red => vt100::Color::Idx(1),
            Color::LightCyan => vt100::Color::Idx(14),
            Color::Indexed(n) => vt100::Color::Idx(n),
            Color::Rgb(r, g, b) => vt100::Color::Rgb(r, g, b),
            other => panic!("{other} is not drawn here"),
        }
    }

    proptest! {
        #[test]
        fn a_terminal_shows_the_cells_after_any_number_of_frames(frames in prop::collection::vec(cells(), 1..5)) {
            let (rows, columns) = (AREA.height.try_into().unwrap(), AREA.width.try_into().unwrap());
            let mut terminal = vt100::Parser::new(rows, columns, 0);
            let mut before = Buffer::empty(AREA);
            for frame in frames {
                let mut after = before.clone();
                for (at, glyph, style) in frame {
                    let cell = &mut after[((at % 30) as u16, (at / 30) as u16)];
                    cell.reset();
                    cell.set_char(glyph).set_style(style);
                }
                terminal.process(encoded(before.diff(&after).into_iter()).as_bytes());
                for (x, y) in AREA.positions().map(|p| (p.x, p.y)) {
                    let (cell, shown) = (&after[(x, y)], terminal.screen().cell(y, x).unwrap());
                    let contents = if shown.has_contents() { shown.contents() } else { " " };
                    prop_assert_eq!(contents, cell.symbol());
                    prop_assert_eq!((shown.fgcolor(), shown.bgcolor()), (seen(cell.fg), seen(cell.bg)));
                    let is = |m| cell.modifier.contains(m);
                    prop_assert_eq!((shown.bold(), shown.dim()), (is(Modifier::BOLD), is(Modifier::DIM)));
                    prop_assert_eq!((shown.italic(), shown.inverse()), (is(Modifier::ITALIC), is(Modifier::REVERSED)));
                    prop_assert_eq!(shown.underline(), is(Modifier::UNDERLINED));
                }
                before = after;
            }
        }
    }

    #[test]
    fn bold_and_dim_go_off_together_and_what_stays_comes_back() {
        // The terminal of the test above cannot be both; real ones can.
        let with = |modifier| Pen { modifier, ..PLAIN };
        assert_eq!(parameters(with(Modifier::BOLD | Modifier::DIM), with(Modifier::DIM)), "22;2");
        assert_eq!(parameters(with(Modifier::BOLD | Modifier::DIM), PLAIN), "22");
    }

    #[test]
    fn what_is_near_costs_little() {
        let mut buffer = Buffer::empty(AREA);
        buffer.set_string(3, 2, "12", Style::new().fg(Color::Indexed(245)));
        buffer.set_string(6, 2, "3", Style::new().fg(Color::Indexed(245)).add_modifier(Modifier::BOLD));
        let bytes = encoded(Buffer::empty(AREA).diff(&buffer).into_iter());
        assert_eq!(bytes, "\x1b[3;4H\x1b[38;5;245m12\x1b[C\x1b[1m3\x1b[0m");
    }
}
