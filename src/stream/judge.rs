//! A method fed sample by sample: what it says of each, and what it takes back.

use std::collections::VecDeque;

use super::predict::online;
use super::setup::Plan;
use crate::method::{Verdict, shared};
use crate::track::lost_samples;

/// What is said of one sample.
#[derive(Debug, Clone, Copy)]
pub struct Said {
    /// The verdict; never `Missing`.
    pub verdict: Verdict,
    /// Expected value; NaN where there is none.
    pub expected: f64,
    /// Tolerance; NaN where there is none.
    pub tolerance: f64,
}

impl Said {
    /// Of a sample that waits for a model to start.
    pub const UNCHECKED: Self = Self { verdict: Verdict::Unchecked, expected: f64::NAN, tolerance: f64::NAN };
}

impl PartialEq for Said {
    /// To the bit, and no value is like no other value.
    fn eq(&self, other: &Self) -> bool {
        let bits = |s: &Self| [s.expected, s.tolerance].map(|x| if x.is_nan() { 0 } else { x.to_bits() });
        let absent = |s: &Self| [s.expected.is_nan(), s.tolerance.is_nan()];
        self.verdict == other.verdict && bits(self) == bits(other) && absent(self) == absent(other)
    }
}

/// What a method does with a sample of a segment; samples are counted from 0 at its first.
#[derive(Debug, Clone, Copy)]
pub(super) enum Event {
    /// Says this of sample `at`, whatever it said before.
    Says(usize, Said),
    /// Lost its model at the run of outliers that begins with this sample.
    Lost(usize),
}

/// A method that judges the samples of one segment as they come.
pub(super) trait Online {
    /// Takes the next sample. Says something of it, of earlier ones, or of none.
    fn push(&mut self, t: f64, y: f64, events: &mut Vec<Event>);
}

/// Judges a channel as it comes, cutting it where too many samples are lost.
pub struct Judge<L> {
    plan: Plan,
    interval: f64,
    max_gap: Option<usize>,
    segment: Box<dyn Online>,
    last: f64,
    /// Samples of this segment so far.
    count: usize,
    /// The newest of them.
    recent: VecDeque<Recent<L>>,
    /// How many of them are kept.
    reach: usize,
    events: Vec<Event>,
    /// Places among the newest of which something was said.
    touched: Vec<usize>,
}

/// A sample that the method may still speak of.
struct Recent<L> {
    label: L,
    /// What was handed on.
    told: Said,
    /// What is said now.
    now: Said,
}

/// What came of one sample.
#[derive(Debug, Clone, PartialEq)]
pub struct Heard<L> {
    /// What is said of it.
    pub said: Said,
    /// Earlier samples of which something else is said now: what was said, and what is.
    pub corrections: Vec<(L, Said, Said)>,
    /// First samples of the runs at which the model was lost.
    pub lost: Vec<L>,
}

impl<L: Clone> Judge<L> {
    /// A judge that has heard nothing; `interval` is the nominal interval in seconds.
    #[must_use]
    pub fn new(plan: Plan, interval: f64) -> Self {
        let settings = &plan.settings;
        let whole = |key: &str| settings.get(key).map_or(0, |_| settings.whole(key));
        // No method speaks of samples before the start group or the run at hand. 16: no start group that is not a
        // setting is longer.
        let reach = (whole(shared::MAX_RUN.key) + 1).max(whole("start")).max(16);
        Self {
            segment: online(&plan, interval),
            max_gap: settings.whole_or_off(shared::MAX_GAP.key),
            plan,
            interval,
            last: f64::NAN,
            count: 0,
            recent: VecDeque::with_capacity(reach),
            reach,
            events: Vec::new(),
            touched: Vec::new(),
        }
    }

    /// Takes the next sample, later than the last; `label` comes back with what is said of it later.
    pub fn push(&mut self, t: f64, y: f64, label: L) -> Heard<L> {
        let cut = |max_gap| self.count > 0 && lost_samples(t - self.last, self.interval) > max_gap;
        if self.max_gap.is_some_and(cut) {
            self.segment = online(&self.plan, self.interval);
            self.count = 0;
            self.recent.clear();
        }
        self.last = t;
        self.count += 1;
        if self.recent.len() == self.reach {
            self.recent.pop_front();
        }
        self.recent.push_back(Recent { label, told: Said::UNCHECKED, now: Said::UNCHECKED });
        self.events.clear();
        self.segment.push(t, y, &mut self.events);
        self.hear()
    }

    /// How many samples are kept because more may be said of them.
    #[cfg(test)]
    pub(super) fn kept(&self) -> usize {
        self.recent.len()
    }

    /// Takes down the events, and gives what is new.
    fn hear(&mut self) -> Heard<L> {
        let mut lost = Vec::new();
        self.touched.clear();
        for event in &self.events {
            let (Event::Says(at, _) | Event::Lost(at)) = *event;
            let back = self.count.checked_sub(at + 1);
            let place = back.and_then(|back| self.recent.len().checked_sub(back + 1));
            debug_assert!(place.is_some(), "sample {at} of {} is out of reach", self.count);
            let Some((place, slot)) = place.and_then(|p| Some((p, self.recent.get_mut(p)?))) else { continue };
            match *event {
                Event::Says(_, said) => {
                    slot.now = said;
                    self.touched.push(place);
                }
                Event::Lost(_) => lost.push(slot.label.clone()),
            }
        }
        let newest = self.recent.len() - 1;
        let said = self.recent.get_mut(newest).map_or(Said::UNCHECKED, |r| {
            r.told = r.now;
            r.now
        });
        self.touched.sort_unstable();
        self.touched.dedup();
        let mut corrections = Vec::new();
        for &place in &self.touched {
            let Some(r) = self.recent.get_mut(place).filter(|r| r.told != r.now) else { continue };
            corrections.push((r.label.clone(), r.told, r.now));
            r.told = r.now;
        }
        Heard { said, corrections, lost }
    }
}
