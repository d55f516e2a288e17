//! The natural cubic spline through given points. By hand: a tridiagonal system, which
//! nalgebra would solve as a dense one.

/// A natural cubic spline: its second derivative is 0 at both ends.
#[derive(Debug, Clone, PartialEq)]
pub struct Natural {
    t: Vec<f64>,
    y: Vec<f64>,
    /// Second derivatives at the points.
    bend: Vec<f64>,
}

impl Natural {
    /// The spline through the points; `t` must increase, at least one point. Through two points it is a line.
    ///
    /// # Panics
    /// When there is no point, or the slices differ in length.
    #[must_use]
    pub fn through(t: &[f64], y: &[f64]) -> Self {
        assert!(!t.is_empty() && t.len() == y.len(), "a spline needs points");
        let n = t.len();
        let mut bend = vec![0.0; n];
        // Thomas' algorithm on the tridiagonal equations of the second derivatives at the inner points.
        let mut ratio = vec![0.0; n];
        for i in 1..n.saturating_sub(1) {
            let (h0, h1) = (t[i] - t[i - 1], t[i + 1] - t[i]);
            let right = (y[i + 1] - y[i]) / h1 - (y[i] - y[i - 1]) / h0;
            let pivot = (h0 + h1) / 3.0 - h0 / 6.0 * ratio[i - 1];
            ratio[i] = h1 / 6.0 / pivot;
            bend[i] = (right - h0 / 6.0 * bend[i - 1]) / pivot;
        }
        for i in (1..n.saturating_sub(1)).rev() {
            bend[i] -= ratio[i] * bend[i + 1];
        }
        Self { t: t.to_vec(), y: y.to_vec(), bend }
    }

    /// Its value at time `t`; outside the points, that of the cubic of the nearest piece.
    #[must_use]
    pub fn at(&self, t: f64) -> f64 {
        let n = self.t.len();
        if n == 1 {
            return self.y[0];
        }
        let i = self.t.partition_point(|x| *x <= t).clamp(1, n - 1);
        let h = self.t[i] - self.t[i - 1];
        let (a, b) = ((self.t[i] - t) / h, (t - self.t[i - 1]) / h);
        let curve = (a * a * a - a) * self.bend[i - 1] + (b * b * b - b) * self.bend[i];
        // Taken from one end, so that an offset of the values costs no digits.
        self.y[i - 1] + b * (self.y[i] - self.y[i - 1]) + curve * h * h / 6.0
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn it_goes_through_its_points_and_is_a_line_through_two() {
        let (t, y) = ([0.0, 1.0, 2.5, 4.0], [1.0, -2.0, 0.5, 3.0]);
        let s = Natural::through(&t, &y);
        assert!(t.iter().zip(y).all(|(&t, y)| (s.at(t) - y).abs() < 1e-14));
        assert!((Natural::through(&[1.0, 3.0], &[2.0, 6.0]).at(2.5) - 5.0).abs() < 1e-14);
    }

    #[test]
    fn the_textbook_example() {
        // Points (0, 1), (1, e), (2, e^2), (3, e^3): Burden and Faires, Numerical Analysis, section 3.5, example 2:
        // c1 = 0.75685, c2 = 5.83007 (half the second derivatives).
        let e = std::f64::consts::E;
        let s = Natural::through(&[0.0, 1.0, 2.0, 3.0], &[1.0, e, e * e, e * e * e]);
        assert!((s.bend[1] / 2.0 - 0.75685).abs() < 1e-5, "{:?}", s.bend);
        assert!((s.bend[2] / 2.0 - 5.83007).abs() < 1e-5);
    }
}
