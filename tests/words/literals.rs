//! The texts in a source file.

/// The strings of Rust code with their lines, and its doc comments where they are `shown`. Strings of one word without a
/// letter, and reasons of lints, are no texts.
pub(crate) fn literals(code: &str, shown: bool) -> Vec<(usize, String)> {
    let mut found = Vec::new();
    let mut rest = code;
    let mut comment = String::new();
    let at = |rest: &str| code[..code.len() - rest.len()].lines().count().max(1);
    while !rest.is_empty() {
        let line = rest.lines().next().unwrap_or_default();
        if let Some(text) = rest.strip_prefix("///").filter(|_| shown) {
            let text = text.lines().next().unwrap_or_default();
            comment.push_str(&format!("{text} "));
            rest = &rest[line.len()..];
        } else if rest.starts_with("//") {
            rest = &rest[line.len()..];
        } else if let Some(length) = character(rest) {
            rest = &rest[length..];
        } else if let Some((text, length)) = raw(rest).or_else(|| quoted(rest)) {
            let before = &code[..code.len() - rest.len()];
            if !before.ends_with("reason = ") && text.chars().any(char::is_alphabetic) {
                found.push((at(rest), text));
            }
            rest = &rest[length..];
        } else {
            let c = rest.chars().next().map_or(1, char::len_utf8);
            if !comment.is_empty() && !rest.starts_with(char::is_whitespace) {
                found.push((at(rest), std::mem::take(&mut comment)));
            }
            rest = &rest[c..];
        }
    }
    found
}

/// The comments of Rust code with the lines on which they begin; lines that follow each other are one.
pub(crate) fn comments(code: &str) -> Vec<(usize, String)> {
    let mut found: Vec<(usize, String)> = Vec::new();
    let mut last = 0;
    for (number, line) in (1..).zip(code.lines()) {
        let Some(text) = line.trim_start().strip_prefix("//") else { continue };
        let text = text.trim_start_matches(['/', '!']);
        match found.last_mut() {
            Some((_, whole)) if last + 1 == number => *whole = format!("{whole} {text}"),
            _ => found.push((number, text.to_owned())),
        }
        last = number;
    }
    found
}

/// The length of a character literal; none for a lifetime.
fn character(text: &str) -> Option<usize> {
    let inside = text.strip_prefix('\'')?;
    let length = if inside.starts_with('\\') { inside[2..].find('\'')? + 2 } else { inside.chars().next()?.len_utf8() };
    inside[length..].starts_with('\'').then_some(length + 2)
}

/// A raw string and its length.
fn raw(text: &str) -> Option<(String, usize)> {
    let hashes = text.strip_prefix('r')?.bytes().take_while(|b| *b == b'#').count();
    let inside = text[1 + hashes..].strip_prefix('"')?;
    let end = format!("\"{}", "#".repeat(hashes));
    let length = inside.find(&end)?;
    Some((inside[..length].to_owned(), 2 + hashes + length + end.len()))
}

/// A string and its length; a line that is continued goes on without its indent.
fn quoted(text: &str) -> Option<(String, usize)> {
    let inside = text.strip_prefix('"')?;
    let mut out = String::new();
    let mut chars = inside.char_indices();
    while let Some((i, c)) = chars.next() {
        match c {
            '"' => return Some((out, i + 2)),
            '\\' => match chars.next()?.1 {
                '\n' => {
                    let indent = inside[i + 2..].len() - inside[i + 2..].trim_start().len();
                    inside[i + 2..i + 2 + indent].chars().for_each(|_| {
                        chars.next();
                    });
                }
                'n' | 't' => out.push(' '),
                c => out.push(c),
            },
            c => out.push(c),
        }
    }
    None
}

#[test]
fn strings_and_shown_comments_are_found() {
    let code =
        "/// Shown\n/// here.\nlet a = \"one \\\n    two\"; // not \"this\"\nlet c = '\"'; let b = r#\"a \"b\"\"#;\n";
    assert_eq!(
        literals(code, true),
        [(2, " Shown  here. ".to_owned()), (3, "one two".to_owned()), (5, "a \"b\"".to_owned())]
    );
    assert_eq!(literals(code, false).len(), 2);
}

#[test]
fn lines_of_a_comment_are_read_together() {
    let code = "//! One\n//! two.\n\nlet a = 1;\n    // three\n    // four\n    let b = \"// no\";\n";
    assert_eq!(comments(code), [(1, " One  two.".to_owned()), (5, " three  four".to_owned())]);
}
