//! What stands for a parameter in the settings of its source document.

use super::Value;

/// The value of a parameter in the settings of its source document, where the default is another.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Paper {
    /// The value.
    pub value: Value,
    /// Why the default is another, in one line.
    pub why: &'static str,
    /// False where the document does not give it, and the value is one that leaves its other rules as they are.
    pub printed: bool,
}

impl Paper {
    /// What the document gives: a value, or that it has no such rule.
    #[must_use]
    pub const fn printed(value: Value, why: &'static str) -> Self {
        Self { value, why, printed: true }
    }

    /// What stands for something that the document leaves open.
    #[must_use]
    pub const fn open(value: Value, why: &'static str) -> Self {
        Self { value, why, printed: false }
    }
}
