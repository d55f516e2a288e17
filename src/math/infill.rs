//! Curves through samples on both sides of a stretch, to be evaluated inside it.

/// The natural cubic spline through points; two points make a line.
#[derive(Debug, Clone)]
pub struct NaturalSpline {
    t: Vec<f64>,
    y: Vec<f64>,
    /// Second derivatives at the points.
    bend: Vec<f64>,
}

impl NaturalSpline {
    /// The spline through the points; `t` must increase and hold at least two times.
    #[must_use]
    pub fn through(t: Vec<f64>, y: Vec<f64>) -> Self {
        let n = t.len();
        let mut bend = vec![0.0; n];
        // Tridiagonal equations for the inner second derivatives, solved downwards and back.
        let mut upper = vec![0.0; n];
        for i in 1..n.saturating_sub(1) {
            let (h, g) = (t[i] - t[i - 1], t[i + 1] - t[i]);
            let right = 6.0 * ((y[i + 1] - y[i]) / g - (y[i] - y[i - 1]) / h);
            let pivot = 2.0 * (h + g) - h * upper[i - 1];
            upper[i] = g / pivot;
            bend[i] = (right - h * bend[i - 1]) / pivot;
        }
        for i in (1..n.saturating_sub(1)).rev() {
            bend[i] -= upper[i] * bend[i + 1];
        }
        Self { t, y, bend }
    }

    /// Its value at `x`, between the first and the last point.
    #[must_use]
    pub fn at(&self, x: f64) -> f64 {
        let last = self.t.len().saturating_sub(1);
        let i = self.t.partition_point(|&t| t <= x).clamp(1, last.max(1)) - 1;
        let h = self.t[i + 1] - self.t[i];
        let (a, b) = ((self.t[i + 1] - x) / h, (x - self.t[i]) / h);
        // The level is taken off so that an offset of the values costs no digits.
        let curve = ((a * a * a - a) * self.bend[i] + (b * b * b - b) * self.bend[i + 1]) * h * h / 6.0;
        self.y[i] + b * (self.y[i + 1] - self.y[i]) + curve
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn it_passes_through_the_points_and_is_smooth_and_straight_at_the_ends() {
        let t = vec![0.0, 1.0, 2.5, 3.0, 7.0, 7.5];
        let y = vec![1.0, -2.0, 4.0, 0.5, 2.0, 2.0];
        let spline = NaturalSpline::through(t.clone(), y.clone());
        let e = 1e-4;
        for i in 0..t.len() {
            assert!((spline.at(t[i]) - y[i]).abs() < 1e-12);
        }
        for &x in &t[1..5] {
            let slope = |x: f64| (spline.at(x + e) - spline.at(x - e)) / (2.0 * e);
            assert!((slope(x - 2.0 * e) - slope(x + 2.0 * e)).abs() < 1e-1, "no corner at {x}");
            let bend = |x: f64| (spline.at(x + e) - 2.0 * spline.at(x) + spline.at(x - e)) / (e * e);
            assert!((bend(x - 2.0 * e) - bend(x + 2.0 * e)).abs() < 1e-1, "no jump of the curvature at {x}");
        }
        let bend = |x: f64| (spline.at(x + e) - 2.0 * spline.at(x) + spline.at(x - e)) / (e * e);
        assert!(bend(e).abs() < 1e-2 && bend(7.5 - e).abs() < 1e-2);
    }

    #[test]
    fn through_two_points_it_is_a_line() {
        let line = NaturalSpline::through(vec![1.0, 3.0], vec![5.0, 9.0]);
        assert!((line.at(1.5) - 6.0).abs() < 1e-14);
    }
}
