//! What a study found, in words.

use super::{Advice, Curve, Measured, OF_ALL, Unsuitable};
use crate::calibration::amount;

impl Measured {
    /// How small a wild point it finds, for a channel in `unit` (may be empty): "finds 95 % of single points from 42 ft,
    /// of runs of 5 from 60 ft".
    #[must_use]
    pub fn detectability(&self, unit: &str) -> String {
        let sized: Vec<&Curve> = self.kinds.iter().filter(|curve| curve.kind.has_sizes()).collect();
        let found =
            sized.iter().filter_map(|c| Some(format!("{} from {}", c.kind.plural(), amount(c.smallest?, unit))));
        let found: Vec<String> = found.collect();
        let missed: Vec<&str> = sized.iter().filter(|c| c.smallest.is_none()).map(|c| c.kind.plural()).collect();
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

    /// What it flags on the record as it is: "flags 3 samples, 1 of them alone among the methods".
    #[must_use]
    pub fn flags(&self) -> String {
        let samples = |n: usize| if n == 1 { "1 sample".to_owned() } else { format!("{n} samples") };
        match (self.untouched.flagged, self.untouched.alone) {
            (0, _) => "flags nothing on the record as it is".to_owned(),
            (n, 0) => format!("flags {} on the record as it is", samples(n)),
            (n, alone) => format!("flags {} on the record as it is, {alone} of which most methods do not", samples(n)),
        }
    }
}

impl Advice {
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
