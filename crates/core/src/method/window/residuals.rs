//! Scales from the residuals of a window's samples, each from its own expected value: step 3 of \[003\].

use std::ops::Range;

use rayon::prelude::*;

use super::{CHUNK, Figures, Judged, Limits, Rule, Verdict, Windows};
use crate::math::moments::Moments;
use crate::math::sliding::Sliding;
use crate::method::reaches;
use crate::stop::{Stop, Stopped};

/// The residuals of all samples of a segment. What lies beyond its ends has none: nothing was measured there.
pub(super) fn residuals(figures: &Figures, x: &[f64], windows: &Windows) -> Vec<f64> {
    figures.expected.iter().enumerate().map(|(c, expected)| x[windows.center(c)] - expected).collect()
}

/// `sqrt(sum r^2 / (n - 1))`.
fn scale(sums: &Moments) -> f64 {
    (sums.squares_about(0.0) / (sums.count - 1.0)).sqrt()
}

/// The samples of the segment in the window of sample `c`.
fn inside(windows: &Windows, c: usize) -> Range<usize> {
    let (range, first) = (windows.range(c), windows.center(0));
    range.start.saturating_sub(first)..(range.end - first).min(windows.len())
}

/// The scale of every window on the data as given.
pub(super) fn scales(residuals: &[f64], windows: &Windows, stop: &Stop) -> Result<Vec<f64>, Stopped> {
    let mut scales = vec![0.0; residuals.len()];
    scales.par_chunks_mut(CHUNK).enumerate().try_for_each(|(chunk, out)| {
        stop.check()?;
        let mut window = Sliding::<Moments>::default();
        for (i, slot) in out.iter_mut().enumerate() {
            window.move_to(residuals, inside(windows, chunk * CHUNK + i));
            *slot = scale(&window.get());
        }
        Ok(())
    })?;
    Ok(scales)
}

/// One pass with feedback. \[003\] goes on from step 3: the expected values stay those of the data as given, and a sample
/// that was replaced by its own has no residual any more in the windows that follow.
pub(super) fn feed_back(
    rule: &Rule,
    windows: &Windows,
    residuals: &mut [f64],
    expected: Vec<f64>,
    limits: &Limits<'_>,
    stop: &Stop,
) -> Result<Judged, Stopped> {
    let n = windows.len();
    let mut judged = Judged { verdict: vec![Verdict::Normal; n], expected, ..Judged::default() };
    judged.tolerance.reserve_exact(n);
    // Before and after the sample in the middle: the former may have been replaced, the latter have not.
    let (mut before, mut after) = (Sliding::<Moments>::default(), Sliding::<Moments>::default());
    for c in 0..n {
        stop.check_at(c)?;
        let range = inside(windows, c);
        before.move_to(residuals, range.start..c);
        after.move_to(residuals, c..range.end);
        let tolerance = rule.k * limits.bound(scale(&before.get().merge(&after.get())));
        judged.tolerance.push(tolerance);
        if reaches(residuals[c].abs(), tolerance) {
            judged.verdict[c] = Verdict::Outlier;
            residuals[c] = 0.0;
        }
    }
    Ok(judged)
}
