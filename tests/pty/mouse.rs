//! The mouse is taken and given back, and points at what is under it.

use super::{COMPACT, Folder, Terminal, WIDE, workbench};

/// The modes of the mouse, in the order in which they are switched on.
const MODES: [&str; 3] = ["1000", "1002", "1006"];

fn on(raw: &[u8], mode: &str) -> bool {
    let text = String::from_utf8_lossy(raw);
    let (high, low) = (text.rfind(&format!("\x1b[?{mode}h")), text.rfind(&format!("\x1b[?{mode}l")));
    high > low
}

#[test]
fn movement_alone_is_never_asked_for() {
    let (_folder, mut terminal) = workbench(COMPACT);
    assert!(MODES.iter().all(|mode| on(&terminal.raw(), mode)));
    terminal.keys("q");
    let (_, raw) = terminal.end();
    // Mode 1003 reports every movement of the hand, 1015 another form of report.
    let text = String::from_utf8_lossy(&raw);
    assert!(!text.contains("?1003h") && !text.contains("?1015h"));
    assert!(MODES.iter().all(|mode| !on(&raw, mode)));
}

#[test]
fn the_mouse_is_left_to_the_terminal_on_demand_and_taken_back() {
    let folder = Folder::with_demo();
    let mut terminal = Terminal::start(&folder.path(""), "--no-mouse demo.csv", COMPACT, &[]);
    terminal.settle();
    assert!(MODES.iter().all(|mode| !on(&terminal.raw(), mode)));
    terminal.keys("M");
    terminal.wait_for("the mouse points and zooms");
    assert!(MODES.iter().all(|mode| on(&terminal.raw(), mode)));
    terminal.keys("M");
    terminal.wait_for("the mouse selects text");
    assert!(MODES.iter().all(|mode| !on(&terminal.raw(), mode)));
    terminal.keys("q");
    let (status, raw) = terminal.end();
    assert_eq!(status, 0);
    assert!(MODES.iter().all(|mode| !on(&raw, mode)));
}

#[test]
fn a_click_in_the_queue_goes_to_the_flag_and_a_second_zooms_to_it() {
    let (_folder, mut terminal) = workbench(WIDE);
    // The row of the flag in row 200 of the record, as the screen has it; columns and rows of reports count from 1.
    let row = terminal.look(|screen| {
        let rows: Vec<String> = screen.rows(82, 38).collect();
        rows.iter().position(|line| line.trim_start().starts_with("200 ")).unwrap() + 1
    });
    terminal.keys(&format!("\x1b[<0;90;{row}M\x1b[<0;90;{row}m"));
    terminal.wait_for("#200 ");
    // The current flag stands in the same row until the queue scrolls, which it does from its middle on only.
    terminal.keys(&format!("\x1b[<0;90;{row}M\x1b[<0;90;{row}m"));
    terminal.wait_for("of 2,356 samples");
}

#[test]
fn a_double_click_in_a_list_takes_what_was_under_it() {
    let (_folder, mut terminal) = workbench(COMPACT);
    terminal.keys("m");
    terminal.wait_for("type to filter");
    let row = terminal.look(|screen| {
        let rows: Vec<String> = screen.rows(0, 80).collect();
        rows.iter().position(|line| line.contains(" hampel ")).unwrap() + 1
    });
    // Both clicks come at once, as a hand makes them; the list may move under the first.
    terminal.keys(&format!("\x1b[<0;20;{row}M\x1b[<0;20;{row}m").repeat(2));
    terminal.wait_for("hampel: Hampel identifier");
    terminal.settle();
}

#[test]
fn half_a_report_presses_no_key() {
    let (_folder, mut terminal) = workbench(COMPACT);
    terminal.keys("z");
    terminal.wait_for("of 2,356 samples");
    // `0` would show the whole record, `M` give the mouse away.
    terminal.keys("\x1b");
    terminal.keys("[<0;5");
    terminal.keys(";5M");
    terminal.keys("n");
    terminal.wait_for("#91 ");
    terminal.look(|screen| {
        let text = screen.contents();
        assert!(text.contains("of 2,356 samples") && !text.contains("the mouse"), "{text}");
    });
}

#[test]
#[cfg(target_os = "linux")]
fn a_suspended_workbench_gives_mouse_and_screen_back_and_takes_them_again() {
    let (_folder, mut terminal) = workbench(COMPACT);
    terminal.keys("\x1a");
    terminal.wait_stopped();
    let raw = terminal.raw();
    assert!(["1049", "2004"].iter().chain(&MODES).all(|mode| !on(&raw, mode)));
    terminal.look(|screen| assert!(!screen.alternate_screen() && !screen.hide_cursor()));
    terminal.signal("CONT");
    terminal.wait_until("the screen again", |screen| screen.alternate_screen() && screen.hide_cursor());
    terminal.wait_for("5 flag 1 of ");
    let raw = terminal.raw();
    assert!(["1049", "2004"].iter().chain(&MODES).all(|mode| on(&raw, mode)));
}
