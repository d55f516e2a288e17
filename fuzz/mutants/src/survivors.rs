//! `fuzz/SURVIVORS.md`: the survivors that are known, each with the reason why it may.

use std::collections::BTreeSet;
use std::fmt::Write;
use std::path::Path;

use crate::list::{Mutant, offset};

/// How the list names a mutant: its file, the line of code with the replaced text marked, what is changed. Lines move;
/// this does not.
#[derive(Clone, PartialEq, Eq, PartialOrd, Ord, Debug)]
pub struct Row {
    /// File, relative to the root.
    pub file: String,
    /// Line of code, `⟦ ⟧` round what is replaced.
    pub code: String,
    /// What is changed.
    pub name: String,
}

/// The row of a mutant of a file with this text.
#[must_use]
pub fn row(text: &str, mutant: &Mutant) -> Row {
    let (from, to) = (offset(text, mutant.span.0), offset(text, mutant.span.1));
    let begin = text.get(..from).unwrap_or("").rfind('\n').map_or(0, |at| at + 1);
    let end = text.get(from..).unwrap_or("").find('\n').map_or(text.len(), |at| from + at);
    let part = |from: usize, to: usize| text.get(from..to.max(from)).unwrap_or("");
    let code = format!("{}⟦{}⟧{}", part(begin, from), part(from, to.min(end)), part(to.min(end), end));
    let plain = |text: &str| text.trim().replace('|', "¦").replace('`', "'");
    Row { file: mutant.file.clone(), code: plain(&code), name: plain(&mutant.name) }
}

/// The rows of the list at `path`; none when there is no list.
#[must_use]
pub fn read(path: &Path) -> BTreeSet<Row> {
    parse(&std::fs::read_to_string(path).unwrap_or_default())
}

fn parse(text: &str) -> BTreeSet<Row> {
    let cell = |cell: Option<&str>| Some(cell?.trim().trim_matches('`').to_owned());
    let line = |line: &str| {
        let mut cells = line.strip_prefix('|')?.split('|');
        Some(Row { file: cell(cells.next())?, code: cell(cells.next())?, name: cell(cells.next())? })
    };
    text.lines().filter_map(line).filter(|row| row.code.contains('⟦')).collect()
}

/// A row as the list has it, with room for the reason.
#[must_use]
pub fn written(row: &Row, reason: &str) -> String {
    let mut out = String::new();
    // Writing to a string does not fail.
    _ = write!(out, "| `{}` | `{}` | `{}` | {reason} |", row.file, row.code, row.name);
    out
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::list::Place;

    #[test]
    fn a_row_is_read_as_it_is_written() {
        let text = "fn f() {\n    a || b < c\n}\n";
        let span = (Place { line: 2, column: 12 }, Place { line: 2, column: 13 });
        let name = "replace < with <= in f".into();
        let made = row(text, &Mutant { file: "src/a.rs".into(), name, span, replacement: "<=".into() });
        assert_eq!(made.code, "a ¦¦ b ⟦<⟧ c");
        assert_eq!(
            parse(&format!("| file | code |\n|---|---|\n{}\n", written(&made, "b < c always"))),
            BTreeSet::from([made])
        );
    }

    #[test]
    fn of_many_lines_the_first_is_shown() {
        let text = "fn f() {\n    match a {\n        1 => 2,\n    }\n}\n";
        let span = (Place { line: 2, column: 5 }, Place { line: 4, column: 6 });
        let made = row(text, &Mutant { file: "src/a.rs".into(), name: "m".into(), span, replacement: "1".into() });
        assert_eq!(made.code, "⟦match a {⟧");
    }
}
