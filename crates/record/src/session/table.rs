//! What the tables of a result share: the walk over rows and channels, and the texts of their cells.

use std::io::Write;

use super::{Analysed, Outcome, Place, Session};
use crate::error::{Error, Result};
use crate::method::{Filtered, Verdict};
use crate::track::{Cells, Channel, Samples, Series, Track, escape_formula, for_each_row};

/// A column of a table: its name in the first line, and what its cells say.
#[derive(Debug, Clone, Copy)]
pub struct Column {
    /// Its name.
    pub name: &'static str,
    /// What its cells say.
    pub about: &'static str,
}

/// A column.
#[must_use]
pub const fn column(name: &'static str, about: &'static str) -> Column {
    Column { name, about }
}

/// The names of columns, as the first line of a table has them.
#[must_use]
pub fn names<const N: usize>(columns: &[Column; N]) -> [&'static str; N] {
    columns.map(|column| column.name)
}

/// The columns that most tables begin with.
pub(super) const ROW: Column = column("row", "number of the data row, from 1");
pub(super) const TIME: Column = column("time", "time of the row, as in the record");
pub(super) const CHANNEL: Column = column("channel", "name of the channel");

/// One channel of a result, walked row by row.
#[derive(Debug)]
pub struct Walk<'a> {
    /// Its present samples.
    pub series: Series<'a>,
    /// Its name.
    pub name: &'a str,
    /// Its result.
    pub outcome: &'a Outcome,
    /// Index of its plan.
    pub plan: usize,
    /// The values that the cleaned file has in place of the measured ones, if it has others.
    filtered: Option<&'a Filtered>,
    track: &'a Track,
    channel: &'a Channel,
    next: usize,
    /// The rows of its target that are still to come, in a table of several tracks.
    own: Option<&'a [u32]>,
}

impl Walk<'_> {
    /// True when `row` is one of the channel's own; rows must be asked for in ascending order, each once.
    fn owns(&mut self, row: usize) -> bool {
        let Some(own) = self.own else { return true };
        match own.split_first() {
            Some((first, rest)) if *first as usize == row => {
                self.own = Some(rest);
                true
            }
            _ => false,
        }
    }

    /// The position of the sample of `row`; rows must be asked for in ascending order.
    pub fn position(&mut self, row: usize) -> Option<usize> {
        let last = self.series.len().checked_sub(1)?;
        // Where the newest row stands first, the samples go backwards through the file.
        let backwards = self.series.row(0) > self.series.row(last);
        let position = if backwards { last.checked_sub(self.next)? } else { self.next };
        (position <= last && self.series.row(position) == row).then(|| {
            self.next += 1;
            position
        })
    }

    /// The value that the cleaned file has for an outcome's sample; none where the cell is empty.
    #[must_use]
    pub fn clean(&self, position: usize) -> Option<f64> {
        let filtered = self.filtered.and_then(|f| f.value.get(position).copied()).filter(|value| value.is_finite());
        let fix = filtered.or_else(|| self.outcome.fix(position));
        let rounded = |v: f64| v.is_finite().then(|| self.track.rounded(self.channel, v));
        fix.map_or(Some(self.series.y[position]), rounded)
    }

    /// A value as the cleaned file would have it.
    #[must_use]
    pub fn rounded(&self, value: f64) -> f64 {
        self.track.rounded(self.channel, value)
    }

    /// The value that fills the missing sample of `row`, if any.
    #[must_use]
    pub fn fill(&self, row: usize) -> Option<f64> {
        let place = Place::Cell(row);
        let at = self.outcome.fills.binary_search_by_key(&place, |f| f.place).ok()?;
        self.outcome.fills.get(at).map(|f| self.track.rounded(self.channel, f.value))
    }

    /// The measured value of a row that is not present (no usable time), if its cell is a number.
    #[must_use]
    pub fn raw(&self, track: &Track, row: usize, position: Option<usize>) -> Option<f64> {
        match position {
            Some(position) => Some(self.series.y[position]),
            None => track.channel(self.name).map(|c| c.value(row)).filter(|v| v.is_finite()),
        }
    }
}

/// The channels of a result, before their first row.
pub(super) fn walks<'a>(track: &'a Track, session: &'a Session, analysed: &'a Analysed) -> Vec<Walk<'a>> {
    let walk = |(plan, (index, samples, outcome)): (usize, &'a (usize, Samples, Outcome))| {
        let channel = &track.channels[*index];
        Walk {
            series: samples.series(channel, &track.time),
            name: &session.plans[plan].channel,
            outcome,
            plan,
            filtered: analysed.filtered_of(plan),
            track,
            channel,
            next: 0,
            own: channel.target.as_ref().map(|t| &*t.rows),
        }
    };
    analysed.channels.iter().enumerate().map(walk).collect()
}

/// Calls `visit` with every row and channel of a result (of several tracks, with each row its own channels), in the order
/// of the file and of the session.
///
/// # Errors
/// When the input cannot be read again, or is no longer the one that was loaded; what `visit` gives.
pub fn walk(
    track: &Track,
    session: &Session,
    analysed: &Analysed,
    mut visit: impl FnMut(usize, &Cells<'_>, &mut Walk<'_>) -> Result<()>,
) -> Result<()> {
    let mut channels = walks(track, session, analysed);
    for_each_row(track, |row, cells| {
        channels.iter_mut().filter_map(|c| c.owns(row).then_some(c)).try_for_each(|channel| visit(row, cells, channel))
    })
}

/// The text of the time of a row, as the file has it (but no formula); the sample number where there is no time column.
#[must_use]
pub fn time_text(track: &Track, row: usize, cells: &Cells<'_>) -> String {
    track.time.column.map_or_else(|| row.to_string(), |c| escape_formula(&cells.text(c)).into_owned())
}

/// A number as the tables have it, empty for none.
#[must_use]
pub fn cell(value: Option<f64>) -> String {
    value.filter(|v| v.is_finite()).map(crate::track::number_text).unwrap_or_default()
}

/// The word for what holds of a sample; that for a missing one without a position.
#[must_use]
pub fn verdict_word(outcome: &Outcome, position: Option<usize>) -> &'static str {
    position.map_or(Verdict::Missing, |p| outcome.verdict(p)).word()
}

fn csv_error(e: csv::Error) -> Error {
    let text = e.to_string();
    let source = match e.into_kind() {
        csv::ErrorKind::Io(source) => source,
        _ => std::io::Error::other(text),
    };
    Error::Io { action: "write", path: "the table".into(), source }
}

/// Writes a row of a table.
///
/// # Errors
/// [`Error::Io`].
pub fn write_row(writer: &mut csv::Writer<&mut dyn Write>, fields: &[&str]) -> Result<()> {
    writer.write_record(fields).map_err(csv_error)
}
