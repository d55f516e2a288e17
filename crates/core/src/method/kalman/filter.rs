//! The Kalman filter of one channel: state of position, velocity and (with `ca`) acceleration.

use nalgebra::{SMatrix, SVector};

use crate::method::shared;
use crate::param::{Choice, Settings};

/// What a filter and its gate are tuned to.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Tuning {
    /// 2: constant acceleration; 1: constant velocity.
    pub order: usize,
    /// Deviation of the measurement noise, in the units of the channel.
    pub sigma: f64,
    /// Deviation of the process noise per step: of the acceleration, in units per squared second.
    pub sigma_w: f64,
    /// The gate in deviations of the innovation.
    pub c: f64,
    /// How far the gate may open while outliers follow each other, as a factor; none: without limit.
    pub cap: Option<f64>,
}

impl Tuning {
    /// The tuning of `settings` for noise of deviation `sigma` at an interval of `interval` seconds.
    #[must_use]
    pub fn of(settings: &Settings, sigma: f64, interval: f64) -> Self {
        Self {
            order: if settings.word("model") == "cv" { 1 } else { 2 },
            sigma,
            sigma_w: settings.real("tracking_index") * sigma / (interval * interval),
            c: settings.real(shared::C.key),
            cap: match settings.choice("gate_cap") {
                Choice::Number(cap) => Some(cap),
                Choice::Word(_) => None,
            },
        }
    }

    /// How many samples start a filter.
    #[must_use]
    pub fn group(&self) -> usize {
        GROUP.max(self.order + 2)
    }
}

/// Samples in a start group; the least-squares fit below is written for this many.
const GROUP: usize = 4;

/// The filter.
#[derive(Debug, Clone, Copy, Default)]
pub struct Filter {
    /// Value of the first sample of the start group: the state is relative to it, so that an offset of the values
    /// costs no digits.
    level: f64,
    x: [f64; 3],
    /// Covariance: pp, pu, ps, uu, us, ss.
    p: [f64; 6],
}

impl Filter {
    /// State and covariance at the last sample of a start group, from the least-squares polynomial through it.
    #[must_use]
    pub fn start(group: &[(f64, f64); GROUP], tuning: &Tuning) -> Self {
        if tuning.order == 1 { Self::fitted::<2>(group, tuning.sigma) } else { Self::fitted::<3>(group, tuning.sigma) }
    }

    fn fitted<const TERMS: usize>(group: &[(f64, f64); GROUP], sigma: f64) -> Self
    where
        nalgebra::Const<GROUP>: nalgebra::DimMin<nalgebra::Const<TERMS>, Output = nalgebra::Const<TERMS>>,
        nalgebra::Const<TERMS>: nalgebra::DimMin<nalgebra::Const<TERMS>, Output = nalgebra::Const<TERMS>>,
    {
        let (first, last) = (group[0], group[GROUP - 1]);
        let scale = last.0 - first.0;
        let power = |i: usize, k: usize| (0..k).fold(1.0, |p, _| p * (group[i].0 - last.0) / scale);
        let a = SMatrix::<f64, GROUP, TERMS>::from_fn(power);
        let y = SVector::<f64, GROUP>::from_fn(|i, _| group[i].1 - first.1);
        let qr = a.qr();
        let inverse = qr.r().try_inverse().unwrap_or_else(SMatrix::zeros);
        let fit = inverse * (qr.q().transpose() * y);
        let spread = inverse * inverse.transpose();
        // From coefficients of the scaled abscissa to derivatives: k! / scale^k.
        let factor = [1.0, 1.0 / scale, 2.0 / (scale * scale)];
        let x = |k: usize| if k < TERMS { fit[k] * factor[k] } else { 0.0 };
        let p = |i: usize, j: usize| {
            if i.max(j) < TERMS { sigma * sigma * spread[(i, j)] * factor[i] * factor[j] } else { 0.0 }
        };
        Self { level: first.1, x: [x(0), x(1), x(2)], p: [p(0, 0), p(0, 1), p(0, 2), p(1, 1), p(1, 2), p(2, 2)] }
    }

    // By hand, over the six numbers of a symmetric matrix: the same steps in nalgebra (F P F' + Q, P - K H P) round
    // otherwise, which would change the results of saved sessions.

    /// Predicts `dt` seconds ahead, in `steps` equal steps with process noise of their own.
    #[inline]
    pub fn predict(&mut self, dt: f64, steps: usize, tuning: &Tuning) {
        let [x, u, s] = self.x;
        let half = 0.5 * dt * dt;
        self.x = [x + u * dt + s * half, u + s * dt, s];
        let [pp, pu, ps, uu, us, ss] = self.p;
        let (a0, a1, a2) = (pp + dt * pu + half * ps, pu + dt * uu + half * us, ps + dt * us + half * ss);
        let (b1, b2) = (uu + dt * us, us + dt * ss);
        let p = [a0 + dt * a1 + half * a2, a1 + dt * a2, a2, b1 + dt * b2, b2, ss];
        let q = process_noise(dt, steps, tuning);
        for i in 0..6 {
            self.p[i] = p[i] + q[i];
        }
    }

    /// Expected value of the sample.
    #[must_use]
    #[inline]
    pub fn expected(&self) -> f64 {
        self.level + self.x[0]
    }

    /// Variance of the position.
    #[must_use]
    pub fn variance(&self) -> f64 {
        self.p[0]
    }

    /// Variance of the innovation, S.
    #[must_use]
    #[inline]
    pub fn innovation_variance(&self, tuning: &Tuning) -> f64 {
        self.p[0] + tuning.sigma * tuning.sigma
    }

    /// Takes in a sample.
    #[inline]
    pub fn update(&mut self, y: f64, tuning: &Tuning) {
        let d = (y - self.level) - self.x[0];
        let r = tuning.sigma * tuning.sigma;
        let [pp, pu, ps, uu, us, ss] = self.p;
        let variance = pp + r;
        let k = [pp / variance, pu / variance, ps / variance];
        for (x, k) in self.x.iter_mut().zip(k) {
            *x += k * d;
        }
        let rest = r / variance;
        self.p = [rest * pp, rest * pu, rest * ps, uu - k[1] * pu, us - k[1] * ps, ss - k[2] * ps];
    }
}

/// The covariance that `steps` steps of `dt / steps` add: the sum of F^j G G' F^j' over j = 0 .. steps - 1 in closed
/// form, so that a gap costs the same whatever its length.
#[inline]
fn process_noise(dt: f64, steps: usize, tuning: &Tuning) -> [f64; 6] {
    #[expect(clippy::cast_precision_loss, reason = "the sums themselves are rounded")]
    let n = steps as f64;
    let h = dt / n;
    let w = tuning.sigma_w * tuning.sigma_w;
    if tuning.order == 1 {
        // F^j G = (h^2 (m - 1/2), h) with m = j + 1.
        let (sum, squares) = (n * n / 2.0, n * n * n / 3.0 - n / 12.0);
        return [w * h * h * h * h * squares, w * h * h * h * sum, 0.0, w * h * h * n, 0.0, 0.0];
    }
    // F^j G = (h^2 m^2 / 2, h m, 1).
    let (mut sums, h2) = ([1.0; 4], h * h);
    if steps > 1 {
        let one = n * (n + 1.0) / 2.0;
        let two = one * (2.0 * n + 1.0) / 3.0;
        sums = [one, two, one * one, two * (3.0 * n * n + 3.0 * n - 1.0) / 5.0];
    }
    let [s1, s2, s3, s4] = sums;
    [w * h2 * h2 * s4 / 4.0, w * h2 * h * s3 / 2.0, w * h2 * s2 / 2.0, w * h2 * s2, w * h * s1, w * n]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::polyfit::Polynomial;

    fn tuning(order: usize) -> Tuning {
        Tuning { order, sigma: 2.0, sigma_w: 0.3, c: 3.0, cap: None }
    }

    const GROUP_OF_4: [(f64, f64); 4] = [(10.0, 1e6 + 5.0), (10.5, 1e6 + 7.0), (11.1, 1e6 + 4.0), (11.5, 1e6 + 9.0)];

    #[test]
    fn it_starts_from_the_least_squares_polynomial_and_its_variance() {
        let (t, y): (Vec<f64>, Vec<f64>) = GROUP_OF_4.into_iter().unzip();
        for order in [1, 2] {
            let tuning = Tuning { sigma_w: 0.0, ..tuning(order) };
            let fit = Polynomial::fit(&t, &y, order);
            let mut filter = Filter::start(&GROUP_OF_4, &tuning);
            assert!((filter.expected() - fit.at(11.5)).abs() < 1e-8);
            filter.predict(0.7, 1, &tuning);
            assert!((filter.expected() - fit.at(12.2)).abs() < 1e-8);
            let want = 4.0 * (1.0 + fit.variance_at(12.2));
            assert!((filter.innovation_variance(&tuning) / want - 1.0).abs() < 1e-10);
        }
    }

    #[test]
    fn without_process_noise_it_is_the_growing_least_squares_polynomial() {
        let (mut t, mut y): (Vec<f64>, Vec<f64>) = GROUP_OF_4.into_iter().unzip();
        let tuning = Tuning { sigma_w: 0.0, ..tuning(2) };
        let mut filter = Filter::start(&GROUP_OF_4, &tuning);
        for i in 0..10 {
            let (dt, value) = (0.4 + 0.1 * f64::from(i % 3), 1e6 + f64::from(i * 7 % 5));
            filter.predict(dt, 1, &tuning);
            filter.update(value, &tuning);
            t.push(t[t.len() - 1] + dt);
            y.push(value);
            let fit = Polynomial::fit(&t, &y, 2);
            assert!((filter.expected() - fit.at(t[t.len() - 1])).abs() < 1e-7);
        }
    }

    #[test]
    fn a_gap_in_closed_form_is_the_same_as_step_by_step() {
        for order in [1, 2] {
            let tuning = tuning(order);
            for steps in [1_usize, 2, 3, 7] {
                let mut at_once = Filter::start(&GROUP_OF_4, &tuning);
                let mut one_by_one = at_once;
                at_once.predict(0.5 * steps as f64, steps, &tuning);
                (0..steps).for_each(|_| one_by_one.predict(0.5, 1, &tuning));
                for (a, b) in at_once.p.iter().zip(one_by_one.p) {
                    assert!((a - b).abs() <= 1e-11 * b.abs(), "order {order}, {steps} steps: {a} {b}");
                }
            }
        }
    }
}
