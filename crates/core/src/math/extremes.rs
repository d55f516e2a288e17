//! The most deviant of many values, one after the other, without sorting those in the middle.

use super::order::sort_many;
use super::pieces::{self, Check};

/// Values taken from both ends inwards: at each turn the one farthest from a centre that may have moved.
#[derive(Debug)]
pub struct Extremes<'a> {
    values: &'a [f64],
    /// Values up to `low` and from `high` on have been handed to the ends below; those between wait.
    low: f64,
    high: f64,
    /// Ascending from the inside to the outside: the last is the outermost and, among equals, the earliest.
    lower: Vec<(f64, usize)>,
    upper: Vec<(f64, usize)>,
}

impl<'a> Extremes<'a> {
    /// All of these values; none may be NaN.
    #[must_use]
    pub fn new(values: &'a [f64]) -> Self {
        Self { values, low: f64::NEG_INFINITY, high: f64::INFINITY, lower: Vec::new(), upper: Vec::new() }
    }

    /// Takes out the value that is farthest from `center` (among equally far ones the earliest) and says at which
    /// index it stands; none when all have been taken. `scale` is asked
    /// now and then for a hint at how widely those left are spread.
    ///
    /// # Errors
    /// What `check` gives, which is asked before each piece of longer work.
    pub fn next<E: Send>(
        &mut self,
        center: f64,
        scale: impl Fn() -> f64,
        check: &impl Check<E>,
    ) -> Result<Option<usize>, E> {
        while (self.lower.is_empty() || self.upper.is_empty()) && self.low < self.high {
            self.reach_inwards(center, scale(), check)?;
        }
        if self.lower.is_empty() != self.upper.is_empty() {
            self.share(check)?;
        }
        let (lower, upper) = (self.lower.last(), self.upper.last());
        let take_lower = match (lower, upper) {
            (None, None) => return Ok(None),
            (Some(_), None) => true,
            (None, Some(_)) => false,
            (Some(&(a, i)), Some(&(b, j))) => {
                let (below, above) = (center - a, b - center);
                below > above || (below >= above && i < j)
            }
        };
        Ok(if take_lower { self.lower.pop() } else { self.upper.pop() }.map(|(_, i)| i))
    }

    /// When all that are left stand at one end, gives the half that lies at the other side to the other end: the
    /// centre may have moved past them all.
    fn share<E: Send>(&mut self, check: &impl Check<E>) -> Result<(), E> {
        let all = if self.upper.is_empty() { &self.lower } else { &self.upper };
        // All are equal, as those of a constant: there is nothing to share, however often it is asked.
        if all.first().map(|v| v.0) == all.last().map(|v| v.0) {
            return Ok(());
        }
        let (mut lower, mut upper) = (std::mem::take(&mut self.lower), std::mem::take(&mut self.upper));
        let (from, to) = if upper.is_empty() { (&mut lower, &mut upper) } else { (&mut upper, &mut lower) };
        // Equal values stay together, so that the earliest of them comes first whichever end they are at.
        let half = from[from.len() / 2].0;
        let before = from.iter().take_while(|v| v.0 != half).count();
        let inner = if before > 0 { before } else { from.iter().take_while(|v| v.0 == half).count() };
        if inner < from.len() {
            to.extend(from.drain(..inner));
        }
        sort(&mut lower, &mut upper, check)?;
        (self.lower, self.upper) = (lower, upper);
        Ok(())
    }

    /// Hands the outermost of the waiting values to the ends, and in the end all of them.
    fn reach_inwards<E: Send>(&mut self, center: f64, scale: f64, check: &impl Check<E>) -> Result<(), E> {
        let width = self.high - self.low;
        let (mut low, mut high) = (center - 2.5 * scale, center + 2.5 * scale);
        // In small steps, so that no single sort takes long.
        if width.is_finite() && high - low > 0.8 * width {
            (low, high) = (self.low + 0.15 * width, self.high - 0.15 * width);
        }
        // Much narrower than what has been taken already, or no width at all: what waits is handed over whole.
        let inside = low > self.low && high < self.high && low < high && width > 1e-3 * scale;
        if !inside {
            let middle = center.clamp(self.low, self.high);
            (low, high) = (middle, middle);
        }
        let waits = |v: f64| v > self.low && v < self.high;
        let ends = pieces::map(self.values.len(), check, |piece| {
            let (mut lower, mut upper) = (Vec::new(), Vec::new());
            for (i, &v) in piece.clone().zip(&self.values[piece]) {
                if v <= low && waits(v) {
                    lower.push((v, i));
                } else if v >= high && waits(v) {
                    upper.push((v, i));
                }
            }
            (lower, upper)
        })?;
        let (mut lower, mut upper) = (Vec::new(), Vec::new());
        for (low, high) in ends {
            lower.extend(low);
            upper.extend(high);
        }
        sort(&mut lower, &mut upper, check)?;
        // The new ones lie further in than those still there.
        lower.append(&mut self.lower);
        upper.append(&mut self.upper);
        (self.lower, self.upper) = (lower, upper);
        (self.low, self.high) = if inside { (low, high) } else { (f64::INFINITY, f64::NEG_INFINITY) };
        Ok(())
    }
}

/// Puts the outermost last and, among equals, the earliest.
fn sort<E: Send>(lower: &mut Vec<(f64, usize)>, upper: &mut Vec<(f64, usize)>, check: &impl Check<E>) -> Result<(), E> {
    let (lower, upper) = rayon::join(
        || sort_many(lower, |a, b| b.0.total_cmp(&a.0).then(b.1.cmp(&a.1)), check),
        || sort_many(upper, |a, b| a.0.total_cmp(&b.0).then(b.1.cmp(&a.1)), check),
    );
    lower.and(upper)
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::super::pieces::{certain, to_the_end};
    use super::*;

    fn next(extremes: &mut Extremes<'_>, center: f64, scale: f64) -> Option<usize> {
        certain(extremes.next(center, || scale, &to_the_end))
    }

    proptest! {
        #[test]
        fn it_equals_its_plain_twin(
            values in prop::collection::vec(prop_oneof![-1.0..1.0, -9.0..9.0, -3.0..1e6, (-4i32..4).prop_map(f64::from)], 1..200),
        ) {
            let mut left: Vec<usize> = (0..values.len()).collect();
            let mut extremes = Extremes::new(&values);
            while !left.is_empty() {
                let mean = left.iter().map(|&i| values[i]).sum::<f64>() / left.len() as f64;
                let scale = left.iter().map(|&i| (values[i] - mean).abs()).sum::<f64>() / left.len() as f64;
                let mut far = 0;
                for at in 1..left.len() {
                    if (values[left[at]] - mean).abs() > (values[left[far]] - mean).abs() {
                        far = at;
                    }
                }
                prop_assert_eq!(next(&mut extremes, mean, scale), Some(left.remove(far)));
            }
            prop_assert_eq!(next(&mut extremes, 0.0, 1.0), None);
        }
    }

    #[test]
    fn many_equal_values_are_not_gone_through_for_each() {
        use std::sync::atomic::{AtomicUsize, Ordering};
        let looks = AtomicUsize::new(0);
        let check = || {
            looks.fetch_add(1, Ordering::Relaxed);
            Ok(())
        };
        let n = 200_000;
        for values in [vec![7.5; n], (0..n).map(|i| f64::from(u8::from(i % 3 == 0))).collect()] {
            looks.store(0, Ordering::Relaxed);
            let mut extremes = Extremes::new(&values);
            for _ in 0..n / 2 {
                assert!(certain(extremes.next(0.5, || 0.5, &check)).is_some());
            }
            // A look for each piece of a pass: this many passes go through the values.
            let passes = looks.load(Ordering::Relaxed) * pieces::PIECE / n;
            assert!(passes < 40, "{passes} passes");
        }
    }

    #[test]
    fn equal_values_come_in_their_order() {
        let values = [2.0, -2.0, 2.0, 0.0, -2.0, 0.0];
        let mut extremes = Extremes::new(&values);
        let order: Vec<usize> = std::iter::from_fn(|| next(&mut extremes, 0.0, 1.0)).collect();
        assert_eq!(order, [0, 1, 2, 4, 3, 5]);
    }
}
