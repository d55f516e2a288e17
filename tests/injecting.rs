//! `inject`, `simulate` and the scores of `clean`, from the command line.

#![expect(clippy::expect_used, reason = "a test that cannot read its own data may say so by ending")]

use std::path::Path;

use assert_cmd::Command;
use serde_json::Value;

fn wildpoint(args: &[&str], folder: &Path) -> assert_cmd::assert::Assert {
    Command::cargo_bin("wildpoint").expect("the program").current_dir(folder).args(args).assert()
}

fn printed(args: &[&str], folder: &Path) -> String {
    let output = wildpoint(args, folder).success().get_output().stdout.clone();
    String::from_utf8(output).expect("text")
}

/// A record with quirks: comments, a units row, CRLF, quotes, an empty cell, a short row, a gap, no last line end.
fn quirky() -> String {
    let mut text = String::from("# made by hand\r\ntime,\"alt, m\",note\r\ns,m,\r\n");
    for i in 0..400 {
        let t = f64::from(i) * 0.5 + if i >= 200 { 30.0 } else { 0.0 };
        let alt = 1000.0 + 3.0 * t + f64::from(i * 7919 % 101) / 50.0;
        match i {
            50 => text.push_str("25.0,,\"a, b\"\r\n"),
            60 => text.push_str("# a comment between\r\n30.0\r\n"),
            70 => text.push_str(&format!("{t:.1},\" {alt:.2}\",q\r\n")),
            _ => text.push_str(&format!("{t:.1},{alt:.2},\r\n")),
        }
    }
    text.truncate(text.len() - 2);
    text
}

/// The line without its two last cells, and those.
fn split_off(line: &str) -> (&str, &str, &str) {
    let (rest, truth) = line.rsplit_once(',').expect("a truth cell");
    let (rest, raw) = rest.rsplit_once(',').expect("a raw cell");
    (rest, raw, truth)
}

#[test]
fn taking_the_injected_cells_out_gives_the_input_back() {
    let dir = tempfile::tempdir().expect("a folder");
    let input = quirky();
    std::fs::write(dir.path().join("in.csv"), &input).expect("written");
    let args =
        ["inject", "in.csv", "--seed", "5", "--isolated", "2%", "--patches", "4x3..6", "-o", "out.csv", "--json"];
    let told: Value = serde_json::from_str(&printed(&args, dir.path())).expect("json");
    let output = std::fs::read_to_string(dir.path().join("out.csv")).expect("an output");
    let (mut changed, mut marked) = (0, 0);
    let lines: Vec<(&str, &str)> = input.split("\r\n").zip(output.split("\r\n")).collect();
    assert_eq!(lines.len(), input.split("\r\n").count());
    for (old, new) in lines {
        if old.starts_with('#') {
            assert_eq!(old, new);
            continue;
        }
        if old.starts_with("time") {
            assert_eq!(new, "time,\"alt, m\",note,\"alt, m_raw\",\"alt, m_truth\"");
            continue;
        }
        if old == "s,m," {
            assert_eq!(new, "s,m,,,");
            continue;
        }
        let (cells, raw, truth) = split_off(new);
        // A short row was filled up to the new cells.
        let was_short = old == "30.0";
        if cells == old || was_short && cells == "30.0,," {
            assert_eq!(truth, "0");
        } else {
            let (start, end) = (cells.find(',').expect("cells") + 1, cells.rfind(',').expect("cells"));
            assert_eq!(format!("{}{raw}{}", &cells[..start], &cells[end..]), old, "only that cell has changed");
            assert_eq!(truth, "1");
            changed += 1;
        }
        marked += usize::from(truth == "1");
    }
    assert_eq!((changed, marked), (marked, marked));
    // 2 % of 398 samples that have a value, and four patches.
    assert_eq!((told["isolated"].as_u64(), told["patches"].as_u64()), (Some(8), Some(4)));
    assert_eq!(told["wild"].as_u64(), Some(marked as u64));
    assert!((20..=32).contains(&marked), "{marked}");
}

#[test]
fn clean_scores_what_was_injected() {
    let dir = tempfile::tempdir().expect("a folder");
    std::fs::write(dir.path().join("in.csv"), quirky()).expect("written");
    let inject = ["inject", "in.csv", "--seed", "2", "--patches", "3x2..4", "--amplitude", "20..40", "-o", "out.csv"];
    let told = printed(&inject, dir.path());
    assert!(told.contains("3 runs") && told.contains("`alt, m_truth`"), "{told}");
    let clean = ["clean", "out.csv", "--channel", "alt, m", "--reference", "alt, m_raw", "--set", "k=8", "--json"];
    let summary: Value = serde_json::from_str(&printed(&clean, dir.path())).expect("json");
    let channels = summary["channels"].as_array().expect("channels");
    assert_eq!(channels.len(), 1, "the reference is not judged");
    let (score, counts) = (&channels[0]["score"], &channels[0]["counts"]);
    let number = |v: &Value| v.as_u64().expect("a count");
    // 20 scales against a tolerance of 8: every one of them is found.
    assert_eq!((number(&score["missed"]), number(&score["events"]["missed"])), (0, 0), "{score}");
    assert_eq!((score["recall"].as_f64(), score["rejection_rate"].as_f64()), (Some(1.0), Some(1.0)));
    assert_eq!(number(&score["hits"]) + number(&score["false_alarms"]), number(&counts["flagged"]));
    let lengths = score["by_run_length"].as_array().expect("lengths");
    let samples: u64 = lengths.iter().map(|l| number(&l["samples"])).sum();
    assert_eq!(samples, number(&score["wild"]));
    assert_eq!(number(&score["patches"]["events"]), 3);
    let error = &channels[0]["final_error"];
    assert_eq!(number(&error["samples"]) + number(&error["removed"]), number(&counts["present"]));
    let mut without = clean.to_vec();
    without.retain(|a| *a != "--json");
    assert!(printed(&without, dir.path()).contains("final error"));
    wildpoint(&["clean", "out.csv", "--channel", "alt, m", "--reference", "nothing"], dir.path()).failure();
}

#[test]
fn injecting_is_repeatable_and_never_over_the_input() {
    let dir = tempfile::tempdir().expect("a folder");
    std::fs::write(dir.path().join("in.csv"), quirky()).expect("written");
    let read = |name: &str| std::fs::read(dir.path().join(name)).expect("an output");
    for name in ["a.csv", "b.csv"] {
        printed(&["inject", "in.csv", "--seed", "9", "--step", "-12@40", "-o", name], dir.path());
    }
    printed(&["inject", "in.csv", "--seed", "10", "--step", "-12@40", "-o", "c.csv"], dir.path());
    assert_eq!(read("a.csv"), read("b.csv"));
    assert_ne!(read("a.csv"), read("c.csv"));
    let refused = wildpoint(&["inject", "in.csv", "--force", "-o", "in.csv"], dir.path()).failure();
    assert!(String::from_utf8_lossy(&refused.get_output().stderr).contains("never overwritten"));
    let again = wildpoint(&["inject", "a.csv", "--channel", "alt, m", "-o", "d.csv"], dir.path()).failure().code(2);
    assert!(String::from_utf8_lossy(&again.get_output().stderr).contains("already"));
}

#[test]
fn simulate_writes_what_clean_scores() {
    let dir = tempfile::tempdir().expect("a folder");
    let text = printed(&["simulate", "jin", "--seed", "4"], dir.path());
    printed(&["simulate", "jin", "--seed", "4", "-o", "jin.csv"], dir.path());
    assert_eq!(std::fs::read_to_string(dir.path().join("jin.csv")).expect("an output"), text);
    let clean = ["clean", "jin.csv", "--channel", "x", "--reference", "x_clean", "--method", "trend-wright", "--json"];
    let summary: Value = serde_json::from_str(&printed(&clean, dir.path())).expect("json");
    // [002]: the trend lets 3 sigma find the 20 outliers of 5 and more at a noise of 0.5.
    assert_eq!(summary["channels"][0]["score"]["missed"].as_u64(), Some(0));
    wildpoint(&["simulate", "jun"], dir.path()).failure().code(2);
    wildpoint(&["reproduce", "demo"], dir.path()).failure().code(2);
    wildpoint(&["simulate", "jin", "--runs", "0"], dir.path()).failure().code(2);
}
