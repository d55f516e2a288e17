//! The shortest way of the cursor from one cell to another.

use super::pen::Pen;
use super::shown::Shown;

/// Cells up to which what lies between is written again: a move costs as much.
const BRIDGE: u16 = 3;

/// Where the cursor is.
#[derive(Debug, Clone, Copy)]
pub(super) struct At {
    pub(super) x: u16,
    pub(super) y: u16,
    /// Columns by which it may be further right: symbols have been put that are two columns wide in some terminals.
    pub(super) doubt: u16,
}

/// Moves the cursor the shortest way; gives the doubt there is then. Up to three cells that lie between and look like
/// `pen` are written again. At the right edge a terminal may not be where it seems, not even in which row: from there
/// the way is absolute.
pub(super) fn step(out: &mut String, from: Option<At>, (x, y): (u16, u16), pen: Pen, shown: &Shown) -> u16 {
    let start = out.len();
    absolute(out, (x, y));
    let Some(at) = from else { return 0 };
    let mut doubt = 0;
    // Each way is written behind the shortest one so far, and takes its place if it is shorter.
    let mut or = |out: &mut String, doubt_then: u16, way: &dyn Fn(&mut String)| {
        let middle = out.len();
        way(out);
        if out.len() - middle < middle - start {
            out.drain(start..middle);
            doubt = doubt_then;
        } else {
            out.truncate(middle);
        }
    };
    if at.y == y && at.x <= x {
        if x - at.x <= BRIDGE
            && let Some(text) = shown.text(at.x..x, y, pen)
        {
            or(out, at.doubt, &|out| out.push_str(&text));
        }
        // In the row of a symbol in doubt, what follows may be further right as well.
        or(out, at.doubt, &|out| sideways(out, at.x, x));
    }
    if at.x.saturating_add(at.doubt) < shown.columns() {
        or(out, 0, &|out| {
            rows(out, at.y, y);
            column(out, x);
        });
        if at.doubt == 0 {
            or(out, 0, &|out| {
                rows(out, at.y, y);
                sideways(out, at.x, x);
            });
        }
    }
    doubt
}

fn absolute(out: &mut String, (x, y): (u16, u16)) {
    out.push_str("\x1b[");
    number(out, y + 1);
    if x > 0 {
        out.push(';');
        number(out, x + 1);
    }
    out.push('H');
}

/// Up or down in the same column. A line feed is that alone in raw mode, and there is a row below to go to.
fn rows(out: &mut String, from: u16, to: u16) {
    match (to.saturating_sub(from), from.saturating_sub(to)) {
        (0, 0) => {}
        (down @ 1..=3, _) => (0..down).for_each(|_| out.push('\n')),
        (0, up) => relative(out, up, 'A'),
        (down, _) => relative(out, down, 'B'),
    }
}

/// Left or right in the same row.
fn sideways(out: &mut String, from: u16, to: u16) {
    match (to.saturating_sub(from), from.saturating_sub(to)) {
        (0, 0) => {}
        _ if to == 0 => out.push('\r'),
        (0, left @ 1..=3) => (0..left).for_each(|_| out.push('\x08')),
        (0, left) => relative(out, left, 'D'),
        (right, _) => relative(out, right, 'C'),
    }
}

/// To a column of the same row.
fn column(out: &mut String, x: u16) {
    if x == 0 { out.push('\r') } else { relative(out, x + 1, 'G') }
}

fn relative(out: &mut String, by: u16, letter: char) {
    out.push_str("\x1b[");
    if by > 1 {
        number(out, by);
    }
    out.push(letter);
}

fn number(out: &mut String, n: u16) {
    if n >= 10 {
        number(out, n / 10);
    }
    out.push(char::from(b'0' + (n % 10) as u8));
}
