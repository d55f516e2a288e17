//! Markup within a line: code, emphasis, links, pictures.

/// The text without its markup. Links to pages are their text, links into the web have their address behind them.
pub(super) fn plain(text: &str) -> String {
    let mut out = String::with_capacity(text.len());
    // Every second part is code, in which nothing is markup.
    for (i, part) in text.split('`').enumerate() {
        match i % 2 {
            // Several words of code are told from the text around them.
            1 if part.contains(' ') => out.push_str(&format!("`{}`", part.replace("\\|", "|"))),
            1 => out.push_str(&part.replace("\\|", "|")),
            _ => out.push_str(&unmarked(part)),
        }
    }
    out
}

fn unmarked(text: &str) -> String {
    let mut out = String::with_capacity(text.len());
    let mut rest = text;
    while let Some(at) = rest.find(['[', '*', '\\', '<']) {
        let (before, here) = rest.split_at(at);
        out.push_str(before);
        rest = match here.as_bytes() {
            [b'[', ..] => link(here, &mut out),
            [b'*', b'*', ..] => &here[2..],
            // An asterisk between blanks is a product.
            [b'*', b' ', ..] if out.ends_with(' ') => pushed(here, 1, &mut out),
            [b'*', ..] => &here[1..],
            [b'\\', next, ..] if next.is_ascii_punctuation() => pushed(&here[1..], 1, &mut out),
            [b'<', ..] if here.starts_with("<http") => &here[1..],
            _ => pushed(here, 1, &mut out),
        };
    }
    out + rest
}

/// Takes over the first bytes as they are.
fn pushed<'a>(text: &'a str, count: usize, out: &mut String) -> &'a str {
    out.push_str(&text[..count]);
    &text[count..]
}

/// Takes over a link; gives what follows.
fn link<'a>(here: &'a str, out: &mut String) -> &'a str {
    let parts = here[1..].split_once("](").and_then(|(words, rest)| Some((words, rest.split_once(')')?)));
    let Some((words, (target, after))) = parts.filter(|(words, _)| !words.contains('[')) else {
        return pushed(here, 1, out);
    };
    if out.ends_with('!') {
        out.pop();
        out.push_str(&format!("[picture: {words}]"));
    } else if target.contains("://") {
        out.push_str(&format!("{} <{target}>", unmarked(words)));
    } else {
        out.push_str(&unmarked(words));
    }
    after
}

#[cfg(test)]
mod tests {
    use super::plain;

    #[test]
    fn markup_goes_and_words_stay() {
        for (marked, wanted) in [
            ("**Run** `a * b` and *see* it", "Run `a * b` and see it"),
            ("[Verdicts](explanation/verdicts.md), [web](https://e.org)", "Verdicts, web <https://e.org>"),
            ("![A flag](x.svg)", "[picture: A flag]"),
            ("`a\\|b` or a\\|b, sum (k * s), [001] s.2", "a|b or a|b, sum (k * s), [001] s.2"),
        ] {
            assert_eq!(plain(marked), wanted);
        }
    }
}
