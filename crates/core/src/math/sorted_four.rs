//! Four sliding windows of one length side by side, each kept in order: what [`SortedWindow`](super::sorted_window)
//! does for one.
//!
//! Side by side the four share every comparison instruction, no value has to change its place in a register, and no
//! step waits for the one before it: a few instructions per value and step, without a branch. Values must be finite.

use super::order::{MAD_TO_SIGMA, mean_of_two};

/// How many windows stand side by side.
pub const FOUR: usize = 4;

/// Windows of up to this many values are worth working through whole at every step; in longer ones a search for the
/// places is faster.
pub const WIDEST: usize = 64;

/// The values of four windows, each in ascending order: entry `i` holds the i-th of each.
#[derive(Debug, Clone, Default)]
pub struct SortedFour {
    values: Vec<[f64; FOUR]>,
}

impl SortedFour {
    /// No values yet.
    #[must_use]
    pub fn new() -> Self {
        Self::default()
    }

    /// Slides over all windows of `width` (1 to [`WIDEST`]) in `x`, of which there must be [`FOUR`] or more: each of the
    /// four takes a quarter of them. `each` is told where the windows begin, and sees them; where their number is no
    /// multiple of four, some come twice.
    pub fn slide(&mut self, x: &[f64], width: usize, mut each: impl FnMut([usize; FOUR], &Self)) {
        let count = x.len() + 1 - width;
        let quarter = count.div_ceil(FOUR);
        let steps = quarter - 1;
        let mut at: [usize; FOUR] = std::array::from_fn(|lane| (lane * quarter).min(count - quarter));
        self.fill(at.map(|at| &x[at..at + width]));
        each(at, self);
        let leaving = at.map(|at| &x[at..at + steps]);
        let entering = at.map(|at| &x[at + width..at + width + steps]);
        for step in 0..steps {
            self.exchange(leaving.map(|lane| lane[step]), entering.map(|lane| lane[step]));
            at = at.map(|at| at + 1);
            each(at, self);
        }
    }

    /// Makes the windows hold these values, as many in each.
    fn fill(&mut self, windows: [&[f64]; FOUR]) {
        self.values.clear();
        self.values.resize(windows[0].len(), [0.0; FOUR]);
        for (lane, window) in windows.into_iter().enumerate() {
            // A negative zero becomes a positive one, as in the single window.
            let mut sorted: Vec<f64> = window.iter().map(|v| v + 0.0).collect();
            sorted.sort_unstable_by(f64::total_cmp);
            self.values.iter_mut().zip(sorted).for_each(|(values, v)| values[lane] = v);
        }
    }

    /// Puts `new` in the place of one value equal to `old` in each window. Without that one the values of a window are
    /// w; then the one at place i is `new` where `w[i - 1] <= new <= w[i]`, and the nearer of the two where it is not.
    #[inline]
    fn exchange(&mut self, old: [f64; FOUR], new: [f64; FOUR]) {
        let new = new.map(|v| v + 0.0);
        let mut before = [f64::NEG_INFINITY; FOUR];
        let count = self.values.len();
        let Some(&first) = self.values.first() else { return };
        let mut here = first;
        for i in 0..count {
            let next = if i + 1 < count { self.values[i + 1] } else { [f64::INFINITY; FOUR] };
            let mut place = [0.0; FOUR];
            for lane in 0..FOUR {
                let w = if here[lane] < old[lane] { here[lane] } else { next[lane] };
                let capped = if new[lane] < w { new[lane] } else { w };
                place[lane] = if before[lane] > capped { before[lane] } else { capped };
                before[lane] = w;
            }
            self.values[i] = place;
            here = next;
        }
    }

    /// The median of each window; the mean of the two middle values of an even count.
    #[must_use]
    #[inline]
    pub fn median(&self) -> [f64; FOUR] {
        let (v, middle) = (&self.values, self.values.len() / 2);
        if v.len().is_multiple_of(2) {
            std::array::from_fn(|lane| mean_of_two(v[middle - 1][lane], v[middle][lane]))
        } else {
            v[middle]
        }
    }

    /// `1.4826 * median |x - center|` of each window about its centre.
    #[must_use]
    #[inline]
    pub fn mad_scale(&self, center: [f64; FOUR]) -> [f64; FOUR] {
        let k = self.values.len() / 2;
        let upper = self.nearest(k, center);
        let middle = if self.values.len().is_multiple_of(2) {
            let lower = self.nearest(k - 1, center);
            std::array::from_fn(|lane| mean_of_two(lower[lane], upper[lane]))
        } else {
            upper
        };
        middle.map(|d| MAD_TO_SIGMA * d)
    }

    /// The (k + 1)-th smallest deviation from the centre: the least that a run of k + 1 neighbours can keep within.
    #[inline]
    fn nearest(&self, k: usize, center: [f64; FOUR]) -> [f64; FOUR] {
        let mut least = [f64::INFINITY; FOUR];
        for (low, high) in self.values.iter().zip(&self.values[k..]) {
            for lane in 0..FOUR {
                let (below, above) = (center[lane] - low[lane], high[lane] - center[lane]);
                let reach = if below > above { below } else { above };
                least[lane] = if reach < least[lane] { reach } else { least[lane] };
            }
        }
        least
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;
    use crate::math::sorted_window::SortedWindow;

    proptest! {
        #[test]
        fn four_windows_are_what_each_is_by_itself(
            x in prop::collection::vec(
                prop_oneof![-9.0..9.0, (-3i32..3).prop_map(f64::from), Just(0.0), Just(-0.0)], 40..240,
            ),
            width in 1usize..37,
        ) {
            let mut seen = vec![false; x.len() + 1 - width];
            SortedFour::new().slide(&x, width, |at, four| {
                let (median, scale) = (four.median(), four.mad_scale(four.median()));
                for lane in 0..FOUR {
                    let mut single = SortedWindow::new();
                    single.fill(&x[at[lane]..at[lane] + width]);
                    let alone = single.median();
                    assert_eq!(median[lane].to_bits(), alone.to_bits(), "window at {}", at[lane]);
                    assert_eq!(scale[lane].to_bits(), single.mad_scale(alone).to_bits());
                    seen[at[lane]] = true;
                }
            });
            prop_assert!(seen.iter().all(|seen| *seen), "every window has its turn");
        }
    }
}
