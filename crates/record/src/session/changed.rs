//! The table of changes: what differs between a record and its cleaned file, a row for each cell.

use std::collections::BTreeMap;
use std::io::Write;

use super::table::{CHANNEL, Column, TIME, column, names, time_text, write_row};
use super::{Analysed, Place, Session};
use crate::error::{Error, Result};
use crate::method::Verdict;
use crate::repair::FILL_GAPS;
use crate::track::{Cells, NewRow, Track, cell_text, escape_formula, for_each_row};

/// The columns, in order.
pub const CHANGED_COLUMNS: [Column; 7] = [
    column("row", "number of the data row, from 1; empty for a new row"),
    TIME,
    CHANNEL,
    column("old", "text of the cell in the record"),
    column("new", "text of the cell in the cleaned file; empty when the value was removed"),
    column("verdict", "verdict in effect: `outlier` or `missing`, where filtered values are written any of them"),
    column(
        "by",
        "id of the method or the check that flagged it, `analyst`, `fill_gaps`, or `filtered` for the value of the model",
    ),
];
/// Who fills what is missing: the setting of the repair.
const FILLED_BY: &str = FILL_GAPS.key;
/// Who writes the values of the model.
const FILTERED: &str = "filtered";
/// Who decides.
const ANALYST: &str = "analyst";

/// A cell of the file: its row (from 0) and its column.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
struct At {
    row: usize,
    column: usize,
}

/// Why a cell changes.
#[derive(Debug)]
struct Reason<'a> {
    channel: &'a str,
    verdict: Verdict,
    by: &'a str,
}

/// Writes the changed cells as CSV, with their texts before and after, in the order of the file. A row that the input
/// does not have has no number and stands after the row that it follows.
///
/// # Errors
/// When the input cannot be read again, or is no longer the one that was loaded, or the table cannot be written.
pub fn changed(track: &Track, session: &Session, analysed: &Analysed, out: &mut dyn Write) -> Result<()> {
    let changes = analysed.changes(track);
    let reasons = reasons(track, session, analysed);
    let mut writer = csv::Writer::from_writer(out);
    write_row(&mut writer, &names(&CHANGED_COLUMNS))?;
    let (mut cells, mut rows) = (changes.cells.as_slice(), changes.rows.as_slice());
    for_each_row(track, |row, texts| {
        let mine = cells.iter().take_while(|c| c.row as usize == row).count();
        let (now, later) = cells.split_at(mine);
        cells = later;
        for change in now {
            let Some(reason) = reasons.get(&At { row, column: change.column }) else { continue };
            let old = texts.text(change.column);
            let new = cell_text(track, change.column, &old, change.value);
            let (number, time) = ((row + 1).to_string(), time_text(track, row, texts));
            let (old, new) = (escape_formula(&old), escape_formula(&new));
            let name = escape_formula(reason.channel);
            write_row(&mut writer, &[&number, &time, &name, &old, &new, reason.verdict.word(), reason.by])?;
        }
        let mine = rows.iter().take_while(|r| r.after_row as usize == row).count();
        let (now, later) = rows.split_at(mine);
        rows = later;
        now.iter().try_for_each(|new| added(track, texts, new, &mut writer))
    })?;
    writer.flush().map_err(Error::io("write", "the changes"))
}

/// Writes the cells of a row that the input does not have, which follows `row`.
fn added(track: &Track, texts: &Cells<'_>, new: &NewRow, writer: &mut csv::Writer<&mut dyn Write>) -> Result<()> {
    let time = match track.time.column {
        Some(column) => track.time.write_like(new.seconds, &texts.text(column)),
        None => String::new(),
    };
    let id = track.track_column().map(|column| texts.text(column));
    for (column, value) in &new.cells {
        let of_row = |name: &str| match &id {
            Some(id) => format!("{name}@{id}"),
            None => name.to_owned(),
        };
        let name = of_row(&track.columns[*column].name);
        let text = cell_text(track, *column, "", Some(*value));
        let fields = [
            "",
            &escape_formula(&time),
            &escape_formula(&name),
            "",
            &escape_formula(&text),
            Verdict::Missing.word(),
            FILLED_BY,
        ];
        write_row(writer, &fields)?;
    }
    Ok(())
}

/// Why each cell changes.
fn reasons<'a>(track: &Track, session: &'a Session, analysed: &'a Analysed) -> BTreeMap<At, Reason<'a>> {
    let mut reasons = BTreeMap::new();
    for (at, (plan, (index, samples, outcome))) in session.plans.iter().zip(&analysed.channels).enumerate() {
        let filtered = analysed.filtered_of(at).map_or(&[][..], |filtered| &filtered.value);
        let channel = &track.channels[*index];
        let series = samples.series(channel, &track.time);
        for &position in &outcome.outliers {
            let row = series.row(position);
            let decided = u32::try_from(row).ok().and_then(|row| plan.decisions.get(row)).is_some();
            let by = if decided { ANALYST } else { outcome.detection.by(position) };
            let reason = Reason { channel: &plan.channel, verdict: Verdict::Outlier, by };
            reasons.insert(At { row, column: channel.column }, reason);
        }
        for (position, _) in filtered.iter().enumerate().filter(|(_, value)| value.is_finite()) {
            let reason = Reason { channel: &plan.channel, verdict: outcome.verdict(position), by: FILTERED };
            reasons.entry(At { row: series.row(position), column: channel.column }).or_insert(reason);
        }
        for fill in &outcome.fills {
            if let Place::Cell(row) = fill.place {
                let reason = Reason { channel: &plan.channel, verdict: Verdict::Missing, by: FILLED_BY };
                reasons.insert(At { row, column: channel.column }, reason);
            }
        }
    }
    reasons
}
