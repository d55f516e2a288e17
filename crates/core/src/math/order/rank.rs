//! Values of given ranks among very many, found without putting them in order and without a copy of them.

use crate::math::pieces::{self, Check};

/// Values of which two are known between which the wanted ones lie, almost surely.
const SAMPLE: usize = 4096;

/// Up to this many values are copied and put in order as far as needed.
const FEW: usize = 8 * SAMPLE;

/// The values of two ranks (from 0, ascending, one apart at most) among `value(0 .. n)`, none of which may be NaN: in
/// parallel, the same on any number of threads. A negative zero counts as zero.
pub(super) fn of_many<E: Send>(
    n: usize,
    ranks: [usize; 2],
    value: impl Fn(usize) -> f64 + Sync,
    check: &impl Check<E>,
) -> Result<[f64; 2], E> {
    let value = |i: usize| value(i) + 0.0;
    check()?;
    if n <= FEW {
        return Ok(of_few(&mut (0..n).map(value).collect::<Vec<f64>>(), ranks));
    }
    let mut sample: Vec<f64> = sampled(n).map(value).collect();
    sample.sort_unstable_by(f64::total_cmp);
    let likely = ranks[1] / (n / SAMPLE);
    let near = |at: usize| sample[at.min(SAMPLE - 1)];
    let (low, high) = (near(likely.saturating_sub(SAMPLE / 25)), near(likely + SAMPLE / 25));
    let parts = Parts::of(n, [low, high], &value, check)?;
    match ranks.map(|rank| parts.place(rank)) {
        [Some(lower), Some(upper)] if parts.between.len() <= n / 2 => parts.values([lower, upper], check),
        // The sample misled, as it may where the values repeat themselves in its own step.
        _ => Ok([by_digits(n, ranks[0], &value, check)?, by_digits(n, ranks[1], &value, check)?]),
    }
}

/// Indices of [`SAMPLE`] of `n` values: one from each of as many stretches, each time at another place of it. What
/// repeats itself, such as the rounding of even steps of time, has a period that even distances could meet.
fn sampled(n: usize) -> impl Iterator<Item = usize> {
    let stretch = n / SAMPLE;
    // Multiples of the golden ratio modulo 1 are spread evenly and repeat nothing.
    let fraction = |i: usize| (i as u64).wrapping_mul(0x9e37_79b9_7f4a_7c15) >> 32;
    (0..SAMPLE).map(move |i| i * stretch + ((fraction(i) * stretch as u64) >> 32) as usize)
}

/// [`of_many`] of values that are there.
pub(super) fn of_slice<E: Send>(values: &[f64], ranks: [usize; 2], check: &impl Check<E>) -> Result<[f64; 2], E> {
    of_many(values.len(), ranks, |i| values[i], check)
}

/// The values of two ranks among few; reorders them.
fn of_few(values: &mut [f64], [lower, upper]: [usize; 2]) -> [f64; 2] {
    let (below, &mut found, _) = values.select_nth_unstable_by(upper, f64::total_cmp);
    let before = || below.iter().copied().max_by(f64::total_cmp).unwrap_or(found);
    [if lower == upper { found } else { before() }, found]
}

/// Where a rank lies.
enum Place {
    Low,
    Between(usize),
    High,
}

/// Values counted around two of them, and those between. Many records have few different values, so those equal to
/// either are counted and not kept.
struct Parts {
    low: f64,
    high: f64,
    below: usize,
    at_low: usize,
    between: Vec<f64>,
    at_high: usize,
}

impl Parts {
    fn of<E: Send>(
        n: usize,
        [low, high]: [f64; 2],
        value: &(impl Fn(usize) -> f64 + Sync),
        check: &impl Check<E>,
    ) -> Result<Self, E> {
        let counted = pieces::map(n, check, |piece| {
            let (mut below, mut up_to_low, mut above) = (0, 0, 0);
            // Every value is written down, and the next over it where it does not count: no branch to guess.
            let (mut kept, mut between) = (0, vec![0.0; piece.len()]);
            let len = piece.len();
            for v in piece.map(value) {
                below += usize::from(v < low);
                up_to_low += usize::from(v <= low);
                above += usize::from(v > high);
                between[kept] = v;
                kept += usize::from(v > low && v < high);
            }
            between.truncate(kept);
            // Most of the room is not needed, and there are as many of these as pieces.
            between.shrink_to_fit();
            // Where both are one value, it is counted once.
            let at_high = if low < high { len - up_to_low - kept - above } else { 0 };
            (below, up_to_low - below, between, at_high)
        })?;
        let mut parts = Self { low, high, below: 0, at_low: 0, between: Vec::new(), at_high: 0 };
        for (below, at_low, between, at_high) in counted {
            parts.below += below;
            parts.at_low += at_low;
            parts.between.extend(between);
            parts.at_high += at_high;
        }
        Ok(parts)
    }

    /// Where the value of a rank is; none when it is beyond the two.
    fn place(&self, rank: usize) -> Option<Place> {
        let rank = rank.checked_sub(self.below)?;
        let Some(rank) = rank.checked_sub(self.at_low) else { return Some(Place::Low) };
        let Some(rank) = rank.checked_sub(self.between.len()) else { return Some(Place::Between(rank)) };
        (rank < self.at_high).then_some(Place::High)
    }

    fn values<E: Send>(&self, places: [Place; 2], check: &impl Check<E>) -> Result<[f64; 2], E> {
        let within = places.each_ref().map(|place| if let Place::Between(rank) = *place { Some(rank) } else { None });
        let found = match within {
            [Some(lower), Some(upper)] => of_slice(&self.between, [lower, upper], check)?,
            [Some(one), None] | [None, Some(one)] => of_slice(&self.between, [one, one], check)?,
            [None, None] => [f64::NAN; 2],
        };
        let value = |(place, found): (&Place, f64)| match place {
            Place::Low => self.low,
            Place::Between(_) => found,
            Place::High => self.high,
        };
        Ok([value((&places[0], found[0])), value((&places[1], found[1]))])
    }
}

/// A number that grows with the value, in the order of [`f64::total_cmp`].
#[inline]
fn digits(value: f64) -> u64 {
    let bits = value.to_bits();
    if bits >> 63 == 0 { bits | 1 << 63 } else { !bits }
}

/// The value of a rank, found digit by digit: slower than [`of_many`] and never misled.
fn by_digits<E: Send>(
    n: usize,
    mut rank: usize,
    value: &impl Fn(usize) -> f64,
    check: &impl Check<E>,
) -> Result<f64, E> {
    const BITS: u32 = 16;
    let mut found = 0_u64;
    for shift in (0..u64::BITS).step_by(BITS as usize).map(|from_low| u64::BITS - BITS - from_low) {
        // How often each next digit follows those that are known.
        let mut counts = vec![0_usize; 1 << BITS];
        let known = |at: u64| at.checked_shr(shift + BITS).unwrap_or(0);
        for first in (0..n).step_by(pieces::PIECE) {
            check()?;
            for at in (first..n.min(first + pieces::PIECE)).map(|i| digits(value(i))) {
                if known(at) == known(found) {
                    counts[(at >> shift) as usize & ((1 << BITS) - 1)] += 1;
                }
            }
        }
        let mut next = 0;
        while rank >= counts[next] {
            rank -= counts[next];
            next += 1;
        }
        found |= (next as u64) << shift;
    }
    Ok(f64::from_bits(if found >> 63 == 1 { found & !(1 << 63) } else { !found }))
}

#[cfg(test)]
mod tests {
    use std::collections::HashSet;

    use super::super::super::pieces::{certain, to_the_end};
    use super::*;

    #[test]
    fn ranks_are_those_of_the_sorted_values_whichever_way_they_are_found() {
        for n in [1usize, 2, FEW, FEW + 1, 100_003] {
            let spread = |i: usize| ((i * 7919) % 104_729) as f64 - 50_000.0;
            let ties = |i: usize| ((i * 7919) % 7) as f64 - 3.0;
            let one = |_: usize| -1.5;
            let tiny = |i: usize| if i.is_multiple_of(3) { 0.0 } else { f64::from_bits((i % 5) as u64) };
            // The sample sees one value only, and the wrong one.
            let seen: HashSet<usize> = if n < SAMPLE { HashSet::new() } else { sampled(n).collect() };
            let misleading = |i: usize| if seen.contains(&i) { 1e9 } else { spread(i) };
            for value in [&spread as &(dyn Fn(usize) -> f64 + Sync), &ties, &one, &tiny, &misleading] {
                let mut sorted: Vec<f64> = (0..n).map(value).collect();
                sorted.sort_by(f64::total_cmp);
                for upper in [0, n / 3, n / 2, n - 1] {
                    let ranks = [upper.saturating_sub(1), upper];
                    let want = ranks.map(|r| sorted[r].to_bits());
                    assert_eq!(certain(of_many(n, ranks, value, &to_the_end)).map(f64::to_bits), want, "{n} {upper}");
                    let by_digits = ranks.map(|r| certain(by_digits(n, r, &value, &to_the_end)).to_bits());
                    assert_eq!(by_digits, want, "{n} {upper}");
                }
            }
        }
    }

    #[test]
    fn the_rounding_of_even_steps_does_not_mislead_the_sample() {
        for n in [100_003, 1_000_000] {
            let mut order: Vec<usize> = sampled(n).collect();
            order.dedup();
            assert_eq!((order.len(), order.is_sorted(), order[SAMPLE - 1] < n), (SAMPLE, true, true));
            let step = |i: usize| (i + 1) as f64 * 0.1 - i as f64 * 0.1;
            let mut sample: Vec<f64> = sampled(n).map(step).collect();
            sample.sort_by(f64::total_cmp);
            let mut all: Vec<f64> = (0..n).map(step).collect();
            all.sort_by(f64::total_cmp);
            let below = |v: f64| all.partition_point(|a| *a < v);
            let up_to = |v: f64| all.partition_point(|a| *a <= v);
            let (low, high) = (sample[SAMPLE / 2 - SAMPLE / 25], sample[SAMPLE / 2 + SAMPLE / 25]);
            assert!(below(low) <= n / 2 && n / 2 < up_to(high), "{low} {high} {}", all[n / 2]);
        }
    }
}
