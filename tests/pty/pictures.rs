//! All methods asked in the background, while the workbench goes on.

use super::{COMPACT, flagged, workbench};

#[test]
fn all_methods_are_asked_in_the_background_and_their_samples_walked() {
    let (_folder, mut terminal) = workbench(COMPACT);
    let before = flagged(&terminal);
    terminal.keys("C");
    // All but the one that needs a rate channel; half of them is nine.
    terminal.wait_for("18 methods; 9 or more flag");
    terminal.wait_for("left out: matched");
    terminal.wait_for("2 all methods");
    terminal.keys("gh");
    terminal.wait_for("of 18 methods flag it; sample");
    // They have said something, and nothing has changed.
    assert_eq!(flagged(&terminal), before);
    terminal.keys("C");
    terminal.wait_for("2 residual");
}
