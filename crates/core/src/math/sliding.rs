//! Sums over a sliding window without a running difference: nothing is ever subtracted again, so nothing drifts, and a
//! value of 1e12 that has left the window has left no trace.

use std::ops::Range;

/// Sums over some items that can be joined with the sums over others. The default is over none.
pub trait Summary: Copy + Default {
    /// What is summed over.
    type Item: Copy;

    /// Takes in one more item.
    fn add(&mut self, item: Self::Item);

    /// The sums over the items of both.
    #[must_use]
    fn joined(&self, other: &Self) -> Self;
}

/// The sums over a window that slides over a slice, in constant time per step (two stacks: the older part as sums
/// from its end backwards, the newer part as one running sum).
#[derive(Debug, Clone, Default)]
pub struct Sliding<S> {
    range: Range<usize>,
    /// Sums over `x[i..middle]` for ever smaller i: the last entry is the one that counts.
    older: Vec<S>,
    newer: S,
}

impl<S: Summary> Sliding<S> {
    /// Makes it the window over `x[to]`. Items that were in the window at the last call must not have changed since,
    /// from the start of `to` on.
    #[inline]
    pub fn move_to(&mut self, x: &[S::Item], to: Range<usize>) {
        let from = self.range.clone();
        let onward = to.start >= from.start && to.start < from.end && to.end >= from.end;
        let gone = to.start.wrapping_sub(from.start);
        if onward && (gone == 0 || gone < self.older.len()) {
            x[from.end..to.end].iter().for_each(|&v| self.newer.add(v));
            self.older.truncate(self.older.len() - gone);
        } else {
            self.older.clear();
            self.newer = S::default();
            let mut sum = S::default();
            self.older.extend(x[to.clone()].iter().rev().map(|&v| {
                sum.add(v);
                sum
            }));
        }
        self.range = to;
    }

    /// Forgets the window: the next [`Sliding::move_to`] reads all of it again.
    pub fn forget(&mut self) {
        self.range = 0..0;
        self.older.clear();
        self.newer = S::default();
    }

    /// The sums over the window.
    #[must_use]
    #[inline]
    pub fn get(&self) -> S {
        self.older.last().map_or(self.newer, |older| older.joined(&self.newer))
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    /// The items themselves: nothing may be lost, doubled or out of order.
    #[derive(Debug, Clone, Copy, Default)]
    struct Count(u64);

    impl Summary for Count {
        type Item = u32;

        fn add(&mut self, item: u32) {
            self.0 += 1 << item;
        }

        fn joined(&self, other: &Self) -> Self {
            Self(self.0 + other.0)
        }
    }

    proptest! {
        #[test]
        fn it_holds_the_items_of_the_window(moves in prop::collection::vec((0usize..4, 0usize..6), 1..40)) {
            let x: Vec<u32> = (0..60).collect();
            let mut window = Sliding::<Count>::default();
            let (mut start, mut end) = (0, 0);
            for (drop, gain) in moves {
                end = (end + gain).min(60);
                start = (start + drop).min(end);
                window.move_to(&x, start..end);
                prop_assert_eq!(window.get().0, (start..end).map(|i| 1u64 << i).sum::<u64>());
            }
        }
    }
}
