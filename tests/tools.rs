//! `sweep`, `compare`, `stream` and sets of files, as a user runs them.

#![expect(
    clippy::expect_used,
    clippy::print_stdout,
    reason = "a test that cannot read its own data may say so by ending; what is skipped or measured is printed"
)]

use std::fmt::Write as _;
use std::io::{BufRead as _, BufReader, Write as _};
use std::path::{Path, PathBuf};
use std::process::{Command, Output, Stdio};

use assert_cmd::cargo::cargo_bin;

fn wildpoint(folder: &Path, line: &str) -> Output {
    Command::new(cargo_bin!("wildpoint")).current_dir(folder).args(line.split_whitespace()).output().expect("it runs")
}

fn text(bytes: &[u8]) -> String {
    String::from_utf8(bytes.to_vec()).expect("UTF-8")
}

fn done(folder: &Path, line: &str) -> String {
    let output = wildpoint(folder, line);
    assert_eq!(output.status.code(), Some(0), "{line}: {}", text(&output.stderr));
    text(&output.stdout)
}

fn json(folder: &Path, line: &str) -> serde_json::Value {
    serde_json::from_str(&done(folder, line)).expect("JSON")
}

fn fails(folder: &Path, line: &str, status: i32) -> String {
    let output = wildpoint(folder, line);
    assert_eq!(output.status.code(), Some(status), "{line}: {}", text(&output.stderr));
    text(&output.stderr)
}

/// Rows that are wild in [`record`].
const WILD: [usize; 7] = [40, 120, 121, 122, 200, 260, 330];

/// 400 samples at 10 Hz on a slope, with a jitter of up to 0.5 and wild points at 60 and more.
fn record(folder: &Path, name: &str) -> PathBuf {
    let mut csv = "t,x,y,truth\n".to_owned();
    for i in 0..400_usize {
        let jitter = (i * 7919 % 101) as f64 / 101.0 - 0.5;
        let wild = WILD.contains(&i);
        let x = 3.0 + 0.2 * i as f64 + jitter + if wild { 60.0 + (i % 7) as f64 } else { 0.0 };
        writeln!(csv, "{}.{},{x:.3},{jitter:.3},{}", i / 10, i % 10, u8::from(wild)).expect("it fits");
    }
    let path = folder.join(name);
    std::fs::write(&path, csv).expect("written");
    path
}

fn folder() -> tempfile::TempDir {
    tempfile::tempdir().expect("a folder")
}

#[test]
fn a_sweep_finds_the_threshold_between_noise_and_wild_points() {
    let dir = folder();
    record(dir.path(), "a.csv");
    let told = json(dir.path(), "sweep a.csv --method two-sided --json");
    assert_eq!((&told["channel"], &told["key"]), (&"x".into(), &"k".into()));
    assert_eq!(told["points"].as_array().map(Vec::len), Some(49));
    let k = told["suggestion"].as_f64().expect("a suggestion");
    let cleaned = json(dir.path(), &format!("clean a.csv --channel x --set k={k} --json"));
    assert_eq!(cleaned["flagged"], WILD.len());
    assert_eq!(cleaned["channels"][0]["score"]["missed"], 0);

    let suggested = json(dir.path(), "clean a.csv --channel x --suggest --json --save-session s.toml");
    assert_eq!(suggested["channels"][0]["settings"]["k"].as_f64(), Some(k));
    let session = std::fs::read_to_string(dir.path().join("s.toml")).expect("written");
    assert!(session.contains(&format!("\n# k = {k} was suggested: 7 flagged")), "{session}");
    assert!(done(dir.path(), "replay --check s.toml").contains("same result"), "the note does no harm");
    assert!(fails(dir.path(), "clean a.csv --suggest --set k=3", 2).contains("leave out"));

    let table = done(dir.path(), "sweep a.csv --channel x --method hampel");
    assert!(table.contains("missed") && table.contains("suggestion: --method hampel --set k="), "{table}");
    let noise = done(dir.path(), "sweep a.csv --channel y --method hampel");
    assert!(noise.contains("no suggestion"), "{noise}");
    let few = json(dir.path(), "sweep a.csv --method hampel --param window --from 3 --to 9 --steps 4 --linear --json");
    let values: Vec<f64> =
        few["points"].as_array().expect("points").iter().filter_map(|p| p["value"].as_f64()).collect();
    assert_eq!(values, [3.0, 5.0, 7.0, 9.0]);
    assert!(fails(dir.path(), "sweep a.csv --method grubbs", 2).contains("--param"));
    assert!(fails(dir.path(), "sweep a.csv --channel nothing", 2).contains("nothing"));
}

#[test]
fn real_altitudes_have_a_plateau_with_the_spikes_on_it() {
    let data = Path::new(env!("CARGO_MANIFEST_DIR")).join("../shared/data");
    let path = data.join("adsb_noisy_landing.csv");
    if !path.is_file() {
        println!("skipped: no {}", path.display());
        return;
    }
    let told = json(&data, "sweep adsb_noisy_landing.csv --channel alt_ft --json");
    let k = told["suggestion"].as_f64().expect("a suggestion");
    let dir = folder();
    let flags = dir.path().join("f.csv");
    done(&data, &format!("clean adsb_noisy_landing.csv --channel alt_ft --set k={k} --flags {}", flags.display()));
    let rows = std::fs::read_to_string(flags).expect("written");
    let raw: Vec<&str> = rows.lines().filter(|l| l.contains(",outlier,")).filter_map(|l| l.split(',').nth(3)).collect();
    assert_eq!(raw, ["30975", "28975", "28975"], "the three spikes that the data's page names, and nothing else");
}

#[test]
fn a_comparison_has_every_method_and_writes_what_they_agree_on() {
    let dir = folder();
    record(dir.path(), "a.csv");
    let told = json(dir.path(), "compare a.csv --channel x --json --set hampel.k=9 --set max_gap=off");
    let rows = told["methods"].as_array().expect("methods");
    assert_eq!(rows.len(), wildpoint::method::voting().count() - 1, "all but the one that needs a rate");
    assert_eq!(told["skipped"][0]["method"], "matched");
    let of = |id: &str| rows.iter().find(|r| r["method"] == id).expect("a row");
    let alone = json(dir.path(), "clean a.csv --channel x --method hampel --set k=9 --set max_gap=off --json");
    assert_eq!(of("hampel")["flagged"], alone["flagged"]);
    assert_eq!(of("two-sided")["score"]["missed"], 0);
    let agreement = told["agreement"].as_array().expect("counts");
    let flagged: u64 = rows.iter().filter_map(|r| r["flagged"].as_u64()).sum();
    let votes: u64 = agreement.iter().filter_map(|a| Some(a["methods"].as_u64()? * a["exactly"].as_u64()?)).sum();
    assert_eq!(votes, flagged, "every flag of every method is one vote");

    let line = "compare a.csv --channel x --votes 8 -o c.csv --flags f.csv";
    let table = done(dir.path(), line);
    assert!(table.contains("two-sided") && table.contains("consensus"), "{table}");
    let flags = std::fs::read_to_string(dir.path().join("f.csv")).expect("written");
    let rows: Vec<usize> =
        flags.lines().filter(|l| l.contains(",outlier,")).filter_map(|l| l.split(',').next()?.parse().ok()).collect();
    assert_eq!(rows, WILD.map(|i| i + 1));
    let lines = |name: &str| std::fs::read_to_string(dir.path().join(name)).expect("a file");
    let (before, after) = (lines("a.csv"), lines("c.csv"));
    let changed: Vec<usize> =
        before.lines().zip(after.lines()).enumerate().filter(|(_, (a, b))| a != b).map(|(i, _)| i).collect();
    assert_eq!(changed, WILD.map(|i| i + 1), "what is not wild is as it was");
    assert!(fails(dir.path(), line, 2).contains("--force"));
    assert!(fails(dir.path(), "compare a.csv --votes 99", 2).contains("--votes 99"));
    assert!(fails(dir.path(), "compare a.csv -o d.csv", 2).contains("--votes K"));
    assert!(fails(dir.path(), "compare a.csv --set nothing.k=3", 2).contains("nothing"));
}

#[test]
fn one_bad_file_does_not_stop_the_others() {
    let dir = folder();
    record(dir.path(), "a.csv");
    record(dir.path(), "b.csv");
    std::fs::write(dir.path().join("bad.csv"), "no numbers\nat all\n").expect("written");
    let output =
        wildpoint(dir.path(), "clean a.csv bad.csv b.csv missing.csv -o out/ --flags out/ --save-session out/");
    assert_eq!(output.status.code(), Some(2));
    let (table, errors) = (text(&output.stdout), text(&output.stderr));
    assert!(errors.contains("bad.csv") && errors.contains("missing.csv"), "{errors}");
    let order: Vec<&str> = table.lines().filter_map(|l| l.split_whitespace().next()).collect();
    assert_eq!(order, ["file", "a.csv", "bad.csv", "b.csv", "missing.csv", "all", "2"]);
    let single = folder();
    let a = dir.path().join("a.csv");
    done(single.path(), &format!("clean {} -o a.csv --flags f.csv", a.display()));
    for (many, one) in [("out/a.csv", "a.csv"), ("out/a.flags.csv", "f.csv")] {
        let read = |path: PathBuf| std::fs::read(path).expect("written");
        assert_eq!(read(dir.path().join(many)), read(single.path().join(one)), "{many}");
    }
    assert!(!dir.path().join("out/bad.csv").exists());

    let told = wildpoint(dir.path(), "clean a.csv bad.csv --json");
    let told: serde_json::Value = serde_json::from_slice(&told.stdout).expect("JSON");
    assert_eq!((&told["failed"], &told["files"][0]["rows"]), (&1.into(), &400.into()));
    assert!(told["files"][1]["error"].is_string());
    assert!(fails(dir.path(), "clean a.csv b.csv -o one.csv", 2).contains("one.csv/"));
    assert!(fails(dir.path(), "clean a.csv b.csv -o ./", 2).contains("never overwritten"));
}

#[test]
fn sessions_are_replayed_and_compared_in_sets() {
    let dir = folder();
    record(dir.path(), "a.csv");
    record(dir.path(), "b.csv");
    done(dir.path(), "clean a.csv b.csv -o out/ --save-session s/");
    assert!(done(dir.path(), "replay --check s/a.toml s/b.toml").contains("s/b.toml: same result"));
    done(dir.path(), "replay s/a.toml s/b.toml -o again/ --flags again/");
    let read = |name: &str| std::fs::read(dir.path().join(name)).expect("written");
    assert_eq!(read("out/b.csv"), read("again/b.csv"));
    assert!(dir.path().join("again/a.flags.csv").is_file());

    let changed = text(&read("b.csv")).replacen("0.0,", "0.0,1", 1);
    std::fs::write(dir.path().join("b.csv"), changed).expect("written");
    let differs = wildpoint(dir.path(), "replay --check s/a.toml s/b.toml");
    assert_eq!(differs.status.code(), Some(1), "a comparison failed");
    assert!(text(&differs.stdout).contains("s/a.toml: same result"));
    let failed = wildpoint(dir.path(), "replay --check s/nothing.toml s/b.toml s/a.toml");
    assert_eq!(failed.status.code(), Some(2), "one could not be run at all");
    assert!(text(&failed.stderr).contains("nothing.toml") && text(&failed.stdout).contains("s/a.toml: same result"));
}

/// The last word of a stream about each row: verdict, expected, tolerance.
fn last_words(out: &str) -> Vec<[String; 3]> {
    let mut words: Vec<[String; 3]> = Vec::new();
    for line in out.lines().skip(1) {
        let cells: Vec<&str> = line.split(',').collect();
        let row: usize = cells[0].parse().expect("a row");
        words.resize(words.len().max(row), [const { String::new() }; 3]);
        words[row - 1] = [3, 4, 5].map(|c| cells[c].to_owned());
    }
    words
}

#[test]
fn a_stream_ends_up_with_what_the_file_says() {
    let dir = folder();
    let path = record(dir.path(), "a.csv");
    let settings = "--set sigma=0.4 --set floor=0 --channel x --time t";
    for (method, off) in [("five-point", "--set look_back=false"), ("two-sided", "--set direction=forward")] {
        done(dir.path(), &format!("clean a.csv --method {method} {settings} {off} --diagnostics {method}.csv -q"));
        let whole = std::fs::read_to_string(dir.path().join(format!("{method}.csv"))).expect("written");
        let whole: Vec<[String; 3]> =
            whole.lines().skip(1).map(|l| [4, 5, 6].map(|c| l.split(',').nth(c).unwrap_or("").to_owned())).collect();
        let output = Command::new(cargo_bin!("wildpoint"))
            .args(["stream", "--method", method, "--interval", "0.1"])
            .args(settings.split_whitespace())
            .stdin(std::fs::File::open(&path).expect("it opens"))
            .output()
            .expect("it runs");
        assert_eq!(output.status.code(), Some(0));
        assert_eq!(last_words(&text(&output.stdout)), whole, "{method}");
    }
}

#[test]
fn a_stream_takes_its_method_from_a_session() {
    let dir = folder();
    let path = record(dir.path(), "a.csv");
    done(dir.path(), "clean a.csv --channel x --method kalman --set c=5 --save-session s.toml -q");
    let stream = |line: &str| {
        let mut command = Command::new(cargo_bin!("wildpoint"));
        command.current_dir(dir.path()).args(line.split_whitespace());
        command.stdin(std::fs::File::open(&path).expect("it opens")).output().expect("it runs")
    };
    let refused = stream("stream --session s.toml");
    assert_eq!(refused.status.code(), Some(2));
    assert!(text(&refused.stderr).contains("sigma=NUMBER"), "{}", text(&refused.stderr));
    let output = stream("stream --session s.toml --set sigma=0.4");
    let errors = text(&output.stderr);
    assert!(errors.contains("look_back = true of the session is false"), "{errors}");
    let outliers = last_words(&text(&output.stdout)).iter().filter(|w| w[0] == "outlier").count();
    assert_eq!(outliers, WILD.len());
}

#[test]
fn a_stream_answers_while_the_sender_waits_and_outlives_a_reader() {
    let mut child = Command::new(cargo_bin!("wildpoint"))
        .args(["stream", "--method", "template", "--time", "t", "--interval", "1", "-q"])
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .expect("it runs");
    let mut send = child.stdin.take().expect("its input");
    let mut hear = BufReader::new(child.stdout.take().expect("its output"));
    send.write_all(b"t,x\n").expect("sent");
    let mut line = String::new();
    for i in 0..20 {
        writeln!(send, "{i},{}", i % 3).expect("sent");
        line.clear();
        if i == 0 {
            hear.read_line(&mut line).expect("the header");
        }
        line.clear();
        hear.read_line(&mut line).expect("an answer before the next line is sent");
        assert!(line.starts_with(&format!("{},{i},", i + 1)), "{line}");
    }
    drop(hear);
    // The reader is gone. Either write may be the one that learns of it.
    let _ = writeln!(send, "20,1").and_then(|()| writeln!(send, "21,1"));
    drop(send);
    let output = child.wait_with_output().expect("it ends");
    assert_eq!((output.status.code(), text(&output.stderr).as_str()), (Some(0), ""));
}

#[test]
fn advice_is_measured_on_the_record_and_can_be_taken() {
    let folder = folder();
    let file = record(folder.path(), "a.csv");
    let before = std::fs::read(&file).expect("read");
    let methods = "--method two-sided --method hampel --method wright";
    let line = format!("advise a.csv --channel x {methods} --json");
    let advice = json(folder.path(), &line);
    assert_eq!((advice["samples"].as_u64(), advice["methods"].as_array().map(Vec::len)), (Some(400), Some(3)));
    let row = |index: usize| &advice["methods"][index];
    // On a slope of 80 the mean of all samples finds nothing that two neighbours would.
    assert!(row(0)["recall"].as_f64() > row(2)["recall"].as_f64());
    let smallest = row(0)["kinds"][0]["smallest"].as_f64().expect("single points are found");
    // The jitter is half a unit to either side; a wild point of 60 is found for certain.
    assert!((0.5..30.0).contains(&smallest), "{smallest}");
    assert_eq!(row(0)["untouched"]["flagged"].as_u64(), Some(WILD.len() as u64));
    // The clock aside, the same again; another seed puts the wild points elsewhere.
    let kinds = |advice: &serde_json::Value| advice["methods"][1]["kinds"].to_string();
    assert_eq!(kinds(&json(folder.path(), &line)), kinds(&advice));
    assert_ne!(kinds(&json(folder.path(), &format!("{line} --seed 2"))), kinds(&advice));
    let told = done(folder.path(), &format!("advise a.csv --channel x {methods}"));
    let best =
        row(usize::try_from(advice["recommended"].as_u64().expect("one")).expect("small"))["setup"]["method"].clone();
    let best = best.as_str().expect("a name");
    assert!(told.contains(&format!("recommended: {best}; finds 95 % of single points from")), "{told}");
    assert!(told.contains(&format!("to take it: --method {best}")), "{told}");
    assert_eq!(std::fs::read(&file).expect("read"), before, "the record is as it was");
}

/// An advice without its last column, the times.
fn without_times(text: &str) -> String {
    let is_row = |line: &str| line.starts_with("95 %") || line.ends_with(|c: char| c.is_ascii_digit());
    let cut = |line: &str| {
        if is_row(line) { line.rsplit_once(' ').map_or("", |cut| cut.0.trim_end()).to_owned() } else { line.to_owned() }
    };
    text.lines().map(|line| cut(line) + "\n").collect()
}

/// `WILDPOINT_UPDATE=1 cargo test --test tools readme` writes the advice of the README again.
#[test]
fn the_readme_shows_a_real_advice() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let page = root.join("README.md");
    let text = std::fs::read_to_string(&page).expect("the README");
    let open = "$ wildpoint ";
    let from = text.find("$ wildpoint advise").expect("an advice");
    let (line, shown) = text[from + open.len()..].split_once('\n').expect("its output");
    let shown = &shown[..shown.find("```").expect("its end")];
    let real = done(root, line);
    if std::env::var_os("WILDPOINT_UPDATE").is_some() {
        std::fs::write(&page, text.replacen(shown, &real, 1)).expect("the README can be written");
    } else {
        assert_eq!(without_times(shown), without_times(&real), "WILDPOINT_UPDATE=1 cargo test --test tools readme");
    }
}

#[test]
fn a_record_that_cannot_be_asked_is_refused_with_the_reason() {
    let folder = folder();
    std::fs::write(folder.path().join("short.csv"), "t,x\n0,1\n1,2\n2,1\n3,2\n4,1\n5,2\n").expect("written");
    let error = fails(folder.path(), "advise short.csv", 2);
    assert!(error.contains("x: the record is too short: 6 samples") && error.contains("wildpoint methods"), "{error}");
    let error = fails(folder.path(), "sweep short.csv --method auto", 2);
    assert!(error.contains("--method auto") && error.contains("wildpoint advise"), "{error}");
}

#[test]
fn the_recommended_method_is_cleaned_with_and_recorded_with_its_reasons() {
    let folder = folder();
    record(folder.path(), "a.csv");
    let told =
        done(folder.path(), "clean a.csv --channel x --method auto --repair linear -o b.csv --save-session s.toml");
    assert!(told.contains("method auto: recommended: "), "{told}");
    let session = std::fs::read_to_string(folder.path().join("s.toml")).expect("saved");
    let method = session.lines().find_map(|l| l.strip_prefix("method = ")).expect("a method").trim_matches('"');
    assert!(session.contains(&format!("\nrecommended = \"{method}\"\n")), "{session}");
    assert!(session.contains(&format!("  \"recommended: {method}; finds 95 %")), "{session}");
    assert!(session.contains("[channel.detectability]"), "{session}");
    assert!(session.contains("linear"), "the repair stays: {session}");
    done(folder.path(), "replay s.toml --check");
    // A report has the same whether it is made with the session or from it.
    done(folder.path(), "clean a.csv --channel x --method auto --repair linear --report clean.md");
    done(folder.path(), "replay s.toml --report replay.md");
    for name in ["clean.md", "replay.md"] {
        let report = std::fs::read_to_string(folder.path().join(name)).expect("written");
        let (_, section) = report.split_once("### Methods compared on this record").expect(name);
        assert!(
            section.contains(&format!("recommended: {method}; finds")) && section.contains("| wright |"),
            "{section}"
        );
        assert!(report.contains("- detectability: finds 95 % of single points from"), "{report}");
    }
    let error = fails(folder.path(), "clean a.csv --method auto --suggest", 2);
    assert!(error.contains("both choose"), "{error}");
    let error = fails(folder.path(), "clean a.csv --method auto --set nonsense=1", 2);
    assert!(error.contains("nonsense"), "{error}");
}

#[test]
fn the_consensus_is_cleaned_with_like_any_method() {
    let folder = folder();
    record(folder.path(), "a.csv");
    let clean = "clean a.csv --channel x --method consensus --set votes=2 --set methods=hampel,two-sided,wright";
    let told =
        json(folder.path(), &format!("{clean} --repair linear -o b.csv --flags b.flags --save-session s.toml --json"));
    assert_eq!(told["channels"][0]["counts"]["flagged"].as_u64(), Some(WILD.len() as u64), "{told}");
    let session = std::fs::read_to_string(folder.path().join("s.toml")).expect("saved");
    assert!(session.contains("votes = 2, methods = [\"wright\", \"hampel\", \"two-sided\"]"), "{session}");
    done(folder.path(), "replay s.toml --check");
    // The same as the votes of the same methods, counted.
    let methods = "--method hampel --method two-sided --method wright";
    let votes = format!("compare a.csv --channel x {methods} --votes 2 --repair linear -o c.csv --json");
    let told = json(folder.path(), &votes);
    assert_eq!(told["consensus"]["flagged"].as_u64(), Some(WILD.len() as u64), "{told}");
    let read = |name: &str| std::fs::read(folder.path().join(name)).expect("written");
    assert!(read("b.csv") == read("c.csv"), "cleaned alike");
    // More votes than methods are said to flag nothing.
    let told =
        done(folder.path(), "clean a.csv --channel x --method consensus --set votes=3 --set methods=hampel,wright");
    assert!(told.contains("votes = 3, but 2 methods vote"), "{told}");
    let error = fails(folder.path(), "clean a.csv --method consensus --set methods=hampel,matched", 2);
    assert!(error.contains("methods = hampel,matched") && error.contains("two-sided"), "{error}");
}

#[test]
fn tuning_never_finds_less_and_keeps_to_the_flags() {
    let folder = folder();
    record(folder.path(), "a.csv");
    let tuned = json(folder.path(), "advise a.csv --channel x --tune hampel --json");
    let of = |which: &str, key: &str| tuned[which][key].as_f64().expect("a number");
    assert!(of("after", "recall") >= of("before", "recall"), "{tuned}");
    let flags = |which: &str| tuned[which]["untouched"]["flagged"].as_u64();
    assert!(flags("after") <= flags("before") && tuned["tried"].as_u64() > Some(5), "{tuned}");
}
