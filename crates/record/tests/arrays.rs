//! Files that h5py and netCDF4 wrote (`data/arrays/make.py` says what is in them), and broken ones.

#![cfg(feature = "hdf5")]
#![expect(
    clippy::unwrap_used,
    clippy::print_stderr,
    reason = "a failed expectation is a failed test, and what is skipped is said"
)]

use std::path::{Path, PathBuf};
use std::process::Command;
use std::sync::Arc;

use wildpoint_record::error::Error;
use wildpoint_record::track::{
    Aside, CellChange, Changes, ColumnKind, CopyForm, LoadOptions, Preview, Source, Track, Wanted, copy_form,
    for_each_row, load, rewrite, write_columns,
};

const ROWS: usize = 60;

fn folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/data/arrays")
}

/// The saw of `make.py`.
fn saw(row: usize) -> f64 {
    20.0 + (row * 7 % 17) as f64 / 4.0
}

/// The same with its wild point.
fn wild(row: usize) -> f64 {
    if row == 30 { 99.5 } else { saw(row) }
}

fn loaded(path: &Path, table: Option<usize>) -> Track {
    let options = LoadOptions { table, ..LoadOptions::default() };
    load(&Source::File(path.to_path_buf()), &options).unwrap_or_else(|e| panic!("{e}"))
}

fn values<'t>(track: &'t Track, name: &str) -> &'t [f64] {
    &track.channel(name).unwrap_or_else(|| panic!("no channel {name}: {:?}", names(track))).values
}

fn names(track: &Track) -> Vec<&str> {
    track.channels.iter().map(|c| c.name.as_str()).collect()
}

fn unit<'t>(track: &'t Track, name: &str) -> &'t str {
    &track.columns.iter().find(|c| c.name == name).unwrap().unit
}

fn kind(track: &Track, name: &str) -> ColumnKind {
    track.columns.iter().find(|c| c.name == name).unwrap().kind
}

/// Times of a calendar: the first, and the step.
fn times(track: &Track) -> (String, f64) {
    let seconds = &track.time.seconds;
    let step = seconds[1] - seconds[0];
    assert!(seconds.windows(2).all(|w| (w[1] - w[0] - step).abs() < 1e-9), "{seconds:?}");
    (track.time.exact_label(seconds[0]), step)
}

fn same(found: &[f64], expected: impl Fn(usize) -> f64) {
    assert_eq!(found.len(), ROWS);
    for (row, value) in found.iter().enumerate() {
        let expected = expected(row);
        assert!(*value == expected || value.is_nan() && expected.is_nan(), "row {row}: {value} and not {expected}");
    }
}

fn cells(track: &Track, row: usize) -> Vec<String> {
    let mut found = Vec::new();
    for_each_row(track, |at, cells| {
        if at == row {
            found = (0..cells.len()).map(|c| cells.text(c).into_owned()).collect();
        }
        Ok(())
    })
    .unwrap();
    found
}

fn says(track: &Track, words: &str) -> bool {
    track.notes.iter().any(|n| n.contains(words))
}

/// What is in the files of `make.py`.
fn check(folder: &Path) {
    classic(&folder.join("classic.nc"));
    offset64(&folder.join("offset64.nc"));
    netcdf4(&folder.join("netcdf4.nc"));
    groups(&folder.join("groups.h5"));
    latest(&folder.join("latest.h5"));
    table(&folder.join("table.h5"));
    matlab(&folder.join("matlab.mat"));
}

fn classic(path: &Path) {
    let track = loaded(path, None);
    assert_eq!((times(&track), track.time.name.as_str()), (("2021-03-04T09:00:00Z".into(), 0.5), "time"));
    assert_eq!(names(&track), ["temp", "pres"]);
    same(values(&track, "temp"), |i| if i == 5 { f64::NAN } else { wild(i) });
    same(values(&track, "pres"), |i| if i == 7 { f64::NAN } else { 10.0 + i as f64 / 8.0 });
    assert_eq!((unit(&track, "temp"), unit(&track, "pres")), ("degC", "dbar"));
    assert_eq!(
        (kind(&track, "temp_state"), kind(&track, "who")),
        (ColumnKind::Aside(Aside::Quality), ColumnKind::Text)
    );
    assert!(says(&track, "`temp` is sea water temperature"), "{:?}", track.notes);
    // As short as they were packed: two decimals.
    assert_eq!(cells(&track, 30), ["2021-03-04T09:00:15.000Z", "99.50", "13.75", "4", "ab"]);
    assert_eq!(cells(&track, 5)[1], "");
    assert_eq!(track.rounded(&track.channels[0], 20.123), 20.12);
}

fn offset64(path: &Path) {
    let track = loaded(path, None);
    assert_eq!(times(&track), ("2021-03-04T10:00:00Z".into(), 10.0));
    // What was never written is no value.
    same(values(&track, "level"), |i| if i == 20 { f64::NAN } else { wild(i) });
    assert_eq!(cells(&track, 1)[0], "2021-03-04T10:00:10Z");
}

fn netcdf4(path: &Path) {
    let track = loaded(path, None);
    assert_eq!(times(&track), ("2021-03-04T10:00:00Z".into(), 0.25));
    assert_eq!((names(&track), unit(&track, "wind[1]")), (vec!["wind[0]", "wind[1]", "wind[2]"], "m s-1"));
    same(values(&track, "wind[0]"), wild);
    same(values(&track, "wind[2]"), |i| saw(i) + 2.0);
    assert!(says(&track, "`spectrum` (60 × 60 values)"), "{:?}", track.notes);
    assert!(says(&track, "--table reads another"), "{:?}", track.notes);
    let tables = [loaded(path, Some(1)), loaded(path, Some(2))];
    let freq = tables.iter().find(|t| t.columns.iter().any(|c| c.name == "freq")).unwrap();
    assert_eq!((freq.columns.len(), unit(freq, "freq")), (1, "Hz"));
    let options = LoadOptions { table: Some(3), ..LoadOptions::default() };
    let e = load(&Source::File(path.to_path_buf()), &options).unwrap_err().to_string();
    assert!(e.contains("there is no table 3") && e.contains("time (60 rows)"), "{e}");
}

fn groups(path: &Path) {
    let track = loaded(path, None);
    assert_eq!((track.rows, names(&track)), (ROWS, vec!["imu/ax", "imu/ay"]));
    same(values(&track, "imu/ax"), wild);
    same(values(&track, "imu/ay"), |i| saw(i) * 4.0);
    assert_eq!((track.time.name.as_str(), track.time.seconds[3], unit(&track, "imu/ax")), ("imu/t", 0.03, "m/s2"));
    assert_eq!(cells(&track, 30).last().map(String::as_str), Some("FALSE"));
    assert!(says(&track, "1 gps (20 rows), 2 imu (60 rows); table 2 is read"), "{:?}", track.notes);
    let gps = loaded(path, Some(1));
    assert_eq!((gps.rows, names(&gps)), (20, vec!["gps/lat"]));
    let options = LoadOptions { table: Some(1), ..LoadOptions::default() };
    let preview = Preview::of(path, &options, 1 << 20, Wanted::always()).unwrap();
    assert_eq!((preview.rows(), names(&preview.track)), ((20, false), vec!["gps/lat"]));
}

fn latest(path: &Path) {
    let track = loaded(path, None);
    assert_eq!(times(&track), ("2021-03-04T10:00:00Z".into(), 1.0));
    same(values(&track, "height"), |i| if i == 3 { f64::NAN } else { wild(i) });
    same(values(&track, "position[1]"), |i| saw(i) * 2.0);
    same(values(&track, "z.r"), saw);
    assert_eq!(unit(&track, "height"), "m");
}

fn table(path: &Path) {
    let track = loaded(path, None);
    assert_eq!((times(&track), track.time.name.as_str()), (("2021-03-04T10:00:00Z".into(), 1.0), "time"));
    same(values(&track, "range"), wild);
    same(values(&track, "xy[1]"), |i| saw(i) + 0.5);
    assert_eq!(cells(&track, 30)[2..4], ["a", "FALSE"]);
    assert_eq!(cells(&track, 31)[2], "#b");
}

fn matlab(path: &Path) {
    let track = loaded(path, None);
    assert_eq!((times(&track), track.time.name.as_str()), (("2021-03-04T10:00:00Z".into(), 1.0), "t"));
    same(values(&track, "s/alt"), wild);
    same(values(&track, "xyz[2]"), |i| saw(i) + 2.0);
    assert!(says(&track, "datenum") && says(&track, "`note` (text)"), "{:?}", track.notes);
    assert_eq!(kind(&track, "s/ok"), ColumnKind::Aside(Aside::Flag));
}

#[test]
fn files_of_the_usual_libraries_are_read() {
    check(&folder());
}

/// The Python that has h5py and netCDF4: the one that `WILDPOINT_PYTHON` names.
#[test]
fn files_that_the_libraries_write_now_are_read() {
    let python = std::env::var("WILDPOINT_PYTHON").unwrap_or_else(|_| "python3".into());
    let has = Command::new(&python).args(["-c", "import h5py, netCDF4"]).output();
    if !has.is_ok_and(|out| out.status.success()) {
        eprintln!("skipped: {python} has no h5py and netCDF4");
        return;
    }
    let fresh = tempfile::tempdir().unwrap();
    let made = Command::new(&python).arg(folder().join("make.py")).arg(fresh.path()).output().unwrap();
    assert!(made.status.success(), "{}", String::from_utf8_lossy(&made.stderr));
    check(fresh.path());
}

#[test]
fn the_cleaned_copy_is_text_or_parquet() {
    let track = loaded(&folder().join("classic.nc"), None);
    for name in ["out.nc", "out.h5", "OUT.MAT"] {
        let e = copy_form(Path::new(name), &track).unwrap_err().to_string();
        assert!(e.contains("NetCDF file is read, and not written") && e.contains(".csv or .parquet"), "{e}");
    }
    assert_eq!(copy_form(Path::new("out.csv"), &track).unwrap(), CopyForm::Text);
    assert_eq!(copy_form(Path::new("out.parquet"), &track).unwrap(), CopyForm::Columns);
    let cells = vec![CellChange { row: 30, column: 1, value: Some(21.254_9) }];
    let changes = Changes { cells, rows: Vec::new() };
    let mut text = Vec::new();
    rewrite(&track, &changes, &mut text).unwrap();
    let lines: Vec<String> = String::from_utf8(text).unwrap().lines().map(str::to_owned).collect();
    assert_eq!((lines.len(), lines[0].as_str()), (ROWS + 1, "time,temp,pres,temp_state,who"));
    assert_eq!(lines[31], "2021-03-04T09:00:15.000Z,21.25,13.75,4,ab");
    assert_eq!(lines[32], "2021-03-04T09:00:15.500Z,23.25,13.875,1,\"c,d\"");
    let mut parquet = Vec::new();
    write_columns(&track, &changes, None, &mut parquet).unwrap();
    let again = of_bytes(parquet).unwrap();
    assert_eq!((names(&again), times(&again)), (names(&track), times(&track)));
    same(&again.channels[0].values, |i| match i {
        5 => f64::NAN,
        30 => 21.25,
        _ => saw(i),
    });
}

#[test]
fn what_takes_more_memory_than_there_is_is_refused_before_it_is_taken() {
    let e = load(&Source::File(folder().join("sparse.h5")), &LoadOptions::default()).unwrap_err();
    assert!(matches!(e, Error::Memory { .. }), "{e}");
}

#[test]
fn options_of_text_are_refused_and_what_is_no_table_is_named() {
    let source = Source::File(folder().join("groups.h5"));
    let options = LoadOptions { skip: Some(1), ..LoadOptions::default() };
    let e = load(&source, &options).unwrap_err().to_string();
    assert!(e.contains("--skip") && e.contains("groups.h5 is an HDF5 file"), "{e}");
    // Read again as it was read: the same table.
    let gps = loaded(&folder().join("groups.h5"), Some(1));
    assert_eq!(cells(&gps, 3), ["3", "51.003"]);
}

fn of_bytes(bytes: Vec<u8>) -> Result<Track, String> {
    let source = Source::BuiltIn { name: "test", bytes: Arc::from(bytes) };
    load(&source, &LoadOptions::default()).map_err(|e| e.to_string())
}

#[test]
fn broken_files_are_errors_or_read_and_never_end_the_program() {
    let mut state = 0x9e37_79b9_7f4a_7c15_u64;
    let mut next = |below: usize| {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (state >> 33) as usize % below
    };
    for name in ["classic.nc", "offset64.nc", "netcdf4.nc", "groups.h5", "latest.h5", "table.h5", "matlab.mat"] {
        let whole = std::fs::read(folder().join(name)).unwrap();
        let mut told = 0;
        for variant in 0..200 {
            let mut bytes = whole.clone();
            if variant % 4 == 0 {
                bytes.truncate(16 + next(whole.len() - 16));
            } else {
                for _ in 0..=variant % 4 {
                    // Most of what decides stands at the start.
                    let within = if variant % 2 == 0 { whole.len() } else { whole.len().min(2048) };
                    let at = 16 + next(within - 16);
                    bytes[at] ^= 1 << next(8);
                }
            }
            if let Err(e) = of_bytes(bytes) {
                told += 1;
                assert!(e.contains("\n  "), "{name}: the way out: {e}");
            }
        }
        assert!(told > 20, "{name}: {told} of 200 are refused");
    }
    // Sizes that no file has.
    let e = of_bytes(b"\x89HDF\r\n\x1a\n\0\0\0\0".to_vec()).unwrap_err();
    assert!(e.contains("damaged or cut off") && e.contains("fetch the file again"), "{e}");
}
