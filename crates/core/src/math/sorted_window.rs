//! A sliding window kept in order: its median, and the median absolute deviation about any centre, in O(log window).

use std::ops::Range;

use super::order::{MAD_TO_SIGMA, mean_of_two};

/// Windows of up to this many values are worked through whole, without a branch: faster than a search in them.
const SHORT: usize = 48;

/// The values of a window over a slice, in ascending order.
///
/// A step of the window moves the values between the old and the new one by one place: a short `memmove` up to
/// windows of a thousand, where it beats every tree. Values must be finite.
#[derive(Debug, Clone, Default)]
pub struct SortedWindow {
    values: Vec<f64>,
    range: Range<usize>,
    /// Where the next state of a short window is written.
    spare: Vec<f64>,
}

impl SortedWindow {
    /// An empty window.
    #[must_use]
    pub fn new() -> Self {
        Self::default()
    }

    /// How many values it holds.
    #[must_use]
    pub fn len(&self) -> usize {
        self.values.len()
    }

    /// True when it holds none.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.values.is_empty()
    }

    /// Makes it the window over `x[to]`. `x` must be the slice of the last call, up to [`SortedWindow::exchange`].
    #[inline]
    pub fn move_to(&mut self, x: &[f64], to: Range<usize>) {
        let from = self.range.clone();
        self.range = to.clone();
        if to.start == from.start + 1 && to.end == from.end + 1 && from.start < from.end {
            self.exchange(x[from.start], x[from.end]);
            return;
        }
        let onward = to.start >= from.start && to.start < from.end && to.end >= from.end;
        if !onward || to.start - from.start + (to.end - from.end) > 4 {
            self.fill(&x[to]);
            return;
        }
        x[from.end..to.end].iter().for_each(|&v| self.insert(v));
        x[from.start..to.start].iter().for_each(|&v| self.remove(v));
    }

    /// Makes it hold these values, whatever it held.
    pub fn fill(&mut self, values: &[f64]) {
        self.values.clear();
        // A negative zero becomes a positive one, so that the bits of a median do not depend on the way here.
        self.values.extend(values.iter().map(|v| v + 0.0));
        self.values.sort_unstable_by(f64::total_cmp);
    }

    /// Forgets the window: the next [`SortedWindow::move_to`] reads all of it again.
    pub fn forget(&mut self) {
        self.range = 0..0;
        self.values.clear();
    }

    /// Puts `new` in the place of one value equal to `old`, which it must hold.
    #[inline]
    pub fn exchange(&mut self, old: f64, new: f64) {
        let v = &mut self.values;
        // Held values and differences that are mostly zero need no work.
        if old == new {
            return;
        }
        if v.len() <= SHORT {
            self.spare.resize(v.len(), 0.0);
            exchange_short(v, &mut self.spare, old, new + 0.0);
            std::mem::swap(v, &mut self.spare);
            return;
        }
        // Sums of the largest doubles overflow to values that are not found again: they cost a place, not the program.
        let from = v.partition_point(|&x| x < old).min(v.len() - 1);
        let to = v.partition_point(|&x| x < new);
        if to > from {
            v.copy_within(from + 1..to, from);
            v[to - 1] = new + 0.0;
        } else {
            v.copy_within(to..from, to + 1);
            v[to] = new + 0.0;
        }
    }

    /// Adds a value.
    pub fn insert(&mut self, value: f64) {
        let at = self.values.partition_point(|&x| x < value);
        self.values.insert(at, value + 0.0);
    }

    /// Takes out one value equal to `value`, which it must hold.
    pub fn remove(&mut self, value: f64) {
        let at = self.values.partition_point(|&x| x < value);
        if at < self.values.len() {
            self.values.remove(at);
        }
    }

    /// The median; the mean of the two middle values of an even count; NaN when empty.
    #[must_use]
    #[inline]
    pub fn median(&self) -> f64 {
        let (v, middle) = (&self.values, self.values.len() / 2);
        match v.len() {
            0 => f64::NAN,
            n if n.is_multiple_of(2) => mean_of_two(v[middle - 1], v[middle]),
            _ => v[middle],
        }
    }

    /// `median |x - center|` (even count: the mean of the two middle ones); NaN when empty.
    #[must_use]
    #[inline]
    pub fn median_deviation(&self, center: f64) -> f64 {
        let v = self.values.as_slice();
        if v.is_empty() {
            return f64::NAN;
        }
        // The k + 1 values nearest to the centre stand side by side: find where they begin. They lie one further
        // on as long as the value to be dropped is farther away than the one to be gained.
        let k = v.len() / 2;
        if v.len() <= SHORT {
            let upper = nearest_short(v, k, center);
            return if v.len().is_multiple_of(2) { mean_of_two(nearest_short(v, k - 1, center), upper) } else { upper };
        }
        let (mut begin, mut size) = (0, v.len() - k - 1);
        while size > 0 {
            let half = size / 2;
            let at = begin + half;
            let farther = center - v[at] > v[at + k + 1] - center;
            begin = if farther { at + 1 } else { begin };
            size = if farther { size - half - 1 } else { half };
        }
        let (left, right) = (center - v[begin], v[begin + k] - center);
        if !v.len().is_multiple_of(2) {
            return left.max(right);
        }
        let inner = if left > right { (center - v[begin + 1]).max(right) } else { left.max(v[begin + k - 1] - center) };
        mean_of_two(inner, left.max(right))
    }

    /// `1.4826 * median |x - center|`.
    #[must_use]
    #[inline]
    pub fn mad_scale(&self, center: f64) -> f64 {
        MAD_TO_SIGMA * self.median_deviation(center)
    }
}

/// Ascending `values` with `new` in the place of one equal to `old`. Without that one the values are w; then the one at
/// place i is `new` where `w[i - 1] <= new <= w[i]`, and the nearer of the two where it is not.
#[inline]
fn exchange_short(values: &[f64], to: &mut [f64], old: f64, new: f64) {
    let Some((&last, _)) = values.split_last() else { return };
    let (mut before, inner) = (f64::NEG_INFINITY, values.len() - 1);
    let place = |before: f64, w: f64| {
        let capped = if new < w { new } else { w };
        if before > capped { before } else { capped }
    };
    let to = &mut to[..=inner];
    for ((to, &here), &next) in to.iter_mut().zip(&values[..inner]).zip(&values[1..]) {
        let w = if here < old { here } else { next };
        *to = place(before, w);
        before = w;
    }
    to[inner] = place(before, if last < old { last } else { f64::INFINITY });
}

/// The (k + 1)-th smallest deviation from `center`: the least that a run of k + 1 neighbours can keep within.
#[inline]
fn nearest_short(v: &[f64], k: usize, center: f64) -> f64 {
    let mut least = f64::INFINITY;
    for (low, high) in v.iter().zip(&v[k..]) {
        let (below, above) = (center - low, high - center);
        let reach = if below > above { below } else { above };
        least = if reach < least { reach } else { least };
    }
    least
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;
    use crate::math::order::{mad_scale_in_place, median};

    fn agrees(window: &SortedWindow, x: &[f64]) {
        let m = median(x);
        assert_eq!(window.median().to_bits(), (m + 0.0).to_bits());
        for center in [m, x.iter().sum::<f64>() / x.len() as f64, -3.25, 100.0] {
            let plain = mad_scale_in_place(&mut x.to_vec(), center);
            assert_eq!(window.mad_scale(center), plain, "{x:?} about {center}");
        }
    }

    proptest! {
        #[test]
        fn it_equals_its_plain_twin(
            x in prop::collection::vec(prop_oneof![-9.0..9.0, (-3i32..3).prop_map(f64::from), Just(0.0), Just(-0.0)], 1..160),
            width in 1usize..80,
            step in 1usize..4,
        ) {
            let mut window = SortedWindow::new();
            for c in (0..x.len()).step_by(step) {
                let range = c.saturating_sub(width / 2)..(c + width - width / 2).min(x.len());
                window.move_to(&x, range.clone());
                agrees(&window, &x[range]);
            }
        }

        #[test]
        fn an_exchanged_value_is_as_if_it_had_been_there(
            mut x in prop::collection::vec(-9.0..9.0, 20..60), at in 0usize..20, new in -20.0..20.0,
        ) {
            let mut window = SortedWindow::new();
            window.move_to(&x, 0..20);
            window.exchange(x[at], new);
            x[at] = new;
            agrees(&window, &x[..20]);
            for start in 1..=x.len() - 20 {
                window.move_to(&x, start..start + 20);
                agrees(&window, &x[start..start + 20]);
            }
        }
    }

    #[test]
    fn an_empty_window_has_no_median() {
        assert!(SortedWindow::new().median().is_nan() && SortedWindow::new().mad_scale(0.0).is_nan());
    }
}
