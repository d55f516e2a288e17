//! A disk on which there is no room for the journal, and then is again. The limit of the size of files stands for it:
//! a write beyond it is done in part and then fails.

use rustix::process::{Pid, Resource, Rlimit, prlimit};

use super::journal::{Desk, overlay};
use super::terminal::{Terminal, title};

/// Lets the program's files grow up to this many bytes, or without a limit.
fn limit_files(terminal: &Terminal, bytes: Option<u64>) {
    let pid = Pid::from_raw(terminal.pid().try_into().unwrap());
    prlimit(pid, Resource::Fsize, Rlimit { current: bytes, maximum: None }).unwrap();
}

/// The length of the only journal.
fn length(desk: &Desk) -> u64 {
    desk.journals()[0].metadata().unwrap().len()
}

#[test]
fn what_a_full_disk_refuses_is_shown_as_long_as_it_lasts_and_written_when_there_is_room() {
    let desk = Desk::new();
    let mut terminal = desk.open("demo.csv");
    terminal.keys("a");
    terminal.wait_for("accepted row 61");
    desk.wait_for_journals(1);
    // Room for a part of a line.
    limit_files(&terminal, Some(length(&desk) + 20));
    terminal.keys("r");
    terminal.wait_for("changes are not journalled:");
    for (key, words) in [("a", "accepted row 200"), ("r", "rejected row 222"), (".", "k 4.0 → 4.1")] {
        terminal.keys(key);
        terminal.wait_for(words);
        terminal.settle();
        terminal.look(|screen| assert!(title(screen).contains("not journalled"), "{}", screen.contents()));
    }
    limit_files(&terminal, None);
    terminal.wait_until("the mark goes", |screen| !title(screen).contains("not journalled"));
    terminal.wait_for("changes are journalled again");
    terminal.kill();
    let mut terminal = desk.start("demo.csv");
    overlay(&terminal);
    terminal.wait_for("5 changes were never saved");
    terminal.keys("r");
    terminal.wait_for("5 changes are back");
    terminal.settle();
    let saved = desk.saved(terminal);
    assert_eq!(saved.iter().filter(|line| line.contains("row =")).count(), 4, "{saved:?}");
}

#[test]
fn a_signal_says_what_is_lost_while_the_disk_is_full() {
    let desk = Desk::new();
    let mut terminal = desk.open("demo.csv");
    // Not even the first line.
    limit_files(&terminal, Some(10));
    terminal.keys("a");
    terminal.wait_for("changes are not journalled:");
    terminal.signal("TERM");
    let (status, raw) = terminal.end();
    let text = String::from_utf8_lossy(&raw);
    assert!(status == 143 && text.contains("lost, since the journal could not be written"), "{text}");
    assert!(desk.journals().is_empty(), "{:?}", desk.journals());

    let mut terminal = desk.open("demo.csv");
    terminal.keys("a");
    terminal.wait_for("accepted row 61");
    desk.wait_for_journals(1);
    limit_files(&terminal, Some(length(&desk)));
    terminal.keys("r");
    terminal.wait_for("changes are not journalled:");
    terminal.keys("a");
    terminal.wait_for("accepted row 200");
    terminal.signal("TERM");
    let text = String::from_utf8_lossy(&terminal.end().1).into_owned();
    assert!(text.contains("the last 2 changes could not be written and are lost"), "{text}");
    let terminal = desk.start("demo.csv");
    overlay(&terminal);
    terminal.wait_for("1 change was never saved");
    terminal.look(|screen| assert!(!screen.contents().contains("torn"), "{}", screen.contents()));
}

#[test]
fn a_journal_that_somebody_removes_is_written_again() {
    let desk = Desk::new();
    let mut terminal = desk.open("demo.csv");
    terminal.keys("a");
    terminal.wait_for("accepted row 61");
    desk.wait_for_journals(1);
    std::fs::remove_dir_all(desk.state.path().join("wildpoint")).unwrap();
    terminal.keys("r");
    terminal.wait_for("rejected row 91");
    terminal.kill();
    let terminal = desk.start("demo.csv");
    overlay(&terminal);
    terminal.wait_for("2 changes were never saved");
}
