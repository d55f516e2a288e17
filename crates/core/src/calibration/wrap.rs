//! The period of a circular channel: a heading that goes from 359 to 0, an angle from pi to -pi.
//!
//! Name and unit propose a period; the data must consent: all values within one period, and where they jump, they
//! jump by nearly a whole period and go on from there.

use std::f64::consts::TAU;

/// A circular channel.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Wrap {
    /// Its period, in units of the channel.
    pub period: f64,
    /// How often it passes from one end to the other.
    pub crossings: usize,
    /// True where name or unit propose the period and the data consent; false where only the data speak for it.
    pub certain: bool,
}

/// Words in the names of angles that go round.
const ANGLES: [&str; 20] = [
    "heading",
    "hdg",
    "course",
    "cog",
    "cmg",
    "azimuth",
    "azi",
    "az",
    "bearing",
    "brg",
    "yaw",
    "direction",
    "dir",
    "wdir",
    "longitude",
    "lon",
    "lng",
    "long",
    "psi",
    "track",
];
/// Of the data alone, this many crossings are wanted.
const ENOUGH: usize = 3;
/// A jump is a crossing when it comes this near to a whole period.
const NEARLY: f64 = 0.8;
/// This share of the values may lie outside of one period, and of the jumps be none.
const WILD: f64 = 0.01;

/// The period of a channel of this name and unit with the values `y` (finite, in the order of the record); none where
/// it is not circular, or never passes its end. Linear in the number of samples.
#[must_use]
pub fn wrap(name: &str, unit: &str, y: &[f64]) -> Option<Wrap> {
    let proposed = proposed(name, unit);
    let candidates: &[f64] = if proposed.is_empty() && unit.is_empty() { &[360.0, TAU] } else { &proposed };
    candidates.iter().find_map(|&period| {
        let crossings = consent(y, period, proposed.is_empty())?;
        Some(Wrap { period, crossings, certain: !proposed.is_empty() })
    })
}

/// The periods that name and unit speak for.
fn proposed(name: &str, unit: &str) -> Vec<f64> {
    let unit = unit.to_lowercase();
    let degrees = unit.starts_with("deg") || unit.starts_with('°');
    let per_time = unit.contains('/') || unit == "degc" || unit == "°c";
    if degrees && !per_time {
        return vec![360.0];
    }
    if unit == "rad" || unit.starts_with("radian") {
        return vec![TAU];
    }
    let name = name.to_lowercase();
    let mut words = name.split(|c: char| !c.is_alphabetic());
    if unit == "h" || words.clone().any(|word| word == "hour" || word == "hod") {
        return vec![24.0];
    }
    if unit.is_empty() && words.any(|word| ANGLES.contains(&word)) { vec![360.0, TAU] } else { Vec::new() }
}

/// How often `y` passes from one end of the period to the other; none where the data speak against the period. Without
/// a name that proposes it, the values must reach both ends, and cross often.
fn consent(y: &[f64], period: f64, unnamed: bool) -> Option<usize> {
    let most = share(y.len(), WILD);
    let outside = |v: f64, low: f64| v < low - 1e-9 * period || v > low + period * (1.0 + 1e-9);
    // One more than may be is enough.
    let inside = |low: f64| y.iter().filter(|v| outside(**v, low)).nth(most).is_none();
    let low = [0.0, -period / 2.0].into_iter().find(|low| inside(*low))?;
    let (mut crossings, mut other) = (0, 0);
    for i in 1..y.len() {
        let jump = (y[i] - y[i - 1]).abs();
        if jump <= period / 2.0 {
            continue;
        }
        // After a wild point the record goes back.
        let stays = |i: usize, next: usize| y.get(next).is_none_or(|v| (v - y[i]).abs() <= period / 2.0);
        let before = i < 2 || stays(i - 1, i - 2);
        if jump >= NEARLY * period && jump <= period && before && stays(i, i + 1) {
            crossings += 1;
        } else {
            other += 1;
        }
    }
    if unnamed {
        let edge = |from: f64, to: f64| y.iter().any(|v| (from..=to).contains(v));
        let both = edge(low, low + 0.02 * period) && edge(low + 0.98 * period, low + period);
        return (both && crossings >= ENOUGH && other == 0).then_some(crossings);
    }
    (crossings > 0 && other <= most.max(crossings)).then_some(crossings)
}

/// This share of a number.
#[expect(clippy::cast_precision_loss, clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a count")]
fn share(n: usize, share: f64) -> usize {
    (n as f64 * share) as usize
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A turn of `rate` per sample, written between `low` and `low + period`.
    fn turn(n: usize, rate: f64, period: f64, low: f64) -> Vec<f64> {
        (0..n).map(|i| (i as f64 * rate - low).rem_euclid(period) + low).collect()
    }

    #[test]
    fn a_heading_that_crosses_north_has_the_period_of_its_unit() {
        let y = turn(500, 1.5, 360.0, 0.0);
        assert_eq!(wrap("hdg", "deg", &y), Some(Wrap { period: 360.0, crossings: 2, certain: true }));
        assert_eq!(wrap("course_over_ground", "", &y).map(|w| w.period), Some(360.0));
        let signed = turn(500, 1.5, 360.0, -180.0);
        assert_eq!(wrap("yaw", "deg", &signed).map(|w| w.period), Some(360.0));
        let radians = turn(500, 0.04, TAU, -TAU / 2.0);
        assert_eq!(wrap("yaw", "rad", &radians).map(|w| w.period), Some(TAU));
        assert_eq!(wrap("hour", "", &turn(500, 0.5, 24.0, 0.0)).map(|w| w.period), Some(24.0));
    }

    #[test]
    fn the_data_must_consent() {
        // A latitude, a heading that stays where it is, an angle that is counted on.
        assert!(wrap("lat", "deg", &turn(80, 0.1, 360.0, 0.0)).is_none());
        assert!(wrap("heading", "deg", &vec![12.0; 90]).is_none());
        let on: Vec<f64> = (0..900).map(f64::from).collect();
        assert!(wrap("heading", "deg", &on).is_none());
        // Wild points that go to the other end and back.
        let mut spiked = vec![5.0; 300];
        [30, 90, 150].into_iter().for_each(|i| spiked[i] = 355.0);
        assert!(wrap("heading", "deg", &spiked).is_none());
        assert!(wrap("speed", "m/s", &turn(500, 1.5, 360.0, 0.0)).is_none());
    }

    #[test]
    fn without_a_name_only_a_clear_case_is_offered() {
        let y = turn(2000, 1.5, 360.0, 0.0);
        assert_eq!(wrap("ch4", "", &y).map(|w| (w.period, w.certain)), Some((360.0, false)));
        assert!(wrap("ch4", "", &y[..300]).is_none(), "one crossing could be anything");
    }
}
