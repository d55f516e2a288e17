//! Settings with which a window cannot flag anything ("Bounds" of section 3).

use super::{Center, Spread, spread};
use crate::method::{exceeds, shared};
use crate::param::Settings;

/// How many scales a lone spike reaches at most among `width` samples, by the root mean square that includes it.
pub(in crate::method) fn reach(width: usize, center: Center) -> f64 {
    #[expect(clippy::cast_precision_loss, reason = "windows are at most 1001 long")]
    let n = width as f64;
    match center {
        // It pulls the mean along: d (1 - 1/n) over d / sqrt(n).
        Center::Mean => (n - 1.0) / n.sqrt(),
        // The median stays: d over d / sqrt(n - 1).
        Center::Median => (n - 1.0).sqrt(),
    }
}

/// The warning that goes with a reach, when it does not exceed the multiplier.
pub(in crate::method) fn of_reach(reach: f64, k: f64) -> Option<String> {
    (!exceeds(reach, k)).then(|| {
        format!(
            "cannot flag anything: with scale rms and this window a lone spike reaches at most {reach:.3} sigma, \
             and k is {k}; use a longer window, scale = mad or a smaller k"
        )
    })
}

/// What the user should know about the settings of a window method.
pub(in crate::method) fn warnings(settings: &Settings, center: Center) -> Vec<String> {
    if spread(settings) == Spread::Mad {
        return Vec::new();
    }
    of_reach(reach(settings.whole(shared::WINDOW.key), center), settings.real(shared::K.key)).into_iter().collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_reach_of_a_mean_window_is_that_of_the_page() {
        for (n, reaches) in [(7, 2.27), (8, 2.47), (10, 2.85), (11, 3.015)] {
            assert!((reach(n, Center::Mean) - reaches).abs() < 0.006, "{n}");
        }
        assert!(of_reach(reach(10, Center::Median), 3.0).is_some(), "3.0 of 3 is a tie that any noise breaks");
        assert!(of_reach(reach(11, Center::Mean), 3.0).is_none());
    }
}
