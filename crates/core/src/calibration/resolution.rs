//! The resolution of a channel: the step of the grid its values lie on.

/// A step counts when at least this share of all steps other than 0 has it.
const SHARE: f64 = 0.05;

/// At most this many steps are looked at, spread over the record.
const ENOUGH: usize = 100_000;

/// The smallest step between neighbours that many share, so that neither a rounded decimal nor a fill value decides
/// it; 0 where there is none.
pub(super) fn resolution(y: &[f64]) -> f64 {
    let every = y.len().div_ceil(ENOUGH);
    let step = |w: &[f64]| (w[1] - w[0]).abs();
    let mut steps: Vec<f64> =
        y.windows(2).step_by(every.max(1)).map(step).filter(|d| *d > 0.0 && d.is_finite()).collect();
    if steps.is_empty() {
        return 0.0;
    }
    steps.sort_unstable_by(f64::total_cmp);
    // What subtraction leaves of equal steps between values of the usual size.
    let mut sizes: Vec<f64> = y.iter().step_by(every).map(|y| y.abs()).collect();
    let rounding = 16.0 * f64::EPSILON * super::quantile(&mut sizes, 0.95);
    #[expect(
        clippy::cast_precision_loss,
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "counts of samples are far below 2^53"
    )]
    let enough = ((SHARE * steps.len() as f64) as usize).max(3);
    let mut from = 0;
    while from < steps.len() {
        let to = steps.partition_point(|d| *d <= steps[from] * (1.0 + 1e-4) + rounding);
        if to - from >= enough {
            return steps[from];
        }
        from = to;
    }
    0.0
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_step_that_many_share_is_the_resolution() {
        let mut y: Vec<f64> = (0..200).map(|i| 25.0 * f64::from(i * i % 11)).collect();
        assert!((resolution(&y) - 25.0).abs() < 1e-9);
        // One rounded decimal and one fill value do not decide it.
        (y[17], y[90]) = (y[17] + 0.001, 1e20);
        assert!((resolution(&y) - 25.0).abs() < 1e-9);
        assert!(resolution(&[7.0; 50]).abs() < 1e-300);
        let irregular: Vec<f64> = (1..200).map(|i| f64::from(i).sqrt()).collect();
        assert!(resolution(&irregular).abs() < 1e-300);
    }
}
