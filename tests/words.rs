//! The words of the program are those of `docs/terms.md`: no text that a user can read, no page and no comment has a word
//! that the page rules out there.

#![expect(clippy::expect_used, reason = "a test that cannot read its own data may say so by ending")]

#[path = "words/literals.rs"]
mod literals;

use std::path::{Path, PathBuf};

/// Where comments are, besides the texts of the program.
const COMMENTED: [&str; 5] = ["src", "crates", "tests", "benches", "fuzz"];
/// Comments that have the words as examples.
const EXAMPLES: [&str; 1] = ["tests/words"];
/// Where texts of the program are.
const SOURCES: [&str; 3] = ["src", "crates/core/src", "crates/record/src"];
/// Doc comments that are shown: those of the command line.
const SHOWN: &str = "src/cli";
/// Where the words of source documents are quoted: only what is ruled out everywhere is.
const QUOTING: [&str; 7] = [
    "docs/methods.md",
    "docs/references.md",
    "src/experiment/gan",
    "src/experiment/hou",
    "src/experiment/jiang",
    "src/experiment/jin",
    "src/experiment/qin",
];
/// The page itself.
const PAGE: &str = "docs/terms.md";
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

/// What is ruled out in a text.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Reach {
    /// The words of the first table: it is for those who read the source, or quotes the source documents.
    Everywhere,
    /// Those of both.
    ForUsers,
}

/// A text of the project.
struct Shown {
    place: String,
    reach: Reach,
    text: String,
}

fn reach(name: &str) -> Reach {
    if QUOTING.iter().any(|quoting| name.starts_with(quoting)) { Reach::Everywhere } else { Reach::ForUsers }
}

/// The texts of the program: strings, and the comments that become help.
fn texts_of_the_program() -> Vec<Shown> {
    let mut all = Vec::new();
    for path in SOURCES.iter().flat_map(|folder| below(&root().join(folder))) {
        let name = path.strip_prefix(root()).expect("inside").to_string_lossy().into_owned();
        if !name.ends_with(".rs") || name.contains("tests") {
            continue;
        }
        let source = std::fs::read_to_string(&path).expect("a source file");
        let code = source.split("\n#[cfg(test)]\nmod tests {").next().unwrap_or_default();
        let found = literals::literals(code, name.starts_with(SHOWN));
        let shown = |(line, text)| Shown { place: format!("{name}:{line}"), reach: reach(&name), text };
        all.extend(found.into_iter().map(shown));
    }
    all
}

/// The comments of all source files, each with all of its lines.
fn comments_of_the_source() -> Vec<Shown> {
    let mut all = Vec::new();
    for path in COMMENTED.iter().flat_map(|folder| below(&root().join(folder))) {
        let name = path.strip_prefix(root()).expect("inside").to_string_lossy().into_owned();
        let excepted = EXAMPLES.iter().any(|examples| name.starts_with(examples)) || name.contains("/target/");
        if excepted || !name.ends_with(".rs") {
            continue;
        }
        let source = std::fs::read_to_string(&path).expect("a source file");
        let found = literals::comments(&source).into_iter();
        let reach = Reach::Everywhere;
        all.extend(found.map(|(line, text)| Shown { place: format!("{name}:{line}"), reach, text }));
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
        if name == PAGE {
            continue;
        }
        let mut code = false;
        for (number, line) in std::fs::read_to_string(&path).expect("a page").lines().enumerate() {
            code ^= line.trim_start().starts_with("```");
            if !code {
                let place = format!("{name}:{}", number + 1);
                all.push(Shown { place, reach: reach(&name), text: line.to_owned() });
            }
        }
    }
    all
}

/// A word that is not used, and the one in its place.
struct Term {
    /// Where it is not used.
    reach: Reach,
    not: String,
    instead: String,
}

/// The tables of the page.
fn terms() -> Vec<Term> {
    let page = std::fs::read_to_string(root().join(PAGE)).expect("the page");
    let (everywhere, for_users) = page.split_once("\n## In texts for users\n").expect("two tables");
    let all = [(Reach::Everywhere, everywhere), (Reach::ForUsers, for_users)];
    all.into_iter().flat_map(|(reach, part)| terms_of(reach, part)).collect()
}

fn terms_of(reach: Reach, part: &str) -> Vec<Term> {
    let rows = part.lines().filter(|l| l.starts_with("| ")).skip(1);
    rows.flat_map(|row| {
        let cells: Vec<&str> = row.trim_matches('|').split(" | ").map(str::trim).collect();
        let [instead, _, not] = cells.as_slice() else { panic!("{row}: three cells") };
        // A comma at the start belongs to the word.
        let (first, rest) = not.split_at(usize::from(not.starts_with(',')));
        let words = rest.split(", ").map(move |word| format!("{first}{word}"));
        words.map(|not| Term { reach, not: not.to_lowercase(), instead: (*instead).to_owned() }).collect::<Vec<_>>()
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
    let (program, pages, comments) = (texts_of_the_program(), texts_of_the_pages(), comments_of_the_source());
    let counts = [program.len(), pages.len(), comments.len()];
    assert!(counts[0] > 2000 && counts[1] > 500 && counts[2] > 5000, "texts are seen: {counts:?}");
    let mut found = Vec::new();
    let all = program.iter().chain(&pages).chain(&comments);
    for shown in all.filter(|shown| !KEPT.contains(&&*shown.text)) {
        let text = plain(&shown.text);
        let ruled_out = |term: &&Term| term.reach == Reach::Everywhere || shown.reach == Reach::ForUsers;
        for term in terms.iter().filter(ruled_out).filter(|term| has(&text, &term.not)) {
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
