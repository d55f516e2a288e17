//! The covariance that the gains of the tracker imply, in units of the squared noise scale. By hand as in the Kalman filter,
//! for the same reason: nalgebra gives other bits, and no speed.

/// Covariance of position, velocity and acceleration.
#[derive(Debug, Clone, Default)]
pub(super) struct Spread {
    /// pp, pu, ps, uu, us, ss.
    p: [f64; 6],
}

impl Spread {
    /// That of the exact parabola through three samples, at the last of them; the others stand `x1` and `x2`
    /// seconds from it.
    pub(super) fn of_parabola(x1: f64, x2: f64) -> Self {
        let velocity = [-x2 / ((x1 - x2) * x1), -x1 / ((x2 - x1) * x2), -(x1 + x2) / (x1 * x2)];
        let acceleration = [2.0 / ((x1 - x2) * x1), 2.0 / ((x2 - x1) * x2), 2.0 / (x1 * x2)];
        let dot = |a: [f64; 3], b: [f64; 3]| a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
        Self {
            p: [
                1.0,
                velocity[2],
                acceleration[2],
                dot(velocity, velocity),
                dot(velocity, acceleration),
                dot(acceleration, acceleration),
            ],
        }
    }

    /// Variance of the position predicted `h` seconds ahead.
    #[inline]
    pub(super) fn position_after(&self, h: f64) -> f64 {
        predicted(self.p, h)[0]
    }

    /// A step of `h` seconds to a sample that is taken in with `gain`, or not at all.
    #[inline]
    pub(super) fn step(&mut self, h: f64, gain: Option<[f64; 3]>) {
        let p = predicted(self.p, h);
        let Some([a, b, g]) = gain else {
            self.p = p;
            return;
        };
        // (I - K H) P (I - K H)' + K K', written out for H = (1 0 0).
        let [pp, pu, ps, uu, us, ss] = p;
        let rest = 1.0 - a;
        self.p = [
            rest * rest * pp + a * a,
            rest * (pu - b * pp) + a * b,
            rest * (ps - g * pp) + a * g,
            uu - 2.0 * b * pu + b * b * pp + b * b,
            us - b * ps - g * pu + b * g * pp + b * g,
            ss - 2.0 * g * ps + g * g * pp + g * g,
        ];
    }
}

/// F P F' for a step of `h`, F of constant acceleration.
#[inline]
fn predicted([pp, pu, ps, uu, us, ss]: [f64; 6], h: f64) -> [f64; 6] {
    let half = 0.5 * h * h;
    // Rows of F P.
    let (a0, a1, a2) = (pp + h * pu + half * ps, pu + h * uu + half * us, ps + h * us + half * ss);
    let (b1, b2) = (uu + h * us, us + h * ss);
    [a0 + h * a1 + half * a2, a1 + h * a2, a2, b1 + h * b2, b2, ss]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::gains;
    use crate::math::polyfit::Polynomial;

    #[test]
    fn with_growing_gains_it_is_the_covariance_of_the_parabola_through_all_samples() {
        let h = 0.5;
        let mut spread = Spread::of_parabola(-2.0 * h, -h);
        let mut t = vec![0.0, h, 2.0 * h];
        for j in 4..20 {
            let fit = Polynomial::fit(&t, &vec![0.0; t.len()], 2);
            for ahead in [h, 3.0 * h] {
                let want = fit.variance_at(t[t.len() - 1] + ahead);
                let got = spread.position_after(ahead);
                assert!((got / want - 1.0).abs() < 1e-9, "{j}, {ahead}: {got} {want}");
            }
            let g = gains::growing(j);
            spread.step(h, Some([g.a, g.b / h, g.g / (h * h)]));
            t.push(h * (j - 1) as f64);
        }
    }
}
