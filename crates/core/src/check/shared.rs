//! Parameters that several checks share, each declared once.

use crate::param::{Kind, Param, Value, always};

/// The key of the limit beyond which a sample is suspect.
pub(super) const SUSPECT: &str = "suspect";

/// The key of the limit beyond which a sample fails.
pub(super) const FAIL: &str = "fail";

/// A limit that can be off.
pub(super) const fn limit(key: &'static str, help: &'static str, unit: &'static str, min: f64) -> Param {
    Param {
        key,
        help,
        unit,
        kind: Kind::RealOr { words: &["off"], min, max: 1e300 },
        default: Value::Word("off"),
        paper: None,
        matters: always,
    }
}

/// The longest stretch that can be an island.
pub(super) const LONGEST: Param = Param {
    key: "longest",
    help: "a longer stretch that cannot be reached from the one before is a real change, and its first sample suspect",
    unit: "samples",
    kind: Kind::Whole { min: 1, max: 1_000_000, step: 1 },
    default: Value::Whole(25),
    paper: None,
    matters: always,
};
