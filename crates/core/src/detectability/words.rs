//! What a study found, in words.

use super::{Advice, Curve, Kind, Measured, OF_ALL, OfKind, Unsuitable};
use crate::calibration::amount;

/// What a setting finds of wild points of one kind.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Detected {
    /// The kind.
    pub kind: Kind,
    /// The size from which on [`OF_ALL`] are found, in channel units; none where the largest are not, and for a kind
    /// without sizes.
    pub smallest: Option<f64>,
    /// Share found, the mean over all sizes; none before any was put in.
    pub recall: Option<f64>,
}

impl Detected {
    /// In a cell of a table: the size, or the share of a kind without sizes; `-` where there is none.
    #[must_use]
    pub fn cell(&self) -> String {
        let text = if self.kind.has_sizes() {
            self.smallest.map(two_digits)
        } else {
            self.recall.map(|recall| format!("{:.0} %", 100.0 * recall))
        };
        text.unwrap_or_else(|| "-".to_owned())
    }

    /// From which sizes on wild points are found, for a channel in `unit` (may be empty): "finds 95 % of single points
    /// from 42 ft, of runs of 5 from 60 ft".
    #[must_use]
    pub fn in_words(all: &[Self], unit: &str) -> String {
        let sized: Vec<&Self> = all.iter().filter(|found| found.kind.has_sizes()).collect();
        let found =
            sized.iter().filter_map(|f| Some(format!("{} from {}", f.kind.plural(), amount(f.smallest?, unit))));
        let found: Vec<String> = found.collect();
        let missed: Vec<&str> = sized.iter().filter(|f| f.smallest.is_none()).map(|f| f.kind.plural()).collect();
        let mut words = match found.is_empty() {
            true => String::new(),
            false => format!("finds {:.0} % of {}", 100.0 * OF_ALL, found.join(", of ")),
        };
        if !missed.is_empty() {
            let link = if words.is_empty() { "" } else { "; " };
            words += &format!("{link}does not find {:.0} % of {} of any size", 100.0 * OF_ALL, missed.join(" or "));
        }
        words
    }
}

impl From<&Curve> for Detected {
    fn from(curve: &Curve) -> Self {
        Self { kind: curve.kind, smallest: curve.smallest, recall: curve.recall }
    }
}

/// A number with two digits, as tables show sizes.
#[must_use]
pub fn two_digits(value: f64) -> String {
    let rounded: f64 = format!("{value:.1e}").parse().unwrap_or(value);
    rounded.to_string()
}

impl Measured {
    /// What it finds, kind by kind.
    #[must_use]
    pub fn detected(&self) -> Vec<Detected> {
        self.kinds.iter().map(Detected::from).collect()
    }

    /// [`Detected::in_words`] of what it finds.
    #[must_use]
    pub fn detectability(&self, unit: &str) -> String {
        Detected::in_words(&self.detected(), unit)
    }

    /// What it flags on the record as it is, and what it leaves open: "flags 3 samples on the record as it is, 1 of which
    /// most methods do not, and leaves 12 suspect".
    #[must_use]
    pub fn flags(&self) -> String {
        let samples = |n: usize| if n == 1 { "1 sample".to_owned() } else { format!("{n} samples") };
        let flagged = match (self.untouched.flagged, self.untouched.alone) {
            (0, _) => "flags nothing on the record as it is".to_owned(),
            (n, 0) => format!("flags {} on the record as it is", samples(n)),
            (n, alone) => format!("flags {} on the record as it is, {alone} of which most methods do not", samples(n)),
        };
        match self.untouched.suspects {
            0 => flagged,
            n => format!("{flagged}, and leaves {n} suspect"),
        }
    }
}

impl Advice {
    /// How much each kind weighs in the share that is found, and how many of it the record itself shows: "single 83 % (20),
    /// run 2 17 % (3)". Empty where the record cannot be asked.
    #[must_use]
    pub fn weights_in_words(&self) -> String {
        let of = |of: &OfKind| format!("{} {:.0} % ({})", of.kind.short(), 100.0 * of.weight, of.own);
        self.weights.iter().map(of).collect::<Vec<_>>().join(", ")
    }

    /// The reasons in two lines: what is recommended, and what comes next; or why nothing is.
    #[must_use]
    pub fn reasons(&self, unit: &str) -> Vec<String> {
        if let Some(why) = self.unsuitable {
            return vec![format!("no method is recommended: {why}")];
        }
        let line = |what: &str, index: Option<usize>| {
            let measured = self.methods.get(index?)?;
            let id = measured.setup.method.about().id;
            Some(format!("{what}: {id}; {}; {}", measured.detectability(unit), measured.flags()))
        };
        [line("recommended", self.recommended), line("runner-up", self.runner_up)].into_iter().flatten().collect()
    }
}

impl Unsuitable {
    /// What helps.
    #[must_use]
    pub fn way_out(self) -> &'static str {
        match self {
            Self::TooShort { .. } => "choose a method by hand: `wildpoint methods`",
            Self::TooContaminated { .. } | Self::TooIrregular { .. } => {
                "compare the methods by hand: `wildpoint compare`"
            }
        }
    }
}
