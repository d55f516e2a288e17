//! Arbitrary text of a file on its way to the screen: nothing in it acts on the terminal, hides or reorders.

use unicode_width::UnicodeWidthChar;
use wildpoint::track::printable;

pub(super) fn body(data: &[u8]) {
    let text = String::from_utf8_lossy(data);
    let safe = printable(&text);
    let mut marks = 0;
    for c in safe.chars() {
        // Cc, and the code points that Unicode lists as bidirectional controls (UAX 9, table of explicit formatting).
        assert!(!c.is_control(), "{c:?}");
        let bidi = matches!(c, '\u{61c}' | '\u{200e}' | '\u{200f}' | '\u{202a}'..='\u{202e}' | '\u{2066}'..='\u{2069}');
        assert!(!bidi, "{c:?}");
        marks = if c.width() == Some(0) { marks + 1 } else { 0 };
        assert!(marks <= 2, "{marks} marks on one character");
    }
    assert!(safe.chars().count() <= 4096 * 10 + 1, "a long text ends");
    if text.chars().all(|c| c.is_ascii_graphic() || c == ' ') && text.len() <= 4096 {
        assert_eq!(safe, text, "what is harmless stays");
    }
    // Whatever the first pass left is what a second one leaves, but for the length.
    if safe.chars().count() <= 4096 {
        assert_eq!(printable(&safe), safe);
    }
}
