//! The figures: how many mutants of each folder came to which end.

use std::collections::BTreeMap;

use crate::outcome::Outcome;
use crate::plan::in_crate;

/// The columns, with the outcomes they count.
const COLUMNS: &[(&str, &[Outcome])] = &[
    ("unviable", &[Outcome::Unviable]),
    ("killed", &[Outcome::Killed]),
    ("timed out", &[Outcome::TimedOut]),
    ("not switched", &[Outcome::Apart]),
    ("survived", &[Outcome::Survived]),
];

/// The folder a file is counted in: `method` for `crates/core/src/method.rs` and all below
/// `crates/core/src/method`.
#[must_use]
pub fn folder(file: &str) -> &str {
    in_crate(file).split(['/', '.']).next().unwrap_or("")
}

/// The table, in Markdown; `listed` of a mutant says that it survives with a reason.
#[must_use]
pub fn table<'a>(rows: impl Iterator<Item = (&'a str, Option<Outcome>, bool)>) -> String {
    let mut counts: BTreeMap<&str, Vec<usize>> = BTreeMap::new();
    for (file, outcome, listed) in rows {
        for name in [folder(file), "together"] {
            let row = counts.entry(name).or_insert_with(|| vec![0; COLUMNS.len() + 3]);
            row[0] += 1;
            match COLUMNS.iter().position(|(_, these)| outcome.is_some_and(|o| these.contains(&o))) {
                Some(column) => row[column + 1] += 1,
                None => row[COLUMNS.len() + 2] += 1,
            }
            row[COLUMNS.len() + 1] += usize::from(listed);
        }
    }
    let names = COLUMNS.iter().map(|(name, _)| *name);
    let heads: Vec<&str> = ["mutants"].into_iter().chain(names).chain(["of these listed", "not judged"]).collect();
    let mut out = format!("| folder | {} |\n|---|{}\n", heads.join(" | "), "---|".repeat(heads.len()));
    for (name, row) in counts {
        let cells: Vec<String> = row.iter().map(ToString::to_string).collect();
        out.push_str(&format!("| {name} | {} |\n", cells.join(" | ")));
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_mutant_is_counted_in_its_folder_and_together() {
        let rows = [
            ("crates/core/src/method.rs", Some(Outcome::Killed), false),
            ("src/method/window/sorted.rs", Some(Outcome::Survived), true),
            ("crates/core/src/repair.rs", None, false),
        ];
        let table = table(rows.into_iter());
        assert!(table.contains("| method | 2 | 0 | 1 | 0 | 0 | 1 | 1 | 0 |\n"), "{table}");
        assert!(table.contains("| repair | 1 | 0 | 0 | 0 | 0 | 0 | 0 | 1 |\n"), "{table}");
        assert!(table.contains("| together | 3 | 0 | 1 | 0 | 0 | 1 | 1 | 1 |\n"), "{table}");
    }
}
