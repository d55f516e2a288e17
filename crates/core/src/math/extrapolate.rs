//! Extrapolating the newest points by least-squares polynomials of low order, point by point, without allocation:
//! by weights worked out once while the times are even, by a fit (Forsythe 1957) otherwise.

mod fit;

use fit::{Scratch, by_moments};

/// Steps whose lengths differ by no more than this fraction of a step count as even. Decimal times that were
/// rounded to doubles differ by less up to ten million steps.
const EVEN: f64 = 1e-8;

/// Weights are kept for predictions at most this many steps ahead.
const AHEAD: usize = 32;

/// The newest points, in order, as many as asked for.
#[derive(Debug, Clone)]
pub struct Recent {
    /// Twice the room, so that the newest points always lie side by side.
    t: Vec<f64>,
    y: Vec<f64>,
    room: usize,
    /// How many of the newest points follow each other at even steps.
    even: usize,
    interval: f64,
}

impl Recent {
    /// Room for `room` points, at an interval of `interval` seconds if they are even.
    #[must_use]
    pub fn new(room: usize, interval: f64) -> Self {
        let room = room.max(1);
        Self { t: Vec::with_capacity(4 * room), y: Vec::with_capacity(4 * room), room, even: 0, interval }
    }

    /// Forgets all points.
    pub fn clear(&mut self) {
        self.t.clear();
        self.y.clear();
        self.even = 0;
    }

    /// How many points there are, at most the room.
    #[must_use]
    #[inline]
    pub fn len(&self) -> usize {
        self.t.len().min(self.room)
    }

    /// True when there is none.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.t.is_empty()
    }

    /// The value of the newest point; NaN when there is none.
    #[must_use]
    #[inline]
    pub fn newest_value(&self) -> f64 {
        self.y.last().copied().unwrap_or(f64::NAN)
    }

    /// Adds a point; the oldest goes when there is no room.
    #[inline]
    pub fn push(&mut self, t: f64, y: f64) {
        self.even = match self.t.last() {
            Some(last) if (t - last - self.interval).abs() <= EVEN * self.interval => self.even + 1,
            _ => 1,
        };
        if self.t.len() == 4 * self.room {
            let keep = self.t.len() - self.room;
            self.t.drain(..keep);
            self.y.drain(..keep);
        }
        self.t.push(t);
        self.y.push(y);
    }

    /// The newest `m` points (all, when there are fewer).
    #[inline]
    fn newest(&self, m: usize) -> (&[f64], &[f64]) {
        let from = self.t.len().saturating_sub(m);
        (&self.t[from..], &self.y[from..])
    }

    /// How many of the newest points follow each other at even steps.
    #[must_use]
    #[inline]
    pub fn even_points(&self) -> usize {
        self.even
    }

    /// How many of these times follow the newest point and each other at even steps.
    #[must_use]
    pub fn even_ahead(&self, t: &[f64]) -> usize {
        let Some(&newest) = self.t.last() else { return 0 };
        let before = std::iter::once(&newest).chain(t);
        let even = |(a, b): (&f64, &f64)| (b - a - self.interval).abs() <= EVEN * self.interval;
        before.zip(t).take_while(|&pair| even(pair)).count()
    }

    /// The newest `m` values (all, when there are fewer), oldest first.
    #[must_use]
    pub fn newest_values(&self, m: usize) -> &[f64] {
        self.newest(m).1
    }

    /// How many even steps after the newest point `t` lies; none when that is no whole number.
    #[must_use]
    #[inline]
    pub fn ahead(&self, t: f64) -> Option<usize> {
        self.t.last().and_then(|last| self.steps(t - last))
    }

    /// How many even steps this distance is.
    #[inline]
    fn steps(&self, distance: f64) -> Option<usize> {
        if (distance - self.interval).abs() <= EVEN * self.interval {
            return Some(1);
        }
        let steps = (distance / self.interval).round();
        let even = (distance - steps * self.interval).abs() <= EVEN * self.interval;
        // Saturates; a distance that is not finite is not even.
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "small, not negative")]
        let steps = steps as usize;
        even.then_some(steps)
    }
}

/// Extrapolates a polynomial of one order through up to this many points.
#[derive(Debug, Clone)]
pub struct Extrapolator {
    /// Order of the polynomial.
    pub order: usize,
    /// How many of the newest points it is fitted to, when there are as many.
    pub points: usize,
    /// Weights of the points by steps ahead, oldest first; empty until asked for.
    weights: Vec<Vec<f64>>,
    fit: Scratch,
}

impl Extrapolator {
    /// An extrapolator of `order` on `points` points.
    #[must_use]
    pub fn new(order: usize, points: usize) -> Self {
        Self { order, points, weights: vec![Vec::new(); AHEAD + 1], fit: Scratch::default() }
    }

    /// The fitted polynomial's value at `t`, which is [`Recent::ahead`] by this many steps; quick while the points are
    /// even. It differs from [`Extrapolator::exact`] by the rounding of the times: a caller must not let that decide.
    #[must_use]
    #[inline]
    pub fn quick(&mut self, recent: &Recent, t: f64, ahead: Option<usize>) -> f64 {
        match ahead {
            Some(ahead @ 1..=AHEAD) if recent.even >= self.points => self.weighted(recent.newest(self.points).1, ahead),
            _ => self.exact(recent, t),
        }
    }

    /// [`Extrapolator::quick`] one even step after the last of these values, which are as many as it is fitted to or
    /// more, at even times.
    #[must_use]
    #[inline]
    pub fn next(&mut self, values: &[f64]) -> f64 {
        self.weighted(&values[values.len() - self.points..], 1)
    }

    /// The fitted polynomial's value at `t`, on the times as they are.
    #[must_use]
    pub fn exact(&mut self, recent: &Recent, t: f64) -> f64 {
        let (times, values) = recent.newest(self.points);
        if (1..=2).contains(&self.order)
            && times.len() > self.order
            && let Some(value) = by_moments(times, values, self.order, t)
        {
            return value;
        }
        self.fit.at(times, values, self.order, t)
    }

    #[inline]
    fn weighted(&mut self, y: &[f64], ahead: usize) -> f64 {
        if self.weights[ahead].is_empty() {
            self.weights[ahead] = even_weights(self.points, self.order, ahead);
        }
        // The weights add up to 1: with the newest value taken off, an offset costs no digits.
        let level = y[y.len() - 1];
        // Four sums at once: the order of the additions is fixed, and the processor need not wait for each.
        let mut sums = [0.0; 4];
        let weights = &self.weights[ahead];
        let (chunks, rest) = (weights.chunks_exact(4), weights.chunks_exact(4).remainder());
        let tail = &y[y.len() - rest.len()..];
        for (w, v) in chunks.zip(y.chunks_exact(4)) {
            for k in 0..4 {
                sums[k] += w[k] * (v[k] - level);
            }
        }
        let tail: f64 = rest.iter().zip(tail).map(|(w, v)| w * (v - level)).sum();
        level + ((sums[0] + sums[1]) + (sums[2] + sums[3]) + tail)
    }
}

/// The weights with which `points` values at even steps enter the least-squares polynomial of `order`, `ahead`
/// steps after the newest. Oldest first.
#[must_use]
pub fn even_weights(points: usize, order: usize, ahead: usize) -> Vec<f64> {
    #[expect(clippy::cast_precision_loss, reason = "a few hundred at most")]
    let t: Vec<f64> = (0..points).map(|i| i as f64).collect();
    #[expect(clippy::cast_precision_loss, reason = "a few hundred at most")]
    let at = (points - 1 + ahead) as f64;
    let unit = |i: usize| {
        let mut y = vec![0.0; points];
        y[i] = 1.0;
        Scratch::default().at(&t, &y, order, at)
    };
    (0..points).map(unit).collect()
}

/// Standard deviation of (prediction - sample) in noise scales, `ahead` even steps after the newest of `points`.
#[must_use]
pub fn prediction_error(points: usize, order: usize, ahead: usize) -> f64 {
    (1.0 + even_weights(points, order, ahead).iter().map(|w| w * w).sum::<f64>()).sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::polyfit::Polynomial;

    fn value(i: usize) -> f64 {
        1e6 + (i * 7919 % 101) as f64
    }

    #[test]
    fn on_even_steps_weights_and_fit_agree_and_both_with_the_general_fit() {
        for (order, points) in [(1, 8), (2, 16), (3, 24), (3, 7), (1, 2)] {
            let mut recent = Recent::new(24, 0.5);
            let mut extrapolator = Extrapolator::new(order, points);
            let mut twin: Vec<(f64, f64)> = Vec::new();
            for i in 0..200 {
                let t = 0.5 * i as f64;
                if twin.len() >= points {
                    let (a, b) = (
                        extrapolator.quick(&recent, t + 0.5, recent.ahead(t + 0.5)),
                        extrapolator.exact(&recent, t + 0.5),
                    );
                    let newest = &twin[twin.len() - points..];
                    let (times, values): (Vec<f64>, Vec<f64>) = newest.iter().copied().unzip();
                    let general = Polynomial::fit(&times, &values, order).at(t + 0.5);
                    assert!((a - b).abs() <= 1e-12 * b.abs(), "order {order}, {i}: {a} {b}");
                    assert!((a - general).abs() <= 1e-12 * b.abs(), "order {order}, {i}: {a} {general}");
                }
                // Two rejected samples now and then: a hole in the times.
                if i % 50 > 1 {
                    recent.push(t, value(i));
                    twin.push((t, value(i)));
                }
            }
        }
    }

    #[test]
    fn uneven_steps_are_fitted_as_they_are() {
        let mut recent = Recent::new(16, 0.1);
        let mut extrapolator = Extrapolator::new(2, 16);
        let f = |t: f64| 3.0 - 2.0 * t + 0.25 * t * t;
        for i in 0..40 {
            let t = 0.1 * i as f64 + 0.02 * (i % 3) as f64;
            recent.push(t, f(t));
        }
        assert!((extrapolator.quick(&recent, 4.3, recent.ahead(4.3)) - f(4.3)).abs() < 1e-10);
    }
}
