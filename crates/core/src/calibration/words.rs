//! What a calibration found, in words.

use super::{Calibration, quantile};

/// Below this share a repeated value is chance.
const HELD: f64 = 0.01;

/// Noise differs along a record when its limits reach this many times their median …
const ROUGH: f64 = 2.0;
/// … in the roughest part of this size.
const ROUGHEST: f64 = 0.05;

impl Calibration {
    /// What was found, a clause each, for a channel in `unit` (may be empty): "steps of 25 ft", "54 % repeat the value
    /// before", "errors up to 62 ft are this record's own noise".
    #[must_use]
    pub fn words(&self, unit: &str) -> Vec<String> {
        let mut clauses = Vec::new();
        if self.resolution > 0.0 {
            clauses.push(format!("steps of {}", amount(self.resolution, unit)));
        }
        if self.held >= HELD {
            clauses.push(format!("{:.0} % repeat the value before", 100.0 * self.held));
        }
        clauses.push(self.noise(unit));
        clauses
    }

    fn noise(&self, unit: &str) -> String {
        let Some(limit) = self.typical_limit() else { return "too few samples to tell noise from wild points".into() };
        let mut finite: Vec<f64> = self.limits.iter().copied().filter(|l| l.is_finite()).collect();
        let rough = quantile(&mut finite, 1.0 - ROUGHEST);
        let own = format!("errors up to {} are this record's own noise", amount(limit, unit));
        if rough > ROUGH * limit { format!("{own}, up to {} where it is rough", amount(rough, unit)) } else { own }
    }
}

/// Two digits of a value, with its unit.
pub(crate) fn amount(value: f64, unit: &str) -> String {
    let rounded: f64 = format!("{value:.1e}").parse().unwrap_or(value);
    if unit.is_empty() { rounded.to_string() } else { format!("{rounded} {unit}") }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::calibration::Rules;

    fn found(limits: Vec<f64>) -> Calibration {
        let objections = vec![0.0; limits.len()];
        let rules = Rules::Noise;
        Calibration { rules, whole: None, resolution: 25.0, held: 0.537, tails: 1.0, objections, limits }
    }

    #[test]
    fn a_record_is_described_in_clauses() {
        let words = found(vec![61.7; 100]).words("ft");
        let wanted =
            ["steps of 25 ft", "54 % repeat the value before", "errors up to 62 ft are this record's own noise"];
        assert_eq!(words, wanted);
    }

    #[test]
    fn a_rough_part_is_told_and_so_is_that_nothing_is_known() {
        let mut limits = vec![1e-4; 100];
        limits[..20].fill(0.5);
        let rough = Calibration { resolution: 0.0, held: 0.0, ..found(limits) };
        assert_eq!(rough.words(""), ["errors up to 0.0001 are this record's own noise, up to 0.5 where it is rough"]);
        let short = Calibration { resolution: 0.0, held: 0.0, ..found(vec![f64::INFINITY; 3]) };
        assert_eq!(short.words("m"), ["too few samples to tell noise from wild points"]);
    }
}
