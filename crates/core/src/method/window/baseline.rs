//! The local-slope baseline: deviations from a window's middle would measure the track's slope, not its noise.

use rayon::prelude::*;

use super::CHUNK;
use super::sorted::whole;
use crate::math::pieces::{self, PIECE};
use crate::math::sorted_four::SortedFour;
use crate::math::sorted_window::SortedWindow;
use crate::method::Segment;
use crate::stop::{Stop, Stopped};

/// The integral of the local slope (the running median of slopes over a third of `width`), one value per sample; none
/// for segments under five samples, which are left alone. "`detrend = slope`" of section 3.
pub(super) fn slope(segment: &Segment<'_>, width: usize, stop: &Stop) -> Result<Option<Vec<f64>>, Stopped> {
    let (t, y, n) = (segment.t, segment.y, segment.len());
    if n < 5 {
        return Ok(None);
    }
    let lag = (width / 3).max(1).min(n - 2);
    let count = n - lag;
    let medians = (width - lag).min(count);
    let last = count - medians;
    // Windows near the ends are the same one, so a window is worked out once for each place it begins at.
    let mut slopes = vec![0.0; last + 1];
    slopes.par_chunks_mut(CHUNK).enumerate().try_for_each(|(chunk, out)| {
        stop.check()?;
        let at = chunk * CHUNK..chunk * CHUNK + out.len() + medians - 1;
        let (here, ahead) = (at.clone(), at.start + lag..at.end + lag);
        let ends = y[here.clone()].iter().zip(&y[ahead.clone()]).zip(t[here].iter().zip(&t[ahead]));
        let lagged: Vec<f64> = ends.map(|((y0, y1), (t0, t1))| (y1 - y0) / (t1 - t0)).collect();
        whole(&lagged, medians, SortedWindow::median, SortedFour::median, |i, median| out[i] = median);
        Ok(())
    })?;
    let slope = |i: usize| slopes[i.saturating_sub(width / 2).min(last)];
    let rise = |i: usize| if i == 0 { 0.0 } else { f64::midpoint(slope(i - 1), slope(i)) * (t[i] - t[i - 1]) };
    let mut base: Vec<f64> = pieces::collect(n, &|| stop.check(), rise)?;
    let mut height = 0.0;
    for piece in base.chunks_mut(PIECE) {
        stop.check()?;
        for base in piece {
            height += *base;
            *base = height;
        }
    }
    Ok(Some(base))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::order::median;

    fn segment<'a>(t: &'a [f64], y: &'a [f64]) -> Segment<'a> {
        Segment { t, y, interval: 1.0, sigma: 0.0, floor: 0.0, floors: &[], objections: &[], rate: None }
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
            let base = slope(&segment(&t, &y), width, &Stop::never()).unwrap().unwrap();
            let want = plain(&t, &y, width);
            assert!(base.iter().zip(&want).all(|(a, b)| (a - b).abs() < 1e-9), "{len} {width}");
        }
    }

    #[test]
    fn a_line_is_its_own_baseline_whatever_a_spike_does() {
        let t: Vec<f64> = (0..60).map(f64::from).collect();
        let mut y: Vec<f64> = t.iter().map(|t| 3.0 * t).collect();
        y[30] += 1e6;
        let base = slope(&segment(&t, &y), 21, &Stop::never()).unwrap().unwrap();
        assert!(base.iter().zip(&t).all(|(b, t)| (b - 3.0 * t).abs() < 1e-9));
    }
}
