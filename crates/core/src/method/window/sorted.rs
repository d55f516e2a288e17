//! Order statistics of sliding windows: four side by side where the windows are whole and short, one after the other
//! where they are cut at the ends or long.

use std::ops::Range;

use super::{CHUNK, Windows};
use crate::math::sorted_four::{FOUR, SortedFour, WIDEST};
use crate::math::sorted_window::SortedWindow;
use crate::stop::{Stop, Stopped};
use rayon::prelude::*;

/// Fewer windows than this are not worth the four.
const FEW: usize = 64;

/// What `one` says of each whole window of `width` over `x`, and `four` of four at once, is `put` at the window's place
/// in their order. The two must say the same.
pub(super) fn whole<T>(
    x: &[f64],
    width: usize,
    one: impl Fn(&SortedWindow) -> T,
    four: impl Fn(&SortedFour) -> [T; FOUR],
    mut put: impl FnMut(usize, T),
) {
    let count = (x.len() + 1).saturating_sub(width);
    if width <= WIDEST && count >= FEW {
        SortedFour::new().slide(x, width, |at, windows| {
            for (at, said) in at.into_iter().zip(four(windows)) {
                put(at, said);
            }
        });
        return;
    }
    let mut window = SortedWindow::new();
    for at in 0..count {
        window.move_to(x, at..at + width);
        put(at, one(&window));
    }
}

/// As [`whole`], for the windows around the samples `at` of the padded values `x`; `put` is told how far into `at`.
pub(super) fn around<T>(
    x: &[f64],
    windows: &Windows,
    at: &Range<usize>,
    one: impl Fn(&SortedWindow) -> T,
    four: impl Fn(&SortedFour) -> [T; FOUR],
    mut put: impl FnMut(usize, T),
) {
    let inner = windows.whole();
    let (begin, end) = (inner.start.clamp(at.start, at.end), inner.end.clamp(at.start, at.end));
    let mut window = SortedWindow::new();
    for c in (at.start..begin).chain(end.max(begin)..at.end) {
        window.move_to(x, windows.range(c));
        put(c - at.start, one(&window));
    }
    if begin < end {
        let x = &x[windows.range(begin).start..windows.range(end - 1).end];
        whole(x, windows.width(), one, four, |i, said| put(begin - at.start + i, said));
    }
}

/// The sliding medians of `x` by these windows, piece by piece in parallel.
pub(in crate::method) fn medians(x: &[f64], windows: &Windows, stop: &Stop) -> Result<Vec<f64>, Stopped> {
    let mut medians = vec![0.0; windows.len()];
    medians.par_chunks_mut(CHUNK).enumerate().try_for_each(|(chunk, out)| {
        stop.check()?;
        let at = chunk * CHUNK..chunk * CHUNK + out.len();
        around(x, windows, &at, SortedWindow::median, SortedFour::median, |i, median| out[i] = median);
        Ok(())
    })?;
    Ok(medians)
}
