//! The stand-in for the radar record of a ballistic missile of \[003\].

use super::super::record::{Record, Signal, Wild};
use crate::experiment::Random;

/// What the stand-in is.
pub(super) const STAND_IN: &str = "The document flies a ballistic missile in a commercial simulator and says neither \
     on which path nor how large the outliers are. Here: free flight of a lofted shot about a spherical Earth, 2384 s \
     at 1 Hz, seen by a radar a few hundred km beside it, and the height that follows from range (100 m) and elevation (0.1 \
     deg) to first order, with noise of 0.3 to 0.6 km. 10 % outliers: half alone, half in patches of 2 to 8 of about \
     the same error, 2 to 10 km either way. Paper settings as the \
     document prescribes them, and the defaults of this program.";

const SAMPLES: usize = 2384;
/// Half of them alone, half in patches.
const OUTLIERS: usize = 238;
const PATCH: (usize, usize) = (2, 8);
/// Sizes of the errors, km.
const SIZE: (f64, f64) = (2.0, 10.0);

/// km and km^3/s^2.
const EARTH: f64 = 6371.0;
const GRAVITY: f64 = 398_600.441_8;
/// Upward and horizontal speed at the start, km/s, at this height: burn-out of the last stage.
const UP: f64 = 6.47;
const ALONG: f64 = 0.25;
const START_HEIGHT: f64 = 100.0;
/// Place of the radar, km on the ground: along the track and beside it.
const RADAR: (f64, f64) = (200.0, 200.0);
/// Noise of range in km and of elevation in radians.
const RANGE_NOISE: f64 = 0.1;
const ANGLE_NOISE: f64 = 0.1 * std::f64::consts::PI / 180.0;
/// Steps of integration per second.
const STEPS: usize = 20;

/// The record of a seed.
pub(super) fn record(seed: u64) -> Record {
    let mut random = Random::new(seed);
    let clean: Vec<f64> = arc().iter().map(|p| p.height + p.deviation * random.normal()).collect();
    let (errors, wild) = outliers(&mut random);
    #[expect(clippy::cast_precision_loss, reason = "some thousand samples")]
    let t = (0..SAMPLES).map(|i| i as f64).collect();
    Record::new(Signal::new("t_s", 0, t), vec![Signal::with_errors("height_km", 4, &clean, &errors)], wild)
}

/// A point of the arc: its height, and the deviation of the height that the radar measures.
struct Point {
    height: f64,
    deviation: f64,
}

/// The free flight, by leapfrog steps: the four operations and square roots only.
fn arc() -> Vec<Point> {
    #[expect(clippy::cast_precision_loss, reason = "a few steps")]
    let h = 1.0 / STEPS as f64;
    let pull = |[x, y]: [f64; 2]| {
        let square = x * x + y * y;
        let per = -GRAVITY / (square * square.sqrt());
        [per * x, per * y]
    };
    let (mut at, mut v) = ([0.0, EARTH + START_HEIGHT], [ALONG, UP]);
    let mut points = Vec::with_capacity(SAMPLES);
    for _ in 0..SAMPLES {
        points.push(seen(at));
        for _ in 0..STEPS {
            let a = pull(at);
            let half = [v[0] + a[0] * h / 2.0, v[1] + a[1] * h / 2.0];
            at = [at[0] + half[0] * h, at[1] + half[1] * h];
            let a = pull(at);
            v = [half[0] + a[0] * h / 2.0, half[1] + a[1] * h / 2.0];
        }
    }
    points
}

/// What the radar sees of the place `at` in the plane of the flight.
fn seen(at: [f64; 2]) -> Point {
    let length = |v: [f64; 3]| (v[0] * v[0] + v[1] * v[1] + v[2] * v[2]).sqrt();
    let place = [at[0], at[1], 0.0];
    let up = [RADAR.0, EARTH, RADAR.1];
    let radar = up.map(|c| c * EARTH / length(up));
    let sight = [place[0] - radar[0], place[1] - radar[1], place[2] - radar[2]];
    let range = length(sight);
    let sine = (sight[0] * radar[0] + sight[1] * radar[1] + sight[2] * radar[2]) / (range * EARTH);
    let cosine = (1.0 - sine * sine).max(0.0).sqrt();
    let (of_range, of_angle) = (sine * RANGE_NOISE, range * cosine * ANGLE_NOISE);
    Point { height: length(place) - EARTH, deviation: (of_range * of_range + of_angle * of_angle).sqrt() }
}

fn outliers(random: &mut Random) -> (Vec<f64>, Vec<Option<Wild>>) {
    let (mut errors, mut wild) = (vec![0.0; SAMPLES], vec![None; SAMPLES]);
    let mut left = OUTLIERS;
    while left > 0 {
        let single = left > OUTLIERS / 2;
        let length = match left {
            _ if single => 1,
            2..=8 => left,
            9 => 4,
            _ => random.whole(PATCH.0, PATCH.1),
        };
        let start = random.whole(1, SAMPLES - 1 - length);
        if wild[start - 1..=start + length].iter().any(Option::is_some) {
            continue;
        }
        let size = random.sign() * random.between(SIZE.0, SIZE.1);
        errors[start..start + length].iter_mut().for_each(|e| *e = size + 0.1 * size * random.normal());
        wild[start..start + length].fill(Some(if single { Wild::Isolated } else { Wild::Patch }));
        left -= length;
    }
    (errors, wild)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_flight_keeps_its_energy_and_comes_down_again() {
        let arc = arc();
        let top = arc.iter().map(|p| p.height).fold(0.0, f64::max);
        // vis-viva: at the top all of the vertical speed has become height; the angular momentum is that of the start.
        let r = EARTH + START_HEIGHT;
        let (energy, momentum) = ((UP * UP + ALONG * ALONG) / 2.0 - GRAVITY / r, r * ALONG);
        let root = (GRAVITY * GRAVITY + 2.0 * energy * momentum * momentum).sqrt();
        let apogee = (-GRAVITY - root) / (2.0 * energy) - EARTH;
        assert!((top - apogee).abs() < 0.01, "{top} {apogee}");
        let last = arc.last().unwrap().height;
        assert!((0.0..400.0).contains(&last) && arc.iter().all(|p| p.height > 0.0), "{last}");
        let (low, high) = arc.iter().fold((f64::MAX, 0.0_f64), |(l, h), p| (l.min(p.deviation), h.max(p.deviation)));
        assert!(low > 0.3 && high < 0.6, "noise of {low} to {high} km");
    }

    #[test]
    fn a_tenth_of_the_record_is_wild() {
        let record = record(1);
        assert_eq!((record.count(Wild::Isolated), record.count(Wild::Patch)), (119, 119));
        let runs = record.wild.chunk_by(|a, b| a == b).filter(|r| r[0] == Some(Wild::Patch));
        assert!(runs.clone().all(|r| (2..=8).contains(&r.len())));
    }
}
