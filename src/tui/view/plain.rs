//! Words for terminals that cannot show every character: what text brings in beyond the glyph set is replaced.

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;

use super::super::plot::Glyphs;

/// Replacements of one cell for one cell.
const SUBSTITUTES: [(&str, &str); 15] = [
    ("·", "|"),
    ("−", "-"),
    ("×", "x"),
    ("…", "~"),
    ("→", ">"),
    ("←", "<"),
    ("↑", "^"),
    ("↓", "v"),
    ("±", "~"),
    ("‹", "<"),
    ("›", ">"),
    ("─", "-"),
    ("│", "|"),
    ("°", "o"),
    ("µ", "u"),
];

/// Leaves in `area` only what the glyph set has: everything for Unicode, ASCII otherwise (and braille).
pub(super) fn restrict(glyphs: Glyphs, area: Rect, buffer: &mut Buffer) {
    if glyphs == Glyphs::Unicode {
        return;
    }
    for y in area.top()..area.bottom() {
        for x in area.left()..area.right() {
            let cell = &mut buffer[(x, y)];
            let symbol = cell.symbol();
            let braille = glyphs == Glyphs::Braille && symbol.chars().all(|c| ('\u{2800}'..='\u{28ff}').contains(&c));
            if symbol.is_ascii() || braille {
                continue;
            }
            let plain = SUBSTITUTES.iter().find(|(from, _)| *from == symbol).map_or("?", |(_, to)| to);
            cell.set_symbol(plain);
        }
    }
}
