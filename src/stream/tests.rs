use std::cell::RefCell;
use std::path::Path;
use std::rc::Rc;

use clap::Parser;

use super::*;
use crate::cli::{Cli, Command, Task};
use crate::experiment::Random;
use crate::method::{self, Judged, judge_channel, noise};
use crate::param::Settings;
use crate::stop::Stop;

mod same;

fn args(line: &str) -> StreamArgs {
    let words = ["wildpoint", "stream"].into_iter().chain(line.split_whitespace());
    match Cli::try_parse_from(words).unwrap().command {
        Some(Task::Batch(Command::Stream(args))) => args,
        other => panic!("{other:?}"),
    }
}

/// What a stream of `input` prints, and what it tells.
fn streamed(options: &str, input: &str) -> (String, String) {
    let (mut out, mut err) = (Vec::new(), Vec::new());
    run(&args(options), input.as_bytes(), &mut out, &mut err).unwrap();
    (String::from_utf8(out).unwrap(), String::from_utf8(err).unwrap())
}

fn refused(options: &str) -> String {
    run(&args(options), &b""[..], &mut Vec::new(), &mut Vec::new()).unwrap_err().to_string()
}

const FIVE: &str = "--method five-point --set sigma=1 --interval 1";

/// A line at rest with a spike at row 8.
fn spiked() -> String {
    (0..12).fold("t,x\n".to_owned(), |text, i| text + &format!("{i},{}\n", if i == 7 { 90 } else { 5 }))
}

fn verdicts(out: &str) -> Vec<(u64, String, bool)> {
    let row = |l: &str| {
        let cells: Vec<&str> = l.split(',').collect();
        (cells[0].parse().unwrap(), cells[3].to_owned(), cells[6] == "correction")
    };
    out.lines().skip(1).map(row).collect()
}

#[test]
fn a_line_for_each_line_and_corrections_once_a_start_group_is_complete() {
    let (out, err) = streamed(FIVE, &spiked());
    let said = verdicts(&out);
    let first: Vec<&str> = said.iter().filter(|s| !s.2).map(|s| s.1.as_str()).collect();
    let mut expected = vec!["unchecked"; 4];
    expected.extend(["normal", "normal", "normal", "outlier", "normal", "normal", "normal", "normal"]);
    assert_eq!(first, expected);
    let corrected: Vec<u64> = said.iter().filter(|s| s.2 && s.1 == "normal").map(|s| s.0).collect();
    assert_eq!(corrected, [1, 2, 3, 4]);
    assert_eq!(said[4].0, 5, "the row itself comes before what it corrects");
    assert!(err.contains("12 rows: 1 outliers\n"), "{err}");
}

#[test]
fn a_run_that_is_too_long_is_taken_back_and_told() {
    let step = (0..20).fold("t,x\n".to_owned(), |text, i| text + &format!("{i},{}\n", if i < 8 { 5 } else { 90 }));
    let (out, err) = streamed(&format!("{FIVE} --set max_run=6"), &step);
    let said = verdicts(&out);
    assert!(said.iter().any(|s| s.0 == 9 && s.1 == "outlier" && !s.2));
    let last = |row: u64| said.iter().rfind(|s| s.0 == row).map(|s| s.1.as_str());
    assert_eq!((last(9), last(10), last(20)), (Some("suspect"), Some("normal"), Some("normal")));
    assert!(err.contains("row 9, time 8: more than max_run outliers"), "{err}");
    assert!(err.contains("20 rows: 0 outliers, 1 suspects, 1 restarts"), "{err}");
}

#[test]
fn bad_lines_pass_through_counted_and_disturb_nothing() {
    let clean = spiked();
    let mut lines: Vec<&str> = clean.lines().collect();
    for (at, bad) in [(11, "9.5,inf"), (9, "7.2,oops"), (8, "3"), (6, "2,5"), (5, "# a remark"), (4, "2.5,"), (3, "")] {
        lines.insert(at, bad);
    }
    let (out, err) = streamed(FIVE, &(lines.join("\n") + "\n"));
    let rows = verdicts(&out);
    let of = |word: &str| rows.iter().filter(|r| r.1 == word).count();
    assert_eq!((of("unreadable"), of("missing"), of("outlier")), (3, 2, 1));
    assert_eq!(rows.iter().filter(|r| !r.2).count(), 17, "comments and blank lines are no samples");
    assert!(err.contains("1 without a value, 1 with a time that is not after the one before, 3 unreadable"), "{err}");
    assert!(err.contains("line 13: cannot be read: 3"), "{err}");
    let judged = |out: &str| -> Vec<String> {
        let good = out.lines().filter(|l| l.ends_with(',') && !l.contains("unreadable") && !l.contains("missing"));
        good.map(|l| l.split_once(',').unwrap().1.to_owned()).collect()
    };
    assert_eq!(judged(&out), judged(&streamed(FIVE, &clean).0));
}

#[test]
fn objects_say_what_cells_say() {
    let objects = spiked().lines().skip(1).fold(String::new(), |text, line| {
        let (t, x) = line.split_once(',').unwrap();
        text + &format!("{{\"x\": {x}, \"id\": \"a\", \"t\": {t}.0}}\n")
    });
    // The first object lacks the channel, and another is not closed.
    let broken = objects.replacen("\"t\": 9.0}", "\"t\": 9.0", 1).replacen("\"x\": 5, ", "", 1);
    let (out, _) = streamed(&format!("{FIVE} --time t --channel x"), &broken);
    let told: Vec<serde_json::Value> = out.lines().map(|l| serde_json::from_str(l).unwrap()).collect();
    let first = |row: u64| told.iter().find(|v| v["row"] == row).unwrap();
    assert_eq!((&first(8)["verdict"], &first(8)["value"]), (&"outlier".into(), &90.0.into()));
    assert_eq!(first(10)["verdict"], "unreadable");
    assert_eq!(first(1)["verdict"], "missing");
    assert!(told.iter().any(|v| v["row"] == 2 && v["correction"] == true && v["verdict"] == "normal"));
    assert_eq!(told.iter().filter(|v| v.get("correction").is_none()).count(), 12);
}

#[test]
fn the_last_line_may_be_cut_short() {
    let (out, err) = streamed(FIVE, spiked().trim_end());
    assert_eq!(verdicts(&out).iter().filter(|v| !v.2).count(), 12);
    assert!(err.contains("line 13: has no line end"), "{err}");
    let (out, _) = streamed(FIVE, &(spiked() + "12"));
    assert!(out.ends_with("unreadable,,,\n"), "{out}");
}

#[test]
fn without_an_interval_it_looks_at_the_first_steps() {
    let rows: String = (0..14).fold(String::new(), |text, i| {
        text + &format!("{}.5;{}\n", 1_700_000_000 + 2 * i, if i == 11 { 90 } else { 5 })
    });
    let unnamed = run(&args("--method template"), rows.as_bytes(), &mut Vec::new(), &mut Vec::new());
    assert!(unnamed.unwrap_err().to_string().contains("--time"), "which of two numbers is the time cannot be guessed");
    let (out, err) = streamed("--method five-point --set sigma=1 --time #1", &rows);
    let said = verdicts(&out);
    assert_eq!(said.iter().filter(|s| !s.2).count(), 14, "the first line is data");
    assert!(said.contains(&(12, "outlier".into(), false)), "{out}");
    assert!(err.contains("14 rows: 1 outliers"), "{err}");
    // The same with steps of 2 s taken for gaps of one lost sample: no start group has one.
    let (out, _) = streamed("--method five-point --set sigma=1 --interval 1 --time #1", &rows);
    assert!(verdicts(&out).iter().all(|s| s.1 == "unchecked"), "{out}");
}

#[test]
fn few_rows_are_judged_when_the_sender_ends() {
    let (out, _) = streamed("--method template", "t,x\n1,5\n2,5\n");
    assert_eq!(verdicts(&out).len(), 2);
    assert_eq!(streamed("--method template", "").1, "wildpoint: 0 rows: 0 outliers\n");
    let none = run(&args("--method template"), &b"t,x\n"[..], &mut Vec::new(), &mut Vec::new());
    assert!(none.is_err(), "a header is no stream");
}

#[test]
fn midnight_is_no_step_back_and_a_step_back_is_no_midnight() {
    let row = |i: u32| format!("23:59:{:02},5\n", 50 + i);
    let next = |i: u32| format!("00:00:{i:02},5\n");
    let rows: Vec<String> = (0..10).map(row).chain((0..7).map(next)).collect();
    let text = "time,x\n".to_owned() + &rows.concat();
    assert!(streamed(FIVE, &text).1.contains("17 rows: 0 outliers\n"));
    let back = text.replacen("50,5\n", "50,5\n23:59:49,5\n", 1);
    let (_, err) = streamed(FIVE, &back);
    assert!(err.contains("18 rows: 0 outliers, 1 with a time that is not after the one before\n"), "{err}");
}

#[test]
fn what_needs_the_future_is_refused_with_the_way_out() {
    for (options, what) in [
        ("--method five-point", "sigma=NUMBER"),
        ("--method two-sided --set delta=9", "sigma=NUMBER"),
        ("--method hampel", "five-point"),
        ("--method matched", "needs samples that come later"),
        ("--method five-point --set sigma=1 --set look_back=true", "look_back"),
        ("--method template --set noise_floor=pooled", "noise_floor"),
        ("--method two-sided --set sigma=1 --set direction=both", "direction"),
        ("--method kalman --set sigma=1 --set test=joint", "test = joint"),
        ("--method five-point --set sigma=1 --interval 0", "--interval 0"),
        ("--method five-point --set sigma=1 --channel a --channel b", "one channel"),
    ] {
        let text = refused(options);
        assert!(text.contains(what), "{options}: {text}");
    }
}

/// Hands out one line at a time, and looks at what has come out before it gives the next.
struct Patient {
    lines: Vec<String>,
    out: Rc<RefCell<Vec<u8>>>,
    seen: Vec<usize>,
}

impl Read for &mut Patient {
    fn read(&mut self, buffer: &mut [u8]) -> std::io::Result<usize> {
        self.seen.push(String::from_utf8_lossy(&self.out.borrow()).lines().count());
        if self.lines.is_empty() {
            return Ok(0);
        }
        let line = self.lines.remove(0);
        buffer[..line.len()].copy_from_slice(line.as_bytes());
        Ok(line.len())
    }
}

struct Shared(Rc<RefCell<Vec<u8>>>);

impl Write for Shared {
    fn write(&mut self, bytes: &[u8]) -> std::io::Result<usize> {
        self.0.borrow_mut().extend_from_slice(bytes);
        Ok(bytes.len())
    }

    fn flush(&mut self) -> std::io::Result<()> {
        Ok(())
    }
}

#[test]
fn a_sender_that_pauses_has_all_answers_to_what_it_sent() {
    let out = Rc::new(RefCell::new(Vec::new()));
    let lines = ["t,x\n", "0,5\n", "1,", "5\n2,5\n", "3,5\n"].map(str::to_owned).to_vec();
    let mut patient = Patient { lines, out: Rc::clone(&out), seen: Vec::new() };
    let mut writer = std::io::BufWriter::new(Shared(out));
    run(&args(&format!("{FIVE} --time t")), &mut patient, &mut writer, &mut Vec::new()).unwrap();
    assert_eq!(patient.seen, [0, 0, 2, 2, 4, 5], "the header comes with the first answer");
}

#[test]
fn a_reader_that_has_gone_away_ends_the_stream() {
    struct Gone;
    impl Write for Gone {
        fn write(&mut self, _: &[u8]) -> std::io::Result<usize> {
            Err(std::io::ErrorKind::BrokenPipe.into())
        }
        fn flush(&mut self) -> std::io::Result<()> {
            Ok(())
        }
    }
    let ended = run(&args(FIVE), spiked().as_bytes(), &mut Gone, &mut Vec::new());
    assert!(matches!(ended, Err(Error::Io { source, .. }) if source.kind() == std::io::ErrorKind::BrokenPipe));
}
