//! The stand-in for the GPS velocity of \[000\].

use super::super::record::{Record, Signal, Wild};
use crate::experiment::Random;

/// Samples that were received.
pub(super) const SAMPLES: usize = 19_285;
/// Samples that were lost.
pub(super) const LOST: usize = 192;
/// Samples that are wild.
pub(super) const OUTLIERS: usize = 135;

/// Samples sent.
const SENT: usize = SAMPLES + LOST;
const INTERVAL: f64 = 0.1;
/// The long loss: the 21 samples after the one at 1239.5 s (2.1 s without data), across which the velocity steps.
const LOSS: std::ops::Range<usize> = 12_396..12_417;
const STEP: f64 = 2.0;
/// Quiet noise, and how much larger a burst is.
const QUIET: f64 = 0.5;
const BURST: f64 = 6.0;
/// Samples per burst, and how many make 9 % of the record.
const BURST_LENGTH: (usize, usize) = (20, 60);
const BURST_SHARE: f64 = 0.09;
/// Stretches on another level, their lengths in samples and their levels: an instrument in another mode, not
/// outliers.
const STRETCHES: usize = 15;
const STRETCH_LENGTH: (usize, usize) = (10, 80);
const STRETCH_LEVEL: (f64, f64) = (9.0, 20.0);
/// Single outliers, and the sizes of all: their mean square takes the residual from 1.08 to about the document's
/// 2.91 m/s.
const SINGLE: usize = 45;
const SIZE: (f64, f64) = (6.0, 55.0);

/// The record of a seed.
pub(super) fn record(seed: u64) -> Record {
    let mut random = Random::new(seed);
    let noise = noise(&mut random);
    let taken = &mut vec![false; SENT];
    let levels = stretches(&mut random, taken);
    let lost = lost(&mut random, taken);
    let (errors, wild) = outliers(&mut random, taken);
    let velocity = velocity();
    let clean = (0..SENT).map(|i| {
        let step = if i >= LOSS.start { STEP } else { 0.0 };
        velocity[i] + step + levels[i] + noise[i] * random.normal()
    });
    let clean: Vec<f64> = clean.collect();
    let received: Vec<usize> = (0..SENT).filter(|i| !lost[*i]).collect();
    let of = |all: &[f64]| received.iter().map(|&i| all[i]).collect::<Vec<f64>>();
    #[expect(clippy::cast_precision_loss, reason = "some thousand samples")]
    let t = received.iter().map(|&i| i as f64 * INTERVAL).collect();
    let vx = Signal::with_errors("vx_mps", 3, &of(&clean), &of(&errors));
    Record::new(Signal::new("t_s", 1, t), vec![vx], received.iter().map(|&i| wild[i]).collect())
}

/// Velocity by sample: thrust from the start, a second burn, drag and two turns, each a smooth bump of acceleration.
fn velocity() -> Vec<f64> {
    // Middle and half width in seconds, height in m/s2.
    const BUMPS: [(f64, f64, f64); 7] = [
        (25.0, 25.0, 22.0),
        (70.0, 30.0, 14.0),
        (260.0, 160.0, 3.0),
        (700.0, 300.0, -1.2),
        (1100.0, 120.0, 1.5),
        (1500.0, 250.0, -2.0),
        (1800.0, 140.0, -1.5),
    ];
    let mut v = 0.0;
    let step = |i: usize| {
        #[expect(clippy::cast_precision_loss, reason = "some thousand samples")]
        let t = i as f64 * INTERVAL;
        let bump = |&(middle, half, height): &(f64, f64, f64)| {
            let u: f64 = (t - middle) / half;
            let inside = (1.0 - u * u).max(0.0);
            height * inside * inside
        };
        v += BUMPS.iter().map(bump).sum::<f64>() * INTERVAL;
        v
    };
    (0..SENT).map(step).collect()
}

/// Deviation of the noise by sample.
fn noise(random: &mut Random) -> Vec<f64> {
    let mut deviation = vec![QUIET; SENT];
    let mut left = 0.0;
    #[expect(clippy::cast_precision_loss, reason = "some thousand samples")]
    let wanted = BURST_SHARE * SENT as f64;
    while left < wanted {
        let length = random.whole(BURST_LENGTH.0, BURST_LENGTH.1);
        let start = random.whole(0, SENT - length);
        for d in &mut deviation[start..start + length] {
            left += f64::from(u8::from(*d <= QUIET));
            *d = BURST * QUIET;
        }
    }
    deviation
}

/// A free place for `length` samples with `margin` on both sides, which it takes.
fn place(random: &mut Random, taken: &mut [bool], length: usize, margin: usize) -> usize {
    loop {
        let start = random.whole(200, SENT - 200 - length);
        if !taken[start - margin..start + length + margin].contains(&true) {
            taken[start..start + length].fill(true);
            return start;
        }
    }
}

fn stretches(random: &mut Random, taken: &mut [bool]) -> Vec<f64> {
    let mut levels = vec![0.0; SENT];
    taken[LOSS].fill(true);
    for _ in 0..STRETCHES {
        let length = random.whole(STRETCH_LENGTH.0, STRETCH_LENGTH.1);
        let start = place(random, taken, length, 30);
        levels[start..start + length].fill(random.sign() * random.between(STRETCH_LEVEL.0, STRETCH_LEVEL.1));
    }
    levels
}

fn lost(random: &mut Random, taken: &mut [bool]) -> Vec<bool> {
    let mut lost = vec![false; SENT];
    lost[LOSS].fill(true);
    let mut left = LOST - LOSS.len();
    while left > 0 {
        let length = random.whole(1, 3).min(left);
        let start = place(random, taken, length, 2);
        lost[start..start + length].fill(true);
        left -= length;
    }
    lost
}

fn outliers(random: &mut Random, taken: &mut [bool]) -> (Vec<f64>, Vec<Option<Wild>>) {
    let (mut errors, mut wild) = (vec![0.0; SENT], vec![None; SENT]);
    let mut left = OUTLIERS;
    while left > 0 {
        let single = left > OUTLIERS - SINGLE;
        // Never a last patch of one.
        let length = match left {
            _ if single => 1,
            2..=5 => left,
            6 => 3,
            _ => random.whole(2, 5),
        };
        let start = place(random, taken, length, 3);
        let size = random.sign() * random.between(SIZE.0, SIZE.1);
        errors[start..start + length].iter_mut().for_each(|e| *e = size + QUIET * random.normal());
        wild[start..start + length].fill(Some(if single { Wild::Isolated } else { Wild::Patch }));
        left -= length;
    }
    (errors, wild)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_stand_in_has_the_counts_of_the_document() {
        for seed in [1, 2, 3] {
            let record = record(seed);
            assert_eq!(record.wild.len(), SAMPLES);
            assert_eq!((record.count(Wild::Isolated), record.count(Wild::Patch)), (SINGLE, OUTLIERS - SINGLE));
            let t = &record.time.values;
            let longest = t.windows(2).map(|w| (w[0], w[1] - w[0])).max_by(|a, b| a.1.total_cmp(&b.1)).unwrap();
            assert!((longest.0 - 1239.5).abs() < 1e-9 && (longest.1 - 2.2).abs() < 1e-9, "{longest:?}");
            // Patches of two to five, never a single one among them.
            let runs = record.wild.chunk_by(|a, b| a == b).filter(|r| r[0] == Some(Wild::Patch));
            assert!(runs.clone().all(|r| (2..=5).contains(&r.len())), "{:?}", runs.map(<[_]>::len).max());
        }
    }
}
