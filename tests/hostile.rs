//! What a stranger wrote into names and cells reaches no terminal as it is: whatever a command prints, to standard output
//! or standard error, is free of everything that a terminal would obey, hide or reorder, and stays on its line.

#![expect(clippy::unwrap_used, reason = "a failed expectation is a failed test")]
#![allow(
    clippy::allow_attributes,
    clippy::allow_attributes_without_reason,
    dead_code,
    reason = "of what tests share not all is used here"
)]

mod program;

use std::fmt::Write as _;

use program::{Folder, Ran};
use wildpoint::track::printable_lines;

/// Turns red, sets the title, turns the direction, hides.
const EVIL: &str = "x\u{1b}[31m\u{1b}]0;t\u{7}\u{202e}\u{200b}\u{9b}2Jy";
/// The same as it may be shown.
const SHOWN: &str = "x\\x1b[31m\\x1b]0;t\\x07\\u{202e}\\u{200b}\\u{9b}2Jy";

/// A record in which the name of the file, of two columns, a unit, ids and cells are hostile.
fn folder() -> Folder {
    let mut text = format!("t,{EVIL} [{EVIL}],\"line\n{EVIL}\"\n");
    for i in 0..60 {
        let y = if i == 30 { 500.0 } else { f64::from(i) / 8.0 };
        let z = if i == 41 { EVIL.to_owned() } else { y.to_string() };
        let _ = writeln!(text, "{i},{y},{z}");
    }
    let folder = Folder::with(&[("plain.csv", text.as_bytes())]);
    std::fs::write(folder.path(&format!("{EVIL}.csv")), &text).unwrap();
    std::fs::write(folder.path(&format!("{EVIL}-words.csv")), format!("a,b\n{EVIL},{EVIL}\n")).unwrap();
    std::fs::write(
        folder.path("keys.toml"),
        r#"format = 1
"x\u001b[31m\u202ey" = 2
"#,
    )
    .unwrap();
    folder
}

/// Everything that was printed, which must be harmless; `words` says by what.
fn harmless(words: &str, ran: &Ran) -> String {
    let all = format!("{}{}", ran.out, ran.err);
    assert_eq!(printable_lines(&all), all, "wildpoint {words:?}");
    for line in ran.err.lines() {
        let begins =
            ["wildpoint: ", "error: ", "  ", "Usage: ", "For more "].iter().any(|start| line.starts_with(start));
        assert!(begins || line.is_empty(), "wildpoint {words:?}: a line that is not ours: {line}");
    }
    all
}

#[test]
fn whatever_a_command_prints_is_harmless() {
    let folder = folder();
    let record = format!("{EVIL}.csv");
    folder.run(&format!("clean {record} --save-session s.toml -q"));
    // Arguments, exit status, and whether a hostile name is told.
    let cases = [
        (format!("inspect {record}"), 0),
        (format!("clean {record}"), 0),
        (format!("clean {record} plain.csv"), 0),
        (record.clone(), 0),
        (format!("sweep {record} --channel #2"), 0),
        (format!("compare {record} --channel #2"), 0),
        (format!("inject {record} -o injected.csv"), 0),
        ("replay s.toml --check".into(), 0),
        ("replay s.toml".into(), 0),
        // What is refused.
        (format!("inspect {EVIL}"), 2),
        (EVIL.to_owned(), 2),
        (format!("inspect {EVIL}-words.csv"), 2),
        (format!("clean {EVIL}-words.csv {record}"), 2),
        (format!("clean {record} --channel {EVIL}z"), 2),
        (format!("clean {record} --time #2 --time-unit {EVIL}"), 2),
        (format!("clean {record} --method {EVIL}"), 2),
        (format!("clean {record} --set {EVIL}=1"), 2),
        (format!("clean {record} --set k={EVIL}"), 2),
        (format!("clean {record} --{EVIL}"), 2),
        (format!("clean {record} -o {record}"), 2),
        (format!("clean {record} -o {EVIL}/{EVIL}"), 2),
        (format!("replay {EVIL}"), 2),
        ("replay keys.toml".into(), 2),
    ];
    for (words, status) in cases {
        let ran = folder.run(&words);
        assert_eq!(ran.status, status, "wildpoint {words:?}\n{}", ran.err);
        let all = harmless(&words, &ran);
        if !words.contains("replay s") {
            assert!(all.contains(SHOWN) || all.contains("\\u{202e}") || all.contains("line\\n"), "{words:?}: {all}");
        }
    }
}

#[test]
fn json_is_harmless_and_says_the_same() {
    let folder = folder();
    for words in ["inspect plain.csv --json", "clean plain.csv --json", "compare plain.csv --channel #2 --json"] {
        let ran = folder.run(words);
        let all = harmless(words, &ran);
        let value: serde_json::Value = serde_json::from_str(&ran.out).unwrap();
        assert!(all.contains("\\u202e") && value.to_string().contains('\u{202e}'), "{words}: {all}");
    }
}

#[test]
fn a_session_shows_hidden_characters_and_keeps_them() {
    let folder = folder();
    folder.run("clean plain.csv --save-session s.toml -q");
    let text = folder.text("s.toml");
    assert_eq!(printable_lines(&text), text);
    assert!(text.contains("\\u202E\\u200B\\u009B"), "{text}");
    assert_eq!(folder.run("replay s.toml --check").status, 0);
}

#[test]
fn a_record_with_an_odd_name_is_found_again_or_its_session_refused() {
    use std::os::unix::ffi::OsStrExt as _;
    let folder = Folder::with_demo();
    for name in ["back\\slash.csv", "quote\".csv", "a#b='.csv", EVIL] {
        std::fs::copy(folder.path("demo.csv"), folder.path(name)).unwrap();
        let ran = folder.run(&format!("clean {name} --channel vx_mps --save-session s.toml --force -q"));
        assert_eq!((ran.status, ran.err.as_str()), (0, ""), "{name}");
        assert_eq!(folder.done("replay s.toml --check"), "s.toml: same result\n", "{name}");
    }
    let name = std::ffi::OsStr::from_bytes(b"l\xe9.csv");
    std::fs::copy(folder.path("demo.csv"), folder.path("x").with_file_name(name)).unwrap();
    let before = std::fs::read_dir(folder.path("")).unwrap().count();
    let mut command = assert_cmd::Command::new(env!("CARGO_BIN_EXE_wildpoint"));
    command.current_dir(folder.path("")).arg("clean").arg(name).args(["-o", "c.csv", "--save-session", "t.toml"]);
    let ran = command.output().unwrap();
    let err = String::from_utf8_lossy(&ran.stderr);
    assert!(
        ran.status.code() == Some(2) && err.contains("its name is not UTF-8") && err.contains("another name"),
        "{err}"
    );
    assert_eq!(std::fs::read_dir(folder.path("")).unwrap().count(), before, "nothing was written");
}

#[test]
fn what_could_not_be_used_is_told_by_clean_too() {
    let folder = Folder::with(&[("a.csv", b"t,x\n0,1\n1,2\n1,3\n2,four\n3,5\n"), ("b.csv", b"t,x\n0,1\n1,2\n")]);
    let told = "1 repeated time (line 4: 1)\nnote: 1 unreadable cell (line 5: four (x))\n";
    let out = folder.done("clean a.csv");
    assert!(out.contains(&format!("\nnote: {told}")), "{out}");
    assert!(!folder.done("clean b.csv").lines().any(|line| line.starts_with("note")));
    let many = folder.done("clean a.csv b.csv");
    assert!(many.contains("note: a.csv: 1 repeated time (line 4: 1)\n"), "{many}");
    let json: serde_json::Value = serde_json::from_str(&folder.done("clean a.csv --json")).unwrap();
    assert_eq!(json["notes"].as_array().unwrap().len(), 2);
}

#[test]
fn a_column_is_meant_by_its_number_everywhere() {
    let mut text = String::from("t,x,r\n");
    for i in 0..60 {
        let _ = writeln!(text, "{i},{},{}", if i == 30 { 500 } else { 2 * i }, 2);
    }
    let folder = Folder::with(&[("a.csv", text.as_bytes())]);
    for (by_number, by_name) in [
        ("sweep a.csv --channel #2", "sweep a.csv --channel x"),
        ("compare a.csv --channel #3 --json", "compare a.csv --channel r --json"),
        ("clean a.csv --channel #2 --method matched --rate #3", "clean a.csv --channel x --method matched --rate r"),
        ("clean a.csv --reference #3", "clean a.csv --reference r"),
    ] {
        // How long a method took is never the same.
        let said =
            |words: &str| folder.done(words).lines().filter(|l| !l.contains("\"ms\"")).collect::<Vec<_>>().join("\n");
        assert_eq!(said(by_number), said(by_name), "{by_number}");
    }
}
