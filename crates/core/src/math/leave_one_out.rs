//! Sliding median of a window without the sample in its middle.

use std::ops::Range;

/// For each `i`, the median of the values of `window(i)` other than that of `i`; NaN when fewer than `least` are
/// left. NaN values do not take part. Both ends of the window must not decrease as `i` grows. `visit` is called with
/// each index and may stop the walk with an error.
///
/// # Errors
/// What `visit` returns.
pub fn medians<E>(
    values: &[f64],
    window: impl Fn(usize) -> Range<usize>,
    least: usize,
    mut visit: impl FnMut(usize) -> Result<(), E>,
) -> Result<Vec<f64>, E> {
    let mut sorted: Vec<f64> = Vec::new();
    let mut now = 0..0;
    let mut result = Vec::with_capacity(values.len());
    for (i, own) in values.iter().enumerate() {
        visit(i)?;
        let to = window(i);
        while now.end < to.end {
            insert(&mut sorted, values[now.end]);
            now.end += 1;
        }
        while now.start < to.start {
            remove(&mut sorted, values[now.start]);
            now.start += 1;
        }
        result.push(without(&sorted, *own, least));
    }
    Ok(result)
}

fn place(sorted: &[f64], value: f64) -> usize {
    sorted.partition_point(|x| x.total_cmp(&value).is_lt())
}

fn insert(sorted: &mut Vec<f64>, value: f64) {
    if !value.is_nan() {
        sorted.insert(place(sorted, value), value);
    }
}

fn remove(sorted: &mut Vec<f64>, value: f64) {
    if !value.is_nan() {
        sorted.remove(place(sorted, value));
    }
}

/// The median of `sorted` without one value equal to `own` (which is in it, or NaN).
fn without(sorted: &[f64], own: f64, least: usize) -> f64 {
    let (skip, n) = if own.is_nan() { (usize::MAX, sorted.len()) } else { (place(sorted, own), sorted.len() - 1) };
    if n < least.max(1) {
        return f64::NAN;
    }
    let nth = |i: usize| sorted[if i < skip { i } else { i + 1 }];
    if n.is_multiple_of(2) { f64::midpoint(nth(n / 2 - 1), nth(n / 2)) } else { nth(n / 2) }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::order;

    #[test]
    fn it_is_the_plain_median_of_the_others() {
        let values: Vec<f64> =
            (0..300).map(|i: i32| if i % 41 == 7 { f64::NAN } else { f64::from(i * 7919 % 23) }).collect();
        for half in [1, 2, 7] {
            let window = |i: usize| i.saturating_sub(half)..(i + half + 1).min(values.len());
            let got = medians(&values, window, 3, |_| Ok::<(), ()>(())).unwrap_or_default();
            for (i, got) in got.iter().enumerate() {
                let others: Vec<f64> =
                    window(i).filter(|&k| k != i && !values[k].is_nan()).map(|k| values[k]).collect();
                let want = if others.len() < 3 { f64::NAN } else { order::median(&others) };
                assert!(got.total_cmp(&want).is_eq(), "{i}, {half}: {got} {want}");
            }
        }
    }
}
