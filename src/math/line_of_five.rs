//! The least-squares line through the last five points, extended: one closed form for even and uneven times.

/// The last five points.
#[derive(Debug, Clone, Default)]
pub struct LineOfFive {
    /// In a ring, the next to go at `next`.
    t: [f64; 5],
    y: [f64; 5],
    next: usize,
}

impl LineOfFive {
    /// Adds a point; the oldest of five goes.
    #[inline]
    pub fn push(&mut self, t: f64, y: f64) {
        self.t[self.next] = t;
        self.y[self.next] = y;
        self.next = if self.next == 4 { 0 } else { self.next + 1 };
    }

    /// The line's value at `t`, and the sum of the squared weights with which the five values enter it: on even
    /// steps, one step ahead, the weights are (-4 -1 2 5 8) / 10 (\[001\] eq. (22)). Five points must have been
    /// pushed, at different times.
    #[must_use]
    #[inline]
    pub fn at(&self, t: f64) -> (f64, f64) {
        // Distances from the time asked for and from one of the values: large times and offsets cost no digits.
        let x = self.t.map(|s| s - t);
        let level = self.y[0];
        let v = self.y.map(|y| y - level);
        let middle = (x[0] + x[1] + x[2] + x[3] + x[4]) / 5.0;
        let mean = (v[0] + v[1] + v[2] + v[3] + v[4]) / 5.0;
        let (mut xx, mut xv) = (0.0, 0.0);
        for i in 0..5 {
            let d = x[i] - middle;
            xx += d * d;
            xv += d * v[i];
        }
        let per_xx = 1.0 / xx;
        (level + (mean - middle * (xv * per_xx)), 0.2 + middle * middle * per_xx)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::polyfit::Polynomial;

    #[test]
    fn it_is_the_line_of_the_general_fit_at_any_times_and_offsets() {
        let mut line = LineOfFive::default();
        let t: Vec<f64> = (0..30).map(|i| 1.7e9 + 0.25 * f64::from(i) + 0.0625 * f64::from(i * i % 3)).collect();
        let y: Vec<f64> = (0..30).map(|i| 1e6 + f64::from(i * 37 % 11)).collect();
        for i in 0..29 {
            line.push(t[i], y[i]);
            if i >= 4 {
                let fit = Polynomial::fit(&t[i - 4..=i], &y[i - 4..=i], 1);
                let (value, variance) = line.at(t[i + 1]);
                assert!((value - fit.at(t[i + 1])).abs() < 1e-8, "at {i}");
                assert!((variance - fit.variance_at(t[i + 1])).abs() < 1e-12, "at {i}");
            }
        }
    }
}
