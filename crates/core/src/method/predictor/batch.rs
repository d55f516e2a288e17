//! Whole records at a predictor's pace: the ordinary samples, which are nearly all, many at a time.

use super::{Engine, Model, Sink};
use crate::method::Way;
use crate::stop::{Stop, Stopped};

/// Samples handed over at a time.
const BLOCK: usize = 512;

/// A step of fewer intervals than this has lost nothing.
const USUAL: f64 = 1.49;

/// A model that can take in many ordinary samples in one go, faster than one by one.
pub trait Batch: Model<Prediction: Copy> {
    /// Takes in samples from the first on, as long as each is accepted and comes less than `whole` seconds after the
    /// one before it (nothing is lost then), and as long as it pleases: the rest goes through [`Model::predict`] and
    /// [`Model::answer`]. A model goes and no outlier stands before the first. Says how many it took, and in `said`,
    /// which is as long as the samples, what it predicted of them. Not one bit differs from what sample by sample
    /// gives.
    fn take_in(&mut self, t: &[f64], samples: &[Self::Sample], whole: f64, said: &mut [Self::Prediction]) -> usize {
        let _ = (t, samples, whole, said);
        0
    }
}

/// Feeds an engine with `sample(0 .. t.len())`, with time or against it.
///
/// # Errors
/// [`Stopped`] as soon as nobody waits for the result any more.
pub fn feed<M: Batch>(
    engine: &mut Engine<M>,
    t: &[f64],
    sample: impl Fn(usize) -> M::Sample,
    way: Way,
    sink: &mut impl Sink<M::Prediction>,
    stop: &Stop,
) -> Result<(), Stopped> {
    let n = t.len();
    let (mut times, mut samples) = (Vec::with_capacity(BLOCK), Vec::with_capacity(BLOCK));
    let mut said = vec![*engine.model().prediction(); BLOCK];
    for from in (0..n).step_by(BLOCK) {
        stop.check()?;
        let to = (from + BLOCK).min(n);
        times.clear();
        samples.clear();
        match way {
            Way::Forward => {
                times.extend_from_slice(&t[from..to]);
                samples.extend((from..to).map(&sample));
            }
            Way::Backward => {
                times.extend(t[n - to..n - from].iter().rev().map(|t| -t));
                samples.extend((n - to..n - from).rev().map(&sample));
            }
        }
        engine.push_block(&times, &samples, &mut said, sink);
    }
    Ok(())
}

impl<M: Batch> Engine<M> {
    /// [`Engine::push`] for each of these samples; `said` has room for as many predictions.
    fn push_block(
        &mut self,
        t: &[f64],
        samples: &[M::Sample],
        said: &mut [M::Prediction],
        sink: &mut impl Sink<M::Prediction>,
    ) {
        let mut at = 0;
        while at < t.len() {
            if self.going && self.run == 0 {
                let said = &mut said[..t.len() - at];
                let taken = self.model.take_in(&t[at..], &samples[at..], USUAL * self.interval, said);
                if taken > 0 {
                    sink.accepted(self.count, &said[..taken]);
                    self.count += taken;
                    at += taken;
                    self.last = t[at - 1];
                    if at == t.len() {
                        return;
                    }
                }
            }
            self.push(t[at], samples[at], sink);
            at += 1;
        }
    }
}
