//! The README keeps its word: the generated parts are those of this program, and its commands are real.
//! `WILDPOINT_UPDATE=1 cargo test --test docs` writes the generated parts again. The pages of `docs/` lead only to what is
//! there, and describe every method with its parameters.

#![expect(clippy::expect_used, reason = "a test that cannot read its own data may say so by ending")]

use std::path::{Path, PathBuf};

use wildpoint::method::METHODS;
use wildpoint::repair;
use wildpoint::session::{Session, Setup};
use wildpoint::track::{FORMATS, LoadOptions, Source, load, refused};
use wildpoint::tui::plot::Glyphs;
use wildpoint::tui::theme::Theme;
use wildpoint::tui::{Look, Opening, still};

fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

fn path() -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("README.md")
}

/// The workbench on the built-in record, as `cargo run` shows it.
fn frame() -> Result<String, wildpoint::error::Error> {
    let options = LoadOptions::default();
    let track = load(&Source::demo(), &options)?;
    let session = Session::new(&track, options, &Setup::standard());
    let opening = Opening { track, session, file: None, notes: Vec::new(), own: Vec::new() };
    still(opening, Look { theme: Theme::mono(), glyphs: Glyphs::Unicode }, (112, 32))
}

/// The text with what stands between the markers of `name` replaced.
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
fn frame_methods_and_keys_of_the_readme_are_those_of_the_program() {
    let old = std::fs::read_to_string(path()).expect("the README is there");
    let frame = frame().expect("the built-in record can be judged");
    let mut new = with_part(&old, "frame", &format!("```text\n{}\n```\n", frame.trim_end()));
    new = with_part(&new, "methods", &wildpoint::batch::methods_table());
    new = with_part(&new, "flags", &wildpoint::session::schemes_table());
    new = with_part(&new, "keys", &wildpoint::tui::keys::markdown());
    if std::env::var_os("WILDPOINT_UPDATE").is_some() {
        std::fs::write(path(), &new).expect("the README can be written");
    }
    let now = std::fs::read_to_string(path()).expect("the README is there");
    let first = now.lines().zip(new.lines()).position(|(a, b)| a != b);
    assert!(now == new, "README.md is stale from line {:?} on: run WILDPOINT_UPDATE=1 cargo test --test docs", first);
}

/// A table of two columns or more, as Markdown has it.
fn table(head: &[&str], rows: impl Iterator<Item = Vec<String>>) -> String {
    let line = |cells: &[String]| format!("| {} |\n", cells.join(" | "));
    let names: Vec<String> = head.iter().map(|h| (*h).to_owned()).collect();
    let ruler = format!("|{}\n", "---|".repeat(head.len()));
    // A pipe would part cells.
    rows.map(|row| line(&row.iter().map(|c| c.replace('|', "\\|")).collect::<Vec<_>>()))
        .fold(format!("{}{ruler}", line(&names)), |text, row| text + &row)
}

#[test]
fn the_page_of_what_is_read_is_that_of_the_registry() {
    let path = root().join("docs/what-it-reads.md");
    let old = std::fs::read_to_string(&path).expect("the page is there");
    let formats = FORMATS.iter().map(|f| vec![f.name.into(), f.about.into(), f.known_by.into(), f.maps.into()]);
    let formats = table(&["format", "what it is", "known by", "what is read"], formats);
    let refused = table(&["what", "what converts it"], refused().map(|(name, help)| vec![name.into(), help.into()]));
    let new = with_part(&with_part(&old, "formats", &formats), "refused", &refused);
    if std::env::var_os("WILDPOINT_UPDATE").is_some() {
        std::fs::write(&path, &new).expect("the page can be written");
    }
    let now = std::fs::read_to_string(&path).expect("the page is there");
    assert!(now == new, "docs/what-it-reads.md is stale: run WILDPOINT_UPDATE=1 cargo test --test docs");
}

#[test]
fn the_table_of_advice_on_the_methods_page_is_that_of_the_program() {
    let path = root().join("docs/methods.md");
    let old = std::fs::read_to_string(&path).expect("the page is there");
    let new = with_part(&old, "choices", &wildpoint::batch::choices_table());
    if std::env::var_os("WILDPOINT_UPDATE").is_some() {
        std::fs::write(&path, &new).expect("the page can be written");
    }
    let now = std::fs::read_to_string(&path).expect("the page is there");
    assert!(now == new, "docs/methods.md is stale: run WILDPOINT_UPDATE=1 cargo test --test docs");
}

#[test]
fn the_commands_of_the_readme_exist() {
    use clap::CommandFactory;
    let text = std::fs::read_to_string(path()).expect("the README is there");
    let command = wildpoint::cli::Cli::command();
    let known: Vec<&str> = command.get_subcommands().map(clap::Command::get_name).collect();
    let mut seen = 0;
    for line in text.lines().filter(|l| l.starts_with("wildpoint ") || l.starts_with("cargo run --release -- ")) {
        let line = line.trim_start_matches("cargo run --release -- ").trim_start_matches("wildpoint ");
        let word = line.split_whitespace().next().unwrap_or_default();
        if word.starts_with('-') || word.contains('.') {
            continue;
        }
        assert!(known.contains(&word), "{line}: no such command");
        seen += 1;
    }
    assert!(seen >= 5, "the README shows the commands");
}

/// The pages that people read, by their paths in the repository.
fn pages() -> Vec<PathBuf> {
    let inside = std::fs::read_dir(root().join("docs")).expect("docs is there");
    let pages = inside.map(|e| e.expect("an entry").path()).filter(|p| p.extension().is_some_and(|e| e == "md"));
    pages.chain(["README.md", "CONTRIBUTING.md"].map(|name| root().join(name))).collect()
}

/// The targets of the links of a page, without those into the web.
fn links(text: &str) -> Vec<String> {
    let targets = text.split("](").skip(1).filter_map(|rest| rest.split_once(')')).map(|(target, _)| target);
    targets.filter(|t| !t.contains("://") && !t.contains(' ')).map(str::to_owned).collect()
}

/// What stands between backticks and looks like a path of this repository.
fn paths(text: &str) -> Vec<String> {
    let quoted = text.split('`').skip(1).step_by(2);
    let tops = ["src/", "crates/", "tests/", "docs/", "fuzz/", "benches/", "sessions/"];
    let literal = |p: &&str| tops.iter().any(|top| p.starts_with(top)) && !p.contains(['*', ' ']);
    let own = |p: &&str| !p.contains("your_method") && !p.contains("ID");
    quoted.filter(literal).filter(own).map(str::to_owned).collect()
}

#[test]
fn the_pages_lead_to_what_is_there() {
    let mut seen = 0;
    for page in pages() {
        let text = std::fs::read_to_string(&page).expect("a page");
        let folder = page.parent().expect("a folder");
        for link in links(&text) {
            let file = link.split('#').next().unwrap_or_default();
            assert!(folder.join(file).exists(), "{}: {link} leads nowhere", page.display());
            seen += 1;
        }
        for path in paths(&text) {
            assert!(root().join(&path).exists(), "{}: there is no {path}", page.display());
            seen += 1;
        }
    }
    assert!(seen > 40, "links and paths are seen: {seen}");
    let summary = std::fs::read_to_string(root().join("docs/SUMMARY.md")).expect("the summary");
    for page in std::fs::read_dir(root().join("docs")).expect("docs is there") {
        let name = page.expect("an entry").file_name().to_string_lossy().into_owned();
        let listed = name == "SUMMARY.md" || !name.ends_with(".md") || links(&summary).contains(&name);
        assert!(listed, "docs/SUMMARY.md does not list {name}");
    }
}

#[test]
fn the_methods_page_has_every_method_and_parameter() {
    let text = std::fs::read_to_string(root().join("docs/methods.md")).expect("the page");
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
