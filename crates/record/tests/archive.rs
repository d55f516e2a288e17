//! A session on a folder of files: however the rows are spread over them, and whether they are text or Parquet, the
//! result is the same; and what a session records of it.

#![expect(clippy::unwrap_used, reason = "a test that cannot read its own data may say so by ending")]

use std::fmt::Write as _;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use parquet::data_type::{ByteArray, ByteArrayType, DoubleType};
use parquet::file::properties::WriterProperties;
use parquet::file::writer::SerializedFileWriter;
use parquet::schema::parser::parse_message_type;
use proptest::prelude::*;
use wildpoint_record::session::Digest;
use wildpoint_record::session::archive::{
    Archive, DecisionsFor, Named, Summary, Template, recorded, replay_folder, with_archive,
};

#[derive(Debug, Clone)]
struct Row {
    track: &'static str,
    time: f64,
    values: [Option<f64>; 2],
}

const CHANNELS: &str =
    "[[channel]]\nname = \"v\"\nmethod = \"hampel\"\n\n[[channel]]\nname = \"w\"\nmethod = \"two-sided\"\n";

/// Three tracks, two of which have times that come twice; wild points, and cells without a value.
fn rows() -> Vec<Row> {
    let ripple = |n: usize| (((n * n + 3) as f64).sin() * 100.0).round() / 100.0 + if n % 41 == 7 { 30.0 } else { 0.0 };
    let row = |i: usize| Row {
        track: ["p-1", "p-2", "q"][i % 3],
        time: (i / 3) as f64 * 0.5 - if i % 30 == 17 { 0.5 } else { 0.0 },
        values: [Some(ripple(i)).filter(|_| i % 13 != 5), Some(ripple(i + 1000))],
    };
    (0..300).map(row).collect()
}

fn write_csv(path: &Path, rows: &[Row]) {
    let cell = |value: Option<f64>| value.map(|v| v.to_string()).unwrap_or_default();
    let mut text = "pass,t,v,w\n".to_owned();
    for row in rows {
        writeln!(text, "{},{},{},{}", row.track, row.time, cell(row.values[0]), cell(row.values[1])).unwrap();
    }
    std::fs::write(path, text).unwrap();
}

fn write_parquet(path: &Path, rows: &[Row]) {
    let schema = "message m { required binary pass (UTF8); required double t; optional double v; optional double w; }";
    let schema = Arc::new(parse_message_type(schema).unwrap());
    let file = std::fs::File::create(path).unwrap();
    let mut writer = SerializedFileWriter::new(file, schema, Arc::new(WriterProperties::default())).unwrap();
    let mut group = writer.next_row_group().unwrap();
    let ids: Vec<ByteArray> = rows.iter().map(|row| row.track.into()).collect();
    let mut column = group.next_column().unwrap().unwrap();
    column.typed::<ByteArrayType>().write_batch(&ids, None, None).unwrap();
    column.close().unwrap();
    let times: Vec<f64> = rows.iter().map(|row| row.time).collect();
    let mut column = group.next_column().unwrap().unwrap();
    column.typed::<DoubleType>().write_batch(&times, None, None).unwrap();
    column.close().unwrap();
    for at in 0..2 {
        let present: Vec<f64> = rows.iter().filter_map(|row| row.values[at]).collect();
        let levels: Vec<i16> = rows.iter().map(|row| i16::from(row.values[at].is_some())).collect();
        let mut column = group.next_column().unwrap().unwrap();
        column.typed::<DoubleType>().write_batch(&present, Some(&levels), None).unwrap();
        column.close().unwrap();
    }
    group.close().unwrap();
    writer.close().unwrap();
}

/// A session of format 2 as the program saves it, with its digest.
fn session(folder: &Path, about_data: &str) -> PathBuf {
    let path = folder.join("s.toml");
    let data = format!("[data]\nfile = \"none.csv\"\nsha256 = \"\"\nbytes = 0\nrows = 0\n{about_data}\n");
    let text = format!("format = 2\n\n{data}\n{CHANNELS}");
    let digest = Digest::of(&path, &text).unwrap().lines();
    std::fs::write(&path, text + &digest).unwrap();
    path
}

fn template(session: &Path) -> Template {
    Template::read(session, DecisionsFor::Nobody, Named::default()).unwrap()
}

fn replayed(session: &Path, folder: &Path) -> Vec<Summary> {
    replay_folder(&template(session), folder, |_| {}).unwrap()
}

const BOTH: &str = "time = \"t\"\ntrack = \"pass\"";

/// The result of one CSV file with all rows in order.
fn expected(session: &Path, base: &Path) -> Vec<Summary> {
    let folder = base.join("whole");
    std::fs::create_dir_all(&folder).unwrap();
    write_csv(&folder.join("all.csv"), &rows());
    let found = replayed(session, &folder);
    assert_eq!(found.len(), 6);
    assert!(found.iter().any(|s| s.counts.flagged > 0), "{found:?}");
    found
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(12))]
    #[test]
    fn any_partition_of_the_rows_gives_the_same_digest(
        shuffled in Just(rows()).prop_shuffle(),
        files in prop::collection::vec(0_usize..4, 300),
        parquet in prop::collection::vec(any::<bool>(), 4),
    ) {
        let base = tempfile::tempdir().unwrap();
        let session = session(base.path(), BOTH);
        let folder = base.path().join("parts");
        std::fs::create_dir_all(folder.join("deep")).unwrap();
        std::fs::write(folder.join("_SUCCESS"), "").unwrap();
        for (file, parquet) in parquet.iter().enumerate() {
            let own: Vec<Row> = shuffled.iter().zip(&files).filter(|(_, f)| **f == file).map(|(r, _)| r.clone()).collect();
            if *parquet {
                write_parquet(&folder.join(format!("part-{file}.parquet")), &own);
            } else {
                write_csv(&folder.join("deep").join(format!("part-{file}.csv")), &own);
            }
        }
        prop_assert_eq!(replayed(&session, &folder), expected(&session, base.path()));
    }
}

#[test]
fn a_folder_for_each_track_gives_the_same_as_a_column() {
    let base = tempfile::tempdir().unwrap();
    let session = session(base.path(), BOTH);
    let folder = base.path().join("hive");
    for (track, escaped) in [("p-1", "p%2D1"), ("p-2", "p-2"), ("q", "q")] {
        let own = folder.join(format!("pass={escaped}"));
        std::fs::create_dir_all(&own).unwrap();
        let rows: Vec<Row> = rows().into_iter().filter(|row| row.track == track).collect();
        write_csv(&own.join("part.csv"), &rows);
        let text = std::fs::read_to_string(own.join("part.csv")).unwrap();
        let without: Vec<&str> = text.lines().map(|line| line.split_once(',').unwrap().1).collect();
        std::fs::write(own.join("part.csv"), without.join("\n")).unwrap();
    }
    assert_eq!(replayed(&session, &folder), expected(&session, base.path()));
}

#[test]
fn what_a_session_records_of_an_archive_is_read_again_and_a_change_is_named() {
    let base = tempfile::tempdir().unwrap();
    let session = session(base.path(), BOTH);
    let archive = Archive::of(&expected(&session, base.path()));
    assert_eq!((archive.tracks, archive.rows), (3, 300));
    assert!(archive.differences(recorded(&session).unwrap().archive.as_ref())[0].contains("no [archive]"));
    // Twice: the second takes the place of the first.
    for flagged in [0, archive.flagged] {
        let text = std::fs::read_to_string(&session).unwrap();
        let text = with_archive(&session, &text, &Archive { flagged, ..archive.clone() }).unwrap();
        std::fs::write(&session, text).unwrap();
    }
    let now = recorded(&session).unwrap();
    assert_eq!((now.archive.as_ref(), now.altered.as_deref()), (Some(&archive), Some(&[][..])));
    assert!(archive.differences(now.archive.as_ref()).is_empty());
    // One value of one row is another: the counts may be the same, the digest is not.
    let mut other = rows();
    other[3].values[1] = Some(0.125);
    write_csv(&base.path().join("whole/all.csv"), &other);
    let changed = Archive::of(&replayed(&session, &base.path().join("whole")));
    let said = changed.differences(now.archive.as_ref());
    assert!(said.last().unwrap().starts_with("the digest of the archive is"), "{said:?}");
    // A session that was changed by hand gets no new digest.
    let text = std::fs::read_to_string(&session).unwrap().replace("hampel", "median-window");
    std::fs::write(&session, &text).unwrap();
    let refused = with_archive(&session, &text, &archive).unwrap_err().to_string();
    assert!(refused.contains("was changed since the session was saved"), "{refused}");
}

#[test]
fn a_folder_without_files_and_rows_without_a_track_are_refused() {
    let base = tempfile::tempdir().unwrap();
    let session = session(base.path(), BOTH);
    let folder = base.path().join("archive");
    std::fs::create_dir_all(&folder).unwrap();
    std::fs::write(folder.join("_metadata.csv"), "x").unwrap();
    let said = replay_folder(&template(&session), &folder, |_| {}).unwrap_err().to_string();
    assert!(said.contains("no file of an archive"), "{said}");
    std::fs::write(folder.join("a.csv"), "pass,t,v,w\na,0,1,1\n,1,1,1\na,2,1,1\n").unwrap();
    let said = replay_folder(&template(&session), &folder, |_| {}).unwrap_err().to_string();
    assert!(said.contains("row 2 names no track"), "{said}");
}
