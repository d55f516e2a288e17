//! Arbitrary keys, as a slow or hostile line delivers them: every key means one thing or nothing, none is invented,
//! and an `Esc` that waits is always let go.

use ratatui::crossterm::event::{KeyCode, KeyEvent, KeyModifiers};
use wildpoint::tui::action::Panel;
use wildpoint::tui::input::Normaliser;
use wildpoint::tui::keys::{Keys, Meaning};

use super::bytes::Bytes;

pub(super) fn body(data: &[u8]) {
    let mut bytes = Bytes(data);
    let panel = Panel::ALL[bytes.below(Panel::ALL.len())];
    let keys = Keys::default();
    let mut normaliser = Normaliser::default();
    let mut prefix = None;
    let (mut fed, mut given) = (0, 0);
    while !bytes.is_empty() {
        let meant = match bytes.byte() {
            0 => normaliser.flush().into_iter().collect(),
            shape => {
                fed += 1;
                normaliser.feed(key(shape, &mut bytes))
            }
        };
        for key in meant {
            given += 1;
            prefix = match keys.meaning(key, prefix, panel) {
                Meaning::Prefix(c) => {
                    assert!(prefix.is_none(), "a prefix of a prefix");
                    Some(c)
                }
                Meaning::Action(_) | Meaning::Nothing => None,
            };
        }
    }
    given += usize::from(normaliser.flush().is_some());
    assert!(!normaliser.waits() && normaliser.flush().is_none(), "an Esc is let go once");
    // An Alt-letter is an Esc and a letter.
    assert!(given <= 2 * fed, "{given} keys out of {fed}");
}

fn key(shape: u8, bytes: &mut Bytes<'_>) -> KeyEvent {
    const CODES: [KeyCode; 20] = [
        KeyCode::Esc,
        KeyCode::Enter,
        KeyCode::Backspace,
        KeyCode::Left,
        KeyCode::Right,
        KeyCode::Up,
        KeyCode::Down,
        KeyCode::Home,
        KeyCode::End,
        KeyCode::PageUp,
        KeyCode::PageDown,
        KeyCode::Tab,
        KeyCode::BackTab,
        KeyCode::Delete,
        KeyCode::Insert,
        KeyCode::F(5),
        KeyCode::Null,
        KeyCode::CapsLock,
        KeyCode::Menu,
        KeyCode::KeypadBegin,
    ];
    let modifiers = |bits: u8| KeyModifiers::from_bits_truncate(bits);
    match shape {
        1..=40 => KeyEvent::new(CODES[usize::from(shape) % CODES.len()], KeyModifiers::NONE),
        41..=80 => KeyEvent::new(CODES[usize::from(shape) % CODES.len()], modifiers(bytes.byte())),
        81..=100 => {
            let c = char::from_u32(bytes.word() as u32 % 0x11_0000).unwrap_or('\u{fffd}');
            KeyEvent::new(KeyCode::Char(c), modifiers(bytes.byte()))
        }
        101..=180 => KeyEvent::new(KeyCode::Char(char::from(bytes.byte())), KeyModifiers::NONE),
        _ => KeyEvent::new(KeyCode::Char(char::from(b"[O;~0159ABCDHFZ"[usize::from(shape) % 15])), KeyModifiers::NONE),
    }
}
