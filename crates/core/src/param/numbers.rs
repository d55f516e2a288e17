//! A short list of numbers as the value of a parameter.

use std::fmt;

/// A few finite numbers in the order in which they were given.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Numbers {
    /// The numbers; 0 beyond the length.
    values: [f64; Numbers::MOST],
    len: usize,
}

impl Numbers {
    /// How many there can be.
    pub const MOST: usize = 8;

    /// No number.
    pub const NONE: Self = Self { values: [0.0; Self::MOST], len: 0 };

    /// These numbers; none when they are too many or one of them is not finite.
    #[must_use]
    pub fn of(numbers: &[f64]) -> Option<Self> {
        if numbers.len() > Self::MOST || numbers.iter().any(|x| !x.is_finite()) {
            return None;
        }
        let mut values = [0.0; Self::MOST];
        values[..numbers.len()].copy_from_slice(numbers);
        Some(Self { values, len: numbers.len() })
    }

    /// Reads numbers with commas or blanks between them.
    #[must_use]
    pub fn parse(text: &str) -> Option<Self> {
        let words = text.split([',', ' ']).map(str::trim).filter(|word| !word.is_empty());
        let numbers: Vec<f64> = words.map(|word| word.parse().ok()).collect::<Option<_>>()?;
        Self::of(&numbers)
    }

    /// The numbers.
    #[must_use]
    pub fn as_slice(&self) -> &[f64] {
        &self.values[..self.len]
    }
}

impl serde::Serialize for Numbers {
    fn serialize<S: serde::Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_seq(self.as_slice())
    }
}

impl fmt::Display for Numbers {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (i, x) in self.as_slice().iter().enumerate() {
            write!(f, "{}{x:?}", if i == 0 { "" } else { "," })?;
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_list_reads_back_what_it_prints() {
        let list = Numbers::parse("-9999, 1e20,99.99").unwrap();
        assert_eq!(list.as_slice(), [-9999.0, 1e20, 99.99]);
        assert_eq!(Numbers::parse(&list.to_string()), Some(list));
        assert_eq!(Numbers::parse(""), Some(Numbers::NONE));
        assert!(Numbers::parse("1,x").is_none() && Numbers::parse("inf").is_none());
        assert!(Numbers::of(&[1.0; Numbers::MOST + 1]).is_none());
    }
}
