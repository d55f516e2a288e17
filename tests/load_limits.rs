//! Loading at the limits: lines, columns, spans and mixtures that no program writes on purpose.

#![expect(clippy::unwrap_used, reason = "a failed expectation is a failed test")]

use std::fmt::Write as _;

use wildpoint::error::Error;
use wildpoint::session::read;
use wildpoint::track::{Changes, Delimiter, LoadOptions, Source, TimeFormat, Track, load, rewrite};

fn load_with(text: &[u8], options: &LoadOptions) -> Result<Track, Error> {
    load(&Source::BuiltIn { name: "limits.csv", bytes: text.into() }, options)
}

fn loaded(text: &[u8]) -> Track {
    let track = load_with(text, &LoadOptions::default()).unwrap_or_else(|e| panic!("{e}"));
    let mut again = Vec::new();
    rewrite(&track, &Changes::default(), &mut again).unwrap();
    assert!(again == text, "rewritten with no change, it is another file");
    track
}

fn refused(text: &[u8]) -> String {
    load_with(text, &LoadOptions::default()).unwrap_err().to_string()
}

#[test]
fn a_thousand_columns_with_the_time_in_the_middle() {
    let mut text = String::new();
    for row in 0..5 {
        let cell = |c: usize| match (row, c) {
            (0, 500) => "time_s".into(),
            (0, _) => format!("c{c}_m"),
            (_, 500) => format!("{}.5", row - 1),
            _ => format!("{}", c * 10 + row),
        };
        let cells: Vec<String> = (0..1000).map(cell).collect();
        writeln!(text, "{}", cells.join(",")).unwrap();
    }
    let track = loaded(text.as_bytes());
    assert_eq!((track.rows, track.channels.len(), track.time.column), (4, 999, Some(500)));
    assert_eq!(track.channels[998].values, [9991.0, 9992.0, 9993.0, 9994.0]);
    assert_eq!(track.time.seconds, [0.0, 1.0, 2.0, 3.0]);
}

#[test]
fn a_line_of_ten_megabytes_is_a_cell_or_an_error_and_nothing_worse() {
    let long = "x".repeat(10 << 20);
    let track = loaded(format!("time,x,remark\n0,1,a\n1,2,{long}\n2,3,b\n").as_bytes());
    assert_eq!((track.rows, &track.channels[0].values[..]), (3, &[1.0, 2.0, 3.0][..]));
    // In a column of numbers it is one unreadable cell, told in a few characters.
    let track = loaded(format!("time,x\n0,1\n1,{long}\n2,3\n").as_bytes());
    let fault = &track.faults.unreadable_cells;
    assert_eq!((fault.count, fault.first[0].0, track.channels[0].values[1].is_nan()), (1, 3, true));
    assert!(fault.first[0].1.len() < 100);
    let digits = "1".repeat(10 << 20);
    assert_eq!(loaded(format!("time,x\n0,1\n1,{digits}\n2,3\n").as_bytes()).faults.infinite_cells.count, 1);
    for text in [long.clone(), format!("{long}\n{long}\n"), format!("a,\"{long}\n")] {
        assert!(refused(text.as_bytes()).len() < 1000);
    }
}

#[test]
fn rows_with_another_delimiter_are_counted_and_noted() {
    let mut text = String::from("time,x,y\n");
    for i in 0..41 {
        let row = format!("{i},{i}.5,{}.25", i * i % 17);
        writeln!(text, "{}", if i % 4 == 3 { row.replace(',', ";") } else { row }).unwrap();
    }
    let track = loaded(text.as_bytes());
    assert_eq!((track.rows, track.faults.ragged_rows.count, track.channels.len()), (41, 10, 2));
    assert_eq!(track.faults.ragged_rows.first[0], (5, "1 cells".into()));
    assert!(track.notes.iter().any(|n| n.contains("another number of cells")), "{:?}", track.notes);
    // Decimal commas between semicolons are no mixture; points among them are read as well.
    let track = loaded(b"time;x\n0;1,5\n1;2.5\n2;3,5\n");
    assert_eq!((track.dialect.decimal_comma, track.channels[0].values[0], track.rows), (true, 1.5, 3));
}

#[test]
fn commas_that_part_cells_and_begin_decimals_need_quotes() {
    let text = b"time,x\n0,\"1,5\"\n1,\"2,5\"\n2,\"3,5\"\n";
    let comma = |quotes| LoadOptions {
        delimiter: Some(Delimiter::Byte(b',')),
        decimal_comma: Some(true),
        quotes,
        ..LoadOptions::default()
    };
    assert_eq!(load_with(text, &comma(None)).unwrap().channels[0].values, [1.5, 2.5, 3.5]);
    // A repaired 2,5 would be two cells.
    let e = load_with(b"time,x\n0,1\n1,2\n", &comma(Some(false))).unwrap_err().to_string();
    assert!(e.contains("where cells are not quoted") && e.contains("--delimiter"), "{e}");
}

#[test]
fn a_comment_after_blanks_is_a_comment_in_every_pass() {
    let track = loaded(b"id,x\na,1\n  # b,2\nc,3\n");
    assert_eq!((track.rows, &track.channels[0].values[..]), (2, &[1.0, 3.0][..]));
    let cells = vec![wildpoint::track::CellChange { row: 1, column: 1, value: Some(5.0) }];
    let mut out = Vec::new();
    rewrite(&track, &Changes { cells, rows: Vec::new() }, &mut out).unwrap();
    assert_eq!(out, b"id,x\na,1\n  # b,2\nc,5\n");
}

#[test]
fn a_leap_second_is_a_row_of_its_own_and_the_second_after_it_the_same_time() {
    let text =
        b"time,x\n2016-12-31T23:59:59Z,1\n2016-12-31T23:59:60Z,2\n2017-01-01T00:00:00Z,3\n2017-01-01T00:00:01Z,4\n";
    let track = loaded(text);
    // UTC as computers count it has no room for it: one of the two is a repeated time, said so and kept in the file.
    assert_eq!(format!("{:?}", track.time.seconds), "[0.0, 1.0, NaN, 2.0]");
    assert_eq!(track.faults.repeated_times.first, [(4, "2017-01-01T00:00:00Z".into())]);
    let clock = loaded(b"time,x\n23:59:59,1\n23:59:60,2\n00:00:01,3\n00:00:02,4\n");
    assert_eq!(clock.time.seconds, [0.0, 1.0, 2.0, 3.0]);
}

#[test]
fn zones_are_taken_off_in_every_spelling() {
    for zone in ["Z", "z", " UTC", "+00:00", "-00:00", "+0000", "+00"] {
        let track = loaded(format!("time,x\n2019-03-31T01:59:59{zone},1\n2019-03-31T02:00:00{zone},2\n").as_bytes());
        assert_eq!(track.time.full_label(1.0), "2019-03-31 02:00:00 UTC", "{zone}");
    }
    // One instant, three ways to write it, then one second more: summer time begins in between.
    let track = loaded(
        b"time,x\n2019-03-31T00:59:59Z,1\n2019-03-31T03:00:00+02:00,2\n2019-03-30T18:30:01-06:30,3\n2019-03-31 06:45:02 +0545,4\n",
    );
    assert_eq!(track.time.seconds, [0.0, 1.0, 2.0, 3.0]);
}

#[test]
fn steps_of_a_millisecond_over_twenty_years_are_exact() {
    // Each time is the double nearest to the decimal number of seconds, as reading that number gives it.
    let mut text = String::from("time,x\n");
    let mut expected = Vec::new();
    // From 2000-01-01 to 2020-01-01 there are 7305 days.
    for (day, date) in [(0_u64, "2000-01-01"), (7305, "2020-01-01")] {
        for ms in 0..2000_u64 {
            writeln!(text, "{date}T00:00:{:02}.{:03}Z,{ms}", ms / 1000, ms % 1000).unwrap();
            expected.push(format!("{}.{:03}", day * 86_400 + ms / 1000, ms % 1000).parse::<f64>().unwrap());
        }
    }
    let track = loaded(text.as_bytes());
    assert_eq!(track.time.format, TimeFormat::Iso);
    assert!(track.time.seconds == expected);
    assert_eq!(track.faults.repeated_times.count, 0);
    let epoch = text.replace("time,x\n", "").lines().enumerate().fold(String::from("epoch_ms,x\n"), |all, (i, _)| {
        let ms = 946_684_800_000 + (if i < 2000 { 0 } else { 7305 * 86_400_000 }) + i as u64 % 2000;
        all + &format!("{ms},1\n")
    });
    let track = loaded(epoch.as_bytes());
    assert_eq!(track.time.format, TimeFormat::Epoch { unit_ns: 1_000_000 });
    assert!(track.time.seconds == expected);
}

#[test]
fn other_kinds_of_text_are_named() {
    let wide: Vec<u8> = "time,x\n0,1\n".encode_utf16().flat_map(u16::to_le_bytes).collect();
    assert!(refused(&wide).contains("UTF-16 without a byte order mark"));
    assert!(refused(b"\xff\xfet\0i").contains("UTF-16"), "half a file");
    assert!(refused(b"time,x\n0,1\n1,\0\n").contains(":3: a NUL byte"));
    assert!(refused(b"PK\x03\x04rest").contains("the zip stream is broken"));
}

#[cfg(unix)]
#[test]
fn a_device_is_refused_and_not_read_to_its_end() {
    let device = std::path::PathBuf::from("/dev/zero");
    let e = load(&Source::File(device.clone()), &LoadOptions::default()).unwrap_err().to_string();
    assert!(e.contains("a pipe or a device") && e.contains("wildpoint stream"), "{e}");
    let e = read(&device).unwrap_err().to_string();
    assert!(e.contains("not a regular file"), "{e}");
}

#[test]
fn a_session_of_great_depth_or_size_is_refused() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("deep.toml");
    for text in [
        format!("format = 1\nx = {}1{}\n", "[".repeat(100_000), "]".repeat(100_000)),
        format!("format = 1\nx = {}1{}\n", "{ a = ".repeat(50_000), " }".repeat(50_000)),
        format!("format = 1\n[{}]\n", vec!["a"; 100_000].join(".")),
    ] {
        std::fs::write(&path, text).unwrap();
        assert!(!read(&path).unwrap_err().to_string().is_empty());
    }
    let file = std::fs::File::create(&path).unwrap();
    file.set_len(65 << 20).unwrap();
    assert!(read(&path).unwrap_err().to_string().contains("more than 64 MiB"));
}
