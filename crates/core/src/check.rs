//! Checks before the method: what a channel cannot have measured, whatever surrounds it. The [`Check`] trait, what a
//! check sees and says, and the registry [`CHECKS`].
//!
//! A sample that a check objects to is an outlier or a suspect by that check, and the method does not see it.
//!
//! Adding a check: write `check/your_check.rs` with a unit struct that implements [`Check`], and add it to
//! [`CHECKS`]. The panel, `--check`, sessions and the contract tests follow.

use crate::error::{Error, nearest};
use crate::method::{Verdict, exceeds};
use crate::param::{Choice, Param, Settings, Value};
use crate::stop::{Stop, Stopped};

mod applied;
mod by_method;
mod islands;
pub mod missing_values;
pub mod null_island;
pub mod position;
pub mod rate;
mod shared;
pub mod stuck;
pub mod valid_range;

pub use applied::{Applied, parse_all};

/// Every check, in the order in which lists show them.
pub static CHECKS: &[&dyn Check] = &[
    &valid_range::ValidRange,
    &missing_values::MissingValues,
    &stuck::Stuck,
    &rate::Rate,
    &null_island::NullIsland,
    &position::Position,
];

/// The check with this id; the id of a method stands for a check that it makes.
///
/// # Errors
/// [`Error::Usage`] with the checks there are and the nearest.
pub fn find(id: &str) -> Result<&'static dyn Check, Error> {
    let registered = CHECKS.iter().copied().find(|c| c.about().id == id);
    registered.or_else(|| by_method::find(id)).ok_or_else(|| {
        let ids: Vec<&str> = CHECKS.iter().map(|c| c.about().id).collect();
        let hint = nearest(id, ids.iter().copied()).map_or(String::new(), |k| format!("did you mean {k}? "));
        Error::usage(
            format!("{id}: there is no such check"),
            format!("{hint}checks: {}; or the id of a method", ids.join(", ")),
        )
    })
}

/// A test of single samples that does not depend on a model of the channel: a pure function from samples and settings
/// to objections.
pub trait Check: Sync {
    /// What it is and which parameters it has.
    fn about(&self) -> &'static About;

    /// What it objects to, by ascending position, each position once.
    ///
    /// # Errors
    /// [`Stopped`] as soon as nobody waits for the result any more.
    fn examine(&self, subject: &Subject<'_>, settings: &Settings, stop: &Stop) -> Result<Vec<Objection>, Stopped>;

    /// Refuses settings under which it cannot object to anything, or that contradict each other.
    ///
    /// # Errors
    /// [`Error::Usage`] with what is wrong and what to set.
    fn verify(&self, settings: &Settings) -> Result<(), Error>;

    /// The evidence of an objection in a few words.
    fn evidence(&self, objection: &Objection) -> String;
}

/// What a check is.
#[derive(Debug)]
pub struct About {
    /// The id of `--check` and the session file.
    pub id: &'static str,
    /// One line for lists.
    pub help: &'static str,
    /// Its parameters.
    pub params: &'static [Param],
    /// What `own` repair does with the samples that it fails.
    pub own: Own,
    /// How many channels it is about, least and most; none for a check of the channel alone.
    pub channels: Option<(usize, usize)>,
}

/// What `own` repair does with samples that a check fails.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Own {
    /// Nothing: the cell stays empty, as nothing was measured.
    Remove,
    /// The line between the accepted samples on both sides.
    Line,
}

/// What a check sees: the present samples of one channel.
#[derive(Debug, Clone, Copy)]
pub struct Subject<'a> {
    /// Times in seconds, strictly increasing.
    pub t: &'a [f64],
    /// Values, finite, as many.
    pub y: &'a [f64],
    /// The period of a circular channel, in units of the channel.
    pub period: Option<f64>,
    /// For a check of several channels: the values of each of them at these times, NaN where there is none, in the order
    /// in which the check names them. Empty otherwise.
    pub channels: &'a [Vec<f64>],
}

/// What a check objects to.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Objection {
    /// Position of the sample.
    pub position: usize,
    /// `Outlier` where it fails, `Suspect` where it is doubtful.
    pub verdict: Verdict,
    /// What was found: a value, a length, a rate.
    pub found: f64,
    /// What it was compared with.
    pub limit: f64,
}

/// The limits of a check: beyond the first a sample is suspect, beyond the second it fails.
#[derive(Debug, Clone, Copy)]
struct Limits {
    suspect: Option<f64>,
    fail: Option<f64>,
}

impl Limits {
    /// The limits under the keys `suspect` and `fail`.
    fn of(settings: &Settings) -> Self {
        Self { suspect: number(settings, shared::SUSPECT), fail: number(settings, shared::FAIL) }
    }

    /// Refuses limits that are both off, or the wrong way round.
    fn verify(self, id: &str, example: &str) -> Result<(), Error> {
        match (self.suspect, self.fail) {
            (None, None) => {
                Err(Error::usage(format!("{id}: needs a limit"), format!("set fail, suspect or both: {example}")))
            }
            (Some(suspect), Some(fail)) if suspect > fail => Err(Error::usage(
                format!("{id}: suspect = {suspect} lies beyond fail = {fail}"),
                "what is suspect begins before what fails: give suspect the smaller limit",
            )),
            _ => Ok(()),
        }
    }

    /// What is said of a sample at which `found` was measured, with the limit that it exceeds.
    fn verdict(self, found: f64) -> Option<(Verdict, f64)> {
        let beyond = |limit: Option<f64>| limit.filter(|limit| exceeds(found, *limit));
        let fails = beyond(self.fail).map(|limit| (Verdict::Outlier, limit));
        fails.or_else(|| beyond(self.suspect).map(|limit| (Verdict::Suspect, limit)))
    }
}

/// The number under `key`; none where it is a word.
fn number(settings: &Settings, key: &str) -> Option<f64> {
    match settings.get(key)? {
        Value::Word(_) => None,
        #[expect(clippy::cast_precision_loss, reason = "a number of samples is far below 2^53")]
        Value::Whole(_) | Value::Duration(_) => Some(settings.whole(key) as f64),
        _ => match settings.choice(key) {
            Choice::Number(x) => Some(x),
            Choice::Word(_) => None,
        },
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::method::METHODS;
    use crate::param::{Kind, Numbers};

    #[test]
    fn ids_and_keys_are_unique_and_every_declared_value_is_legal() {
        let mut ids: Vec<&str> = METHODS.iter().map(|m| m.about().id).collect();
        for about in CHECKS.iter().map(|c| c.about()) {
            assert!(!ids.contains(&about.id) && about.help.len() > 20, "{}", about.id);
            ids.push(about.id);
            for (i, param) in about.params.iter().enumerate() {
                let of = format!("{}.{}", about.id, param.key);
                assert!(about.params[..i].iter().all(|p| p.key != param.key), "{of} comes twice");
                assert!(param.accepts(param.default) && param.help.len() > 5, "{of}");
                assert_eq!(param.parse(&param.default.to_string()).ok(), Some(param.default), "{of} reads back");
                assert!(!["check", "channels", "on"].contains(&param.key), "{of}: a key of the session");
            }
        }
    }

    #[test]
    fn short_constant_and_extreme_records_are_survived_at_every_end_of_every_range() {
        let records: [&[f64]; 6] = [&[], &[1.0], &[1.0, 1e308], &[7.5; 60], &[1e308, -1e308, 1e308, 0.0], &[5e-324; 9]];
        for check in CHECKS {
            let about = check.about();
            let defaults = Settings::defaults(about.params);
            let mut all = vec![defaults.clone()];
            for param in about.params {
                let ends = match param.kind {
                    Kind::Whole { min, max, .. } | Kind::WholeOrOff { min, max } => {
                        vec![Value::Whole(min), Value::Whole(max)]
                    }
                    Kind::Real { min, max, .. } | Kind::RealOr { min, max, .. } => {
                        vec![Value::Real(min), Value::Real(max)]
                    }
                    Kind::Choice(words) => words.iter().map(|w| Value::Word(w)).collect(),
                    Kind::Switch => vec![Value::Switch(false), Value::Switch(true)],
                    Kind::Numbers => vec![Value::Numbers(Numbers::NONE)],
                    Kind::Words(list) => vec![Value::Words(crate::param::Words::all(list))],
                };
                for end in ends {
                    let mut settings = defaults.clone();
                    settings.set(about.id, param.key, end).unwrap();
                    all.push(settings);
                }
            }
            for (y, settings) in records.iter().flat_map(|y| all.iter().map(move |s| (*y, s))) {
                let t: Vec<f64> = (0..y.len()).map(|i| i as f64).collect();
                let channels = vec![y.to_vec(), vec![f64::NAN; y.len()]];
                let subject = Subject { t: &t, y, period: None, channels: &channels };
                let found = check.examine(&subject, settings, &Stop::never()).unwrap();
                let ascends = found.windows(2).all(|w| w[0].position < w[1].position);
                assert!(ascends && found.iter().all(|o| o.position < y.len()), "{} {y:?}", about.id);
                found.iter().for_each(|o| assert!(!check.evidence(o).is_empty()));
            }
        }
    }
}
