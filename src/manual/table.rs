//! Tables of a page, in columns that fit the width.

use unicode_width::UnicodeWidthStr;

use super::inline::plain;
use crate::wrapped::wrapped;

/// A column is not made narrower than this.
const NARROWEST: usize = 8;
/// Blanks between columns.
const GAP: usize = 2;

/// The table of these Markdown lines, with a line of dashes below the head.
pub(super) fn table(lines: &[&str], width: usize) -> String {
    let mut rows: Vec<Vec<String>> = lines.iter().map(|line| cells(line)).collect();
    if rows.len() > 1 {
        rows.remove(1);
    }
    let count = rows.iter().map(Vec::len).max().unwrap_or(0);
    let widths = widths(&rows, count, width);
    let mut out = String::new();
    for (at, row) in rows.iter().enumerate() {
        let parts: Vec<Vec<String>> = row.iter().zip(&widths).map(|(cell, w)| wrapped(cell, *w, ("", ""))).collect();
        for line in 0..parts.iter().map(Vec::len).max().unwrap_or(0) {
            let texts = parts.iter().map(|part| part.get(line).map_or("", String::as_str));
            out += &joined(texts, &widths);
        }
        if at == 0 {
            let dashes: Vec<String> = widths.iter().map(|w| "-".repeat(*w)).collect();
            out += &joined(dashes.iter().map(String::as_str), &widths);
        }
    }
    out
}

/// The cells of a line.
fn cells(line: &str) -> Vec<String> {
    let inside = line.trim().trim_start_matches('|');
    let inside = inside.strip_suffix('|').filter(|rest| !rest.ends_with('\\')).unwrap_or(inside);
    // A pipe behind a backslash does not end a cell.
    let mut cells = vec![String::new()];
    let mut escaped = false;
    for c in inside.chars() {
        match (c, cells.last_mut()) {
            ('|', _) if !escaped => cells.push(String::new()),
            (c, Some(cell)) => cell.push(c),
            _ => {}
        }
        escaped = c == '\\';
    }
    cells.iter().map(|cell| plain(cell.trim())).collect()
}

/// Columns as wide as their cells, the widest made narrower until all fit.
fn widths(rows: &[Vec<String>], count: usize, width: usize) -> Vec<usize> {
    let natural = |c: usize| rows.iter().filter_map(|row| row.get(c)).map(|cell| cell.width()).max().unwrap_or(0);
    let mut widths: Vec<usize> = (0..count).map(natural).collect();
    let room = width.saturating_sub(GAP * count.saturating_sub(1));
    while widths.iter().sum::<usize>() > room {
        match widths.iter_mut().max() {
            Some(widest) if *widest > NARROWEST => *widest -= 1,
            _ => break,
        }
    }
    widths
}

fn joined<'a>(texts: impl Iterator<Item = &'a str>, widths: &[usize]) -> String {
    let padded =
        texts.zip(widths).map(|(text, width)| format!("{text}{}", " ".repeat(width.saturating_sub(text.width()))));
    padded.collect::<Vec<_>>().join(&" ".repeat(GAP)).trim_end().to_owned() + "\n"
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn columns_line_up_and_long_cells_go_on_below() {
        let lines = ["| key | what |", "|---|---|", "| `a` | accept the flag and go to the next |", "| `a\\|b` | 航 |"];
        let wanted =
            "key  what\n---  -----------------\na    accept the flag\n     and go to the\n     next\na|b  航\n";
        assert_eq!(table(&lines, 22), wanted);
    }
}
