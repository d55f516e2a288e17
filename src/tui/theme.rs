//! Named styles of everything on the screen.
//!
//! The hues are those of Okabe and Ito, which people with any kind of colour vision tell apart. Text keeps the
//! terminal's own foreground and background. The screen is quiet: what matters is bright, the rest is dim. No class
//! is told by colour alone: the plots give each flag state a glyph of its own, and the colourless theme has only
//! attributes.

use ratatui::style::{Color, Modifier, Style};

use super::plot::FlagState;

mod paint;

pub use paint::{Base, Paints, ROLES, Role};

/// How many colours the terminal shows.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ColorDepth {
    /// None: attributes only.
    Never,
    /// The sixteen named colours, whose hues belong to the terminal.
    Ansi16,
    /// The indexed palette of 256 colours.
    Indexed256,
    /// 24 bits.
    True,
}

/// The style of each role. A style that only sets a background is meant to be patched over another.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Theme {
    /// Plain text.
    pub text: Style,
    /// Text and lines that step back: axes, rules, help.
    pub dim: Style,
    /// The title line and the names of panels.
    pub title: Style,
    /// The name of the panel that has the keyboard, and the value under change.
    pub focus: Style,
    /// Names of keys in the footer and in help.
    pub key: Style,
    /// The curve of the kept raw samples.
    pub raw: Style,
    /// The expected value.
    pub expected: Style,
    /// The edges of the expected band.
    pub band: Style,
    /// Repaired values.
    pub repaired: Style,
    /// The filtered track.
    pub filtered: Style,
    /// An undecided flag.
    pub flag_unreviewed: Style,
    /// A flag accepted as an outlier.
    pub flag_accepted: Style,
    /// A flag overruled: the sample is good.
    pub flag_rejected: Style,
    /// A sample flagged by the analyst.
    pub flag_by_hand: Style,
    /// A suspect sample, which is not an outlier.
    pub flag_suspect: Style,
    /// Patched over the cell under the cursor.
    pub cursor: Style,
    /// The line of the cursor where nothing else is drawn.
    pub cursor_line: Style,
    /// Patched over selected cells.
    pub selection: Style,
    /// Patched over columns in which the record has lost samples.
    pub gap: Style,
    /// The line at which a method flags.
    pub threshold: Style,
    /// Residuals beyond the threshold.
    pub over: Style,
    /// The part of the overview that the trace shows.
    pub viewport: Style,
    /// Something went well.
    pub ok: Style,
    /// Something deserves a look.
    pub warning: Style,
    /// Something failed.
    pub error: Style,
}

/// A hue in the three colour depths.
#[derive(Clone, Copy)]
struct Hue {
    rgb: (u8, u8, u8),
    index: u8,
    named: Color,
}

const fn hue(rgb: (u8, u8, u8), index: u8, named: Color) -> Hue {
    Hue { rgb, index, named }
}

const VERMILLION: Hue = hue((213, 94, 0), 166, Color::LightRed);
const BLUISH_GREEN: Hue = hue((0, 158, 115), 36, Color::Green);
const REDDISH_PURPLE: Hue = hue((204, 121, 167), 175, Color::LightMagenta);
const ORANGE: Hue = hue((230, 159, 0), 178, Color::Yellow);
const YELLOW: Hue = hue((240, 228, 66), 227, Color::LightYellow);
const SKY_BLUE: Hue = hue((86, 180, 233), 74, Color::LightCyan);
const BLUE: Hue = hue((0, 114, 178), 25, Color::Blue);

/// The hues that differ between a dark and a light background.
struct Ground {
    dim: Hue,
    band: Hue,
    expected: Hue,
    repaired: Hue,
    accent: Hue,
    selection: Hue,
    gap: Option<Hue>,
}

const DARK: Ground = Ground {
    dim: hue((138, 138, 138), 245, Color::DarkGray),
    band: hue((98, 98, 98), 241, Color::DarkGray),
    expected: YELLOW,
    repaired: SKY_BLUE,
    accent: SKY_BLUE,
    selection: hue((68, 68, 68), 238, Color::Blue),
    gap: Some(hue((48, 48, 48), 236, Color::Black)),
};

const LIGHT: Ground = Ground {
    dim: hue((118, 118, 118), 243, Color::DarkGray),
    band: hue((158, 158, 158), 247, Color::DarkGray),
    expected: hue((150, 110, 0), 94, Color::Yellow),
    repaired: BLUE,
    accent: BLUE,
    selection: hue((208, 208, 208), 252, Color::Gray),
    gap: Some(hue((228, 228, 228), 254, Color::White)),
};

impl Theme {
    /// The theme for a terminal of `depth` colours, with a light or a dark background.
    #[must_use]
    pub fn choose(depth: ColorDepth, light: bool) -> Self {
        match depth {
            ColorDepth::Never => Self::mono(),
            _ => Self::colored(depth, if light { &LIGHT } else { &DARK }),
        }
    }

    /// Attributes only, for terminals and people without colours.
    #[must_use]
    pub fn mono() -> Self {
        let plain = Style::new();
        let bold = plain.add_modifier(Modifier::BOLD);
        let dim = plain.add_modifier(Modifier::DIM);
        Self {
            text: plain,
            dim,
            title: bold,
            focus: bold.add_modifier(Modifier::REVERSED),
            key: bold,
            raw: plain,
            expected: dim,
            band: dim,
            repaired: plain.add_modifier(Modifier::ITALIC),
            filtered: dim.add_modifier(Modifier::ITALIC),
            flag_unreviewed: bold,
            flag_accepted: bold.add_modifier(Modifier::ITALIC),
            flag_rejected: dim.add_modifier(Modifier::ITALIC),
            flag_by_hand: bold.add_modifier(Modifier::UNDERLINED),
            flag_suspect: dim.add_modifier(Modifier::BOLD),
            cursor: plain.add_modifier(Modifier::REVERSED),
            cursor_line: dim,
            selection: plain.add_modifier(Modifier::UNDERLINED),
            gap: plain,
            threshold: dim,
            over: bold,
            viewport: bold,
            ok: plain,
            warning: bold,
            error: bold.add_modifier(Modifier::REVERSED),
        }
    }

    fn colored(depth: ColorDepth, ground: &Ground) -> Self {
        let fg = |hue: Hue| Style::new().fg(color(depth, hue));
        let bg = |hue: Hue| Style::new().bg(color(depth, hue));
        let bold = |style: Style| style.add_modifier(Modifier::BOLD);
        Self {
            text: Style::new(),
            dim: fg(ground.dim),
            title: bold(Style::new()),
            focus: bold(fg(ground.accent)),
            key: bold(Style::new()),
            raw: Style::new(),
            expected: fg(ground.expected),
            band: fg(ground.band),
            repaired: fg(ground.repaired),
            filtered: fg(BLUISH_GREEN),
            flag_unreviewed: bold(fg(VERMILLION)),
            flag_accepted: fg(BLUISH_GREEN),
            flag_rejected: fg(ground.dim),
            flag_by_hand: bold(fg(REDDISH_PURPLE)),
            flag_suspect: fg(ORANGE),
            cursor: Style::new().add_modifier(Modifier::REVERSED),
            cursor_line: fg(ground.dim),
            selection: bg(ground.selection),
            gap: ground.gap.map_or(Style::new(), bg),
            threshold: fg(ground.dim),
            over: bold(fg(VERMILLION)),
            viewport: bold(fg(ground.accent)),
            ok: fg(BLUISH_GREEN),
            warning: fg(ORANGE),
            error: bold(fg(VERMILLION)),
        }
    }

    /// The style of a flag of this state.
    #[must_use]
    pub fn flag(&self, state: FlagState) -> Style {
        match state {
            FlagState::Unreviewed => self.flag_unreviewed,
            FlagState::Accepted => self.flag_accepted,
            FlagState::Rejected => self.flag_rejected,
            FlagState::ByHand => self.flag_by_hand,
            FlagState::Suspect => self.flag_suspect,
        }
    }
}

fn color(depth: ColorDepth, hue: Hue) -> Color {
    match depth {
        ColorDepth::Never => Color::Reset,
        ColorDepth::Ansi16 => hue.named,
        ColorDepth::Indexed256 => Color::Indexed(hue.index),
        ColorDepth::True => Color::Rgb(hue.rgb.0, hue.rgb.1, hue.rgb.2),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const DEPTHS: [ColorDepth; 4] = [ColorDepth::Never, ColorDepth::Ansi16, ColorDepth::Indexed256, ColorDepth::True];

    fn all_differ(styles: &[Style]) -> bool {
        styles.iter().enumerate().all(|(i, a)| styles[i + 1..].iter().all(|b| a != b))
    }

    #[test]
    fn states_and_tones_differ_in_every_depth_and_by_attributes_where_there_are_no_colours() {
        for depth in DEPTHS {
            for light in [false, true] {
                let theme = Theme::choose(depth, light);
                assert!(all_differ(&FlagState::ALL.map(|state| theme.flag(state))), "{depth:?}");
                assert!(all_differ(&[theme.ok, theme.warning, theme.error]), "{depth:?}");
                assert!(all_differ(&[theme.text, theme.dim, theme.focus]), "{depth:?}");
                let cursor = theme.cursor.add_modifier;
                assert!(cursor.contains(Modifier::REVERSED), "the cursor is told without a colour");
            }
        }
        let mono = format!("{:?}", Theme::mono());
        assert!(!mono.contains(".fg(") && !mono.contains(".bg("), "{mono}");
    }
}
