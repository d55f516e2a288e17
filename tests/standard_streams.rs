//! `-` is standard input or standard output, and standard output that is closed is no place for a result.

#![cfg(unix)]
#![expect(clippy::unwrap_used, reason = "a failed expectation is a failed test")]
#![expect(dead_code, reason = "a module that is shared by test programs")]

mod program;

use program::{Folder, Ran};

/// Runs a line of the shell in the folder; `wildpoint` is the program.
fn shell(folder: &Folder, line: &str) -> Ran {
    let mut command = std::process::Command::new("sh");
    command.current_dir(folder.path("")).env("W", env!("CARGO_BIN_EXE_wildpoint")).env("LANG", "C.UTF-8");
    let line = line.replace("wildpoint", "\"$W\"");
    let output = command.args(["-c", &line]).output().unwrap();
    let text = |bytes: Vec<u8>| String::from_utf8(bytes).unwrap();
    Ran { status: output.status.code().unwrap(), out: text(output.stdout), err: text(output.stderr) }
}

#[test]
fn outputs_go_to_standard_output_alone_and_words_beside_it() {
    let folder = Folder::with_demo();
    folder.done("clean demo.csv -o clean.csv --flags flags.csv --save-session s.toml -q");
    for (words, file) in [
        ("clean demo.csv -o -", "clean.csv"),
        ("clean demo.csv --flags -", "flags.csv"),
        ("clean demo.csv --flags - -o again.csv", "flags.csv"),
        ("replay s.toml -o -", "clean.csv"),
        ("replay s.toml --flags - -q", "flags.csv"),
    ] {
        let ran = folder.run(words);
        assert_eq!((ran.status, ran.out == folder.text(file)), (0, true), "{words}: {}", ran.err);
        assert_eq!(ran.err.contains("flagged by two-sided"), !words.ends_with("-q"), "{words}: {}", ran.err);
    }
    assert_eq!(folder.text("again.csv"), folder.text("clean.csv"));
    assert!(!folder.path("-").exists());
    for words in ["clean demo.csv -o - --json", "clean demo.csv -o - --flags -", "replay s.toml -o - --json"] {
        let ran = folder.run(words);
        assert_eq!((ran.status, ran.out.as_str()), (2, ""), "{words}");
        assert!(ran.err.contains("standard output"), "{words}: {}", ran.err);
    }
}

#[test]
fn a_record_on_standard_input_gives_what_the_file_gives() {
    let folder = Folder::with_demo();
    folder.done("clean demo.csv -o clean.csv --flags flags.csv -q");
    let piped = shell(&folder, "cat demo.csv | wildpoint clean - -o - -q");
    assert_eq!((piped.status, piped.err.as_str()), (0, ""));
    assert!(piped.out == folder.text("clean.csv"));
    let table = shell(&folder, "wildpoint clean - --flags - -q < demo.csv");
    assert!(table.out == folder.text("flags.csv"));
    let inspected = shell(&folder, "cat demo.csv | wildpoint inspect -");
    assert!(inspected.status == 0 && inspected.out.contains("2356"), "{}{}", inspected.out, inspected.err);
    assert_eq!(shell(&folder, "cat demo.csv | wildpoint sweep - --json").status, 0);
    let report = shell(&folder, "wildpoint clean - --report r.html -q < demo.csv");
    assert_eq!((report.status, report.err.as_str()), (0, ""));
    // A session names a record that can be found again.
    let session = shell(&folder, "wildpoint clean - --save-session s.toml < demo.csv");
    assert_eq!(session.status, 2);
    assert!(session.err.contains("a session cannot find it again"), "{}", session.err);
    assert!(!folder.path("s.toml").exists());
}

#[test]
fn a_session_on_standard_input_is_replayed() {
    let folder = Folder::with_demo();
    folder.done("clean demo.csv -o clean.csv --save-session s.toml -q");
    let ran = shell(&folder, "cat s.toml | wildpoint replay - -o - -q");
    assert_eq!((ran.status, ran.out == folder.text("clean.csv")), (0, true), "{}", ran.err);
    assert_eq!(shell(&folder, "cat s.toml | wildpoint replay --check -").out, "-: same result\n");
}

#[test]
fn a_pipe_by_its_name_is_refused_and_not_waited_for() {
    let folder = Folder::with_demo();
    assert_eq!(shell(&folder, "mkfifo p.toml p.csv").status, 0);
    for words in ["replay p.toml", "replay --check p.toml", "inspect p.csv", "clean demo.csv -o p.csv --force"] {
        let ran = folder.run(words);
        assert_eq!(ran.status, 2, "{words}");
        assert!(ran.err.contains("not a regular file") || ran.err.contains("a pipe"), "{words}: {}", ran.err);
    }
}

#[test]
#[cfg(target_os = "linux")]
fn a_closed_standard_output_is_an_error_before_anything_is_done() {
    let folder = Folder::with_demo();
    for words in ["clean demo.csv -o out.csv", "inspect demo.csv", "methods"] {
        let ran = shell(&folder, &format!("wildpoint {words} >&-"));
        assert_eq!(ran.status, 2, "{words}");
        assert!(ran.err.contains("standard output is closed"), "{words}: {}", ran.err);
        assert!(!folder.path("out.csv").exists());
    }
    assert_eq!(shell(&folder, "wildpoint inspect demo.csv >/dev/null").status, 0);
    assert_eq!(shell(&folder, "wildpoint clean demo.csv -o out.csv -q >&-").status, 0);
}

/// Where a user may make a bind mount of his own; elsewhere there is nothing to be seen.
#[test]
#[cfg(target_os = "linux")]
#[expect(clippy::print_stderr, reason = "a test that is skipped says so")]
fn the_input_is_known_through_a_bind_mount() {
    let folder = Folder::with_demo();
    std::fs::create_dir(folder.path("mounted")).unwrap();
    let before = folder.text("demo.csv");
    let mount = "mount --bind . mounted";
    if shell(&folder, &format!("unshare -rm sh -c '{mount}'")).status != 0 {
        eprintln!("skipped: no bind mounts here");
        return;
    }
    // `$W` is for the inner shell.
    let run = "exec \"$W\" clean demo.csv -o mounted/demo.csv --force";
    let ran = shell(&folder, &format!("unshare -rm sh -c '{mount} && {run}'"));
    assert_eq!(ran.status, 2, "{}{}", ran.out, ran.err);
    assert!(ran.err.contains("this is the input"), "{}", ran.err);
    assert!(folder.text("demo.csv") == before);
}
