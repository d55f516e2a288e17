//! How small a wild point can be and still be found on this record; and which method finds most on it.
//!
//! Beyond the documents. They compare methods on simulated tracks. A [`Study`] asks the record itself: copies of it get
//! wild points of known kind and size ([`Kind`], [`SIZES`]) in calm places, and every method judges every copy. What it
//! finds of them by size is its detectability on this record, at these settings; what it flags on the untouched record,
//! and most other methods do not, is taken for false. [`Study::advice`] weighs one against the other.
//!
//! ```
//! use wildpoint_core::detectability::Study;
//! use wildpoint_core::{Series, Setup, stop::Stop};
//!
//! let t: Vec<f64> = (0..400).map(f64::from).collect();
//! let y: Vec<f64> = (0..400).map(|i| f64::from(i) + f64::from(i * i).sin()).collect();
//! let series = Series::new(&t, &y);
//! let mut study = Study::new((&series).into(), vec![Setup::standard()], 1, &Stop::never())?;
//! while study.advance(&Stop::never())? {}
//! let advice = study.advice();
//! let smallest = advice.methods[0].kinds[0].smallest.expect("single points are found");
//! assert!((1.0..20.0).contains(&smallest), "{smallest} in the units of the channel");
//! # Ok::<(), wildpoint_core::Error>(())
//! ```

use std::fmt;
use std::time::Instant;

use rayon::prelude::*;

use crate::analysis::{Detection, Input};
use crate::error::Result;
use crate::math::random::Random;
use crate::method::Verdict;
use crate::series::Series;
use crate::setup::Setup;
use crate::stop::Stop;

mod advice;
mod curve;
mod event;
mod excerpt;
mod ground;
mod own;
mod placement;
mod round;
mod tuning;
mod words;

pub use advice::{Advice, Measured, Untouched};
pub use curve::{Curve, OF_ALL, Point};
pub use event::{Kind, SIZES};
pub use excerpt::WHOLE;
use ground::Ground;
pub use own::OfKind;
use round::{Round, Tally};
pub use tuning::{Budget, Tuned};
pub use words::{Detected, two_digits};

/// This many wild points of each kind and size are put in, in all rounds together.
const EVENTS: usize = 32;

/// In all rounds together at most this many samples are calibrated: what bounds the time on a short record.
const MOST_SAMPLES: usize = 1 << 19;

/// Methods on copies of a record that have known wild points in them.
#[derive(Debug)]
pub struct Study {
    ground: std::result::Result<Ground, Unsuitable>,
    setups: Vec<Setup>,
    untouched: Vec<Alone>,
    tallies: Vec<Tally>,
    /// The copies so far.
    copies: Vec<Round>,
    /// Samples of the whole record.
    samples: usize,
    seed: u64,
    rounds: Rounds,
}

/// How far a study has come.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Rounds {
    /// Rounds that are done.
    pub done: usize,
    /// Rounds in all; 0 before the first is done.
    pub all: usize,
    /// Parts of copies in which a wild point was wanted so far.
    wanted: usize,
}

/// What a method says of the untouched record.
#[derive(Debug, Clone, Default)]
struct Alone {
    flagged: Vec<u32>,
    suspects: usize,
    unchecked: usize,
    milliseconds: f64,
}

/// Why a record cannot be asked.
#[derive(Debug, Clone, Copy, PartialEq, serde::Serialize)]
#[serde(tag = "why", rename_all = "kebab-case")]
pub enum Unsuitable {
    /// It has too few samples.
    TooShort {
        /// How many it has.
        samples: usize,
    },
    /// Too few samples agree with their neighbours.
    TooContaminated {
        /// The share that does, from 0 to 1.
        calm: f64,
    },
    /// Gaps and changes leave too few places between them.
    TooIrregular {
        /// How many places there are.
        places: usize,
    },
}

impl fmt::Display for Unsuitable {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::TooShort { samples } => write!(f, "the record is too short: {samples} samples"),
            Self::TooContaminated { calm } => write!(
                f,
                "the record is too contaminated: only {:.0} % of its samples agree with their neighbours",
                100.0 * calm
            ),
            Self::TooIrregular { places } => {
                write!(f, "the record is too irregular: only {places} samples have calm neighbours on both sides")
            }
        }
    }
}

impl Study {
    /// A study of the methods of `setups`, all with the preparation of the first, on the channel of `input`; `seed` is
    /// that of the random numbers. Of a channel with more than [`WHOLE`] samples, 16 pieces are taken.
    ///
    /// # Errors
    /// [`Error::Stopped`](crate::Error::Stopped), and what [`Detection::of`] gives.
    pub fn new(input: Input<'_>, setups: Vec<Setup>, seed: u64, stop: &Stop) -> Result<Self> {
        let preparation = setups.first().map(|setup| setup.preparation.clone()).unwrap_or_default();
        let setups: Vec<Setup> = setups.into_iter().map(|setup| setup.prepared(&preparation)).collect();
        let samples = input.series.len();
        let ground = Ground::of(input, &preparation, stop)?;
        let untouched = match &ground {
            Ok(ground) => untouched(ground, &setups, stop)?,
            Err(_) => Vec::new(),
        };
        let tallies = vec![Tally::default(); setups.len()];
        let (copies, rounds) = (Vec::new(), Rounds::default());
        Ok(Self { ground, setups, untouched, tallies, copies, samples, seed, rounds })
    }

    /// Why this record cannot be asked; none where it can.
    #[must_use]
    pub fn unsuitable(&self) -> Option<Unsuitable> {
        self.ground.as_ref().err().copied()
    }

    /// How far it has come.
    #[must_use]
    pub fn rounds(&self) -> Rounds {
        self.rounds
    }

    /// Puts wild points into another copy and lets every method judge it. False when nothing is left to do.
    ///
    /// # Errors
    /// [`Error::Stopped`](crate::Error::Stopped), and what [`Detection::of`] gives. Nothing is counted then.
    pub fn advance(&mut self, stop: &Stop) -> Result<bool> {
        let Ok(ground) = &self.ground else { return Ok(false) };
        if self.rounds.done > 0 && self.rounds.done >= self.rounds.all {
            return Ok(false);
        }
        let order = shuffled(ground.wanted.len(), self.seed);
        let wanted = |i: usize| ground.wanted[order[(self.rounds.wanted + i) % order.len()]];
        // Rounds of one seed must differ, and those of neighbouring seeds, too.
        let seed = self.seed.wrapping_mul(0x9E37_79B9_7F4A_7C15).wrapping_add(self.rounds.done as u64 + 1);
        let round = Round::new(ground, seed, wanted, stop)?;
        let tallies: Vec<Tally> =
            self.setups.par_iter().map(|setup| round.tally(ground, setup, stop)).collect::<Result<_>>()?;
        self.tallies.iter_mut().zip(&tallies).for_each(|(all, one)| all.add(one));
        if self.rounds.done == 0 {
            self.rounds.all = rounds(ground, round.events());
        }
        self.rounds.done += 1;
        self.rounds.wanted += ground.events_at_once();
        self.copies.push(round);
        Ok(self.rounds.done < self.rounds.all)
    }

    /// What other settings make of the same wild points, one for each of `setups`. Empty before the first round, or where
    /// the record cannot be asked.
    ///
    /// # Errors
    /// [`Error::Stopped`](crate::Error::Stopped), and what [`Detection::of`] gives.
    pub fn measure(&self, setups: &[Setup], stop: &Stop) -> Result<Vec<Measured>> {
        let Ok(ground) = &self.ground else { return Ok(Vec::new()) };
        if self.copies.is_empty() {
            return Ok(Vec::new());
        }
        let preparation = self.setups.first().map(|setup| setup.preparation.clone()).unwrap_or_default();
        let setups: Vec<Setup> = setups.iter().map(|setup| setup.clone().prepared(&preparation)).collect();
        let said = untouched(ground, &setups, stop)?;
        let tally = |setup: &Setup| {
            let mut all = Tally::default();
            for round in &self.copies {
                all.add(&round.tally(ground, setup, stop)?);
            }
            Ok(all)
        };
        let tallies: Vec<Tally> = setups.par_iter().map(tally).collect::<Result<_>>()?;
        Ok(advice::measured(ground, &setups, &tallies, &said))
    }

    /// The advice among other settings, on the same wild points.
    ///
    /// # Errors
    /// As [`Study::measure`].
    pub fn compare(&self, setups: &[Setup], stop: &Stop) -> Result<Advice> {
        Ok(Advice::among(self, self.measure(setups, stop)?))
    }

    /// What came out so far.
    #[must_use]
    pub fn advice(&self) -> Advice {
        Advice::of(self)
    }
}

/// How many rounds it takes until there are [`EVENTS`] of each kind and size, when one has this many `events`.
fn rounds(ground: &Ground, events: usize) -> usize {
    let wanted = (EVENTS * ground.wanted.len()).div_ceil(events.max(1));
    wanted.clamp(1, (MOST_SAMPLES / ground.y.len().max(1)).max(1))
}

/// The numbers below `n` in an order of chance.
fn shuffled(n: usize, seed: u64) -> Vec<usize> {
    let mut random = Random::new(seed);
    let mut order: Vec<usize> = (0..n).collect();
    for i in (1..n).rev() {
        order.swap(i, random.whole(0, i));
    }
    order
}

/// What each method says of the record as it is. One after the other, so that the times say something.
fn untouched(ground: &Ground, setups: &[Setup], stop: &Stop) -> Result<Vec<Alone>> {
    let series = Series::new(&ground.t, &ground.y);
    let calibrated = Detection::of(ground.input(&series), &ground.calibrating, stop)?;
    let mut all = Vec::with_capacity(setups.len());
    for setup in setups {
        let start = Instant::now();
        let detection = Detection::calibrated(ground.input(&series), setup, Some(&calibrated), stop)?;
        let milliseconds = start.elapsed().as_secs_f64() * 1e3;
        let verdict = detection.judged.verdict();
        let is = |wanted: Verdict| verdict.iter().filter(|v| **v == wanted).count();
        #[expect(clippy::cast_possible_truncation, reason = "an excerpt has few samples")]
        let flagged = (0..verdict.len()).filter(|&i| verdict[i] == Verdict::Outlier).map(|i| i as u32).collect();
        all.push(Alone { flagged, suspects: is(Verdict::Suspect), unchecked: is(Verdict::Unchecked), milliseconds });
    }
    Ok(all)
}

#[cfg(test)]
mod tests;
