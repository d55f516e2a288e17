//! Loading awkward files, each named after what is awkward about it.

#![expect(clippy::expect_used, clippy::unwrap_used, reason = "a failed expectation is a failed test")]

use std::path::{Path, PathBuf};

use wildpoint::error::Error;
use wildpoint::track::{
    Changes, ColumnKind, Delimiter, Encoding, LoadOptions, Source, TimeFormat, Track, for_each_row, load, rewrite,
};

fn path(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/data").join(name)
}

fn load_with(name: &str, options: &LoadOptions) -> Result<Track, Error> {
    load(&Source::File(path(name)), options)
}

fn loaded(name: &str) -> Track {
    let track = load_with(name, &LoadOptions::default()).unwrap_or_else(|e| panic!("{name}: {e}"));
    let mut again = Vec::new();
    rewrite(&track, &Changes::default(), &mut again).unwrap();
    let bytes = std::fs::read(path(name)).unwrap();
    assert!(track.dialect.packing.is_some() || again == bytes, "{name}: rewritten with no change, it is another file");
    for channel in &track.channels {
        assert_eq!(channel.values.len(), track.rows, "{name}: {}", channel.name);
    }
    assert_eq!(track.time.seconds.len(), track.rows, "{name}");
    track
}

fn refused(name: &str) -> String {
    load_with(name, &LoadOptions::default()).expect_err(name).to_string()
}

/// Equal, with NaN equal to NaN.
#[track_caller]
fn assert_same(values: &[f64], expected: &[f64]) {
    assert_eq!(format!("{values:?}"), format!("{expected:?}"));
}

fn values<'a>(track: &'a Track, channel: &str) -> &'a [f64] {
    &track.channel(channel).unwrap_or_else(|| panic!("channel {channel}")).values
}

const NAN: f64 = f64::NAN;

#[test]
fn delimiters_and_decimal_commas() {
    let track = loaded("semicolon_decimal_comma.csv");
    assert_eq!((track.dialect.delimiter, track.dialect.decimal_comma), (Delimiter::Byte(b';'), true));
    assert_same(values(&track, "höhe_m"), &[1.5, -2.25, 1500.0]);
    assert_same(&track.time.seconds, &[0.0, 0.5, 1.0]);
    assert_eq!((track.channels.len(), track.channels[0].unit.as_str()), (1, "m"));

    let track = loaded("pipes_no_header.psv");
    assert_eq!((track.dialect.header, track.channels.len()), (false, 2));
    assert_eq!(track.time.format, TimeFormat::SampleNumber);
    assert!(track.notes[0].contains("--time '#1'"), "{:?}", track.notes);
    let told = LoadOptions { time: Some("#1".into()), ..LoadOptions::default() };
    assert_same(&load_with("pipes_no_header.psv", &told).unwrap().time.seconds, &[0.0, 0.5, 1.0]);

    let track = loaded("blanks_leading.txt");
    assert_eq!(track.dialect.delimiter, Delimiter::Blanks);
    assert_same(&track.time.seconds, &[0.0, 0.1, 100.2]);
    assert_same(values(&track, "y"), &[7.0, NAN, 9.0]);

    let track = loaded("tabs_units_row.tsv");
    assert_eq!((track.dialect.units_row, track.rows, track.channels[0].unit.as_str()), (true, 3, "ft"));
    assert_same(values(&track, "alt"), &[100.0, NAN, 300.0]);
    assert_same(values(&loaded("one_column.csv"), "x"), &[1.0, 2.0, 3.0]);
}

#[test]
fn encodings() {
    let track = loaded("utf16_little_endian.csv");
    assert_eq!(track.dialect.encoding, Encoding::Utf16 { big_endian: false });
    assert_same(values(&track, "höhe_m"), &[1.5, 2.5]);
    assert_same(values(&loaded("utf16_big_endian.csv"), "x"), &[1.5, 2.5]);
    let track = loaded("latin1.csv");
    assert_eq!((track.dialect.encoding, track.channels[0].name.as_str()), (Encoding::Latin1, "temp_°C"));
    let track = loaded("two_members.csv.gz");
    assert_eq!((track.dialect.packing.map(|p| p.name), track.rows), (Some("gzip"), 3));
}

#[test]
fn line_ends_quotes_and_comments() {
    let track = loaded("bom_mixed_line_ends.csv");
    assert_eq!((track.columns[0].name.as_str(), track.rows), ("time", 3));
    assert_same(values(&loaded("carriage_returns_only.csv"), "x"), &[1.0, 2.0]);
    let track = loaded("quoted_line_breaks.csv");
    assert_same(values(&track, "x, \"raw\""), &[1.5, 2.5, 3.5]);
    let mut notes = Vec::new();
    for_each_row(&track, |row, cells| {
        notes.push((row, cells.line, cells.text(2).into_owned(), String::from_utf8_lossy(cells.raw(1)).into_owned()));
        Ok(())
    })
    .unwrap();
    let note = |row, line, text: &str, raw: &str| (row, line, text.to_owned(), raw.to_owned());
    let expected =
        [note(0, 2, "two\nlines, \"quoted\"", "\"1.5\""), note(1, 4, "", " \"2.5\" "), note(2, 5, "a\r\nb", "3.5")];
    assert_eq!(notes, expected);
    let track = loaded("single_quotes.csv");
    assert_eq!((track.dialect.quote, track.channels[0].unit.as_str()), (Some(b'\''), "cm"));
    assert_same(&track.time.seconds, &[0.0, 60.0]);
    assert_same(values(&loaded("comments_everywhere.csv"), "x"), &[1.0, 2.0, 3.0]);
}

#[test]
fn headers() {
    let track = loaded("header_in_comment.csv");
    assert_same(&track.time.seconds, &[0.0, 0.1]);
    assert_eq!(track.columns[0].name, "version");
    assert_same(values(&loaded("title_line.csv"), "y"), &[2.0, 4.0]);
    let names: Vec<String> = loaded("duplicate_names.csv").channels.into_iter().map(|c| c.name).collect();
    assert_eq!(names, ["altitude", "altitude_2", "column_4"]);
}

#[test]
fn empty_and_ragged_rows() {
    let track = loaded("trailing_empty_rows.csv");
    assert_same(values(&track, "x"), &[1.0, NAN, 3.0]);
    assert_eq!(track.faults.unreadable_times.first, [(3, String::new())]);
    assert_eq!(track.columns[3].kind, ColumnKind::Empty);
    let track = loaded("ragged.csv");
    assert_same(values(&track, "y"), &[2.0, NAN, 4.0, 5.0]);
    let ragged = &track.faults.ragged_rows;
    assert_eq!((ragged.count, ragged.first[0].0, ragged.first[1].0), (2, 3, 4));
    assert!(track.notes[0].contains("another number of cells"), "{:?}", track.notes);
}

#[test]
fn missing_unreadable_and_infinite_cells() {
    let track = loaded("missing_markers.csv");
    let bad = &track.faults.unreadable_cells;
    assert_eq!((bad.count, &bad.first[0]), (2, &(12, "bad (x)".to_owned())));
    assert_eq!(values(&track, "x").iter().filter(|v| v.is_nan()).count(), 9);
    let told = LoadOptions { missing: vec!["-9999".into(), "bad".into()], ..LoadOptions::default() };
    let track = load_with("missing_markers.csv", &told).unwrap();
    assert_eq!((track.faults.unreadable_cells.count, track.columns[1].missing), (1, 11));
    let track = loaded("infinite.csv");
    assert_same(values(&track, "x"), &[1.0, NAN, NAN, NAN, 2.0]);
    assert_eq!((track.faults.infinite_cells.count, track.faults.infinite_cells.first[0].0), (3, 3));
}

#[test]
fn times() {
    let track = loaded("clock_past_midnight.csv");
    assert_same(&track.time.seconds, &[0.0, 0.25, 0.5, 0.75]);
    let track = loaded("date_and_time_apart.csv");
    assert_same(&track.time.seconds, &[0.0, 3600.0, 7200.0]);
    assert_eq!(track.time.full_label(3600.0), "2005-04-01 00:00:00");
    let track = loaded("epoch_milliseconds.csv");
    assert_eq!(track.time.format, TimeFormat::Epoch { unit_ns: 1_000_000 });
    assert_same(&track.time.seconds, &[0.0, 0.25, 0.5]);
    assert_same(&loaded("epoch_nanoseconds.csv").time.seconds, &[0.0, 1e-9]);
    let track = loaded("iso_every_spelling.csv");
    assert_same(&track.time.seconds, &[0.0, 0.5, 1.0, 55.0, 21_775.0, NAN]);
    assert_eq!(track.faults.unreadable_times.first, [(7, "noon".to_owned())]);
    let track = loaded("long_decimals.csv");
    assert_same(&track.time.seconds, &[0.0, 0.300_000_000_000_000_04 - 0.1, 0.4]);
    let track = loaded("repeated_backward_unreadable.csv");
    assert_same(&track.time.seconds, &[0.0, 1.0, NAN, NAN, NAN, NAN, NAN, 2.0]);
    let faults = &track.faults;
    assert_eq!(faults.repeated_times.first, [(4, "6".to_owned())]);
    assert_eq!(faults.backward_times.first, [(5, "4".to_owned()), (6, "5.5".to_owned())]);
    assert_eq!(faults.unreadable_times.first, [(7, String::new()), (8, "soon".to_owned())]);
    assert!(track.notes[0].starts_with("time goes back after row 3 (6): 2 of 8 rows"), "{:?}", track.notes);
}

#[test]
fn day_first_must_be_told_where_the_file_does_not_show_it() {
    assert!(refused("day_or_month_first.csv").contains("is the day or the month first?"));
    let told = |day_first| LoadOptions { day_first: Some(day_first), ..LoadOptions::default() };
    let seconds = |day_first| load_with("day_or_month_first.csv", &told(day_first)).unwrap().time.seconds;
    assert_same(&seconds(true), &[0.0, 86_400.0]);
    assert_same(&seconds(false), &[0.0, 31.0 * 86_400.0]);
}

#[test]
fn truth_and_chosen_columns() {
    let track = loaded("one_truth.csv");
    assert_eq!((track.truth, track.channels.len()), (Some(vec![false, true, false]), 1));
    let track = loaded("two_truths.csv");
    assert_eq!((&track.truth, track.channels.len()), (&None, 2));
    let options = LoadOptions {
        channels: vec!["b".into(), "#2".into()],
        truth: Some("a_truth".into()),
        ..LoadOptions::default()
    };
    let track = load_with("two_truths.csv", &options).unwrap();
    let names: Vec<&str> = track.channels.iter().map(|c| c.name.as_str()).collect();
    assert_eq!((names, track.truth), (vec!["b", "a"], Some(vec![false, true])));
    let fails = |options: LoadOptions| load_with("two_truths.csv", &options).unwrap_err().to_string();
    let e = fails(LoadOptions { truth: Some("b".into()), ..LoadOptions::default() });
    assert!(e.contains("`b` is no truth column: it holds 2"), "{e}");
    let e = fails(LoadOptions { channels: vec!["time".into()], ..LoadOptions::default() });
    assert!(e.contains("`time` is the time"), "{e}");
    let e = fails(LoadOptions { channels: vec!["a_thruth".into()], ..LoadOptions::default() });
    assert!(e.contains("did you mean `a_truth`"), "{e}");
    let sample = LoadOptions { time: Some("sample".into()), ..LoadOptions::default() };
    assert_eq!(load_with("two_truths.csv", &sample).unwrap().channels.len(), 3);
    let words = LoadOptions { channels: vec!["state".into()], ..LoadOptions::default() };
    let e = load_with("tabs_units_row.tsv", &words).unwrap_err().to_string();
    assert!(e.contains("`state` is no channel of numbers: it holds `up`"), "{e}");
}

#[test]
fn what_is_no_table_of_numbers_is_refused_with_line_and_way_out() {
    for (name, what) in [
        ("open_quote.csv", "open_quote.csv:3: a quoted cell starts here"),
        ("zero_bytes.csv", "zero_bytes.csv:3: a NUL byte"),
        ("empty.csv", "the file is empty"),
        ("header_alone.csv", "header_alone.csv:1: a header, and no rows"),
        ("words_only.csv", "words_only.csv:1: no column of numbers"),
        ("nmea.txt", "nmea.txt:1: NMEA sentences"),
        ("ranging.npt", "ranging.npt: no records with measurements in this file, which looks like CRD"),
        ("long_form.csv", "long_form.csv:1: a long table"),
        ("", "this is a folder"),
        ("not_there.csv", "cannot read"),
    ] {
        let message = refused(name);
        assert!(message.contains(what), "{name}: {message}");
        assert!(name == "not_there.csv" || message.contains("\n  "), "{name}: no way out: {message}");
    }
    let no_quotes = LoadOptions { quotes: Some(false), ..LoadOptions::default() };
    let track = load_with("open_quote.csv", &no_quotes).unwrap();
    assert_eq!(track.faults.unreadable_cells.first, [(3, "\"2 (x)".to_owned())]);
}

#[test]
fn a_file_that_changed_is_not_read_as_if_it_had_not() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("a.csv");
    std::fs::write(&file, "time,x\n0,1\n1,2\n").unwrap();
    let track = load(&Source::File(file.clone()), &LoadOptions::default()).unwrap();
    std::fs::write(&file, "time,x\n0,1\n1,3\n").unwrap();
    let e = rewrite(&track, &Changes::default(), &mut Vec::new()).unwrap_err().to_string();
    assert!(e.contains("the file changed since it was loaded"), "{e}");
    assert!(for_each_row(&track, |_, _| Ok(())).is_err());
}

#[test]
fn a_recognised_truth_column_is_about_the_channel_that_its_name_fits() {
    let text = "t,vx_mps,alt_m,vx_truth_outlier\n0,1,2,0\n1,1,2,1\n2,1,2,0\n";
    let source = Source::BuiltIn { name: "test", bytes: text.as_bytes().into() };
    let by_itself = load(&source, &LoadOptions::default()).unwrap();
    assert_eq!(by_itself.truth_for("vx_mps"), Some(&[false, true, false][..]));
    assert_eq!(by_itself.truth_for("alt_m"), None);
    let told = LoadOptions { truth: Some("vx_truth_outlier".into()), ..LoadOptions::default() };
    assert!(load(&source, &told).unwrap().truth_for("alt_m").is_some());
    let general = text.replace("vx_truth", "truth");
    let source = Source::BuiltIn { name: "test", bytes: general.as_bytes().into() };
    assert!(load(&source, &LoadOptions::default()).unwrap().truth_for("alt_m").is_some());
}

#[test]
fn a_time_that_steps_back_or_repeats_is_still_the_time() {
    let text = "t_s,y\n0,1\n1,2\n2,3\n3,4\n2,5\n4,6\n4,7\n5,8\n6,9\n";
    let source = Source::BuiltIn { name: "test", bytes: text.as_bytes().into() };
    let track = load(&source, &LoadOptions::default()).unwrap();
    assert_eq!((track.time.name.as_str(), track.channels.len()), ("t_s", 1));
    assert_eq!((track.faults.backward_times.count, track.faults.repeated_times.count), (1, 1));
    // A column named `t` that goes up and down is a measurement.
    let text = "t,y\n20.5,1\n20.4,2\n20.6,3\n20.5,4\n20.3,5\n20.6,6\n";
    let source = Source::BuiltIn { name: "test", bytes: text.as_bytes().into() };
    assert_eq!(load(&source, &LoadOptions::default()).unwrap().time.name, "sample");
}

/// What is noted of a record of this text.
fn notes(text: &str, options: &LoadOptions) -> Vec<String> {
    let source = Source::BuiltIn { name: "test", bytes: text.as_bytes().into() };
    load(&source, options).unwrap().notes
}

#[test]
fn a_time_column_that_cannot_be_read_is_told() {
    for (first, second) in [("three o'clock", "four o'clock"), ("2024-03-31 Q1", "2024-03-31 Q2")] {
        let text = format!("time,x\n{first},1\n{second},2\n");
        let told = notes(&text, &LoadOptions::default());
        let wanted =
            format!("time is the sample number, since `time` holds no times that can be read: {first}; times are");
        assert!(matches!(&told[..], [note] if note.starts_with(&wanted)), "{told:?}");
        assert_eq!(notes(&text, &LoadOptions { time: Some("sample".into()), ..LoadOptions::default() }), [""; 0]);
    }
    // Words that are no time, under a name that is none.
    assert_eq!(notes("site,x\na,1\nb,2\n", &LoadOptions::default()), [""; 0]);
}

#[test]
fn numbers_with_commas_between_commas_are_told() {
    let text = "t,x,y\n0,\"1,5\",1\n1,\"2,5\",2\n2,\"3,5\",3\n";
    let told = notes(text, &LoadOptions::default());
    assert!(matches!(&told[..], [note] if note.starts_with("`x` holds numbers with commas: say --decimal-comma")));
    assert_eq!(notes(text, &LoadOptions { decimal_comma: Some(true), ..LoadOptions::default() }), [""; 0]);
    assert_eq!(notes("t,x,y\n0,\"1,a\",1\n1,\"2,5\",2\n", &LoadOptions::default()), [""; 0]);
    // Nothing else is there.
    let alone = Source::BuiltIn { name: "test", bytes: b"t,x\n0,\"1,5\"\n1,\"2,5\"\n".as_slice().into() };
    let e = load(&alone, &LoadOptions::default()).unwrap_err().to_string();
    assert!(e.contains("no column of numbers besides the time") && e.contains("`x` holds numbers with commas"), "{e}");
}

#[test]
fn a_truth_column_is_not_about_a_channel_loaded_alone_that_its_name_does_not_fit() {
    let text = "t,vx_mps,alt_m,vx_truth_outlier\n0,1,2,0\n1,1,2,1\n2,1,2,0\n";
    let source = Source::BuiltIn { name: "test", bytes: text.as_bytes().into() };
    let only = LoadOptions { channels: vec!["alt_m".into()], ..LoadOptions::default() };
    assert_eq!(load(&source, &only).unwrap().truth_for("alt_m"), None);
}
