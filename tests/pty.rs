//! The workbench in a terminal, from the first frame to the last byte.

#![cfg(unix)]
#![expect(clippy::unwrap_used, reason = "a failed expectation is a failed test")]

#[path = "pty/bytes.rs"]
mod bytes;
#[path = "pty/pictures.rs"]
mod chart_actions;
#[path = "pty/command_line.rs"]
mod command_line;
#[path = "pty/files.rs"]
mod files;
#[cfg(target_os = "linux")]
#[path = "pty/full_disk.rs"]
mod full_disk;
#[path = "pty/growing.rs"]
mod growing;
#[path = "pty/journal.rs"]
mod journal;
#[path = "pty/mouse.rs"]
mod mouse;
mod program;
#[path = "pty/resize.rs"]
mod resize;
#[cfg(target_os = "linux")]
#[path = "pty/soak.rs"]
mod soak;
#[cfg(target_os = "linux")]
#[path = "pty/stuck.rs"]
mod stuck;
mod terminal;

use program::Folder;
use terminal::{Terminal, title};

const COMPACT: (u16, u16) = (80, 24);
const WIDE: (u16, u16) = (120, 40);

/// The workbench on the demonstration record, with its first result.
fn workbench(size: (u16, u16)) -> (Folder, Terminal) {
    let folder = Folder::with_demo();
    let terminal = Terminal::start(&folder.path(""), "demo.csv", size, &[]);
    terminal.settle();
    (folder, terminal)
}

/// The number before ` flagged`.
fn flagged(terminal: &Terminal) -> usize {
    let title = terminal.look(title);
    title.split(" flagged").next().and_then(|left| left.rsplit(' ').next()).unwrap().parse().unwrap()
}

/// The alternate screen is left, the cursor shown, bracketed paste and the mouse off, all after they were the other way round.
fn assert_restored(raw: &[u8]) {
    let text = String::from_utf8_lossy(raw);
    for (taken, given_back) in [
        ("\x1b[?1049h", "\x1b[?1049l"),
        ("\x1b[?25l", "\x1b[?25h"),
        ("\x1b[?2004h", "\x1b[?2004l"),
        ("\x1b[?1000h", "\x1b[?1000l"),
        ("\x1b[?1002h", "\x1b[?1002l"),
        ("\x1b[?1006h", "\x1b[?1006l"),
    ] {
        let (from, to) = (text.rfind(taken), text.rfind(given_back));
        assert!(from.is_some() && from < to, "{given_back:?} does not follow {taken:?}");
    }
}

#[test]
fn the_first_frame_shows_record_trace_and_flags() {
    for size in [COMPACT, WIDE] {
        let (_folder, terminal) = workbench(size);
        terminal.look(|screen| {
            let text = screen.contents();
            assert!(title(screen).contains("demo.csv · vx_mps [m/s] (1/2)"), "{text}");
            assert!(text.contains("1 trace all 2,356 samples") && text.contains("5 flag 1 of "), "{text}");
            // A curve, and the rail under it.
            assert!(text.chars().any(|c| ('\u{2801}'..='\u{28ff}').contains(&c)), "{text}");
            assert!(text.lines().any(|line| line.starts_with(" flags ") && line.contains('▁')), "{text}");
            assert!(screen.alternate_screen() && screen.hide_cursor() && screen.bracketed_paste());
        });
    }
}

#[test]
fn keys_change_channel_threshold_and_method() {
    let (_folder, mut terminal) = workbench(COMPACT);
    terminal.keys("d");
    terminal.wait_for("demo.csv · alt_m [m] (2/2)");
    terminal.keys("d");
    terminal.wait_for("demo.csv · vx_mps [m/s] (1/2)");
    terminal.settle();
    let before = flagged(&terminal);
    terminal.keys(".");
    terminal.wait_for("k ‹4.1›");
    terminal.keys(":set k 40\r");
    terminal.wait_for("k ‹40.0›");
    terminal.settle();
    assert!(flagged(&terminal) < before, "the wild points of the simulation begin at 9 m/s, 40 sigma are 43 m/s");
    terminal.keys("m");
    terminal.wait_for("filter:");
    terminal.keys("hampel\r");
    terminal.wait_for("hampel: Hampel identifier");
    terminal.settle();
    terminal.look(|screen| assert!(screen.contents().contains("\n  hampel  "), "{}", screen.contents()));
}

#[test]
fn flags_are_walked_decided_on_and_undone() {
    let (_folder, mut terminal) = workbench(COMPACT);
    let before = flagged(&terminal);
    // The first wild points of the record are in rows 61, 91 and 200.
    terminal.wait_for("#61 ");
    terminal.keys("n");
    terminal.wait_for("#91 ");
    terminal.keys("a");
    terminal.wait_for("accepted row 91");
    terminal.wait_for("#200 ");
    terminal.keys("r");
    terminal.wait_for("rejected row 200");
    terminal.settle();
    assert_eq!(flagged(&terminal), before - 1);
    terminal.keys("u");
    terminal.wait_for("undone: row 200 normal");
    terminal.settle();
    assert_eq!(flagged(&terminal), before);
    terminal.look(|screen| assert!(title(screen).contains("[+]"), "one decision is still there"));
}

#[test]
fn what_is_saved_and_exported_can_be_replayed() {
    let (folder, mut terminal) = workbench(WIDE);
    terminal.keys("nar");
    terminal.wait_for("rejected row 200");
    terminal.settle();
    terminal.keys(":w reviewed.toml\r");
    terminal.wait_for("saved reviewed.toml");
    terminal.keys(":export reviewed.csv\r");
    terminal.wait_for("wrote reviewed.csv");
    terminal.look(|screen| assert!(!title(screen).contains("[+]")));
    terminal.keys("q");
    assert_eq!(terminal.end().0, 0, "nothing is unsaved: q does not ask");
    assert_eq!(folder.done("replay --check reviewed.toml"), "reviewed.toml: same result\n");
    folder.done("replay reviewed.toml -o replayed.csv");
    assert!(folder.text("replayed.csv") == folder.text("reviewed.csv"));
    let session = folder.text("reviewed.toml");
    assert!(
        session.contains(
            "{ row = 91, time = \"91.0\", value = \"55.21\", verdict = \"outlier\", at = \"2026-01-01T00:00:00Z\" }"
        ),
        "{session}"
    );
    assert!(session.contains("{ row = 200, ") && session.matches("verdict = ").count() == 2, "{session}");
    assert_eq!(folder.names(), ["demo.csv", "replayed.csv", "reviewed.csv", "reviewed.toml"]);
}

#[test]
fn nothing_is_overwritten_without_being_told_to() {
    let (folder, mut terminal) = workbench(COMPACT);
    std::fs::write(folder.path("there.toml"), "kept").unwrap();
    terminal.keys(":w there.toml\r");
    terminal.wait_for("there.toml already exists");
    terminal.keys("\x1b");
    terminal.wait_until("no question", |screen| !screen.contents().contains("already exists"));
    terminal.keys(":export demo.csv\r");
    terminal.wait_for("demo.csv: this is the input");
    assert_eq!(folder.text("there.toml"), "kept");
    terminal.keys(":w there.toml\r");
    terminal.wait_for("overwrite it");
    terminal.keys("o");
    terminal.wait_for("saved there.toml");
    assert!(folder.text("there.toml").starts_with("format = 2\n"));
}

#[test]
fn a_session_that_another_workbench_saved_meanwhile_is_not_written_over_unseen() {
    let (folder, mut terminal) = workbench(WIDE);
    terminal.keys("a:w s.toml\r");
    terminal.wait_for("saved s.toml");
    // The other one opens it, decides and saves; its own file needs no question.
    let mut other = Terminal::start(&folder.path(""), "s.toml", WIDE, &[]);
    other.wait_for("5 flag 1 of ");
    other.settle();
    other.keys("nr\x13");
    other.wait_for("saved s.toml");
    let theirs = folder.text("s.toml");
    assert_eq!(theirs.matches("verdict = ").count(), 2, "{theirs}");
    terminal.keys("u\x13");
    terminal.wait_for("s.toml has changed since it was read or saved here");
    terminal.keys("\x1b");
    terminal.wait_until("no question", |screen| !screen.contents().contains("has changed since"));
    assert_eq!(folder.text("s.toml"), theirs);
    terminal.keys("\x13");
    terminal.wait_for("overwrite it");
    terminal.keys("o");
    terminal.wait_for("saved s.toml");
    assert_eq!(folder.text("s.toml").matches("verdict = ").count(), 0);
}

#[test]
fn quitting_asks_when_something_is_unsaved_and_gives_the_terminal_back() {
    let (folder, mut terminal) = workbench(COMPACT);
    terminal.keys("a");
    terminal.wait_for("[+]");
    terminal.keys("q");
    terminal.wait_for("not saved");
    terminal.keys("\x1b");
    terminal.wait_until("the panels", |screen| !screen.contents().contains("not saved"));
    terminal.keys("q");
    terminal.wait_for("discard them and quit");
    terminal.keys("d");
    let (status, raw) = terminal.end();
    assert_eq!(status, 0);
    assert_restored(&raw);
    assert_eq!(folder.names(), ["demo.csv"]);
}

#[test]
fn signals_give_the_terminal_back() {
    for (name, number) in [("TERM", 15), ("HUP", 1), ("INT", 2), ("QUIT", 3)] {
        let (_folder, mut terminal) = workbench(COMPACT);
        terminal.keys("a");
        terminal.wait_for("accepted row 61");
        terminal.signal(name);
        let (status, raw) = terminal.end();
        assert_eq!(status, 128 + number, "{name}");
        assert_restored(&raw);
        let after = String::from_utf8_lossy(&raw).rsplit("\x1b[?25h").next().unwrap().to_owned();
        let lines: Vec<&str> = after.lines().filter(|line| !line.trim().is_empty()).collect();
        let way_back = "`wildpoint demo.csv` offers it back";
        assert!(matches!(lines[..], [line] if line.contains(way_back)), "one line after the screen: {after:?}");
    }
}

#[test]
fn a_panic_gives_the_terminal_back_before_it_speaks() {
    let folder = Folder::with_demo();
    let terminal = Terminal::start(&folder.path(""), "demo.csv", COMPACT, &[("WILDPOINT_PANIC", "1")]);
    let (status, raw) = terminal.end();
    assert_eq!(status, 101);
    assert_restored(&raw);
    let text = String::from_utf8_lossy(&raw);
    let (back, said) = (text.rfind("\x1b[?1049l").unwrap(), text.find("a panic on demand").unwrap());
    assert!(back < said, "the message is on the screen of the shell");
}

#[test]
fn keys_come_from_the_terminal_when_standard_input_is_a_file() {
    let folder = Folder::with_demo();
    let mut terminal = Terminal::start_fed(&folder.path(""), "demo.csv", "demo.csv", COMPACT);
    terminal.wait_for("flagged");
    terminal.keys("a");
    terminal.wait_for("accepted row 61");
    terminal.keys(":q!\r");
    assert_eq!(terminal.end().0, 0);
}

#[test]
fn a_resize_redraws_and_too_small_a_window_says_so() {
    let (_folder, mut terminal) = workbench(COMPACT);
    terminal.resize(WIDE);
    terminal.wait_for("3 method & parameters");
    terminal.resize((30, 8));
    terminal.wait_for("terminal too small");
    terminal.resize(COMPACT);
    terminal.wait_until("the compact layout", |screen| {
        let text = screen.contents();
        text.contains("5 flag 1 of ") && !text.contains("3 method & parameters") && text.trim_end().ends_with("q quit")
    });
}

#[test]
#[cfg(target_os = "linux")]
fn a_torn_arrow_key_is_one_key() {
    let (_folder, mut terminal) = workbench(COMPACT);
    // At the left end the left arrow can only say so; taken for three keys, `D` opens the list of channels.
    let shown = |text: &'static str| move |screen: &vt100::Screen| screen.contents().contains(text);
    let mut torn = 0;
    while torn < 5 {
        let between = std::time::Instant::now();
        terminal.key_by_itself("\x1b");
        terminal.keys("[D");
        // On a busy machine the rest may come so late that it is no rest: that attempt does not count.
        let at_once = between.elapsed().as_millis() < 10;
        terminal.wait_until("an effect", |screen| shown("end of the record")(screen) || shown("filter:")(screen));
        if at_once {
            terminal.look(|screen| assert!(!shown("filter:")(screen), "three keys:\n{}", screen.contents()));
            torn += 1;
        }
        if terminal.look(shown("filter:")) {
            terminal.keys("\x1b");
            terminal.wait_until("no list", |screen| !shown("filter:")(screen));
        }
        // Giving the focus to the trace, which has it, takes the words away.
        terminal.keys("1");
        terminal.wait_until("no words", |screen| !shown("end of the record")(screen));
    }
    terminal.look(|screen| assert!(!title(screen).contains("[+]")));
}

#[test]
fn pasted_text_is_text_and_never_keys() {
    let (_folder, mut terminal) = workbench(COMPACT);
    // As keys: accept, reject, undo, step, quit, drop.
    terminal.keys("\x1b[200~aru..qd\r\x1b[201~n");
    terminal.wait_for("#91 ");
    terminal.look(|screen| {
        assert!(!title(screen).contains("[+]") && screen.contents().contains("k ‹4.0›"), "{}", screen.contents());
    });
    terminal.keys(":");
    terminal.wait_for("Enter do it");
    terminal.keys("\x1b[200~goto\n #500\x1b[201~");
    terminal.wait_for(":goto #500");
    terminal.keys("\r");
    terminal.wait_for("#500 ");
}

/// The parameters of every SGR sequence.
fn sgr(raw: &[u8]) -> Vec<u8> {
    let text = String::from_utf8_lossy(raw);
    let bodies = text.split("\x1b[").skip(1).filter_map(|rest| rest.split_once('m')).map(|(body, _)| body.to_owned());
    let bodies = bodies.filter(|body| body.bytes().all(|b| b.is_ascii_digit() || b == b';'));
    bodies.flat_map(|body| body.split(';').map(|n| n.parse().unwrap_or(0)).collect::<Vec<_>>()).collect()
}

#[test]
fn without_colours_attributes_are_left() {
    let folder = Folder::with_demo();
    let run = |environment: &[(&str, &str)]| {
        let mut terminal = Terminal::start(&folder.path(""), "demo.csv", COMPACT, environment);
        terminal.settle();
        let reversed = terminal.look(|screen| {
            let cells = (0..COMPACT.1).flat_map(|row| (0..COMPACT.0).map(move |col| (row, col)));
            cells.filter(|&(row, col)| screen.cell(row, col).is_some_and(vt100::Cell::inverse)).count()
        });
        terminal.keys("q");
        (reversed, sgr(&terminal.end().1))
    };
    let is_colour = |n: &u8| matches!(n, 30..=38 | 40..=48 | 58 | 90..=97 | 100..=107);
    let (reversed, plain) = run(&[("NO_COLOR", "1")]);
    assert!(reversed > 0 && plain.contains(&7) && plain.contains(&1), "the cursor is reversed, titles are bold");
    assert!(!plain.iter().any(is_colour), "{plain:?}");
    // The same scan does find colours where there are some.
    assert!(run(&[]).1.iter().any(is_colour));
}
