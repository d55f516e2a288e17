//! How the lines of a stream are laid out: recognised from the first of them as the loader does it.

use std::borrow::Cow;

use serde_json::Value as Json;

use super::lines::Line;
use crate::cli::FormatArg;
use crate::error::{Error, Result};
use crate::track::{
    Cell, Delimiter, Dialect, LoadOptions, Reading, SECONDS_PER_DAY, Source, TimeAxis, TimeFormat, Track, load,
};

/// What a line holds.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Sample {
    /// Data row, from 1.
    pub(super) row: u64,
    /// Line of the input, from 1.
    pub(super) line: u64,
    /// The text of the time.
    pub(super) time: String,
    /// The text of the value; the whole line where it has no cells.
    pub(super) value: String,
    /// What can be made of it.
    pub(super) content: Content,
}

/// What can be made of a line.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Content {
    /// Seconds after the first time, and the value.
    Measured(f64, f64),
    /// A time and no value.
    Missing,
    /// Something else.
    Unreadable,
}

/// Where time and channel stand and how they are written.
pub(super) struct Layout {
    format: FormatArg,
    dialect: Dialect,
    reading: Reading,
    /// Format and origin; no times.
    axis: TimeAxis,
    /// Keys of the objects, where lines are objects.
    names: Vec<String>,
    channel: usize,
    /// The name of the channel.
    pub(super) name: String,
    /// Channels that are left out.
    pub(super) others: usize,
    /// The last time that was read, for times of day.
    last: f64,
}

/// The name under which the loader speaks of the stream.
const NAME: &str = "standard input";

/// Rows that are looked at to find the time column, where it is not named.
const ROWS: usize = 3;

/// Longest text of a line that is passed on unread.
const SHOWN: usize = 200;

impl Layout {
    /// The layout of a stream that starts with `lines`, and how many of them are data; none while they are too few
    /// to tell and the stream goes on (not `ended`).
    ///
    /// # Errors
    /// What the loader says of these lines as a file.
    pub(super) fn of(
        lines: &[Line],
        format: FormatArg,
        options: &LoadOptions,
        ended: bool,
    ) -> Result<Option<(Self, usize)>> {
        let (text, names, options) = match format {
            FormatArg::Csv => (joined(lines), Vec::new(), options.clone()),
            FormatArg::Jsonl => {
                let names = keys(lines);
                let text = as_table(lines, &names)?;
                let options =
                    LoadOptions { delimiter: Some(Delimiter::Byte(b',')), header: Some(true), ..options.clone() };
                (text, names, options)
            }
        };
        let track = load(&Source::BuiltIn { name: NAME, bytes: text.into() }, &options)?;
        let wanted = if ended || options.time.is_some() { 1 } else { ROWS };
        if track.rows < wanted {
            return Ok(None);
        }
        let rows = track.rows;
        Ok(Some((Self::told(track, format, names, &options)?, rows)))
    }

    fn told(track: Track, format: FormatArg, names: Vec<String>, options: &LoadOptions) -> Result<Self> {
        if let Some(view) = &track.dialect.view {
            return Err(Error::usage(
                format!("{}: several lines make a row, and a stream is judged line by line", view.format.name),
                "save the record as a file, and use `clean`",
            ));
        }
        let others = track.channels.len().saturating_sub(1);
        // A file can be looked at first; a stream would be judged by the wrong column all along.
        // That a first column without a name is the time can be seen in a file, not in its first rows.
        let counts =
            matches!(track.time.format, TimeFormat::Seconds | TimeFormat::Elapsed { .. } | TimeFormat::Epoch { .. });
        let guessed = counts && !track.dialect.header;
        if options.time.is_none() && (guessed || (track.time.column.is_none() && others > 0)) {
            let names: Vec<&str> = track.columns.iter().map(|c| c.name.as_str()).collect();
            return Err(Error::usage(
                "the time column of the stream is not clear",
                format!("name it with --time: sample (their number), or one of {} (#1 is the first)", names.join(", ")),
            ));
        }
        let Some(channel) = track.channels.into_iter().next() else {
            return Err(Error::input(NAME, "no column of numbers", "name the channel with --channel"));
        };
        Ok(Self {
            format,
            reading: Reading::new(track.dialect.decimal_comma, &options.missing),
            dialect: track.dialect,
            axis: TimeAxis { seconds: Vec::new(), ..track.time },
            names,
            channel: channel.column,
            name: channel.name,
            others,
            last: f64::NAN,
        })
    }

    /// What `line` holds as data row `row` (from 1).
    pub(super) fn read(&mut self, line: &Line, row: u64) -> Sample {
        let sample = |time: String, value: String, content| Sample { row, line: line.number, time, value, content };
        let cells = match self.format {
            FormatArg::Csv => self.cells(line),
            FormatArg::Jsonl => self.fields(line),
        };
        let Some([date, time, value]) = cells.filter(|_| !line.cut) else {
            let text: String = String::from_utf8_lossy(&line.bytes).chars().take(SHOWN).collect();
            return sample(String::new(), text, Content::Unreadable);
        };
        let seconds = self.seconds(&date, &time, row);
        let content = match (seconds, self.reading.cell(value.as_bytes())) {
            (Some(t), Cell::Number(y)) => Content::Measured(t, y),
            (Some(_), Cell::Missing) => Content::Missing,
            _ => Content::Unreadable,
        };
        sample(if self.axis.column.is_some() { time } else { (row - 1).to_string() }, value, content)
    }

    /// Date, time and value of a line of cells; empty where the layout has no such column, none where the line has
    /// too few cells.
    fn cells(&self, line: &Line) -> Option<[String; 3]> {
        self.dialect.with_cells(&line.bytes, line.number, |cells| {
            let text = |column: Option<usize>| match column {
                None => Some(String::new()),
                Some(c) => (c < cells.len()).then(|| cells.text(c).into_owned()),
            };
            Some([text(self.axis.date_column)?, text(self.axis.column)?, text(Some(self.channel))?])
        })
    }

    /// The same of an object; a key that is not there has no value.
    fn fields(&self, line: &Line) -> Option<[String; 3]> {
        let object: Json = serde_json::from_slice(&line.bytes).ok()?;
        let object = object.as_object()?;
        let text =
            |column: Option<usize>| column.and_then(|c| object.get(self.names.get(c)?)).map_or(String::new(), plain);
        Some([text(self.axis.date_column), text(self.axis.column), text(Some(self.channel))])
    }

    /// Seconds after the first time.
    fn seconds(&mut self, date: &str, time: &str, row: u64) -> Option<f64> {
        if self.axis.column.is_none() {
            #[expect(clippy::cast_precision_loss, reason = "rows are far below 2^53")]
            return Some((row - 1) as f64);
        }
        let text = match (self.axis.date_column, &self.axis.format) {
            (None, _) if self.dialect.decimal_comma => Cow::Owned(time.replace(',', ".")),
            (None, _) => Cow::Borrowed(time),
            (Some(_), _) => Cow::Owned(format!("{date} {time}")),
        };
        let mut seconds = self.axis.parse(&text).filter(|t| t.is_finite())?;
        if self.axis.format == TimeFormat::Clock && self.last.is_finite() {
            // A step back of more than half a day is the next day.
            seconds += SECONDS_PER_DAY * ((self.last - seconds) / SECONDS_PER_DAY).round();
        }
        self.last = seconds;
        Some(seconds)
    }
}

fn joined(lines: &[Line]) -> Vec<u8> {
    lines.iter().flat_map(|l| l.bytes.iter().chain(b"\n")).copied().collect()
}

/// The keys of the objects, each once.
fn keys(lines: &[Line]) -> Vec<String> {
    let mut keys: Vec<String> = Vec::new();
    for object in lines.iter().filter_map(|l| serde_json::from_slice::<Json>(&l.bytes).ok()) {
        for key in object.as_object().into_iter().flat_map(|o| o.keys()) {
            if !keys.contains(key) {
                keys.push(key.clone());
            }
        }
    }
    keys
}

/// The objects as a table with a header, for the loader.
fn as_table(lines: &[Line], names: &[String]) -> Result<Vec<u8>> {
    let broken = |e: csv::Error| Error::input(NAME, e.to_string(), "write one JSON object on each line");
    let mut table = csv::Writer::from_writer(Vec::new());
    table.write_record(names).map_err(broken)?;
    for line in lines {
        let object: Option<Json> = serde_json::from_slice(&line.bytes).ok();
        let cell = |name: &String| object.as_ref().and_then(|o| o.get(name)).map_or(String::new(), plain);
        table.write_record(names.iter().map(cell)).map_err(broken)?;
    }
    table.into_inner().map_err(|e| Error::input(NAME, e.to_string(), "write one JSON object on each line"))
}

/// A JSON value as the text of a cell.
fn plain(value: &Json) -> String {
    match value {
        Json::String(text) => text.trim().to_owned(),
        Json::Null => String::new(),
        other => other.to_string(),
    }
}
