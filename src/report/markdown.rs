//! A report as one Markdown file. Its pictures are inside as data, since many readers drop SVG elements.

use std::fmt::Write as _;

use super::html::STYLE;
use super::page::{Page, Section, Table};
use super::svg::STATES;
use crate::plot::FlagState;
use crate::track::printable;

/// Text made safe to stand in a paragraph or a cell.
fn escaped(text: &str) -> String {
    let mut out = String::with_capacity(text.len());
    for c in printable(text).chars() {
        match c {
            '<' => out.push_str("&lt;"),
            '>' => out.push_str("&gt;"),
            '&' => out.push_str("&amp;"),
            '\\' | '`' | '*' | '_' | '{' | '}' | '[' | ']' | '#' | '|' | '~' | '!' | '$' => {
                out.push('\\');
                out.push(c);
            }
            c => out.push(c),
        }
    }
    out
}

/// The page.
pub(super) fn markdown(page: &Page) -> String {
    let (title, byline, outcome) = (escaped(&page.title), escaped(&page.byline), escaped(&page.outcome));
    let mut out = format!("# {title}\n\n{byline}\n\n{outcome}\n\n");
    let facts = page.facts.iter().map(|(name, value)| vec![(*name).to_owned(), value.clone()]).collect();
    table(&Table { head: vec![("record", false), ("", false)], rows: facts, ..Table::default() }, &mut out);
    notes(&page.notes, &mut out);
    out.push_str("## Columns\n\n");
    table(&page.columns, &mut out);
    page.channels.iter().for_each(|section| channel(section, &mut out));
    if !page.references.is_empty() {
        out.push_str("## References\n\n");
        for (cited, document) in &page.references {
            let _ = writeln!(out, "- {}: {}", escaped(cited), escaped(document));
        }
        out.push('\n');
    }
    let _ = write!(out, "## How to reproduce\n\n{}", block(&page.command, "sh"));
    let _ = write!(out, "{}\n\n", escaped(&page.command_note));
    match &page.session {
        Some(session) => out.push_str(&block(session, "toml")),
        None => out.push_str("The session is too long to be repeated here; save it beside this report.\n"),
    }
    out
}

/// Lines in a fence that is longer than any in them.
fn block(text: &str, language: &str) -> String {
    let longest = text.split(|c| c != '`').map(str::len).max().unwrap_or(0);
    let fence = "`".repeat(longest.max(2) + 1);
    let lines: String = text.lines().map(|line| printable(line) + "\n").collect();
    format!("{fence}{language}\n{lines}{fence}\n\n")
}

fn notes(notes: &[String], out: &mut String) {
    for note in notes {
        let _ = writeln!(out, "- {}", escaped(note));
    }
    if !notes.is_empty() {
        out.push('\n');
    }
}

fn channel(section: &Section, out: &mut String) {
    let (title, method) = (escaped(&section.title), escaped(&section.method));
    let _ = write!(out, "## {title}\n\n{method}\n\n{}\n\n", escaped(&section.advice));
    let counts: Vec<String> =
        section.counts.iter().map(|(what, count)| format!("**{}** {}", escaped(count), escaped(what))).collect();
    let _ = write!(out, "{}\n\n", counts.join(" · "));
    notes(&section.notes, out);
    let mut small = false;
    for figure in &section.figures {
        if figure.small && !small {
            let _ = write!(out, "### Largest flags, close up\n\n{}\n\n", escaped(&section.close));
            small = true;
        }
        let caption = escaped(&figure.caption);
        let _ = write!(out, "![{caption}](data:image/svg+xml;base64,{})\n\n{caption}\n\n", base64(&alone(&figure.svg)));
    }
    let marks: Vec<String> = STATES.iter().map(|(_, _, shape, words)| format!("{shape} {words}")).collect();
    let _ = write!(out, "{} · + repaired\n\n### Settings that matter\n\n", marks.join(" · "));
    table(&section.settings, out);
    if let Some(compared) = &section.compared {
        out.push_str("### Methods compared on this record\n\n");
        notes(&compared.lines, out);
        if !compared.table.rows.is_empty() {
            table(&compared.table, out);
        }
    }
    out.push_str("### Flags and decisions\n\n");
    if !section.listed.is_empty() {
        let _ = write!(out, "{}\n\n", escaped(&section.listed));
    }
    if !section.flags.rows.is_empty() {
        table(&section.flags, out);
    }
}

fn table(table: &Table, out: &mut String) {
    let row = |cells: Vec<String>| format!("| {} |\n", cells.join(" | "));
    let shape = |mark: &Option<FlagState>| STATES.iter().find(|s| Some(s.0) == *mark).map_or("", |s| s.2).to_owned();
    let first = |cell: String| (!table.marks.is_empty()).then_some(cell).into_iter();
    let head = table.head.iter();
    out.push_str(&row(first(String::new()).chain(head.clone().map(|(name, _)| escaped(name))).collect()));
    let rule = head.map(|(_, number)| if *number { "--:" } else { "---" }.to_owned());
    out.push_str(&row(first("---".into()).chain(rule).collect()));
    for (at, cells) in table.rows.iter().enumerate() {
        let mark = table.marks.get(at).map(shape).into_iter();
        let mut cells: Vec<String> = cells.iter().map(|cell| escaped(cell)).collect();
        let note = table.notes.get(at).filter(|note| !note.is_empty());
        if let (Some(note), Some(last)) = (note, cells.last_mut()) {
            last.push_str(&format!("; note: {}", escaped(note)));
        }
        out.push_str(&row(mark.chain(cells).collect()));
    }
    out.push('\n');
}

/// A picture that stands by itself: with its own style.
fn alone(svg: &str) -> String {
    match svg.find('>') {
        Some(at) => format!("{}<style>{STYLE}</style>{}", &svg[..=at], &svg[at + 1..]),
        None => svg.to_owned(),
    }
}

/// Base 64 (RFC 4648, section 4).
fn base64(text: &str) -> String {
    const DIGITS: &[u8; 64] = b"ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    let mut out = String::with_capacity(text.len() * 4 / 3 + 4);
    for part in text.as_bytes().chunks(3) {
        let bits = part.iter().fold(0_u32, |bits, b| bits << 8 | u32::from(*b)) << (8 * (3 - part.len()));
        for digit in 0..4 {
            let index = (bits >> (18 - 6 * digit)) as usize & 63;
            out.push(if digit <= part.len() { char::from(DIGITS[index]) } else { '=' });
        }
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn base64_is_that_of_the_rfc() {
        // RFC 4648, section 10.
        let vectors =
            [("", ""), ("f", "Zg=="), ("fo", "Zm8="), ("foo", "Zm9v"), ("foob", "Zm9vYg=="), ("foobar", "Zm9vYmFy")];
        for (plain, coded) in vectors {
            assert_eq!(base64(plain), coded);
        }
    }

    #[test]
    fn nothing_in_a_text_is_markup() {
        assert_eq!(escaped("a|b <script> *x* `y` [l](u)"), r"a\|b &lt;script&gt; \*x\* \`y\` \[l\](u)");
        assert!(block("a\n```\nb\n", "sh").starts_with("````sh\n"), "the fence is longer than those inside");
    }
}
