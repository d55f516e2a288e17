//! Least-squares polynomials by orthogonal polynomials (Forsythe 1957): stable on any times, no normal equations. By hand:
//! nalgebra's QR of the same columns sums in another order, which would change the last bits of saved results.

mod long;

/// The highest order that any caller uses.
pub const MAX_ORDER: usize = 8;

/// A polynomial fitted by least squares.
#[derive(Debug, Clone, PartialEq)]
pub struct Polynomial {
    center: f64,
    scale: f64,
    /// Taken off the values before the fit, so that a large offset costs no digits.
    level: f64,
    /// Recurrence `p[k+1] = (u - a[k]) p[k] - b[k] p[k-1]`.
    a: [f64; MAX_ORDER + 1],
    b: [f64; MAX_ORDER + 1],
    /// Sum of squares of each orthogonal polynomial over the points.
    norm: [f64; MAX_ORDER + 1],
    coefficients: [f64; MAX_ORDER + 1],
    terms: usize,
}

impl Polynomial {
    /// The polynomial of at most `order` closest to the points; the order is lowered to `t.len() - 1`.
    /// `t` must be finite and increase; `order` is at most [`MAX_ORDER`].
    ///
    /// # Panics
    /// When there is no point, or the slices differ in length.
    #[must_use]
    pub fn fit(t: &[f64], y: &[f64], order: usize) -> Self {
        assert!(!t.is_empty() && t.len() == y.len(), "a fit needs points");
        let mut fit = Self::unfitted(t, y[0], order);
        let Self { center, scale, level, terms, .. } = fit;
        let u: Vec<f64> = t.iter().map(|t| (t - center) / scale).collect();
        let mut rest: Vec<f64> = y.iter().map(|y| y - level).collect();
        let mut before = vec![0.0; u.len()];
        let mut now = vec![1.0; u.len()];
        for k in 0..terms {
            let norm: f64 = now.iter().map(|p| p * p).sum();
            let c = now.iter().zip(&rest).map(|(p, r)| p * r).sum::<f64>() / norm;
            rest.iter_mut().zip(&now).for_each(|(r, p)| *r -= c * p);
            fit.norm[k] = norm;
            fit.coefficients[k] = c;
            if k + 1 == terms {
                break;
            }
            let a = u.iter().zip(&now).map(|(u, p)| u * p * p).sum::<f64>() / norm;
            let b = if k == 0 { 0.0 } else { norm / fit.norm[k - 1] };
            for i in 0..u.len() {
                let next = (u[i] - a) * now[i] - b * before[i];
                before[i] = now[i];
                now[i] = next;
            }
            fit.a[k] = a;
            fit.b[k] = b;
        }
        fit
    }

    fn unfitted(t: &[f64], level: f64, order: usize) -> Self {
        let (first, last) = (t[0], t[t.len() - 1]);
        Self {
            center: f64::midpoint(first, last),
            scale: if last > first { (last - first) / 2.0 } else { 1.0 },
            level,
            a: [0.0; MAX_ORDER + 1],
            b: [0.0; MAX_ORDER + 1],
            norm: [0.0; MAX_ORDER + 1],
            coefficients: [0.0; MAX_ORDER + 1],
            terms: order.min(MAX_ORDER).min(t.len() - 1) + 1,
        }
    }

    /// Its value at time `t`.
    #[must_use]
    #[inline]
    pub fn at(&self, t: f64) -> f64 {
        let mut sum = 0.0;
        self.walk(t, |k, p| sum += self.coefficients[k] * p);
        self.level + sum
    }

    /// The variance of its value at time `t`, for noise of deviation 1 on the points: the sum of the squared weights
    /// with which the points enter that value. At a point, this is the point's leverage.
    #[must_use]
    #[inline]
    pub fn variance_at(&self, t: f64) -> f64 {
        let mut sum = 0.0;
        self.walk(t, |k, p| sum += p * p / self.norm[k]);
        sum
    }

    /// Calls `visit` with each orthogonal polynomial's index and value at `t`.
    #[inline]
    fn walk(&self, t: f64, mut visit: impl FnMut(usize, f64)) {
        let u = (t - self.center) / self.scale;
        let (mut before, mut now) = (0.0, 1.0);
        for k in 0..self.terms {
            visit(k, now);
            let next = (u - self.a[k]) * now - self.b[k] * before;
            before = now;
            now = next;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_polynomial_of_the_order_is_met_exactly_even_at_large_times_and_offsets() {
        let t: Vec<f64> = (0..40).map(|i| 1.7e9 + f64::from(i) * 0.5 + 0.125 * f64::from(i % 4)).collect();
        let f = |t: f64| {
            let x = t - 1.7e9;
            1e9 + 3.0 - 2.0 * x + 0.5 * x * x - 0.01 * x * x * x
        };
        let y: Vec<f64> = t.iter().map(|&t| f(t)).collect();
        let fit = Polynomial::fit(&t, &y, 3);
        assert!(t.iter().all(|&t| (fit.at(t) - f(t)).abs() < 1e-6));
    }

    #[test]
    fn the_end_value_of_a_line_through_five_has_the_weights_of_the_textbook() {
        // One step ahead of five even points: (-4 -1 2 5 8) / 10, sum of squares 1.1 (eq. (18) of [001]).
        let t = [0.0, 1.0, 2.0, 3.0, 4.0];
        for (i, w) in [-0.4, -0.1, 0.2, 0.5, 0.8].into_iter().enumerate() {
            let mut y = [0.0; 5];
            y[i] = 1.0;
            let fit = Polynomial::fit(&t, &y, 1);
            assert!((fit.at(5.0) - w).abs() < 1e-14);
            assert!((fit.variance_at(5.0) - 1.1).abs() < 1e-14);
        }
    }

    #[test]
    fn it_solves_the_normal_equations() {
        let t = [0.0, 0.4, 1.0, 1.1, 2.0, 3.5, 4.0];
        let y = [1.0, -2.0, 0.3, 4.0, 2.2, -1.0, 0.0];
        let fit = Polynomial::fit(&t, &y, 3);
        for power in 0..=3 {
            let dot: f64 = t.iter().zip(&y).map(|(&t, y)| (y - fit.at(t)) * t.powi(power)).sum();
            assert!(dot.abs() < 1e-11, "residuals are orthogonal to t^{power}: {dot}");
        }
        // The leverages of a fit add up to the number of its terms.
        assert!((t.iter().map(|&t| fit.variance_at(t)).sum::<f64>() - 4.0).abs() < 1e-12);
    }

    #[test]
    fn fewer_points_than_the_order_asks_for_lower_it() {
        let fit = Polynomial::fit(&[1.0, 2.0], &[5.0, 7.0], 3);
        assert!((fit.at(4.0) - 11.0).abs() < 1e-12);
        assert!((Polynomial::fit(&[3.0], &[5.0], 2).at(9.0) - 5.0).abs() < 1e-15);
    }
}
