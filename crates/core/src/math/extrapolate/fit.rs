//! The value of a least-squares polynomial of low order at one time, without allocation.

/// Room for the orthogonal polynomials of a fit.
#[derive(Debug, Clone, Default)]
pub(super) struct Scratch {
    u: Vec<f64>,
    rest: Vec<f64>,
    before: Vec<f64>,
    now: Vec<f64>,
}

impl Scratch {
    /// The value at `at` of the polynomial of at most `order` closest to the points; lower when they are few.
    pub(super) fn at(&mut self, t: &[f64], y: &[f64], order: usize, at: f64) -> f64 {
        let n = t.len();
        let (first, last, level) = (t[0], t[n - 1], y[n - 1]);
        let center = f64::midpoint(first, last);
        let scale = if last > first { (last - first) / 2.0 } else { 1.0 };
        self.u.clear();
        self.u.extend(t.iter().map(|t| (t - center) / scale));
        self.rest.clear();
        self.rest.extend(y.iter().map(|y| y - level));
        self.before.clear();
        self.before.resize(n, 0.0);
        self.now.clear();
        self.now.resize(n, 1.0);
        let x = (at - center) / scale;
        let (mut p_before, mut p_now) = (0.0, 1.0);
        let (mut sum, mut norm_before) = (0.0, 1.0);
        let (u, rest, before, now) = (&self.u[..n], &mut self.rest[..n], &mut self.before[..n], &mut self.now[..n]);
        for k in 0..=order.min(n - 1) {
            let (mut norm, mut c, mut a) = (0.0, 0.0, 0.0);
            for i in 0..n {
                let square = now[i] * now[i];
                norm += square;
                c += now[i] * rest[i];
                a += u[i] * square;
            }
            (c, a) = (c / norm, a / norm);
            let b = if k == 0 { 0.0 } else { norm / norm_before };
            for i in 0..n {
                rest[i] -= c * now[i];
                let next = (u[i] - a) * now[i] - b * before[i];
                before[i] = now[i];
                now[i] = next;
            }
            sum += c * p_now;
            (p_before, p_now) = (p_now, (x - a) * p_now - b * p_before);
            norm_before = norm;
        }
        level + sum
    }
}

/// Sums run in this many lanes of fixed order.
const LANES: usize = 4;

/// The value at `at` of the line or parabola closest to the points, by the moments of the centred and scaled times:
/// orthogonal polynomials whose inner products are taken from sums. None when the times are so uneven that the sums
/// would cancel.
pub(super) fn by_moments(t: &[f64], y: &[f64], order: usize, at: f64) -> Option<f64> {
    let n = t.len();
    let (first, last, level) = (t[0], t[n - 1], y[n - 1]);
    let unit = 2.0 / (last - first);
    #[expect(clippy::cast_precision_loss, reason = "a few hundred at most")]
    let count = n as f64;
    let mean = lanes::<1>(t, y, |t, _| [(t - last) * unit]).map(|sum| sum / count)[0];
    let x = (at - last) * unit - mean;
    let d = |t: f64| (t - last) * unit - mean;
    if order == 1 {
        let [v0, v1, s2] = lanes(t, y, |t, y| {
            let (d, v) = (d(t), y - level);
            [v, d * v, d * d]
        });
        return Some(level + (v0 / count + x * (v1 / s2)));
    }
    let [v0, v1, v2, s2, s3, s4] = lanes(t, y, |t, y| {
        let (d, v) = (d(t), y - level);
        let square = d * d;
        [v, d * v, square * v, square, square * d, square * square]
    });
    // The second polynomial is d^2 - a d - b; its sum of squares is what remains of the fourth moment.
    let (a, b) = (s3 / s2, s2 / count);
    let norm = s4 - a * s3 - b * s2;
    let second = (v2 - a * v1 - b * v0) / norm;
    (norm > 0.01 * s4).then(|| level + (v0 / count + x * (v1 / s2) + second * (x * x - a * x - b)))
}

/// Sums of the terms of all points.
#[inline]
fn lanes<const N: usize>(t: &[f64], y: &[f64], terms: impl Fn(f64, f64) -> [f64; N]) -> [f64; N] {
    let mut sums = [[0.0; LANES]; N];
    let (t_chunks, y_chunks) = (t.chunks_exact(LANES), y.chunks_exact(LANES));
    let rest = t_chunks.remainder().iter().zip(y_chunks.remainder());
    for (t, y) in t_chunks.zip(y_chunks) {
        for lane in 0..LANES {
            for (sum, term) in sums.iter_mut().zip(terms(t[lane], y[lane])) {
                sum[lane] += term;
            }
        }
    }
    for (t, y) in rest {
        for (sum, term) in sums.iter_mut().zip(terms(*t, *y)) {
            sum[0] += term;
        }
    }
    sums.map(|lane| (lane[0] + lane[1]) + (lane[2] + lane[3]))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::polyfit::Polynomial;

    #[test]
    fn moments_and_fit_agree_on_uneven_times_and_decline_hopeless_ones() {
        for n in [3, 4, 5, 8, 16, 19, 60] {
            let t: Vec<f64> = (0..n).map(|i| 1e6 + 0.5 * i as f64 + 0.2 * (i * i % 3) as f64).collect();
            let y: Vec<f64> = (0..n).map(|i| 1e6 + (i * 7919 % 101) as f64).collect();
            let at = t[n - 1] + 0.7;
            for order in [1, 2] {
                let want = Polynomial::fit(&t, &y, order).at(at);
                let got = by_moments(&t, &y, order, at).unwrap_or(f64::NAN);
                assert!((got - want).abs() <= 1e-12 * want.abs(), "{n}, order {order}: {got} {want}");
            }
        }
        assert!(by_moments(&[0.0, 1000.0, 1000.1, 1000.2], &[0.0; 4], 2, 1001.0).is_none());
    }
}
