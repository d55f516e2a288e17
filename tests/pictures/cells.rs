//! Rows of a screen as SVG: text as text, braille dots, blocks and lines as shapes, so that no font moves them.

use std::fmt::Write as _;

use vt100::{Cell, Color, Screen};

/// Width of a cell.
pub(crate) const WIDTH: u16 = 8;
/// Height of a cell.
pub(crate) const HEIGHT: u16 = 16;
/// Where the letters of a row stand.
const BASE: u16 = 12;
/// The colour of text without one.
pub(crate) const INK: &str = "#d0d4d8";
/// The colour of the ground.
pub(crate) const GROUND: &str = "#14181c";

/// How a cell is drawn.
#[derive(Debug, Clone, PartialEq, Eq)]
struct Look {
    ink: String,
    ground: Option<String>,
    bold: bool,
    underline: bool,
}

/// The rows of the screen, each as the content of an SVG group with its top at 0.
pub(crate) fn rows(screen: &Screen) -> Vec<String> {
    let (height, width) = screen.size();
    (0..height.into()).map(|row| one(screen, row, width.into())).collect()
}

fn one(screen: &Screen, row: u16, width: u16) -> String {
    let mut out = String::new();
    let mut from = 0;
    while from < width {
        let Some(first) = screen.cell(row, from) else { break };
        if is_invisible(first) {
            from += 1;
            continue;
        }
        let first = look(first);
        // A blank goes with what is before it: its ink depends on how the screen came to be. A ground ends with its cells.
        let spreads = first.ground.is_none() && !first.underline;
        let same =
            |c: &u16| screen.cell(row, *c).is_some_and(|cell| (spreads && is_invisible(cell)) || look(cell) == first);
        let to = (from..width).take_while(same).last().map_or(from + 1, |last| last + 1);
        let texts: Vec<&str> = (from..to).filter_map(|c| screen.cell(row, c)).map(Cell::contents).collect();
        run(&texts, from, &first, &mut out);
        from = to;
    }
    out
}

/// Whether a cell shows nothing but the ground.
fn is_invisible(cell: &Cell) -> bool {
    cell.contents().trim().is_empty() && look(cell).ground.is_none() && !cell.underline()
}

fn look(cell: &Cell) -> Look {
    let (mut ink, mut ground) = (color(cell.fgcolor()), color(cell.bgcolor()));
    if cell.inverse() {
        let swapped = ground.take().unwrap_or_else(|| GROUND.to_owned());
        ground = Some(ink.take().unwrap_or_else(|| INK.to_owned()));
        ink = Some(swapped);
    }
    let ink = ink.unwrap_or_else(|| INK.to_owned());
    Look { ink, ground, bold: cell.bold(), underline: cell.underline() }
}

/// Cells of one look from column `from` on.
fn run(texts: &[&str], from: u16, look: &Look, out: &mut String) {
    let left = from * WIDTH;
    let width = u16::try_from(texts.len()).unwrap() * WIDTH;
    if let Some(ground) = &look.ground {
        let _ = write!(out, r#"<rect x="{left}" width="{width}" height="{HEIGHT}" fill="{ground}"/>"#);
    }
    if look.underline {
        let _ = write!(out, r#"<path d="M{left} 14.5h{width}" stroke="{}"/>"#, look.ink);
    }
    let (mut dots, mut blocks, mut lines) = (String::new(), String::new(), String::new());
    // Letters that follow each other, with the column of the first.
    let mut words: Vec<(u16, String)> = Vec::new();
    let mut open = false;
    for (column, text) in (from..).zip(texts) {
        let c = text.chars().next().unwrap_or(' ');
        let x = column * WIDTH;
        let letter = match c {
            '\u{2800}'..='\u{28ff}' => {
                braille(c, x, &mut dots);
                false
            }
            '▁'..='█' => {
                let eighths = u16::try_from(u32::from(c) - u32::from('▁') + 1).unwrap();
                let _ = write!(blocks, "M{x} {HEIGHT}h{WIDTH}v-{}h-{WIDTH}z", eighths * HEIGHT / 8);
                false
            }
            '─' | '┄' | '│' | '┤' | '┌' | '┐' | '└' | '┘' => {
                line(c, x, &mut lines);
                false
            }
            ' ' => false,
            _ => true,
        };
        match words.last_mut().filter(|_| open && letter) {
            Some((_, word)) => word.push_str(text),
            None if letter => words.push((column, (*text).to_owned())),
            None => {}
        }
        open = letter && text.is_ascii();
    }
    shapes(&dots, &blocks, &lines, look, out);
    for (column, word) in &words {
        let bold = if look.bold { r#" font-weight="bold""# } else { "" };
        let long = word.chars().count() * usize::from(WIDTH);
        let _ = write!(
            out,
            r#"<text x="{}" y="{BASE}" textLength="{long}" fill="{}"{bold}>{}</text>"#,
            column * WIDTH,
            look.ink,
            escaped(word)
        );
    }
}

fn shapes(dots: &str, blocks: &str, lines: &str, look: &Look, out: &mut String) {
    if !dots.is_empty() {
        let _ = write!(out, r#"<path d="{dots}" stroke="{}" stroke-width="2"/>"#, look.ink);
    }
    if !blocks.is_empty() {
        let _ = write!(out, r#"<path d="{blocks}" fill="{}"/>"#, look.ink);
    }
    if !lines.is_empty() {
        let _ = write!(out, r#"<path d="{lines}" stroke="{}"/>"#, look.ink);
    }
}

/// The dots of a braille pattern: bits 0 to 2 and 6 on the left from the top, 3 to 5 and 7 on the right.
fn braille(c: char, x: u16, out: &mut String) {
    const PLACES: [(u16, u16); 8] = [(0, 0), (0, 1), (0, 2), (1, 0), (1, 1), (1, 2), (0, 3), (1, 3)];
    let bits = u32::from(c) - 0x2800;
    for (_, (column, row)) in PLACES.iter().enumerate().filter(|(bit, _)| bits >> bit & 1 == 1) {
        let _ = write!(out, "M{} {}h2", x + 1 + 4 * column, 2 + 4 * row);
    }
}

/// A line of a frame.
fn line(c: char, x: u16, out: &mut String) {
    let (middle, half) = (x + WIDTH / 2, HEIGHT / 2);
    let _ = match c {
        '─' => write!(out, "M{x} {half}h{WIDTH}"),
        '┄' => write!(out, "M{x} {half}h3m2 0h3"),
        '│' => write!(out, "M{middle} 0v{HEIGHT}"),
        '┤' => write!(out, "M{middle} 0v{HEIGHT}M{x} {half}h4"),
        '┌' => write!(out, "M{middle} {HEIGHT}v-{half}h4"),
        '┐' => write!(out, "M{middle} {HEIGHT}v-{half}h-4"),
        '└' => write!(out, "M{middle} 0v{half}h4"),
        _ => write!(out, "M{middle} 0v{half}h-4"),
    };
}

fn escaped(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;")
}

/// The colour as SVG has it; none for that of the terminal.
fn color(color: Color) -> Option<String> {
    let [r, g, b] = match color {
        Color::Default => return None,
        Color::Rgb(r, g, b) => [r, g, b],
        Color::Idx(i @ 0..16) => SIXTEEN[usize::from(i)],
        // The cube of six by six by six, then 24 greys, as xterm has them.
        Color::Idx(i @ 16..232) => {
            let level = |n: u8| if n == 0 { 0 } else { 55 + 40 * n };
            let i = i - 16;
            [level(i / 36), level(i / 6 % 6), level(i % 6)]
        }
        Color::Idx(i) => [8 + 10 * (i - 232); 3],
    };
    Some(format!("#{r:02x}{g:02x}{b:02x}"))
}

const SIXTEEN: [[u8; 3]; 16] = [
    [0, 0, 0],
    [205, 49, 49],
    [13, 188, 121],
    [229, 229, 16],
    [36, 114, 200],
    [188, 63, 188],
    [17, 168, 205],
    [229, 229, 229],
    [102, 102, 102],
    [241, 76, 76],
    [35, 209, 139],
    [245, 245, 67],
    [59, 142, 234],
    [214, 112, 214],
    [41, 184, 219],
    [255, 255, 255],
];

#[test]
fn dots_and_colours_are_where_terminals_have_them() {
    let mut out = String::new();
    braille('⠁', 8, &mut out);
    braille('⢀', 8, &mut out);
    assert_eq!(out, "M9 2h2M13 14h2");
    assert_eq!(color(Color::Idx(196)).as_deref(), Some("#ff0000"));
    assert_eq!(color(Color::Idx(244)).as_deref(), Some("#808080"));
}
