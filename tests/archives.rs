//! `replay --archive`: a session on a folder of files, its digest printed, recorded and checked.

#![expect(clippy::unwrap_used, reason = "a failed expectation is a failed test")]

#[expect(dead_code, reason = "other test programs use the rest")]
mod program;

use std::fmt::Write as _;

use program::Folder;

const DEMO: &str = include_str!("../data/demo.csv");

/// The demonstration record as two tracks, the rows of both in each of three files; and a session made on the record.
fn archive() -> Folder {
    let folder = Folder::with_demo();
    folder.done("clean demo.csv --channel vx_mps --method hampel --save-session s.toml --quiet");
    std::fs::create_dir(folder.path("parts")).unwrap();
    let (header, rows) = DEMO.split_once('\n').unwrap();
    for part in 0..3 {
        let mut text = format!("pass,{header}\n");
        for (_, row) in rows.lines().enumerate().filter(|(at, _)| at % 3 == part) {
            writeln!(text, "a,{row}\nb,{row}").unwrap();
        }
        std::fs::write(folder.path(&format!("parts/{part}.csv")), text).unwrap();
    }
    folder
}

const REPLAY: &str = "replay s.toml --archive parts --track pass";

#[test]
fn the_digest_of_an_archive_is_printed_recorded_and_checked() {
    let folder = archive();
    let printed = folder.done(REPLAY);
    let flagged: usize = folder
        .done("clean demo.csv --channel vx_mps --method hampel --json")
        .split("\"flagged\": ")
        .nth(1)
        .and_then(|rest| rest.split(|c: char| !c.is_ascii_digit()).next())
        .unwrap()
        .parse()
        .unwrap();
    let rows = 2 * (DEMO.lines().count() - 1);
    let start = format!("s.toml: 2 tracks, {rows} rows, {} samples flagged, digest ", 2 * flagged);
    assert!(printed.starts_with(&start), "{printed}");
    let ran = folder.run(&format!("{REPLAY} --check"));
    assert_eq!((ran.status, ran.err.as_str()), (1, ""));
    assert!(ran.out.contains("the session has no [archive] to compare with"), "{}", ran.out);
    folder.done(&format!("{REPLAY} --record --threads 2"));
    assert!(folder.text("s.toml").contains(printed.trim().rsplit(' ').next().unwrap()));
    // What was named is recorded, too.
    assert_eq!(folder.done("replay s.toml --archive parts --check --threads 1"), "s.toml: same result\n");
    assert_eq!(folder.done("replay s.toml --check"), "s.toml: same result\n", "the record is another matter");
    let part = folder.text("parts/1.csv");
    std::fs::write(folder.path("parts/1.csv"), part.replacen("a,101.0,", "a,101.25,", 1)).unwrap();
    let differs = folder.run("replay s.toml --archive parts --check --json");
    assert_eq!(differs.status, 1);
    assert!(differs.out.contains("the digest of the archive is"), "{}", differs.out);
}

#[test]
fn what_cannot_be_applied_to_an_archive_is_refused() {
    let folder = archive();
    let decided = include_str!("../sessions/hampel_decisions.toml").replace("../data/demo.csv", "demo.csv");
    std::fs::write(folder.path("decided.toml"), decided).unwrap();
    let refused = |words: &str| {
        let ran = folder.run(words);
        assert_eq!((ran.status, ran.out.as_str()), (2, ""), "{words}");
        ran.err
    };
    let said = refused("replay decided.toml --archive parts --track pass --time t_s");
    assert!(said.contains("decided.toml:16: the session has decisions (4), which belong to one record"), "{said}");
    folder.done("replay decided.toml --archive parts --track pass --time t_s --decisions=b");
    let said = refused("replay decided.toml --archive parts --track pass --time t_s --decisions=b --record");
    assert!(said.contains("format 1 has no [archive]"), "{said}");
    assert!(refused("replay s.toml s.toml --archive parts").contains("2 sessions for one archive"));
    assert!(refused("replay s.toml --record").contains("--archive"));
    assert!(refused("replay s.toml --archive parts -o clean.csv").contains("cannot be used with"));
    let changed = folder.text("s.toml").replace("k = 3.0", "k = 3.5");
    std::fs::write(folder.path("s.toml"), &changed).unwrap();
    let said = refused(&format!("{REPLAY} --record"));
    assert!(said.contains("k of vx_mps was changed since the session was saved"), "{said}");
    assert_eq!(folder.text("s.toml"), changed, "nothing is written");
}
