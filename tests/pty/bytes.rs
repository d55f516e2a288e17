//! What goes over the wire: every byte of every step, and nothing when nothing happens.

use super::{COMPACT, Terminal, WIDE, workbench};

/// How many bytes it takes until `shown` is on the screen, with its result, after `keys`; in as many frames as it
/// takes.
fn bytes_for(terminal: &mut Terminal, keys: &str, shown: &str) -> usize {
    let before = terminal.bytes();
    terminal.keys(keys);
    terminal.wait_for(shown);
    terminal.settle();
    terminal.bytes() - before
}

/// Below the trace, the workbench says what a step of the parameter changes, and nothing more is to come.
fn advised(terminal: &Terminal, size: (u16, u16)) {
    terminal.wait_for(if size == WIDE { "f sets k" } else { "↓+" });
}

#[test]
fn a_threshold_step_keeps_to_the_bar_of_the_design() {
    for size in [WIDE, COMPACT] {
        let (_folder, mut terminal) = workbench(size);
        advised(&terminal, size);
        let mut k = 40;
        let (up, down) = ([(".", 1)].repeat(20), [(",", -1)].repeat(20));
        for (key, by) in up.into_iter().chain(down) {
            let next = k + by;
            let shown = format!("k {}.{} → {}.{}", k / 10, k % 10, next / 10, next % 10);
            let bytes = bytes_for(&mut terminal, key, &shown);
            assert!(bytes < 400, "{shown} takes {bytes} bytes at {size:?}");
            k = next;
        }
    }
}

#[test]
fn each_step_of_a_review_keeps_to_the_bar_of_the_design() {
    let (folder, mut terminal) = workbench(WIDE);
    advised(&terminal, WIDE);
    // The first wild points of the record are in rows 61, 91, 200, 222, 239; the last one is in row 2307.
    let steps = [
        ("n", "#91 "),
        ("n", "#200 "),
        ("p", "#91 "),
        ("p", "#61 "),
        ("p", "#2307 "),
        ("n", "#61 "),
        ("N", "#91 "),
        ("P", "#61 "),
        ("a", "accepted row 61"),
        ("r", "rejected row 91"),
        (" ", "#200 "),
        ("x", "#200 "),
        ("u", "undone"),
    ];
    for (key, shown) in steps {
        let bytes = bytes_for(&mut terminal, key, shown);
        assert!(bytes < 1500, "{key:?} takes {bytes} bytes");
    }
    // Another workbench starts, works and ends: all that time this one has nothing to say.
    let before = terminal.bytes();
    let mut other = Terminal::start(&folder.path(""), "demo.csv", WIDE, &[]);
    other.settle();
    other.keys("n");
    other.wait_for("#91 ");
    other.keys("q");
    assert_eq!(other.end().0, 0);
    assert_eq!(terminal.bytes(), before, "an idle workbench writes nothing");
}

#[test]
fn a_burst_of_keys_is_drawn_in_few_frames() {
    let (_folder, mut terminal) = workbench(WIDE);
    terminal.wait_for("f sets k");
    let frames = terminal.frames();
    terminal.keys(&".".repeat(100));
    terminal.wait_for("k 13.9 → 14.0");
    terminal.settle();
    let drawn = terminal.frames() - frames;
    assert!(drawn < 50, "{drawn} frames for 100 keys that came at once");
}
