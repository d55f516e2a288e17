//! Parameters that several methods share, each declared once.

use crate::param::{Kind, Param, Step, Value, always};

/// The multiplier of the scale; sections give it their own default.
pub const K: Param = Param {
    key: "k",
    help: "tolerance in scales: flagged when |y - expected| reaches k * scale",
    unit: "scales",
    kind: Kind::Real { min: 0.5, max: 1000.0, step: Step::Add(0.1) },
    default: Value::Real(3.0),
    paper: None,
    matters: always,
};

/// Where a channel is cut into segments.
pub const MAX_GAP: Param = Param {
    key: "max_gap",
    help: "cut where more than this many samples are lost in a row (off: never cut)",
    unit: "samples",
    kind: Kind::WholeOrOff { min: 0, max: 1_000_000 },
    default: Value::Whole(5),
    paper: None,
    matters: always,
};

/// Lower bound on any scale.
pub const FLOOR: Param = Param {
    key: "floor",
    help: "lower bound on any scale; auto: half the smallest step of the data (quantised records)",
    unit: "channel units",
    kind: Kind::RealOr { words: &["auto"], min: 0.0, max: 1e300 },
    default: Value::Word("auto"),
    paper: None,
    matters: always,
};

/// How the noise scale is found.
pub const SIGMA: Param = Param {
    key: "sigma",
    help: "noise scale: auto or difference (robust; correlated noise hides from it: AR(1) 0.3/0.6/0.9 gives \
           0.77/0.54/0.25 of the deviation), spline (eq. (2) of [000]; outliers inflate it), or a number",
    unit: "channel units",
    kind: Kind::RealOr { words: &["auto", "difference", "spline"], min: f64::MIN_POSITIVE, max: 1e300 },
    default: Value::Word("auto"),
    paper: None,
    matters: always,
};
