//! The manual in the terminal: pages of `docs/`, wrapped to its width.

use std::io::{IsTerminal, Write};
use std::process::{Command, Stdio};

use clap::CommandFactory;
use unicode_width::UnicodeWidthStr;

use crate::batch::{is_explained, methods_page};
use crate::cli::Cli;
use crate::error::{Error, Result, nearest};

mod inline;
mod pages;
mod render;
mod table;

pub use pages::{PAGES, Page};

/// Columns where the output is not a terminal.
const WIDTH: usize = 80;
/// Columns at most: longer lines are hard to read.
const WIDEST: usize = 100;

/// What `wildpoint help TOPIC` shows: a page, the help of a command, or a method; without a topic, the list of topics.
///
/// # Errors
/// [`Error::Usage`] for an unknown topic.
pub fn text(topic: Option<&str>, width: usize) -> Result<String> {
    let Some(topic) = topic else { return Ok(topics(width)) };
    if let Some(page) = PAGES.iter().find(|page| page.topic == topic) {
        return Ok(render::rendered(page.text, width));
    }
    let mut cli = Cli::command();
    cli.build();
    if let Some(command) = cli.find_subcommand_mut(topic) {
        return Ok(command.clone().render_long_help().to_string());
    }
    if is_explained(topic) {
        return methods_page(topic);
    }
    let names = PAGES.iter().map(|page| page.topic).chain(cli.get_subcommands().map(clap::Command::get_name));
    let hint = nearest(topic, names).map_or(String::new(), |name| format!("did you mean {name}? "));
    Err(Error::usage(format!("{topic}: there is no such topic"), format!("{hint}`wildpoint help` lists the topics")))
}

/// The topics, by kind.
fn topics(width: usize) -> String {
    let mut out = String::from("wildpoint help TOPIC shows a page of the manual, a command, or a method.\n");
    let wide = PAGES.iter().map(|page| page.topic.width()).max().unwrap_or(0);
    let mut kind = "";
    for page in PAGES {
        if page.kind != kind {
            kind = page.kind;
            out += &format!("\n{kind}\n");
        }
        out += &format!("  {:wide$}  {}\n", page.topic, page.title());
    }
    let cli = Cli::command();
    let commands: Vec<&str> = cli.get_subcommands().filter(|c| !c.is_hide_set()).map(clap::Command::get_name).collect();
    out += "\nCommands\n";
    for line in crate::wrapped::wrapped(&commands.join(", "), width, ("  ", "  ")) {
        out += &(line + "\n");
    }
    out + "\nMethods\n  `wildpoint methods` lists them.\n"
}

/// Shows a topic: through `$PAGER` on a terminal, if it is set, otherwise as plain text.
///
/// # Errors
/// As [`text`]; [`Error::Io`] when it cannot be written.
pub fn show(topic: Option<&str>) -> Result<()> {
    let stdout = std::io::stdout();
    let terminal = stdout.is_terminal();
    let size = terminal.then(ratatui::crossterm::terminal::size).and_then(std::result::Result::ok);
    let text = text(topic, size.map_or(WIDTH, |(columns, _)| usize::from(columns).clamp(20, WIDEST)))?;
    let pager = std::env::var("PAGER").ok().filter(|pager| terminal && !pager.trim().is_empty());
    if pager.is_some_and(|pager| paged(&pager, &text)) {
        return Ok(());
    }
    stdout.lock().write_all(text.as_bytes()).map_err(Error::io("write", "standard output"))
}

/// Whether the pager has shown it. A pager may end before it has read everything.
fn paged(pager: &str, text: &str) -> bool {
    let Ok(mut child) = Command::new("sh").args(["-c", pager]).stdin(Stdio::piped()).spawn() else { return false };
    if let Some(mut input) = child.stdin.take() {
        let _ = input.write_all(text.as_bytes());
    }
    // 127: the shell has not found it.
    child.wait().is_ok_and(|status| status.code() != Some(127))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_topic_is_a_page_of_the_width() {
        for page in PAGES {
            let text = text(Some(page.topic), 80).unwrap();
            assert!(text.starts_with(page.title()), "{}: {text}", page.topic);
            let prose = text.lines().filter(|line| !line.starts_with("    "));
            let wide: Vec<&str> = prose.filter(|line| line.width() > 80).collect();
            assert!(wide.is_empty(), "{}: {wide:?}", page.topic);
        }
    }

    #[test]
    fn commands_methods_and_checks_are_topics_and_others_are_guessed() {
        assert!(text(Some("clean"), 80).unwrap().contains("--output"));
        assert!(text(Some("hampel"), 80).unwrap().starts_with("hampel: "));
        assert!(text(Some("stuck"), 80).unwrap().starts_with("stuck: "));
        let wrong = text(Some("tutoral"), 80).unwrap_err().to_string();
        assert!(wrong.contains("did you mean tutorial?"), "{wrong}");
        let all = text(None, 80).unwrap();
        assert!(PAGES.iter().all(|page| all.contains(page.topic)) && all.contains("replay"), "{all}");
    }
}
