//! Text of a file made safe to look at.

use std::fmt::Write as _;

/// Combining marks that a base character may carry.
const MOST_MARKS: usize = 2;
/// Characters that are shown of one text.
const LONGEST: usize = 4096;

/// `text` with everything that a terminal would obey, hide or reorder made visible as an escape like `\x1b` or
/// `\u{202e}`: control characters, bidirectional controls, zero-width characters and tags. At most two combining
/// marks stay on a base character, and a very long text ends in `…`. For screens and messages; outputs take the
/// bytes of the file.
#[must_use]
pub fn printable(text: &str) -> String {
    visible(text, LONGEST)
}

/// As [`printable`], for a text of our own in which texts of files stand: its line ends stay, and nothing is cut.
#[must_use]
pub fn printable_lines(text: &str) -> String {
    text.split('\n').map(|line| visible(line, usize::MAX)).collect::<Vec<_>>().join("\n")
}

fn visible(text: &str, longest: usize) -> String {
    let mut safe = String::with_capacity(text.len());
    let mut marks = 0;
    for (count, c) in text.chars().enumerate() {
        if count == longest {
            safe.push('…');
            break;
        }
        if is_combining(c) {
            marks += 1;
            if marks <= MOST_MARKS {
                safe.push(c);
            }
            continue;
        }
        marks = 0;
        push_visible(&mut safe, c);
    }
    safe
}

/// JSON, which says of itself what it holds, with the characters that a terminal would obey, hide or reorder written as
/// `\u202e`. They can only stand inside its strings, where that means the same.
#[must_use]
pub fn printable_json(json: &str) -> String {
    let mut safe = String::with_capacity(json.len());
    for c in json.chars() {
        if c == '\x7f' || is_hidden(c) {
            c.encode_utf16(&mut [0; 2]).iter().for_each(|unit| {
                let _ = write!(safe, "\\u{unit:04x}");
            });
        } else {
            safe.push(c);
        }
    }
    safe
}

/// A character as it is, or an escape where a terminal would obey, hide or reorder.
fn push_visible(safe: &mut String, c: char) {
    match c {
        '\t' => safe.push_str("\\t"),
        '\n' => safe.push_str("\\n"),
        '\r' => safe.push_str("\\r"),
        c if c.is_ascii_control() => {
            let _ = write!(safe, "\\x{:02x}", u32::from(c));
        }
        c if is_hidden(c) => {
            let _ = write!(safe, "\\u{{{:x}}}", u32::from(c));
        }
        c => safe.push(c),
    }
}

/// Characters that draw nothing or change how others are drawn.
#[must_use]
pub fn is_hidden(c: char) -> bool {
    matches!(c,
        '\u{80}'..='\u{9f}' // C1 controls
        | '\u{ad}' // soft hyphen
        | '\u{61c}' | '\u{200e}' | '\u{200f}' | '\u{202a}'..='\u{202e}' | '\u{2066}'..='\u{2069}' // direction
        | '\u{200b}'..='\u{200d}' | '\u{2060}'..='\u{2065}' | '\u{206a}'..='\u{206f}' | '\u{feff}' // zero width
        | '\u{180e}' | '\u{115f}' | '\u{1160}' | '\u{3164}' | '\u{ffa0}' // fillers
        | '\u{2028}' | '\u{2029}' // line and paragraph separators
        | '\u{fe00}'..='\u{fe0f}' | '\u{e0100}'..='\u{e01ef}' // variation selectors
        | '\u{fff9}'..='\u{fffb}' | '\u{e0000}'..='\u{e007f}' // annotations and tags
    )
}

/// Marks that are drawn over the character before them.
fn is_combining(c: char) -> bool {
    !c.is_ascii() && !is_hidden(c) && unicode_width::UnicodeWidthChar::width(c) == Some(0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_a_terminal_would_obey_is_shown() {
        assert_eq!(printable("a\x1b[31mred\x07"), "a\\x1b[31mred\\x07");
        assert_eq!(printable("a\tb\r\n\x7f\u{9b}"), "a\\tb\\r\\n\\x7f\\u{9b}");
        assert_eq!(
            printable("x\u{202e}y\u{200b}\u{feff}\u{ad}\u{e0041}"),
            "x\\u{202e}y\\u{200b}\\u{feff}\\u{ad}\\u{e0041}"
        );
        assert_eq!(printable("Höhe °C 高さ"), "Höhe °C 高さ");
    }

    #[test]
    fn at_most_two_marks_stay_on_a_character() {
        assert_eq!(printable("e\u{301}\u{302}\u{303}\u{304}x\u{301}"), "e\u{301}\u{302}x\u{301}");
    }

    #[test]
    fn lines_stay_lines_and_json_stays_json() {
        assert_eq!(printable_lines("a: \x1b[31m\n  note: \u{202e}\r\n"), "a: \\x1b[31m\n  note: \\u{202e}\\r\n");
        let name = "x\x1b[31m\u{202e}\u{9b}\x7f\u{e0041}\"ö";
        let json = serde_json::to_string_pretty(&[name]).unwrap();
        let safe = printable_json(&json);
        assert_eq!(safe, "[\n  \"x\\u001b[31m\\u202e\\u009b\\u007f\\udb40\\udc41\\\"ö\"\n]");
        assert_eq!(serde_json::from_str::<Vec<String>>(&safe).unwrap(), [name]);
    }

    #[test]
    fn length_is_capped() {
        let safe = printable(&"x".repeat(10_000));
        assert_eq!(safe.chars().count(), LONGEST + 1);
        assert!(safe.ends_with('…'));
    }
}
