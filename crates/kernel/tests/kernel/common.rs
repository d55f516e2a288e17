//! What the tests of the kernel share: streams of Arrow, and the program run on them.

use std::path::{Path, PathBuf};

use arrow_array::cast::AsArray as _;
use arrow_array::types::{Float64Type, Int64Type};
use arrow_array::{Array as _, ArrayRef, RecordBatch};
use arrow_ipc::reader::StreamReader;
use arrow_ipc::writer::StreamWriter;
use arrow_select::concat::concat_batches;

/// The stream of `batch`, cut into batches of `size` rows.
pub(crate) fn stream(batch: &RecordBatch, size: usize) -> Vec<u8> {
    let cut = (0..batch.num_rows()).step_by(size);
    stream_of(batch, cut.map(|at| batch.slice(at, size.min(batch.num_rows() - at))))
}

/// The stream of `pieces` with the schema of `batch`.
pub(crate) fn stream_of(batch: &RecordBatch, pieces: impl Iterator<Item = RecordBatch>) -> Vec<u8> {
    let mut writer = StreamWriter::try_new(Vec::new(), batch.schema_ref()).unwrap();
    pieces.for_each(|piece| writer.write(&piece).unwrap());
    writer.into_inner().unwrap()
}

/// A batch of columns by name.
pub(crate) fn batch(columns: Vec<(&str, ArrayRef)>) -> RecordBatch {
    RecordBatch::try_from_iter_with_nullable(columns.into_iter().map(|(name, column)| (name, column, true))).unwrap()
}

/// What the kernel gives for a stream, as one batch.
pub(crate) fn kernel(args: &[&str], input: Vec<u8>) -> RecordBatch {
    let output = run(args, input);
    assert!(output.status.success(), "{args:?}: {}", String::from_utf8_lossy(&output.stderr));
    let reader = StreamReader::try_new(output.stdout.as_slice(), None).unwrap();
    let schema = reader.schema();
    let batches: Vec<RecordBatch> = reader.map(Result::unwrap).collect();
    concat_batches(&schema, &batches).unwrap()
}

/// What the kernel says when it refuses a stream; its exit status is 2.
pub(crate) fn refused(args: &[&str], input: Vec<u8>) -> String {
    let output = run(args, input);
    let said = String::from_utf8(output.stderr).unwrap();
    assert_eq!(output.status.code(), Some(2), "{args:?}: {said}");
    said
}

fn run(args: &[&str], input: Vec<u8>) -> std::process::Output {
    assert_cmd::Command::cargo_bin("wildpoint-kernel").unwrap().args(args).write_stdin(input).output().unwrap()
}

/// A session on `columns`, which lies in `folder`.
pub(crate) fn session(folder: &Path, about_data: &str, channels: &str) -> PathBuf {
    let path = folder.join("s.toml");
    let data = format!("[data]\nfile = \"none.csv\"\nsha256 = \"\"\nrows = 0\n{about_data}\n");
    std::fs::write(&path, format!("format = 1\n{data}\n{channels}\n")).unwrap();
    path
}

pub(crate) fn reals(batch: &RecordBatch, name: &str) -> Vec<Option<f64>> {
    batch.column_by_name(name).unwrap().as_primitive::<Float64Type>().iter().collect()
}

pub(crate) fn wholes(batch: &RecordBatch, name: &str) -> Vec<Option<i64>> {
    batch.column_by_name(name).unwrap().as_primitive::<Int64Type>().iter().collect()
}

pub(crate) fn texts(batch: &RecordBatch, name: &str) -> Vec<String> {
    let column = batch.column_by_name(name).unwrap().as_string::<i32>();
    (0..column.len())
        .map(|row| if column.is_null(row) { String::new() } else { column.value(row).to_owned() })
        .collect()
}
