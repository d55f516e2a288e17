//! The fuzz targets on the stable toolchain: every find of the past again, then a few thousand seeded inputs.

#![expect(clippy::unwrap_used, reason = "a failed expectation is a failed test")]

mod fuzzing;

use std::path::Path;

use fuzzing::TARGETS;
use wildpoint::experiment::Random;

/// Seeded inputs per target.
const INPUTS: usize = 2000;

fn cases(target: &str) -> Vec<(String, Vec<u8>)> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("fuzz/regressions").join(target);
    let Ok(entries) = std::fs::read_dir(folder) else { return Vec::new() };
    let mut paths: Vec<_> = entries.map(|e| e.unwrap().path()).collect();
    paths.sort();
    paths.into_iter().map(|p| (p.display().to_string(), std::fs::read(p).unwrap())).collect()
}

/// Runs a body; a panic names the input.
fn run(body: fuzzing::Body, name: &str, data: &[u8]) {
    if std::panic::catch_unwind(|| body(data)).is_err() {
        panic!("{name}: {} bytes: {:?}", data.len(), String::from_utf8_lossy(data));
    }
}

#[test]
fn finds_of_the_past_stay_mended() {
    for (target, body) in TARGETS {
        for (name, data) in cases(target) {
            run(*body, &name, &data);
        }
    }
}

#[test]
fn seeded_inputs_break_no_law() {
    for (index, (target, body)) in TARGETS.iter().enumerate() {
        let mut random = Random::new(index as u64 + 1);
        let seeds: Vec<Vec<u8>> = cases(target).into_iter().map(|(_, data)| data).collect();
        for i in 0..INPUTS {
            let data = match seeds.get(i % (2 * seeds.len().max(1))) {
                Some(seed) => mutated(seed, &mut random),
                None => noise(&mut random),
            };
            run(*body, &format!("{target} input {i}"), &data);
        }
    }
}

/// `WILDPOINT_FUZZ_SECONDS=60 cargo test --test fuzz_cases -- --ignored --nocapture` runs each target for a minute.
#[test]
#[ignore = "runs as long as WILDPOINT_FUZZ_SECONDS says, for each target"]
#[expect(clippy::print_stdout, reason = "it says how many inputs there were")]
fn seeded_inputs_for_a_while() {
    let seconds = std::env::var("WILDPOINT_FUZZ_SECONDS").ok().and_then(|s| s.parse().ok()).unwrap_or(10);
    let wanted = std::env::var("WILDPOINT_FUZZ_TARGETS").unwrap_or_default();
    let asked = |target: &str| wanted.is_empty() || wanted.split(',').any(|w| w == target);
    for (index, (target, body)) in TARGETS.iter().enumerate().filter(|(_, (target, _))| asked(target)) {
        let mut random = Random::new(1000 + index as u64);
        let seeds: Vec<Vec<u8>> = cases(target).into_iter().map(|(_, data)| data).collect();
        let begun = std::time::Instant::now();
        let mut inputs = 0;
        while begun.elapsed().as_secs() < seconds {
            let data = match seeds.get(inputs % (seeds.len() + 1)) {
                Some(seed) => mutated(seed, &mut random),
                None => noise(&mut random),
            };
            run(*body, &format!("{target} input {inputs}"), &data);
            inputs += 1;
        }
        println!("{target}: {inputs} inputs");
    }
}

#[test]
fn every_target_is_run_by_the_fuzzer_too() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let manifest = std::fs::read_to_string(root.join("fuzz/Cargo.toml")).unwrap();
    for (target, _) in TARGETS {
        assert!(manifest.contains(&format!("name = \"{target}\"")), "{target} is not in fuzz/Cargo.toml");
        assert!(root.join(format!("fuzz/targets/{target}.rs")).exists(), "{target} has no file");
        assert!(!cases(target).is_empty(), "{target} has no seeds in fuzz/regressions");
    }
}

fn below(random: &mut Random, limit: usize) -> usize {
    ((random.uniform() * limit as f64) as usize).min(limit.saturating_sub(1))
}

fn noise(random: &mut Random) -> Vec<u8> {
    let length = below(random, 600);
    (0..length).map(|_| below(random, 256) as u8).collect()
}

/// A seed with a few bytes replaced, doubled or taken out.
fn mutated(seed: &[u8], random: &mut Random) -> Vec<u8> {
    let mut data = seed.to_vec();
    for _ in 0..=below(random, 6) {
        if data.is_empty() {
            break;
        }
        let at = below(random, data.len());
        match below(random, 4) {
            0 => data[at] = below(random, 256) as u8,
            1 => data[at] = b",;\n\"#0.-e:T"[below(random, 11)],
            2 => drop(data.drain(at..(at + 1 + below(random, 9)).min(data.len()))),
            _ => {
                let part = data[at..(at + 1 + below(random, 30)).min(data.len())].to_vec();
                data.splice(at..at, part);
            }
        }
    }
    data
}
