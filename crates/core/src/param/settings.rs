//! One value for each parameter of a list.

use super::{Choice, Numbers, Param, Value, find};
use crate::error::Result;

/// One legal value for each parameter of a list. Cloning is cheap; two settings of one method compare by value.
#[derive(Debug, Clone)]
pub struct Settings {
    params: &'static [Param],
    values: Vec<Value>,
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
        Self { params, values: params.iter().map(|p| p.default).collect() }
    }

    /// Every parameter as its source document prescribes it, the others at their defaults.
    #[must_use]
    pub fn paper(params: &'static [Param]) -> Self {
        Self { params, values: params.iter().map(|p| p.paper.unwrap_or(p.default)).collect() }
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
            other => panic!("{key}: read as a whole number, declared as {other:?}"),
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
