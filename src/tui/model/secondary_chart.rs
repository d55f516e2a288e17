//! The picture below the trace, and the channel beside it.

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
    /// How many methods flag each sample.
    Consensus,
    /// Which share of wild points of known size is found.
    Detectability,
}

/// Which channel is shown beside the one on the screen, where there is room for two.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Second {
    /// The next one.
    #[default]
    Next,
    /// That of this plan.
    Plan(usize),
    /// None.
    Off,
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
    /// Those that follow each other; the others are asked for by keys of their own.
    pub const ALL: [Self; 3] = [Self::Residual, Self::Histogram, Self::Steps];

    /// Its name on the screen.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Residual => "residual",
            Self::Histogram => "histogram",
            Self::Steps => "time steps",
            Self::Consensus => "all methods",
            Self::Detectability => "detectability",
        }
    }

    /// The one after it.
    #[must_use]
    pub fn next(self) -> Self {
        let at = Self::ALL.iter().position(|kind| *kind == self);
        Self::ALL[at.map_or(0, |at| (at + 1) % Self::ALL.len())]
    }
}
