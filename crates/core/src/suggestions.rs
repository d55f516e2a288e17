//! What a channel itself suggests doing with it before its method sees it.

use crate::calibration::repeated::{Repeated, repeated};
use crate::calibration::stuck::{Stuck, stuck};
use crate::calibration::wrap::{Wrap, wrap};
use crate::check::{Applied, missing_values, stuck as stuck_check};
use crate::param::{Numbers, Value};
use crate::preparation::Preparation;

/// Something that a channel suggests.
#[derive(Debug, Clone, PartialEq)]
pub struct Suggestion {
    /// What to do.
    pub remedy: Remedy,
    /// True where the record leaves no doubt: a new session begins with it.
    pub certain: bool,
    /// Why, in words.
    pub words: String,
}

/// What can be done with a channel.
#[derive(Debug, Clone, PartialEq)]
pub enum Remedy {
    /// A check.
    Check(Applied),
    /// A period.
    Period(f64),
}

/// What a channel of this name and unit suggests by its values, in the order of the record (NaN where there is none):
/// missing values, stuck stretches, a period. Linear in the number of values.
#[must_use]
pub fn suggestions(name: &str, unit: &str, values: &[f64]) -> Vec<Suggestion> {
    let y: Vec<f64> = values.iter().copied().filter(|v| v.is_finite()).collect();
    let far = repeated(&y);
    let mut found: Vec<Suggestion> =
        [true, false].into_iter().filter_map(|certain| missing(&far, certain, &y)).collect();
    let is_far = |v: &f64| far.iter().any(|r| r.value.to_bits() == v.to_bits());
    let rest: Vec<f64> = if far.is_empty() { y } else { y.into_iter().filter(|v| !is_far(v)).collect() };
    let period = wrap(name, unit, &rest);
    found.extend(stuck(&rest).and_then(|stuck| held(&stuck)));
    found.extend(period.map(circular));
    found
}

impl Preparation {
    /// What is certain of what was suggested.
    #[must_use]
    pub fn certain(suggested: Vec<Suggestion>) -> Self {
        let mut preparation = Self::default();
        suggested.into_iter().filter(|s| s.certain).for_each(|s| preparation.take(s.remedy));
        preparation
    }

    /// Does what was suggested, too.
    pub fn take(&mut self, remedy: Remedy) {
        match remedy {
            Remedy::Check(check) => self.add(check),
            Remedy::Period(period) => self.period = Some(period),
        }
    }

    /// True when what was suggested is done.
    #[must_use]
    pub fn has(&self, remedy: &Remedy) -> bool {
        match remedy {
            Remedy::Check(check) if check.id() == missing_values::ID => {
                let values = |check: &Applied| check.settings.numbers(missing_values::VALUES);
                let known = |value: &f64| {
                    let same = |other: &Applied| other.id() == check.id() && values(other).as_slice().contains(value);
                    self.checks.iter().any(same)
                };
                values(check).as_slice().iter().all(known)
            }
            Remedy::Check(check) => self.checks.iter().any(|other| other.id() == check.id()),
            Remedy::Period(_) => self.period.is_some(),
        }
    }
}

/// The check of far values of which there is no doubt, or of the others.
fn missing(far: &[Repeated], certain: bool, y: &[f64]) -> Option<Suggestion> {
    let of_kind: Vec<&Repeated> = far.iter().filter(|r| r.certain == certain).take(Numbers::MOST).collect();
    let values: Vec<f64> = of_kind.iter().map(|r| r.value).collect();
    if values.is_empty() {
        return None;
    }
    let mut check = Applied::new(&missing_values::MissingValues);
    check.set(missing_values::VALUES, Value::Numbers(Numbers::of(&values)?)).ok()?;
    #[expect(clippy::cast_precision_loss, reason = "the loader refuses files of 2^32 rows and more")]
    let share = |count: usize| 100.0 * count as f64 / y.len().max(1) as f64;
    let times = |r: &&Repeated| match r.count {
        1 => format!("{:?} once", r.value),
        n => format!("{:?} {n} times ({:.2} %)", r.value, share(n)),
    };
    let list: Vec<String> = of_kind.iter().map(times).collect();
    let verb = if certain { "is" } else { "may be" };
    Some(Suggestion {
        remedy: Remedy::Check(check),
        certain,
        words: format!("{} {verb} a fill value", list.join(", ")),
    })
}

fn held(stuck: &Stuck) -> Option<Suggestion> {
    let mut check = Applied::new(&stuck_check::Stuck);
    check.set(stuck_check::SUSPECT, Value::Whole(i64::try_from(stuck.limit).ok()?)).ok()?;
    let longest = stuck.stretches.iter().map(std::ops::Range::len).max()?;
    let stretches = match stuck.stretches.len() {
        1 => format!("one stretch of {longest}"),
        n => format!("{n} stretches of up to {longest}"),
    };
    let verb = if stuck.certain { "was stuck" } else { "may have been stuck" };
    let words = format!("{verb}: {stretches} equal values, elsewhere at most {}", stuck.longest_own);
    Some(Suggestion { remedy: Remedy::Check(check), certain: stuck.certain, words })
}

fn circular(wrap: Wrap) -> Suggestion {
    let times = if wrap.crossings == 1 { "once".to_owned() } else { format!("{} times", wrap.crossings) };
    let verb = if wrap.certain { "is circular" } else { "may be circular" };
    let words = format!("{verb}, with the period {}: it passes the end {times}", wrap.period);
    Suggestion { remedy: Remedy::Period(wrap.period), certain: wrap.certain, words }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_certain_is_done_and_the_rest_is_offered() {
        let mut heading: Vec<f64> =
            (0..600).map(|i| (f64::from(i) * 1.7 + f64::from(i * 7 % 5) * 0.1) % 360.0).collect();
        (100..160).for_each(|i| heading[i] = -9999.0);
        heading[300] = f64::NAN;
        heading[301] = 9999.0;
        let all = suggestions("hdg", "deg", &heading);
        let preparation = Preparation::certain(all.clone());
        assert_eq!(preparation.period, Some(360.0));
        assert_eq!(preparation.checks.len(), 1);
        assert!(format!("{}", preparation.checks[0]).contains("-9999.0"));
        let offered: Vec<&Suggestion> = all.iter().filter(|s| !preparation.has(&s.remedy)).collect();
        assert_eq!(offered.len(), 1);
        assert!(offered[0].words.starts_with("9999.0 once may be a fill value"), "{}", offered[0].words);
        let mut with_it = preparation.clone();
        with_it.take(offered[0].remedy.clone());
        assert!(all.iter().all(|s| with_it.has(&s.remedy)) && with_it.checks.len() == 2);
    }

    #[test]
    fn a_clean_channel_suggests_nothing() {
        let y: Vec<f64> = (0..500).map(|i| (f64::from(i) * 0.05).sin() * 30.0 + 100.0).collect();
        assert!(suggestions("alt", "m", &y).is_empty());
    }
}
