//! Cells as bytes.

use ratatui::buffer::{Buffer, Cell};
use unicode_width::UnicodeWidthStr;

use super::moves::{At, step};
use super::order::orders;
use super::pen::{PLAIN, Pen, change};
use super::shown::Shown;

/// A symbol to be put at a column and a row, both from 0.
#[derive(Clone, Copy)]
pub(super) struct Put<'a> {
    pub(super) x: u16,
    pub(super) y: u16,
    pub(super) symbol: &'a str,
    pub(super) pen: Pen,
}

/// Erases a row from the cursor on: shorter than this many blanks, and nothing else is to the right of them.
const ERASE: &str = "\x1b[K";
const ERASED_FROM: u16 = 4;

impl Put<'_> {
    /// Where the cursor is after the symbol, when it was put with so much doubt.
    pub(super) fn end(&self, doubt: u16) -> At {
        let columns = |width: usize| u16::try_from(width).unwrap_or(1).max(1);
        let (width, ambiguous) = match self.symbol.len() {
            1 => (1, 1),
            _ => (columns(self.symbol.width()), columns(self.symbol.width_cjk())),
        };
        let doubt = doubt.saturating_add(ambiguous.saturating_sub(width));
        At { x: self.x.saturating_add(width), y: self.y, doubt }
    }
}

/// Takes the foreground away from blanks, on which it cannot be seen: one that only lost its style does not go over
/// the wire.
pub(in crate::tui) fn plain_blanks(buffer: &mut Buffer) {
    for cell in &mut buffer.content {
        if cell.symbol() == " " && Pen::of(cell).hides_foreground() {
            (cell.fg, cell.underline_color, cell.modifier) = (PLAIN.fg, PLAIN.line, PLAIN.modifier);
        }
    }
}

/// The bytes that put cells (column, row, both from 0; in the order of rows) on a terminal whose attributes are reset,
/// and leave them reset: in that of several orders which is shortest. What is `shown` there is brought up to date.
pub(super) fn encoded<'a>(content: impl Iterator<Item = (u16, u16, &'a Cell)>, shown: &mut Shown) -> String {
    let mut puts: Vec<Put<'a>> =
        content.map(|(x, y, cell)| Put { x, y, symbol: cell.symbol(), pen: Pen::of(cell) }).collect();
    blend_blanks(&mut puts);
    // Before anything is encoded: what lies between two puts is written again as it will be in the end.
    puts.iter().for_each(|put| shown.put(put.x, put.y, put.symbol, put.pen));
    orders(&puts, shown).into_iter().map(|puts| in_order(&puts, shown)).min_by_key(String::len).unwrap_or_default()
}

/// Gives a blank beside another cell the look of that one, where it looks the same.
fn blend_blanks(puts: &mut [Put<'_>]) {
    for i in 1..puts.len() {
        let (before, put) = (puts[i - 1], puts[i]);
        let beside = (before.x + 1, before.y) == (put.x, put.y) && before.pen.bg == put.pen.bg;
        if beside && put.symbol == " " && put.pen.hides_foreground() && before.pen.hides_foreground() {
            puts[i].pen = before.pen;
        }
    }
}

fn in_order(puts: &[Put<'_>], shown: &Shown) -> String {
    let mut out = String::new();
    let mut pen = PLAIN;
    let mut at: Option<At> = None;
    // The column of each row from which it has been erased.
    let mut erased: Vec<(u16, u16)> = Vec::new();
    for put in puts {
        if erased.iter().any(|(y, from)| put.y == *y && put.x >= *from) {
            continue;
        }
        let doubt = step(&mut out, at, (put.x, put.y), pen, shown);
        if put.symbol == " " && pen.erases() && shown.blank_from(put.x, put.y) >= ERASED_FROM {
            out.push_str(ERASE);
            at = Some(At { x: put.x, y: put.y, doubt });
            erased.push((put.y, put.x));
            continue;
        }
        if put.pen != pen {
            change(&mut out, pen, put.pen);
            pen = put.pen;
        }
        out.push_str(put.symbol);
        at = Some(put.end(doubt));
    }
    if pen != PLAIN {
        out.push_str("\x1b[0m");
    }
    out
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;
    use ratatui::layout::Rect;
    use ratatui::style::{Color, Modifier, Style};

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
            let mut shown = Shown::of(AREA.width, AREA.height);
            for frame in frames {
                let mut after = before.clone();
                for (at, glyph, style) in frame {
                    let cell = &mut after[((at % 30) as u16, (at / 30) as u16)];
                    cell.reset();
                    cell.set_char(glyph).set_style(style);
                }
                plain_blanks(&mut after);
                terminal.process(encoded(before.diff(&after).into_iter(), &mut shown).as_bytes());
                for (x, y) in AREA.positions().map(|p| (p.x, p.y)) {
                    let (cell, shown) = (&after[(x, y)], terminal.screen().cell(y, x).unwrap());
                    let contents = if shown.has_contents() { shown.contents() } else { " " };
                    prop_assert_eq!(contents, cell.symbol());
                    prop_assert_eq!(shown.bgcolor(), seen(cell.bg));
                    prop_assert_eq!(shown.inverse(), cell.modifier.contains(Modifier::REVERSED));
                    prop_assert_eq!(shown.underline(), cell.modifier.contains(Modifier::UNDERLINED));
                    if contents == " " && Pen::of(cell).hides_foreground() {
                        continue;
                    }
                    prop_assert_eq!(shown.fgcolor(), seen(cell.fg));
                    let is = |m| cell.modifier.contains(m);
                    prop_assert_eq!((shown.bold(), shown.dim()), (is(Modifier::BOLD), is(Modifier::DIM)));
                    prop_assert_eq!(shown.italic(), is(Modifier::ITALIC));
                }
                before = after;
            }
        }
    }

    #[test]
    fn what_is_near_costs_little() {
        let mut buffer = Buffer::empty(AREA);
        buffer.set_string(3, 2, "12", Style::new().fg(Color::Indexed(245)));
        buffer.set_string(6, 2, "3", Style::new().fg(Color::Indexed(245)).add_modifier(Modifier::BOLD));
        let bytes = encoded(Buffer::empty(AREA).diff(&buffer).into_iter(), &mut Shown::of(AREA.width, AREA.height));
        // The blank between them is written again: a byte, where the move takes three.
        assert_eq!(bytes, "\x1b[3;4H\x1b[38;5;245m12 \x1b[1m3\x1b[0m");
    }

    #[test]
    fn what_lies_between_two_changes_is_written_again_where_that_is_shorter() {
        let grey = Style::new().fg(Color::Indexed(245));
        let mut shown = Shown::of(AREA.width, AREA.height);
        let mut before = Buffer::empty(AREA);
        before.set_string(0, 0, "k 4.0 is 4.1", grey);
        plain_blanks(&mut before);
        encoded(Buffer::empty(AREA).diff(&before).into_iter(), &mut shown);
        let mut after = before.clone();
        after.set_string(0, 0, "k 5.3 is 5.4", grey);
        plain_blanks(&mut after);
        let bytes = encoded(before.diff(&after).into_iter(), &mut shown);
        assert_eq!(bytes, "\x1b[1;3H\x1b[38;5;245m5.3\x1b[4C5.4\x1b[0m");
    }

    #[test]
    fn rows_of_a_list_are_reached_by_steps_where_the_cursor_is_certain() {
        let mut buffer = Buffer::empty(AREA);
        buffer.set_string(20, 1, "12", Style::new());
        buffer.set_string(20, 2, "13", Style::new());
        buffer.set_string(0, 3, "x", Style::new());
        let encode = |buffer: &Buffer| {
            encoded(Buffer::empty(AREA).diff(buffer).into_iter(), &mut Shown::of(AREA.width, AREA.height))
        };
        assert_eq!(encode(&buffer), "\x1b[2;21H12\n\x08\x0813\n\rx");
        // After a glyph that some terminals draw two columns wide the column is absolute, at the right edge all is.
        let mut buffer = Buffer::empty(AREA);
        buffer.set_string(20, 1, "●", Style::new());
        buffer.set_string(20, 2, "13", Style::new());
        buffer.set_string(29, 3, "1", Style::new());
        buffer.set_string(29, 4, "2", Style::new());
        assert_eq!(encode(&buffer), "\x1b[2;21H●\n\x1b[21G13\n\x1b[7C1\x1b[5;30H2");
    }

    #[test]
    fn the_way_between_cells_far_apart_is_short() {
        let red = Style::new().fg(Color::Red);
        let mut buffer = Buffer::empty(AREA);
        for (y, style) in [(1, Style::new()), (2, red), (3, Style::new())] {
            buffer.set_string(2, y, "a", style);
            buffer.set_string(20, y, "⣿", style);
        }
        let bytes = encoded(Buffer::empty(AREA).diff(&buffer).into_iter(), &mut Shown::of(AREA.width, AREA.height));
        assert_eq!(bytes, "\x1b[2;3Ha\x1b[17C⣿\n\x08\x1b[31m⣿\x1b[3Ga\n\x08\x1b[0ma\x1b[17C⣿");
    }

    #[test]
    fn the_end_of_a_row_is_erased_where_that_is_shorter_than_blanks() {
        let mut before = Buffer::empty(AREA);
        let mut after = Buffer::empty(AREA);
        for (y, old, new) in
            [(0, "a long message", "a"), (1, "abc", ""), (2, "all but the end   .", "                  .")]
        {
            before.set_string(0, y, old, Style::new().fg(Color::Red));
            after.set_string(0, y, new, Style::new().fg(Color::Red));
        }
        for buffer in [&mut before, &mut after] {
            plain_blanks(buffer);
        }
        let mut shown = Shown::of(AREA.width, AREA.height);
        encoded(Buffer::empty(AREA).diff(&before).into_iter(), &mut shown);
        let bytes = encoded(before.diff(&after).into_iter(), &mut shown);
        assert_eq!(bytes, "\x1b[1;3H\x1b[K\n\r\x1b[K\n               ");
        // Nor with a pen that some terminals would leave on the row.
        let mut underlined = Buffer::empty(AREA);
        underlined.set_string(0, 0, "a", Style::new().add_modifier(Modifier::UNDERLINED));
        let mut shown = Shown::of(AREA.width, AREA.height);
        encoded(Buffer::empty(AREA).diff(&before).into_iter(), &mut shown);
        let bytes = encoded(before.diff(&underlined).into_iter(), &mut shown);
        assert!(bytes.contains("\x1b[K") && !bytes.contains("\x1b[4ma\x1b[K"), "{bytes:?}");
        // Not with a pen that would fill it.
        let mut filled = Buffer::empty(AREA);
        filled.set_string(0, 3, "abc", Style::new().bg(Color::Red));
        before.set_string(4, 3, "a message", Style::new());
        let mut shown = Shown::of(AREA.width, AREA.height);
        encoded(Buffer::empty(AREA).diff(&before).into_iter(), &mut shown);
        let bytes = encoded(before.diff(&filled).into_iter(), &mut shown);
        assert!(bytes.contains("\x1b[41mabc"), "{bytes:?}");
        assert!(bytes.contains("\x1b[K") && !bytes.contains("\x1b[41mabc\x1b[K"), "{bytes:?}");
    }

    #[test]
    fn a_blank_costs_no_look_of_its_own() {
        let grey = Style::new().fg(Color::Indexed(245));
        let mut buffer = Buffer::empty(AREA);
        buffer.set_string(0, 0, "a b", grey);
        let mut blank = buffer.clone();
        blank.set_string(0, 0, "a  ", Style::new().fg(Color::Red));
        for buffer in [&mut buffer, &mut blank] {
            plain_blanks(buffer);
        }
        let bytes =
            |from: &Buffer, to: &Buffer| encoded(from.diff(to).into_iter(), &mut Shown::of(AREA.width, AREA.height));
        assert_eq!(bytes(&blank, &buffer), "\x1b[1H\x1b[38;5;245ma b\x1b[0m");
        assert_eq!(bytes(&Buffer::empty(AREA), &buffer), "\x1b[1H\x1b[38;5;245ma b\x1b[0m");
    }
}
