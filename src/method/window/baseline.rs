//! The local-slope baseline: deviations from a window's middle would measure the track's slope, not its noise.

use super::{CHUNK, sweep};
use crate::math::sorted_window::SortedWindow;
use crate::method::Segment;
use crate::stop::{Stop, Stopped};

/// Adds the integral of the local slope (the running median of slopes over a third of `width`) to `base`, which has
/// one value per sample. Segments under five samples are left alone. "`detrend = slope`" of section 3.
pub(super) fn add_slope(segment: &Segment<'_>, width: usize, base: &mut [f64], stop: &Stop) -> Result<(), Stopped> {
    let (t, y, n) = (segment.t, segment.y, segment.len());
    if n < 5 {
        return Ok(());
    }
    let lag = (width / 3).max(1).min(n - 2);
    let count = n - lag;
    let medians = (width - lag).min(count);
    let last = count - medians;
    // Windows near the ends are the same one, so a window is worked out once for each place it begins at.
    let mut slopes = vec![0.0; last + 1];
    let piece = |chunk: usize| {
        let end = (chunk * CHUNK + CHUNK + medians - 1).min(count);
        (chunk * CHUNK..end).map(|j| (y[j + lag] - y[j]) / (t[j + lag] - t[j])).collect::<Vec<f64>>()
    };
    let state = || (SortedWindow::new(), None);
    sweep(&mut slopes, stop, state, |(window, lagged), begin| {
        let origin = begin - begin % CHUNK;
        let lagged: &Vec<f64> = lagged.get_or_insert_with(|| piece(begin / CHUNK));
        window.move_to(lagged, begin - origin..begin - origin + medians);
        window.median()
    })?;
    let slope = |i: usize| slopes[i.saturating_sub(width / 2).min(last)];
    let mut height = 0.0;
    for i in 1..n {
        stop.check_at(i)?;
        height += f64::midpoint(slope(i - 1), slope(i)) * (t[i] - t[i - 1]);
        base[i] += height;
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::order::median;

    fn segment<'a>(t: &'a [f64], y: &'a [f64]) -> Segment<'a> {
        Segment { t, y, interval: 1.0, sigma: 0.0, floor: 0.0, rate: None }
    }

    /// The page's formulas, one by one.
    fn plain(t: &[f64], y: &[f64], n: usize) -> Vec<f64> {
        let len = y.len();
        let m = (n / 3).max(1).min(len - 2);
        let s: Vec<f64> = (0..len - m).map(|j| (y[j + m] - y[j]) / (t[j + m] - t[j])).collect();
        let w = (n - m).min(s.len());
        let slope: Vec<f64> = (0..len)
            .map(|i| {
                let a = i.saturating_sub(n / 2).min(s.len() - w);
                median(&s[a..a + w])
            })
            .collect();
        let mut b = vec![0.0; len];
        for i in 1..len {
            b[i] = b[i - 1] + (slope[i - 1] + slope[i]) / 2.0 * (t[i] - t[i - 1]);
        }
        b
    }

    #[test]
    fn it_equals_its_plain_twin() {
        for (len, width) in [(5, 3), (7, 21), (40, 21), (200, 10), (20_000, 33)] {
            let t: Vec<f64> = (0..len).map(|i| f64::from(i) + 0.3 * f64::from(i * 7 % 3)).collect();
            let y: Vec<f64> = t.iter().map(|t| 50.0 * (t / 30.0).sin() + (t * 99.7).sin()).collect();
            let mut base = vec![0.0; y.len()];
            add_slope(&segment(&t, &y), width, &mut base, &Stop::never()).unwrap();
            let want = plain(&t, &y, width);
            assert!(base.iter().zip(&want).all(|(a, b)| (a - b).abs() < 1e-9), "{len} {width}");
        }
    }

    #[test]
    fn a_line_is_its_own_baseline_whatever_a_spike_does() {
        let t: Vec<f64> = (0..60).map(f64::from).collect();
        let mut y: Vec<f64> = t.iter().map(|t| 3.0 * t).collect();
        y[30] += 1e6;
        let mut base = vec![0.0; 60];
        add_slope(&segment(&t, &y), 21, &mut base, &Stop::never()).unwrap();
        assert!(base.iter().zip(&t).all(|(b, t)| (b - 3.0 * t).abs() < 1e-9));
    }
}
