//! What was measured of a channel with wild points of known size, as the session and the report carry it.

use super::Setup;
use super::detectability::{Advice, Detected, Kind, Measured};

/// What was measured of a channel before its session was saved. It changes no result, and no replay measures it again.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Measurement {
    /// The methods side by side, and which of them is recommended.
    pub advice: Option<Box<Comparison>>,
    /// What the settings of the plan find.
    pub detectability: Option<Box<Detectability>>,
}

/// The methods side by side on a record.
#[derive(Debug, Clone, PartialEq)]
pub struct Comparison {
    /// Seed of the random numbers.
    pub seed: u64,
    /// Samples of the record.
    pub samples: usize,
    /// Samples on which the methods were tried.
    pub tried: usize,
    /// The kinds of wild points that were put in.
    pub kinds: Vec<Kind>,
    /// A row for each method.
    pub rows: Vec<Row>,
    /// Id of the method that is recommended; none where none is.
    pub recommended: Option<String>,
    /// Why: a line for the recommended method, and one for the runner-up.
    pub reasons: Vec<String>,
}

/// What is known of a method.
#[derive(Debug, Clone, PartialEq)]
pub struct Row {
    /// Its id.
    pub method: String,
    /// What it finds, kind by kind, of the kinds of the comparison.
    pub found: Vec<Detected>,
    /// The share of all that it finds, from 0 to 1.
    pub recall: f64,
    /// Outliers on the record as it is.
    pub flagged: usize,
    /// Those that neither half of the methods nor the calibration supports.
    pub alone: usize,
    /// Root mean square of its repairs minus the values before, in channel units; none where it repaired nothing.
    pub repair_error: Option<f64>,
}

/// How small a wild point is found with the settings of a plan.
#[derive(Debug, Clone)]
pub struct Detectability {
    /// What it was measured with: it holds for no other detection.
    pub setup: Setup,
    /// Seed of the random numbers.
    pub seed: u64,
    /// What is found, kind by kind.
    pub found: Vec<Detected>,
}

impl PartialEq for Detectability {
    fn eq(&self, other: &Self) -> bool {
        self.setup.same_detection(&other.setup) && self.seed == other.seed && self.found == other.found
    }
}

impl Measurement {
    /// True when nothing was measured.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.advice.is_none() && self.detectability.is_none()
    }

    /// What a finished comparison of methods on a channel in `unit` says: the comparison, and what the settings of
    /// `setup` find where they are among those compared.
    #[must_use]
    pub fn of(advice: &Advice, seed: u64, unit: &str, setup: &Setup) -> Self {
        let own = advice.methods.iter().find(|m| m.setup.same_detection(setup));
        Self {
            advice: Some(Box::new(Comparison::of(advice, seed, unit))),
            detectability: own.map(|own| Box::new(Detectability::of(own, seed))),
        }
    }

    /// What settings find, where it was measured with the detection of `setup`.
    #[must_use]
    pub fn detectability_of(&self, setup: &Setup) -> Option<&Detectability> {
        self.detectability.as_deref().filter(|found| found.setup.same_detection(setup))
    }
}

impl Comparison {
    /// What a comparison of methods on a channel in `unit` says.
    #[must_use]
    pub fn of(advice: &Advice, seed: u64, unit: &str) -> Self {
        Self {
            seed,
            samples: advice.samples,
            tried: advice.tried,
            kinds: advice.methods.first().map_or_else(Vec::new, |m| m.kinds.iter().map(|c| c.kind).collect()),
            rows: advice.methods.iter().map(Row::of).collect(),
            recommended: advice.best().map(|best| best.setup.method.about().id.to_owned()),
            reasons: advice.reasons(unit),
        }
    }

    /// How it was measured, in words.
    #[must_use]
    pub fn how(&self) -> String {
        let of = if self.tried < self.samples {
            format!(" in pieces of the record's {}", self.samples)
        } else {
            String::new()
        };
        format!("measured with wild points put into copies of {} samples{of} (seed {})", self.tried, self.seed)
    }
}

impl Row {
    fn of(measured: &Measured) -> Self {
        Self {
            method: measured.setup.method.about().id.to_owned(),
            found: measured.detected(),
            recall: measured.recall,
            flagged: measured.untouched.flagged,
            alone: measured.untouched.alone,
            repair_error: measured.repair_error,
        }
    }
}

impl Detectability {
    /// What was measured of a setup.
    #[must_use]
    pub fn of(measured: &Measured, seed: u64) -> Self {
        Self { setup: measured.setup.clone(), seed, found: measured.detected() }
    }

    /// In words, for a channel in `unit`.
    #[must_use]
    pub fn in_words(&self, unit: &str) -> String {
        Detected::in_words(&self.found, unit)
    }
}
