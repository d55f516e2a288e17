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

/// The check with this id.
///
/// # Errors
/// [`Error::Usage`] with the checks there are and the nearest.
pub fn find(id: &str) -> Result<&'static dyn Check, Error> {
    CHECKS.iter().copied().find(|c| c.about().id == id).ok_or_else(|| {
        let ids: Vec<&str> = CHECKS.iter().map(|c| c.about().id).collect();
        let hint = nearest(id, ids.iter().copied()).map_or(String::new(), |k| format!("did you mean {k}? "));
        Error::usage(format!("{id}: there is no such check"), format!("{hint}checks: {}", ids.join(", ")))
    })
}

/// A test of single samples that does not depend on a model of the channel: a pure function from samples and settings
/// to objections.
pub trait Check: Sync {
    /// What it is and which knobs it has.
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
    /// Its knobs.
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
            (None, None) => Err(Error::usage(
                format!("{id}: without a limit it objects to nothing"),
                format!("set fail, suspect or both: {example}"),
            )),
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
        Value::Whole(n) => Some(n as f64),
        _ => match settings.choice(key) {
            Choice::Number(x) => Some(x),
            Choice::Word(_) => None,
        },
    }
}
