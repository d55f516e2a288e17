//! The tables of a reproduced experiment as text.

use std::fmt::Write as _;

use unicode_width::UnicodeWidthStr as _;

use crate::experiment::{Cell, Reproduction, Table};
use crate::wrapped::wrapped as lines;

/// Width to which sentences are wrapped.
const WIDTH: usize = 100;

/// The tables and findings of one experiment, for people.
#[must_use]
pub fn reproduction_text(result: &Reproduction) -> String {
    let runs = if result.runs == 1 { "1 run".to_owned() } else { format!("{} runs", result.runs) };
    let mut out = format!("{}  {}\n", result.id, result.source);
    out.push_str(&wrapped(&format!("{} ({runs} from seed {})", result.help, result.seed), "  ", "  "));
    out.push_str(&wrapped(&format!("Data: {}", result.stand_in), "  ", "  "));
    for table in &result.tables {
        let _ = write!(out, "\n{}", table_text(table));
    }
    out.push('\n');
    for finding in &result.findings {
        let fitted = if finding.fitted { " The stand-in was fitted to this." } else { "" };
        let text = format!("{}. Here: {}.{fitted}", finding.statement, finding.measured);
        out.push_str(&wrapped(&text, &format!("  {:14}  ", finding.held.word()), "                  "));
    }
    out
}

/// A table with its columns lined up: words to the left, figures to the right.
fn table_text(table: &Table) -> String {
    let shown: Vec<Vec<String>> = table.rows.iter().map(|r| r.iter().map(Cell::shown).collect()).collect();
    let is_text = |c: usize| table.rows.iter().any(|r| matches!(r.get(c), Some(Cell::Text(_))));
    let width = |c: usize| {
        let cells = shown.iter().filter_map(|r| r.get(c)).map(|s| s.width());
        cells.chain([table.columns[c].width()]).max().unwrap_or(0)
    };
    let columns: Vec<(usize, bool)> = (0..table.columns.len()).map(|c| (width(c), is_text(c))).collect();
    let line = |cells: &[&str]| {
        let mut line = String::from(" ");
        for (cell, &(width, left)) in cells.iter().zip(&columns) {
            let blanks = " ".repeat(width.saturating_sub(cell.width()));
            let (before, after) = if left { ("", blanks.as_str()) } else { (blanks.as_str(), "") };
            let _ = write!(line, " {before}{cell}{after} ");
        }
        line.trim_end().to_owned() + "\n"
    };
    let mut out = format!("  {}\n", table.title);
    out.push_str(&line(&table.columns));
    for row in &shown {
        out.push_str(&line(&row.iter().map(String::as_str).collect::<Vec<_>>()));
    }
    out
}

/// Text broken between words; the first line starts with `first`, the others with `next`.
fn wrapped(text: &str, first: &str, next: &str) -> String {
    lines(text, WIDTH, (first, next)).join("\n") + "\n"
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn columns_line_up() {
        let table = Table {
            title: "T".into(),
            columns: vec!["method", "n"],
            rows: vec![vec![Cell::text("a"), Cell::with_spread(1.25, 0.5, 1)], vec![Cell::text("longer"), Cell::Empty]],
        };
        let expected = "  T\n  method          n\n  a       1.2 ± 0.5\n  longer          -\n";
        assert_eq!(table_text(&table), expected);
    }

    #[test]
    fn sentences_are_broken_between_words() {
        let text = "word ".repeat(30);
        let lines: Vec<String> = wrapped(&text, "  a ", "    ").lines().map(str::to_owned).collect();
        assert!(lines.len() == 2 && lines.iter().all(|l| l.len() <= WIDTH), "{lines:?}");
        assert_eq!(lines.iter().map(|l| l.matches("word").count()).sum::<usize>(), 30);
    }
}
