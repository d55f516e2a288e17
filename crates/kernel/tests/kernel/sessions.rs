//! The kernel gives for the record of every saved session what `replay` gives: the cells of the cleaned file, the rows
//! of the audit table and the counts, wherever the stream is cut and with any number of threads.

use std::collections::HashMap;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use crate::common::{batch, kernel, reals, stream, texts, wholes};
use arrow_array::{ArrayRef, Float64Array, RecordBatch};
use wildpoint_record::session::flags::flags;
use wildpoint_record::session::{Accepted, Analysed, Opened, open, write_cleaned};
use wildpoint_record::track::number_of;

fn sessions() -> Vec<PathBuf> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../sessions");
    let mut found: Vec<PathBuf> = std::fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()).collect();
    found.sort();
    assert!(found.len() >= 6, "{found:?}");
    found
}

/// A table of text as cells by the name of their column.
struct Table {
    names: Vec<String>,
    rows: Vec<Vec<String>>,
}

impl Table {
    fn of(text: &[u8], delimiter: u8) -> Self {
        let mut reader = csv::ReaderBuilder::new().delimiter(delimiter).from_reader(text);
        let names = reader.headers().unwrap().iter().map(str::to_owned).collect();
        let rows = reader.records().map(|row| row.unwrap().iter().map(str::to_owned).collect()).collect();
        Self { names, rows }
    }

    fn column(&self, name: &str) -> Vec<&str> {
        let at = self.names.iter().position(|n| n == name).unwrap();
        self.rows.iter().map(|row| row[at].as_str()).collect()
    }
}

/// The record of a session as Arrow, from its numbers.
fn record(opened: &Opened) -> RecordBatch {
    let track = &opened.track;
    #[expect(clippy::cast_precision_loss, reason = "small whole seconds")]
    let origin = track.time.origin_ns as f64 / 1e9;
    let times: Float64Array = track.time.seconds.iter().map(|s| Some(s + origin)).collect();
    let mut columns: Vec<(&str, ArrayRef)> = vec![(track.time.name.as_str(), Arc::new(times))];
    for channel in &track.channels {
        let values: Float64Array = channel.values.iter().map(|v| Some(*v).filter(|v| v.is_finite())).collect();
        columns.push((&channel.name, Arc::new(values)));
    }
    batch(columns)
}

/// The cells of the cleaned file by their time, of every channel.
fn same_cells(opened: &Opened, analysed: &Analysed, samples: &RecordBatch) {
    let track = &opened.track;
    let mut text = Vec::new();
    write_cleaned(track, &analysed.changes(track), &mut text).unwrap();
    let comma = track.dialect.decimal_comma;
    let table = Table::of(&text, if comma { b';' } else { b',' });
    let times = table.column(&track.time.name);
    for channel in opened.session.plans.iter().map(|plan| track.channel(&plan.channel).unwrap()) {
        let cells = table.column(&channel.name);
        let by_time: HashMap<u64, &str> =
            times.iter().zip(cells).map(|(time, cell)| (number_of(time).unwrap().to_bits(), cell)).collect();
        let clean = reals(samples, &format!("{}_clean", channel.name));
        for (time, clean) in reals(samples, &track.time.name).iter().zip(clean) {
            let written = number_of(by_time[&time.unwrap().to_bits()]);
            let rounded = clean.map(|value| track.rounded(channel, value));
            assert_eq!(rounded, written, "{} at {time:?}", channel.name);
        }
    }
}

/// The audit table, cell by cell.
fn same_flags(opened: &Opened, analysed: &Analysed, found: &RecordBatch) {
    let mut text = Vec::new();
    flags(&opened.track, &opened.session, analysed, &mut text).unwrap();
    let table = Table::of(&text, b',');
    assert_eq!(table.rows.len(), found.num_rows());
    for name in ["channel", "verdict", "kind", "forward", "backward", "action", "decided_by", "note"] {
        assert_eq!(table.column(name), texts(found, name), "{name}");
    }
    for name in ["row", "run_start", "run_length"] {
        let expected: Vec<Option<i64>> = table.column(name).iter().map(|cell| cell.parse().ok()).collect();
        assert_eq!(expected, wholes(found, name), "{name}");
    }
    for name in ["raw", "expected", "tolerance", "ratio"] {
        let expected: Vec<Option<f64>> = table.column(name).iter().map(|cell| cell.parse().ok()).collect();
        assert_eq!(expected, reals(found, name), "{name}");
    }
}

#[test]
fn the_kernel_gives_what_replay_gives() {
    for path in sessions() {
        let opened = open(&path, Accepted::default()).unwrap();
        let analysed = Analysed::of(&opened.session, &opened.track, &wildpoint_core::stop::Stop::never()).unwrap();
        let record = record(&opened);
        let session = path.to_str().unwrap();
        let args = ["--session", session, "--time", &opened.track.time.name, "--decisions"];
        let mut first: Option<[RecordBatch; 3]> = None;
        for (size, threads) in [(65_536, "1"), (7, "2"), (1, "1")] {
            let emitted = ["samples", "flags", "summary"].map(|emit| {
                kernel(&[&args[..], &["--threads", threads, "--emit", emit]].concat(), stream(&record, size))
            });
            let first = first.get_or_insert_with(|| emitted.clone());
            assert_eq!(*first, emitted, "{session}, batches of {size} rows, {threads} threads");
        }
        let [samples, flags, summary] = first.unwrap();
        same_cells(&opened, &analysed, &samples);
        same_flags(&opened, &analysed, &flags);
        let flagged: i64 = wholes(&summary, "flagged").into_iter().flatten().sum();
        assert_eq!(usize::try_from(flagged).unwrap(), opened.session.result.unwrap().flagged, "{session}");
    }
}
