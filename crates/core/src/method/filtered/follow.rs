//! A recursive filter run over a segment in which it is settled what is wild.

use std::ops::Range;

use super::Filtered;
use crate::method::Way;
use crate::method::predictor::{Answer, Engine, Model, Sink};
use crate::stop::{Stop, Stopped};

/// What a filter gets for a sample.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(in crate::method) enum Entry {
    /// A value that it takes in: measured, or filled in.
    Value(f64),
    /// Nothing: it goes on without the sample.
    Nothing,
}

/// A filter whose state can be asked for.
pub(in crate::method) trait Estimator {
    /// How many samples start it.
    fn group(&self) -> usize;
    /// As [`Model::passed_over`].
    fn passed_over(&self, group: &[(f64, f64)]) -> usize;
    /// Starts from this group.
    fn start(&mut self, group: &[(f64, f64)]);
    /// Goes on to the time `t`, before which `lost` samples are missing.
    fn predict(&mut self, t: f64, lost: usize);
    /// Takes in the sample at that time.
    fn take_in(&mut self, y: f64);
    /// Goes on without it.
    fn pass(&mut self) {}
    /// The state's position and its standard deviation.
    fn estimate(&self) -> [f64; 2];
}

/// What a filter is run over.
#[derive(Debug, Clone, Copy)]
pub(in crate::method) struct Course<'a> {
    /// Times in seconds.
    pub(in crate::method) t: &'a [f64],
    /// What the filter gets at each of them.
    pub(in crate::method) entries: &'a [Entry],
    /// Nominal interval in seconds.
    pub(in crate::method) interval: f64,
    /// Positions at which a new filter starts, ascending.
    pub(in crate::method) restarts: &'a [usize],
    /// True when samples before a start have the values of a filter that runs against time.
    pub(in crate::method) look_back: bool,
}

/// The estimates of new filters along a course.
///
/// # Errors
/// [`Stopped`] as soon as nobody waits for the result any more.
pub(in crate::method) fn follow<E: Estimator>(
    filter: impl Fn() -> E,
    course: &Course<'_>,
    stop: &Stop,
) -> Result<Filtered, Stopped> {
    let n = course.t.len();
    let mut filtered = Filtered::none(n);
    let starts = std::iter::once(0).chain(course.restarts.iter().copied());
    let ends = course.restarts.iter().copied().chain([n]);
    for (start, end) in starts.zip(ends) {
        one_way(filter(), course, start..end, Way::Forward, &mut filtered, stop)?;
    }
    if course.look_back && filtered.value.iter().any(|value| value.is_nan()) {
        let mut back = Filtered::none(n);
        one_way(filter(), course, 0..n, Way::Backward, &mut back, stop)?;
        for i in (0..n).filter(|&i| filtered.value[i].is_nan()).collect::<Vec<_>>() {
            (filtered.value[i], filtered.deviation[i]) = (back.value[i], back.deviation[i]);
        }
    }
    Ok(filtered)
}

fn one_way<E: Estimator>(
    filter: E,
    course: &Course<'_>,
    range: Range<usize>,
    way: Way,
    into: &mut Filtered,
    stop: &Stop,
) -> Result<(), Stopped> {
    let mut engine = Engine::new(Follower { filter, estimate: [f64::NAN; 2] }, course.interval, 0);
    for k in 0..range.len() {
        stop.check_at(k)?;
        let (i, t) = match way {
            Way::Forward => (range.start + k, course.t[range.start + k]),
            Way::Backward => (range.end - 1 - k, -course.t[range.end - 1 - k]),
        };
        engine.push(t, course.entries[i], &mut Unheard);
        if engine.going() {
            [into.value[i], into.deviation[i]] = engine.model().estimate;
        }
    }
    Ok(())
}

/// The estimates are read from the model itself.
struct Unheard;

impl<P> Sink<P> for Unheard {
    fn started(&mut self, _: Range<usize>, _: bool) {}
    fn judged(&mut self, _: usize, _: Answer, _: usize, _: &P) {}
    fn lost(&mut self, _: Range<usize>) {}
}

/// A filter that is updated with the samples it is given, and judges none.
struct Follower<E> {
    filter: E,
    estimate: [f64; 2],
}

impl<E: Estimator> Model for Follower<E> {
    type Sample = Entry;
    type Prediction = [f64; 2];

    fn group(&self) -> usize {
        self.filter.group()
    }

    fn passed_over(&self, group: &[(f64, Entry)]) -> usize {
        let missing = group.iter().rposition(|(_, entry)| *entry == Entry::Nothing);
        missing.map_or_else(|| self.filter.passed_over(&points(group)), |at| at + 1)
    }

    fn start(&mut self, group: &[(f64, Entry)]) {
        self.filter.start(&points(group));
        self.estimate = self.filter.estimate();
    }

    fn predict(&mut self, t: f64, lost: usize, _: usize) {
        self.filter.predict(t, lost);
    }

    fn prediction(&self) -> &[f64; 2] {
        &self.estimate
    }

    fn answer(&mut self, _: f64, entry: Entry) -> Answer {
        match entry {
            Entry::Value(y) => self.filter.take_in(y),
            Entry::Nothing => self.filter.pass(),
        }
        self.estimate = self.filter.estimate();
        if entry == Entry::Nothing { Answer::Rejects } else { Answer::Accepts }
    }
}

fn points(group: &[(f64, Entry)]) -> Vec<(f64, f64)> {
    let point = |&(t, entry): &(f64, Entry)| match entry {
        Entry::Value(y) => Some((t, y)),
        Entry::Nothing => None,
    };
    group.iter().filter_map(point).collect()
}
