//! Files from the screen: another record is picked and opened, a report and all outputs are written.

use super::program::Folder;
use super::terminal::{Terminal, title};
use super::{COMPACT, WIDE};

const OTHER: &str = "t,height\n0,1\n1,2\n2,3\n3,4\n4,5\n5,60\n6,7\n7,8\n8,9\n9,10\n10,11\n11,12\n";

fn folder() -> Folder {
    Folder::with(&[
        ("demo.csv", include_bytes!("../../data/demo.csv")),
        ("other.csv", OTHER.as_bytes()),
        ("words.txt", b"a,b\nx,y\nz,w\n"),
        ("esc\x1b]0;owned\x07.csv", b"t,x\n0,1\n1,2\n2,3\n"),
    ])
}

fn start(folder: &Folder, size: (u16, u16)) -> Terminal {
    let terminal = Terminal::start(&folder.path(""), "demo.csv", size, &[]);
    terminal.settle();
    terminal
}

const CTRL_O: &str = "\x0f";
const CTRL_E: &str = "\x05";

#[test]
fn another_record_is_picked_tuned_and_reported_on() {
    let folder = folder();
    let mut terminal = start(&folder, WIDE);
    terminal.keys(CTRL_O);
    terminal.wait_for("other.csv");
    terminal.look(|screen| assert!(screen.contents().contains("esc\\x1b]0;owned\\x07.csv"), "{}", screen.contents()));
    terminal.keys("words");
    terminal.wait_for("no column of");
    terminal.keys("\x15other");
    terminal.wait_for("12 rows, 2 columns");
    terminal.keys("\r");
    terminal.wait_until("the other record", |screen| title(screen).contains("other.csv · height"));
    terminal.settle();
    terminal.keys(":set k 6\r");
    terminal.wait_for("k 6 · u undo");
    terminal.settle();
    terminal.keys(":report out.html\r");
    terminal.wait_for("wrote out.html: report");
    let report = folder.text("out.html");
    assert!(report.contains("<h1>other.csv</h1>") && report.contains("k=6.0"));
    // The parameter was turned and nothing saved: another record is asked about, and the answer saves first.
    terminal.keys(":open demo.csv\r");
    terminal.wait_for("open demo.csv");
    terminal.keys("w");
    terminal.wait_until("the first record again", |screen| title(screen).contains("demo.csv · vx_mps"));
    terminal.settle();
    terminal.keys("q");
    assert_eq!(terminal.end().0, 0);
    assert!(folder.text("other.wild.toml").contains("file = \"other.csv\""));
    assert_eq!(folder.done("replay --check other.wild.toml"), "other.wild.toml: same result\n");
}

#[test]
fn all_outputs_are_written_from_one_dialog() {
    let folder = folder();
    let mut terminal = start(&folder, COMPACT);
    std::fs::write(folder.path("demo.flags.csv"), "theirs").unwrap();
    terminal.keys(CTRL_E);
    terminal.wait_for("demo.flags.csv  exists");
    // Flags and report besides the cleaned file.
    terminal.keys("\x1b[B \x1b[B\x1b[B \r");
    terminal.wait_for("demo.flags.csv already exists");
    terminal.keys("o");
    terminal.wait_for("wrote 3 files");
    terminal.keys("q");
    assert_eq!(terminal.end().0, 0);
    assert!(folder.text("demo.flags.csv").starts_with("row,time,"));
    assert!(folder.text("demo.html").starts_with("<!DOCTYPE html>"));
    // Of the channels, the one on the screen.
    folder.done("clean demo.csv --channel vx_mps -o same.csv -q");
    assert!(folder.text("demo.clean.csv") == folder.text("same.csv"));
    assert!(!folder.path("demo.diagnostics.csv").exists());
}

#[test]
fn columns_are_corrected_and_the_work_stays() {
    let folder = folder();
    let mut terminal = start(&folder, COMPACT);
    terminal.wait_for("#61 ");
    terminal.keys("a");
    terminal.wait_for("accepted row 61");
    terminal.settle();
    terminal.keys(":loader\r");
    terminal.wait_for("2356 rows, 4 columns");
    // The sample number instead of the time column.
    terminal.keys("\x7f\x1b[C");
    terminal.wait_for("time is the sample number");
    terminal.keys("\r");
    terminal.wait_for("open demo.csv");
    terminal.keys("d");
    terminal.wait_for("loaded again; settings kept, 1 decision kept");
    terminal.settle();
    terminal.keys(":w again.toml\r");
    terminal.wait_for("saved again.toml");
    terminal.keys("q");
    assert_eq!(terminal.end().0, 0);
    let session = folder.text("again.toml");
    assert!(session.contains("time = \"sample\"") && session.contains("{ row = 61, "), "{session}");
}

#[test]
fn a_file_that_is_not_understood_opens_the_loader_and_leaving_it_says_what_is_open() {
    let folder = folder();
    std::fs::write(folder.path("bad.csv"), "hello\nworld\n").unwrap();
    let mut terminal = Terminal::start(&folder.path(""), "bad.csv", COMPACT, &[]);
    terminal.wait_for("no column of numbers in the first lines");
    terminal.keys("\x1b");
    terminal.wait_for("bad.csv is not opened; this is wildpoint:demo");
    terminal.keys("q");
    assert_eq!(terminal.end().0, 0);
}

#[test]
fn a_session_saved_under_another_name_is_among_the_recent_files() {
    let folder = folder();
    let state = tempfile::TempDir::new().unwrap();
    let environment = [("XDG_STATE_HOME", state.path().to_str().unwrap())];
    let mut terminal = Terminal::start(&folder.path(""), "demo.csv", WIDE, &environment);
    terminal.settle();
    terminal.keys("W\x15mine.toml\r");
    terminal.wait_for("saved mine.toml");
    terminal.keys("q");
    assert_eq!(terminal.end().0, 0);
    let mut terminal = Terminal::start(&folder.path(""), "other.csv", WIDE, &environment);
    terminal.settle();
    terminal.keys(CTRL_O);
    terminal.wait_for("recent");
    terminal.keys("mine.toml");
    terminal.wait_for("session on ");
    terminal.keys("\r");
    terminal.wait_until("the session", |screen| title(screen).contains("demo.csv · vx_mps"));
    terminal.keys("q");
    assert_eq!(terminal.end().0, 0);
}

#[test]
fn a_session_that_is_opened_again_has_its_channel_in_its_place_and_no_other() {
    let folder = folder();
    let mut terminal = start(&folder, COMPACT);
    terminal.keys("d");
    terminal.wait_for("alt_m [m] (2/2)");
    terminal.settle();
    terminal.keys(":w alt.toml\r");
    terminal.wait_for("saved alt.toml");
    terminal.keys("q");
    assert_eq!(terminal.end().0, 0);
    let saved = folder.text("alt.toml");
    assert_eq!(saved.matches("[[channel]]").count(), 1);
    let mut terminal = Terminal::start(&folder.path(""), "alt.toml", COMPACT, &[]);
    // The second of two, as when the record was opened; what the session is about is on the screen.
    terminal.wait_for("alt_m [m] (2/2)");
    terminal.settle();
    terminal.keys("d");
    terminal.wait_for("vx_mps [m/s] (1/2)");
    terminal.settle();
    terminal.keys("d");
    terminal.wait_for("alt_m [m] (2/2)");
    terminal.keys(":w again.toml\r");
    terminal.wait_for("saved again.toml");
    terminal.keys("q");
    assert_eq!(terminal.end().0, 0);
    assert!(folder.text("again.toml") == saved, "channels that were only looked at do not get into the session");
}

#[test]
fn where_a_session_goes_is_shown_before_it_is_written_and_lies_beside_the_record() {
    let folder = Folder::with_demo();
    std::fs::create_dir(folder.path("tracks")).unwrap();
    std::fs::rename(folder.path("demo.csv"), folder.path("tracks/demo.csv")).unwrap();
    let mut terminal = Terminal::start(&folder.path(""), "tracks/demo.csv", COMPACT, &[]);
    terminal.settle();
    terminal.keys("a\x13");
    terminal.wait_for("save as: tracks/demo.wild.toml");
    assert!(!folder.path("tracks/demo.wild.toml").exists());
    terminal.keys("\r");
    terminal.wait_for("saved tracks/demo.wild.toml");
    // Now it has its place: the next time it is not asked.
    terminal.keys("r\x13");
    // Its words, not the mark of what is unsaved, which is not there before the keys have been read either.
    terminal.wait_for("2 decisions");
    terminal.keys(":report\r");
    terminal.wait_for("wrote tracks/demo.html");
    terminal.keys("q");
    assert_eq!(terminal.end().0, 0);
}
