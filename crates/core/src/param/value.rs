//! The value of one parameter.

use std::fmt;

use super::{Numbers, Words, duration};

/// The value of one parameter. Prints in the form that `--set` and the session file read back.
#[derive(Debug, Clone, Copy, PartialEq, serde::Serialize)]
#[serde(untagged)]
pub enum Value {
    /// A whole number.
    Whole(i64),
    /// A finite number.
    Real(f64),
    /// One of the words of the parameter.
    Word(&'static str),
    /// Yes or no.
    Switch(bool),
    /// A few numbers.
    Numbers(Numbers),
    /// Some of the words of the parameter.
    Words(Words),
    /// A length of time in seconds, for a parameter that counts samples.
    #[serde(serialize_with = "duration_text")]
    Duration(f64),
}

#[expect(clippy::trivially_copy_pass_by_ref, reason = "serde hands over a reference")]
fn duration_text<S: serde::Serializer>(seconds: &f64, serializer: S) -> Result<S::Ok, S::Error> {
    serializer.serialize_str(&duration::text(*seconds))
}

/// The value of a parameter that is either a word or a number.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Choice {
    /// One of the words.
    Word(&'static str),
    /// The number.
    Number(f64),
}

impl fmt::Display for Value {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Whole(n) => write!(f, "{n}"),
            // `{:?}` is the shortest text that reads back as the same double, always with a point or an exponent.
            Self::Real(x) => write!(f, "{x:?}"),
            Self::Word(w) => f.write_str(w),
            Self::Switch(b) => write!(f, "{b}"),
            Self::Numbers(list) => write!(f, "{list}"),
            Self::Words(words) => write!(f, "{words}"),
            Self::Duration(seconds) => f.write_str(&duration::text(*seconds)),
        }
    }
}
