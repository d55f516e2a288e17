//! What the commands refuse: exit status 2, what, where and the way out on standard error, nothing written.

#![expect(clippy::unwrap_used, reason = "a failed expectation is a failed test")]

mod program;

use program::Folder;

/// Bytes that are no text: a PNG begins like this.
const BINARY: &[u8] = b"\x89PNG\r\n\x1a\n\0\0\0\rIHDR\0\0\x02\0\0\0\x01\0\x08\x06\0\0\0";

fn folder() -> Folder {
    let folder = Folder::with_demo();
    std::fs::create_dir(folder.path("folder")).unwrap();
    let files: [(&str, &[u8]); 5] = [
        ("binary.csv", BINARY),
        ("empty.csv", b""),
        ("header.csv", b"t,y\n"),
        ("there.csv", b"kept\n"),
        ("words.csv", b"a,b\nx,y\nz,w\n"),
    ];
    files.into_iter().for_each(|(name, bytes)| std::fs::write(folder.path(name), bytes).unwrap());
    folder
}

/// Outputs that must not appear.
const OUTPUTS: &str = "-o new.csv --flags flags.csv --diagnostics diag.csv --save-session s.toml";

/// Runs each of `cases`: arguments, and what the message must say.
fn refused(cases: &[(&str, &[&str])]) {
    let folder = folder();
    let before = folder.names();
    for (words, wanted) in cases {
        let ran = folder.run(words);
        assert_eq!((ran.status, ran.out.as_str()), (2, ""), "wildpoint {words}\n{}", ran.err);
        for part in *wanted {
            assert!(ran.err.contains(part), "wildpoint {words}\n{}does not say: {part}", ran.err);
        }
        // What and where on the first line, the way out on the next.
        let lines: Vec<&str> = ran.err.lines().filter(|line| !line.trim().is_empty()).collect();
        assert!(lines.len() >= 2, "wildpoint {words}\n{}names no way out", ran.err);
        assert!(lines[0].starts_with("wildpoint: ") || lines[0].starts_with("error: "), "{}", ran.err);
        assert_eq!(folder.names(), before, "wildpoint {words} left a file");
    }
    assert_eq!(folder.text("there.csv"), "kept\n");
    assert!(folder.text("demo.csv") == include_str!("../data/demo.csv"), "the input is as it was");
}

#[test]
fn one_setting_with_two_values() {
    let words = format!("clean demo.csv --max-gap 3 --set max_gap=off {OUTPUTS}");
    refused(&[(&words, &["--max-gap 3", "max_gap=off", "give one of them"])]);
}

#[test]
fn files_that_are_no_records() {
    let case = |file: &str| format!("clean {file} {OUTPUTS}");
    let (folder, empty, binary, header, words, gone) = (
        case("folder"),
        case("empty.csv"),
        case("binary.csv"),
        case("header.csv"),
        case("words.csv"),
        case("gone.csv"),
    );
    refused(&[
        (&folder, &["folder: this is a folder", "name one of the files"]),
        (&empty, &["empty.csv: the file is empty", "header and rows"]),
        (&binary, &["binary.csv", "text"]),
        (&header, &["header.csv:1", "no rows"]),
        (&words, &["words.csv"]),
        (&gone, &["gone.csv: cannot read", "No such file"]),
        ("inspect gone.csv", &["gone.csv: cannot read"]),
        ("inspect empty.csv --json", &["empty.csv: the file is empty"]),
        ("gone.csv", &["gone.csv: cannot read"]),
        ("replay gone.toml", &["gone.toml: cannot read"]),
    ]);
}

#[test]
fn columns_methods_and_settings_that_do_not_exist() {
    let case = |words: &str| format!("clean demo.csv {OUTPUTS} {words}");
    let cases: [(&str, &[&str]); 17] = [
        ("--channel vx", &["`vx`", "vx_mps, alt_m"]),
        ("--time when", &["`when`", "t_s"]),
        ("--truth alt_m", &["`alt_m`", "truth"]),
        ("--method hample", &["hample: there is no such method", "did you mean hampel?", "two-sided"]),
        ("--method matched", &["matched needs", "--rate"]),
        ("--method matched --rate speed", &["speed"]),
        ("--set direction=foward", &["direction = foward: not a legal value", "did you mean forward?"]),
        ("--set kk=3", &["kk: two-sided has no such parameter", "did you mean k?"]),
        ("--set k=-3", &["k = -3", "0.5 .. 1000"]),
        ("--set k=many", &["k = many"]),
        ("--set points=8.5", &["points = 8.5", "4 .. 30"]),
        ("--set k", &["--set", "KEY=VALUE"]),
        ("--set =3", &["--set", "KEY=VALUE"]),
        ("--repair glue", &["glue: there is no such repair", "linear, spline"]),
        ("--max-gap few", &["max_gap = few", "off"]),
        ("--fill-gaps all", &["fill_gaps = all", "cells | rows"]),
        ("--threads 0", &["--threads 0", "1 or more"]),
    ];
    let lines: Vec<(String, &[&str])> = cases.into_iter().map(|(words, wanted)| (case(words), wanted)).collect();
    refused(&lines.iter().map(|(words, wanted)| (words.as_str(), *wanted)).collect::<Vec<_>>());
    refused(&[
        ("methods hample", &["hample", "did you mean hampel?"]),
        ("clen demo.csv -o new.csv", &["clen: there is no such command", "did you mean clean?", "inspect"]),
        ("clen", &["clen: there is no such command", "did you mean clean?"]),
        ("simulate demoo", &["demoo", "did you mean demo?"]),
        ("completions tcsh", &["tcsh", "bash"]),
        ("--size 80", &["--size", "WIDTHxHEIGHT"]),
        ("demo.csv --method hample", &["hample", "did you mean hampel?"]),
        ("clean", &["FILE", "--help"]),
        ("clean demo.csv --colour", &["--colour"]),
    ]);
}

#[test]
fn outputs_that_would_destroy_something() {
    refused(&[
        ("clean demo.csv -o there.csv --flags new.csv", &["there.csv: already exists", "--force"]),
        ("clean demo.csv -o new.csv --flags there.csv", &["there.csv: already exists", "--force"]),
        ("clean demo.csv -o new.csv --save-session there.csv", &["there.csv: already exists", "--force"]),
        ("clean demo.csv -o demo.csv --force", &["demo.csv: this is the input", "another name"]),
        ("clean demo.csv -o folder/../demo.csv --force", &["this is the input", "another name"]),
        ("clean demo.csv -o new.csv --flags demo.csv --force", &["demo.csv: this is the input"]),
        ("clean demo.csv -o missing/new.csv --flags new.csv", &["missing", "folder"]),
        ("clean demo.csv -o folder", &["folder: this is a folder", "file name"]),
        ("clean demo.csv -o new.csv --flags new.csv", &["new.csv: two outputs", "different names"]),
    ]);
}

#[test]
fn with_force_an_existing_output_is_overwritten() {
    let folder = folder();
    folder.done("clean demo.csv -o there.csv --force -q");
    assert_eq!(folder.text("there.csv").lines().count(), 2357);
    let words = folder.text("words.csv");
    assert_eq!(words, "a,b\nx,y\nz,w\n");
}
