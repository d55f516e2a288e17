//! Some of a few words as the value of a parameter.

use std::fmt;

/// Some words of a list of at most 64, in the order of the list; never none.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Words {
    list: &'static [&'static str],
    /// A bit for each word that is taken, the lowest for the first.
    taken: u64,
}

/// Stands for all words of a list.
const ALL: &str = "all";

impl Words {
    /// All words of `list`.
    #[must_use]
    pub const fn all(list: &'static [&'static str]) -> Self {
        let taken = if list.len() < 64 { (1 << list.len()) - 1 } else { u64::MAX };
        Self { list, taken }
    }

    /// These words of `list`; none where one of them is not in it, and where there is none.
    #[must_use]
    pub fn of<'a>(list: &'static [&'static str], words: impl IntoIterator<Item = &'a str>) -> Option<Self> {
        let bit = |word: &str| list.iter().position(|w| *w == word).filter(|at| *at < 64).map(|at| 1 << at);
        let taken = words.into_iter().try_fold(0, |taken, word| Some(taken | bit(word)?))?;
        (taken != 0).then_some(Self { list, taken })
    }

    /// Reads words of `list` with commas or blanks between them, or `all`.
    #[must_use]
    pub fn parse(list: &'static [&'static str], text: &str) -> Option<Self> {
        let words = || text.split([',', ' ']).map(str::trim).filter(|word| !word.is_empty());
        if words().eq([ALL]) { Some(Self::all(list)) } else { Self::of(list, words()) }
    }

    /// The words.
    pub fn iter(&self) -> impl Iterator<Item = &'static str> + '_ {
        self.list.iter().enumerate().filter(|(at, _)| self.taken >> at & 1 == 1).map(|(_, word)| *word)
    }

    /// True where they are words of `list`.
    #[must_use]
    pub fn are_of(&self, list: &'static [&'static str]) -> bool {
        self.list == list
    }
}

impl serde::Serialize for Words {
    fn serialize<S: serde::Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_seq(self.iter())
    }
}

impl fmt::Display for Words {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if *self == Self::all(self.list) {
            return f.write_str(ALL);
        }
        for (i, word) in self.iter().enumerate() {
            write!(f, "{}{word}", if i == 0 { "" } else { "," })?;
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const LIST: &[&str] = &["a", "b", "c"];

    #[test]
    fn words_read_back_what_they_print() {
        for text in ["all", "a", "a,c"] {
            assert_eq!(Words::parse(LIST, text).unwrap().to_string(), text);
        }
        assert_eq!(Words::parse(LIST, "c, a").unwrap().to_string(), "a,c", "in the order of the list");
        assert_eq!(Words::parse(LIST, "a b c"), Some(Words::all(LIST)));
        for wrong in ["", "d", "a,d", "all,a"] {
            assert_eq!(Words::parse(LIST, wrong), None, "{wrong}");
        }
    }
}
