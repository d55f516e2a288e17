//! Differences that vanish on smooth tracks, on the real times.

/// The third difference over four neighbours: how far the parabola through the first three misses the fourth,
/// scaled so that white noise of deviation `s` gives one of `s * sqrt(20)`, as the plain
/// `y0 - 3 y1 + 3 y2 - y3` does on even steps (to which it is equal there, up to the sign).
#[must_use]
#[inline]
pub fn third(t: [f64; 4], y: [f64; 4]) -> f64 {
    let (a, b, c) = (t[0] - t[3], t[1] - t[3], t[2] - t[3]);
    // Lagrange weights of the parabola at t[3]; they add up to 1, so the level is taken off first: an offset of the
    // values then costs no digits.
    let w0 = b * c / ((a - b) * (a - c));
    let w1 = a * c / ((b - a) * (b - c));
    let w2 = a * b / ((c - a) * (c - b));
    let miss = (y[3] - y[2]) - (w0 * (y[0] - y[2]) + w1 * (y[1] - y[2]));
    miss * (20.0 / (1.0 + w0 * w0 + w1 * w1 + w2 * w2)).sqrt()
}

/// The fourth difference over five neighbours: how far the cubic through the first four misses the fifth, scaled
/// so that white noise of deviation `s` gives one of `s * sqrt(70)`, as `y0 - 4 y1 + 6 y2 - 4 y3 + y4` does on
/// even steps (to which it is equal there).
#[must_use]
#[inline]
pub fn fourth(t: [f64; 5], y: [f64; 5]) -> f64 {
    let mut miss = y[4] - y[3];
    let mut sum = 1.0;
    for i in 0..4 {
        let mut w = 1.0;
        for j in (0..4).filter(|&j| j != i) {
            w *= (t[4] - t[j]) / (t[i] - t[j]);
        }
        sum += w * w;
        miss -= w * (y[i] - y[3]);
    }
    miss * (70.0 / sum).sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn even_steps_give_the_plain_differences() {
        let y = [2.0, 7.0, 1.0, 8.0, 2.8];
        let plain = y[0] - 3.0 * y[1] + 3.0 * y[2] - y[3];
        let got = third([0.0, 0.5, 1.0, 1.5], [y[0], y[1], y[2], y[3]]);
        assert!((got + plain).abs() < 1e-12, "{got} {plain}");
        let plain = y[0] - 4.0 * y[1] + 6.0 * y[2] - 4.0 * y[3] + y[4];
        let got = fourth([10.0, 10.5, 11.0, 11.5, 12.0], y);
        assert!((got - plain).abs() < 1e-12, "{got} {plain}");
    }

    #[test]
    fn uneven_steps_leave_nothing_of_a_parabola_and_a_cubic() {
        let t = [0.0, 0.3, 1.1, 1.2, 2.0];
        let parabola = t.map(|t| 3.0 - t + 2.0 * t * t);
        assert!(third([t[0], t[1], t[2], t[3]], [parabola[0], parabola[1], parabola[2], parabola[3]]).abs() < 1e-12);
        let cubic = t.map(|t| 3.0 - t + 2.0 * t * t - 5.0 * t * t * t);
        assert!(fourth(t, cubic).abs() < 1e-11);
    }
}
