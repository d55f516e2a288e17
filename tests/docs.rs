//! The README keeps its word: the generated parts are those of this program, and its commands are real.
//! `WILDPOINT_UPDATE=1 cargo test --test docs` writes the generated parts again.

use std::path::PathBuf;

use wildpoint::session::{Session, Setup};
use wildpoint::track::{LoadOptions, Source, load};
use wildpoint::tui::plot::Glyphs;
use wildpoint::tui::theme::Theme;
use wildpoint::tui::{Look, Opening, still};

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
        _ => panic!("the README has no part {name}"),
    }
}

#[test]
fn frame_methods_and_keys_of_the_readme_are_those_of_the_program() {
    let old = std::fs::read_to_string(path()).expect("the README is there");
    let frame = frame().expect("the built-in record can be judged");
    let mut new = with_part(&old, "frame", &format!("```text\n{}\n```\n", frame.trim_end()));
    new = with_part(&new, "methods", &wildpoint::batch::methods_table());
    new = with_part(&new, "keys", &wildpoint::tui::keys::markdown());
    if std::env::var_os("WILDPOINT_UPDATE").is_some() {
        std::fs::write(path(), &new).expect("the README can be written");
    }
    let now = std::fs::read_to_string(path()).expect("the README is there");
    let first = now.lines().zip(new.lines()).position(|(a, b)| a != b);
    assert!(now == new, "README.md is stale from line {:?} on: run WILDPOINT_UPDATE=1 cargo test --test docs", first);
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
