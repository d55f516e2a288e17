//! A configuration of arbitrary text: refused in words, or read so that the key map it gives can be written and read
//! back, and the program can still be left.

use std::path::Path;

use wildpoint::tui::action::Action;
use wildpoint::tui::config::{Config, listing};

pub(super) fn body(data: &[u8]) {
    let text = String::from_utf8_lossy(data);
    let path = Path::new("config.toml");
    let config = match Config::of_text(&text, path) {
        Ok(config) => config,
        Err(e) => return assert!(!e.to_string().is_empty()),
    };
    assert!(config.keys.key_of(Action::Quit).is_some(), "no key is left to quit");
    let listed = listing(&config.keys);
    let again = Config::of_text(&listed, path).expect("what is listed is read");
    assert_eq!(listing(&again.keys), listed);
}
