//! Two results of one channel, A and B: which samples only one of them flags.

use std::ops::Range;

/// Who flags a sample.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Side {
    /// A flags it and B does not.
    OnlyA,
    /// B flags it and A does not.
    OnlyB,
    /// Both do.
    Both,
}

/// The flagged samples of two results, parted by who flags them; positions ascend.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct Sides {
    only_a: Vec<u32>,
    only_b: Vec<u32>,
    both: Vec<u32>,
    /// Those of `only_a` and `only_b` together.
    differences: Vec<u32>,
}

/// How many of a sorted list lie in a range of positions.
fn within(list: &[u32], range: &Range<usize>) -> Range<usize> {
    let first = list.partition_point(|&p| (p as usize) < range.start);
    first..first + list[first..].partition_point(|&p| (p as usize) < range.end)
}

impl Sides {
    /// Parts the positions that A and B flag, both ascending.
    #[must_use]
    pub fn of(a: &[u32], b: &[u32]) -> Self {
        let mut sides = Self::default();
        let (mut i, mut j) = (0, 0);
        loop {
            match (a.get(i), b.get(j)) {
                (None, None) => return sides,
                (Some(&x), Some(&y)) if x == y => {
                    sides.both.push(x);
                    (i, j) = (i + 1, j + 1);
                }
                (Some(&x), y) if y.is_none_or(|&y| x < y) => {
                    sides.only_a.push(x);
                    sides.differences.push(x);
                    i += 1;
                }
                (_, y) => {
                    sides.only_b.extend(y);
                    sides.differences.extend(y);
                    j += 1;
                }
            }
        }
    }

    /// How many samples only A, only B and both flag.
    #[must_use]
    pub fn counts(&self) -> [usize; 3] {
        [&self.only_a, &self.only_b, &self.both].map(Vec::len)
    }

    /// The same counts for a range of positions.
    #[must_use]
    pub fn counts_in(&self, range: &Range<usize>) -> [usize; 3] {
        [&self.only_a, &self.only_b, &self.both].map(|list| within(list, range).len())
    }

    /// The samples of a range on which A and B differ, with the one that flags them.
    pub fn differences_in(&self, range: &Range<usize>) -> impl Iterator<Item = (usize, Side)> {
        let list = self.differences[within(&self.differences, range)].iter();
        list.filter_map(|&p| self.side(p as usize).map(|side| (p as usize, side)))
    }

    /// Who flags the sample at `position`; none when nobody does.
    #[must_use]
    pub fn side(&self, position: usize) -> Option<Side> {
        let position = u32::try_from(position).ok()?;
        let has = |list: &[u32]| list.binary_search(&position).is_ok();
        let all = [(&self.only_a, Side::OnlyA), (&self.only_b, Side::OnlyB), (&self.both, Side::Both)];
        all.into_iter().find(|(list, _)| has(list)).map(|(_, side)| side)
    }

    /// The sample after `position` (or before it) on which A and B differ, which of them all it is (from 0), and
    /// whether the search went over the end; none when they do not differ.
    #[must_use]
    pub fn next(&self, position: usize, forward: bool) -> Option<(usize, usize, bool)> {
        step(&self.differences, position, forward)
    }
}

/// The member of a sorted list after a position, or before it: the member, its index, and whether the search went over
/// the end.
#[must_use]
pub fn step(list: &[u32], position: usize, forward: bool) -> Option<(usize, usize, bool)> {
    let last = list.len().checked_sub(1)?;
    let index = if forward {
        list.partition_point(|&p| (p as usize) <= position)
    } else {
        list.partition_point(|&p| (p as usize) < position).wrapping_sub(1)
    };
    let wrapped = index > last;
    let index = if !wrapped {
        index
    } else if forward {
        0
    } else {
        last
    };
    Some((list[index] as usize, index, wrapped))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn flags_are_parted_and_the_differences_walked_round() {
        let sides = Sides::of(&[1, 4, 7, 9], &[0, 4, 9, 12, 13]);
        assert_eq!((sides.counts(), sides.counts_in(&(4..13))), ([2, 3, 2], [1, 1, 2]));
        let found: Vec<_> = sides.differences_in(&(1..13)).collect();
        assert_eq!(found, [(1, Side::OnlyA), (7, Side::OnlyA), (12, Side::OnlyB)]);
        assert_eq!((sides.side(4), sides.side(5)), (Some(Side::Both), None));
        assert_eq!((sides.next(1, true), sides.next(13, true)), (Some((7, 2, false)), Some((0, 0, true))));
        assert_eq!((sides.next(7, false), sides.next(0, false)), (Some((1, 1, false)), Some((13, 4, true))));
        assert_eq!(Sides::of(&[3], &[3]).next(0, true), None);
    }
}
