//! What the commands write and print where all goes well; what they refuse is in `cli_errors.rs`, the layouts of
//! files are in `cli_layouts.rs`.

#![expect(clippy::unwrap_used, reason = "a failed expectation is a failed test")]

mod program;

use std::io::{BufRead, BufReader};
use std::process::{Command, Stdio};

use program::Folder;
use serde_json::Value;
use wildpoint::method::METHODS;
use wildpoint::repair::REPAIRS;

const DEMO: &str = include_str!("../data/demo.csv");

fn json(text: &str) -> Value {
    serde_json::from_str(text).unwrap()
}

/// The records of a table without quoted cells, as (row, channel, cells by the header).
fn table(text: &str) -> Vec<Vec<&str>> {
    text.lines().skip(1).map(|line| line.split(',').collect()).collect()
}

#[test]
fn clean_writes_the_files_of_the_contract() {
    let folder = Folder::with_demo();
    folder.done("clean demo.csv -o clean.csv --flags flags.csv --diagnostics diag.csv --save-session s.toml");
    assert_eq!(folder.names(), ["clean.csv", "demo.csv", "diag.csv", "flags.csv", "s.toml"]);
    let (flags, diagnostics) = (folder.text("flags.csv"), folder.text("diag.csv"));
    assert_eq!(
        flags.lines().next(),
        Some(
            "row,time,channel,raw,verdict,kind,run_start,run_length,expected,tolerance,ratio,forward,backward,clean,\
             action,decided_by,note"
        )
    );
    assert_eq!(
        diagnostics.lines().next(),
        Some("row,time,channel,raw,verdict,expected,tolerance,clean,filtered,filtered_deviation")
    );
    // A row for every sample of both channels.
    assert_eq!(diagnostics.lines().count(), 1 + 2 * 2356);
    // The truth column was written by the simulation: every wild point of the velocity is in the table.
    let flagged = |row: &str, channel: &str| {
        table(&flags).iter().any(|f| f[0] == row && f[2] == channel && f[4] == "outlier" && f[15] == "method")
    };
    for (i, line) in DEMO.lines().enumerate().skip(1).filter(|(_, line)| line.ends_with(",1")) {
        assert!(flagged(&i.to_string(), "vx_mps"), "row {i}: {line}");
    }
    let session = folder.text("s.toml");
    assert!(session.starts_with("format = 2\n") && session.contains("file = \"demo.csv\"\n"), "{session}");
    assert_eq!(session.matches("[[channel]]").count(), 2);
}

#[test]
fn only_repaired_cells_differ_from_the_input() {
    let folder = Folder::with_demo();
    folder.done("clean demo.csv -o clean.csv --flags flags.csv");
    let (clean, flags) = (folder.text("clean.csv"), folder.text("flags.csv"));
    // The table is applied to the input by hand: cell of row and channel, new text in `clean`.
    let mut lines: Vec<Vec<String>> = DEMO.lines().map(|line| line.split(',').map(str::to_owned).collect()).collect();
    for flag in table(&flags).iter().filter(|f| f[4] == "outlier") {
        let column = if flag[2] == "vx_mps" { 1 } else { 2 };
        // The table has numbers, the file has them with the decimals of its columns.
        let decimals = if column == 1 { 2 } else { 1 };
        let written = flag[13].parse().map_or_else(|_| String::new(), |value: f64| format!("{value:.decimals$}"));
        lines[flag[0].parse::<usize>().unwrap()][column] = written;
        assert_eq!(flag[14], if flag[13].is_empty() { "removed" } else { "repaired" });
    }
    let by_hand: String = lines.iter().map(|cells| cells.join(",") + "\n").collect();
    assert!(clean == by_hand, "the cleaned file is not the input with the cells of the table");
    assert_ne!(clean, DEMO);
}

#[test]
fn removed_cells_are_empty_and_the_rest_of_the_row_stays() {
    let folder = Folder::with_demo();
    folder.done("clean demo.csv --channel vx_mps --repair remove -o clean.csv");
    // Row 91 of the record is the wild `91.0,55.21,407.4,1`.
    let line = folder.text("clean.csv").lines().nth(91).map(str::to_owned);
    assert_eq!(line.as_deref(), Some("91.0,,407.4,1"));
}

#[test]
fn the_summary_tells_what_the_table_holds() {
    let folder = Folder::with_demo();
    let summary = json(&folder.done("clean demo.csv --flags flags.csv --json"));
    let flags = folder.text("flags.csv");
    for (at, channel) in ["vx_mps", "alt_m"].into_iter().enumerate() {
        let told = &summary["channels"][at];
        assert_eq!(told["channel"], channel);
        let count = |verdict: &str| table(&flags).iter().filter(|f| f[2] == channel && f[4] == verdict).count();
        assert_eq!(told["counts"]["flagged"], count("outlier"));
        assert_eq!(told["counts"]["suspects"], count("suspect"));
        assert_eq!(told["counts"]["present"], 2356);
    }
    assert_eq!(summary["rows"], 2356);
    assert_eq!(summary["clean_sha256"], Value::Null, "no cleaned file was asked for");
    assert_eq!(folder.done("clean demo.csv -q"), "");
    assert!(folder.done("clean demo.csv").contains("vx_mps: "));
}

#[test]
fn a_truth_column_gives_scores() {
    let renamed = DEMO.replacen("vx_truth_outlier", "marked", 1);
    let folder = Folder::with(&[("record.csv", renamed.as_bytes())]);
    let judged = json(&folder.done("clean record.csv --channel vx_mps --truth marked --json"));
    let score = &judged["channels"][0]["score"];
    // What the simulation marked, counted in the file itself.
    let wild = DEMO.lines().filter(|line| line.ends_with(",1")).count();
    assert_eq!((&score["wild"], &score["missed"]), (&Value::from(wild), &Value::from(0)));
    assert_eq!(judged["channels"].as_array().map(Vec::len), Some(1), "one channel was asked for");
}

#[test]
fn settings_come_from_preset_and_set_in_this_order() {
    let folder = Folder::with_demo();
    let settings = |words: &str| {
        json(&folder.done(&format!("clean demo.csv --channel vx_mps --json {words}")))["channels"][0]["settings"]
            .clone()
    };
    // Section 6 of `docs/methods.md`: order 2 (paper 3), two_point off (on), max_run 10 (5), repair_rule best (matched).
    let of = |s: &Value| [&s["order"], &s["two_point"], &s["max_run"], &s["repair_rule"]].map(ToString::to_string);
    assert_eq!(of(&settings("")), ["2", "false", "10", "\"best\""]);
    assert_eq!(of(&settings("--preset paper")), ["3", "true", "5", "\"matched\""]);
    assert_eq!(of(&settings("--set order=1 --preset paper")), ["1", "true", "5", "\"matched\""]);
    assert_eq!(settings("--method hampel --set window=41 --max-gap 9")["window"], 41);
    assert_eq!(settings("--max-gap off")["max_gap"], "off");
}

#[test]
fn a_larger_multiplier_flags_less() {
    let folder = Folder::with_demo();
    let flagged = |k: &str| {
        json(&folder.done(&format!("clean demo.csv --method hampel --set k={k} --json")))["flagged"].as_u64().unwrap()
    };
    assert!(flagged("3") > flagged("30"));
}

#[test]
fn thousands_of_threads_become_a_few_a_core_and_that_is_said() {
    let folder = Folder::with_demo();
    let ran = folder.run("clean demo.csv -o clean.csv -q --threads 20000");
    let cores = std::thread::available_parallelism().unwrap().get();
    let said = format!("--threads 20000: {} are used, 4 a core", 4 * cores);
    assert!(ran.status == 0 && ran.err.contains(&said), "{}", ran.err);
}

#[test]
fn the_number_of_threads_changes_no_byte() {
    let folder = Folder::with_demo();
    let written = |n: usize| {
        let words = "clean demo.csv --json -o {}.csv --flags {}f.csv --diagnostics {}d.csv --save-session {}.toml";
        let printed = folder.done(&format!("{} --threads {n}", words.replace("{}", &format!("t{n}"))));
        ["", "f", "d"].map(|kind| folder.text(&format!("t{n}{kind}.csv"))).join("")
            + &folder.text(&format!("t{n}.toml"))
            + &printed.replace(&format!("t{n}"), "t")
    };
    assert!(written(1) == written(4));
}

#[test]
fn methods_are_listed_and_explained() {
    let folder = Folder::with(&[]);
    let listed = json(&folder.done("methods --json"));
    let ids: Vec<&str> = listed.as_array().unwrap().iter().map(|m| m["id"].as_str().unwrap()).collect();
    assert_eq!(ids, METHODS.iter().map(|m| m.about().id).collect::<Vec<_>>());
    let list = folder.done("methods");
    for id in ids.into_iter().chain(REPAIRS.iter().map(|r| r.id)) {
        assert!(list.lines().any(|line| line.trim_start().starts_with(&format!("{id} "))), "{id}");
    }
    for method in METHODS {
        let (id, page) = (method.about().id, folder.done(&format!("methods {}", method.about().id)));
        assert!(page.starts_with(&format!("{id}: ")), "{page}");
        for param in method.about().params {
            assert!(page.contains(&format!("\n  {} ", param.key)), "{id} does not explain {}", param.key);
        }
    }
    let one = json(&folder.done("methods hampel --json"));
    assert_eq!((&one["id"], &one["needs_rate"]), (&"hampel".into(), &false.into()));
}

#[test]
fn inspect_states_the_facts_of_the_record() {
    let folder = Folder::with_demo();
    let facts = json(&folder.done("inspect demo.csv --json"));
    assert_eq!((&facts["rows"], &facts["time"], &facts["duration_s"]), (&2356.into(), &"t_s".into(), &2399.0.into()));
    let kinds: Vec<&Value> = facts["columns"].as_array().unwrap().iter().map(|c| &c["kind"]).collect();
    assert_eq!(kinds, ["time", "number", "number", "truth"]);
    let vx = &facts["channels"][0];
    // 2400 seconds, of which 2356 came in; one loss of 21 s, longer than max_gap, cuts the record in two.
    assert_eq!([&vx["present"], &vx["missing"], &vx["lost"], &vx["segments"]], [2356, 0, 44, 2]);
    // The simulation adds noise of 1.08 m/s.
    let noise = vx["noise_difference"].as_f64().unwrap();
    assert!((noise - 1.08).abs() < 0.08, "{noise}");
    let page = folder.done("inspect demo.csv");
    for fact in ["rows      2356", "t_s (seconds): 0 s … 2399 s", "vx_mps            number    m/s", "bad rows  none"]
    {
        assert!(page.contains(fact), "{fact} is not in\n{page}");
    }
}

/// What `inspect` says of the noise is what a method finds: the turn is taken without its jump at north.
#[test]
fn inspect_calibrates_a_circular_channel_unwrapped() {
    let row = |i: u32| format!("{},{:.1}\n", i, (350.0 + 0.7 * f64::from(i) + f64::from(i * i % 3) / 10.0) % 360.0);
    let text = format!("t_s,azimuth_deg\n{}", (0..60).map(row).collect::<String>());
    let folder = Folder::with(&[("turn.csv", text.as_bytes())]);
    let page = folder.done("inspect turn.csv");
    let words = page.lines().find(|line| line.contains("errors up to")).unwrap_or_else(|| panic!("{page}"));
    let error = words.split("errors up to ").nth(1).and_then(|rest| rest.split(' ').next()).unwrap();
    assert!(error.parse::<f64>().unwrap() < 5.0, "{words}");
}

#[test]
fn simulate_gives_the_record_of_its_seed() {
    let folder = Folder::with(&[]);
    assert!(folder.done("simulate demo") == DEMO);
    let other = folder.done("simulate demo --seed 7");
    assert!(other == folder.done("simulate demo --seed 7") && other != DEMO);
}

#[test]
fn completions_and_manual_are_printed() {
    let folder = Folder::with(&[]);
    for shell in ["bash", "zsh", "fish"] {
        assert!(folder.done(&format!("completions {shell}")).contains("save-session"), "{shell}");
    }
    let manual = folder.done("man");
    assert!(manual.contains(".TH wildpoint 1") && manual.contains(".SH SYNOPSIS"), "{manual}");
}

#[test]
fn a_reader_that_has_seen_enough_is_no_failure() {
    let demo = concat!(env!("CARGO_MANIFEST_DIR"), "/data/demo.csv");
    // All of these print more than a pipe or a buffer of 8 KiB holds.
    for words in ["simulate demo", "methods --json", "completions bash", "completions zsh"] {
        let mut child = Command::new(env!("CARGO_BIN_EXE_wildpoint"))
            .args(words.split(' '))
            .stdout(Stdio::piped())
            .stderr(Stdio::piped())
            .spawn()
            .unwrap();
        let mut first = String::new();
        BufReader::with_capacity(16, child.stdout.take().unwrap()).read_line(&mut first).unwrap();
        let output = child.wait_with_output().unwrap();
        assert!(!first.is_empty() && output.status.success(), "{words}: {:?}", output.status);
        assert_eq!(String::from_utf8_lossy(&output.stderr), "", "{words}");
    }
    // A reader that was never there.
    for words in [format!("inspect {demo}"), format!("clean {demo}"), demo.to_owned(), "man".to_owned()] {
        let (reader, writer) = std::io::pipe().unwrap();
        drop(reader);
        let mut command = Command::new(env!("CARGO_BIN_EXE_wildpoint"));
        let output = command.args(words.split(' ')).stdout(writer).output().unwrap();
        assert!(output.status.success() && output.stderr.is_empty(), "{words}: {output:?}");
    }
}

#[test]
fn without_a_terminal_one_frame_of_the_size_and_a_summary_are_printed() {
    use unicode_width::UnicodeWidthStr;
    let folder = Folder::with_demo();
    for (size, width, height) in [("80x24", 80, 24), ("120x40", 120, 40)] {
        let printed = folder.done(&format!("demo.csv --size {size}"));
        let (frame, summary) = printed.split_once("\n\n vx").map_or_else(
            || (printed.lines().take(height).collect::<Vec<_>>(), printed.lines().skip(height).collect::<Vec<_>>()),
            |_| unreachable!("the summary starts at the margin"),
        );
        assert!(frame.iter().all(|line| line.width() <= width), "{printed}");
        assert!(frame[0].contains("demo.csv · vx_mps [m/s] (1/2)"), "{printed}");
        assert!(frame[height - 1].ends_with("q quit"), "{printed}");
        assert!(summary.iter().any(|line| line.starts_with("vx_mps: ")), "{printed}");
        assert!(!printed.contains('\u{1b}'), "a frame for a file has no escape sequences");
    }
    assert!(folder.done("--size 80x24").contains(" wildpoint:demo · vx_mps"), "the built-in record");
}

#[test]
fn a_flag_from_a_tolerance_of_nothing_has_that_for_its_reason() {
    let mut text = String::from("t,x\n");
    (0..30).for_each(|i| text += &format!("{i},{}\n", if i == 14 { 9.0 } else { 7.5 }));
    let folder = Folder::with(&[("a.csv", text.as_bytes())]);
    folder.done("clean a.csv --method wright --set floor=0 --flags f.csv --diagnostics d.csv");
    // row,time,channel,raw,verdict,kind,run_start,run_length,expected,tolerance,ratio: a ratio to 0 is none.
    assert!(folder.text("f.csv").contains("\n15,14,x,9,outlier,isolated,15,1,7.5,0,,"), "{}", folder.text("f.csv"));
    let diagnostics = folder.text("d.csv");
    assert!(diagnostics.contains("\n15,14,x,9,outlier,7.5,0,,,\n"), "{diagnostics}");
    assert!(diagnostics.contains("\n14,13,x,7.5,normal,7.5,,7.5,,\n"), "{diagnostics}");
}

#[test]
#[cfg(unix)]
fn a_limit_on_the_size_of_files_is_told_and_leaves_the_old_file() {
    let folder = Folder::with_demo();
    std::fs::write(folder.path("c.csv"), "old").unwrap();
    let mut shell = assert_cmd::Command::new("sh");
    shell.current_dir(folder.path("")).args(["-c", "ulimit -f 20; exec \"$0\" clean demo.csv -o c.csv --force"]);
    let ran = shell.arg(env!("CARGO_BIN_EXE_wildpoint")).output().unwrap();
    let err = String::from_utf8_lossy(&ran.stderr);
    assert!(ran.status.code() == Some(2) && err.contains("c.csv: cannot write") && err.contains("ulimit -f"), "{err}");
    assert_eq!(folder.names(), ["c.csv", "demo.csv"]);
    assert_eq!(folder.text("c.csv"), "old");
}

#[cfg(unix)]
#[test]
fn a_signal_in_the_middle_of_writing_leaves_no_hidden_file() {
    // What ignores a signal, as a shell does in the background, hands that on: it would not end what runs here.
    let status = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
    let ignored = status.lines().find_map(|line| u64::from_str_radix(line.strip_prefix("SigIgn:")?.trim(), 16).ok());
    let ends = |number: &i32| ignored.unwrap_or(0) >> (number - 1) & 1 == 0;
    for (name, number) in [("TERM", 15), ("INT", 2), ("HUP", 1)].into_iter().filter(|(_, number)| ends(number)) {
        // A program that was quicker than this test is given more to do.
        let (signal, names) = [1, 4, 16].iter().find_map(|more| signalled_while_writing(name, more * 400_000)).unwrap();
        assert_eq!((signal, names), (number, vec!["demo.csv".to_owned(), "long.csv".to_owned()]));
    }
}

/// The signal that ended a `clean` of this many rows which got the signal `name` as it wrote, and what it left; none
/// where it was done before that.
#[cfg(unix)]
fn signalled_while_writing(name: &str, rows: u64) -> Option<(i32, Vec<String>)> {
    use std::os::unix::process::ExitStatusExt as _;
    let folder = Folder::with_demo();
    let rows: String = (0..rows).map(|i| format!("{i}.5,{}.25\n", i * 7919 % 977)).collect();
    std::fs::write(folder.path("long.csv"), format!("t,y\n{rows}")).unwrap();
    let mut clean = Command::new(env!("CARGO_BIN_EXE_wildpoint"));
    // Packing takes long enough to be found at it.
    let clean = clean.current_dir(folder.path("")).args(["clean", "long.csv", "-o", "long.clean.csv.gz"]);
    let mut running = clean.stdout(Stdio::null()).spawn().unwrap();
    while !folder.names().iter().any(|n| n.starts_with(".wildpoint-")) {
        if running.try_wait().unwrap().is_some() {
            return None;
        }
        std::thread::yield_now();
    }
    assert!(Command::new("kill").args(["-s", name, &running.id().to_string()]).status().unwrap().success());
    running.wait().unwrap().signal().map(|signal| (signal, folder.names()))
}

#[cfg(unix)]
#[test]
fn a_signal_that_is_to_be_ignored_is_ignored() {
    let folder = Folder::with_demo();
    let mut shell = Command::new("sh");
    // As `nohup` does it, and a shell for what it runs in the background.
    shell
        .current_dir(folder.path(""))
        .args(["-c", "trap '' HUP INT; exec \"$0\" stream --method five-point --time t --interval 1 --set sigma=1"]);
    let shell = shell.arg(env!("CARGO_BIN_EXE_wildpoint")).stdin(Stdio::piped());
    let mut running = shell.stdout(Stdio::piped()).spawn().unwrap();
    let mut input = running.stdin.take().unwrap();
    let mut output = BufReader::new(running.stdout.take().unwrap());
    std::io::Write::write_all(&mut input, b"t,y\n0,1\n").unwrap();
    // Something has come back: the signals are set by now.
    output.read_line(&mut String::new()).unwrap();
    for name in ["HUP", "INT"] {
        Command::new("kill").args(["-s", name, &running.id().to_string()]).status().unwrap();
    }
    drop(input);
    std::io::copy(&mut output, &mut std::io::sink()).unwrap();
    assert!(running.wait().unwrap().success());
}
