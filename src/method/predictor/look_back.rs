//! A predictor over a whole segment: forwards, and backwards for the samples that the forward run cannot judge.

use std::ops::Range;

use super::{Answer, Engine, Model, Prediction, Sink};
use crate::method::{Judged, Restart, Segment, Verdict, Way};
use crate::stop::{Stop, Stopped};

/// What one run says of the samples of a segment, in the order of time.
#[derive(Debug, Default)]
pub struct Page {
    /// Verdicts, expected values and tolerances of the samples kept.
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
    #[must_use]
    pub fn new(n: usize, way: Way, kept: usize) -> Self {
        let reversed = (way == Way::Backward).then_some(n);
        Self { judged: Judged::unchecked(kept), first: None, kept, reversed }
    }

    /// Empties the page for another run.
    pub fn clear(&mut self) {
        self.judged.verdict.fill(Verdict::Unchecked);
        self.judged.expected.fill(f64::NAN);
        self.judged.tolerance.fill(f64::NAN);
        self.judged.restarts.clear();
        self.first = None;
    }

    /// Position in the segment of the sample that came as number `at`.
    #[inline]
    fn position(&self, at: usize) -> usize {
        self.reversed.map_or(at, |n| n - 1 - at)
    }

    fn put(&mut self, at: usize, verdict: Verdict, expected: f64, tolerance: f64) {
        let i = self.position(at);
        if i < self.kept {
            self.judged.verdict[i] = verdict;
            self.judged.expected[i] = expected;
            self.judged.tolerance[i] = tolerance;
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
    #[must_use]
    pub fn of<M: Model>(model: M, segment: &Segment<'_>, sample: impl Fn(usize) -> M::Sample) -> Option<Self> {
        let mut engine = Engine::new(model, segment.interval, 0);
        let mut page = Page::new(segment.len(), Way::Forward, 0);
        for i in 0..segment.len() {
            engine.push(segment.t[i], sample(i), &mut Nothing(&mut page.first));
            if let Some(group) = page.first {
                return Some(Self { end: group.end });
            }
        }
        None
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
/// the whole reversed segment: nothing earlier could judge them. A segment without a start stays unchecked.
///
/// # Errors
/// [`Stopped`] as soon as nobody waits for the result any more.
pub fn judge_both_ways<M: Model<Sample = f64, Prediction = Prediction>>(
    model: impl Fn() -> M + Sync,
    segment: &Segment<'_>,
    max_run: usize,
    look_back: bool,
    stop: &Stop,
) -> Result<Judged, Stopped> {
    let n = segment.len();
    let Some(first) = First::of(model(), segment, |i| segment.y[i]) else {
        return Ok(Judged::unchecked(n));
    };
    let forward = || {
        let mut page = Page::new(n, Way::Forward, n);
        let mut engine = Engine::new(model(), segment.interval, max_run);
        for i in 0..n {
            stop.check_at(i)?;
            engine.push(segment.t[i], segment.y[i], &mut page);
        }
        Ok(page.judged)
    };
    let backward = || {
        let mut page = Page::new(n, Way::Backward, first.end);
        let mut engine = Engine::new(model(), segment.interval, max_run);
        for i in (0..n).rev() {
            stop.check_at(i)?;
            engine.push(-segment.t[i], segment.y[i], &mut page);
        }
        Ok(page.judged)
    };
    if !look_back {
        return forward();
    }
    let (forward, backward) = rayon::join(forward, backward);
    let (mut judged, mut back): (Judged, Judged) = (forward?, backward?);
    judged.verdict[..first.end].copy_from_slice(&back.verdict);
    judged.expected[..first.end].copy_from_slice(&back.expected);
    judged.tolerance[..first.end].copy_from_slice(&back.tolerance);
    judged.restarts.append(&mut back.restarts);
    Ok(judged)
}
