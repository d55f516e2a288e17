//! What came of a mutant, and the file that remembers it: a line `key, outcome, by what, name` for each, so that a run
//! that is broken off goes on where it was, and one after a change judges only what is new.

use std::collections::BTreeMap;
use std::collections::hash_map::DefaultHasher;
use std::fs::{self, OpenOptions};
use std::hash::{Hash, Hasher};
use std::io::Write;
use std::path::Path;

use crate::group::{bytes, outermost};
use crate::list::Mutant;
use crate::tree::fault;
use crate::unit::units;

/// What came of a mutant.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Debug)]
pub enum Outcome {
    /// It is no program.
    Unviable,
    /// No variable can switch it.
    Apart,
    /// A test failed.
    Killed,
    /// A test did not end.
    TimedOut,
    /// Every test passed.
    Survived,
}

/// Outcomes by their word in the file.
const WORDS: &[(Outcome, &str)] = &[
    (Outcome::Unviable, "unviable"),
    (Outcome::Apart, "apart"),
    (Outcome::Killed, "killed"),
    (Outcome::TimedOut, "timed out"),
    (Outcome::Survived, "survived"),
];

impl Outcome {
    /// Its word in the file.
    #[must_use]
    pub fn word(self) -> &'static str {
        WORDS.iter().find(|(outcome, _)| *outcome == self).map_or("", |(_, word)| word)
    }

    fn from_word(word: &str) -> Option<Self> {
        WORDS.iter().find(|(_, w)| *w == word).map(|(outcome, _)| *outcome)
    }
}

/// What a mutant is known by as long as its function does not change, wherever that moves: a sum over the file's name,
/// the text of the function, the place in it, the replacement, and how many functions of the same text stand before. In
/// the order of `mutants`, which are those of one file.
///
/// # Errors
/// Words that say where the text is no Rust.
pub fn keys(text: &str, mutants: &[&Mutant]) -> Result<Vec<u64>, String> {
    let units = units(text)?;
    let mut seen = BTreeMap::new();
    let key = |mutant: &&Mutant| {
        let span = bytes(text, mutant);
        // Outside any body: the line it is in.
        let line = text.get(..span.start).unwrap_or("").rfind('\n').map_or(0, |at| at + 1);
        let body = outermost(&units, &span).unwrap_or(line..span.end);
        let mut sum = DefaultHasher::new();
        let place = (span.start - body.start, span.len());
        (&mutant.file, text.get(body).unwrap_or(""), place, &mutant.replacement).hash(&mut sum);
        let before = seen.entry(sum.finish()).or_insert(0_usize);
        if *before > 0 {
            before.hash(&mut sum);
        }
        *before += 1;
        sum.finish()
    };
    Ok(mutants.iter().map(key).collect())
}

/// The outcomes in the file at `path`, by their key; of two the later one. None when there is no file.
#[must_use]
pub fn read(path: &Path) -> BTreeMap<u64, Outcome> {
    let text = fs::read_to_string(path).unwrap_or_default();
    let line = |line: &str| {
        let mut cells = line.split('\t');
        Some((u64::from_str_radix(cells.next()?, 16).ok()?, Outcome::from_word(cells.next()?)?))
    };
    text.lines().filter_map(line).collect()
}

/// Adds a line to the file at `path`.
///
/// # Errors
/// Words that name the file that cannot be written.
pub fn append(path: &Path, key: u64, outcome: Outcome, by: &str, mutant: &Mutant) -> Result<(), String> {
    let mut file = OpenOptions::new().create(true).append(true).open(path).map_err(fault(path))?;
    let line = mutant.span.0.line;
    let row = format!("{key:016x}\t{}\t{by}\t{}:{line}: {}\n", outcome.word(), mutant.file, mutant.name);
    file.write_all(row.as_bytes()).map_err(fault(path))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::list::Place;

    fn key(text: &str, line: usize, column: usize) -> u64 {
        let span = (Place { line, column }, Place { line, column: column + 1 });
        let mutant = Mutant { file: "src/a.rs".into(), name: "m".into(), span, replacement: "-".into() };
        keys(text, &[&mutant]).unwrap()[0]
    }

    #[test]
    fn a_key_moves_with_its_function_and_changes_with_it() {
        let here = key("fn f() { 1 + 2 + 3 }", 1, 12);
        assert_eq!(here, key("// Moved.\n\nfn f() { 1 + 2 + 3 }", 3, 12));
        assert_ne!(here, key("fn f() { 1 + 2 + 3 }", 1, 16));
        assert_ne!(here, key("fn f() { 1 + 2 + 4 }", 1, 12));
    }

    #[test]
    fn functions_of_the_same_text_are_told_apart() {
        let text = "fn f() { 1 + 2 }\nfn g() { 1 + 2 }";
        let at = |line| (Place { line, column: 12 }, Place { line, column: 13 });
        let mutant =
            |line| Mutant { file: "src/a.rs".into(), name: "m".into(), span: at(line), replacement: "-".into() };
        let keys = keys(text, &[&mutant(1), &mutant(2)]).unwrap();
        assert_ne!(keys[0], keys[1]);
        assert_eq!(keys[0], key("fn f() { 1 + 2 }", 1, 12), "the first keeps the key that it has alone");
    }

    #[test]
    fn what_is_written_is_read_and_the_later_line_holds() {
        let path = std::env::temp_dir().join(format!("wildpoint-mutants-{}.tsv", std::process::id()));
        let span = (Place { line: 1, column: 1 }, Place { line: 1, column: 2 });
        let mutant = Mutant { file: "src/a.rs".into(), name: "m".into(), span, replacement: "-".into() };
        append(&path, 7, Outcome::Survived, "", &mutant).unwrap();
        append(&path, 8, Outcome::TimedOut, "a::b", &mutant).unwrap();
        append(&path, 7, Outcome::Killed, "a::b", &mutant).unwrap();
        assert_eq!(read(&path), BTreeMap::from([(7, Outcome::Killed), (8, Outcome::TimedOut)]));
        fs::remove_file(&path).unwrap();
    }
}
