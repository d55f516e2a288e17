//! The polynomials that compete for each sample, and the model they make up (steps 1 and 2 of section 6).

use crate::math::extrapolate::{Extrapolator, Recent, prediction_error};
use crate::method::predictor::{Answer, Batch, Model, passed_over_by_third};
use crate::method::{TIE, reaches};
use crate::param::Settings;

/// A polynomial order with the points it is fitted to.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Candidate {
    /// Order l.
    pub order: usize,
    /// Points `m_l`.
    pub points: usize,
    /// The number by which verdicts remember it: its order, or 4 for the line through two points.
    pub code: u8,
}

/// The code of "none".
pub(super) const NO_CANDIDATE: u8 = 0;
/// The code of the line through the last two points.
pub(super) const TWO_POINT: u8 = 4;

impl Candidate {
    fn of_order(order: usize, settings: &Settings) -> Self {
        let own = match order {
            2 => settings.whole_or_off("points_2"),
            3 => settings.whole_or_off("points_3"),
            _ => None,
        };
        let points = own.unwrap_or_else(|| order * settings.whole("points"));
        #[expect(clippy::cast_possible_truncation, reason = "orders are at most 3")]
        Self { order, points, code: order as u8 }
    }

    /// How many accepted samples it waits for.
    #[must_use]
    pub fn need(&self) -> usize {
        if self.code == TWO_POINT { 2 } else { self.points.min(3 * (self.order + 1)) }
    }

    /// Standard deviation of its prediction error in noise scales, this many steps ahead of even samples.
    #[must_use]
    pub fn error(&self, ahead: usize) -> f64 {
        prediction_error(self.points, self.order, ahead)
    }

    /// Its name: `parabola on 16`.
    #[must_use]
    pub fn name(&self) -> String {
        let shape = ["constant", "line", "parabola", "cubic"].get(self.order).unwrap_or(&"polynomial");
        format!("{shape} on {}", self.points)
    }
}

/// The candidates of these settings, the highest order first.
#[must_use]
pub fn candidates(settings: &Settings) -> Vec<Candidate> {
    let order = settings.whole("order");
    if !settings.switch("variable_order") {
        return vec![Candidate::of_order(order, settings)];
    }
    let mut list: Vec<Candidate> = (1..=order).rev().map(|l| Candidate::of_order(l, settings)).collect();
    if settings.switch("two_point") {
        list.push(Candidate { order: 1, points: 2, code: TWO_POINT });
    }
    list
}

/// What is said of a sample beside its verdict: the candidate that came closest, and its prediction.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Closest {
    /// Its prediction.
    pub expected: f64,
    /// Its code.
    pub code: u8,
}

/// A sample with the tolerance it is judged by.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Bounded {
    /// Its value.
    pub y: f64,
    /// Within this of a prediction it is expected.
    pub delta: f64,
}

/// The candidates over the newest accepted samples of one direction.
#[derive(Debug, Clone)]
pub struct Candidates {
    list: Vec<(Candidate, Extrapolator)>,
    recent: Recent,
    /// Points of the candidate that has most.
    most: usize,
    /// The newest values and those to come, side by side.
    stretch: Vec<f64>,
    /// Samples in a start group.
    start: usize,
    /// Third differences of a start group stay below this, or below the tolerance of one of its samples.
    start_limit: f64,
    t: f64,
    /// Predictions of the candidates that take part, by their place in the list.
    predicted: [f64; 4],
    closest: Closest,
}

/// Robust start groups accept third differences up to this many noise scales: two deviations of a third difference.
const START_SCALES: f64 = 9.0;

impl Candidates {
    /// A model for these settings; `sigma` in the units of the channel, `interval` in seconds.
    #[must_use]
    pub fn new(settings: &Settings, sigma: f64, interval: f64) -> Self {
        let list = candidates(settings);
        let smallest = list.iter().filter(|c| c.code != TWO_POINT).map(Candidate::need).min().unwrap_or(4);
        let room = list.iter().map(|c| c.points).max().unwrap_or(1);
        Self {
            start: settings.whole("start").max(4).max(smallest),
            list: list.into_iter().map(|c| (c, Extrapolator::new(c.order, c.points))).collect(),
            recent: Recent::new(room, interval),
            most: room,
            stretch: Vec::with_capacity(room + BATCH),
            start_limit: if settings.word("start_limit") == "robust" { START_SCALES * sigma } else { 0.0 },
            t: f64::NAN,
            predicted: [f64::NAN; 4],
            closest: Closest { expected: f64::NAN, code: NO_CANDIDATE },
        }
    }

    /// Predictions at `t`: on the times as they are if `exact`, else by the quickest way.
    #[inline]
    fn extrapolate(&mut self, exact: bool) {
        let ahead = self.recent.ahead(self.t);
        for ((candidate, extrapolator), predicted) in self.list.iter_mut().zip(&mut self.predicted) {
            *predicted = if self.recent.len() < candidate.need() {
                f64::NAN
            } else if exact {
                extrapolator.exact(&self.recent, self.t)
            } else {
                extrapolator.quick(&self.recent, self.t, ahead)
            };
        }
    }

    /// The prediction closest to `y` (within 1e-9 delta: the higher order), its distance, and whether the rounding of
    /// even times could change what follows from them. `newest` is the value of the newest point.
    #[inline]
    fn closest_to(&self, Bounded { y, delta }: Bounded, newest: f64) -> (Closest, f64, bool) {
        let tie = TIE * delta;
        let (mut best, mut distance) = (Closest { expected: f64::NAN, code: NO_CANDIDATE }, f64::INFINITY);
        let (mut margin, mut doubtful) = (0.0_f64, false);
        for ((candidate, _), &p) in self.list.iter().zip(&self.predicted) {
            if p.is_nan() {
                continue;
            }
            let d = (p - y).abs();
            margin = margin.max(1e-10 * delta + 1e-6 * (p - newest).abs());
            doubtful |= (d - (distance - tie)).abs() <= margin;
            if d < distance - tie {
                (best, distance) = (Closest { expected: p, code: candidate.code }, d);
            }
        }
        doubtful |= (distance - delta * (1.0 - TIE)).abs() <= margin;
        (best, distance, doubtful)
    }
}

impl Model for Candidates {
    type Sample = Bounded;
    type Prediction = Closest;

    fn group(&self) -> usize {
        self.start
    }

    fn passed_over(&self, group: &[(f64, Bounded)]) -> usize {
        let values: Vec<(f64, f64)> = group.iter().map(|(t, sample)| (*t, sample.y)).collect();
        let delta = group.iter().map(|(_, sample)| sample.delta).fold(0.0, f64::max);
        passed_over_by_third(&values, delta.max(self.start_limit))
    }

    fn start(&mut self, group: &[(f64, Bounded)]) {
        self.recent.clear();
        group.iter().for_each(|&(t, sample)| self.recent.push(t, sample.y));
    }

    #[inline]
    fn predict(&mut self, t: f64, _: usize, _: usize) {
        self.t = t;
        self.extrapolate(false);
    }

    fn prediction(&self) -> &Closest {
        &self.closest
    }

    #[inline]
    fn answer(&mut self, t: f64, sample: Bounded) -> Answer {
        let (mut closest, mut distance, doubtful) = self.closest_to(sample, self.recent.newest_value());
        if doubtful {
            // Too close to call by weights for exactly even times: the verdict must not depend on the way it was
            // reached.
            self.extrapolate(true);
            (closest, distance, _) = self.closest_to(sample, self.recent.newest_value());
        }
        self.closest = closest;
        if reaches(distance, sample.delta) {
            return Answer::Rejects;
        }
        self.recent.push(t, sample.y);
        Answer::Accepts
    }
}

/// Samples looked at in one go.
const BATCH: usize = 128;

impl Batch for Candidates {
    fn take_in(&mut self, t: &[f64], samples: &[Bounded], _: f64, said: &mut [Closest]) -> usize {
        // While the points of every candidate are even, all of them take part by their weights.
        if self.recent.even_points() < self.most {
            return 0;
        }
        let even = self.recent.even_ahead(&t[..t.len().min(BATCH)]);
        // One stretch of memory, written well before it is read: a read that meets the write of the sample before
        // waits until that is done with.
        self.stretch.clear();
        self.stretch.extend_from_slice(self.recent.newest_values(self.most));
        self.stretch.extend(samples[..even].iter().map(|s| s.y));
        let stretch = std::mem::take(&mut self.stretch);
        let mut taken = 0;
        for (values, &sample) in stretch.windows(self.most).zip(&samples[..even]) {
            for ((_, extrapolator), predicted) in self.list.iter_mut().zip(&mut self.predicted) {
                *predicted = extrapolator.next(values);
            }
            let (closest, distance, doubtful) = self.closest_to(sample, values[values.len() - 1]);
            if doubtful || reaches(distance, sample.delta) {
                break;
            }
            said[taken] = closest;
            taken += 1;
        }
        self.stretch = stretch;
        t[..taken].iter().zip(samples).for_each(|(&t, sample)| self.recent.push(t, sample.y));
        taken
    }
}

#[cfg(test)]
mod tests {
    use super::super::TwoSided;
    use super::*;
    use crate::method::Method;

    /// Parabola and line (in this order) with delta 1, which predict these values.
    fn predicting(parabola: f64, line: f64) -> Candidates {
        let mut model = Candidates::new(&Settings::defaults(TwoSided.about().params), 0.1, 1.0);
        model.predicted[..2].copy_from_slice(&[parabola, line]);
        model
    }

    /// Section 6, step 3: the candidate that came closest, within 1e-9 delta the higher order.
    #[test]
    fn of_candidates_equally_close_the_higher_order_is_remembered() {
        let code = |parabola: f64, line: f64| {
            predicting(parabola, line).closest_to(Bounded { y: 0.0, delta: 1.0 }, 0.0).0.code
        };
        assert_eq!(code(0.5, 0.5), 2);
        assert_eq!(code(0.5, 0.5 - 0.5e-9), 2, "within 1e-9 delta");
        assert_eq!(code(0.5, 0.5 - 2e-9), 1);
        assert_eq!(code(0.5, 0.6), 2);
        assert_eq!(code(f64::NAN, 0.6), 1);
    }

    /// Even times are taken for exactly even by the quick way: what stands within that rounding of a limit is left to
    /// the exact one.
    #[test]
    fn a_prediction_near_a_limit_is_doubtful() {
        let doubtful = |parabola: f64, line: f64, newest: f64| {
            predicting(parabola, line).closest_to(Bounded { y: 0.0, delta: 1.0 }, newest).2
        };
        assert!(!doubtful(0.5, 0.9, 0.5));
        // A distance of delta, less its tie.
        assert!(doubtful(1.0 - 1e-9, 3.0, 1.0));
        // Two candidates that are equally close but for the tie.
        assert!(doubtful(0.5, 0.5 - 1e-9, 0.5));
        // The farther a prediction reaches, the less is known of it: a millionth of 1,000 is 0.001.
        assert!(doubtful(0.9995, 3.0, 1000.0));
        assert!(!doubtful(0.9995, 3.0, 1.0));
    }
}
