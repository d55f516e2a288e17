//! A page of Markdown as plain text of a width. It knows what the pages use: headings, paragraphs, lists, tables, code.

use super::inline::plain;
use super::table::table;
use crate::wrapped::wrapped;

/// The page as text.
pub(super) fn rendered(page: &str, width: usize) -> String {
    let mut out = String::new();
    let lines: Vec<&str> = page.lines().collect();
    let mut at = 0;
    while let Some(&line) = lines.get(at) {
        let here = &lines[at..];
        let (text, used) = match line.trim_start() {
            "" => (String::new(), 1),
            fence if fence.starts_with("```") => code(here),
            comment if comment.starts_with("<!--") => (String::new(), 1),
            heading if heading.starts_with('#') => (headed(heading), 1),
            row if row.starts_with('|') => {
                let rows = here.iter().take_while(|l| l.trim_start().starts_with('|')).count();
                (table(&here[..rows], width), rows)
            }
            _ => paragraph(here, width),
        };
        // One empty line between blocks, none between the items of a list.
        let close = item(line).is_some() && at > 0 && !lines[at - 1].trim().is_empty();
        if !text.is_empty() && !out.is_empty() && !close {
            out.push('\n');
        }
        out += &text;
        at += used;
    }
    out
}

/// A heading, the title underlined.
fn headed(line: &str) -> String {
    let text = plain(line.trim_start_matches('#').trim());
    let title = line.starts_with("# ");
    if title {
        format!("{text}\n{}\n", "=".repeat(unicode_width::UnicodeWidthStr::width(text.as_str())))
    } else {
        text + "\n"
    }
}

/// A fenced block, as it is.
fn code(lines: &[&str]) -> (String, usize) {
    let indent = lines[0].len() - lines[0].trim_start().len();
    let inside = lines[1..].iter().take_while(|line| !line.trim_start().starts_with("```"));
    let text: Vec<String> = inside.map(|line| format!("    {}\n", line.get(indent..).unwrap_or_default())).collect();
    (text.concat(), (text.len() + 2).min(lines.len()))
}

/// A paragraph, or an item of a list with the lines that go on with it.
fn paragraph(lines: &[&str], width: usize) -> (String, usize) {
    let more = lines[1..].iter().take_while(|line| goes_on(line)).count();
    let text = lines[..=more].iter().map(|line| line.trim()).collect::<Vec<_>>().join(" ");
    let indent = lines[0].len() - lines[0].trim_start().len();
    let first = " ".repeat(indent);
    let (mark, text) = item(lines[0]).map_or(("", text.as_str()), |mark| (mark, text[mark.len()..].trim_start()));
    let (first, next) = match mark {
        "" => (first.clone(), first),
        mark => (format!("{first}{mark} "), " ".repeat(indent + mark.len() + 1)),
    };
    (wrapped(&plain(text), width, (&first, &next)).join("\n") + "\n", more + 1)
}

/// The mark of an item: `-` or a number.
fn item(line: &str) -> Option<&str> {
    let line = line.trim_start();
    let mark = line.split(' ').next()?;
    let number = mark.strip_suffix('.').is_some_and(|n| !n.is_empty() && n.bytes().all(|b| b.is_ascii_digit()));
    (mark == "-" || number).then_some(mark)
}

/// Whether a line belongs to the paragraph before it.
fn goes_on(line: &str) -> bool {
    let text = line.trim_start();
    !text.is_empty() && item(line).is_none() && !["```", "<!--", "#", "|"].iter().any(|mark| text.starts_with(mark))
}

#[cfg(test)]
mod tests {
    use super::rendered;

    #[test]
    fn headings_paragraphs_lists_and_code() {
        let page = "# A *page*\n\nTwo lines\nof text.\n<!-- keys -->\n\n- one that goes\n  on\n- two\n\n   ```sh\n   ls  -l\n   ```\n\n## More\n";
        let wanted = "A page\n======\n\nTwo lines of\ntext.\n\n- one that goes\n  on\n- two\n\n    ls  -l\n\nMore\n";
        assert_eq!(rendered(page, 15), wanted);
    }
}
