//! Colours that the user chooses, laid over a theme, on terminals with fewer colours too.

use ratatui::style::{Color, Style};

use super::{ColorDepth, Theme};

/// What a theme starts from.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Base {
    /// For a dark background.
    Dark,
    /// For a light background.
    Light,
    /// Without colours.
    Mono,
}

impl Base {
    /// All of them.
    pub const ALL: [Self; 3] = [Self::Dark, Self::Light, Self::Mono];

    /// Its word in the configuration.
    #[must_use]
    pub fn word(self) -> &'static str {
        match self {
            Self::Dark => "dark",
            Self::Light => "light",
            Self::Mono => "mono",
        }
    }
}

/// A role of the theme that the configuration can paint.
pub struct Role {
    /// Its name in the configuration.
    pub name: &'static str,
    /// What it paints.
    pub about: &'static str,
    of: fn(&mut Theme) -> &mut Style,
    /// True where the colour is that of the background.
    ground: bool,
}

/// Every role of the theme.
pub static ROLES: &[Role] = &[
    fore("text", "plain text", |t| &mut t.text),
    fore("dim", "axes, rules, help", |t| &mut t.dim),
    fore("title", "the title line and the names of panels", |t| &mut t.title),
    fore("focus", "the panel with the keyboard, and the active value", |t| &mut t.focus),
    fore("key", "names of keys in the last line and in help", |t| &mut t.key),
    fore("raw", "the curve of the kept samples", |t| &mut t.raw),
    fore("expected", "the expected value", |t| &mut t.expected),
    fore("band", "the edges of the tolerance band", |t| &mut t.band),
    fore("repaired", "repaired values", |t| &mut t.repaired),
    fore("filtered", "the filtered track", |t| &mut t.filtered),
    fore("flag_unreviewed", "a flag without a decision", |t| &mut t.flag_unreviewed),
    fore("flag_accepted", "an accepted flag", |t| &mut t.flag_accepted),
    fore("flag_rejected", "a rejected flag", |t| &mut t.flag_rejected),
    fore("flag_by_hand", "a sample flagged by the analyst", |t| &mut t.flag_by_hand),
    fore("flag_suspect", "a suspect", |t| &mut t.flag_suspect),
    fore("cursor", "the cell under the cursor", |t| &mut t.cursor),
    fore("cursor_line", "the line of the cursor", |t| &mut t.cursor_line),
    Role { name: "selection", about: "selected cells (background)", of: |t| &mut t.selection, ground: true },
    Role { name: "gap", about: "columns with lost samples (background)", of: |t| &mut t.gap, ground: true },
    fore("threshold", "the threshold", |t| &mut t.threshold),
    fore("over", "residuals beyond the threshold", |t| &mut t.over),
    fore("viewport", "the part of the overview that the trace shows", |t| &mut t.viewport),
    fore("ok", "messages: done", |t| &mut t.ok),
    fore("warning", "messages: caution", |t| &mut t.warning),
    fore("error", "messages: error", |t| &mut t.error),
];

const fn fore(name: &'static str, about: &'static str, of: fn(&mut Theme) -> &mut Style) -> Role {
    Role { name, about, of, ground: false }
}

/// What the user wants of the theme.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Paints {
    /// What it starts from; none: what the command line says.
    pub base: Option<Base>,
    /// Colours by the name of their role.
    pub roles: Vec<(&'static str, Color)>,
}

impl Paints {
    /// The theme for a terminal of `depth` colours; `light` is what the command line says of the background. Without
    /// colours, attributes are left.
    #[must_use]
    pub fn theme(&self, depth: ColorDepth, light: bool) -> Theme {
        if depth == ColorDepth::Never {
            return Theme::mono();
        }
        let mut theme = match self.base {
            _ if light => Theme::choose(depth, true),
            Some(Base::Mono) => Theme::mono(),
            Some(base) => Theme::choose(depth, base == Base::Light),
            None => Theme::choose(depth, false),
        };
        for (name, color) in &self.roles {
            if let Some(role) = ROLES.iter().find(|role| role.name == *name) {
                let style = (role.of)(&mut theme);
                let color = within(*color, depth);
                *style = if role.ground { style.bg(color) } else { style.fg(color) };
            }
        }
        theme
    }
}

/// The named colours in the usual values of terminals, by index.
const NAMED: [(Color, [u8; 3]); 16] = [
    (Color::Black, [0, 0, 0]),
    (Color::Red, [205, 0, 0]),
    (Color::Green, [0, 205, 0]),
    (Color::Yellow, [205, 205, 0]),
    (Color::Blue, [0, 0, 238]),
    (Color::Magenta, [205, 0, 205]),
    (Color::Cyan, [0, 205, 205]),
    (Color::Gray, [229, 229, 229]),
    (Color::DarkGray, [127, 127, 127]),
    (Color::LightRed, [255, 0, 0]),
    (Color::LightGreen, [0, 255, 0]),
    (Color::LightYellow, [255, 255, 0]),
    (Color::LightBlue, [92, 92, 255]),
    (Color::LightMagenta, [255, 0, 255]),
    (Color::LightCyan, [0, 255, 255]),
    (Color::White, [255, 255, 255]),
];

/// The levels of the cube of 216 colours that starts at index 16; 24 greys follow it.
const LEVELS: [u8; 6] = [0, 95, 135, 175, 215, 255];

/// The red, green and blue of an index of the palette of 256.
fn rgb_of(index: u8) -> [u8; 3] {
    match index {
        0..=15 => NAMED[usize::from(index)].1,
        16..=231 => {
            let at = usize::from(index) - 16;
            [LEVELS[at / 36], LEVELS[at / 6 % 6], LEVELS[at % 6]]
        }
        _ => [8 + 10 * (index - 232); 3],
    }
}

fn distance(a: [u8; 3], b: [u8; 3]) -> u32 {
    a.into_iter().zip(b).map(|(x, y)| u32::from(x.abs_diff(y)).pow(2)).sum()
}

/// The colour as a terminal of `depth` colours can show it.
fn within(color: Color, depth: ColorDepth) -> Color {
    match (depth, color) {
        (ColorDepth::Never, _) => Color::Reset,
        (ColorDepth::Indexed256, Color::Rgb(r, g, b)) => {
            // The first sixteen belong to the terminal: their values are not known.
            let nearest = (16..=255).min_by_key(|i| distance(rgb_of(*i), [r, g, b])).unwrap_or(15);
            Color::Indexed(nearest)
        }
        (ColorDepth::Ansi16, Color::Indexed(i)) if i < 16 => NAMED[usize::from(i)].0,
        (ColorDepth::Ansi16, Color::Indexed(i)) => named(rgb_of(i)),
        (ColorDepth::Ansi16, Color::Rgb(r, g, b)) => named([r, g, b]),
        (_, other) => other,
    }
}

fn named(rgb: [u8; 3]) -> Color {
    NAMED.iter().min_by_key(|(_, value)| distance(*value, rgb)).map_or(Color::Reset, |(color, _)| *color)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_style_of_the_theme_has_a_role_of_its_name() {
        // Painted one after the other, each changes the field of its name and no other.
        let fields = |theme: &Theme| -> Vec<(String, String)> {
            let text = format!("{theme:?}");
            let body = text.trim_start_matches("Theme { ").trim_end_matches(" }");
            let parts = body.split(", ").filter_map(|part| part.split_once(": Style"));
            parts.map(|(name, style)| (name.to_owned(), style.to_owned())).collect()
        };
        let plain = fields(&Theme::mono());
        let names: Vec<&str> = plain.iter().map(|(name, _)| name.as_str()).collect();
        assert_eq!(names, ROLES.iter().map(|role| role.name).collect::<Vec<_>>());
        for role in ROLES {
            let mut theme = Theme::mono();
            *(role.of)(&mut theme) = Style::new().fg(Color::Rgb(1, 2, 3));
            let changed = fields(&theme).into_iter().zip(&plain).filter(|(a, b)| a != *b).map(|(a, _)| a.0);
            assert_eq!(changed.collect::<Vec<_>>(), [role.name]);
        }
    }

    #[test]
    fn colours_are_those_the_terminal_can_show() {
        let paints = Paints { base: None, roles: vec![("raw", Color::Rgb(255, 0, 0)), ("gap", Color::Indexed(21))] };
        let raw = |depth| paints.theme(depth, false).raw.fg;
        assert_eq!(raw(ColorDepth::True), Some(Color::Rgb(255, 0, 0)));
        // Index 196 is (5, 0, 0) of the cube.
        assert_eq!(raw(ColorDepth::Indexed256), Some(Color::Indexed(196)));
        assert_eq!(raw(ColorDepth::Ansi16), Some(Color::LightRed));
        assert_eq!(paints.theme(ColorDepth::Never, false), Theme::mono());
        assert_eq!(paints.theme(ColorDepth::Ansi16, false).gap.bg, Some(Color::Blue));
    }

    #[test]
    fn the_base_is_the_configuration_s_unless_the_command_line_says_light() {
        let base = |base| Paints { base: Some(base), roles: Vec::new() };
        let depth = ColorDepth::Indexed256;
        assert_eq!(base(Base::Light).theme(depth, false), Theme::choose(depth, true));
        assert_eq!(base(Base::Dark).theme(depth, true), Theme::choose(depth, true));
        assert_eq!(base(Base::Mono).theme(depth, false), Theme::mono());
    }
}
