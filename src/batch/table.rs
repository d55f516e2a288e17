//! Tables of plain text.

use unicode_width::UnicodeWidthStr;

/// The rows with their cells in columns: the first column to the left, the others to the right.
#[must_use]
pub(super) fn columns(rows: &[Vec<String>]) -> String {
    let count = rows.iter().map(Vec::len).max().unwrap_or(0);
    let width = |c: usize| rows.iter().filter_map(|r| r.get(c)).map(|cell| cell.width()).max().unwrap_or(0);
    let widths: Vec<usize> = (0..count).map(width).collect();
    let mut out = String::new();
    for row in rows {
        let mut line = String::new();
        for (c, (cell, width)) in row.iter().zip(&widths).enumerate() {
            let padding = " ".repeat(width - cell.width());
            let gap = if c > 0 { "  " } else { "" };
            line += &if c == 0 { format!("{cell}{padding}") } else { format!("{gap}{padding}{cell}") };
        }
        out += line.trim_end();
        out.push('\n');
    }
    out
}

/// Texts as a row.
#[must_use]
pub(super) fn row<const N: usize>(cells: [&str; N]) -> Vec<String> {
    cells.map(str::to_owned).to_vec()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn wide_characters_do_not_shift_the_columns() {
        let rows = [row(["file", "n"]), row(["航迹.csv", "12"]), row(["a", "7"])];
        assert_eq!(columns(&rows), "file       n\n航迹.csv  12\na          7\n");
    }
}
