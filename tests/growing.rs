//! Records that grow after a session on them was saved: rows that were added make no other record.

#![expect(clippy::unwrap_used, reason = "a failed expectation is a failed test")]

mod program;

use std::io::Write as _;

use program::Folder;
use wildpoint::session::{Accepted, Analysed, document, open};
use wildpoint::stop::Stop;

const DEMO: &str = include_str!("../data/demo.csv");
const SESSION: &str = include_str!("../sessions/hampel_decisions.toml");

/// Three rows that follow on the demonstration record, the second of them wild.
const MORE: &str = "2400.0,622.1,78630.0,0\n2401.0,9622.2,78640.5,1\n2402.0,622.3,78651.0,0\n";

fn append(folder: &Folder, text: &str) {
    let mut file = std::fs::OpenOptions::new().append(true).open(folder.path("demo.csv")).unwrap();
    file.write_all(text.as_bytes()).unwrap();
}

/// A folder with the record, a session of this format with four decisions on it, and the cleaned file of that.
fn saved(format: u32) -> Folder {
    let session = SESSION.replace("../data/demo.csv", "demo.csv");
    let folder = Folder::with_demo();
    std::fs::write(folder.path("s.toml"), session).unwrap();
    folder.done("replay s.toml -q -o before.csv");
    if format > 1 {
        let path = folder.path("s.toml");
        let mut opened = open(&path, Accepted::default()).unwrap();
        let analysed = Analysed::of(&opened.session, &opened.track, &Stop::never()).unwrap();
        let text = document(&mut opened.session, &opened.track, &analysed, &path).unwrap();
        assert!(text.starts_with(&format!("format = {format}\n")) && text.contains("\nbytes = "), "{text}");
        std::fs::write(path, text).unwrap();
    }
    folder
}

#[test]
fn a_grown_record_is_refused_in_words_and_taken_in_when_it_is_accepted() {
    for format in [1, 2] {
        let folder = saved(format);
        append(&folder, MORE);
        let refused = folder.run("replay s.toml -o after.csv");
        assert_eq!((refused.status, refused.out.as_str()), (2, ""), "{}", refused.err);
        assert!(refused.err.contains("3 rows were added to the record"), "{}", refused.err);
        assert!(refused.err.contains("--accept-appended"), "{}", refused.err);
        assert_eq!(folder.names(), ["before.csv", "demo.csv", "s.toml"], "nothing was written");

        let said = folder.done("replay s.toml -o after.csv --flags flags.csv --accept-appended");
        assert!(said.contains("3 rows were added to the record since the session was saved"), "{said}");
        assert!(!said.contains("left out"), "{said}");
        let (before, after) = (folder.text("before.csv"), folder.text("after.csv"));
        assert_eq!(after.lines().count(), before.lines().count() + 3);
        assert!(after.lines().last().unwrap().starts_with("2402.0,622.3,"));
        let flags = folder.text("flags.csv");
        assert_eq!(flags.lines().filter(|l| l.contains(",analyst,")).count(), 4, "every decision stays: {flags}");
        assert!(flags.lines().any(|l| l.starts_with("2358,2401.0,vx_mps,9622.2,outlier")), "{flags}");
    }
}

#[test]
fn a_check_of_a_grown_record_is_about_the_rows_of_the_session() {
    for format in [1, 2] {
        let folder = saved(format);
        append(&folder, MORE);
        let unasked = folder.run("replay s.toml --check");
        assert_eq!((unasked.status, unasked.err.as_str()), (1, ""));
        assert!(unasked.out.contains("3 rows were added to the record"), "{}", unasked.out);
        let asked = folder.done("replay s.toml --check --accept-appended");
        assert!(asked.contains("s.toml: same result; 3 rows were added"), "{asked}");
        assert!(asked.contains("left out"), "{asked}");
    }
}

#[test]
fn what_is_no_longer_the_start_of_the_record_is_another_record() {
    let folder = saved(2);
    std::fs::write(folder.path("demo.csv"), DEMO.replacen("\n100.0,", "\n100.5,", 1) + MORE).unwrap();
    let ran = folder.run("replay s.toml --accept-appended");
    assert_eq!(ran.status, 2);
    assert!(ran.err.contains("3 rows added"), "{}", ran.err);
    assert!(ran.err.contains("not those of the session"), "{}", ran.err);
    let short: String = DEMO.lines().take(2000).map(|l| format!("{l}\n")).collect();
    std::fs::write(folder.path("demo.csv"), short).unwrap();
    let ran = folder.run("replay s.toml --accept-appended");
    assert_eq!(ran.status, 2);
    assert!(ran.err.contains("removed"), "{}", ran.err);
}

#[test]
fn a_decision_on_a_row_that_was_half_written_is_left_out_in_words() {
    let rest = "1.30,78622.7,0\n";
    let half = DEMO.strip_suffix(rest).unwrap();
    assert!(half.ends_with("\n2399.0,62"));
    let folder = Folder::with(&[("demo.csv", half.as_bytes())]);
    folder.done("clean demo.csv -q --channel vx_mps --save-session s.toml");
    let text = folder.text("s.toml");
    let decision =
        "decisions = [\n  { row = 2356, time = \"2399.0\", value = \"62\", verdict = \"normal\" },\n]\n\n[result]";
    // By hand: format 1 has no digest that would complain.
    let digest = text.find("\n[digest]").unwrap();
    let text = text[..digest].replace("format = 2", "format = 1").replace("[result]", decision);
    std::fs::write(folder.path("s.toml"), text).unwrap();
    folder.done("replay s.toml");
    std::fs::write(folder.path("demo.csv"), DEMO.to_owned() + MORE).unwrap();
    let said = folder.done("replay s.toml --accept-appended");
    assert!(said.contains("3 rows were added"), "{said}");
    assert!(said.contains("left out: row 2356 of vx_mps: the value is \"621.30\""), "{said}");
}
