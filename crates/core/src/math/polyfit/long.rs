//! Fits over many points: the same orthogonal polynomials, worked out anew at each point instead of stored, in
//! pieces that do not depend on the number of threads.

use rayon::prelude::*;

use super::{MAX_ORDER, Polynomial};
use crate::math::pieces::{self, Check};

/// Points in one piece of work.
const CHUNK: usize = 16_384;

/// Sums that run side by side, so that the compiler may use vector instructions.
const LANES: usize = 8;

impl Polynomial {
    /// As [`Polynomial::fit`], for many points: in parallel and without memory of its own. `check` is asked before
    /// each piece of work.
    ///
    /// # Errors
    /// The error of `check`.
    ///
    /// # Panics
    /// When there is no point, or the slices differ in length.
    pub fn fit_long<E: Send>(t: &[f64], y: &[f64], order: usize, check: &impl Check<E>) -> Result<Self, E> {
        assert!(!t.is_empty() && t.len() == y.len(), "a fit needs points");
        let mut fit = Self::unfitted(t, y[0], order);
        for k in 0..fit.terms {
            let pieces: Vec<[f64; 3]> = t
                .par_chunks(CHUNK)
                .zip(y.par_chunks(CHUNK))
                .map(|(t, y)| check().map(|()| fit.sums(t, y, k)))
                .collect::<Result<_, E>>()?;
            let [norm, dot, moment] = pieces.iter().fold([0.0; 3], |s, p| [s[0] + p[0], s[1] + p[1], s[2] + p[2]]);
            fit.norm[k] = norm;
            fit.coefficients[k] = dot / norm;
            fit.a[k] = moment / norm;
            fit.b[k] = if k == 0 { 0.0 } else { norm / fit.norm[k - 1] };
        }
        Ok(fit)
    }

    /// The value `y` at time `t` minus the polynomial's, without the rounding of the level.
    #[must_use]
    #[inline]
    pub fn residual(&self, t: f64, y: f64) -> f64 {
        let mut rest = y - self.level;
        self.walk(t, |k, p| rest -= self.coefficients[k] * p);
        rest
    }

    /// [`Polynomial::residual`] at many points, in parallel; all three slices are of one length.
    ///
    /// # Errors
    /// What `check` gives, which is asked before each piece of work.
    pub fn residuals_long<E: Send>(
        &self,
        t: &[f64],
        y: &[f64],
        residual: &mut [f64],
        check: &impl Check<E>,
    ) -> Result<(), E> {
        pieces::over(residual, check, |first, residual| {
            let here = first..first + residual.len();
            let (t, y) = (t[here.clone()].chunks(LANES), y[here].chunks(LANES));
            for ((residual, t), y) in residual.chunks_mut(LANES).zip(t).zip(y) {
                let mut rest = [0.0; LANES];
                rest.iter_mut().zip(y).for_each(|(rest, y)| *rest = y - self.level);
                self.walk_lanes(t, |k, i, p| rest[i] -= self.coefficients[k] * p);
                residual.copy_from_slice(&rest[..t.len()]);
            }
        })
    }

    /// [`Polynomial::at`] at many points, in parallel; both slices are of one length.
    ///
    /// # Errors
    /// What `check` gives, which is asked before each piece of work.
    pub fn values_long<E: Send>(&self, t: &[f64], value: &mut [f64], check: &impl Check<E>) -> Result<(), E> {
        pieces::over(value, check, |first, value| {
            for (value, t) in value.chunks_mut(LANES).zip(t[first..].chunks(LANES)) {
                let mut sum = [0.0; LANES];
                let t = &t[..value.len()];
                self.walk_lanes(t, |k, i, p| sum[i] += self.coefficients[k] * p);
                value.iter_mut().zip(sum).for_each(|(value, sum)| *value = self.level + sum);
            }
        })
    }

    /// As `walk`, for up to [`LANES`] times side by side: calls `visit` with the polynomial's index, the place of the
    /// time and the value there.
    #[inline]
    fn walk_lanes(&self, t: &[f64], mut visit: impl FnMut(usize, usize, f64)) {
        let (mut u, mut before, mut now) = ([0.0; LANES], [0.0; LANES], [1.0; LANES]);
        u.iter_mut().zip(t).for_each(|(u, t)| *u = (t - self.center) / self.scale);
        for k in 0..self.terms {
            for i in 0..LANES {
                visit(k, i, now[i]);
                let next = (u[i] - self.a[k]) * now[i] - self.b[k] * before[i];
                before[i] = now[i];
                now[i] = next;
            }
        }
    }

    /// Sums over some points: the square of polynomial `k`, its product with what the ones before it leave of the
    /// values, and its square times the abscissa.
    fn sums(&self, t: &[f64], y: &[f64], k: usize) -> [f64; 3] {
        let mut sums = [[0.0; LANES]; 3];
        let whole = t.len() - t.len() % LANES;
        for at in (0..whole).step_by(LANES) {
            self.add::<LANES>(&t[at..at + LANES], &y[at..at + LANES], k, &mut sums);
        }
        for at in whole..t.len() {
            self.add::<1>(&t[at..=at], &y[at..=at], k, &mut sums);
        }
        sums.map(|lanes| lanes.iter().sum())
    }

    #[inline]
    fn add<const N: usize>(&self, t: &[f64], y: &[f64], k: usize, sums: &mut [[f64; LANES]; 3]) {
        let (mut u, mut rest) = ([0.0; N], [0.0; N]);
        let (mut before, mut now) = ([0.0; N], [1.0; N]);
        for i in 0..N {
            u[i] = (t[i] - self.center) / self.scale;
            rest[i] = y[i] - self.level;
        }
        for j in 0..k.min(MAX_ORDER) {
            for i in 0..N {
                rest[i] -= self.coefficients[j] * now[i];
                let next = (u[i] - self.a[j]) * now[i] - self.b[j] * before[i];
                before[i] = now[i];
                now[i] = next;
            }
        }
        for i in 0..N {
            let square = now[i] * now[i];
            sums[0][i] += square;
            sums[1][i] += now[i] * rest[i];
            sums[2][i] += u[i] * square;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::pieces::{certain, to_the_end};

    #[test]
    fn it_is_the_fit_of_few_points() {
        for n in [1usize, 2, 5, 9, 100, 40_003] {
            let t: Vec<f64> = (0..n).map(|i| 1.7e9 + i as f64 * 0.1 + 0.02 * (i % 3) as f64).collect();
            let y: Vec<f64> =
                (0..n).map(|i| 1e6 + (i as f64 / n as f64 * 5.0).sin() * 1e3 + (i * i % 7) as f64).collect();
            for order in [0, 1, 2, 5, 8] {
                let short = Polynomial::fit(&t, &y, order);
                let long = Polynomial::fit_long(&t, &y, order, &|| Ok::<(), ()>(())).unwrap();
                for i in (0..n).step_by(1 + n / 50) {
                    assert!((short.at(t[i]) - long.at(t[i])).abs() < 1e-8, "{n} {order} {i}");
                    assert!((long.residual(t[i], y[i]) - (y[i] - long.at(t[i]))).abs() < 1e-8);
                }
            }
        }
    }

    #[test]
    fn a_refusal_ends_it() {
        assert_eq!(Polynomial::fit_long(&[0.0, 1.0], &[0.0, 1.0], 1, &|| Err("no")), Err("no"));
    }

    #[test]
    fn many_at_a_time_are_the_same_to_the_last_bit() {
        let n = CHUNK + 3 * LANES + 5;
        let t: Vec<f64> = (0..n).map(|i| 1.7e9 + i as f64 * 0.1 + 0.02 * (i % 3) as f64).collect();
        let y: Vec<f64> = (0..n).map(|i| (i as f64 * 12.9898).sin() * 7.0).collect();
        for order in [0, 1, 2, 5, 8] {
            let fit = Polynomial::fit_long(&t, &y, order, &|| Ok::<(), ()>(())).unwrap();
            let (mut residual, mut value) = (vec![0.0; n], vec![0.0; n]);
            certain(fit.residuals_long(&t, &y, &mut residual, &to_the_end));
            certain(fit.values_long(&t, &mut value, &to_the_end));
            for i in 0..n {
                assert_eq!(residual[i].to_bits(), fit.residual(t[i], y[i]).to_bits(), "order {order}, {i}");
                assert_eq!(value[i].to_bits(), fit.at(t[i]).to_bits(), "order {order}, {i}");
            }
        }
    }
}
