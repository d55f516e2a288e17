//! `floor = record` stays the calibration of earlier versions, to the last bit: saved sessions name it.

use wildpoint_core::Series;
use wildpoint_core::calibration::{Calibration, Rules, calibrate};
use wildpoint_core::stop::{Stop, Stopped};

/// Noise of deviation close to 1 from a fixed walk of basic operations, which is the same on every machine.
fn noise(i: usize) -> f64 {
    let uniform = |k: usize| ((i * 7919 % 104_729) as f64 * 0.618_033_988_749_895 * (k * k + 1) as f64).fract();
    (1..=12).map(uniform).sum::<f64>() - 6.0
}

fn by(rules: Rules, y: &[f64]) -> Result<Calibration, Stopped> {
    let t: Vec<f64> = (0..y.len()).map(|i| i as f64).collect();
    calibrate(&Series::new(&t, y), rules, &Stop::never())
}

/// FNV-1a over the bits of the limits, the objections and the tails.
fn digest(found: &Calibration) -> u64 {
    let all = found.limits.iter().chain(&found.objections).chain([&found.tails]);
    all.flat_map(|x| x.to_bits().to_le_bytes())
        .fold(0xcbf2_9ce4_8422_2325, |hash, byte| (hash ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3))
}

/// Quiet and rough noise with a few wild points; steps of 0.5 that are held; a record long enough for blocks; noise that
/// shows no end.
fn records() -> [Vec<f64>; 4] {
    let wild = |i: usize| if i % 611 == 300 { 40.0 } else { 0.0 };
    let rough = |i: usize| noise(i) * if (2000..2300).contains(&i) { 10.0 } else { 1.0 };
    [
        (0..6000).map(|i| rough(i) + wild(i)).collect(),
        (0..3000).map(|i| (noise(i / 2) * 2.0).round() / 2.0 + wild(i)).collect(),
        (0..40_000).map(|i| 0.01 * i as f64 + noise(i) + wild(i)).collect(),
        (0..6000).map(|i| noise(i) * noise(i + 7)).collect(),
    ]
}

/// The digests were made by commit d5ec917, which had these rules alone.
#[test]
fn the_calibration_of_earlier_versions_has_the_same_bits() {
    let digests = records().map(|y| digest(&by(Rules::Record, &y).unwrap()));
    assert_eq!(
        digests,
        [0x8068_3362_8f3f_e2ee, 0x8309_9c71_b708_fda1, 0x6d5e_df06_a041_7b8e, 0xed6a_0c3a_523d_eb11],
        "{digests:#x?}"
    );
}

/// If both rules gave the same, the test above could not tell them apart.
#[test]
fn the_rules_differ_on_such_records() {
    let [.., y] = records();
    let [earlier, now] = [Rules::Record, Rules::Noise].map(|rules| by(rules, &y).unwrap());
    assert!(now.limits.iter().zip(&earlier.limits).any(|(now, earlier)| now > earlier));
    assert!(earlier.whole.is_none() && now.whole.is_some());
}
