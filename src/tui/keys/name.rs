//! Names of keys: as the table and the configuration write them, and as people read them.

use ratatui::crossterm::event::{KeyCode, KeyEvent, KeyModifiers};

/// The keys with a name, and their key codes; any other is written as its character.
const NAMED: &[(&str, KeyCode)] = &[
    ("space", KeyCode::Char(' ')),
    ("left", KeyCode::Left),
    ("right", KeyCode::Right),
    ("up", KeyCode::Up),
    ("down", KeyCode::Down),
    ("home", KeyCode::Home),
    ("end", KeyCode::End),
    ("pageup", KeyCode::PageUp),
    ("pagedown", KeyCode::PageDown),
    ("enter", KeyCode::Enter),
    ("backspace", KeyCode::Backspace),
    ("delete", KeyCode::Delete),
    ("insert", KeyCode::Insert),
    ("esc", KeyCode::Esc),
    ("tab", KeyCode::Tab),
    ("backtab", KeyCode::BackTab),
];

/// The name of a key as the table writes it; none for one that cannot be bound.
pub(super) fn name_of(key: KeyEvent) -> Option<String> {
    let control = key.modifiers.contains(KeyModifiers::CONTROL);
    let named = NAMED.iter().find(|(_, code)| *code == key.code).map(|(name, _)| *name);
    match (key.code, named) {
        (_, Some(name)) => {
            // Arrows are told from arrows with Shift; other keys do not arrive with it everywhere.
            let shift = key.modifiers.contains(KeyModifiers::SHIFT) && SHIFTED.contains(&name);
            Some(if shift { format!("shift-{name}") } else { name.to_owned() })
        }
        // The character already says whether Shift was down.
        (KeyCode::Char(c), None) if control => Some(format!("ctrl-{}", c.to_ascii_lowercase())),
        (KeyCode::Char(c), None) if key.modifiers.contains(KeyModifiers::ALT) => Some(format!("alt-{c}")),
        (KeyCode::Char(c), None) => Some(c.to_string()),
        (KeyCode::F(n), None) => Some(format!("f{n}")),
        _ => None,
    }
}

/// The keys that can be told apart with and without Shift.
const SHIFTED: [&str; 4] = ["left", "right", "up", "down"];

/// A key, or several with blanks between them, as the table writes them.
///
/// # Errors
/// What is wrong with it, and what would be right.
pub fn parsed(text: &str) -> Result<String, String> {
    let parts: Vec<&str> = text.split_whitespace().collect();
    match parts.as_slice() {
        [] => Err("an empty key; give one, or [] for none".into()),
        [one] => single(one),
        [first, second] if first.chars().count() == 1 => Ok(format!("{} {}", single(first)?, single(second)?)),
        [_, _] => Err(format!("{text:?}: the first of two keys is a single character, as in \"g a\"")),
        _ => Err(format!("{text:?}: two keys in a row at most")),
    }
}

fn single(text: &str) -> Result<String, String> {
    if text.chars().count() == 1 {
        return if text.chars().all(char::is_control) { Err(format!("{text:?}: not a key")) } else { Ok(text.into()) };
    }
    let lower = text.to_lowercase();
    let is_named = |name: &str| NAMED.iter().any(|(n, _)| *n == name);
    let function =
        |name: &str| name.strip_prefix('f').and_then(|n| n.parse().ok()).is_some_and(|n| (1..=12).contains(&n));
    match lower.split_once('-') {
        None if is_named(&lower) || function(&lower) => Ok(lower),
        Some(("shift", "tab")) => Ok("backtab".into()),
        Some(("shift", name)) if SHIFTED.contains(&name) => Ok(lower),
        Some(("ctrl", c)) if c.chars().count() == 1 => with_control(text, c),
        _ => {
            let names: Vec<&str> = NAMED.iter().map(|(n, _)| *n).collect();
            Err(format!(
                "{text:?}: no such key; a key is one character, ctrl-x, shift-left, f1 to f12, or one of {}",
                names.join(", ")
            ))
        }
    }
}

/// Some keys with Ctrl never arrive as such.
fn with_control(text: &str, c: &str) -> Result<String, String> {
    let because = match c {
        "i" => "a terminal sends it as tab",
        "m" => "a terminal sends it as enter",
        "[" => "a terminal sends it as esc",
        "q" => "terminals use it to stop and start the output",
        "a" | "b" => "tmux and screen keep it for themselves",
        _ if c.chars().all(|c| c.is_ascii_lowercase()) => return Ok(format!("ctrl-{c}")),
        _ => "only letters arrive with Ctrl in every terminal",
    };
    Err(format!("{text:?} cannot be bound: {because}"))
}

/// A key as people write it: `Ctrl-S`, `Space`, `←`.
#[must_use]
pub fn shown(key: &str) -> String {
    let one = |k: &str| match k {
        "left" => "←".to_owned(),
        "right" => "→".to_owned(),
        "up" => "↑".to_owned(),
        "down" => "↓".to_owned(),
        "pageup" => "PgUp".to_owned(),
        "pagedown" => "PgDn".to_owned(),
        "backtab" => "Shift-Tab".to_owned(),
        "shift-left" => "Shift-←".to_owned(),
        "shift-right" => "Shift-→".to_owned(),
        "shift-up" => "Shift-↑".to_owned(),
        "shift-down" => "Shift-↓".to_owned(),
        k => match (k.strip_prefix("ctrl-"), NAMED.iter().any(|(name, _)| *name == k)) {
            (Some(c), _) => format!("Ctrl-{}", c.to_uppercase()),
            (None, true) => k[..1].to_uppercase() + &k[1..],
            (None, false) => k.to_owned(),
        },
    };
    key.split(' ').map(one).collect::<Vec<_>>().join("")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn keys_are_read_however_they_are_spelt_and_refused_with_a_reason() {
        for (text, name) in [
            ("Ctrl-S", "ctrl-s"),
            ("shift-tab", "backtab"),
            ("Shift-Left", "shift-left"),
            ("G", "G"),
            ("g  a", "g a"),
            ("-", "-"),
            ("F5", "f5"),
        ] {
            assert_eq!(parsed(text).as_deref(), Ok(name));
        }
        for (text, why) in [
            ("", "an empty key"),
            ("ctrl-i", "as tab"),
            ("ctrl-b", "tmux"),
            ("ctrl-5", "only letters"),
            ("g a b", "two keys"),
            ("esc a", "single character"),
            ("hyper-x", "no such key"),
            ("f13", "no such key"),
            ("shift-enter", "no such key"),
        ] {
            assert!(parsed(text).is_err_and(|e| e.contains(why)), "{text}");
        }
    }

    #[test]
    fn what_arrives_has_the_name_that_is_read() {
        for (name, code) in NAMED {
            assert_eq!(name_of(KeyEvent::new(*code, KeyModifiers::NONE)).as_deref(), Some(*name));
            assert_eq!(parsed(name).as_deref(), Ok(*name));
        }
        let key = |code, modifiers| name_of(KeyEvent::new(code, modifiers));
        assert_eq!(key(KeyCode::Left, KeyModifiers::SHIFT).as_deref(), Some("shift-left"));
        assert_eq!(key(KeyCode::Char('N'), KeyModifiers::SHIFT).as_deref(), Some("N"));
        assert_eq!(key(KeyCode::Char('R'), KeyModifiers::CONTROL).as_deref(), Some("ctrl-r"));
        assert_eq!(key(KeyCode::CapsLock, KeyModifiers::NONE), None);
    }
}
