//! A method's parameters, declared once.
//!
//! A [`Param`] is a row of plain data: key, help, unit, kind, default, paper value and when it matters. The panel,
//! `--set`, the session file, validation, `wildpoint methods`, the README table and the contract tests are all
//! derived from it. [`Settings`] is one value for each parameter of a list, always valid.

use crate::error::{Error, Result, nearest};

mod duration;
mod numbers;
mod paper;
mod settings;
mod value;
mod words;

pub use numbers::Numbers;
pub use paper::Paper;
pub use settings::Settings;
pub use value::{Choice, Value};
pub use words::Words;

/// The unit of parameters that count samples. Whole numbers of them may be given as lengths of time, too.
pub const SAMPLES: &str = "samples";

/// One parameter.
#[derive(Debug, Clone, Copy)]
pub struct Param {
    /// The key of `--set`, the session file and the palette.
    pub key: &'static str,
    /// One line for the panel and `wildpoint methods`.
    pub help: &'static str,
    /// Unit of the value; empty for a plain number.
    pub unit: &'static str,
    /// Which values are legal and how far a step goes.
    pub kind: Kind,
    /// The value that works on real tracks.
    pub default: Value,
    /// The value in the settings of the source document, where that is another.
    pub paper: Option<Paper>,
    /// False when the value cannot change the result under the other settings: the panel hides it then.
    pub matters: fn(&Settings) -> bool,
}

/// The legal values of a parameter.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Kind {
    /// A whole number from `min` to `max`.
    Whole {
        /// Smallest legal value.
        min: i64,
        /// Largest legal value.
        max: i64,
        /// How far one step of the panel goes.
        step: i64,
    },
    /// A finite number from `min` to `max`.
    Real {
        /// Smallest legal value.
        min: f64,
        /// Largest legal value.
        max: f64,
        /// How far one step of the panel goes.
        step: Step,
    },
    /// One of a few words.
    Choice(&'static [&'static str]),
    /// Yes or no.
    Switch,
    /// One of a few words, or a number.
    RealOr {
        /// The words, the default one first.
        words: &'static [&'static str],
        /// The number is at least this …
        min: f64,
        /// … and at most this.
        max: f64,
    },
    /// `off`, or a whole number.
    WholeOrOff {
        /// Smallest legal number.
        min: i64,
        /// Largest legal number.
        max: i64,
    },
    /// Up to [`Numbers::MOST`] numbers.
    Numbers,
    /// Some of a few words, at least one.
    Words(&'static [&'static str]),
}

/// How far one step of the panel goes on a real scale.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Step {
    /// Adds this.
    Add(f64),
    /// Multiplies by this.
    Times(f64),
}

/// [`Param::matters`] of a parameter that always matters.
#[must_use]
pub fn always(_: &Settings) -> bool {
    true
}

impl Param {
    /// The same parameter with another default.
    #[must_use]
    pub const fn with_default(mut self, default: Value) -> Self {
        self.default = default;
        self
    }

    /// The same parameter with another paper value.
    #[must_use]
    pub const fn with_paper(mut self, paper: Option<Paper>) -> Self {
        self.paper = paper;
        self
    }

    /// The same parameter with another rule for when it matters.
    #[must_use]
    pub const fn with_matters(mut self, matters: fn(&Settings) -> bool) -> Self {
        self.matters = matters;
        self
    }

    /// True when a length of time may stand for a number of samples.
    #[must_use]
    pub fn takes_durations(&self) -> bool {
        self.unit == SAMPLES && matches!(self.kind, Kind::Whole { .. } | Kind::WholeOrOff { .. })
    }

    /// The unit of a value: that of the parameter, but for a duration, which has its own.
    #[must_use]
    pub fn unit_of(&self, value: Value) -> &'static str {
        if matches!(value, Value::Duration(_)) { "" } else { self.unit }
    }

    /// The legal values, in words: `3 .. 1001`, `mad | rms`.
    #[must_use]
    pub fn range(&self) -> String {
        let time = if self.takes_durations() { " | a duration like 30s" } else { "" };
        match self.kind {
            Kind::Whole { min, max, .. } => format!("{min} .. {max}{time}"),
            Kind::Real { min, max, .. } => format!("{} .. {}", bound(min), bound(max)),
            Kind::Choice(words) => words.join(" | "),
            Kind::Switch => "true | false".into(),
            Kind::RealOr { words, min, max } => {
                let least = if min == f64::MIN_POSITIVE { "above 0".into() } else { format!("from {}", bound(min)) };
                format!("{} | a number {least} to {}", words.join(" | "), bound(max))
            }
            Kind::WholeOrOff { min, max } => format!("off | {min} .. {max}{time}"),
            Kind::Numbers => format!("up to {} numbers", Numbers::MOST),
            Kind::Words(words) => format!("all | some of {}", words.join(", ")),
        }
    }

    /// Reads a value as the user typed it.
    ///
    /// # Errors
    /// [`Error::Usage`] naming the key, the text and the legal values.
    pub fn parse(&self, text: &str) -> Result<Value> {
        let text = text.trim();
        let read = match self.kind {
            Kind::Whole { .. } => text.parse().ok().map(Value::Whole),
            Kind::Real { .. } => text.parse().ok().map(Value::Real),
            Kind::Choice(words) => word(words, text),
            Kind::Switch => match text {
                "true" | "yes" | "on" => Some(Value::Switch(true)),
                "false" | "no" | "off" => Some(Value::Switch(false)),
                _ => None,
            },
            Kind::RealOr { words, .. } => word(words, text).or_else(|| text.parse().ok().map(Value::Real)),
            Kind::WholeOrOff { .. } => word(&["off"], text).or_else(|| text.parse().ok().map(Value::Whole)),
            Kind::Numbers => Numbers::parse(text).map(Value::Numbers),
            Kind::Words(words) => Words::parse(words, text).map(Value::Words),
        };
        let read = read.or_else(|| duration::parse(text).map(Value::Duration));
        read.filter(|v| self.accepts(*v)).ok_or_else(|| self.refuse(text))
    }

    /// Takes a value of any spelling that means a legal one (for example a whole number for a real one).
    ///
    /// # Errors
    /// [`Error::Usage`] naming the key, the value and the legal values.
    pub fn accept(&self, value: Value) -> Result<Value> {
        #[expect(clippy::cast_precision_loss, reason = "settings typed by a person are far below 2^53")]
        let value = match (self.kind, value) {
            (Kind::Real { .. } | Kind::RealOr { .. }, Value::Whole(n)) => Value::Real(n as f64),
            (_, other) => other,
        };
        if self.accepts(value) { Ok(value) } else { Err(self.refuse(&value.to_string())) }
    }

    /// True when the value is of the right kind and in range.
    #[must_use]
    pub fn accepts(&self, value: Value) -> bool {
        match (self.kind, value) {
            (Kind::Whole { min, max, .. } | Kind::WholeOrOff { min, max }, Value::Whole(n)) => (min..=max).contains(&n),
            (Kind::Real { min, max, .. } | Kind::RealOr { min, max, .. }, Value::Real(x)) => (min..=max).contains(&x),
            (Kind::Choice(words) | Kind::RealOr { words, .. }, Value::Word(w)) => words.contains(&w),
            (Kind::WholeOrOff { .. }, Value::Word(w)) => w == "off",
            (Kind::Switch, Value::Switch(_)) | (Kind::Numbers, Value::Numbers(_)) => true,
            (Kind::Words(list), Value::Words(words)) => words.are_of(list),
            (_, Value::Duration(seconds)) => self.takes_durations() && seconds.is_finite() && seconds > 0.0,
            _ => false,
        }
    }

    fn refuse(&self, text: &str) -> Error {
        let unit = if self.unit.is_empty() { String::new() } else { format!(" ({})", self.unit) };
        let words: &[&str] = match self.kind {
            Kind::Choice(words) | Kind::RealOr { words, .. } => words,
            _ => &[],
        };
        let meant = nearest(text, words.iter().copied());
        let hint = meant.map_or(String::new(), |near| format!("did you mean {near}? "));
        Error::usage(
            format!("{} = {text}: not a legal value", self.key),
            format!("{hint}{} takes {}{unit}: {}", self.key, self.range(), self.help),
        )
    }

    /// The value `steps` steps of the panel away, stopped at the ends of the range.
    ///
    /// A number of a word-or-number parameter moves by a twentieth of a decade; words are walked one by one.
    #[must_use]
    pub fn step(&self, value: Value, steps: i64) -> Value {
        match (self.kind, value) {
            (Kind::Whole { min, max, step }, Value::Whole(n)) => {
                Value::Whole(n.saturating_add(step.saturating_mul(steps)).clamp(min, max))
            }
            (Kind::Real { min, max, step }, Value::Real(x)) => Value::Real(step.from(x, steps).clamp(min, max)),
            (Kind::RealOr { min, max, .. }, Value::Real(x)) => {
                let least = if min < 0.0 { min } else { min.max(f64::MIN_POSITIVE) };
                // Up is up for negative numbers, too.
                let steps = if x < 0.0 { -steps } else { steps };
                Value::Real(Step::Times(1.122).from(x, steps).clamp(least, max))
            }
            (Kind::Choice(words) | Kind::RealOr { words, .. }, Value::Word(w)) => {
                let at = words.iter().position(|x| *x == w).unwrap_or(0);
                let last = words.len().saturating_sub(1);
                let to = at.saturating_add_signed(isize::try_from(steps).unwrap_or(0)).min(last);
                Value::Word(words.get(to).copied().unwrap_or(w))
            }
            (Kind::Switch, Value::Switch(_)) => Value::Switch(steps > 0),
            (Kind::WholeOrOff { min, max }, Value::Whole(n)) => {
                let to = n.saturating_add(steps);
                if to > max { Value::Word("off") } else { Value::Whole(to.max(min)) }
            }
            (Kind::WholeOrOff { max, .. }, Value::Word(_)) if steps < 0 => Value::Whole(max),
            (_, Value::Duration(seconds)) => {
                Value::Duration(Step::Times(1.122).from(seconds, steps).clamp(f64::MIN_POSITIVE, 1e12))
            }
            (_, other) => other,
        }
    }
}

impl Step {
    /// `x` moved by `steps`, on the grid of the step so that ten steps up and ten down end where they began.
    fn from(self, x: f64, steps: i64) -> f64 {
        #[expect(clippy::cast_precision_loss, reason = "steps are keystrokes")]
        let steps = steps as f64;
        match self {
            Self::Add(step) => ((x / step).round() + steps) / (1.0 / step),
            Self::Times(factor) => {
                let to = x * factor.powf(steps);
                // Three significant digits keep the value readable in the panel and in the session.
                format!("{to:.2e}").parse().unwrap_or(to)
            }
        }
    }
}

/// A limit of a range, as short as it can be told.
fn bound(x: f64) -> String {
    if x.abs() > 1e15 || (x != 0.0 && x.abs() < 1e-5) { format!("{x:e}") } else { x.to_string() }
}

fn word(words: &'static [&'static str], text: &str) -> Option<Value> {
    words.iter().find(|w| **w == text).map(|w| Value::Word(w))
}

/// The parameter of a list that has this key.
///
/// # Errors
/// [`Error::Usage`] with the keys there are and the nearest one.
pub fn find(params: &'static [Param], owner: &str, key: &str) -> Result<&'static Param> {
    params.iter().find(|p| p.key == key).ok_or_else(|| {
        let hint = nearest(key, params.iter().map(|p| p.key)).map_or(String::new(), |k| format!("did you mean {k}? "));
        let keys: Vec<&str> = params.iter().map(|p| p.key).collect();
        Error::usage(
            format!("{key}: {owner} has no such parameter"),
            format!("{hint}its parameters are: {}", keys.join(", ")),
        )
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    const K: Param = Param {
        key: "k",
        help: "tolerance",
        unit: "sigma",
        kind: Kind::Real { min: 0.5, max: 100.0, step: Step::Add(0.1) },
        default: Value::Real(3.0),
        paper: None,
        matters: always,
    };

    #[test]
    fn both_limits_of_a_number_are_told() {
        let of = |min, max| Param { kind: Kind::RealOr { words: &["auto", "off"], min, max }, ..K }.range();
        assert_eq!(of(0.0, 1e300), "auto | off | a number from 0 to 1e300");
        assert_eq!(of(f64::MIN_POSITIVE, 1e300), "auto | off | a number above 0 to 1e300");
        assert_eq!(of(1.0, 1000.0), "auto | off | a number from 1 to 1000");
        let real = |min, max| Param { kind: Kind::Real { min, max, step: Step::Add(1.0) }, ..K }.range();
        assert_eq!(real(0.0, 1e300), "0 .. 1e300", "not 301 digits");
        assert_eq!(real(-1e300, 1e-9), "-1e300 .. 1e-9");
        assert_eq!(real(0.001, 0.5), "0.001 .. 0.5");
    }

    #[test]
    fn ten_steps_up_and_ten_down_end_where_they_began() {
        let mut v = K.default;
        for _ in 0..10 {
            v = K.step(v, 1);
        }
        assert_eq!(v, Value::Real(4.0));
        for _ in 0..10 {
            v = K.step(v, -1);
        }
        assert_eq!(v, Value::Real(3.0));
    }

    #[test]
    fn a_value_out_of_range_names_the_key_and_the_range() {
        let message = K.parse("0.1").unwrap_err().to_string();
        assert!(message.contains("k = 0.1") && message.contains("0.5 .. 100"), "{message}");
        assert!(K.parse("nan").is_err());
        assert!(K.accept(Value::Whole(4)).is_ok_and(|v| v == Value::Real(4.0)));
    }

    #[test]
    fn a_step_up_is_up_for_negative_numbers_too() {
        let low = Param { kind: Kind::RealOr { words: &["off"], min: -1e300, max: 1e300 }, ..K };
        let next = |steps| match low.step(Value::Real(-40.0), steps) {
            Value::Real(x) => x,
            other => panic!("{other}"),
        };
        assert!(next(1) > -40.0 && next(1) < -30.0 && next(-1) < -40.0 && next(-1) > -50.0);
    }

    #[test]
    fn off_lies_above_the_largest_number() {
        let gap = Param { kind: Kind::WholeOrOff { min: 0, max: 5 }, default: Value::Whole(5), ..K };
        assert_eq!(gap.step(Value::Whole(5), 1), Value::Word("off"));
        assert_eq!(gap.step(Value::Word("off"), -1), Value::Whole(5));
        assert_eq!(gap.parse("off").unwrap(), Value::Word("off"));
    }
}
