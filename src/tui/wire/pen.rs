//! How a cell looks, and the sequences that go from one look to another.

use std::fmt::Write as _;

use ratatui::buffer::Cell;
use ratatui::style::{Color, Modifier};

/// How a cell looks.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Pen {
    pub(super) fg: Color,
    pub(super) bg: Color,
    pub(super) line: Color,
    pub(super) modifier: Modifier,
}

/// How a cell looks that has been reset.
pub(super) const PLAIN: Pen =
    Pen { fg: Color::Reset, bg: Color::Reset, line: Color::Reset, modifier: Modifier::empty() };

impl Pen {
    pub(super) fn of(cell: &Cell) -> Self {
        Self { fg: cell.fg, bg: cell.bg, line: cell.underline_color, modifier: cell.modifier }
    }

    /// True when a blank looks the same whatever its foreground is.
    pub(super) fn hides_foreground(self) -> bool {
        !self.modifier.intersects(SEEN_ON_BLANKS)
    }

    /// True when what is erased with this pen is blank and plain: terminals fill it with the background at hand.
    pub(super) fn erases(self) -> bool {
        self.bg == PLAIN.bg && self.hides_foreground()
    }
}

/// What shows on a blank, too.
const SEEN_ON_BLANKS: Modifier = Modifier::REVERSED
    .union(Modifier::UNDERLINED)
    .union(Modifier::CROSSED_OUT)
    .union(Modifier::SLOW_BLINK)
    .union(Modifier::RAPID_BLINK);

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
pub(super) fn change(out: &mut String, from: Pen, to: Pen) {
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
    use super::*;

    #[test]
    fn bold_and_dim_go_off_together_and_what_stays_comes_back() {
        // The terminal of the encoder's test cannot be both; real ones can.
        let with = |modifier| Pen { modifier, ..PLAIN };
        assert_eq!(parameters(with(Modifier::BOLD | Modifier::DIM), with(Modifier::DIM)), "22;2");
        assert_eq!(parameters(with(Modifier::BOLD | Modifier::DIM), PLAIN), "22");
    }
}
