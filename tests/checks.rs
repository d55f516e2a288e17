//! What is done with a channel before its method sees it: checks, periods, positions, and decisions that teach.

#![expect(clippy::unwrap_used, reason = "a failed expectation is a failed test")]

#[expect(dead_code, reason = "other tests use all of it")]
mod program;

use std::fmt::Write as _;

use program::Folder;
use serde_json::Value;

/// Noise between -1 and 1, the same in every run.
fn noise(i: usize) -> f64 {
    let x = (i as u64 + 1).wrapping_mul(0x9E37_79B9_7F4A_7C15);
    let x = (x ^ (x >> 29)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
    ((x >> 40) as f64) / f64::from(1 << 23) - 1.0
}

/// A record of one channel, a value a second, in this many decimals.
fn record(name: &str, decimals: usize, values: impl IntoIterator<Item = f64>) -> String {
    let mut text = format!("time_s,{name}\n");
    for (i, value) in values.into_iter().enumerate() {
        let _ = writeln!(text, "{i},{value:.decimals$}");
    }
    text
}

/// The cells of a table.
fn rows(text: &str) -> Vec<Vec<String>> {
    text.lines().skip(1).map(|line| line.split(',').map(str::to_owned).collect()).collect()
}

fn json(text: &str) -> Value {
    serde_json::from_str(text).unwrap()
}

fn level(i: usize) -> f64 {
    40.0 + 8.0 * (i as f64 * 0.03).sin() + 0.3 * noise(i)
}

#[test]
fn a_third_of_fill_values_is_taken_out_and_no_good_sample_is_touched() {
    let is_fill = |i: usize| (140..250).contains(&i);
    let text = record("level_m", 2, (0..330).map(|i| if is_fill(i) { -9999.0 } else { level(i) }));
    let folder = Folder::with(&[("a.csv", text.as_bytes())]);
    let said = folder.done("clean a.csv -o clean.csv --flags flags.csv --save-session a.toml");
    assert!(said.contains("checked first: missing-values:values=-9999.0: 110 outliers"), "{said}");
    let clean = folder.text("clean.csv");
    for (i, (before, after)) in text.lines().skip(1).zip(clean.lines().skip(1)).enumerate() {
        if is_fill(i) {
            assert_eq!(after, format!("{i},"), "nothing was measured");
        } else {
            assert_eq!(after, before, "row {}", i + 1);
        }
    }
    let flags = folder.text("flags.csv");
    assert!(flags.lines().next().unwrap().ends_with(",decided_by,note,by,evidence"));
    let by_check = |r: &Vec<String>| r[15] == "check" && r[17] == "missing-values" && r[18] == "stands for no value";
    assert_eq!(rows(&flags).iter().filter(|r| r[4] == "outlier" && by_check(r)).count(), 110);
    assert!(folder.text("a.toml").contains("{ check = \"missing-values\", values = [-9999.0] }"));
    // What the session says gives the same bytes, and `none` is none.
    folder.done("replay a.toml -o again.csv --flags again_flags.csv");
    assert_eq!((folder.text("again.csv"), folder.text("again_flags.csv")), (clean, flags));
    assert!(folder.done("replay --check a.toml").contains("same result"));
    assert!(!folder.done("clean a.csv --check none").contains("checked first"));
    assert!(folder.done("inspect a.csv").contains("-9999.0 110 times (33.33 %) is a fill value"));
}

#[test]
fn one_absurd_value_is_a_fill_value_and_hides_no_wild_point() {
    let text = record(
        "v",
        2,
        (0..200).map(|i| match i {
            60 => 1e20,
            120 => 90.0,
            _ => level(i),
        }),
    );
    let folder = Folder::with(&[("a.csv", text.as_bytes())]);
    folder.done("clean a.csv --flags flags.csv -q");
    let flags = rows(&folder.text("flags.csv"));
    let outlier = |row: &str, by: &str| flags.iter().any(|r| r[0] == row && r[4] == "outlier" && r[17] == by);
    assert!(outlier("61", "missing-values"), "{flags:?}");
    assert!(flags.iter().any(|r| r[0] == "121" && r[4] == "outlier" && r[17] != "missing-values"), "{flags:?}");
}

#[test]
fn a_frozen_stretch_is_told_and_kept_and_the_rest_is_judged_by_its_own_noise() {
    let frozen = 150..240;
    let text = record("v", 2, (0..360).map(|i| level(if frozen.contains(&i) { 150 } else { i })));
    let folder = Folder::with(&[("a.csv", text.as_bytes())]);
    folder.done("clean a.csv -o clean.csv --flags flags.csv -q");
    assert_eq!(folder.text("clean.csv"), text, "doubtful samples are kept");
    let flags = rows(&folder.text("flags.csv"));
    let stuck: Vec<usize> =
        flags.iter().filter(|r| r[4] == "suspect" && r[17] == "stuck").map(|r| r[0].parse().unwrap()).collect();
    assert_eq!(stuck, (152..=240).collect::<Vec<_>>(), "all but the first sample");
    assert!(folder.done("inspect a.csv").contains("was stuck: one stretch of 90 equal values"));
}

/// A heading that turns through north again and again, with wild points at `spikes`.
fn heading(n: usize, low: f64, spikes: &[usize]) -> Vec<f64> {
    let turn = |i: usize| 300.0 + 40.0 * (i as f64 * 0.02).sin() + 1.1 * i as f64 + 0.4 * noise(i);
    let wild = |i: usize| if spikes.contains(&i) { 75.0 } else { 0.0 };
    (0..n).map(|i| (turn(i) + wild(i) - low).rem_euclid(360.0) + low).collect()
}

#[test]
fn a_heading_across_north_is_judged_unwrapped_and_repaired_the_short_way() {
    for low in [0.0, -180.0] {
        let clean = heading(900, low, &[]);
        let crossing = (1..900).find(|&i| (clean[i] - clean[i - 1]).abs() > 300.0).unwrap();
        let spikes = [crossing, 400, 700];
        let text = record("heading_deg", 2, heading(900, low, &spikes));
        let folder = Folder::with(&[("a.csv", text.as_bytes())]);
        let said = folder.done("clean a.csv -o clean.csv --flags flags.csv --save-session a.toml");
        assert!(said.contains("circular: judged unwrapped, period 360"), "{said}");
        let flags = rows(&folder.text("flags.csv"));
        let outliers: Vec<usize> = flags.iter().filter(|r| r[4] == "outlier").map(|r| r[0].parse().unwrap()).collect();
        for spike in spikes {
            assert!(outliers.contains(&(spike + 1)), "row {} from {low}", spike + 1);
        }
        assert!(outliers.len() <= spikes.len() + 2, "{outliers:?}");
        for row in rows(&folder.text("clean.csv")) {
            let (i, value): (usize, f64) = (row[0].parse().unwrap(), row[1].parse().unwrap());
            let off = (value - clean[i] + 180.0).rem_euclid(360.0) - 180.0;
            assert!(off.abs() < 5.0, "row {}: {value} for {}", i + 1, clean[i]);
            assert!((low..low + 360.0).contains(&value), "row {}: {value}", i + 1);
        }
        assert!(folder.text("a.toml").contains("period = 360.0"));
        assert!(folder.done("replay --check a.toml").contains("same result"));
    }
}

#[test]
fn a_period_is_told_for_a_channel_or_refused() {
    let text = record("ch7", 2, heading(400, 0.0, &[]));
    let folder = Folder::with(&[("a.csv", text.as_bytes())]);
    assert!(!folder.done("clean a.csv").contains("circular"), "two crossings of a column without a name are no proof");
    assert!(folder.done("clean a.csv --period 360").contains("circular"));
    assert!(folder.done("clean a.csv --period ch7=360").contains("circular"));
    for wrong in ["--period north", "--period ch9=360", "--period -5"] {
        let ran = folder.run(&format!("clean a.csv {wrong}"));
        assert_eq!(ran.status, 2, "{wrong}: {}", ran.err);
    }
}

/// A walk in latitude and longitude with a fix that is off in the longitude alone.
fn walk(wild: &[usize]) -> String {
    let mut text = String::from("time_s,lat,lon\n");
    for i in 0..500 {
        let (lat, lon) = (48.0 + 3e-5 * i as f64 + 2e-6 * noise(i), 11.0 + 2e-5 * i as f64 + 2e-6 * noise(i + 7000));
        let lon = if wild.contains(&i) { lon + 0.01 } else { lon };
        let (lat, lon) = if i == 450 { (0.0, 0.0) } else { (lat, lon) };
        let _ = writeln!(text, "{i},{lat:.7},{lon:.7}");
    }
    text
}

#[test]
fn a_position_is_decided_for_the_epoch() {
    let folder = Folder::with(&[("a.csv", walk(&[100, 300, 301]).as_bytes())]);
    folder.done("clean a.csv --check null-island:channels=lat,lon --position lat,lon --flags flags.csv -o c.csv -q");
    let flags = rows(&folder.text("flags.csv"));
    let by = |id: &str, channel: &str| -> Vec<String> {
        flags.iter().filter(|r| r[17] == id && r[2] == channel && r[4] == "outlier").map(|r| r[0].clone()).collect()
    };
    assert_eq!(by("position", "lon"), ["101", "301", "302"]);
    assert_eq!(by("position", "lat"), by("position", "lon"));
    assert_eq!((by("null-island", "lat"), by("null-island", "lon")), (vec!["451".to_owned()], vec!["451".to_owned()]));
    // The walk goes on through the repaired fixes; nothing stands for the fix that was none.
    let clean = rows(&folder.text("c.csv"));
    let lon: f64 = clean[100][2].parse().unwrap();
    assert!((lon - 11.002).abs() < 1e-4, "{lon}");
    assert_eq!((clean[450][1].as_str(), clean[450][2].as_str()), ("", ""));
    let ran = folder.run("clean a.csv --position lat,lot");
    assert_eq!(ran.status, 2);
    assert!(ran.err.contains("no such channel: lot"), "{}", ran.err);
}

#[test]
fn checks_are_made_for_every_method_and_refused_where_they_make_no_sense() {
    let text = record("v", 2, (0..300).map(|i| if i == 150 { 500.0 } else { level(i) }));
    let folder = Folder::with(&[("a.csv", text.as_bytes())]);
    let told = json(&folder.done("compare a.csv --check valid-range:low=0,high=100 --json"));
    for row in told["methods"].as_array().unwrap() {
        assert!(row["flagged"].as_u64().unwrap() >= 1, "{row}");
    }
    let told = json(&folder.done("clean a.csv --check rate:fail=100,suspect=50 --json"));
    assert_eq!(told["channels"][0]["checks"][0]["outliers"], 1);
    assert_eq!(told["channels"][0]["counts"]["by_checks"], 1);
    for (wrong, words) in [
        ("--check valid-rang:low=0", "did you mean valid-range?"),
        ("--check valid-range", "low"),
        ("--check null-island:channels=v,w", "no such channel"),
        ("--check none --check stuck:fail=9", "none"),
    ] {
        let ran = folder.run(&format!("clean a.csv -o out.csv {wrong}"));
        assert_eq!(ran.status, 2, "{wrong}");
        assert!(ran.err.contains(words), "{wrong}: {}", ran.err);
    }
    assert_eq!(folder.names(), ["a.csv"]);
}

#[test]
fn decisions_teach_where_the_session_says_so() {
    // A long patch widens every scale about it, and a wild point beside it passes; decided to be wild, the patch is
    // kept from the method, which then sees the point.
    let wild = |i: usize| {
        if (200..215).contains(&i) {
            60.0
        } else if i == 225 {
            9.0
        } else {
            0.0
        }
    };
    let text = record("v", 2, (0..400).map(|i| 20.0 + noise(i) + wild(i)));
    let folder = Folder::with(&[("a.csv", text.as_bytes())]);
    folder.done("clean a.csv --method mean-window --set scale=rms --set window=61 --set feedback=false --save-session a.toml -q");
    let flagged = |name: &str| {
        folder.done(&format!("replay {name} --flags flags.csv --force -q"));
        let flags = rows(&folder.text("flags.csv"));
        flags.iter().any(|r| r[0] == "226" && r[4] == "outlier")
    };
    let saved = folder.text("a.toml");
    let decisions: String = (200..215).fold(String::new(), |mut all, i| {
        let value = text.lines().nth(i + 1).unwrap().split(',').nth(1).unwrap();
        let _ = writeln!(all, "  {{ row = {}, time = \"{i}\", value = \"{value}\", verdict = \"outlier\" }},", i + 1);
        all
    });
    let decided = saved.replace("\n[result]", &format!("decisions = [\n{decisions}]\n\n[result]"));
    let taught = decided.replace("decisions = [", "exclude_decided = true\ndecisions = [");
    std::fs::write(folder.path("decided.toml"), &decided).unwrap();
    std::fs::write(folder.path("taught.toml"), &taught).unwrap();
    assert!(!flagged("decided.toml"));
    assert!(flagged("taught.toml"));
}

#[test]
fn channels_that_are_judged_together_each_have_their_checks() {
    let fill = |i: usize| (100..104).contains(&i) || (200..204).contains(&i);
    let mut text = String::from("time_s,x_m,y_m\n");
    for i in 0..400 {
        let (x, y) = (level(i), 90.0 - 0.1 * i as f64 + 0.3 * noise(i + 9000));
        let x = if fill(i) { -9999.0 } else { x };
        let y = if i == 300 { 500.0 } else { y };
        let _ = writeln!(text, "{i},{x:.2},{y:.2}");
    }
    let folder = Folder::with(&[("a.csv", text.as_bytes())]);
    folder.done("clean a.csv --method kalman --set test=joint --flags flags.csv --save-session a.toml -q");
    let flags = rows(&folder.text("flags.csv"));
    let outlier = |row: usize, channel: &str, by: &str| {
        let row = row.to_string();
        flags.iter().any(|r| r[0] == row && r[2] == channel && r[4] == "outlier" && r[17] == by)
    };
    for i in (0..400).filter(|i| fill(*i)) {
        assert!(outlier(i + 1, "x_m", "missing-values"), "row {}", i + 1);
        assert!(!outlier(i + 1, "y_m", "kalman"), "row {}: the other channel is not drawn in", i + 1);
    }
    assert!(outlier(301, "y_m", "kalman") && outlier(301, "x_m", "kalman"), "one verdict for both");
    assert!(folder.done("replay --check a.toml").contains("same result"));
}

#[test]
fn a_method_follows_another_and_a_turned_multiplier_is_a_fresh_judgement() {
    let text = record("v", 2, (0..500).map(|i| level(i) + if i % 60 == 30 { 30.0 } else { 0.0 }));
    let folder = Folder::with(&[("a.csv", text.as_bytes())]);
    folder.done("clean a.csv --check hampel:k=6 --method grubbs --flags flags.csv -q");
    let flags = rows(&folder.text("flags.csv"));
    assert_eq!(flags.iter().filter(|r| r[17] == "hampel" && r[4] == "outlier").count(), 8, "{flags:?}");
    // A sweep turns the multiplier on the scores that it has: the counts are those of single runs.
    let args = "--method hampel --check valid-range:high=60";
    let swept = json(&folder.done(&format!("sweep a.csv {args} --from 2 --to 8 --steps 3 --json")));
    for point in swept["points"].as_array().unwrap() {
        let k = point["value"].as_f64().unwrap();
        let one = json(&folder.done(&format!("clean a.csv {args} --set k={k} --json")));
        let counts = &one["channels"][0]["counts"];
        let by_method = counts["flagged"].as_u64().unwrap() - counts["by_checks"].as_u64().unwrap();
        assert_eq!(point["flagged"].as_u64().unwrap(), by_method, "k = {k}");
    }
}

#[test]
fn a_session_says_what_is_wrong_with_a_check_and_where() {
    let text = record("v", 2, (0..50).map(level));
    let folder = Folder::with(&[("a.csv", text.as_bytes())]);
    folder.done("clean a.csv --check stuck:fail=30 --period 500 --save-session a.toml -q");
    let saved = folder.text("a.toml");
    for (from, to, words) in [
        ("check = \"stuck\"", "check = \"stack\"", "did you mean stuck?"),
        ("fail = 30", "fail = 0", "fail = 0"),
        ("fail = 30", "fale = 30", "fale"),
        ("fail = 30", "fail = \"off\"", "needs a limit"),
        ("period = 500.0", "period = -1.0", "period = -1"),
    ] {
        assert!(saved.contains(from), "{saved}");
        std::fs::write(folder.path("b.toml"), saved.replace(from, to)).unwrap();
        let ran = folder.run("replay b.toml -q");
        assert_eq!(ran.status, 2, "{to}");
        assert!(ran.err.contains(words) && ran.err.contains("b.toml"), "{to}: {}", ran.err);
    }
}

#[test]
fn the_report_and_the_list_of_methods_tell_of_checks() {
    let text = record("v", 2, (0..300).map(|i| if i == 150 { 500.0 } else { level(i) }));
    let folder = Folder::with(&[("a.csv", text.as_bytes())]);
    folder.done("clean a.csv --check valid-range:low=0,high=100 --report r.md -q");
    let report = folder.text("r.md");
    assert!(report.contains("valid-range: above 100") && report.contains("check before the method"), "{report}");
    assert!(report.contains("--check valid-range:low=0.0,high=100.0"), "the command says the same: {report}");
    assert!(folder.done("methods").contains("null-island"));
    assert!(folder.done("methods stuck").contains("--check stuck:KEY=VALUE"));
}

#[test]
fn a_record_without_faults_has_no_checks_and_the_columns_it_had() {
    let text = record("v", 2, (0..300).map(level));
    let folder = Folder::with(&[("a.csv", text.as_bytes())]);
    let said = folder.done("clean a.csv --flags flags.csv --save-session a.toml");
    assert!(
        !said.contains("checked") && folder.text("flags.csv").lines().next().unwrap().ends_with(",decided_by,note")
    );
    let saved = folder.text("a.toml");
    assert!(!saved.contains("checks =") && !saved.contains("period") && !saved.contains("exclude"), "{saved}");
}
