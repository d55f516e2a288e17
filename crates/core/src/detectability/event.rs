//! Wild points that are put into a record: which kinds, of which sizes, and how one is made.

use std::ops::Range;

/// Sizes of wild points in limits of the noise ([`Calibration::limits`](crate::calibration::Calibration::limits)): five
/// to a decade.
pub const SIZES: [f64; 11] = [1.0, 1.6, 2.5, 4.0, 6.3, 10.0, 16.0, 25.0, 40.0, 63.0, 100.0];

/// The level of a run varies by at most this share of it.
const UNEVEN: f64 = 0.1;

/// A kind of wild point.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, serde::Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Kind {
    /// One sample.
    Single,
    /// Two neighbours with about the same error.
    RunOf2,
    /// Five.
    RunOf5,
    /// Ten.
    RunOf10,
    /// All samples of a held value, by the same error: in records that hold values.
    Held,
    /// One to five samples at the fill value: in records that have such.
    Dropout,
}

impl Kind {
    /// The kinds that every record can have.
    pub const COMMON: [Self; 4] = [Self::Single, Self::RunOf2, Self::RunOf5, Self::RunOf10];

    /// Every kind.
    pub const ALL: [Self; 6] = [Self::Single, Self::RunOf2, Self::RunOf5, Self::RunOf10, Self::Held, Self::Dropout];

    /// The key of session files.
    #[must_use]
    pub fn key(self) -> &'static str {
        match self {
            Self::RunOf2 => "run-of-2",
            Self::RunOf5 => "run-of-5",
            Self::RunOf10 => "run-of-10",
            other => other.word(),
        }
    }

    /// How it is called in a table.
    #[must_use]
    pub fn word(self) -> &'static str {
        match self {
            Self::Single => "single",
            Self::RunOf2 => "run of 2",
            Self::RunOf5 => "run of 5",
            Self::RunOf10 => "run of 10",
            Self::Held => "held",
            Self::Dropout => "dropout",
        }
    }

    /// How it is called where there is little room: at most seven characters.
    #[must_use]
    pub fn short(self) -> &'static str {
        match self {
            Self::RunOf2 => "run 2",
            Self::RunOf5 => "run 5",
            Self::RunOf10 => "run 10",
            other => other.word(),
        }
    }

    /// How several are called in a sentence.
    #[must_use]
    pub fn plural(self) -> &'static str {
        match self {
            Self::Single => "single points",
            Self::RunOf2 => "runs of 2",
            Self::RunOf5 => "runs of 5",
            Self::RunOf10 => "runs of 10",
            Self::Held => "held values",
            Self::Dropout => "dropouts",
        }
    }

    /// How many samples one has; of a held value and a dropout at least.
    #[must_use]
    pub fn length(self) -> usize {
        match self {
            Self::Single | Self::Held | Self::Dropout => 1,
            Self::RunOf2 => 2,
            Self::RunOf5 => 5,
            Self::RunOf10 => 10,
        }
    }

    /// True where events of several sizes are made; a dropout has the size of its value.
    #[must_use]
    pub fn has_sizes(self) -> bool {
        self != Self::Dropout
    }
}

/// What is to be put in somewhere.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Wanted {
    pub(super) kind: Kind,
    /// Index in [`SIZES`]; 0 for kinds without sizes.
    pub(super) size: usize,
}

/// What was put in.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Event {
    pub(super) kind: Kind,
    /// Index in [`SIZES`]; 0 for kinds without sizes.
    pub(super) size: usize,
    /// Positions of its samples.
    pub(super) range: Range<usize>,
}

/// Everything that can be put in: each kind in each of its sizes.
pub(super) fn everything(kinds: &[Kind]) -> Vec<Wanted> {
    let of_kind = |&kind: &Kind| {
        let sizes = if kind.has_sizes() { 0..SIZES.len() } else { 0..1 };
        sizes.map(move |size| Wanted { kind, size })
    };
    kinds.iter().flat_map(of_kind).collect()
}

/// The error of one sample of a run: `level`, made uneven by `chance` in [0, 1), and on the grid of a record that has
/// steps of `resolution`.
pub(super) fn error(level: f64, chance: f64, resolution: f64) -> f64 {
    let error = level * (1.0 + UNEVEN * chance);
    if resolution > 0.0 { (error / resolution).round() * resolution } else { error }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_kind_comes_in_all_its_sizes() {
        let all = everything(&[Kind::Single, Kind::Dropout, Kind::RunOf5]);
        assert_eq!(all.len(), 2 * SIZES.len() + 1);
        assert_eq!(all[SIZES.len()], Wanted { kind: Kind::Dropout, size: 0 });
    }

    #[test]
    fn every_kind_has_a_key_of_its_own() {
        let keys = Kind::ALL.map(Kind::key);
        assert_eq!(keys, ["single", "run-of-2", "run-of-5", "run-of-10", "held", "dropout"]);
    }

    #[test]
    fn an_error_stays_on_the_grid_of_the_record() {
        assert_eq!(error(70.0, 0.0, 25.0), 75.0);
        assert_eq!(error(-70.0, 0.5, 0.0), -73.5);
    }
}
