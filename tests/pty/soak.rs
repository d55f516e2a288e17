//! A soak of the workbench in a terminal: random keys, windows that change their size, records that grow, a disk that
//! is full and then is not, kills and signals. No panic, no hang, no lost decision.
//!
//! `cargo test` runs a few rounds; `fuzz/soak SECONDS` runs as many as fit into the time and prints what was done. Each
//! round follows from its seed, which a failure names (`WILDPOINT_SOAK_SEED=SEED` begins there).

#[path = "soak/desk.rs"]
mod desk;
#[path = "soak/random.rs"]
mod random;
#[path = "soak/rounds.rs"]
mod rounds;

use std::time::{Duration, Instant};

/// Rounds of a plain `cargo test`.
const ROUNDS: u64 = 4;

fn number(name: &str) -> Option<u64> {
    std::env::var(name).ok().map(|text| text.parse().unwrap())
}

#[test]
#[expect(clippy::print_stdout, reason = "figures for whoever runs it with --nocapture")]
fn no_panic_no_hang_and_no_lost_decision() {
    let begun = Instant::now();
    let time = number("WILDPOINT_SOAK_SECONDS").map(Duration::from_secs);
    let first = number("WILDPOINT_SOAK_SEED").unwrap_or(1);
    let mut counts = rounds::Counts::default();
    for seed in first.. {
        let over = time.map_or(seed >= first + ROUNDS, |time| begun.elapsed() >= time);
        if over {
            break;
        }
        let round = std::panic::AssertUnwindSafe(|| rounds::round(seed, &mut counts));
        if let Err(panic) = std::panic::catch_unwind(round) {
            println!("seed {seed} failed after {} s: {counts}", begun.elapsed().as_secs());
            std::panic::resume_unwind(panic);
        }
        if seed.is_multiple_of(50) {
            println!("{} s: {counts}", begun.elapsed().as_secs());
        }
    }
    println!("{} s: {counts}", begun.elapsed().as_secs());
}
