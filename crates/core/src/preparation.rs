//! What is done with a channel before its method sees it.

use std::f64::consts::TAU;

use crate::check::{Applied, CHECKS};
use crate::error::{Error, Result};

/// What is done with a channel before its method sees it. What it takes out counts as missing for the method.
#[derive(Debug, Clone, Default, PartialEq, serde::Serialize)]
pub struct Preparation {
    /// Checks, in the order in which they are made: each sees what those before it left.
    pub checks: Vec<Applied>,
    /// Period of a circular channel, in units of the channel: it is judged unwrapped, and written wrapped.
    pub period: Option<f64>,
    /// True when what the analyst decided to be wild is taken out, and what was decided to be good left in.
    pub exclude_decided: bool,
}

impl Preparation {
    /// Adds a check in its place: in the order of the registry, after those of its kind.
    pub fn add(&mut self, check: Applied) {
        let rank = |applied: &Applied| CHECKS.iter().position(|c| c.about().id == applied.id()).unwrap_or(usize::MAX);
        let at = self.checks.partition_point(|other| rank(other) <= rank(&check));
        self.checks.insert(at, check);
    }

    /// True when nothing is done.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        *self == Self::default()
    }

    /// True when a check is switched on.
    #[must_use]
    pub fn checks_anything(&self) -> bool {
        self.checks.iter().any(|check| check.on)
    }
}

/// Reads a period: `360`, `2pi`, or `off` for a channel that is not circular.
///
/// # Errors
/// [`Error::Usage`] for anything but a positive number.
pub fn parse_period(text: &str) -> Result<Option<f64>> {
    let text = text.trim();
    if text == "off" {
        return Ok(None);
    }
    let number = match text.strip_suffix("pi") {
        Some("") => Some(TAU / 2.0),
        Some(times) => times.trim_end_matches('*').parse().ok().map(|n: f64| n * (TAU / 2.0)),
        None => text.parse().ok(),
    };
    number.filter(|p| is_period(*p)).map(Some).ok_or_else(|| {
        let what = format!("period = {text}: not a period");
        Error::usage(what, "give a positive number in the channel's units, for example 360, 24 or 2pi, or off")
    })
}

/// True for a number that can be a period.
#[must_use]
pub fn is_period(period: f64) -> bool {
    period.is_finite() && period > 0.0
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_period_is_a_number_or_a_multiple_of_pi() {
        assert_eq!(parse_period("360").unwrap(), Some(360.0));
        assert_eq!(parse_period("2pi").unwrap(), Some(TAU));
        assert_eq!(parse_period("off").unwrap(), None);
        for text in ["0", "-5", "nan", "north", "xpi"] {
            assert!(parse_period(text).is_err(), "{text}");
        }
    }

    #[test]
    fn checks_stand_in_the_order_of_the_registry() {
        let mut preparation = Preparation::default();
        for text in ["rate:fail=1", "stuck:fail=9", "missing-values:values=1", "stuck:fail=5"] {
            preparation.add(Applied::parse(text).unwrap());
        }
        let ids: Vec<String> = preparation.checks.iter().map(|c| format!("{c:?}")).collect();
        assert!(ids[0].starts_with("missing") && ids[1].contains("9") && ids[2].contains("5"), "{ids:?}");
        assert!(preparation.checks_anything() && !preparation.is_empty());
    }
}
