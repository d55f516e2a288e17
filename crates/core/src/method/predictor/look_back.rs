//! A predictor over a whole segment: forwards, and backwards for the samples that the forward run cannot judge.

use std::ops::Range;

use super::{Answer, Batch, Engine, Model, Prediction, Sink, feed};
use crate::math::pieces::PIECE;
use crate::method::{Judged, Restart, Segment, Verdict, Way};
use crate::stop::{Stop, Stopped};

/// What one run says of the samples of a segment, in the order of time.
#[derive(Debug, Default)]
pub struct Page {
    /// Verdicts, expected values and tolerances of the samples kept: with time, of those so far.
    pub judged: Judged,
    /// The first start group, in positions of the segment.
    pub first: Option<Range<usize>>,
    /// How many samples are kept: those of lower positions.
    kept: usize,
    /// Number of samples, for a run against time.
    reversed: Option<usize>,
}

impl Page {
    /// An empty page for a run over `n` samples that keeps what is said of the first `kept` in time.
    ///
    /// # Errors
    /// [`Stopped`] as soon as nobody waits for the result any more.
    pub fn new(n: usize, way: Way, kept: usize, stop: &Stop) -> Result<Self, Stopped> {
        let mut page = Self { kept, reversed: (way == Way::Backward).then_some(n), ..Self::default() };
        page.judged.verdict.reserve_exact(kept);
        page.judged.expected.reserve_exact(kept);
        page.judged.tolerance.reserve_exact(kept);
        page.clear(stop)?;
        Ok(page)
    }

    /// Empties the page for another run.
    ///
    /// # Errors
    /// [`Stopped`] as soon as nobody waits for the result any more.
    pub fn clear(&mut self, stop: &Stop) -> Result<(), Stopped> {
        self.judged.verdict.clear();
        self.judged.expected.clear();
        self.judged.tolerance.clear();
        self.judged.restarts.clear();
        self.first = None;
        // With time the page grows as it is written: memory that is filled twice costs twice.
        if self.reversed.is_some() {
            self.complete(stop)?;
        }
        Ok(())
    }

    /// To be called when all samples have come: those of which nothing was said are unchecked.
    ///
    /// # Errors
    /// [`Stopped`] as soon as nobody waits for the result any more.
    pub fn complete(&mut self, stop: &Stop) -> Result<(), Stopped> {
        while self.judged.verdict.len() < self.kept {
            stop.check()?;
            self.grow(self.kept.min(self.judged.verdict.len() + PIECE));
        }
        Ok(())
    }

    /// Of the samples up to `n` that are not on the page yet, nothing is said.
    #[cold]
    fn grow(&mut self, n: usize) {
        if n > self.judged.verdict.len() {
            self.judged.verdict.resize(n, Verdict::Unchecked);
            self.judged.expected.resize(n, f64::NAN);
            self.judged.tolerance.resize(n, f64::NAN);
        }
    }

    /// Position in the segment of the sample that came as number `at`.
    #[inline]
    fn position(&self, at: usize) -> usize {
        self.reversed.map_or(at, |n| n - 1 - at)
    }

    #[inline]
    fn put(&mut self, at: usize, verdict: Verdict, expected: f64, tolerance: f64) {
        let i = self.position(at);
        if i >= self.kept {
            return;
        }
        if i > self.judged.verdict.len() {
            self.grow(i);
        }
        let judged = &mut self.judged;
        if i == judged.verdict.len() {
            judged.verdict.push(verdict);
            judged.expected.push(expected);
            judged.tolerance.push(tolerance);
        } else {
            judged.verdict[i] = verdict;
            judged.expected[i] = expected;
            judged.tolerance[i] = tolerance;
        }
    }
}

impl Sink<Prediction> for Page {
    fn started(&mut self, group: Range<usize>, again: bool) {
        for at in group.clone() {
            // A restart must leave a trace: the target may have changed its course, or a patch was too long.
            let suspect = again && at == group.start;
            self.put(at, if suspect { Verdict::Suspect } else { Verdict::Normal }, f64::NAN, f64::NAN);
        }
        if self.first.is_none() {
            let (a, b) = (self.position(group.start), self.position(group.end - 1));
            self.first = Some(a.min(b)..a.max(b) + 1);
        }
    }

    #[inline]
    fn judged(&mut self, at: usize, answer: Answer, _: usize, prediction: &Prediction) {
        let verdict = if answer == Answer::Accepts { Verdict::Normal } else { Verdict::Outlier };
        self.put(at, verdict, prediction.expected, prediction.tolerance);
    }

    fn accepted(&mut self, at: usize, predictions: &[Prediction]) {
        match self.reversed {
            None if at >= self.judged.verdict.len() && at + predictions.len() <= self.kept => {
                self.grow(at);
                let judged = &mut self.judged;
                judged.verdict.resize(at + predictions.len(), Verdict::Normal);
                judged.expected.extend(predictions.iter().map(|p| p.expected));
                judged.tolerance.extend(predictions.iter().map(|p| p.tolerance));
            }
            // The first of them stands last in time: nothing to write before the run comes near the kept ones.
            Some(n) if n - at - predictions.len() >= self.kept => {}
            Some(n) if n - at <= self.kept => {
                let stretch = n - at - predictions.len()..n - at;
                let judged = &mut self.judged;
                judged.verdict[stretch.clone()].fill(Verdict::Normal);
                for (expected, p) in judged.expected[stretch.clone()].iter_mut().rev().zip(predictions) {
                    *expected = p.expected;
                }
                for (tolerance, p) in judged.tolerance[stretch].iter_mut().rev().zip(predictions) {
                    *tolerance = p.tolerance;
                }
            }
            None | Some(_) => {
                for (k, prediction) in predictions.iter().enumerate() {
                    self.put(at + k, Verdict::Normal, prediction.expected, prediction.tolerance);
                }
            }
        }
    }

    fn lost(&mut self, run: Range<usize>) {
        let at = self.position(run.start);
        if at < self.kept {
            let way = if self.reversed.is_some() { Way::Backward } else { Way::Forward };
            self.judged.restarts.push(Restart { at, way });
        }
        run.for_each(|at| self.put(at, Verdict::Unchecked, f64::NAN, f64::NAN));
    }
}

/// The start group that a model finds first.
#[derive(Debug)]
pub struct First {
    /// Its end, in positions of the segment.
    pub end: usize,
}

impl First {
    /// Looks for it; none when the segment has no start.
    ///
    /// # Errors
    /// [`Stopped`] as soon as nobody waits for the result any more.
    pub fn of<M: Model<Sample = f64>>(model: M, segment: &Segment<'_>, stop: &Stop) -> Result<Option<Self>, Stopped> {
        let mut engine = Engine::new(model, segment.interval, 0);
        let mut first: Option<Range<usize>> = None;
        for (i, (&t, &y)) in segment.t.iter().zip(segment.y).enumerate() {
            stop.check_at(i)?;
            engine.push(t, y, &mut Nothing(&mut first));
            if let Some(group) = first {
                return Ok(Some(Self { end: group.end }));
            }
        }
        Ok(None)
    }
}

/// Keeps only the first start group.
struct Nothing<'a>(&'a mut Option<Range<usize>>);

impl<P> Sink<P> for Nothing<'_> {
    fn started(&mut self, group: Range<usize>, _: bool) {
        self.0.get_or_insert(group);
    }
    fn judged(&mut self, _: usize, _: Answer, _: usize, _: &P) {}
    fn lost(&mut self, _: Range<usize>) {}
}

/// Judges a segment forwards. With `look_back`, the first start group and all before it are taken from a run over
/// the whole reversed segment: nothing earlier could judge them. A segment without a start stays unchecked. `model` is
/// a new model for a run in this direction.
///
/// # Errors
/// [`Stopped`] as soon as nobody waits for the result any more.
pub fn judge_both_ways<M: Batch<Sample = f64, Prediction = Prediction>>(
    model: impl Fn(Way) -> M + Sync,
    segment: &Segment<'_>,
    max_run: usize,
    look_back: bool,
    stop: &Stop,
) -> Result<Judged, Stopped> {
    let n = segment.len();
    let Some(first) = First::of(model(Way::Forward), segment, stop)? else {
        return Judged::unchecked_many(n, stop);
    };
    let run = |way, kept| {
        let mut page = Page::new(n, way, kept, stop)?;
        let mut engine = Engine::new(model(way), segment.interval, max_run);
        feed(&mut engine, segment.t, |i| segment.y[i], way, &mut page, stop)?;
        page.complete(stop)?;
        Ok(page.judged)
    };
    if !look_back {
        return run(Way::Forward, n);
    }
    let (forward, backward) = rayon::join(|| run(Way::Forward, n), || run(Way::Backward, first.end));
    let (mut judged, mut back): (Judged, Judged) = (forward?, backward?);
    judged.verdict[..first.end].copy_from_slice(&back.verdict);
    judged.expected[..first.end].copy_from_slice(&back.expected);
    judged.tolerance[..first.end].copy_from_slice(&back.tolerance);
    judged.restarts.append(&mut back.restarts);
    Ok(judged)
}
