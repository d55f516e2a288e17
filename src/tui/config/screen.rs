//! `[screen]`: everything that is neither a key nor a colour.

use std::ops::RangeInclusive;

use toml::Spanned;
use toml::de::{DeTable, DeValue};

use super::{Fault, entries, unknown, wrong};
use crate::tui::input::ESC_TIMEOUT_MS;
use crate::tui::plot::Glyphs;
use crate::tui::theme::ColorDepth;

/// Frames a second at most, when nobody says otherwise.
const FPS: u32 = 30;

/// How the screen behaves.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Screen {
    /// Which characters; none: what the terminal can.
    pub glyphs: Option<Glyphs>,
    /// How many colours; none: what the terminal says.
    pub color: Option<ColorDepth>,
    /// Whether the mouse is the program's. When it is not, the terminal selects text with it.
    pub mouse: bool,
    /// Whether a decision goes on to the next flag.
    pub auto_advance: bool,
    /// How long after an `Esc` the rest of an escape sequence may come, in milliseconds.
    pub esc_timeout_ms: u64,
    /// Frames a second at most.
    pub fps: u32,
}

impl Default for Screen {
    fn default() -> Self {
        let esc_timeout_ms = ESC_TIMEOUT_MS;
        Self { glyphs: None, color: None, mouse: true, auto_advance: true, esc_timeout_ms, fps: FPS }
    }
}

/// A key of `[screen]`.
#[derive(Debug)]
pub struct Setting {
    /// Its name.
    pub name: &'static str,
    /// Its values.
    pub values: &'static str,
    /// What holds without it.
    pub default: &'static str,
    /// What it is for.
    pub about: &'static str,
}

const fn setting(name: &'static str, values: &'static str, default: &'static str, about: &'static str) -> Setting {
    Setting { name, values, default, about }
}

/// The keys of `[screen]`.
pub static SETTINGS: [Setting; 6] = [
    setting("glyphs", "auto, unicode, braille, ascii", "auto", "the characters of the plots"),
    setting("color", "auto, never, 16, 256, true", "auto", "the number of colours"),
    setting("mouse", "true, false", "true", "whether the program uses the mouse"),
    setting("auto_advance", "true, false", "true", "whether a decision goes to the next flag"),
    setting(
        "esc_timeout_ms",
        "1 to 2000",
        "30",
        "wait after Esc for the rest of a key; raise it for a slow connection",
    ),
    setting("fps", "1 to 120", "30", "frames a second at most; lower it for a slow connection"),
];

const GLYPHS: [(&str, Option<Glyphs>); 4] = [
    ("auto", None),
    ("unicode", Some(Glyphs::Unicode)),
    ("braille", Some(Glyphs::Braille)),
    ("ascii", Some(Glyphs::Ascii)),
];

const COLORS: [(&str, Option<ColorDepth>); 5] = [
    ("auto", None),
    ("never", Some(ColorDepth::Never)),
    ("16", Some(ColorDepth::Ansi16)),
    ("256", Some(ColorDepth::Indexed256)),
    ("true", Some(ColorDepth::True)),
];

pub(super) fn read(table: &DeTable<'_>, faults: &mut Vec<Fault>) -> Screen {
    let mut screen = Screen::default();
    for (name, value, span) in entries(table) {
        match name {
            "glyphs" => screen.glyphs = word(name, "glyph set", value, &GLYPHS, faults).flatten(),
            "color" => screen.color = word(name, "number of colours", value, &COLORS, faults).flatten(),
            "mouse" => screen.mouse = switch(name, value, faults).unwrap_or(screen.mouse),
            "auto_advance" => screen.auto_advance = switch(name, value, faults).unwrap_or(screen.auto_advance),
            "esc_timeout_ms" => {
                screen.esc_timeout_ms = number(name, value, 1..=2000, faults).unwrap_or(screen.esc_timeout_ms);
            }
            "fps" => {
                let fps = number(name, value, 1..=120, faults).and_then(|n| u32::try_from(n).ok());
                screen.fps = fps.unwrap_or(screen.fps);
            }
            _ => faults.push(unknown(&span, name, "setting of the screen", &SETTINGS.each_ref().map(|s| s.name))),
        }
    }
    screen
}

fn word<T: Copy>(
    name: &str,
    kind: &str,
    value: &Spanned<DeValue<'_>>,
    words: &[(&str, T)],
    faults: &mut Vec<Fault>,
) -> Option<T> {
    let names: Vec<&str> = words.iter().map(|(w, _)| *w).collect();
    // 256 without quotes means the same.
    let text = match value.get_ref() {
        DeValue::String(text) => text.to_string(),
        DeValue::Integer(number) => number.to_string(),
        _ => {
            faults.push(wrong(value, name, &names.join(", ")));
            return None;
        }
    };
    let found = words.iter().find(|(w, _)| *w == text).map(|(_, meaning)| *meaning);
    if found.is_none() {
        faults.push(unknown(&value.span(), &text, kind, &names));
    }
    found
}

fn switch(name: &str, value: &Spanned<DeValue<'_>>, faults: &mut Vec<Fault>) -> Option<bool> {
    let found = value.get_ref().as_bool();
    if found.is_none() {
        faults.push(wrong(value, name, "true or false"));
    }
    found
}

fn number(
    name: &str,
    value: &Spanned<DeValue<'_>>,
    range: RangeInclusive<u64>,
    faults: &mut Vec<Fault>,
) -> Option<u64> {
    let wanted = format!("a whole number from {} to {}", range.start(), range.end());
    let DeValue::Integer(number) = value.get_ref() else {
        faults.push(wrong(value, name, &wanted));
        return None;
    };
    let text = number.to_string();
    let found = text.parse().ok().filter(|n| range.contains(n));
    if found.is_none() {
        faults.push(Fault::new(
            &value.span(),
            format!("{name} = {text}: out of range"),
            format!("{name} takes {wanted}"),
        ));
    }
    found
}

#[cfg(test)]
mod tests {
    use std::path::Path;

    use super::*;
    use crate::tui::config::Config;

    #[test]
    fn every_setting_is_read() {
        let text = "[screen]\nglyphs = \"ascii\"\ncolor = 256\nmouse = false\nauto_advance = false\nesc_timeout_ms = 80\nfps = 10\n";
        assert!(SETTINGS.iter().all(|setting| text.contains(setting.name)));
        let read = Config::of_text(text, Path::new("config.toml")).unwrap().screen;
        let wanted = Screen {
            glyphs: Some(Glyphs::Ascii),
            color: Some(ColorDepth::Indexed256),
            mouse: false,
            auto_advance: false,
            esc_timeout_ms: 80,
            fps: 10,
        };
        assert_eq!(read, wanted);
    }

    #[test]
    fn the_defaults_that_are_told_are_those_that_hold() {
        let told = |name: &str| SETTINGS.iter().find(|s| s.name == name).unwrap().default;
        let Screen { mouse, auto_advance, esc_timeout_ms, fps, .. } = Screen::default();
        assert_eq!(
            [told("mouse"), told("auto_advance")],
            [mouse, auto_advance].map(|b| if b { "true" } else { "false" })
        );
        assert_eq!((told("esc_timeout_ms"), told("fps")), (&*esc_timeout_ms.to_string(), &*fps.to_string()));
    }
}
