//! Sessions and records from strangers: a session reads the record that it names and nothing else, writes nothing, and
//! is found out when anything in it was changed; text of a file runs in no spreadsheet by way of our tables.

#![expect(clippy::unwrap_used, reason = "a failed expectation is a failed test")]

mod program;

use program::Folder;

const SESSION: &str = include_str!("../sessions/hampel_decisions.toml");

fn folder(session: &str) -> Folder {
    let folder = Folder::with_demo();
    std::fs::write(folder.path("s.toml"), session.replace("../data/demo.csv", "demo.csv")).unwrap();
    folder
}

#[test]
fn another_hash_is_another_record() {
    let at = SESSION.find("sha256 = \"").unwrap() + 10;
    let changed = format!("{}{}{}", &SESSION[..at], "0".repeat(64), &SESSION[at + 64..]);
    let folder = folder(&changed);
    let before = folder.names();
    let ran = folder.run("replay s.toml -o c.csv");
    assert_eq!(ran.status, 2);
    // The sums of the rows tell that none of them changed.
    assert!(ran.err.contains("demo.csv") && ran.err.contains("every row is the same"), "{}", ran.err);
    let without: String = changed.lines().filter(|l| !l.starts_with("row_check")).map(|l| format!("{l}\n")).collect();
    std::fs::write(folder.path("s.toml"), without.replace("../data/demo.csv", "demo.csv")).unwrap();
    let ran = folder.run("replay s.toml -o c.csv");
    assert!(ran.status == 2 && ran.err.contains("another SHA-256"), "{}", ran.err);
    assert_eq!(folder.names(), before);
}

#[test]
fn a_session_reads_nothing_that_is_no_record_and_writes_nothing_of_its_own() {
    for (file, what) in [
        ("/dev/zero", "a pipe or a device"),
        ("/dev/stdin", "a pipe or a device"),
        (".", "a folder"),
        ("s.toml", "s.toml:"),
        ("/nonexistent/x", "is not there"),
    ] {
        let folder = folder(&SESSION.replace("../data/demo.csv", file));
        let ran = folder.run("replay s.toml --check");
        assert!(ran.status == 2 && ran.err.contains(what), "{file}: {}", ran.err);
        assert_eq!(folder.names(), ["demo.csv", "s.toml"], "{file}");
    }
    // Keys that would name an output are no keys of a session.
    for key in ["output = \"/tmp/x\"", "flags = \"x\"", "include = \"demo.csv\"", "command = \"sh\""] {
        let folder = folder(&SESSION.replacen("[data]\n", &format!("[data]\n{key}\n"), 1));
        let ran = folder.run("replay s.toml");
        let word = key.split(' ').next().unwrap();
        assert!(ran.status == 2 && ran.err.contains(word) && ran.err.contains("s.toml:5"), "{key}: {}", ran.err);
        assert_eq!(folder.names(), ["demo.csv", "s.toml"], "{key}");
    }
    let folder = folder(SESSION);
    folder.done("replay s.toml --check");
    folder.done("replay s.toml");
    assert_eq!(folder.names(), ["demo.csv", "s.toml"], "nothing was asked for, nothing is written");
}

/// A record whose header, cells and note a spreadsheet would run.
#[test]
fn formulas_stay_as_they_are_in_the_record_and_are_text_in_our_tables() {
    let mut text = String::from("t_s,=cmd|' /C calc'!A0,@state\n");
    for i in 0..60 {
        let x = if i == 30 { "-99.5".into() } else { format!("{}.{}", i / 10, i % 10) };
        text.push_str(&format!("{i},{x},=HYPERLINK(\"http://x\")\n").replace("\"http://x\"", "A1"));
    }
    let folder = Folder::with(&[("wild.csv", text.as_bytes())]);
    folder.done("clean wild.csv -o c.csv --flags f.csv --diagnostics d.csv --save-session s.toml");
    let clean = folder.text("c.csv");
    assert_eq!(clean.lines().next(), text.lines().next(), "the header is that of the input");
    assert!(clean.lines().skip(1).all(|l| l.ends_with(",=HYPERLINK(A1)")));
    for table in ["f.csv", "d.csv"] {
        let table = folder.text(table);
        let mut reader = csv::Reader::from_reader(table.as_bytes());
        let rows: Vec<csv::StringRecord> = reader.records().map(Result::unwrap).collect();
        assert!(!rows.is_empty());
        for row in &rows {
            assert_eq!(&row[2], "'=cmd|' /C calc'!A0");
            let runs = |c: &str| c.starts_with(['=', '@', '+', '-', '\t', '\r']) && c.parse::<f64>().is_err();
            assert!(!row.iter().any(runs), "{row:?}");
        }
        assert!(rows.iter().any(|r| &r[3] == "-99.5"), "numbers are numbers");
    }
    // A note of the analyst, with the session's own text as it was typed.
    let note = "=1+cmd|'x'";
    let session = folder.text("s.toml");
    let flagged = folder.text("f.csv").lines().find(|l| l.contains(",outlier,")).unwrap().to_owned();
    let row: usize = flagged.split(',').next().unwrap().parse().unwrap();
    let (time, value) = (row - 1, text.lines().nth(row).unwrap().split(',').nth(1).unwrap());
    let decision = format!(
        "decisions = [\n  {{ row = {row}, time = \"{time}\", value = \"{value}\", verdict = \"normal\", note = \"{note}\" }},\n]\n\n[result]"
    );
    std::fs::write(folder.path("noted.toml"), session.replacen("\n[result]", &decision, 1)).unwrap();
    folder.done("replay noted.toml --flags noted.csv");
    assert!(folder.text("noted.csv").contains(&format!(",'{note}")), "{}", folder.text("noted.csv"));
}
