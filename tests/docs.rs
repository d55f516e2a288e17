//! The pages keep their word: the generated parts are those of this program, commands and links are real, and
//! `wildpoint help` shows every page. `WILDPOINT_UPDATE=1 cargo test --test docs` writes the generated parts again.

#![expect(clippy::expect_used, reason = "a test that cannot read its own data may say so by ending")]

#[path = "docs/parts.rs"]
mod parts;
#[path = "docs/snippets.rs"]
mod snippets;

use std::path::{Path, PathBuf};

use wildpoint::manual::PAGES;
use wildpoint::method::{METHODS, voting};
use wildpoint::repair;

fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

fn read(path: &Path) -> String {
    std::fs::read_to_string(path).unwrap_or_else(|e| panic!("{}: {e}", path.display()))
}

/// The files below a folder.
fn below(folder: &Path) -> Vec<PathBuf> {
    let entries = std::fs::read_dir(folder).expect("the folder is there").map(|e| e.expect("an entry").path());
    entries.flat_map(|path| if path.is_dir() { below(&path) } else { vec![path] }).collect()
}

/// The pages of the book, by their paths.
fn book() -> Vec<PathBuf> {
    let mut pages: Vec<PathBuf> =
        below(&root().join("docs")).into_iter().filter(|p| p.extension().is_some_and(|e| e == "md")).collect();
    pages.sort();
    pages
}

/// The pages that people read: the book, and those in the root.
fn pages() -> Vec<PathBuf> {
    let mut pages = book();
    pages.extend(["README.md", "CONTRIBUTING.md"].map(|name| root().join(name)));
    pages
}

/// The text with what is between the markers of `name` replaced.
fn with_part(text: &str, name: &str, part: &str) -> String {
    let (open, close) = (format!("<!-- {name} -->\n"), format!("<!-- /{name} -->"));
    let start = text.find(&open).map(|at| at + open.len());
    let end = text.find(&close);
    match (start, end) {
        (Some(start), Some(end)) if start <= end => format!("{}{part}{}", &text[..start], &text[end..]),
        _ => panic!("the page has no part {name}"),
    }
}

#[test]
fn the_generated_parts_are_those_of_the_program() {
    for (page, parts) in parts::all() {
        let path = root().join("docs").join(page);
        let new = parts.iter().fold(read(&path), |text, (name, part)| with_part(&text, name, part));
        if std::env::var_os("WILDPOINT_UPDATE").is_some() {
            std::fs::write(&path, &new).expect("the page can be written");
        }
        let now = read(&path);
        let first = now.lines().zip(new.lines()).position(|(a, b)| a != b);
        assert!(
            now == new,
            "docs/{page} is stale from line {first:?} on: run WILDPOINT_UPDATE=1 cargo test --test docs"
        );
    }
}

/// Parts that measurements write: `cargo bench` and `python/bench`.
const MEASURED: [&str; 4] = ["benchmarks", "engines", "costs", "pilot"];

/// Every part between markers is written by this test, but for those that measurements write.
#[test]
fn no_generated_part_is_forgotten() {
    let known = parts::all();
    for page in book() {
        let name = page.strip_prefix(root().join("docs")).expect("inside docs").to_string_lossy().into_owned();
        for marker in read(&page).lines().filter_map(|l| l.strip_prefix("<!-- /")?.strip_suffix(" -->")) {
            let made = known.iter().any(|(page, parts)| *page == name && parts.iter().any(|(part, _)| *part == marker));
            assert!(made || MEASURED.contains(&marker), "docs/{name}: nobody writes the part {marker}");
        }
    }
}

#[test]
fn the_readme_is_short_and_counts_right() {
    let text = read(&root().join("README.md"));
    let lines = text.lines().count();
    assert!(lines <= 110, "{lines} lines");
    // The consensus is of the others.
    assert!(text.contains(&format!("All {} methods", voting().count())));
}

/// The targets of the links of a page, without those into the web.
fn links(text: &str) -> Vec<String> {
    let targets = text.split("](").skip(1).filter_map(|rest| rest.split_once(')')).map(|(target, _)| target);
    targets.filter(|t| !t.contains("://") && !t.contains(' ')).map(str::to_owned).collect()
}

/// What is between backticks and looks like a path of this repository.
fn paths(text: &str) -> Vec<String> {
    let quoted = text.split('`').skip(1).step_by(2);
    let tops = ["src/", "crates/", "tests/", "docs/", "fuzz/", "benches/", "data/"];
    let literal = |p: &&str| tops.iter().any(|top| p.starts_with(top)) && !p.contains(['*', ' ']);
    let own = |p: &&str| !p.contains("your_method") && !p.contains("ID");
    quoted.filter(literal).filter(own).map(str::to_owned).collect()
}

/// The anchor that a heading has in a page.
fn anchor(heading: &str) -> String {
    let text = heading.trim_start_matches('#').trim().to_lowercase();
    let kept = text.chars().filter(|c| c.is_alphanumeric() || [' ', '-', '_'].contains(c));
    kept.map(|c| if c == ' ' { '-' } else { c }).collect()
}

#[test]
fn the_pages_lead_to_what_is_there() {
    let mut seen = 0;
    for page in pages() {
        let text = read(&page);
        let folder = page.parent().expect("a folder");
        for link in links(&text) {
            let (file, place) = link.split_once('#').unwrap_or((&link, ""));
            let target = if file.is_empty() { page.clone() } else { folder.join(file) };
            assert!(target.exists(), "{}: {link} leads nowhere", page.display());
            let found = place.is_empty() || read(&target).lines().any(|l| l.starts_with('#') && anchor(l) == place);
            assert!(found, "{}: {link}: no such heading", page.display());
            seen += 1;
        }
        for path in paths(&text) {
            assert!(root().join(&path).exists(), "{}: there is no {path}", page.display());
            seen += 1;
        }
    }
    assert!(seen > 100, "links and paths are seen: {seen}");
}

#[test]
fn the_book_lists_every_page_and_help_shows_it() {
    let summary = links(&read(&root().join("docs/SUMMARY.md")));
    // Pages for developers, and the list of commands, which `help COMMAND` shows in parts.
    let elsewhere =
        ["index.md", "architecture.md", "testing.md", "benchmarks.md", "reference/commands.md", "reference/methods.md"];
    for page in book() {
        let name = page.strip_prefix(root().join("docs")).expect("inside docs").to_string_lossy().into_owned();
        if name == "SUMMARY.md" {
            continue;
        }
        assert!(summary.contains(&name), "docs/SUMMARY.md does not list {name}");
        assert!(
            elsewhere.contains(&&*name) != PAGES.iter().any(|p| p.file == name),
            "{name}: in `help`, or elsewhere?"
        );
    }
}

#[test]
fn the_methods_page_has_every_method_and_parameter() {
    let text = read(&root().join("docs/methods.md"));
    let quoted: Vec<&str> = text.split('`').skip(1).step_by(2).collect();
    // `update = winsor` names the parameter `update`.
    let named = |key: &str| quoted.iter().any(|q| *q == key || q.split(" = ").next() == Some(key));
    let mut missing: Vec<String> = Vec::new();
    for method in METHODS {
        let about = method.about();
        let keys = std::iter::once(about.id).chain(about.params.iter().map(|p| p.key));
        missing.extend(keys.filter(|key| !named(key)).map(|key| format!("{} {key}", about.id)));
    }
    let of_repair = repair::PARAMS.iter().map(|p| p.key).filter(|key| *key != repair::METHOD.key && !named(key));
    missing.extend(of_repair.map(|key| format!("repair {key}")));
    assert!(missing.is_empty(), "docs/methods.md does not name: {}", missing.join(", "));
}
