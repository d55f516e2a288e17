//! What can be said of a sample, and how deviations are compared with limits.

pub use crate::math::tie::TIE;

/// What is said of one sample.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Verdict {
    /// The target can have produced it.
    Normal,
    /// The target cannot have produced it.
    Outlier,
    /// Only one direction objects: perhaps a real change of the trajectory.
    Suspect,
    /// Too few neighbours to judge.
    Unchecked,
    /// No value, or no time.
    Missing,
}

impl serde::Serialize for Verdict {
    fn serialize<S: serde::Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.serialize_str(self.word())
    }
}

impl Verdict {
    /// All of them.
    pub const ALL: [Self; 5] = [Self::Normal, Self::Outlier, Self::Suspect, Self::Unchecked, Self::Missing];

    /// What is said of the value `y` where `expected` was to be measured, within `tolerance`: unchecked where nothing
    /// was expected, or within no bounds.
    #[must_use]
    #[inline]
    pub fn of_deviation(y: f64, expected: f64, tolerance: f64) -> Self {
        if expected.is_nan() || !tolerance.is_finite() {
            Self::Unchecked
        } else if reaches((y - expected).abs(), tolerance) {
            Self::Outlier
        } else {
            Self::Normal
        }
    }

    /// Its word in files and on the screen.
    #[must_use]
    pub fn word(self) -> &'static str {
        match self {
            Self::Normal => "normal",
            Self::Outlier => "outlier",
            Self::Suspect => "suspect",
            Self::Unchecked => "unchecked",
            Self::Missing => "missing",
        }
    }
}

/// What one direction of a two-directional test says of a sample.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Direction {
    /// The extrapolation agrees.
    Normal,
    /// It does not.
    Abnormal,
    /// There was no extrapolation.
    Unjudged,
}

impl Direction {
    /// Its word in files and on the screen.
    #[must_use]
    pub fn word(self) -> &'static str {
        match self {
            Self::Normal => "normal",
            Self::Abnormal => "abnormal",
            Self::Unjudged => "unjudged",
        }
    }
}

/// Which way a test runs through the record.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Way {
    /// With time.
    Forward,
    /// Against time.
    Backward,
}

/// A model that was lost and started again: a change of the trajectory, or a patch longer than `max_run`.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Restart {
    /// Position of the first sample of the run at which the model was lost.
    pub at: usize,
    /// The direction it ran in.
    pub way: Way,
}

/// True when `deviation` reaches `limit`: a tie reaches. Never for a limit that is zero, negative or not finite.
#[must_use]
#[inline]
pub fn reaches(deviation: f64, limit: f64) -> bool {
    limit > 0.0 && limit.is_finite() && deviation >= limit * (1.0 - TIE)
}

/// True when `deviation` exceeds `limit`: a tie does not exceed.
#[must_use]
#[inline]
pub fn exceeds(deviation: f64, limit: f64) -> bool {
    deviation > limit * (1.0 + TIE)
}
