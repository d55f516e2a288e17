//! Saved sessions run again: every file of `sessions/` gives the bytes it recorded, and whatever was changed since,
//! in the data or in the session, is named.
//!
//! `data/descent.csv` is 440 s of `wildpoint simulate demo --seed 42` as a German program would write it:
//! semicolons, decimal commas, CRLF, an umlaut, some cells empty.

#![expect(clippy::unwrap_used, reason = "a failed expectation is a failed test")]

mod program;

use std::path::{Path, PathBuf};

use program::Folder;
use sha2::{Digest, Sha256};
use wildpoint::session::{Accepted, Analysed, document, open};
use wildpoint::stop::Stop;

const DEMO: &str = include_str!("../data/demo.csv");
const SESSION: &str = include_str!("../sessions/hampel_decisions.toml");

/// Every file of `sessions/`.
fn sessions() -> Vec<PathBuf> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("sessions");
    let mut paths: Vec<PathBuf> = std::fs::read_dir(folder).unwrap().map(|e| e.unwrap().path()).collect();
    paths.sort();
    assert!(paths.len() >= 6);
    paths
}

/// The value of a key of `[result]`.
fn recorded(session: &str, key: &str) -> String {
    let value = session.lines().find_map(|line| line.strip_prefix(&format!("{key} = "))).unwrap();
    value.trim_matches('"').to_owned()
}

fn sha256(bytes: &[u8]) -> String {
    Sha256::digest(bytes).iter().map(|byte| format!("{byte:02x}")).collect()
}

/// A folder with the demonstration record and the session with four decisions on it, both under `demo`.
fn folder_with(session: &str, data: &str) -> Folder {
    let session = session.replace("../data/demo.csv", "demo.csv");
    Folder::with(&[("demo.csv", data.as_bytes()), ("demo.toml", session.as_bytes())])
}

#[test]
fn every_saved_session_gives_the_result_it_recorded() {
    let folder = Folder::with(&[]);
    let paths: Vec<String> = sessions().iter().map(|p| p.display().to_string()).collect();
    let printed = folder.done(&format!("replay --check {}", paths.join(" ")));
    // They are of format 1, and say what they cannot tell.
    let since = "not checked: settings, decisions and notes against the saved ones (format 1 has no digest)";
    let expected: String = paths.iter().map(|path| format!("{path}: same result; {since}\n")).collect();
    assert_eq!(printed, expected);
    assert_eq!(folder.names(), [""; 0], "a check writes nothing");
}

#[test]
fn a_replay_writes_the_bytes_that_were_recorded_on_any_number_of_threads() {
    let folder = Folder::with(&[]);
    for path in sessions() {
        let session = std::fs::read_to_string(&path).unwrap();
        let summary: serde_json::Value = serde_json::from_str(&folder.done(&format!(
            "replay {} --threads 1 -o one.csv --flags f1.csv --diagnostics d1.csv --force --json",
            path.display()
        )))
        .unwrap();
        folder.done(&format!(
            "replay {} --threads 4 -o four.csv --flags f4.csv --diagnostics d4.csv --force -q",
            path.display()
        ));
        let clean = std::fs::read(folder.path("one.csv")).unwrap();
        assert_eq!(sha256(&clean), recorded(&session, "clean_sha256"), "{}", path.display());
        assert_eq!(summary["flagged"].to_string(), recorded(&session, "flagged"), "{}", path.display());
        assert!(clean == std::fs::read(folder.path("four.csv")).unwrap());
        assert!(folder.text("f1.csv") == folder.text("f4.csv") && folder.text("d1.csv") == folder.text("d4.csv"));
    }
}

#[test]
fn decisions_win_over_the_method_and_are_in_the_table_with_their_notes() {
    let folder = folder_with(SESSION, DEMO);
    folder.done("replay demo.toml -o clean.csv --flags flags.csv");
    let (flags, clean) = (folder.text("flags.csv"), folder.text("clean.csv"));
    let row = |row: &str| flags.lines().find(|line| line.starts_with(&format!("{row},"))).unwrap().to_owned();
    // Overruled: kept as it was measured, although the method flagged it.
    assert!(row("91").contains(",55.21,normal,,"), "{}", row("91"));
    assert!(row("91").ends_with(",55.21,kept,analyst,\"the beacon was switched, the drop is real\""), "{}", row("91"));
    assert_eq!(clean.lines().nth(91), DEMO.lines().nth(91));
    // Flagged by hand: repaired on the line between 713.13 one second before and 710.98 one second after.
    assert!(row("700").ends_with(",repaired,analyst,\"cable pulled: see \"\"log 12\"\"\""), "{}", row("700"));
    let repaired: f64 = clean.lines().nth(700).and_then(|line| line.split(',').nth(1)).unwrap().parse().unwrap();
    assert!((repaired - 712.055).abs() < 1e-9, "{repaired}");
    // Confirmed.
    assert!(row("222").contains(",235.06,outlier,isolated,") && row("222").ends_with(",repaired,analyst,"));
}

#[test]
fn a_changed_digit_of_the_data_is_named_and_stops_the_replay() {
    let changed = DEMO.replacen("\n100.0,", "\n100.5,", 1);
    let folder = folder_with(SESSION, &changed);
    let row = changed.lines().position(|line| line.starts_with("100.5,")).unwrap();
    let names = folder.names();
    let checked = folder.run("replay demo.toml --check");
    assert_eq!((checked.status, checked.err.as_str()), (1, ""));
    assert!(checked.out.contains("demo.csv") && checked.out.contains(&format!("row {row} differs")), "{}", checked.out);
    let refused = folder.run("replay demo.toml -o clean.csv --flags flags.csv");
    assert_eq!((refused.status, refused.out.as_str()), (2, ""));
    assert!(refused.err.contains(&format!("row {row} differs")), "{}", refused.err);
    assert!(refused.err.contains("--accept-changed-data"), "{}", refused.err);
    assert_eq!(folder.names(), names, "nothing was written");
    let accepted = folder.done("replay demo.toml -o clean.csv --accept-changed-data");
    assert!(accepted.contains("the data are not those of the session"), "{accepted}");
    assert_eq!(folder.text("clean.csv").lines().nth(row), changed.lines().nth(row));
}

#[test]
fn a_decision_that_no_longer_fits_changed_data_is_left_out_and_said_so() {
    let folder = folder_with(SESSION, &DEMO.replacen("\n91.0,55.21,", "\n91.0,55.22,", 1));
    let accepted = folder.done("replay demo.toml -o clean.csv --flags flags.csv --accept-changed-data");
    assert!(accepted.contains("left out: row 91 of vx_mps"), "{accepted}");
    // The method has its way again.
    let flags = folder.text("flags.csv");
    assert!(flags.lines().any(|line| line.starts_with("91,") && line.ends_with(",repaired,method,")), "{flags}");
}

/// Replays the session with `from` replaced; it must be refused with a message that holds all of `wanted` and, where
/// `from` stands on a line of its own making, names that line.
fn refused(from: &str, to: &str, wanted: &[&str]) {
    let session = SESSION.replacen(from, to, 1);
    assert_ne!(session, SESSION, "{from} is not in the session");
    let folder = folder_with(&session, DEMO);
    let names = folder.names();
    let ran = folder.run("replay demo.toml -o clean.csv");
    assert_eq!((ran.status, ran.out.as_str()), (2, ""), "{to}: {}", ran.err);
    let offset = SESSION.find(from).unwrap() + from.len() - from.trim_start().len();
    let line = format!("demo.toml:{}: ", SESSION[..offset].matches('\n').count() + 1);
    for part in wanted.iter().copied().chain([line.as_str()]) {
        assert!(ran.err.contains(part), "{to}\n{}does not say: {part}", ran.err);
    }
    assert!(ran.err.lines().count() >= 2, "no way out: {}", ran.err);
    assert_eq!(folder.names(), names, "{to}: something was written");
    // A check cannot compare what it does not understand either.
    assert_eq!(folder.run("replay demo.toml --check").status, 2, "{to}");
}

#[test]
fn a_tampered_session_is_refused_with_key_and_line() {
    refused("format = 1", "format = 3", &["format = 3", "version of wildpoint"]);
    refused("format = 1", "format = \"one\"", &["format"]);
    refused("rows = 2356", "rowz = 2356", &["rowz", "`rows`"]);
    refused("rows = 2356", "rows = \"many\"", &["rows: ", "whole number"]);
    refused("rows = 2356", "rows = 2357", &["rows = 2357", "2356"]);
    refused("method = \"hampel\"", "method = \"hample\"", &["hample", "did you mean hampel?"]);
    refused("settings = ", "setings = ", &["setings", "`settings`"]);
    refused("settings = { window = 31", "settings = { windov = 31", &["windov", "did you mean window?"]);
    refused("settings = { window = 31", "settings = { window = 2.5", &["window = 2.5", "3 .. 1001"]);
    refused("settings = { window = 31", "settings = { window = 1002", &["window = 1002", "3 .. 1001"]);
    refused("settings = { window = 31", "settings = { window = \"31\"", &["window = \"31\""]);
    refused("repair = { method = \"linear\"", "repair = { method = \"glue\"", &["method = \"glue\"", "linear"]);
    refused("repair = { method", "repair = { max_fil = 3, method", &["max_fil:", "did you mean max_fill?"]);
    refused("flagged = ", "flaged = ", &["flaged", "`flagged`"]);
    refused("flagged = ", "flagged = -", &["flagged: "]);
    refused("\n[result]", "\n[results]", &["results", "`result`"]);
}

#[test]
fn a_tampered_decision_is_refused_with_key_and_line() {
    refused("value = \"55.21\"", "value = \"55.20\"", &["row 91 of vx_mps", "value", "55.20", "55.21"]);
    refused("time = \"91.0\"", "time = \"91.1\"", &["row 91 of vx_mps", "time", "91.1"]);
    refused("time = \"91.0\", ", "", &["row 91 of vx_mps", "the time is \"91.0\"", "made at \"\""]);
    refused("{ row = 91", "{ row = 92", &["row 92 of vx_mps", "55.21"]);
    refused("{ row = 91", "{ row = 9100", &["row 9100", "2356 rows"]);
    refused("{ row = 91", "{ row = 0", &["row = 0"]);
    refused("{ row = 91", "{ row = \"91\"", &["row: ", "whole number"]);
    refused("value = \"55.21\"", "value = 55.21", &["value: ", "string"]);
    refused("verdict = \"normal\"", "verdict = \"fine\"", &["verdict = \"fine\"", "`normal` or `outlier`"]);
    refused("note = \"the beacon", "nota = \"the beacon", &["nota", "`note`"]);
    refused(
        "  { row = 222",
        "  { row = 91, time = \"91.0\", value = \"55.21\", verdict = \"outlier\" },\n  { row = 222",
        &["row 91: decided twice"],
    );
}

#[test]
fn a_channel_twice_or_one_that_is_not_there_is_refused() {
    let channel = "[[channel]]\nname = \"vx_mps\"\nmethod = \"hampel\"\n\n[result]";
    let line = SESSION.lines().position(|line| line == "[result]").unwrap() + 1;
    let twice = folder_with(&SESSION.replace("[result]", channel), DEMO).run("replay demo.toml");
    assert_eq!(twice.status, 2);
    assert!(twice.err.contains(&format!("demo.toml:{line}: vx_mps: this channel comes twice")), "{}", twice.err);
    let gone = folder_with(&SESSION.replace("\"vx_mps\"", "\"vy_mps\""), DEMO).run("replay demo.toml");
    assert_eq!(gone.status, 2);
    assert!(gone.err.contains("`vy_mps`") && gone.err.contains("vx_mps, alt_m"), "{}", gone.err);
}

#[test]
fn a_record_that_is_gone_and_a_file_that_is_no_session_are_refused() {
    let folder = folder_with(&SESSION.replace("../data/demo.csv", "gone.csv"), DEMO);
    for (name, wanted) in [("demo.toml", "gone.csv is not there"), ("none.toml", "none.toml: cannot read")] {
        let ran = folder.run(&format!("replay {name}"));
        assert_eq!((ran.status, ran.out.as_str()), (2, ""));
        assert!(ran.err.contains(wanted), "{}", ran.err);
    }
    let no_session = folder.run("replay demo.csv");
    assert_eq!(no_session.status, 2);
    assert!(no_session.err.contains("demo.csv:1: "), "{}", no_session.err);
}

#[test]
fn a_result_that_differs_is_a_difference_and_no_error() {
    let folder = folder_with(&SESSION.replacen("flagged = ", "flagged = 1", 1), DEMO);
    let ran = folder.run("replay demo.toml --check");
    assert_eq!((ran.status, ran.err.as_str()), (1, ""));
    let flagged = recorded(SESSION, "flagged");
    assert!(ran.out.contains(&format!("{flagged} samples flagged, the session recorded 1{flagged}")), "{}", ran.out);
    let json = folder.run("replay demo.toml --check --json");
    let told: serde_json::Value = serde_json::from_str(&json.out).unwrap();
    assert_eq!((json.status, &told[0]["matches"]), (1, &false.into()));
}

/// The demonstration record and a session of format 2 with four decisions on it.
fn saved() -> Folder {
    let folder = folder_with(SESSION, DEMO);
    let path = folder.path("demo.toml");
    let mut opened = open(&path, Accepted::default()).unwrap();
    let analysed = Analysed::of(&opened.session, &opened.track, &Stop::never()).unwrap();
    let text = document(&mut opened.session, &opened.track, &analysed, &path).unwrap();
    std::fs::write(path, text).unwrap();
    folder
}

#[test]
fn whatever_was_changed_in_a_session_is_named_although_the_result_is_the_same() {
    let folder = saved();
    assert_eq!(folder.done("replay demo.toml --check"), "demo.toml: same result\n");
    let text = folder.text("demo.toml");
    let line = |start: &str| text.lines().find(|l| l.starts_with(start)).unwrap().to_owned() + "\n";
    let accepting = line("  { row = 222");
    let row_check = line("row_check");
    let program = line("program");
    let digest = &text[text.find("\n[digest]").unwrap()..];
    for (from, to, named) in [
        ("max_fill = 20", "max_fill = 21", "max_fill of vx_mps was changed"),
        ("the beacon was switched", "the beacon was stolen", "row 91 of vx_mps: the decision or its note was changed"),
        (&accepting, "", "row 222 of vx_mps: the decision or its note was removed"),
        (&row_check, "", "row_check was removed"),
        (&program, "program = \"wildpoint 9.9.9\"\n", "program was changed"),
        ("rows = 2356\n", "rows = 2356\ntruth = \"vx_truth_outlier\"\n", "truth was added"),
        (digest, "", "the digest was removed"),
        ("flags_sha256 = \"", "flags_sha256 = \"0", "flags_sha256 was changed"),
    ] {
        let changed = text.replacen(from, to, 1);
        assert_ne!(changed, text, "{from}");
        std::fs::write(folder.path("demo.toml"), &changed).unwrap();
        let ran = folder.run("replay demo.toml --check");
        assert_eq!((ran.status, ran.err.as_str()), (1, ""), "{from}");
        assert!(ran.out.contains(named), "{from}: {}", ran.out);
        assert!(folder.done("replay demo.toml").contains(&format!("not what the session recorded: {named}")), "{from}");
    }
    // What it looks like is free.
    std::fs::write(folder.path("demo.toml"), format!("# kept by hand\r\n{}", text.replace('\n', "\r\n"))).unwrap();
    assert_eq!(folder.done("replay demo.toml --check"), "demo.toml: same result\n");
}

#[test]
fn a_threshold_that_changes_no_flag_is_named() {
    let folder = Folder::with_demo();
    folder.done("clean demo.csv -q --channel vx_mps --set k=4.0 --save-session s.toml");
    let text = folder.text("s.toml");
    // The same flags, as the panel of the workbench shows.
    std::fs::write(folder.path("s.toml"), text.replacen("k = 4.0", "k = 4.1", 1)).unwrap();
    let ran = folder.run("replay --check s.toml");
    assert_eq!(ran.status, 1);
    assert!(ran.out.contains("k of vx_mps was changed since the session was saved"), "{}", ran.out);
    assert!(!ran.out.contains("samples flagged"), "the count is the same: {}", ran.out);
}

#[test]
fn a_session_finds_its_record_from_whatever_folder_it_was_saved_in() {
    let folder = Folder::with_demo();
    for name in ["a", "a/b", "sessions"] {
        std::fs::create_dir(folder.path(name)).unwrap();
    }
    folder.done("clean demo.csv -q --save-session a/b/s.toml");
    assert!(folder.text("a/b/s.toml").contains("\nfile = \"../../demo.csv\"\n"), "{}", folder.text("a/b/s.toml"));
    // The folders are moved together with what they hold, and the program runs from elsewhere.
    std::fs::create_dir(folder.path("moved")).unwrap();
    std::fs::rename(folder.path("a"), folder.path("moved/a")).unwrap();
    std::fs::rename(folder.path("demo.csv"), folder.path("moved/demo.csv")).unwrap();
    assert_eq!(folder.done("replay --check moved/a/b/s.toml"), "moved/a/b/s.toml: same result\n");
}

#[test]
fn outputs_of_a_replay_never_take_the_place_of_session_or_record() {
    let folder = folder_with(SESSION, DEMO);
    for name in ["demo.toml", "demo.csv"] {
        let ran = folder.run(&format!("replay demo.toml -o {name} --force"));
        assert_eq!(ran.status, 2);
        assert!(ran.err.contains(&format!("{name}: this is the input")), "{}", ran.err);
    }
    let several = folder.run("replay demo.toml demo.toml -o clean.csv");
    assert_eq!(several.status, 2);
    assert!(several.err.contains("name a folder"), "{}", several.err);
    assert_eq!(folder.run("replay demo.toml --check -o clean.csv").status, 2);
    assert_eq!(folder.names(), ["demo.csv", "demo.toml"]);
}

#[test]
fn a_result_that_is_not_the_recorded_one_is_told_without_a_check() {
    let clean = recorded(SESSION, "clean_sha256");
    let other = SESSION.replace(&clean, &"0".repeat(64));
    for (session, differs) in [(SESSION, false), (other.as_str(), true)] {
        for output in ["", " -o clean.csv --force"] {
            let folder = folder_with(session, DEMO);
            let text = folder.done(&format!("replay demo.toml{output}"));
            let said = format!("note: not what the session recorded: the cleaned file has SHA-256 {clean}");
            assert_eq!(text.contains(&said), differs, "{text}");
            let json = folder.done(&format!("replay demo.toml --json{output}"));
            let summary: serde_json::Value = serde_json::from_str(&json).unwrap();
            assert_eq!(summary["differs"].as_array().unwrap().len(), usize::from(differs), "{json}");
            assert_eq!(folder.run("replay --check demo.toml").status, i32::from(differs));
        }
    }
}
