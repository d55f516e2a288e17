//! Putting very many values in order, in pieces between which somebody is asked whether to go on.

use std::cmp::Ordering;

use crate::math::pieces::Check;

/// Values that are put in order in one go: a fraction of a millisecond.
const FEW: usize = 8192;

/// Puts `values` in the order of `compare`, in which no two of them are equal.
///
/// # Errors
/// What `check` gives; the values are in no order then, and some may be gone.
pub fn sort_many<T: Copy + Send, E: Send>(
    values: &mut Vec<T>,
    compare: impl Fn(&T, &T) -> Ordering + Copy + Sync,
    check: &impl Check<E>,
) -> Result<(), E> {
    check()?;
    let n = values.len();
    if n <= 2 * FEW {
        values.sort_unstable_by(compare);
        return Ok(());
    }
    // Some of them, in order, part the rest into groups that are hardly longer than those.
    let groups = (n / FEW).min(256);
    let mut some: Vec<T> = (0..8 * groups).map(|i| values[i * (n / (8 * groups))]).collect();
    some.sort_unstable_by(compare);
    let bounds: Vec<T> = some.into_iter().skip(8).step_by(8).collect();
    let mut parted: Vec<Vec<T>> = (0..=bounds.len()).map(|_| Vec::with_capacity(n / groups * 5 / 4)).collect();
    for piece in values.chunks(FEW) {
        check()?;
        for value in piece {
            parted[bounds.partition_point(|bound| compare(bound, value).is_lt())].push(*value);
        }
    }
    values.clear();
    for mut group in parted {
        // A group that is nearly all there is would not end.
        if group.len() > n / 2 {
            group.sort_unstable_by(compare);
        } else {
            sort_many(&mut group, compare, check)?;
        }
        values.append(&mut group);
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::pieces::{certain, to_the_end};

    #[test]
    fn many_values_come_out_as_sorting_puts_them() {
        for n in [0, 1, 2 * FEW, 2 * FEW + 1, 500_000] {
            let spread = |i: usize| ((i * 7919) % 104_729) as f64;
            let few = |i: usize| (i % 3) as f64;
            // Where the sample looks, there is one value only.
            let misleading =
                |i: usize| if i.is_multiple_of(n / (8 * (n / FEW).clamp(1, 256)).max(1)) { -1.0 } else { spread(i) };
            for value in [&spread as &dyn Fn(usize) -> f64, &few, &misleading] {
                let mut values: Vec<(f64, usize)> = (0..n).map(|i| (value(i), i)).collect();
                let order = |a: &(f64, usize), b: &(f64, usize)| a.0.total_cmp(&b.0).then(b.1.cmp(&a.1));
                let mut sorted = values.clone();
                sorted.sort_by(order);
                certain(sort_many(&mut values, order, &to_the_end));
                assert_eq!(values, sorted, "{n}");
            }
        }
    }
}
