//! A window that changes its size at any moment.

use rand_pcg::Pcg64Mcg;
use rand_pcg::rand_core::{Rng, SeedableRng};

use super::terminal::title;
use super::{WIDE, workbench};

/// Keys whose frames differ, some with computations under way, some with a drawer or a list over the panels.
const KEYS: [&str; 12] = ["r", "n", ".", ",", "u", "3", "4", "1", "w", "R", "d", "\x0c"];

/// Sizes at which the layout changes, and the ends of what may come.
const EDGES: [(u16, u16); 8] = [(0, 0), (1, 1), (39, 9), (40, 10), (80, 24), (110, 24), (160, 50), (1000, 300)];

fn size(random: &mut Pcg64Mcg) -> (u16, u16) {
    let mut below = |n: u32| random.next_u32() % n;
    match below(4) {
        0 => EDGES[below(8) as usize],
        1 => (below(1001) as u16, below(301) as u16),
        _ => (below(200) as u16, below(60) as u16),
    }
}

#[test]
fn two_hundred_resizes_against_repeating_keys_end_nothing() {
    for seed in 0..3 {
        let mut random = Pcg64Mcg::seed_from_u64(seed);
        let (_folder, mut terminal) = workbench(WIDE);
        for _ in 0..200 {
            // Keys and the new size arrive together: the one is drawn while the other is on its way.
            for _ in 0..=random.next_u32() % 3 {
                terminal.keys(KEYS[random.next_u32() as usize % KEYS.len()]);
            }
            terminal.resize(size(&mut random));
            if random.next_u32().is_multiple_of(4) {
                let before = terminal.bytes();
                terminal.keys("\x0c");
                terminal.wait_more(before);
            }
        }
        terminal.resize((80, 24));
        terminal.keys("\x0c");
        terminal.wait_until("the title", |screen| title(screen).contains("demo.csv"));
        terminal.keys(":q!\r");
        let (status, raw) = terminal.end();
        assert_eq!(status, 0, "seed {seed}: {}", String::from_utf8_lossy(&raw[raw.len().saturating_sub(2000)..]));
    }
}
