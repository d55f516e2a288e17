//! Expected value and scale of one window.

use std::ops::Range;

use super::{Center, Rule, Spread};
use crate::math::moments::Moments;
use crate::math::sliding::Sliding;
use crate::math::sorted_window::SortedWindow;

/// Expected value and scale of a sliding window.
#[derive(Debug)]
pub(super) struct Statistics {
    center: Center,
    spread: Spread,
    sorted: Option<SortedWindow>,
    /// Before and after the sample in the middle: with feedback the former change, the latter do not.
    moments: Option<(Sliding<Moments>, Sliding<Moments>)>,
    at: Range<usize>,
}

impl Statistics {
    /// Nothing yet, for windows of this rule.
    pub(super) fn new(rule: &Rule) -> Self {
        let sorted = rule.center == Center::Median || rule.spread == Spread::Mad;
        let moments = rule.center == Center::Mean || rule.spread == Spread::Rms;
        Self {
            center: rule.center,
            spread: rule.spread,
            sorted: sorted.then(SortedWindow::new),
            moments: moments.then(Default::default),
            at: 0..0,
        }
    }

    /// Moves to the window `x[range]`, of which the samples before `middle` may be replaced ones.
    #[inline]
    pub(super) fn move_to(&mut self, x: &[f64], range: Range<usize>, middle: usize) {
        if let Some(sorted) = &mut self.sorted {
            sorted.move_to(x, range.clone());
        }
        if let Some((before, after)) = &mut self.moments {
            before.move_to(x, range.start..middle);
            after.move_to(x, middle..range.end);
        }
        self.at = range;
    }

    /// Takes notice of a sample in the middle of the window `range` that was replaced.
    pub(super) fn replaced(&mut self, at: usize, range: &Range<usize>, old: f64, new: f64) {
        // The moments after the middle drop it unseen, those before it take it in anew.
        let holds = self.at == *range && range.contains(&at);
        match &mut self.sorted {
            Some(sorted) if holds => sorted.exchange(old, new),
            Some(sorted) => sorted.forget(),
            None => {}
        }
    }

    /// Forgets the window: more than its middle has changed.
    pub(super) fn forget(&mut self) {
        self.at = 0..0;
        if let Some(sorted) = &mut self.sorted {
            sorted.forget();
        }
        if let Some((before, after)) = &mut self.moments {
            before.forget();
            after.forget();
        }
    }

    /// Expected value and scale of the window.
    #[inline]
    pub(super) fn figures(&self) -> [f64; 2] {
        let moments = self.moments.as_ref().map(|(before, after)| before.get().merge(&after.get()));
        let median = self.sorted.as_ref().map_or(f64::NAN, SortedWindow::median);
        let p = match (self.center, &moments) {
            (Center::Mean, Some(m)) => m.mean,
            _ => median,
        };
        let scale = match (self.spread, &moments, &self.sorted) {
            (Spread::Rms, Some(m), _) => (m.squares_about(p) / (m.count - 1.0)).sqrt(),
            (_, _, Some(sorted)) => sorted.mad_scale(median),
            _ => f64::NAN,
        };
        [p, scale]
    }
}
