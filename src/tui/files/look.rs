//! What a file is, found by looking at its beginning.

use std::path::{Path, PathBuf};

use super::super::words::counted;
use super::is_session;
use crate::error::Result;
use crate::session;
use crate::stop::Stop;
use crate::track::{Clocks, ColumnKind, LoadOptions, Preview, RowsAt, Source, Track, Wanted, printable};

/// How much of a record is read.
const MOST: u64 = 1 << 20;

/// A look to take.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Glance {
    /// At what.
    pub source: Source,
    /// How a record is to be loaded.
    pub options: LoadOptions,
}

/// What was seen, as text that is safe to be shown.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct Seen {
    /// What it is, line by line.
    pub lines: Vec<String>,
    /// What deserves a second look: faults and notes.
    pub warnings: Vec<String>,
    /// Names of the columns as an option takes them; none for a session.
    pub columns: Vec<String>,
    /// The first rows: a head of names, one of what the columns are, then cells.
    pub table: Vec<Vec<String>>,
    /// Where the rows of a record stand.
    pub rows_at: Option<RowsAt>,
}

impl Glance {
    /// At a file, with everything recognised.
    #[must_use]
    pub fn file(path: PathBuf) -> Self {
        Self { source: Source::File(path), options: LoadOptions::default() }
    }

    /// Takes the look.
    ///
    /// # Errors
    /// [`crate::error::Error::Stopped`]; what keeps the file from being opened.
    pub fn look(&self, stop: &Stop) -> Result<Seen> {
        stop.check()?;
        let still = || !stop.requested();
        let wanted = Wanted::as_long_as(&still);
        match &self.source {
            Source::File(path) if path.is_dir() => Ok(Seen { lines: vec!["a folder".into()], ..Seen::default() }),
            Source::File(path) if is_session(path) => of_session(path),
            Source::File(path) => Ok(of_record(&Preview::of(path, &self.options, MOST, wanted)?)),
            Source::BuiltIn { bytes, .. } => {
                Ok(of_record(&Preview::of_bytes(bytes, &self.options, bytes.len() as u64, 1.0, wanted)?))
            }
            Source::Input(_) => Ok(Seen { lines: vec![self.source.name()], ..Seen::default() }),
        }
    }
}

fn of_session(path: &Path) -> Result<Seen> {
    let session = session::read(path)?;
    let record = match &session.data.source {
        Source::File(record) => record.display().to_string(),
        other => other.name(),
    };
    let mut lines = vec![format!("session on {}", printable(&record)), counted(session.data.rows, "row")];
    for plan in &session.plans {
        let decided = match plan.decisions.len() {
            0 => String::new(),
            n => format!(", {}", counted(n, "decision")),
        };
        lines.push(format!("{}: {}{decided}", printable(&plan.channel), plan.setup.method.about().id));
    }
    lines.extend(session.result.as_ref().map(|r| format!("{} flagged when it was saved", r.flagged)));
    let gone = matches!(&session.data.source, Source::File(record) if !record.exists());
    let warnings = if gone { vec!["its record is not there".into()] } else { Vec::new() };
    Ok(Seen { lines, warnings, ..Seen::default() })
}

fn of_record(preview: &Preview) -> Seen {
    let track = &preview.track;
    let (rows, estimated) = preview.rows();
    let rows =
        if estimated { format!("about {} rows (its beginning was read)", rounded(rows)) } else { counted(rows, "row") };
    let mut lines = vec![format!("{rows}, {}", counted(track.columns.len(), "column"))];
    lines.push(crate::report::layout(track));
    let usable: Vec<f64> = track.time.seconds.iter().copied().filter(|t| t.is_finite()).collect();
    let from = usable.first().map_or("none is usable".into(), |t| format!("from {}", track.time.full_label(*t)));
    let zone = if track.time.clocks == Clocks::Unstated { ", zone not stated" } else { "" };
    lines.push(format!("time {} ({}{zone}), {from}", printable(&track.time.name), track.time.format.words()));
    lines.extend(track.channels.first().map(|channel| steps(track, channel)));
    let names: Vec<String> = track.channels.iter().map(with_unit).collect();
    lines.push(format!("channels: {}", names.join(", ")));
    let truth: Vec<String> =
        track.columns.iter().filter(|c| c.kind == ColumnKind::Truth).map(|c| printable(&c.name)).collect();
    if !truth.is_empty() {
        lines.push(format!("truth: {}", truth.join(", ")));
    }
    let mut warnings = faults(track);
    warnings.extend(track.notes.iter().map(|note| printable(note)));
    let mut table = vec![
        track.columns.iter().map(|c| printable(&c.name)).collect::<Vec<_>>(),
        track.columns.iter().map(|c| c.kind.word().to_owned()).collect(),
    ];
    table.extend(preview.first.iter().map(|row| row.iter().map(|cell| printable(cell)).collect()));
    Seen {
        lines,
        warnings,
        columns: track.columns.iter().map(|c| c.name.clone()).collect(),
        table,
        rows_at: Some(track.dialect.rows.clone()),
    }
}

fn with_unit(channel: &crate::track::Channel) -> String {
    let name = printable(&channel.name);
    let unit = printable(channel.unit_beside_name());
    if unit.is_empty() { name } else { format!("{name} [{unit}]") }
}

fn steps(track: &Track, channel: &crate::track::Channel) -> String {
    let series = channel.series(&track.time);
    let lost = (1..series.len()).map(|i| series.lost_before(i)).fold(0, usize::saturating_add);
    let interval = if series.interval.is_finite() {
        format!("step {} s", crate::report::short(series.interval))
    } else {
        "no step".into()
    };
    format!("{interval}, {} of {} samples there, {lost} lost between", series.len(), track.rows)
}

pub(in crate::tui) fn faults(track: &Track) -> Vec<String> {
    let shown = track.faults.kinds().map(|(kind, fault)| {
        let first =
            fault.first.first().map_or(String::new(), |(line, text)| format!(" (line {line}: {})", printable(text)));
        format!("{} {}{first}", fault.count, kind.words(fault.count))
    });
    shown.collect()
}

/// Two leading digits: more would claim what an estimate does not know.
fn rounded(n: usize) -> usize {
    let digits = n.max(1).ilog10().saturating_sub(1);
    let unit = 10_usize.pow(digits);
    (n + unit / 2) / unit * unit
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_record_is_described_as_the_loader_understands_it() {
        let text = b"t_s,alt (m),who\n0,1.5,a\n1,2.5,b\n1,9,c\n4,x,d\n5,3,e\n";
        let source = Source::BuiltIn { name: "test", bytes: text[..].into() };
        let seen = Glance { source, options: LoadOptions::default() }.look(&Stop::never()).unwrap();
        assert_eq!(seen.lines[0], "5 rows, 3 columns");
        assert!(seen.lines[2].starts_with("time t_s (seconds), from 0"), "{:?}", seen.lines);
        assert!(seen.lines.iter().any(|l| l == "channels: alt (m)"), "{:?}", seen.lines);
        assert!(seen.warnings.iter().any(|w| w.starts_with("1 repeated time (line 4")), "{:?}", seen.warnings);
        assert_eq!(seen.table[1], ["time", "number", "text"]);
        assert_eq!(seen.table[2], ["0", "1.5", "a"]);
    }

    #[test]
    fn estimates_have_two_digits() {
        assert_eq!([7, 42, 123, 1_949_999].map(rounded), [7, 42, 120, 1_900_000]);
    }
}
