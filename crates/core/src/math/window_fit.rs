//! The least-squares polynomial of one window and what it leaves of every sample. By hand: one fit for each sample over
//! fixed rows, in the order of sums that saved results have.

/// Values handled at a time, so that the compiler may use vector instructions.
const LANES: usize = 4;

/// Orthonormal polynomials over the times of a window.
#[derive(Debug, Clone)]
pub struct WindowFit {
    len: usize,
    terms: usize,
    /// One row per polynomial, filled up with zeros to a multiple of [`LANES`].
    basis: Vec<f64>,
    residual: Vec<f64>,
}

impl WindowFit {
    /// For windows of `len >= 1` samples at even steps, with polynomials of order 5 at most.
    #[must_use]
    pub fn even(len: usize, order: usize) -> Self {
        let stride = len.div_ceil(LANES) * LANES;
        let terms = order.min(5).min(len - 1) + 1;
        let mut fit = Self { len, terms, basis: vec![0.0; terms * stride], residual: vec![0.0; stride] };
        #[expect(clippy::cast_precision_loss, reason = "windows are short")]
        let t: Vec<f64> = (0..len).map(|i| i as f64).collect();
        fit.set_times(&t);
        fit
    }

    /// For these times from now on, as many as before.
    pub fn set_times(&mut self, t: &[f64]) {
        let (n, stride) = (self.len, self.residual.len());
        let (first, last) = (t[0], t[n - 1]);
        let (center, per_scale) = (f64::midpoint(first, last), if last > first { 2.0 / (last - first) } else { 1.0 });
        // The three-term recurrence with normalised polynomials: the next one is u times the last without its parts
        // along the two before it.
        self.basis[..n].fill(1.0);
        for k in 0..self.terms {
            let (done, rest) = self.basis.split_at_mut(k * stride);
            let (now, next) = rest.split_at_mut(stride);
            if k > 0 {
                let before = &done[(k - 1) * stride..];
                take_off(now, before);
                if k > 1 {
                    take_off(now, &done[(k - 2) * stride..(k - 1) * stride]);
                }
            }
            let unit = 1.0 / dot(now, now).sqrt();
            now.iter_mut().for_each(|p| *p *= unit);
            if k + 1 < self.terms {
                for ((next, t), now) in next.iter_mut().zip(t).zip(&*now) {
                    *next = (t - center) * per_scale * now;
                }
            }
        }
    }

    /// Fits the polynomial to the values of the window; says the sum of the squared residuals and the largest of
    /// their absolute values.
    #[inline]
    pub fn fit(&mut self, x: &[f64]) -> (f64, f64) {
        match self.terms {
            1 => self.fit_terms::<1>(x),
            2 => self.fit_terms::<2>(x),
            3 => self.fit_terms::<3>(x),
            4 => self.fit_terms::<4>(x),
            5 => self.fit_terms::<5>(x),
            _ => self.fit_terms::<6>(x),
        }
    }

    /// As [`WindowFit::fit`], with the number of terms known to the compiler.
    #[inline]
    fn fit_terms<const TERMS: usize>(&mut self, x: &[f64]) -> (f64, f64) {
        let stride = self.residual.len();
        let count = stride / LANES;
        let rows: [&[[f64; LANES]]; TERMS] =
            std::array::from_fn(|k| &self.basis[k * stride..(k + 1) * stride].as_chunks().0[..count]);
        // What all values have in common is taken off first: it would cost digits.
        let common = x[self.len / 2];
        for (r, x) in self.residual.iter_mut().zip(&x[..self.len]) {
            *r = x - common;
        }
        let residual = &mut self.residual.as_chunks_mut::<LANES>().0[..count];
        let mut parts = [[0.0; LANES]; TERMS];
        for at in 0..count {
            for k in 0..TERMS {
                for i in 0..LANES {
                    parts[k][i] += rows[k][at][i] * residual[at][i];
                }
            }
        }
        let parts: [f64; TERMS] = parts.map(|lanes| lanes.iter().sum());
        let (mut squares, mut largest) = ([0.0; LANES], [0.0_f64; LANES]);
        for at in 0..count {
            let mut rest = residual[at];
            for k in 0..TERMS {
                for i in 0..LANES {
                    rest[i] -= parts[k] * rows[k][at][i];
                }
            }
            for i in 0..LANES {
                let size = rest[i].abs();
                squares[i] += size * size;
                largest[i] = if size > largest[i] { size } else { largest[i] };
            }
            residual[at] = rest;
        }
        (squares.iter().sum(), largest.iter().copied().fold(0.0, f64::max))
    }

    /// What the last fit left of each value.
    #[must_use]
    pub fn residual(&self) -> &[f64] {
        &self.residual[..self.len]
    }
}

/// Takes the part of `p` along the unit vector `q` off.
fn take_off(p: &mut [f64], q: &[f64]) {
    let c = dot(p, &q[..p.len()]);
    p.iter_mut().zip(q).for_each(|(p, q)| *p -= c * q);
}

/// The scalar product; both as long as a multiple of [`LANES`].
#[inline]
fn dot(a: &[f64], b: &[f64]) -> f64 {
    let mut sums = [0.0; LANES];
    for (a, b) in a.chunks_exact(LANES).zip(b.chunks_exact(LANES)) {
        for i in 0..LANES {
            sums[i] += a[i] * b[i];
        }
    }
    sums.iter().sum()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::polyfit::Polynomial;

    #[test]
    fn it_is_the_general_fit() {
        for n in [1usize, 2, 3, 7, 21, 1001] {
            let jitter = |i: usize| 1.7e9 + i as f64 * 0.25 + 0.0625 * (i % 3) as f64;
            let x: Vec<f64> = (0..n).map(|i| 1e6 + 3.0 * i as f64 + (i as f64 * 12.9898).sin()).collect();
            for order in 1..=5 {
                for even in [true, false] {
                    let t: Vec<f64> = (0..n).map(|i| if even { 5.0 * i as f64 } else { jitter(i) }).collect();
                    let mut fit = WindowFit::even(n, order);
                    if !even {
                        fit.set_times(&t);
                    }
                    let (squares, largest) = fit.fit(&x);
                    let plain = Polynomial::fit(&t, &x, order);
                    let rest: Vec<f64> = t.iter().zip(&x).map(|(&t, &x)| plain.residual(t, x)).collect();
                    assert!(rest.iter().zip(fit.residual()).all(|(a, b)| (a - b).abs() < 1e-8), "{n} {order} {even}");
                    assert!((rest.iter().map(|r| r * r).sum::<f64>() - squares).abs() < 1e-7);
                    assert!((rest.iter().fold(0.0_f64, |m, r| m.max(r.abs())) - largest).abs() < 1e-8);
                }
            }
        }
    }

    #[test]
    fn nothing_is_left_of_a_cubic() {
        let mut fit = WindowFit::even(21, 3);
        let x: Vec<f64> = (0..21).map(|i| 1e9 + f64::from(i * i * i) * 0.5).collect();
        assert!(fit.fit(&x).1 < 1e-10 * 21.0_f64.powi(3));
    }
}
