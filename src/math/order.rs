//! Order statistics: medians and the median absolute deviation. An even count takes the mean of the two middle
//! values; an empty slice gives NaN. Values must not be NaN.

/// Makes the median absolute deviation of normal noise its standard deviation: 1 / `PhiInv(3/4)`, to the five
/// digits in which the literature uses it.
pub const MAD_TO_SIGMA: f64 = 1.4826;

/// The median; reorders the values.
#[must_use]
pub fn median_in_place(values: &mut [f64]) -> f64 {
    if values.is_empty() {
        return f64::NAN;
    }
    let middle = values.len() / 2;
    let odd = !values.len().is_multiple_of(2);
    let (below, &mut upper, _) = values.select_nth_unstable_by(middle, f64::total_cmp);
    if odd {
        return upper;
    }
    let lower = below.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    mean_of_two(lower, upper)
}

/// The median of the values, which stay as they are.
#[must_use]
pub fn median(values: &[f64]) -> f64 {
    median_in_place(&mut values.to_vec())
}

/// `1.4826 * median |x - center|`; reorders and overwrites the values.
#[must_use]
pub fn mad_scale_in_place(values: &mut [f64], center: f64) -> f64 {
    for v in values.iter_mut() {
        *v = (*v - center).abs();
    }
    MAD_TO_SIGMA * median_in_place(values)
}

/// The mean of two values, without overflow.
#[must_use]
#[inline]
pub fn mean_of_two(a: f64, b: f64) -> f64 {
    f64::midpoint(a, b)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn medians_of_odd_even_and_no_values() {
        assert!((median(&[3.0, 1.0, 2.0]) - 2.0).abs() < 1e-15);
        assert!((median(&[4.0, 1.0, 2.0, 3.0]) - 2.5).abs() < 1e-15);
        assert!(median(&[]).is_nan());
    }

    #[test]
    fn the_mad_of_a_known_sample() {
        // |x - 2| = 1 1 0 0 2 4 7 for 1 1 2 2 4 6 9: median 1 (the textbook example of the MAD).
        let mut x = [1.0, 1.0, 2.0, 2.0, 4.0, 6.0, 9.0];
        assert!((mad_scale_in_place(&mut x, 2.0) - MAD_TO_SIGMA).abs() < 1e-15);
    }
}
