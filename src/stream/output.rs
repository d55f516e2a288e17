//! The lines that go out.

use std::io::Write;

use serde::Serialize;

use super::judge::Said;
use super::layout::Sample;
use crate::cli::FormatArg;
use crate::error::{Error, Result};
use crate::session::table::{Column, column, names};
use crate::track::{escape_formula, number_text};

/// The columns, in order.
pub const STREAM_COLUMNS: [Column; 7] = [
    column("row", "number of the line of data, from 1"),
    column("time", "time, as read"),
    column("value", "value, as read"),
    column("verdict", "`normal`, `outlier`, `suspect`, `unchecked`, `missing` or `unreadable`"),
    column("expected", "value that the method expects"),
    column("tolerance", "distance from the expected value at which a sample is flagged"),
    column("correction", "`correction` where an earlier verdict on this row is replaced (JSON: true)"),
];

/// A line about a sample.
#[derive(Serialize)]
struct Told<'a> {
    row: u64,
    time: &'a str,
    value: Value<'a>,
    verdict: &'a str,
    #[serde(skip_serializing_if = "Option::is_none")]
    expected: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    tolerance: Option<f64>,
    #[serde(skip_serializing_if = "std::ops::Not::not")]
    correction: bool,
}

/// A number, or the text where it is none.
#[derive(Serialize)]
#[serde(untagged)]
enum Value<'a> {
    Number(f64),
    Text(&'a str),
}

/// What a line needs to know of its sample when more is said of it later.
#[derive(Debug, Clone)]
pub(super) struct Label {
    pub(super) row: u64,
    pub(super) time: String,
    pub(super) value: String,
    pub(super) y: f64,
}

impl Label {
    pub(super) fn of(sample: &Sample, y: f64) -> Self {
        Self { row: sample.row, time: sample.time.clone(), value: sample.value.clone(), y }
    }
}

/// Writes the header, where the format has one.
///
/// # Errors
/// [`Error::Io`].
pub(super) fn header(format: FormatArg, out: &mut dyn Write) -> Result<()> {
    if format == FormatArg::Csv { put(out, &names(&STREAM_COLUMNS).join(",")) } else { Ok(()) }
}

/// Writes what is said of a sample.
///
/// # Errors
/// [`Error::Io`].
pub(super) fn said(format: FormatArg, label: &Label, said: &Said, correction: bool, out: &mut dyn Write) -> Result<()> {
    let number = |x: f64| Some(x).filter(|x| x.is_finite());
    let told = Told {
        row: label.row,
        time: &label.time,
        value: if format == FormatArg::Jsonl { Value::Number(label.y) } else { Value::Text(&label.value) },
        verdict: said.verdict.word(),
        expected: number(said.expected),
        tolerance: number(said.tolerance).filter(|h| *h > 0.0),
        correction,
    };
    line(format, &told, out)
}

/// Writes a line about a sample of which nothing can be said.
///
/// # Errors
/// [`Error::Io`].
pub(super) fn passed(format: FormatArg, sample: &Sample, verdict: &str, out: &mut dyn Write) -> Result<()> {
    let told = Told {
        row: sample.row,
        time: &sample.time,
        value: Value::Text(&sample.value),
        verdict,
        expected: None,
        tolerance: None,
        correction: false,
    };
    line(format, &told, out)
}

fn line(format: FormatArg, told: &Told<'_>, out: &mut dyn Write) -> Result<()> {
    if format == FormatArg::Jsonl {
        let text = serde_json::to_string(told).map_err(|e| write_error(std::io::Error::other(e)))?;
        return put(out, &text);
    }
    let value = match told.value {
        Value::Text(text) => text.to_owned(),
        Value::Number(x) => number_text(x),
    };
    let number = |x: Option<f64>| x.map(number_text).unwrap_or_default();
    let cells = [
        told.row.to_string(),
        quoted(told.time),
        quoted(&value),
        told.verdict.to_owned(),
        number(told.expected),
        number(told.tolerance),
        if told.correction { "correction".to_owned() } else { String::new() },
    ];
    put(out, &cells.join(","))
}

/// A cell that no spreadsheet runs, in quotes where it needs them.
fn quoted(text: &str) -> String {
    let text = &*escape_formula(text);
    if text.contains(['"', ',', '\n', '\r']) { format!("\"{}\"", text.replace('"', "\"\"")) } else { text.to_owned() }
}

fn put(out: &mut dyn Write, text: &str) -> Result<()> {
    out.write_all(text.as_bytes()).and_then(|()| out.write_all(b"\n")).map_err(write_error)
}

/// The error of a reader that has gone away, or a full disk.
pub(super) fn write_error(source: std::io::Error) -> Error {
    Error::io("write", "standard output")(source)
}
