//! What a user can tell the loader, as words: the command line, session files and the loader's dialog speak the same.

use super::calendar::{DAY, SECOND};
use super::{Delimiter, Encoding};

/// A value that users name by a word.
pub trait Worded: Copy + PartialEq + Send + Sync + 'static {
    /// Every value that can be told, with its word.
    const WORDS: &'static [(&'static str, Self)];

    /// The value of a word.
    #[must_use]
    fn of_word(word: &str) -> Option<Self> {
        Self::WORDS.iter().find(|(w, _)| *w == word).map(|(_, value)| *value)
    }

    /// The word; none for a value that is only recognised.
    #[must_use]
    fn word(self) -> Option<&'static str> {
        Self::WORDS.iter().find(|(_, value)| *value == self).map(|(word, _)| *word)
    }

    /// The words, with commas between them.
    #[must_use]
    fn words() -> String {
        Self::WORDS.iter().map(|(word, _)| *word).collect::<Vec<_>>().join(", ")
    }
}

impl Worded for Delimiter {
    const WORDS: &'static [(&'static str, Self)] = &[
        ("comma", Self::Byte(b',')),
        ("semicolon", Self::Byte(b';')),
        ("tab", Self::Byte(b'\t')),
        ("pipe", Self::Byte(b'|')),
        ("blanks", Self::Blanks),
    ];
}

/// UTF-16 is told by its byte order mark alone.
impl Worded for Encoding {
    const WORDS: &'static [(&'static str, Self)] = &[("utf-8", Self::Utf8 { bom: false }), ("latin-1", Self::Latin1)];
}

/// The unit of times that are numbers.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct TimeUnit {
    /// One unit, ns.
    pub(crate) ns: i64,
}

impl TimeUnit {
    /// Its name in full, in the plural.
    #[must_use]
    pub fn name(self) -> String {
        match self.word() {
            Some("ns") => "nanoseconds".into(),
            Some("us") => "microseconds".into(),
            Some("ms") => "milliseconds".into(),
            Some("s") => "seconds".into(),
            Some("min") => "minutes".into(),
            Some("h") => "hours".into(),
            Some("d") => "days".into(),
            _ => format!("units of {} ns", self.ns),
        }
    }
}

impl Worded for TimeUnit {
    const WORDS: &'static [(&'static str, Self)] = &[
        ("ns", Self { ns: 1 }),
        ("us", Self { ns: 1_000 }),
        ("ms", Self { ns: 1_000_000 }),
        ("s", Self { ns: SECOND }),
        ("min", Self { ns: 60 * SECOND }),
        ("h", Self { ns: 3_600 * SECOND }),
        ("d", Self { ns: DAY }),
    ];
}

#[cfg(test)]
mod tests {
    use super::super::names;
    use super::*;

    fn both_ways<T: Worded + std::fmt::Debug>() {
        for (word, value) in T::WORDS {
            assert_eq!((T::of_word(word), value.word()), (Some(*value), Some(*word)));
        }
        assert_eq!(T::of_word("no such word"), None);
    }

    #[test]
    fn words_and_values_are_one_to_one() {
        both_ways::<Delimiter>();
        both_ways::<Encoding>();
        both_ways::<TimeUnit>();
        assert_eq!(Encoding::Utf16 { big_endian: true }.word(), None);
    }

    #[test]
    fn a_unit_that_is_told_is_that_of_a_column_with_its_name() {
        for (word, unit) in TimeUnit::WORDS {
            assert_eq!(names::time_unit_ns(word), Some(unit.ns), "{word}");
            assert!(!unit.name().starts_with("units"), "{word} has a name in full");
        }
    }
}
