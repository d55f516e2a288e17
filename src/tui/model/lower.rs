//! The picture below the trace.

/// Which picture lies below the trace.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum LowerKind {
    /// The residual along the record.
    #[default]
    Residual,
    /// How often which residual occurs.
    Histogram,
    /// The steps of time from sample to sample.
    Steps,
}

/// The picture below the trace, and its scales.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Lower {
    /// Which.
    pub kind: LowerKind,
    /// True when the residual goes with its logarithm.
    pub log_residual: bool,
    /// True when the counts of the histogram go with their logarithm.
    pub log_counts: bool,
}

impl Default for Lower {
    fn default() -> Self {
        // A few wild points beside a million of good samples would not be seen on a linear scale of counts.
        Self { kind: LowerKind::default(), log_residual: false, log_counts: true }
    }
}

impl LowerKind {
    /// All of them, in the order in which they are shown.
    pub const ALL: [Self; 3] = [Self::Residual, Self::Histogram, Self::Steps];

    /// Its name on the screen.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Residual => "residual",
            Self::Histogram => "histogram",
            Self::Steps => "steps of time",
        }
    }

    /// The one after it.
    #[must_use]
    pub fn next(self) -> Self {
        let at = Self::ALL.iter().position(|kind| *kind == self).unwrap_or(0);
        Self::ALL[(at + 1) % Self::ALL.len()]
    }
}
