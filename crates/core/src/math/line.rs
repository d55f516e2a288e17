//! The least-squares line through the points of a sliding window.

use super::sliding::Summary;

/// Sums over points `[t, x]` from which their line follows.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct LineSums {
    count: f64,
    /// Mean time and mean value.
    mean: [f64; 2],
    /// `sum (t - mean t)^2` and `sum (t - mean t) (x - mean x)`.
    moment: [f64; 2],
}

impl LineSums {
    /// The value at time `t` of the line through the points; their mean when they have no two times.
    #[must_use]
    #[inline]
    pub fn at(&self, t: f64) -> f64 {
        let slope = if self.moment[0] > 0.0 { self.moment[1] / self.moment[0] } else { 0.0 };
        self.mean[1] + slope * (t - self.mean[0])
    }
}

impl Summary for LineSums {
    type Item = [f64; 2];

    #[inline]
    fn add(&mut self, [t, x]: [f64; 2]) {
        self.count += 1.0;
        let (dt, dx) = (t - self.mean[0], x - self.mean[1]);
        let share = 1.0 / self.count;
        self.mean[0] += dt * share;
        self.mean[1] += dx * share;
        let rest = t - self.mean[0];
        self.moment[0] += dt * rest;
        self.moment[1] += dx * rest;
    }

    #[inline]
    fn joined(&self, other: &Self) -> Self {
        if other.count == 0.0 {
            return *self;
        }
        let count = self.count + other.count;
        let share = other.count / count;
        let (dt, dx) = (other.mean[0] - self.mean[0], other.mean[1] - self.mean[1]);
        let weight = self.count * share;
        Self {
            count,
            mean: [self.mean[0] + dt * share, self.mean[1] + dx * share],
            moment: [
                self.moment[0] + other.moment[0] + dt * dt * weight,
                self.moment[1] + other.moment[1] + dt * dx * weight,
            ],
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::polyfit::Polynomial;
    use crate::math::sliding::Sliding;

    #[test]
    fn it_is_the_line_of_the_general_fit() {
        let points: Vec<[f64; 2]> =
            (0..300).map(|i| [f64::from(i) + 0.3 * f64::from(i % 4), (f64::from(i) * 12.9898).sin()]).collect();
        let mut window = Sliding::<LineSums>::default();
        for start in 0..280 {
            window.move_to(&points, start..start + 20);
            let (t, x): (Vec<f64>, Vec<f64>) = points[start..start + 20].iter().map(|p| (p[0], p[1])).unzip();
            let line = Polynomial::fit(&t, &x, 1);
            assert!((window.get().at(t[19]) - line.at(t[19])).abs() < 1e-12);
        }
    }

    #[test]
    fn the_weights_of_the_template_are_those_of_003() {
        // a_i = 2 (3 i - n - 1) / (n (n + 1)), i = 1..n; so a_((n + 1) / 3) = 0.
        let n = 8;
        for i in 1..=n {
            let mut sums = LineSums::default();
            (1..=n).for_each(|j| sums.add([f64::from(j), f64::from(u8::from(i == j))]));
            let weight = f64::from(2 * (3 * i - n - 1)) / f64::from(n * (n + 1));
            assert!((sums.at(f64::from(n)) - weight).abs() < 1e-14);
        }
    }
}
