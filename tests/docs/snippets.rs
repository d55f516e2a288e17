//! Commands in the pages can be typed: every `wildpoint ...` line of a shell block is understood by the command line.

use clap::Parser;
use wildpoint::cli::Cli;

use super::{pages, read};

/// The lines of the blocks of shell, those that end in a backslash joined with the next.
fn shell(text: &str) -> Vec<String> {
    let mut lines: Vec<String> = Vec::new();
    let (mut inside, mut open) = (false, false);
    for line in text.lines().map(str::trim) {
        if line.starts_with("```") {
            inside = !inside && line == "```sh";
            continue;
        }
        if !inside {
            continue;
        }
        let part = line.trim_end_matches('\\').trim().to_owned();
        match lines.last_mut().filter(|_| open) {
            Some(last) => last.push_str(&format!(" {part}")),
            None => lines.push(part),
        }
        open = line.ends_with('\\');
    }
    lines
}

/// The arguments of the commands in a line, as a shell would part them.
fn commands(line: &str) -> Vec<Vec<String>> {
    let line = line.split(" #").next().unwrap_or_default();
    let starts = ["wildpoint ", "cargo run --release -- "];
    let parts = line.split(['|', ';']).map(str::trim);
    let parts = parts.filter_map(|part| starts.iter().find_map(|start| part.split_once(start)));
    let of = |(_, rest): (&str, &str)| {
        let mut words = vec!["wildpoint".to_owned()];
        let (mut word, mut quote) = (String::new(), None);
        for c in rest.split(['<', '>']).next().unwrap_or_default().chars().chain([' ']) {
            match (c, quote) {
                (c, Some(q)) if c == q => quote = None,
                ('"' | '\'', None) => quote = Some(c),
                (' ', None) if word.is_empty() => {}
                (' ', None) => words.push(std::mem::take(&mut word)),
                (c, _) => word.push(c),
            }
        }
        words
    };
    parts.map(of).collect()
}

#[test]
fn the_commands_of_the_pages_can_be_typed() {
    let mut seen = 0;
    for page in pages() {
        for words in shell(&read(&page)).iter().flat_map(|line| commands(line)) {
            // `...` and words in capitals stand for what the reader puts there.
            if words.iter().any(|word| word.contains("...")) {
                continue;
            }
            let parsed = Cli::try_parse_from(&words);
            let help = parsed.as_ref().err().is_some_and(|e| !e.use_stderr());
            assert!(parsed.is_ok() || help, "{}: {}: {}", page.display(), words.join(" "), parsed.unwrap_err());
            seen += 1;
        }
    }
    assert!(seen >= 25, "{seen} commands are seen");
}

#[test]
fn a_line_is_parted_as_a_shell_does() {
    let line = "zcat a.gz | wildpoint clean - --analyst \"M. Ito\" -o - > out.csv   # a comment";
    assert_eq!(commands(line), [["wildpoint", "clean", "-", "--analyst", "M. Ito", "-o", "-"].map(str::to_owned)]);
}
