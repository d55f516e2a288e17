//! The demonstration record: 40 minutes of a vehicle's velocity and altitude, one sample a second, after the
//! example of \[000\]: a dynamic start, lost samples (one long loss), a real step of the velocity while no sample came
//! in, isolated outliers and runs. The truth column marks the outliers of the velocity.

use super::record::{Record, Signal, Wild};
use super::{Experiment, Random};

/// The row of the table.
pub const EXPERIMENT: Experiment = Experiment {
    id: "demo",
    help: "the built-in record: velocity and altitude with lost samples, a step, isolated outliers and runs",
    source: "after [000]",
    record,
    seed: 19_285,
    reproduction: None,
};

/// Rows before some are lost.
const SAMPLES: usize = 2400;
/// Noise of the velocity, m/s: the 1.08 m/s of \[000\].
const VELOCITY_NOISE: f64 = 1.08;
/// Noise of the altitude, m.
const ALTITUDE_NOISE: f64 = 4.0;
/// The long loss, in seconds, across which the velocity steps.
const LOSS: std::ops::Range<usize> = 1240..1261;
/// The step, m/s: a real event, which no method may remove.
const STEP: f64 = 25.0;

/// Acceleration in m/s2 at second `t`: a thrust that builds up, burns on and ends, then drag and a turn.
fn acceleration(t: f64) -> f64 {
    let thrust = if t < 60.0 {
        t / 60.0
    } else if t < 700.0 {
        1.0 + 0.25 * (t / 90.0).sin()
    } else {
        0.0
    };
    let drag = if t < 700.0 { 0.0 } else { -0.35 * (-(t - 700.0) / 400.0).exp() };
    let turn = 0.3 * (t / 140.0).sin();
    thrust + drag + turn
}

/// Which samples are wild, and by how much.
fn wild(random: &mut Random) -> Vec<f64> {
    let mut error = vec![0.0; SAMPLES];
    for _ in 0..40 {
        let at = random.whole(30, SAMPLES - 20);
        error[at] = random.sign() * random.between(9.0, 120.0);
    }
    for _ in 0..9 {
        let (at, length) = (random.whole(60, SAMPLES - 40), random.whole(2, 6));
        let level = random.sign() * random.between(12.0, 60.0);
        error[at..at + length].iter_mut().for_each(|e| *e = level + random.normal());
    }
    error
}

fn record(seed: u64) -> Record {
    let mut random = Random::new(seed);
    let error = wild(&mut random);
    let altitude_error: Vec<usize> = (0..12).map(|_| random.whole(100, SAMPLES - 40)).collect();
    let lost: Vec<usize> = (0..25).map(|_| random.whole(10, SAMPLES - 10)).collect();
    let (mut t_s, mut vx_mps, mut alt_m, mut marks) = (Vec::new(), Vec::new(), Vec::new(), Vec::new());
    let (mut velocity, mut altitude) = (0.0, 120.0);
    for (i, &error) in error.iter().enumerate() {
        #[expect(clippy::cast_precision_loss, reason = "a few thousand seconds")]
        let t = i as f64;
        velocity += acceleration(t);
        altitude += 0.12 * velocity * (1.0 - t / 2600.0);
        let step = if i >= LOSS.start { STEP } else { 0.0 };
        let vx = velocity + step + VELOCITY_NOISE * random.normal() + error;
        let mut alt = altitude + ALTITUDE_NOISE * random.normal();
        if altitude_error.contains(&i) {
            alt += random.sign() * random.between(60.0, 900.0);
        }
        if LOSS.contains(&i) || lost.contains(&i) {
            continue;
        }
        t_s.push(t);
        vx_mps.push(vx);
        alt_m.push(alt);
        // Which of them are alone and which form a patch is nobody's question here.
        marks.push((error != 0.0).then_some(Wild::Isolated));
    }
    let signals = vec![Signal::new("vx_mps", 2, vx_mps), Signal::new("alt_m", 1, alt_m)];
    Record { time: Signal::new("t_s", 1, t_s), signals, wild: marks, truth: "vx_truth_outlier" }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::track::Source;

    #[test]
    fn the_built_in_record_is_what_the_simulation_gives() {
        let Some(Source::BuiltIn { bytes, .. }) = Source::built_in("wildpoint:demo") else {
            panic!("the demonstration record is built in");
        };
        assert!(
            bytes.as_ref() == EXPERIMENT.csv(EXPERIMENT.seed, 1).as_bytes(),
            "write it again: cargo run -- simulate demo > data/demo.csv"
        );
    }
}
