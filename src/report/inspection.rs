//! What the loader understood of a file, for people and for programs.

use std::fmt::Write as _;

use serde::Serialize;

use crate::analysis::Input;
use crate::method::noise;
use crate::method::shared::MAX_GAP;
use crate::param::Value;
use crate::session::{Preparation, Remedy, Suggestion, suggestions};
use crate::stop::{Stop, Stopped};
use crate::track::{ColumnKind, Encoding, FaultKind, Faults, Series, Track, printable, without_signed_zero};

mod understood;

pub use understood::{TableFacts, TimeFacts};

/// The facts of a file.
#[derive(Debug, Clone, Serialize)]
pub struct Inspection {
    /// The file.
    pub file: String,
    /// SHA-256 of its bytes.
    pub sha256: String,
    /// How its text is laid out, in words.
    pub layout: String,
    /// How its text is laid out, fact by fact.
    pub table: TableFacts,
    /// Data rows.
    pub rows: usize,
    /// Every column.
    pub columns: Vec<ColumnFacts>,
    /// Name of the time column, or `sample`.
    pub time: String,
    /// How times are written, in words.
    pub time_format: String,
    /// Where the times stand, fact by fact.
    pub time_facts: TimeFacts,
    /// The column that tells tracks apart, where one does.
    pub track: Option<String>,
    /// The truth column, where there is one.
    pub truth: Option<String>,
    /// First and last usable time.
    pub time_range: Option<(String, String)>,
    /// From the first to the last usable time, in seconds.
    pub duration_s: Option<f64>,
    /// The channels.
    pub channels: Vec<ChannelFacts>,
    /// What could not be used.
    pub faults: Vec<FaultFacts>,
    /// What the user should know.
    pub notes: Vec<String>,
}

/// The facts of a column.
#[derive(Debug, Clone, Serialize)]
pub struct ColumnFacts {
    /// Its number from 1.
    pub number: usize,
    /// Its name.
    pub name: String,
    /// `time`, `number`, `truth`, `text` or `empty`.
    pub kind: &'static str,
    /// Its unit, or empty.
    pub unit: String,
    /// Cells without a value.
    pub missing: usize,
    /// Why it is not a channel, for a column of numbers that is none.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub why: Option<&'static str>,
}

/// The facts of a channel.
#[derive(Debug, Clone, Serialize)]
pub struct ChannelFacts {
    /// Its name.
    pub name: String,
    /// Its unit, or empty.
    pub unit: String,
    /// Samples with a time and a value.
    pub present: usize,
    /// Rows without.
    pub missing: usize,
    /// Nominal interval in seconds.
    pub interval_s: Option<f64>,
    /// Samples lost between present ones.
    pub lost: usize,
    /// Stretches between cuts, at the default `max_gap`.
    pub segments: usize,
    /// Smallest and largest value.
    pub range: Option<(f64, f64)>,
    /// Noise scale by third differences, of the longest segment.
    pub noise_difference: Option<f64>,
    /// Noise scale by the smoothing spline, of the longest segment.
    pub noise_spline: Option<f64>,
    /// What the record's own noise is, in words: the resolution, held values, the residual at which noise ends.
    pub calibration: Vec<String>,
    /// What the values suggest doing before a method sees them, in words.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub suggests: Vec<String>,
}

/// One kind of fault.
#[derive(Debug, Clone, Serialize)]
pub struct FaultFacts {
    /// What it is.
    #[serde(skip)]
    kind: FaultKind,
    /// Its name.
    pub what: &'static str,
    /// How many.
    pub count: usize,
    /// The first few: line and text.
    pub first: Vec<(u64, String)>,
}

impl FaultFacts {
    /// What it is and where: `repeated times (line 3: 0.5, …)`.
    fn places(&self) -> String {
        let first: Vec<String> =
            self.first.iter().map(|(line, text)| format!("line {line}: {}", printable(text))).collect();
        let more = if self.count > self.first.len() { ", …" } else { "" };
        format!("{} ({}{more})", self.kind.words(self.count), first.join(", "))
    }

    /// How many of what, and where.
    pub(super) fn text(&self) -> String {
        format!("{} {}", self.count, self.places())
    }
}

impl Inspection {
    /// The facts of `track`.
    #[must_use]
    pub fn of(track: &Track) -> Self {
        let usable: Vec<f64> = track.time.seconds.iter().copied().filter(|t| t.is_finite()).collect();
        // In a table of several tracks times may start again.
        let ends = usable.iter().copied().reduce(f64::min).zip(usable.iter().copied().reduce(f64::max));
        Self {
            file: track.source.path().map_or_else(|| track.source.name(), |p| p.display().to_string()),
            sha256: track.sha256.clone(),
            layout: layout(track),
            table: TableFacts::of(track),
            rows: track.rows,
            columns: track
                .columns
                .iter()
                .enumerate()
                .map(|(i, c)| ColumnFacts {
                    number: i + 1,
                    name: c.name.clone(),
                    kind: c.kind.word(),
                    unit: c.unit.clone(),
                    missing: c.missing,
                    why: match c.kind {
                        ColumnKind::Aside(aside) => Some(aside.why()),
                        _ => None,
                    },
                })
                .collect(),
            time: track.time.name.clone(),
            time_format: track.time.format.words(),
            time_facts: TimeFacts::of(track),
            track: name_of(track, ColumnKind::Track),
            truth: name_of(track, ColumnKind::Truth),
            time_range: ends.map(|(a, b)| (track.time.full_label(a), track.time.full_label(b))),
            duration_s: ends.map(|(a, b)| b - a),
            channels: track.channels.iter().map(|c| channel_facts(track, c)).collect(),
            faults: fault_facts(&track.faults),
            notes: track.notes.clone(),
        }
    }

    /// A page for people.
    #[must_use]
    pub fn text(&self) -> String {
        let mut out = String::new();
        let _ = writeln!(out, "file      {}", printable(&self.file));
        let _ = writeln!(out, "layout    {}", self.layout);
        let _ = writeln!(out, "rows      {}", self.rows);
        let range = self.time_range.as_ref().map_or("no usable time".to_owned(), |(a, b)| format!("{a} … {b}"));
        let duration = self.duration_s.map_or(String::new(), |d| format!(", {} s", short(d)));
        let _ = writeln!(out, "time      {} ({}): {range}{duration}", printable(&self.time), self.time_words());
        self.columns_text(&mut out);
        self.channels_text(&mut out);
        for channel in &self.channels {
            let words = channel.calibration.join("; ");
            let _ = writeln!(out, "  {}: {}", printable(&channel.name), printable(&words));
        }
        for channel in &self.channels {
            for words in &channel.suggests {
                let _ = writeln!(out, "  note: {} {}", printable(&channel.name), printable(words));
            }
        }
        if self.faults.is_empty() {
            let _ = writeln!(out, "\nbad rows  none");
        } else {
            let _ = writeln!(out, "\nbad rows");
        }
        for fault in &self.faults {
            let _ = writeln!(out, "  {:>8} {}", fault.count, fault.places());
        }
        self.notes.iter().for_each(|note| {
            let _ = writeln!(out, "  note: {}", printable(note));
        });
        out
    }

    /// How times are written, and that nothing tells their zone where it is so.
    pub(super) fn time_words(&self) -> String {
        let zone = if self.time_facts.zone_stated { "" } else { ", zone not stated" };
        format!("{}{zone}", self.time_format)
    }

    fn columns_text(&self, out: &mut String) {
        let width = self.columns.iter().map(|c| printable(&c.name).chars().count()).max().unwrap_or(0).clamp(6, 32);
        let _ = writeln!(out, "\n  {:>3}  {:width$}  {:8}  {:10}  {:>8}", "#", "column", "kind", "unit", "missing");
        for c in &self.columns {
            let (name, unit) = (printable(&c.name), printable(&c.unit));
            let why = c.why.map_or(String::new(), |why| format!("  not a channel: {why}"));
            let _ = writeln!(out, "  {:>3}  {name:width$}  {:8}  {unit:10}  {:>8}{why}", c.number, c.kind, c.missing);
        }
    }

    fn channels_text(&self, out: &mut String) {
        let width = self.channels.iter().map(|c| printable(&c.name).chars().count()).max().unwrap_or(0).clamp(7, 32);
        let _ = writeln!(
            out,
            "\n  {:width$}  {:>9} {:>8} {:>10} {:>8} {:>8}  {:>10} {:>10}  {:>23}",
            "channel", "present", "missing", "interval/s", "lost", "segments", "noise diff", "spline", "range"
        );
        for c in &self.channels {
            let number = |x: Option<f64>| x.map_or_else(|| "-".to_owned(), short);
            let range = c.range.map_or_else(|| "-".to_owned(), |(a, b)| format!("{} … {}", short(a), short(b)));
            let _ = writeln!(
                out,
                "  {:width$}  {:>9} {:>8} {:>10} {:>8} {:>8}  {:>10} {:>10}  {range:>23}",
                printable(&c.name),
                c.present,
                c.missing,
                number(c.interval_s),
                c.lost,
                c.segments,
                number(c.noise_difference),
                number(c.noise_spline),
            );
        }
    }
}

/// The name of the column of a kind.
fn name_of(track: &Track, kind: ColumnKind) -> Option<String> {
    track.columns.iter().find(|c| c.kind == kind).map(|c| c.name.clone())
}

/// Six significant digits, without an exponent where that is readable.
pub(crate) fn short(x: f64) -> String {
    let size = x.abs();
    if size != 0.0 && !(1e-4..1e9).contains(&size) {
        return format!("{x:.4e}");
    }
    let digits = if size >= 1.0 { 5_i32.saturating_sub(magnitude(size)) } else { 6 };
    let text = format!("{x:.*}", usize::try_from(digits.max(0)).unwrap_or(0));
    let text = if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.').to_owned() } else { text };
    without_signed_zero(text)
}

fn magnitude(x: f64) -> i32 {
    #[expect(clippy::cast_possible_truncation, reason = "the logarithm of a double is small")]
    let magnitude = x.log10().floor() as i32;
    magnitude
}

/// Samples that are calibrated at most: facts of a large file shall not take minutes.
const CALIBRATED: usize = 100_000;

/// What a calibration of the channel says, in words, of what a method sees of it under `preparation`; of a long one, of its
/// first samples.
fn calibrated(series: &Series<'_>, preparation: &Preparation, unit: &str) -> Vec<String> {
    let n = series.len().min(CALIBRATED);
    let head = Series::new(&series.t[..n], &series.y[..n]);
    let found = Input::from(&head).calibrated(preparation, &Stop::never());
    let mut words = found.map(|found| found.words(unit)).unwrap_or_default();
    if n < series.len() {
        words.push(format!("by the first {n} samples"));
    }
    words
}

fn channel_facts(track: &Track, channel: &crate::track::Channel) -> ChannelFacts {
    let series = channel.series(&track.time);
    let max_gap = match MAX_GAP.default {
        Value::Whole(n) => usize::try_from(n).ok(),
        _ => None,
    };
    let segments = series.segments(max_gap);
    let longest = segments.iter().enumerate().max_by_key(|(_, s)| s.len()).map(|(i, _)| i);
    let stop = Stop::never();
    let of_longest = |all: Result<Vec<f64>, Stopped>| all.ok()?.get(longest?).copied().filter(|s| s.is_finite());
    let low = series.y.iter().copied().reduce(f64::min);
    let suggested = suggestions(channel);
    ChannelFacts {
        name: channel.name.clone(),
        unit: channel.unit.clone(),
        present: series.len(),
        missing: channel.rows(track) - series.len(),
        interval_s: Some(series.interval).filter(|t| t.is_finite()),
        lost: (1..series.len()).map(|i| series.lost_before(i)).fold(0, usize::saturating_add),
        segments: segments.len(),
        range: low.zip(series.y.iter().copied().reduce(f64::max)),
        noise_difference: of_longest(noise::by_difference(&series, &segments, &stop)),
        noise_spline: of_longest(noise::by_spline(&series, &segments, &stop)),
        calibration: calibrated(&series, &Preparation::certain(suggested.clone()), &channel.unit),
        suggests: suggested.into_iter().map(in_words).collect(),
    }
}

/// A suggestion with what is done about it.
fn in_words(suggestion: Suggestion) -> String {
    let option = match suggestion.remedy {
        Remedy::Check(check) => format!("--check {check}"),
        Remedy::Period(period) => format!("--period {period:?}"),
    };
    let done = if suggestion.certain { "done by itself" } else { "not done by itself" };
    format!("{} ({done}: {option})", suggestion.words)
}

/// What of a record could not be used, with the first lines, and what the loader remarked.
pub(super) fn remarks(track: &Track) -> Vec<String> {
    fault_facts(&track.faults).iter().map(FaultFacts::text).chain(track.notes.iter().cloned()).collect()
}

fn fault_facts(faults: &Faults) -> Vec<FaultFacts> {
    faults
        .kinds()
        .map(|(kind, f)| FaultFacts { kind, what: kind.name, count: f.count, first: f.first.clone() })
        .collect()
}

/// How the text of a record is laid out, in words.
#[must_use]
pub fn layout(track: &Track) -> String {
    let d = &track.dialect;
    let delimiter = understood::delimiter(d.delimiter);
    let encoding = match d.encoding {
        Encoding::Utf8 { bom: false } => "UTF-8",
        Encoding::Utf8 { bom: true } => "UTF-8 with byte order mark",
        Encoding::Utf16 { .. } => "UTF-16",
        Encoding::Latin1 => "Windows-1252",
    };
    if let Some(packing) = d.packing.filter(|packing| packing.is_columnar()) {
        return format!("columns of {}", packing.name);
    }
    if let Some(view) = &d.view {
        let packed = d.packing.map_or(String::new(), |packing| format!(", {}", packing.name));
        return format!("records of {}, {encoding}{packed}", view.format.name);
    }
    let mut words = vec![format!("cells between {delimiter}"), encoding.to_owned()];
    if d.preamble > 1 + usize::from(d.units_row) {
        words.push(format!(
            "{} lines of text above the rows",
            d.preamble - usize::from(d.header) - usize::from(d.units_row)
        ));
    }
    words.push(if d.header { "header" } else { "no header" }.to_owned());
    for (yes, word) in [(d.units_row, "units row"), (d.decimal_comma, "decimal comma")] {
        if yes {
            words.push(word.to_owned());
        }
    }
    words.extend(d.packing.map(|packing| packing.name.to_owned()));
    words.join(", ")
}
