//! What the predictors of section 4 have in common beside the engine: settings and the plausibility check.

use crate::method::{exceeds, shared};
use crate::param::Settings;

/// Settings that all predictors share.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Rules {
    /// Multiplier of the tolerance.
    pub k: f64,
    /// More outliers in a row than this lose the model; 0: never.
    pub max_run: usize,
    /// A faster change than this per second is an outlier at once; 0: no such check.
    pub max_rate: f64,
    /// Whether the samples up to the first start group are judged by a run backwards.
    pub look_back: bool,
}

impl Rules {
    /// Reads them.
    #[must_use]
    pub fn of(settings: &Settings) -> Self {
        Self {
            k: settings.real(shared::K.key),
            max_run: settings.whole(shared::MAX_RUN.key),
            max_rate: settings.real(shared::MAX_RATE.key),
            look_back: settings.switch(shared::LOOK_BACK.key),
        }
    }
}

/// The first-difference check, eq. (20) of \[001\]: the change since the last accepted sample.
#[derive(Debug, Clone, Copy)]
pub struct RateLimit {
    limit: f64,
    last: (f64, f64),
}

impl RateLimit {
    /// A check against `limit` units per second; 0: none.
    #[must_use]
    pub fn new(limit: f64) -> Self {
        Self { limit, last: (f64::NAN, f64::NAN) }
    }

    /// Whether there is such a check.
    #[must_use]
    pub fn is_set(&self) -> bool {
        self.limit > 0.0
    }

    /// Whether the sample changed too fast.
    #[must_use]
    #[inline]
    pub fn broken(&self, t: f64, y: f64) -> bool {
        self.limit > 0.0 && exceeds((y - self.last.1).abs() / (t - self.last.0), self.limit)
    }

    /// The sample was accepted.
    #[inline]
    pub fn accept(&mut self, t: f64, y: f64) {
        self.last = (t, y);
    }
}

/// The warning of a predictor whose settings hide outliers from it.
#[must_use]
pub fn cannot_flag(rules: &Rules) -> Vec<String> {
    let mut lines = Vec::new();
    if (1..5).contains(&rules.max_run) {
        lines.push(format!(
            "max_run = {}: a run of {} or more outliers is taken for a change of the trajectory",
            rules.max_run,
            rules.max_run + 1
        ));
    }
    if !rules.look_back {
        lines.push("look_back is off: outliers among the first five samples are not seen".into());
    }
    lines
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_rate_is_measured_from_the_last_accepted_sample() {
        let mut rate = RateLimit::new(10.0);
        rate.accept(100.0, 50.0);
        assert!(!rate.broken(100.5, 55.0), "10 a second reaches the limit and does not exceed it");
        assert!(rate.broken(100.5, 55.1) && rate.broken(100.5, 44.9));
        assert!(!rate.broken(101.0, 55.1));
        let mut off = RateLimit::new(0.0);
        off.accept(0.0, 0.0);
        assert!(!off.broken(1e-9, 1e9));
    }
}
