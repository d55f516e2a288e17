//! The flagged samples of a channel, arranged for drawing.

use std::ops::Range;

use super::pyramid::{BLOCK, Pyramid, Span};
use crate::math::pieces::{self, PIECE};
use crate::stop::{Stop, Stopped};

/// What is known about a flagged sample.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum FlagState {
    /// Flagged by the method, not decided on.
    Unreviewed,
    /// Accepted as an outlier.
    Accepted,
    /// Overruled: the sample is good.
    Rejected,
    /// Flagged by the analyst.
    ByHand,
    /// Suspected by the method; not an outlier, and counted apart.
    Suspect,
}

impl FlagState {
    /// All states, in the order in which they are counted.
    pub const ALL: [Self; 5] = [Self::Unreviewed, Self::Accepted, Self::Rejected, Self::ByHand, Self::Suspect];

    /// All states, the one that needs the analyst most first: it gives a shared cell or column its look.
    pub const BY_URGENCY: [Self; 5] = [Self::Unreviewed, Self::ByHand, Self::Accepted, Self::Suspect, Self::Rejected];

    /// Its place in [`FlagState::ALL`].
    #[must_use]
    pub fn index(self) -> usize {
        self as usize
    }
}

/// A flagged sample.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Flag {
    /// Position of the sample.
    pub position: u32,
    /// Its value.
    pub y: f64,
    /// What is known about it.
    pub state: FlagState,
}

/// Flags by state, with the extremes of each. Built when flags or decisions change (about 4 ms for 500 000), read in
/// every frame.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Flags {
    lists: [FlagList; 5],
}

/// The flags of one state, in order of position.
#[derive(Debug, Clone, PartialEq, Default)]
pub(crate) struct FlagList {
    pub(crate) positions: Vec<u32>,
    pub(crate) y: Vec<f64>,
    pub(crate) pyramid: Pyramid,
    /// Of each block of the pyramid, the highest value of its lower half and the lowest of its upper half. Wild
    /// points lie on both sides of a curve: this tells what lies between them.
    pub(crate) inner: Vec<(f64, f64)>,
}

impl Flags {
    /// Arranges `flags`; they should be in order of position, and are brought into it when they are not.
    #[must_use]
    pub fn new(flags: &[Flag]) -> Self {
        // Nobody stops it: they are always there.
        Self::new_unless(flags, &Stop::never()).unwrap_or_default()
    }

    /// [`Flags::new`] that may be abandoned.
    ///
    /// # Errors
    /// [`Stopped`] as soon as nobody waits for it any more.
    pub fn new_unless(flags: &[Flag], stop: &Stop) -> Result<Self, Stopped> {
        if !flags.is_sorted_by_key(|flag| flag.position) {
            let mut sorted = flags.to_vec();
            sorted.sort_by_key(|flag| flag.position);
            return Self::new_unless(&sorted, stop);
        }
        let mut lists: [FlagList; 5] = Default::default();
        for piece in flags.chunks(PIECE) {
            stop.check()?;
            for flag in piece {
                let list = &mut lists[flag.state.index()];
                list.positions.push(flag.position);
                list.y.push(flag.y);
            }
        }
        for list in &mut lists {
            list.pyramid = Pyramid::build_spans_unless(list.y.len(), |i| Span::at(list.y[i]), stop)?;
            let inner = |blocks: Range<usize>| {
                let y = &list.y[blocks.start * BLOCK..list.y.len().min(blocks.end * BLOCK)];
                y.chunks(BLOCK).map(inner).collect::<Vec<_>>()
            };
            list.inner = pieces::map(list.y.len().div_ceil(BLOCK), &|| stop.check(), inner)?.concat();
        }
        Ok(Self { lists })
    }

    /// How many flags there are of each state, in the order of [`FlagState::ALL`].
    #[must_use]
    pub fn counts(&self) -> [usize; 5] {
        FlagState::ALL.map(|state| self.list(state).positions.len())
    }

    /// How many flags lie in a range of positions.
    #[must_use]
    pub fn count_in(&self, range: &Range<usize>) -> usize {
        self.lists.iter().map(|list| list.within(range).len()).sum()
    }

    /// Lowest and highest flagged value in a range of positions.
    #[must_use]
    pub(crate) fn span_over(&self, range: &Range<usize>) -> Span {
        self.lists.iter().fold(Span::EMPTY, |all, list| {
            all.union(list.pyramid.span_over(|i| Span::at(list.y[i]), list.within(range)))
        })
    }

    /// Flagged values in a range of positions, state by state.
    pub(crate) fn values_in(&self, range: &Range<usize>) -> impl Iterator<Item = f64> {
        self.lists.iter().flat_map(|list| list.y[list.within(range)].iter().copied())
    }

    pub(crate) fn list(&self, state: FlagState) -> &FlagList {
        &self.lists[state.index()]
    }
}

/// The highest value at or below the middle of the range of `values`, and the lowest above it.
fn inner(values: &[f64]) -> (f64, f64) {
    let all = values.iter().fold(Span::EMPTY, |all, &y| all.union(Span::at(y)));
    let middle = all.low * 0.5 + all.high * 0.5;
    let lower = values.iter().fold(f64::NEG_INFINITY, |a, &y| if y <= middle && y > a { y } else { a });
    let upper = values.iter().fold(f64::INFINITY, |a, &y| if y > middle && y < a { y } else { a });
    // Rounding, a single value or an infinite one can leave a half empty: then nothing is known to be free.
    if middle.is_finite() && lower >= all.low && upper <= all.high { (lower, upper) } else { (all.high, all.low) }
}

impl FlagList {
    /// The part of the list whose positions lie in `range`.
    pub(crate) fn within(&self, range: &Range<usize>) -> Range<usize> {
        let first = self.positions.partition_point(|&p| (p as usize) < range.start);
        let end = first + self.positions[first..].partition_point(|&p| (p as usize) < range.end);
        first..end
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn flags_are_sorted_counted_and_spanned_by_state() {
        let flag = |position, y, state| Flag { position, y, state };
        let flags = Flags::new(&[
            flag(9, 4.0, FlagState::Suspect),
            flag(2, -1.0, FlagState::Accepted),
            flag(5, f64::NAN, FlagState::Accepted),
        ]);
        assert_eq!(flags.counts(), [0, 2, 0, 0, 1]);
        assert_eq!((flags.count_in(&(0..9)), flags.count_in(&(0..10)), flags.count_in(&(3..5))), (2, 3, 0));
        assert_eq!(flags.span_over(&(0..10)), Span { low: -1.0, high: 4.0 });
        assert!(flags.span_over(&(5..6)).is_empty());
    }

    #[test]
    fn the_inner_edges_of_a_block_part_its_two_sides() {
        assert_eq!(inner(&[-9.0, 3.0, -4.0, 8.0, f64::NAN]), (-4.0, 3.0));
        // One value, or none with a finite middle: the whole range counts as taken.
        assert_eq!(inner(&[5.0]), (5.0, 5.0));
        assert_eq!(inner(&[f64::NEG_INFINITY, f64::INFINITY, 1.0]), (f64::INFINITY, f64::NEG_INFINITY));
    }

    #[test]
    fn every_state_has_its_own_place_in_both_orders() {
        for (i, state) in FlagState::ALL.iter().enumerate() {
            assert_eq!(state.index(), i);
            assert_eq!(FlagState::BY_URGENCY.iter().filter(|s| *s == state).count(), 1);
        }
    }
}
