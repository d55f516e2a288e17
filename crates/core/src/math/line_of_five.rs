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
        line(x, v, level)
    }
}

/// How many lines [`LineOfFive::ahead`] works out at a time.
pub const AHEAD: usize = 5 * LANES;

/// Lines five points apart have their points in the same places of the ring: this many go side by side.
pub const LANES: usize = 4;

/// A figure of lines five points apart.
pub type Lanes = [f64; LANES];

/// What stands in each place of the ring, one after the other.
type Rows = [[f64; LANES + 1]; 5];

impl LineOfFive {
    /// True when the oldest point stands first in the ring, as [`LineOfFive::ahead`] wants it.
    #[must_use]
    #[inline]
    pub fn in_order(&self) -> bool {
        self.next == 0
    }

    /// What [`LineOfFive::at`] would say of each of these points if the ones before it had been pushed, to the last
    /// bit: each sum runs over the places of the ring in their order, and what is worked out side by side are lines
    /// five points apart, which have each place filled alike. Five times `said(s, values, variances)` is told of
    /// the points `s`, `s + 5`, `s + 10` and `s + 15`. The line must be [`LineOfFive::in_order`].
    #[inline]
    pub fn ahead(&self, t: &[f64; AHEAD], y: &[f64; AHEAD], mut said: impl FnMut(usize, Lanes, Lanes)) {
        let rows = |ring: &[f64; 5], next: &[f64; AHEAD]| -> Rows {
            std::array::from_fn(|s| std::array::from_fn(|b| if b == 0 { ring[s] } else { next[5 * (b - 1) + s] }))
        };
        let (t, y) = (rows(&self.t, t), rows(&self.y, y));
        // With the place known to the compiler, all stays in registers.
        side_by_side::<0>(&t, &y, &mut said);
        side_by_side::<1>(&t, &y, &mut said);
        side_by_side::<2>(&t, &y, &mut said);
        side_by_side::<3>(&t, &y, &mut said);
        side_by_side::<4>(&t, &y, &mut said);
    }

    /// [`LineOfFive::push`] for all points that [`LineOfFive::ahead`] looked at.
    #[inline]
    pub fn push_all(&mut self, t: &[f64; AHEAD], y: &[f64; AHEAD]) {
        self.t.copy_from_slice(&t[AHEAD - 5..]);
        self.y.copy_from_slice(&y[AHEAD - 5..]);
    }
}

/// The lines at the points that come to place `S` of the ring: the steps of [`line()`], each for all lanes.
#[inline(always)]
fn side_by_side<const S: usize>(t: &Rows, y: &Rows, said: &mut impl FnMut(usize, Lanes, Lanes)) {
    // Places before `S` have got their next point already.
    let place = |rows: &Rows, j: usize, b: usize| rows[j][b + usize::from(j < S)];
    let level = lanes(|b| place(y, 0, b));
    let x: [Lanes; 5] = std::array::from_fn(|j| lanes(|b| place(t, j, b) - t[S][b + 1]));
    let v: [Lanes; 5] = std::array::from_fn(|j| lanes(|b| place(y, j, b) - level[b]));
    let middle = lanes(|b| (x[0][b] + x[1][b] + x[2][b] + x[3][b] + x[4][b]) / 5.0);
    let mean = lanes(|b| (v[0][b] + v[1][b] + v[2][b] + v[3][b] + v[4][b]) / 5.0);
    let (mut xx, mut xv) = ([0.0; LANES], [0.0; LANES]);
    for j in 0..5 {
        for b in 0..LANES {
            let d = x[j][b] - middle[b];
            xx[b] += d * d;
            xv[b] += d * v[j][b];
        }
    }
    let per_xx = lanes(|b| 1.0 / xx[b]);
    let value = lanes(|b| level[b] + (mean[b] - middle[b] * (xv[b] * per_xx[b])));
    said(S, value, lanes(|b| 0.2 + middle[b] * middle[b] * per_xx[b]));
}

#[inline(always)]
fn lanes(figure: impl Fn(usize) -> f64) -> Lanes {
    std::array::from_fn(figure)
}

/// Value and variance at 0 of the line through five points at `x` with the values `v` above `level`.
#[inline]
fn line(x: [f64; 5], v: [f64; 5], level: f64) -> (f64, f64) {
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

    #[test]
    fn twenty_at_a_time_are_the_same_to_the_last_bit() {
        let t: [f64; 5 + 2 * AHEAD] = std::array::from_fn(|i| 1.7e9 + 0.1 * i as f64 + 0.03 * (i * i % 4) as f64);
        let y: [f64; 5 + 2 * AHEAD] = std::array::from_fn(|i| 1e6 + (i as f64 * 12.9898).sin() * 40.0);
        let mut plain = LineOfFive::default();
        (0..5).for_each(|i| plain.push(t[i], y[i]));
        let mut many = plain.clone();
        for block in 0..2 {
            assert!(many.in_order());
            let from = 5 + block * AHEAD;
            let times: &[f64; AHEAD] = t[from..from + AHEAD].try_into().unwrap();
            let values: &[f64; AHEAD] = y[from..from + AHEAD].try_into().unwrap();
            let (mut expected, mut variances) = ([0.0; AHEAD], [0.0; AHEAD]);
            many.ahead(times, values, |s, value, variance| {
                for lane in 0..LANES {
                    (expected[5 * lane + s], variances[5 * lane + s]) = (value[lane], variance[lane]);
                }
            });
            for i in 0..AHEAD {
                let (value, variance) = plain.at(times[i]);
                assert_eq!((value.to_bits(), variance.to_bits()), (expected[i].to_bits(), variances[i].to_bits()));
                plain.push(times[i], values[i]);
            }
            many.push_all(times, values);
        }
        assert_eq!((plain.t, plain.y, plain.next), (many.t, many.y, many.next));
    }
}
