//! Several tracks in one table: each is judged as if it stood alone, and all are cleaned in one file.

#![expect(clippy::unwrap_used, clippy::print_stderr, reason = "a failed expectation is a failed test")]

#[expect(dead_code, reason = "other tests use all of it")]
mod program;

use std::collections::BTreeMap;
use std::path::Path;

use program::Folder;
use wildpoint::experiment::Random;
use wildpoint::track::{LoadOptions, Source, Track, load};

const IDS: [&str; 3] = ["G05", "G13", "R,7"];

/// Rows of three satellites in turn, each with a time that starts again at its own zero, with wild points and a gap.
/// Given: the rows by id.
fn rows() -> Vec<(usize, String)> {
    let mut random = Random::new(5);
    let mut rows = Vec::new();
    let mut counts = [0_u32; 3];
    for i in 0..900 {
        // Not quite in turn.
        let id = if i % 7 == 0 { 0 } else { i % 3 };
        let n = counts[id];
        counts[id] += 1;
        let time = f64::from(n + if n > 150 { 40 } else { 0 }) * [1.0, 0.5, 2.0][id];
        let wild = if n % 37 == 20 { 400.0 * (1.0 + id as f64) } else { 0.0 };
        let range = 1e4 * (1.0 + id as f64) + 12.0 * time + random.normal() + wild;
        rows.push((id, format!("{time:.1},{range:.3},{:.3}", 12.0 + 0.1 * random.normal())));
    }
    rows
}

fn table(rows: &[(usize, String)]) -> String {
    let mut text = String::from("sat,time_s,range_m,rate_mps\n");
    rows.iter().for_each(|(id, row)| text.push_str(&format!("\"{}\",{row}\n", IDS[*id])));
    text
}

fn folder() -> Folder {
    let rows = rows();
    let folder = Folder::with(&[("all.csv", table(&rows).as_bytes())]);
    for (id, name) in IDS.iter().enumerate() {
        let own: Vec<_> = rows.iter().filter(|r| r.0 == id).cloned().collect();
        std::fs::write(folder.path(&format!("{}.csv", name.replace(',', "_"))), table(&own)).unwrap();
    }
    folder
}

/// The lines of a table by what stands in its first cell.
fn by_id(text: &str) -> BTreeMap<String, Vec<String>> {
    let mut lines: BTreeMap<String, Vec<String>> = BTreeMap::new();
    for line in text.lines().skip(1) {
        let id = line.split('"').nth(1).unwrap();
        lines.entry(id.into()).or_default().push(line.into());
    }
    lines
}

#[test]
fn every_track_is_cleaned_as_if_it_stood_alone() {
    let folder = folder();
    for method in ["two-sided", "hampel", "kalman", "diff-median", "matched --rate rate_mps"] {
        for fill in ["off", "cells", "rows --max-gap off"] {
            let how = format!("--time time_s --method {method} --fill-gaps {fill} --force");
            folder.done(&format!("clean all.csv --track sat -o all_clean.csv {how}"));
            let together = by_id(&folder.text("all_clean.csv"));
            for id in IDS {
                let name = id.replace(',', "_");
                folder.done(&format!("clean {name}.csv -o alone.csv {how}"));
                let alone = folder.text("alone.csv");
                let alone: Vec<&str> = alone.lines().skip(1).collect();
                // A new row has the id of its track in one, and nothing where no id was asked for in the other.
                let with_id = |line: &&str| {
                    if line.starts_with("\"\"") {
                        line.replacen("\"\"", &format!("\"{id}\""), 1)
                    } else {
                        (*line).into()
                    }
                };
                let alone: Vec<String> = alone.iter().map(with_id).collect();
                assert_eq!(together[id], alone, "{method} {fill} {id}");
            }
        }
    }
    assert!(folder.text("all_clean.csv").lines().count() > 901 + 3 * 39, "with rows, the gaps of 40 are filled");
}

#[test]
fn the_summary_counts_each_track_and_a_session_replays_it() {
    let folder = folder();
    let json = folder.done("clean all.csv --track sat -o c.csv --flags f.csv --save-session s.toml --json");
    let summary: serde_json::Value = serde_json::from_str(&json).unwrap();
    let channels = summary["channels"].as_array().unwrap();
    let names: Vec<&str> = channels.iter().map(|c| c["channel"].as_str().unwrap()).collect();
    let expected = ["range_m@G05", "rate_mps@G05", "range_m@G13", "rate_mps@G13", "range_m@R,7", "rate_mps@R,7"];
    assert_eq!(names, expected);
    // Wild points stand at every 37th sample from the 20th on, of as many samples as each id has rows.
    for (id, of_id) in IDS.iter().zip([0, 2, 4]) {
        let count = rows().iter().filter(|r| IDS[r.0] == *id).count();
        let wild = (0..count).filter(|n| n % 37 == 20).count();
        assert_eq!(channels[of_id]["counts"]["rows"].as_u64(), Some(count as u64), "{id}");
        assert_eq!(channels[of_id]["counts"]["flagged"].as_u64(), Some(wild as u64), "{id}");
    }
    let session = folder.text("s.toml");
    assert!(session.contains("track = \"sat\"") && session.contains("name = \"range_m@R,7\""), "{session}");
    folder.done("replay s.toml --check");
    // Rows are those of the file, and the channel names the track.
    let flags = folder.text("f.csv");
    let all = rows();
    for flag in flags.lines().skip(1).filter(|l| l.contains("range_m@G13") && l.contains(",outlier,")) {
        let row: usize = flag.split(',').next().unwrap().parse().unwrap();
        let n = all[..row].iter().filter(|r| r.0 == 1).count() - 1;
        assert_eq!((all[row - 1].0, n % 37), (1, 20), "{flag}");
    }
}

#[test]
fn one_track_can_be_named_and_mistakes_are_told() {
    let folder = folder();
    let json = folder.done("clean all.csv --track sat --channel range_m@G13 -o c.csv --json");
    let summary: serde_json::Value = serde_json::from_str(&json).unwrap();
    assert_eq!(summary["channels"].as_array().unwrap().len(), 1);
    let lines = |name: &str| by_id(&folder.text(name));
    assert_eq!(lines("c.csv")["G05"], lines("all.csv")["G05"], "other tracks stay as they are");
    assert_ne!(lines("c.csv")["G13"], lines("all.csv")["G13"]);
    let json = folder.done("clean all.csv --track #1 --channel range_m -o d.csv --json");
    let summary: serde_json::Value = serde_json::from_str(&json).unwrap();
    assert_eq!(summary["channels"].as_array().unwrap().len(), 3);
    for (words, complaint) in [
        ("--track sat --channel range_m@G31", "there is no track `G31`"),
        ("--track satt", "satt"),
        ("--track sat --channel sat", "`sat` is what tells tracks apart"),
        ("--track time_s --time time_s", "`time_s` is the time"),
    ] {
        let ran = folder.run(&format!("clean all.csv {words} -o e.csv"));
        assert!(ran.status == 2 && ran.err.contains(complaint), "{words}: {}", ran.err);
    }
    let inspected = folder.done("inspect all.csv --track sat");
    assert!(inspected.contains("track ") && inspected.contains("range_m@R,7"), "{inspected}");
    assert!(!inspected.contains("time goes back"), "{inspected}");
    // By itself, the column is detected.
    let recognised = folder.done("inspect all.csv");
    assert!(recognised.contains("`sat` tells 3 tracks apart"), "{recognised}");
}

#[test]
fn rows_without_an_id_are_left_alone_and_counted() {
    let text = "id,time,x\na,0,1\n,0,9\nb,0,5\na,1,2\nNA,1,9\nb,1,6\na,1,3\na,2,4\n";
    let source = Source::BuiltIn { name: "ids", bytes: text.as_bytes().into() };
    let options = LoadOptions { track: Some("id".into()), ..LoadOptions::default() };
    let track = load(&source, &options).unwrap();
    let values: Vec<(&str, &[f64])> = track.channels.iter().map(|c| (c.name.as_str(), &c.values[..])).collect();
    assert_eq!(values, [("x@a", &[1.0, 2.0, 3.0, 4.0][..]), ("x@b", &[5.0, 6.0])]);
    let seconds = format!("{:?}", track.time.seconds);
    assert_eq!(seconds, "[0.0, NaN, 0.0, 1.0, NaN, 1.0, NaN, 2.0]");
    assert_eq!((track.faults.repeated_times.count, track.faults.repeated_times.first[0].0), (1, 8));
    assert_eq!(track.notes, ["2 of 8 rows have no `id`: they are left as they are"]);
    assert_eq!((track.channels[1].value(5), track.channels[1].value(0).is_nan()), (6.0, true));
    let by_sample = LoadOptions { time: Some("sample".into()), ..options };
    let track = load(&source, &by_sample).unwrap();
    assert_eq!(format!("{:?}", track.time.seconds), "[0.0, NaN, 0.0, 1.0, NaN, 1.0, 2.0, 3.0]");
    assert!(track.channels.iter().all(|c| c.name.starts_with("x@") || c.name.starts_with("time@")));
}

#[test]
fn a_long_table_is_divided_piece_by_piece_as_it_is_whole() {
    // More than a megabyte, which is never in memory as a whole.
    let mut text = String::from("time,id,x,remark\n");
    (0..60_000).for_each(|i| text.push_str(&format!("{}.5,\"s{}\",{i},nothing to say\n", i / 7, i % 7)));
    let folder = Folder::with(&[("long.csv", text.as_bytes())]);
    let options = LoadOptions { track: Some("id".into()), ..LoadOptions::default() };
    let whole = load(&Source::BuiltIn { name: "long", bytes: text.as_bytes().into() }, &options).unwrap();
    let pieces = load(&Source::File(folder.path("long.csv")), &options).unwrap();
    assert_eq!((&pieces.channels, &pieces.time, &pieces.sha256), (&whole.channels, &whole.time, &whole.sha256));
    assert_eq!((pieces.channels.len(), pieces.faults.repeated_times.count), (7, 0));
    let last = &pieces.channels[6];
    assert_eq!((last.name.as_str(), last.ends(&pieces.time)), ("x@s6", Some((0.0, 8570.0))));
    assert_eq!(last.value(59_996), 59_996.0);
}

#[test]
fn times_of_day_pass_midnight_in_each_track() {
    let text = "id,time,x\na,23:59:58,1\nb,12:00:00,1\na,23:59:59,2\nb,12:00:01,2\na,00:00:00,3\nb,12:00:02,3\n";
    let source = Source::BuiltIn { name: "ids", bytes: text.as_bytes().into() };
    let track = load(&source, &LoadOptions { track: Some("id".into()), ..LoadOptions::default() }).unwrap();
    assert_eq!(track.time.seconds, [0.0, -43_198.0, 1.0, -43_197.0, 2.0, -43_196.0]);
}

/// Tracks of real tables: rows of each id as `awk` counts them.
#[test]
fn tables_of_several_real_tracks() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../shared/data");
    if !folder.is_dir() {
        return eprintln!("skipped: {} is absent", folder.display());
    }
    let open = |name: &str, column: &str, channel: &str| -> Track {
        let options =
            LoadOptions { track: Some(column.into()), channels: vec![channel.into()], ..LoadOptions::default() };
        load(&Source::File(folder.join(name)), &options).unwrap_or_else(|e| panic!("{name}: {e}"))
    };
    let sizes = |t: &Track| t.channels.iter().map(|c| (c.name.clone(), c.values.len())).collect::<BTreeMap<_, _>>();
    let of = |pairs: &[(&str, usize)]| pairs.iter().map(|(n, c)| ((*n).to_owned(), *c)).collect::<BTreeMap<_, _>>();
    let phone = open("gnss_phone_range_rate.csv", "svid", "range_m");
    assert_eq!(
        sizes(&phone),
        of(&[
            ("range_m@5", 207),
            ("range_m@13", 207),
            ("range_m@12", 207),
            ("range_m@20", 207),
            ("range_m@29", 207),
            ("range_m@31", 207)
        ])
    );
    assert_eq!(phone.faults.backward_times.count + phone.faults.repeated_times.count, 0);
    let thirteen = phone.channel("range_m@13").unwrap();
    assert_eq!(thirteen.values.iter().filter(|v| **v > 1e12).count(), 25, "wild ranges of satellite 13");
    let flights = open("spacex_webcast_30hz.csv.gz", "flight", "velocity_mps");
    assert_eq!((flights.channels.len(), flights.channels[0].values.len()), (46, 26_445));
    let series = open("messy/trainset_long_labels_head.csv", "series", "value");
    assert_eq!(series.channels.iter().map(|c| c.values.len()).sum::<usize>(), 1_499);
}
