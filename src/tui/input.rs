//! Keys as they were meant: on a slow line an arrow key can arrive as `Esc`, `[`, `C`, which must not act as three
//! keys. After an `Esc`, what follows at once is put together again.

use ratatui::crossterm::event::{KeyCode, KeyEvent, KeyModifiers};

/// How long after an `Esc` the rest of a sequence may come, in milliseconds.
pub const ESC_TIMEOUT_MS: u64 = 30;

/// No sequence is as long as this: a report of the mouse has three numbers of at most five digits.
const LONGEST: usize = 21;

/// Puts torn sequences together.
#[derive(Debug, Default)]
pub struct Normaliser {
    /// What came since the `Esc` (without it), while a sequence may still go on.
    pending: Option<String>,
}

impl Normaliser {
    /// True while an `Esc` waits for what may follow; [`Normaliser::flush`] ends the wait.
    #[must_use]
    pub fn waits(&self) -> bool {
        self.pending.is_some()
    }

    /// Takes a key in; gives the keys that were meant.
    pub fn feed(&mut self, key: KeyEvent) -> Vec<KeyEvent> {
        if let Some(letter) = after_esc(key) {
            let mut keys = self.feed(escape());
            keys.extend(self.feed(letter));
            return keys;
        }
        let Some(mut tail) = self.pending.take() else {
            if key.code == KeyCode::Esc && key.modifiers.is_empty() {
                self.pending = Some(String::new());
                return Vec::new();
            }
            return vec![key];
        };
        let KeyCode::Char(c) = key.code else {
            // Not the rest of a sequence: the Esc was one, unless it was followed by a tail that is dropped.
            let mut keys = if tail.is_empty() { vec![escape()] } else { Vec::new() };
            keys.extend(self.feed(key));
            return keys;
        };
        if tail.is_empty() && c != '[' && c != 'O' {
            return vec![escape(), key];
        }
        tail.push(c);
        // `[<` begins a report of the mouse, which ends in `M` or `m`: half of one is dropped, no key of it is typed.
        let report = tail.len() == 2 && c == '<';
        let goes_on = tail.len() == 1 || (tail.starts_with('[') && (c.is_ascii_digit() || c == ';' || report));
        if goes_on && tail.len() < LONGEST {
            self.pending = Some(tail);
            return Vec::new();
        }
        meant(&tail).into_iter().collect()
    }

    /// Nothing followed in time: an `Esc` alone was an `Esc`, half a sequence is dropped.
    pub fn flush(&mut self) -> Option<KeyEvent> {
        self.pending.take().filter(String::is_empty).map(|_| escape())
    }
}

/// The letter of an Alt-letter: no key here has Alt, but an `Esc` and a letter that arrive in one read look like one.
fn after_esc(key: KeyEvent) -> Option<KeyEvent> {
    let alone = !key.modifiers.contains(KeyModifiers::CONTROL);
    let alt = matches!(key.code, KeyCode::Char(_)) && key.modifiers.contains(KeyModifiers::ALT) && alone;
    alt.then(|| KeyEvent { modifiers: key.modifiers - KeyModifiers::ALT, ..key })
}

fn escape() -> KeyEvent {
    KeyEvent::new(KeyCode::Esc, KeyModifiers::NONE)
}

/// The key of a sequence; none for one that means nothing here.
fn meant(tail: &str) -> Option<KeyEvent> {
    let last = tail.chars().last()?;
    let parameters = &tail[1..tail.len() - last.len_utf8()];
    let (number, modifier) = parameters.split_once(';').unwrap_or((parameters, "1"));
    let code = match (last, number) {
        ('A', _) => KeyCode::Up,
        ('B', _) => KeyCode::Down,
        ('C', _) => KeyCode::Right,
        ('D', _) => KeyCode::Left,
        ('H', _) | ('~', "1" | "7") => KeyCode::Home,
        ('F', _) | ('~', "4" | "8") => KeyCode::End,
        ('Z', _) => KeyCode::BackTab,
        ('~', "3") => KeyCode::Delete,
        ('~', "5") => KeyCode::PageUp,
        ('~', "6") => KeyCode::PageDown,
        _ => return None,
    };
    let bits = modifier.parse::<u8>().unwrap_or(1).saturating_sub(1);
    let mut modifiers = KeyModifiers::NONE;
    for (bit, m) in [(1, KeyModifiers::SHIFT), (2, KeyModifiers::ALT), (4, KeyModifiers::CONTROL)] {
        if bits & bit != 0 {
            modifiers |= m;
        }
    }
    Some(KeyEvent::new(code, modifiers))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn typed(text: &str) -> Vec<KeyCode> {
        let mut normaliser = Normaliser::default();
        let key = |c: char| match c {
            '\x1b' => escape(),
            c => KeyEvent::new(KeyCode::Char(c), KeyModifiers::NONE),
        };
        let mut keys: Vec<KeyEvent> = text.chars().flat_map(|c| normaliser.feed(key(c))).collect();
        keys.extend(normaliser.flush());
        keys.into_iter().map(|k| k.code).collect()
    }

    #[test]
    fn torn_sequences_are_one_key_wherever_they_were_torn() {
        for (tail, code) in [
            ("[A", KeyCode::Up),
            ("[D", KeyCode::Left),
            ("OC", KeyCode::Right),
            ("[5~", KeyCode::PageUp),
            ("[1;2C", KeyCode::Right),
            ("[Z", KeyCode::BackTab),
        ] {
            assert_eq!(typed(&format!("\x1b{tail}n")), [code, KeyCode::Char('n')], "{tail}");
        }
    }

    #[test]
    fn a_lone_esc_is_an_esc_and_unknown_tails_are_dropped() {
        assert_eq!(typed("\x1b"), [KeyCode::Esc]);
        assert_eq!(typed("\x1bq"), [KeyCode::Esc, KeyCode::Char('q')]);
        assert_eq!(typed("\x1b\x1b[B"), [KeyCode::Esc, KeyCode::Down]);
        assert_eq!(typed("\x1b[99~x"), [KeyCode::Char('x')]);
        assert_eq!(typed("\x1b[1;"), []);
        // A report of the mouse that was torn presses no key: not 0, M or m.
        assert_eq!(typed("\x1b[<0;120;40Mx"), [KeyCode::Char('x')]);
        assert_eq!(typed("\x1b[<65;7;3m"), []);
    }

    #[test]
    fn an_alt_letter_is_an_esc_and_the_letter() {
        let alt = |c, more| KeyEvent::new(KeyCode::Char(c), KeyModifiers::ALT | more);
        let plain = |c, modifiers| KeyEvent::new(KeyCode::Char(c), modifiers);
        let (none, shift) = (KeyModifiers::NONE, KeyModifiers::SHIFT);
        let mut normaliser = Normaliser::default();
        assert_eq!(normaliser.feed(alt('q', none)), [escape(), plain('q', none)]);
        assert_eq!(normaliser.feed(alt('N', shift)), [escape(), plain('N', shift)]);
        // After an Esc that still waited there are two of them.
        assert_eq!(normaliser.feed(escape()), []);
        assert_eq!(normaliser.feed(alt('q', none)), [escape(), escape(), plain('q', none)]);
        // The start of a sequence stays one, wherever it was torn.
        assert_eq!(normaliser.feed(alt('[', none)), []);
        assert_eq!(normaliser.feed(plain('B', none)), [KeyEvent::new(KeyCode::Down, none)]);
        let control = KeyEvent::new(KeyCode::Char('x'), KeyModifiers::ALT | KeyModifiers::CONTROL);
        assert_eq!(normaliser.feed(control), [control]);
    }

    #[test]
    fn the_modifier_of_a_torn_sequence_counts() {
        let shift = meant("[1;2D").map(|k| k.modifiers);
        assert_eq!(shift, Some(KeyModifiers::SHIFT));
    }
}
