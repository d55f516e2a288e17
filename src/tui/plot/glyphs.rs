//! The characters of the plots, in three sets.
//!
//! Box drawing, blocks and bullets are two cells wide in terminals set up for East Asian text; braille never is.

use super::flags::FlagState;

/// A set of characters.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Glyphs {
    /// Braille, lines, blocks and bullets.
    Unicode,
    /// Braille and ASCII only: every character is one cell wide in any terminal.
    Braille,
    /// ASCII only, for serial consoles and fonts without braille.
    Ascii,
}

impl Glyphs {
    /// The character for dots of a cell in the bit order of braille. ASCII has two dots, one above the other.
    #[must_use]
    pub fn dots(self, mask: u8) -> char {
        if mask == 0 {
            return ' ';
        }
        match self {
            Self::Unicode | Self::Braille => braille(mask),
            // The two upper rows of dots, and the two lower.
            Self::Ascii => match (mask & 0x1b != 0, mask & 0xe4 != 0) {
                (true, false) => '\'',
                (false, _) => '.',
                (true, true) => ':',
            },
        }
    }

    /// A height from 0 to 1 in one cell.
    #[must_use]
    pub fn level(self, height: f32) -> char {
        let levels: &[char] = match self {
            Self::Unicode => &['▁', '▂', '▃', '▄', '▅', '▆', '▇', '█'],
            Self::Braille => &['⡀', '⠄', '⠂', '⠁'],
            Self::Ascii => &['_', '.', '-', '\''],
        };
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "from 0 to the number of levels")]
        let at = (height.clamp(0.0, 1.0) * levels.len() as f32) as usize;
        levels[at.min(levels.len() - 1)]
    }

    /// The marker of a flag. Each state has its own shape in every set.
    #[must_use]
    pub fn flag(self, state: FlagState) -> char {
        match (state, self) {
            (FlagState::Unreviewed, Self::Unicode) => '●',
            (FlagState::Unreviewed, _) => '*',
            (FlagState::Accepted, _) => 'x',
            (FlagState::Rejected, _) => 'o',
            (FlagState::ByHand, _) => '+',
            (FlagState::Suspect, _) => '~',
        }
    }

    /// The marker of what has just ceased to be a flag.
    #[must_use]
    pub fn gone(self) -> char {
        if self == Self::Unicode { '·' } else { '.' }
    }

    /// The marker of a flag on the cell of the cursor: ASCII letters go to upper case, for terminals that cannot
    /// show reverse.
    #[must_use]
    pub fn flag_at_cursor(self, state: FlagState) -> char {
        match self {
            Self::Ascii => match state {
                FlagState::Unreviewed => '@',
                FlagState::ByHand => '#',
                FlagState::Suspect => 'S',
                FlagState::Accepted | FlagState::Rejected => self.flag(state).to_ascii_uppercase(),
            },
            _ => self.flag(state),
        }
    }

    /// What stands at the edge for values beyond it: above, below, or both (a plot of one row).
    #[must_use]
    pub fn beyond(self, above: bool, below: bool) -> char {
        match (above, below, self) {
            (true, true, Self::Unicode) => '↕',
            (true, true, _) => 'X',
            (true, false, Self::Unicode) => '▲',
            (true, false, _) => '^',
            (false, true, Self::Unicode) => '▼',
            (false, true, _) => 'v',
            (false, false, _) => ' ',
        }
    }

    /// Lost samples, in the picture of step sizes.
    #[must_use]
    pub fn lost(self) -> char {
        if self == Self::Unicode { '◆' } else { '%' }
    }

    /// A vertical line: the axis, the cursor.
    #[must_use]
    pub fn vertical(self) -> char {
        if self == Self::Unicode { '│' } else { '|' }
    }

    /// A vertical line with a tick to the left.
    #[must_use]
    pub fn tick(self) -> char {
        match self {
            Self::Unicode => '┤',
            Self::Braille | Self::Ascii => '+',
        }
    }

    /// The bars around the part of the overview that the trace shows.
    #[must_use]
    pub fn viewport(self) -> char {
        if self == Self::Unicode { '┃' } else { '|' }
    }

    /// A dotted horizontal line: the threshold.
    #[must_use]
    pub fn threshold(self) -> char {
        if self == Self::Unicode { '┄' } else { '-' }
    }

    /// The line of the expected value where dots cannot be told from the curve's.
    #[must_use]
    pub(super) fn layer(self, mask: u8, ascii: char) -> char {
        if self == Self::Ascii && mask != 0 { ascii } else { self.dots(mask) }
    }

    /// The rail's character for a column with `count` flags.
    #[must_use]
    pub fn rail(self, count: u32) -> char {
        if self == Self::Ascii {
            return match count {
                0 => '-',
                1..=9 => char::from_digit(count, 10).unwrap_or('9'),
                _ => '#',
            };
        }
        let level = match count {
            0 => 0,
            1 => 1,
            2..=3 => 2,
            4..=9 => 3,
            10..=31 => 4,
            32..=99 => 5,
            _ => 6,
        };
        let levels = if self == Self::Unicode { &RAIL } else { &RAIL_BRAILLE };
        levels[level]
    }

    /// A bar of `eighths` (0 to 8) of a cell's height.
    #[must_use]
    pub fn bar(self, eighths: u8) -> char {
        let eighths = usize::from(eighths.min(8));
        match self {
            Self::Unicode => BARS[eighths],
            Self::Braille => BARS_BRAILLE[eighths.div_ceil(2)],
            Self::Ascii => [' ', '.', ':'][eighths.div_ceil(4)],
        }
    }
}

const RAIL: [char; 7] = ['─', '▁', '▂', '▃', '▅', '▆', '█'];
const RAIL_BRAILLE: [char; 7] = ['-', '⡀', '⣀', '⣄', '⣤', '⣶', '⣿'];
const BARS: [char; 9] = [' ', '▁', '▂', '▃', '▄', '▅', '▆', '▇', '█'];
const BARS_BRAILLE: [char; 5] = [' ', '⣀', '⣤', '⣶', '⣿'];

fn braille(mask: u8) -> char {
    // The block of 256 braille patterns holds a character for every mask.
    char::from_u32(0x2800 + u32::from(mask)).unwrap_or(' ')
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn states_differ_in_shape_in_every_set_even_under_the_cursor() {
        for glyphs in [Glyphs::Unicode, Glyphs::Braille, Glyphs::Ascii] {
            let mut shapes: Vec<char> = FlagState::ALL.iter().map(|s| glyphs.flag(*s)).collect();
            shapes.sort_unstable();
            shapes.dedup();
            assert_eq!(shapes.len(), 5);
        }
        let mut ascii: Vec<char> =
            FlagState::ALL.iter().flat_map(|s| [Glyphs::Ascii.flag(*s), Glyphs::Ascii.flag_at_cursor(*s)]).collect();
        ascii.sort_unstable();
        ascii.dedup();
        assert_eq!(ascii.len(), 10);
    }

    #[test]
    fn dots_follow_the_braille_standard_and_halve_in_ascii() {
        // ISO 11548: dots 1 2 3 7 down the left, 4 5 6 8 down the right.
        assert_eq!(Glyphs::Unicode.dots(0x01), '⠁');
        assert_eq!(Glyphs::Unicode.dots(0xc0), '⣀');
        assert_eq!((Glyphs::Ascii.dots(0x09), Glyphs::Ascii.dots(0xc4), Glyphs::Ascii.dots(0x41)), ('\'', '.', ':'));
    }

    #[test]
    fn no_flag_is_told_from_some_and_counts_never_look_smaller() {
        for glyphs in [Glyphs::Unicode, Glyphs::Braille, Glyphs::Ascii] {
            assert!((1..5000).all(|count| glyphs.rail(count) != glyphs.rail(0)));
        }
        assert_eq!([1, 3, 9, 31, 99, 100].map(|n| Glyphs::Unicode.rail(n)), ['▁', '▂', '▃', '▅', '▆', '█']);
        assert_eq!([9, 10].map(|n| Glyphs::Ascii.rail(n)), ['9', '#']);
    }
}
