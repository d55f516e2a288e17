//! The settings of a method with which it finds most on a record.

use super::{Measured, Study};
use crate::error::Result;
use crate::method::shared::MAX_GAP;
use crate::param::{Kind, Param, Value};
use crate::setup::Setup;
use crate::stop::Stop;

/// Whole numbers that are tried in place of one, as factors of it.
const FACTORS: [f64; 6] = [0.5, 0.7, 0.85, 1.2, 1.5, 2.0];

/// A change of settings is taken where it finds at least so much more, as a share of all that was put in.
const GAIN: f64 = 0.005;

/// What a search is allowed.
pub struct Budget<'a> {
    /// At most this many outliers on the record as it is; none: as many as the settings that were given flag there.
    pub flags: Option<usize>,
    /// True as soon as no further settings are to be tried.
    pub is_over: &'a dyn Fn() -> bool,
}

/// What a search gained.
#[derive(Debug, Clone, serde::Serialize)]
pub struct Tuned {
    /// With the settings that were given.
    pub before: Measured,
    /// With the best ones that were found.
    pub after: Measured,
    /// How many settings were tried.
    pub tried: usize,
    /// True where the time was over before the search was.
    pub cut_short: bool,
}

impl Study {
    /// Searches settings with which a method finds more of the wild points that the study has put in, one parameter
    /// after the other, again and again until none helps: whole numbers, words and switches of the method. Its
    /// threshold, its noise scale and the gap limit stay. None before the first round, or where the record cannot be
    /// asked.
    ///
    /// # Errors
    /// [`Error::Stopped`](crate::Error::Stopped), and what [`Study::measure`] gives.
    pub fn tune(&self, setup: &Setup, budget: &Budget<'_>, stop: &Stop) -> Result<Option<Tuned>> {
        let Some(before) = self.measure(std::slice::from_ref(setup), stop)?.pop() else { return Ok(None) };
        let most = budget.flags.unwrap_or(before.untouched.flagged);
        let mut search = Search { best: before.clone(), most, tried: 1, cut_short: false };
        loop {
            let reached = search.best.recall;
            for param in setup.method.about().params {
                if (budget.is_over)() {
                    search.cut_short = true;
                    break;
                }
                search.along(self, param, stop)?;
            }
            if search.cut_short || search.best.recall <= reached {
                break;
            }
        }
        Ok(Some(Tuned { before, after: search.best, tried: search.tried, cut_short: search.cut_short }))
    }
}

struct Search {
    best: Measured,
    /// At most this many outliers on the record as it is.
    most: usize,
    tried: usize,
    cut_short: bool,
}

impl Search {
    /// Tries other values of `param`, and keeps the best where it is worth it.
    fn along(&mut self, study: &Study, param: &'static Param, stop: &Stop) -> Result<()> {
        let now = &self.best.setup;
        if param.key == MAX_GAP.key || !(param.matters)(&now.settings) {
            return Ok(());
        }
        let id = now.method.about().id;
        let with = |value: Value| {
            let mut other = now.clone();
            other.settings.set(id, param.key, value).ok().map(|()| other)
        };
        let others: Vec<Setup> = values(param, now.settings.get(param.key)).into_iter().filter_map(with).collect();
        if others.is_empty() {
            return Ok(());
        }
        let measured = study.measure(&others, stop)?;
        self.tried += measured.len();
        let allowed = |m: &Measured| m.untouched.flagged <= self.most;
        let best = measured.into_iter().filter(allowed).max_by(|a, b| a.recall.total_cmp(&b.recall));
        if let Some(best) = best.filter(|best| best.recall >= self.best.recall + GAIN) {
            self.best = best;
        }
        Ok(())
    }
}

/// The values that are tried in place of `now`.
fn values(param: &Param, now: Option<Value>) -> Vec<Value> {
    match (param.kind, now) {
        (Kind::Whole { min, max, .. } | Kind::WholeOrOff { min, max }, Some(Value::Whole(n))) => {
            #[expect(clippy::cast_precision_loss, clippy::cast_possible_truncation, reason = "clamped to the range")]
            let near = |factor: &f64| ((n as f64 * factor).round() as i64).clamp(min, max);
            // Factors of small numbers fall together, so the neighbours are tried, too.
            let mut all: Vec<i64> = FACTORS.iter().map(near).chain([(n - 1).max(min), (n + 1).min(max)]).collect();
            all.sort_unstable();
            all.dedup();
            all.into_iter().filter(|other| *other != n).map(Value::Whole).collect()
        }
        (Kind::Choice(words), Some(Value::Word(word))) => {
            words.iter().filter(|w| **w != word).map(|w| Value::Word(w)).collect()
        }
        (Kind::Switch, Some(Value::Switch(on))) => vec![Value::Switch(!on)],
        _ => Vec::new(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::method::shared::WINDOW;

    #[test]
    fn values_lie_around_the_present_one_and_in_the_range() {
        let tried = values(&WINDOW, Some(Value::Whole(3)));
        assert_eq!(tried, [4, 5, 6].map(Value::Whole));
        assert!(values(&MAX_GAP, Some(Value::Word("off"))).is_empty());
    }
}
