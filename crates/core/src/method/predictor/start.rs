//! Which samples may start a model: differences that vanish on smooth tracks stay within a limit.

use crate::math::difference;
use crate::method::{exceeds, reaches};

/// Section 4: five neighbours start a model when their fourth difference, eq. (21) of \[001\], does not exceed
/// `limit`. Returns how many samples of `group` must be passed over; 0 when it will do.
#[must_use]
pub fn passed_over_by_fourth(group: &[(f64, f64)], limit: f64) -> usize {
    let &[a, b, c, d, e] = group else { return 1 };
    let fourth = difference::fourth([a.0, b.0, c.0, d.0, e.0], [a.1, b.1, c.1, d.1, e.1]);
    usize::from(exceeds(fourth.abs(), limit))
}

/// Sections 6 and 7: neighbours start a model when the third difference, eq. (1) of \[000\], of every four of them
/// stays below `limit`. Returns how many samples of `group` must be passed over; 0 when it will do.
#[must_use]
pub fn passed_over_by_third(group: &[(f64, f64)], limit: f64) -> usize {
    // From the newest: a quadruple that fails spoils every group that holds it, so the search goes on behind its
    // first sample and no quadruple is looked at again and again.
    for (at, w) in group.windows(4).enumerate().rev() {
        let &[a, b, c, d] = w else { continue };
        if reaches(difference::third([a.0, b.0, c.0, d.0], [a.1, b.1, c.1, d.1]).abs(), limit) {
            return at + 1;
        }
    }
    0
}

#[cfg(test)]
mod tests {
    use super::*;

    fn group(y: &[f64]) -> Vec<(f64, f64)> {
        y.iter().enumerate().map(|(i, &y)| (i as f64, y)).collect()
    }

    #[test]
    fn the_fourth_difference_may_reach_its_limit_and_not_exceed_it() {
        // 1 -4 6 -4 1 times a spike of 1 in the middle: 6.
        let spiked = group(&[0.0, 0.0, 1.0, 0.0, 0.0]);
        assert_eq!(passed_over_by_fourth(&spiked, 6.0), 0);
        assert_eq!(passed_over_by_fourth(&spiked, 5.9), 1);
    }

    #[test]
    fn a_failing_quadruple_is_passed_over_and_the_third_difference_must_stay_below() {
        // Third differences of a spike of 1 at index 2: 3, 3, 1 (absolute), then 0.
        let spiked = group(&[0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0]);
        assert_eq!(passed_over_by_third(&spiked, 3.0), 2, "quadruples 0 and 1 reach 3");
        assert_eq!(passed_over_by_third(&spiked, 3.1), 0);
        assert_eq!(passed_over_by_third(&spiked, 0.9), 3);
    }
}
