//! Parquet files as inputs and outputs of the program.

#![expect(clippy::unwrap_used, reason = "a failed expectation is a failed test")]

#[expect(dead_code, reason = "other tests use all of it")]
mod program;

use program::Folder;

/// How records are judged.
const JUDGED: &str = "--method hampel --repair linear";
/// How they are copied: nothing lies so far from its median.
const UNCHANGED: &str = "--channel y_m --method hampel --set k=1000";

/// A record of a straight line with one wild point and an empty cell.
fn record() -> String {
    let row = |i: usize| {
        let y = match i {
            30 => "99.50".to_owned(),
            40 => String::new(),
            _ => format!("{:.2}", i as f64 / 2.0),
        };
        format!("2021-03-04T10:00:{i:02}Z,{y},{},w{}\n", i * i % 11, i % 3)
    };
    let rows: String = (0..60).map(row).collect();
    format!("time,y_m,n,who\n{rows}")
}

/// The folder with the record as text and as Parquet.
fn folder() -> Folder {
    let folder = Folder::with(&[("in.csv", record().as_bytes())]);
    folder.done(&format!("clean in.csv {UNCHANGED} -o in.parquet"));
    folder
}

fn bytes(folder: &Folder, name: &str) -> Vec<u8> {
    std::fs::read(folder.path(name)).unwrap()
}

#[test]
fn the_cleaned_file_has_the_form_that_its_name_says() {
    let folder = folder();
    folder.done(&format!("clean in.parquet {JUDGED} --channel y_m -o out.parquet"));
    folder.done(&format!("clean in.parquet {JUDGED} --channel y_m -o out.csv"));
    assert!(bytes(&folder, "out.parquet").starts_with(b"PAR1"));
    let text = folder.text("out.csv");
    let lines: Vec<&str> = text.lines().collect();
    assert_eq!((lines.len(), lines[0]), (61, "time,y_m,n,who"));
    assert_eq!(lines[31], "2021-03-04T10:00:30.000000Z,15,9,w0", "{text}");
    // The copy says the same.
    folder.done(&format!("clean out.parquet {UNCHANGED} -o again.csv"));
    assert_eq!(folder.text("again.csv"), text);
    // In a folder, and from standard input.
    folder.done(&format!("clean in.parquet {JUDGED} --channel y_m -o d/ --flags d/"));
    assert_eq!(bytes(&folder, "d/in.parquet"), bytes(&folder, "out.parquet"));
    assert!(folder.path("d/in.flags.csv").exists());
    let shown = folder.run(&format!("clean in.parquet {JUDGED} --channel y_m -o -"));
    assert_eq!((shown.status, shown.out.as_str()), (0, text.as_str()));
}

#[test]
fn a_session_gives_the_same_bytes_again() {
    let folder = folder();
    let options = format!("{JUDGED} --channel y_m --fill-gaps cells");
    folder.done(&format!("clean in.parquet {options} -o out.parquet --flag-columns qartod --save-session s.toml"));
    folder.done("replay s.toml -o again.parquet --flag-columns qartod");
    assert_eq!(bytes(&folder, "again.parquet"), bytes(&folder, "out.parquet"));
    assert!(folder.done("replay s.toml --check").contains("same result"));
    let told = folder.done("replay s.toml -o plain.parquet --json");
    assert!(told.contains("\"differs\": []"), "{told}");
    folder.done("replay s.toml -o d/");
    assert_eq!(bytes(&folder, "d/s.parquet"), bytes(&folder, "plain.parquet"));
}

#[test]
fn flags_are_columns_that_say_what_they_mean() {
    let folder = folder();
    for (input, scheme, wild, empty) in [
        ("in.parquet", "qartod", "4", "9"),
        ("in.parquet", "words", "repaired", "missing"),
        ("in.csv", "argo", "8", "9"),
    ] {
        folder.done(&format!("clean {input} {JUDGED} --channel y_m -o f.parquet --force --flag-columns {scheme}"));
        folder.done(&format!("clean f.parquet {UNCHANGED} -o f.csv --force"));
        let text = folder.text("f.csv");
        let flags: Vec<&str> = text.lines().map(|line| line.rsplit(',').next().unwrap()).collect();
        assert_eq!((flags[0], flags[31], flags[41]), ("y_m_flag", wild, empty), "{text}");
        let file = String::from_utf8_lossy(&bytes(&folder, "f.parquet")).into_owned();
        for key in
            ["y_m_flag:standard_name", "y_m_flag:flag_values", "y_m_flag:flag_meanings", "y_m:ancillary_variables"]
        {
            assert!(file.contains(key), "{key}");
        }
    }
}

#[test]
fn what_is_no_parquet_has_no_such_name() {
    let folder = folder();
    for (output, way_out) in [
        ("--flags f.parquet", ".csv"),
        ("--changed f.parquet", ".csv"),
        ("--diagnostics f.PARQUET", ".csv"),
        ("--save-session s.parquet", ".toml"),
        ("-o f.parquet.gz", "last ending"),
    ] {
        let ran = folder.run(&format!("clean in.csv {JUDGED} --channel y_m {output}"));
        assert!(ran.status == 2 && ran.err.contains(way_out), "{output}: {}", ran.err);
    }
    let ran = folder.run("inspect in.parquet --skip 2");
    assert!(ran.status == 2 && ran.err.contains("--skip"), "{}", ran.err);
    assert_eq!(folder.names(), ["in.csv", "in.parquet"]);
}
