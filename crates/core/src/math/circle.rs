//! Values that go round: a heading from 359 to 0. Unwrapped they lie on a scale without a seam.

use super::order::median_in_place;
use super::pieces::{Check, PIECE};

/// A circular channel on a scale without a seam.
#[derive(Debug, Clone, PartialEq)]
pub struct Circle {
    period: f64,
    /// The smallest value that the record writes: 0, or minus half of the period.
    low: f64,
    /// One value for each measured sample, which differs from it by whole periods.
    pub unwrapped: Vec<f64>,
}

/// The samples that say where the next one is looked for.
const PLACES: usize = 3;
/// The steps that say how fast the channel turns.
const STEPS: usize = 5;

impl Circle {
    /// Unwraps `y`: each sample is taken at the turn that brings it nearest to where the samples before it lead. A wild
    /// point or two among those lead nowhere else, for medians are taken of them. Samples that are not among `kept` (none:
    /// all are) lead nothing.
    ///
    /// # Errors
    /// What `check` gives, which is asked before each piece of work.
    pub fn of<E>(y: &[f64], kept: Option<&[u32]>, period: f64, check: &impl Check<E>) -> Result<Self, E> {
        let negative = match kept {
            Some(kept) => kept.iter().any(|&i| y[i as usize] < 0.0),
            None => y.iter().any(|y| *y < 0.0),
        };
        let low = if negative { -period / 2.0 } else { 0.0 };
        let mut lead = Lead { period, places: Vec::with_capacity(PLACES), steps: Vec::with_capacity(STEPS) };
        let mut kept = kept.map(|kept| kept.iter().copied().peekable());
        let mut unwrapped = Vec::with_capacity(y.len());
        for (i, &y) in y.iter().enumerate() {
            if i.is_multiple_of(PIECE) {
                check()?;
            }
            let place = nearest(y, lead.next(), period);
            #[expect(clippy::cast_possible_truncation, reason = "the loader refuses files of 2^32 rows and more")]
            if kept.as_mut().is_none_or(|kept| kept.next_if_eq(&(i as u32)).is_some()) {
                lead.take(place);
            }
            unwrapped.push(place);
        }
        Ok(Self { period, low, unwrapped })
    }

    /// A value of the unwrapped scale as the record writes it.
    pub fn wrapped(&self, value: f64) -> f64 {
        let wrapped = value - self.period * ((value - self.low) / self.period).floor();
        // Rounding may end on the far end, which is the near one.
        if wrapped >= self.low + self.period { self.low } else { wrapped }
    }

    /// Brings values of the unwrapped scale to the turn of the measured samples `y`.
    pub fn back(&self, values: &mut [f64], y: &[f64]) {
        for ((value, y), unwrapped) in values.iter_mut().zip(y).zip(&self.unwrapped) {
            *value -= unwrapped - y;
        }
    }
}

/// `y` at the turn that is nearest to `place`.
fn nearest(y: f64, place: Option<f64>, period: f64) -> f64 {
    place.map_or(y, |place| y + period * ((place - y) / period).round())
}

/// Where the samples so far lead.
struct Lead {
    period: f64,
    /// The last samples, unwrapped.
    places: Vec<f64>,
    /// The steps between the last samples, the short way round.
    steps: Vec<f64>,
}

impl Lead {
    /// Where the next sample is looked for: from the middle of the last samples on at the usual step.
    fn next(&self) -> Option<f64> {
        if self.places.is_empty() {
            return None;
        }
        let usual = if self.steps.is_empty() { 0.0 } else { median_in_place(&mut self.steps.clone()) };
        #[expect(clippy::cast_precision_loss, reason = "three places at most")]
        let ahead = (self.places.len() + 1) as f64 / 2.0;
        Some(median_in_place(&mut self.places.clone()) + usual * ahead)
    }

    fn take(&mut self, place: f64) {
        if let Some(last) = self.places.last() {
            let step = place - last;
            keep(&mut self.steps, step - self.period * (step / self.period).round(), STEPS);
        }
        keep(&mut self.places, place, PLACES);
    }
}

/// Adds a value behind the last few.
fn keep(values: &mut Vec<f64>, value: f64, most: usize) {
    if values.len() == most {
        values.remove(0);
    }
    values.push(value);
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::pieces::{certain, to_the_end};

    fn unwrapped(y: &[f64], kept: Option<&[u32]>) -> Circle {
        certain(Circle::of(y, kept, 360.0, &to_the_end))
    }

    fn turn(n: usize, rate: f64) -> Vec<f64> {
        (0..n).map(|i| (350.0 + rate * i as f64).rem_euclid(360.0)).collect()
    }

    #[test]
    fn a_steady_turn_is_a_line_however_fast() {
        for rate in [1.0, -7.0, 100.0, -160.0] {
            let circle = unwrapped(&turn(200, rate), None);
            let line = circle.unwrapped.iter().enumerate().all(|(i, v)| (v - 350.0 - rate * i as f64).abs() < 1e-6);
            assert!(line, "{rate}");
            assert!(circle.unwrapped.iter().zip(turn(200, rate)).all(|(u, y)| (circle.wrapped(*u) - y).abs() < 1e-6));
        }
    }

    #[test]
    fn wild_points_leave_the_rest_on_its_turn() {
        let mut y = turn(300, 2.0);
        for (i, wild) in [(3, 170.0), (50, 181.0), (51, 3.0), (200, 299.0)] {
            y[i] = (y[i] + wild).rem_euclid(360.0);
        }
        let wild = [3, 50, 51, 200];
        let circle = unwrapped(&y, None);
        let good = |i: usize| (circle.unwrapped[i] - 350.0 - 2.0 * i as f64).abs() < 1e-6;
        assert!((0..300).all(|i| wild.contains(&i) || good(i)));
    }

    #[test]
    fn samples_that_are_left_out_lead_nowhere() {
        let mut y = turn(60, 2.0);
        (20..40).for_each(|i| y[i] = -9999.0);
        let kept: Vec<u32> = (0..60).filter(|i| !(20..40).contains(i)).collect();
        let circle = unwrapped(&y, Some(&kept));
        // Twenty samples at two degrees are within half a turn.
        assert!((circle.unwrapped[59] - 468.0).abs() < 1e-6, "{}", circle.unwrapped[59]);
        assert!(circle.low == 0.0);
    }

    #[test]
    fn a_record_with_negative_angles_is_written_from_minus_half_a_turn() {
        let circle = unwrapped(&[170.0, 175.0, -180.0, -175.0], None);
        assert_eq!(circle.unwrapped, [170.0, 175.0, 180.0, 185.0]);
        assert_eq!((circle.wrapped(182.0), circle.wrapped(180.0), circle.wrapped(-180.0)), (-178.0, -180.0, -180.0));
    }
}
