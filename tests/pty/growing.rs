//! The record changes while it is open: it grows, or it goes.

use std::io::Write as _;

use super::program::Folder;
use super::terminal::{Terminal, title};

const SIZE: (u16, u16) = (120, 30);

/// Rows that follow on the demonstration record.
const MORE: &str = "2400.0,622.1,78630.0,0\n2401.0,622.2,78640.5,0\n2402.0,622.3,78651.0,0\n";

fn append(folder: &Folder, text: &str) {
    let mut file = std::fs::OpenOptions::new().append(true).open(folder.path("demo.csv")).unwrap();
    file.write_all(text.as_bytes()).unwrap();
}

/// A workbench on `words` with its first result; journals go to the folder `state`.
fn open(folder: &Folder, words: &str) -> Terminal {
    let state = folder.path("state").display().to_string();
    Terminal::start(&folder.path(""), words, SIZE, &[("XDG_STATE_HOME", &state)])
}

/// The line of a session that begins so.
fn line(session: &str, start: &str) -> String {
    session.lines().find(|l| l.starts_with(start)).unwrap_or_default().to_owned()
}

#[test]
fn work_on_a_record_that_grows_is_saved_and_goes_on_with_the_added_rows() {
    let folder = Folder::with_demo();
    let mut terminal = open(&folder, "demo.csv");
    terminal.settle();
    terminal.keys("a");
    terminal.wait_for("accepted row 61");
    append(&folder, MORE);
    terminal.wait_for("3 rows were added to the record");
    terminal.look(|screen| assert!(title(screen).contains("+3 rows"), "{}", screen.contents()));

    terminal.keys(":w s.toml\r");
    terminal.wait_for("saved s.toml");
    let session = folder.text("s.toml");
    assert_eq!(line(&session, "rows = "), "rows = 2356");
    assert!(session.contains("{ row = 61,"), "{session}");
    terminal.keys(":export c.csv\r");
    terminal.wait_for("wrote c.csv");
    assert_eq!(folder.text("c.csv").lines().count(), 2357);
    terminal.keys(":report r.html\r");
    terminal.wait_for("wrote r.html");

    terminal.keys("r");
    terminal.wait_for("rejected row 91");
    terminal.keys(":reload\r");
    terminal.wait_for("3 rows taken in; 2 decisions kept");
    terminal.settle();
    terminal.look(|screen| assert!(!title(screen).contains("+3 rows"), "{}", screen.contents()));
    // What was done before can still be undone.
    terminal.keys("u");
    terminal.wait_for("undone");
    terminal.keys(":w! s.toml\r");
    terminal.wait_for("saved s.toml");
    let session = folder.text("s.toml");
    assert_eq!(line(&session, "rows = "), "rows = 2359");
    assert!(session.contains("{ row = 61,") && !session.contains("{ row = 91,"), "{session}");
    terminal.keys("q");
    assert_eq!(terminal.end().0, 0);
    assert_eq!(folder.done("replay --check s.toml"), "s.toml: same result\n");
}

#[test]
fn work_is_offered_although_the_record_has_grown_since() {
    let folder = Folder::with_demo();
    let mut terminal = open(&folder, "demo.csv");
    terminal.settle();
    terminal.keys("ar");
    terminal.wait_for("rejected row 91");
    terminal.kill();
    append(&folder, MORE);
    let mut terminal = open(&folder, "demo.csv");
    terminal.wait_for("unsaved work was found");
    terminal.wait_for("3 rows were added to the record");
    terminal.keys("r");
    terminal.wait_for("2 changes are back");
    terminal.keys(":w s.toml\r");
    terminal.wait_for("saved s.toml");
    let session = folder.text("s.toml");
    assert_eq!(line(&session, "rows = "), "rows = 2359");
    assert!(session.contains("{ row = 61,") && session.contains("{ row = 91,"), "{session}");
}

#[test]
fn a_session_opens_on_a_record_that_has_grown() {
    let folder = Folder::with_demo();
    let mut terminal = open(&folder, "demo.csv");
    terminal.settle();
    terminal.keys("a");
    terminal.wait_for("accepted row 61");
    terminal.keys(":wq s.toml\r");
    assert_eq!(terminal.end().0, 0);
    append(&folder, MORE);
    let mut terminal = open(&folder, "s.toml");
    terminal.wait_for("3 rows were added to the record");
    terminal.settle();
    terminal.wait_until("the added rows in the title", |screen| title(screen).contains("+3 rows"));
    terminal.keys(":reload\r");
    terminal.wait_for("3 rows taken in; 1 decision kept");
    terminal.settle();
    // The session that was opened is saved again, on all rows now.
    terminal.keys(":wq\r");
    assert_eq!(terminal.end().0, 0);
    assert_eq!(line(&folder.text("s.toml"), "rows = "), "rows = 2359");
}

#[test]
fn decisions_outlive_the_record() {
    let folder = Folder::with_demo();
    let demo = folder.text("demo.csv");
    let mut terminal = open(&folder, "demo.csv");
    terminal.settle();
    terminal.keys("ar");
    terminal.wait_for("rejected row 91");
    std::fs::remove_file(folder.path("demo.csv")).unwrap();
    terminal.wait_for("the record was deleted");
    terminal.keys(":export c.csv\r");
    terminal.wait_for("not written");
    terminal.keys(":w s.toml\r");
    terminal.wait_for("saved s.toml");
    terminal.keys(":decisions d.csv\r");
    terminal.wait_for("wrote d.csv");
    terminal.keys("q");
    assert_eq!(terminal.end().0, 0);
    let row = |number: &str| demo.lines().nth(number.parse().unwrap()).unwrap().split(',').nth(1).unwrap().to_owned();
    let table = folder.text("d.csv");
    let lines: Vec<&str> = table.lines().collect();
    assert_eq!(lines[0], "row,time,channel,raw,verdict,note,by,at");
    assert_eq!(
        lines[1..],
        [
            format!("61,61,vx_mps,{},outlier,,,2026-01-01T00:00:00Z", row("61")),
            format!("91,91,vx_mps,{},normal,,,2026-01-01T00:00:00Z", row("91"))
        ]
    );
    assert_eq!(line(&folder.text("s.toml"), "record_was"), "record_was = \"deleted\"");

    // When the record is back, the session is whole again.
    assert!(folder.run("replay s.toml").err.contains("is not there"));
    std::fs::write(folder.path("demo.csv"), &demo).unwrap();
    let said = folder.done("replay s.toml --flags f.csv");
    assert!(said.contains("saved when its record was deleted"), "{said}");
    assert_eq!(folder.text("f.csv").lines().filter(|l| l.contains(",analyst,")).count(), 2);
    // On other data its decisions do not pass for those on these.
    std::fs::write(folder.path("demo.csv"), demo.replacen("\n61.0,", "\n61.0,1", 1)).unwrap();
    assert_eq!(folder.run("replay s.toml").status, 2);
}
