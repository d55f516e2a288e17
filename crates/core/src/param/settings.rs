//! One value for each parameter of a list.

use super::{Choice, Kind, Numbers, Param, Value, Words, find};
use crate::error::Result;

/// One legal value for each parameter of a list. Cloning is cheap; two settings of one method compare by value.
#[derive(Debug, Clone)]
pub struct Settings {
    params: &'static [Param],
    values: Vec<Value>,
    /// How many seconds a sample takes, where that is known: what durations are counted in.
    interval: Option<f64>,
}

impl PartialEq for Settings {
    fn eq(&self, other: &Self) -> bool {
        std::ptr::eq(self.params, other.params) && self.values == other.values
    }
}

impl serde::Serialize for Settings {
    fn serialize<S: serde::Serializer>(&self, serializer: S) -> std::result::Result<S::Ok, S::Error> {
        serializer.collect_map(self.iter().map(|(param, value)| (param.key, value)))
    }
}

impl Settings {
    /// Every parameter at its default.
    #[must_use]
    pub fn defaults(params: &'static [Param]) -> Self {
        Self { params, values: params.iter().map(|p| p.default).collect(), interval: None }
    }

    /// Every parameter as its source document has it, the others at their defaults.
    #[must_use]
    pub fn paper(params: &'static [Param]) -> Self {
        Self {
            params,
            values: params.iter().map(|p| p.paper.map_or(p.default, |paper| paper.value)).collect(),
            interval: None,
        }
    }

    /// The same settings for samples that are this many seconds apart, which durations are counted in.
    #[must_use]
    pub fn at_interval(&self, seconds: f64) -> Self {
        Self { interval: Some(seconds).filter(|s| s.is_finite() && *s > 0.0), ..self.clone() }
    }

    /// How many seconds a sample takes, where that is known.
    #[must_use]
    pub fn interval(&self) -> Option<f64> {
        self.interval
    }

    /// True when a number of samples is given as a length of time.
    #[must_use]
    pub fn has_durations(&self) -> bool {
        self.values.iter().any(|v| matches!(v, Value::Duration(_)))
    }

    /// The list these are the settings of.
    #[must_use]
    pub fn params(&self) -> &'static [Param] {
        self.params
    }

    /// Parameters with their values, in the order of the list.
    pub fn iter(&self) -> impl Iterator<Item = (&'static Param, Value)> + '_ {
        self.params.iter().zip(self.values.iter().copied())
    }

    /// Parameters that matter under these settings, with their values.
    pub fn mattering(&self) -> impl Iterator<Item = (&'static Param, Value)> + '_ {
        self.iter().filter(|(p, _)| (p.matters)(self))
    }

    /// The value of `key`, if the list has it.
    #[must_use]
    pub fn get(&self, key: &str) -> Option<Value> {
        self.params.iter().position(|p| p.key == key).and_then(|i| self.values.get(i).copied())
    }

    /// Sets `key`; `owner` is named in the error.
    ///
    /// # Errors
    /// [`crate::error::Error::Usage`] for an unknown key or an illegal value; the settings stay as they were.
    pub fn set(&mut self, owner: &str, key: &str, value: Value) -> Result<()> {
        let value = find(self.params, owner, key)?.accept(value)?;
        self.put(key, value);
        Ok(())
    }

    /// Sets `key` from text.
    ///
    /// # Errors
    /// As [`Settings::set`].
    pub fn set_text(&mut self, owner: &str, key: &str, text: &str) -> Result<()> {
        let value = find(self.params, owner, key)?.parse(text)?;
        self.put(key, value);
        Ok(())
    }

    fn put(&mut self, key: &str, value: Value) {
        if let Some(slot) = self.params.iter().position(|p| p.key == key).and_then(|i| self.values.get_mut(i)) {
            *slot = value;
        }
    }

    /// The whole number of `key`. The method that asks has declared the key with that kind (a contract test
    /// runs every method), so a mismatch is a fault of the program, not of the user; the same holds for the
    /// other readers below.
    ///
    /// # Panics
    /// When the list has no such whole-number parameter.
    #[must_use]
    #[track_caller]
    pub fn whole(&self, key: &str) -> usize {
        match self.get(key) {
            Some(Value::Whole(n)) => usize::try_from(n).unwrap_or(0),
            Some(Value::Duration(seconds)) => self.samples(key, seconds),
            other => panic!("{key}: read as a whole number, declared as {other:?}"),
        }
    }

    /// The samples that a duration takes, in the range of the parameter; its default where the interval is not known.
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        clippy::cast_precision_loss,
        reason = "within the range of the parameter"
    )]
    fn samples(&self, key: &str, seconds: f64) -> usize {
        let Some(param) = self.params.iter().find(|p| p.key == key) else { return 0 };
        let (Kind::Whole { min, max, .. } | Kind::WholeOrOff { min, max }) = param.kind else { return 0 };
        match (self.interval, param.default) {
            (Some(interval), _) => (seconds / interval).round().clamp(min as f64, max as f64) as usize,
            (None, Value::Whole(n)) => usize::try_from(n).unwrap_or(0),
            (None, _) => usize::try_from(min).unwrap_or(0),
        }
    }

    /// The number of `key`.
    ///
    /// # Panics
    /// When the list has no such real parameter.
    #[must_use]
    #[track_caller]
    pub fn real(&self, key: &str) -> f64 {
        match self.get(key) {
            Some(Value::Real(x)) => x,
            other => panic!("{key}: read as a real number, declared as {other:?}"),
        }
    }

    /// The word of `key`.
    ///
    /// # Panics
    /// When the list has no such word parameter.
    #[must_use]
    #[track_caller]
    pub fn word(&self, key: &str) -> &'static str {
        match self.get(key) {
            Some(Value::Word(w)) => w,
            other => panic!("{key}: read as a word, declared as {other:?}"),
        }
    }

    /// Whether `key` is on.
    ///
    /// # Panics
    /// When the list has no such switch.
    #[must_use]
    #[track_caller]
    pub fn switch(&self, key: &str) -> bool {
        match self.get(key) {
            Some(Value::Switch(b)) => b,
            other => panic!("{key}: read as a switch, declared as {other:?}"),
        }
    }

    /// The word or the number of `key`.
    ///
    /// # Panics
    /// When the list has no such parameter.
    #[must_use]
    #[track_caller]
    pub fn choice(&self, key: &str) -> Choice {
        match self.get(key) {
            Some(Value::Word(w)) => Choice::Word(w),
            Some(Value::Real(x)) => Choice::Number(x),
            other => panic!("{key}: read as a word or number, declared as {other:?}"),
        }
    }

    /// The numbers of `key`.
    ///
    /// # Panics
    /// When the list has no such parameter.
    #[must_use]
    #[track_caller]
    pub fn numbers(&self, key: &str) -> Numbers {
        match self.get(key) {
            Some(Value::Numbers(list)) => list,
            other => panic!("{key}: read as numbers, declared as {other:?}"),
        }
    }

    /// The words of `key`.
    ///
    /// # Panics
    /// When the list has no such parameter.
    #[must_use]
    #[track_caller]
    pub fn words(&self, key: &str) -> Words {
        match self.get(key) {
            Some(Value::Words(words)) => words,
            other => panic!("{key}: read as words, declared as {other:?}"),
        }
    }

    /// The whole number of `key`, or none when it is `off`.
    ///
    /// # Panics
    /// When the list has no such parameter.
    #[must_use]
    #[track_caller]
    pub fn whole_or_off(&self, key: &str) -> Option<usize> {
        match self.get(key) {
            Some(Value::Word(_)) => None,
            _ => Some(self.whole(key)),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::param::{SAMPLES, Step, always};

    const WINDOW: Param = Param {
        key: "window",
        help: "samples",
        unit: SAMPLES,
        kind: Kind::Whole { min: 3, max: 1001, step: 2 },
        default: Value::Whole(21),
        paper: None,
        matters: always,
    };
    const K: Param = Param {
        key: "k",
        unit: "sigma",
        kind: Kind::Real { min: 0.5, max: 100.0, step: Step::Add(0.1) },
        default: Value::Real(3.0),
        ..WINDOW
    };
    static PARAMS: &[Param] =
        &[WINDOW, K, Param { key: "max_gap", kind: Kind::WholeOrOff { min: 0, max: 100 }, ..WINDOW }];

    #[test]
    fn a_duration_is_counted_in_samples() {
        let mut settings = Settings::defaults(PARAMS);
        settings.set_text("x", "window", "30s").unwrap();
        settings.set_text("x", "max_gap", "2min").unwrap();
        let at = settings.at_interval(2.0);
        assert_eq!((at.whole("window"), at.whole_or_off("max_gap")), (15, Some(60)));
        assert_eq!(settings.at_interval(1e6).whole("window"), 3, "not below the range");
        assert_eq!(settings.whole("window"), 21, "the default while no interval is known");
        assert!(settings == at && settings.has_durations() && settings.get("window").unwrap().to_string() == "30s");
        assert!(settings.set_text("x", "k", "3s").is_err(), "no number of samples");
    }
}
