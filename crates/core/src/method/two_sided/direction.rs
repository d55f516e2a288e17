//! What one direction says of a segment (steps 1 to 4 of section 6).

use std::ops::Range;

use super::candidates::{Bounded, Candidates, Closest, NO_CANDIDATE};
use crate::math::pieces;
use crate::method::predictor::{Answer, Engine, Sink, feed};
use crate::method::{Direction, Restart, Segment, Way};
use crate::stop::{Stop, Stopped};

/// The verdicts of one direction, in the order of time.
#[derive(Debug)]
pub struct OneWay {
    /// One per sample.
    pub said: Vec<Direction>,
    /// The closest prediction; NaN where there is none.
    pub expected: Vec<f64>,
    /// Code of the candidate remembered for the run that the sample belongs to.
    pub code: Vec<u8>,
    /// First samples of start groups that follow a restart.
    pub traces: Vec<usize>,
    /// Where models were lost.
    pub restarts: Vec<Restart>,
    way: Way,
}

impl OneWay {
    fn new(n: usize, way: Way, stop: &Stop) -> Result<Self, Stopped> {
        Ok(Self {
            said: vec![Direction::Unjudged; n],
            expected: pieces::collect(n, &|| stop.check(), |_| f64::NAN)?,
            code: vec![NO_CANDIDATE; n],
            traces: Vec::new(),
            restarts: Vec::new(),
            way,
        })
    }

    #[inline]
    fn position(&self, at: usize) -> usize {
        if self.way == Way::Forward { at } else { self.said.len() - 1 - at }
    }
}

impl Sink<Closest> for OneWay {
    fn started(&mut self, group: Range<usize>, again: bool) {
        if again {
            self.traces.push(self.position(group.start));
        }
        for at in group {
            let i = self.position(at);
            self.said[i] = Direction::Normal;
            self.expected[i] = f64::NAN;
        }
    }

    #[inline]
    fn judged(&mut self, at: usize, answer: Answer, run: usize, closest: &Closest) {
        let i = self.position(at);
        self.expected[i] = closest.expected;
        if answer == Answer::Rejects {
            self.said[i] = Direction::Abnormal;
            return;
        }
        self.said[i] = Direction::Normal;
        for at in at - run..at {
            let i = self.position(at);
            self.code[i] = closest.code;
        }
    }

    fn accepted(&mut self, at: usize, predictions: &[Closest]) {
        let (n, k) = (self.said.len(), predictions.len());
        let stretch = if self.way == Way::Forward { at..at + k } else { n - at - k..n - at };
        self.said[stretch.clone()].fill(Direction::Normal);
        let expected = self.expected[stretch].iter_mut();
        let values = predictions.iter().map(|p| p.expected);
        match self.way {
            Way::Forward => expected.zip(values).for_each(|(expected, value)| *expected = value),
            Way::Backward => expected.rev().zip(values).for_each(|(expected, value)| *expected = value),
        }
    }

    fn lost(&mut self, run: Range<usize>) {
        // The run stays abnormal as the lost model left it, as far as no new model gets hold of it.
        self.restarts.push(Restart { at: self.position(run.start), way: self.way });
    }
}

/// Runs a model over a segment in one direction; `delta(i)` is the tolerance of sample i.
///
/// # Errors
/// [`Stopped`] as soon as nobody waits for the result any more.
pub fn run(
    model: Candidates,
    segment: &Segment<'_>,
    delta: impl Fn(usize) -> f64,
    max_run: usize,
    way: Way,
    stop: &Stop,
) -> Result<OneWay, Stopped> {
    let n = segment.len();
    let mut page = OneWay::new(n, way, stop)?;
    let mut engine = Engine::new(model, segment.interval, max_run);
    feed(&mut engine, segment.t, |i| Bounded { y: segment.y[i], delta: delta(i) }, way, &mut page, stop)?;
    Ok(page)
}
