//! A file that is read piece by piece gives the track, or the error, that the same bytes give in memory.

#![expect(clippy::expect_used, reason = "a failed expectation is a failed test")]

use std::fmt::Write as _;
use std::io::Write as _;
use std::sync::Arc;

use wildpoint::track::{LoadOptions, Source, Track, load};

/// Loads `bytes` from a file, which is read piece by piece, and from memory.
fn both(bytes: &[u8], options: &LoadOptions) -> [Result<Track, String>; 2] {
    assert!(bytes.len() > 1 << 20, "a smaller file is read whole");
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("record.csv");
    std::fs::write(&path, bytes).expect("the file can be written");
    let file = Source::File(path.clone());
    let memory = Source::BuiltIn { name: "record.csv", bytes: Arc::from(bytes) };
    [file, memory].map(|source| {
        let error = |e: wildpoint::error::Error| e.to_string().replace(&path.display().to_string(), "record.csv");
        load(&source, options).map_err(error)
    })
}

/// All of a track but where it came from, to the last bit.
fn all(track: &Track) -> String {
    let bits = |values: &[f64]| values.iter().map(|v| v.to_bits()).collect::<Vec<_>>();
    let mut text = format!("{} {:?} {} {:?}", track.sha256, track.dialect, track.rows, track.columns);
    let _ = write!(text, "{:?} {:?} {}", track.faults, track.notes, track.truth_told);
    let axis = &track.time;
    let _ = write!(text, "{} {:?} {:?} {:?} {}", axis.name, axis.column, axis.date_column, axis.format, axis.origin_ns);
    let _ = write!(text, "{:?} {:?}", bits(&axis.seconds), track.truth);
    for channel in &track.channels {
        let _ = write!(text, "{} {} {} {:?}", channel.name, channel.unit, channel.column, bits(&channel.values));
    }
    text
}

fn same(name: &str, bytes: &[u8]) -> Option<Track> {
    let [file, memory] = both(bytes, &LoadOptions::default());
    match (file, memory) {
        (Ok(file), Ok(memory)) => {
            assert!(all(&file) == all(&memory), "{name}");
            Some(file)
        }
        (file, memory) => {
            assert_eq!(file.err(), memory.err(), "{name}");
            None
        }
    }
}

const ROWS: usize = 120_000;

/// A record of which `change` makes some rows others.
fn record(head: &str, end: &str, change: impl Fn(usize) -> Option<String>) -> String {
    let mut text = format!("{head}{end}");
    for i in 0..ROWS {
        let row = change(i).unwrap_or_else(|| format!("{}.{},{}.25,-{}", i / 10, i % 10, i % 97, i % 13));
        text.push_str(&row);
        text.push_str(end);
    }
    text
}

const HEAD: &str = "t_s,x_m,y_m";

#[test]
fn plain_files_of_all_kinds() {
    let plain = record(HEAD, "\n", |_| None);
    let track = same("plain", plain.as_bytes()).expect("a track");
    assert_eq!((track.rows, track.channels.len()), (ROWS, 2));
    same("crlf", record(HEAD, "\r\n", |_| None).as_bytes()).expect("a track");
    same("lone carriage returns", record(HEAD, "\r", |_| None).as_bytes()).expect("a track");
    same("no last line end", plain.trim_end().as_bytes()).expect("a track");
    same("byte order mark", format!("\u{feff}{plain}").as_bytes()).expect("a track");
    let comments = format!("{}{plain}", "# a note of the instrument\n".repeat(40_000));
    same("long comments", comments.as_bytes()).expect("a track");
    let wide = record(HEAD, "\n", |i| Some(format!("{i},{}.5,{}", i * i % 7, "x".repeat(3000))));
    same("few long lines", &wide.as_bytes()[..3 << 20]).expect("a track");
    let faults = record(HEAD, "\n", |i| match i % 30_000 {
        29_000 => Some(format!("{},1e400,x", i / 10 - 7)),
        29_001 => Some(",,".into()),
        29_002 => Some("soon,1".into()),
        29_003 => Some("  # indented,1,2".into()),
        29_004 => Some(format!("{},1e3, 2 ", i / 10)),
        _ => None,
    });
    let track = same("faults", faults.as_bytes()).expect("a track");
    assert!(track.faults.backward_times.count > 0 && track.faults.backward_times.first[0].0 == 29_002);
    let back = record(HEAD, "\n", |i| (i > 1000 && i % 3 > 0).then(|| format!("{},1,2", i % 50)));
    assert!(same("mostly backward", back.as_bytes()).is_none_or(|track| !track.notes.is_empty()), "lost rows are told");
    let long = record(HEAD, "\n", |i| (i % 50_000 > 49_990).then(|| format!("{i}.123456789012,1,2")));
    same("times finer than nanoseconds", long.as_bytes()).expect("a track");
}

#[test]
fn quoted_files_of_all_kinds() {
    let quoted = record("\"t_s\",\"x_m\",\"site\"", "\n", |i| Some(format!("\"{i}\",\"{}.5\",\"a, b\"", i % 97)));
    same("every cell", quoted.as_bytes()).expect("a track");
    let broken = record("t_s,x_m,site", "\n", |i| {
        Some(format!("{i},{}.5,{}", i % 97, if i % 5 == 0 { "\"two\nlines, \"\"1\"\"\n\"" } else { "5\"" }))
    });
    let track = same("lines in quotes", broken.as_bytes()).expect("a track");
    assert_eq!(track.rows, ROWS);
    let late = record(HEAD, "\n", |i| (i == ROWS - 3).then(|| "11999.7,\"1\",2".into()));
    same("one quote at the end", late.as_bytes()).expect("a track");
    let open = record(HEAD, "\n", |i| (i == 70_000).then(|| "7000.0,\"1,2".into()));
    let [file, _] = both(open.as_bytes(), &LoadOptions::default());
    assert!(file.is_err_and(|e| e.starts_with("record.csv:70002: ")));
    same("an open quote", open.as_bytes());
}

#[test]
fn other_encodings_and_what_is_no_text() {
    let mut latin = record("t_s,x_m,y_\u{b0}C", "\n", |_| None).into_bytes();
    same("a degree sign in UTF-8", &latin).expect("a track");
    latin.extend_from_slice(b"12000,\xb0,1\n");
    let track = same("a last row that is not UTF-8", &latin).expect("a track");
    assert_eq!(track.dialect.encoding, wildpoint::track::Encoding::Latin1);
    let plain = record(HEAD, "\n", |_| None);
    let mut wide = vec![0xff, 0xfe];
    plain.encode_utf16().for_each(|unit| wide.extend(unit.to_le_bytes()));
    same("UTF-16", &wide).expect("a track");
    assert!(same("a NUL", format!("{plain}1,\0,2\n").as_bytes()).is_none());
    let head = "text of no table at all\n".repeat(60_000);
    assert!(same("no table", head.as_bytes()).is_none());
    let mut packer = flate2::write::GzEncoder::new(Vec::new(), flate2::Compression::none());
    packer.write_all(plain.as_bytes()).expect("memory");
    let packed = packer.finish().expect("memory");
    assert!(same("gzipped", &packed).expect("a track").dialect.packing.is_some());
    assert!(same("cut off", &packed[..packed.len() - 9]).is_none());
}

#[test]
fn options_are_followed_and_wrong_ones_refused_alike() {
    let plain = record(HEAD, "\n", |_| None);
    for options in [
        LoadOptions { time: Some("sample".into()), ..LoadOptions::default() },
        LoadOptions { channels: vec!["y_m".into()], missing: vec!["-5".into()], ..LoadOptions::default() },
        LoadOptions { channels: vec!["z".into()], ..LoadOptions::default() },
        LoadOptions { quotes: Some(false), header: Some(false), ..LoadOptions::default() },
        LoadOptions { encoding: Some(wildpoint::track::Encoding::Latin1), ..LoadOptions::default() },
    ] {
        let [file, memory] = both(plain.as_bytes(), &options);
        assert!(file.as_ref().map(all) == memory.as_ref().map(all), "{options:?}: {:?}", file.err());
    }
}
