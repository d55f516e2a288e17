//! The words of the program are those of `docs/terms.md`: no text that a user can read has a word that the page rules out.

#![expect(clippy::expect_used, reason = "a test that cannot read its own data may say so by ending")]

#[path = "words/literals.rs"]
mod literals;

use std::path::{Path, PathBuf};

/// Where texts of the program are.
const SOURCES: [&str; 3] = ["src", "crates/core/src", "crates/record/src"];
/// Doc comments that are shown: those of the command line.
const SHOWN: &str = "src/cli";
/// Where the words are those of the source documents, or are listed.
const QUOTING: [&str; 8] = [
    "docs/terms.md",
    "docs/methods.md",
    "docs/references.md",
    "src/experiment/gan",
    "src/experiment/hou",
    "src/experiment/jiang",
    "src/experiment/jin",
    "src/experiment/qin",
];
/// Texts that are part of saved results and stay what they are.
const KEPT: [&str; 3] = ["patch", "patches", "stands for no value"];

fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

fn below(folder: &Path) -> Vec<PathBuf> {
    let entries = std::fs::read_dir(folder).expect("the folder is there").map(|e| e.expect("an entry").path());
    let mut files: Vec<PathBuf> =
        entries.flat_map(|path| if path.is_dir() { below(&path) } else { vec![path] }).collect();
    files.sort();
    files
}

/// A text that a user can read.
struct Shown {
    place: String,
    text: String,
}

/// The texts of the program: strings, and the comments that become help.
fn texts_of_the_program() -> Vec<Shown> {
    let mut all = Vec::new();
    for path in SOURCES.iter().flat_map(|folder| below(&root().join(folder))) {
        let name = path.strip_prefix(root()).expect("inside").to_string_lossy().into_owned();
        let tests = name.contains("tests") || QUOTING.iter().any(|quoting| name.starts_with(quoting));
        if !name.ends_with(".rs") || tests {
            continue;
        }
        let source = std::fs::read_to_string(&path).expect("a source file");
        let code = source.split("\n#[cfg(test)]\nmod tests {").next().unwrap_or_default();
        let found = literals::literals(code, name.starts_with(SHOWN));
        all.extend(found.into_iter().map(|(line, text)| Shown { place: format!("{name}:{line}"), text }));
    }
    all
}

/// The lines of the pages, without blocks of code.
fn texts_of_the_pages() -> Vec<Shown> {
    let mut pages = below(&root().join("docs"));
    pages.extend(["README.md", "CONTRIBUTING.md", "CHANGELOG.md"].map(|name| root().join(name)));
    let mut all = Vec::new();
    for path in pages.into_iter().filter(|p| p.extension().is_some_and(|e| e == "md")) {
        let name = path.strip_prefix(root()).expect("inside").to_string_lossy().into_owned();
        if QUOTING.contains(&&*name) {
            continue;
        }
        let mut code = false;
        for (number, line) in std::fs::read_to_string(&path).expect("a page").lines().enumerate() {
            code ^= line.trim_start().starts_with("```");
            if !code {
                all.push(Shown { place: format!("{name}:{}", number + 1), text: line.to_owned() });
            }
        }
    }
    all
}

/// A word that is not used, and the one in its place.
struct Term {
    not: String,
    instead: String,
}

/// The table of the page.
fn terms() -> Vec<Term> {
    let page = std::fs::read_to_string(root().join("docs/terms.md")).expect("the page");
    let rows = page.lines().filter(|l| l.starts_with("| ")).skip(1);
    rows.flat_map(|row| {
        let cells: Vec<&str> = row.trim_matches('|').split(" | ").map(str::trim).collect();
        let [instead, _, not] = cells.as_slice() else { panic!("{row}: three cells") };
        // A comma at the start belongs to the word.
        let (first, rest) = not.split_at(usize::from(not.starts_with(',')));
        let words = rest.split(", ").map(move |word| format!("{first}{word}"));
        words.map(|not| Term { not: not.to_lowercase(), instead: (*instead).to_owned() }).collect::<Vec<_>>()
    })
    .collect()
}

/// The text without what is between backticks, in small letters, its blanks single.
fn plain(text: &str) -> String {
    let outside: Vec<&str> = text.split('`').step_by(2).collect();
    outside.join("` `").split_whitespace().collect::<Vec<_>>().join(" ").to_lowercase()
}

/// Whether the text has the word, and not only as a part of another.
fn has(text: &str, word: &str) -> bool {
    text.match_indices(word).any(|(at, _)| {
        let before = text[..at].chars().next_back();
        let after = text[at + word.len()..].chars().next();
        // The name of an option or of a key goes on with these.
        let inside = |c: Option<char>| c.is_some_and(|c| c.is_alphanumeric() || c == '_' || c == '-');
        // A comma begins a word by itself.
        let starts = word.starts_with(char::is_alphanumeric);
        !(inside(after) || starts && inside(before))
    })
}

#[test]
fn no_text_has_a_word_that_the_terms_rule_out() {
    let terms = terms();
    assert!(terms.len() > 30, "the table is read: {}", terms.len());
    let (program, pages) = (texts_of_the_program(), texts_of_the_pages());
    assert!(program.len() > 2000 && pages.len() > 500, "texts are seen: {} and {}", program.len(), pages.len());
    let mut found = Vec::new();
    for shown in program.iter().chain(&pages).filter(|shown| !KEPT.contains(&&*shown.text)) {
        let text = plain(&shown.text);
        for term in terms.iter().filter(|term| has(&text, &term.not)) {
            found.push(format!("{}: `{}` (use: {}): {}", shown.place, term.not, term.instead, shown.text.trim()));
        }
    }
    assert!(found.is_empty(), "{} texts:\n{}", found.len(), found.join("\n"));
}

#[test]
fn the_check_itself_can_fail() {
    assert!(has(&plain("a Patch of 5"), "patch") && !has(&plain("dispatch, `patch`, --patches"), "patch"));
    assert!(has(&plain("give it a number, say"), ", say") && !has(&plain("give it a number"), ", say"));
}
