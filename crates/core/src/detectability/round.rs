//! One copy of a record with known wild points in it, and what a method finds of them.

use std::sync::Arc;

use super::event::{Event, Kind, SIZES, Wanted, error};
use super::ground::Ground;
use crate::analysis::{Detection, Outcome, Rows, settle};
use crate::error::Result;
use crate::math::random::Random;
use crate::method::Verdict;
use crate::review::Decisions;
use crate::series::Series;
use crate::setup::Setup;
use crate::stop::Stop;

/// A copy of the record with wild points in it.
#[derive(Debug)]
pub(super) struct Round {
    y: Vec<f64>,
    events: Vec<Event>,
    /// Any detection on this copy: it has the calibration.
    calibrated: Detection,
}

/// What was found of the events of one kind and size.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub(super) struct Found {
    /// Events.
    pub(super) events: usize,
    /// Those of which at least half of the samples are outliers.
    pub(super) flagged: usize,
    /// Those of which at least half of the samples are outliers or suspects.
    pub(super) seen: usize,
}

/// The errors of repairs: repaired value minus the value before the wild point was put in.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(super) struct Repairs {
    pub(super) sum_of_squares: f64,
    /// Samples that got a value.
    pub(super) repaired: usize,
    /// Samples that were removed.
    pub(super) removed: usize,
}

/// What a method makes of one copy.
#[derive(Debug, Clone, PartialEq, Default)]
pub(super) struct Tally {
    /// One for each of [`Ground::wanted`].
    pub(super) found: Vec<Found>,
    pub(super) repairs: Repairs,
}

impl Tally {
    pub(super) fn add(&mut self, other: &Self) {
        self.found.resize(self.found.len().max(other.found.len()), Found::default());
        for (all, one) in self.found.iter_mut().zip(&other.found) {
            all.events += one.events;
            all.flagged += one.flagged;
            all.seen += one.seen;
        }
        self.repairs.sum_of_squares += other.repairs.sum_of_squares;
        self.repairs.repaired += other.repairs.repaired;
        self.repairs.removed += other.repairs.removed;
    }
}

impl Round {
    /// A copy with wild points from the random numbers of `seed`; the first of them is `wanted(0)`.
    ///
    /// # Errors
    /// What [`Detection::of`] gives.
    pub(super) fn new(ground: &Ground, seed: u64, wanted: impl Fn(usize) -> Wanted, stop: &Stop) -> Result<Self> {
        let mut random = Random::new(seed);
        let mut y = ground.y.clone();
        let events = ground.places.place(ground.events_at_once(), wanted, &mut random);
        for event in &events {
            let level = random.sign() * SIZES[event.size] * ground.limits[event.range.start];
            for at in event.range.clone() {
                y[at] = match (event.kind, ground.dropout) {
                    (Kind::Dropout, Some(value)) => value,
                    (Kind::Held, _) => y[at] + error(level, 0.0, ground.resolution),
                    _ => {
                        y[at]
                            + error(
                                level,
                                if event.range.len() > 1 { random.uniform() } else { 0.0 },
                                ground.resolution,
                            )
                    }
                };
            }
        }
        let calibrated = Detection::of(ground.input(&Series::new(&ground.t, &y)), &ground.calibrating, stop)?;
        Ok(Self { y, events, calibrated })
    }

    /// How many wild points there are.
    pub(super) fn events(&self) -> usize {
        self.events.len()
    }

    /// What the method of `setup` makes of it.
    ///
    /// # Errors
    /// What [`Detection::of`] gives.
    pub(super) fn tally(&self, ground: &Ground, setup: &Setup, stop: &Stop) -> Result<Tally> {
        let series = Series::new(&ground.t, &self.y);
        let detection = Detection::calibrated(ground.input(&series), setup, Some(&self.calibrated), stop)?;
        let rows = Rows { seconds: &ground.t, own: None };
        let outcome = settle(&series, rows, Arc::new(detection), &Decisions::default(), stop)?;
        let mut tally = Tally { found: vec![Found::default(); ground.wanted.len()], ..Tally::default() };
        for event in &self.events {
            let index = ground.wanted.iter().position(|w| w.kind == event.kind && w.size == event.size);
            let Some(found) = index.map(|i| &mut tally.found[i]) else { continue };
            let count = |is: fn(Verdict) -> bool| event.range.clone().filter(|&at| is(outcome.verdict(at))).count();
            let half = |n: usize| 2 * n >= event.range.len();
            found.events += 1;
            found.flagged += usize::from(half(count(|v| v == Verdict::Outlier)));
            found.seen += usize::from(half(count(|v| matches!(v, Verdict::Outlier | Verdict::Suspect))));
            tally.repairs.count(ground, event, &outcome);
        }
        Ok(tally)
    }
}

impl Repairs {
    /// The root mean square of the errors; none where nothing got a value.
    #[expect(clippy::cast_precision_loss, reason = "counts are far below 2^53")]
    pub(super) fn error(&self) -> Option<f64> {
        (self.repaired > 0).then(|| (self.sum_of_squares / self.repaired as f64).sqrt())
    }

    fn count(&mut self, ground: &Ground, event: &Event, outcome: &Outcome) {
        for at in event.range.clone() {
            match outcome.fix(at) {
                Some(fix) if fix.is_finite() => {
                    self.sum_of_squares += (fix - ground.y[at]).powi(2);
                    self.repaired += 1;
                }
                Some(_) => self.removed += 1,
                None => {}
            }
        }
    }
}
