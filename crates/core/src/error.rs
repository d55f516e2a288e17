//! What can go wrong without any file. Every variant says what went wrong and the way out.

use crate::memory::{Full, words};

/// What every fallible function of this crate returns.
pub type Result<T> = std::result::Result<T, Error>;

/// What helps where memory is short.
pub const MORE: &str = "allow more with --memory, or give it less to do: fewer columns (--channel), a part of the file";

/// Everything that can go wrong, worded for the person who gave the value.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum Error {
    /// A method, parameter, name or value does not fit.
    #[error("{what}\n  {help}")]
    Usage {
        /// What does not fit.
        what: String,
        /// What would fit.
        help: String,
    },
    /// Something takes more memory than the program may use.
    #[error("{subject}: this needs more than the {} of memory that the program may use\n  {MORE}", words(full.limit))]
    Memory {
        /// What is to be done.
        subject: String,
        /// The limit.
        full: Full,
    },
    /// The work was stopped through its [`Stop`](crate::stop::Stop).
    #[error("the work was stopped before it ended\n  run it again")]
    Stopped,
}

impl Error {
    /// An [`Error::Usage`].
    pub fn usage(what: impl Into<String>, help: impl Into<String>) -> Self {
        Self::Usage { what: what.into(), help: help.into() }
    }
}

/// `did you mean`: the candidate closest to `name`, when one is close enough to be a slip of the finger.
#[must_use]
pub fn nearest<'a>(name: &str, candidates: impl IntoIterator<Item = &'a str>) -> Option<&'a str> {
    let limit = 1 + name.chars().count() / 3;
    candidates
        .into_iter()
        .map(|c| (edit_distance(name, c), c))
        .filter(|(d, _)| *d <= limit)
        .min_by_key(|(d, _)| *d)
        .map(|(_, c)| c)
}

/// The way out for a name that is none of `names`: the nearest of them, then `kind` and all of them.
#[must_use]
pub fn one_of(kind: &str, name: &str, names: &[&str]) -> String {
    let hint = nearest(name, names.iter().copied()).map_or(String::new(), |near| format!("did you mean {near}? "));
    format!("{hint}{kind}: {}", names.join(", "))
}

fn edit_distance(a: &str, b: &str) -> usize {
    let b: Vec<char> = b.chars().collect();
    let mut row: Vec<usize> = (0..=b.len()).collect();
    for (i, ca) in a.chars().enumerate() {
        let mut diagonal = row[0];
        row[0] = i + 1;
        for (j, cb) in b.iter().enumerate() {
            let cost = diagonal + usize::from(ca != *cb);
            diagonal = row[j + 1];
            row[j + 1] = cost.min(row[j] + 1).min(diagonal + 1);
        }
    }
    row[b.len()]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn nearest_finds_a_slip_and_refuses_a_stranger() {
        assert_eq!(nearest("hample", ["hampel", "two-sided"]), Some("hampel"));
        assert_eq!(nearest("zzz", ["hampel", "two-sided"]), None);
        assert_eq!(one_of("channels", "atl_m", &["alt_m", "vx"]), "did you mean alt_m? channels: alt_m, vx");
        assert_eq!(one_of("channels", "zzzzz", &["alt_m", "vx"]), "channels: alt_m, vx");
    }
}
