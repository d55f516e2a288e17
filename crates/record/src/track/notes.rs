//! What a user should know before trusting a record, in plain words.

use super::cells::Cells;
use super::feed::Feed;
use super::head::Head;
use super::number::Reading;
use super::{Column, ColumnKind, Fault, TimeFormat, Track, names, printable, rows, timing};
use crate::error::Result;

/// The note for a record in which more than a tenth of the rows lie before an earlier one, from `row` on.
///
/// # Errors
/// What a walk over the rows gives.
pub(crate) fn about_backward_times(track: &Track, text: &mut Feed<'_>, row: usize, backward: &Fault) -> Result<String> {
    let mut before: Vec<String> = Vec::new();
    let mut here: Vec<String> = Vec::new();
    rows::walk_feed(track, text, |r, record, splitter| {
        if r + 1 >= row {
            let cells = Cells {
                record: record.bytes,
                spans: splitter.cells(record),
                quote: track.dialect.quote,
                encoding: track.dialect.encoding,
                line: 0,
            };
            before =
                std::mem::replace(&mut here, (0..track.columns.len()).map(|c| cells.text(c).into_owned()).collect());
        }
        Ok(r < row)
    })?;
    let time = track.time.column.and_then(|c| before.get(c)).map(|t| printable(t)).unwrap_or_default();
    let id = track.columns.iter().enumerate().find(|(c, column)| {
        let named = names::words(&column.name).into_iter().any(names::is_id_word);
        let differs = before.get(*c) != here.get(*c);
        named || (column.kind == ColumnKind::Text && differs)
    });
    let cause = match id {
        _ if track.track_column().is_some() => "or two tracks under one id".into(),
        Some((_, column)) => {
            let name = printable(&column.name);
            format!("or several tracks in one table, told apart by `{name}` (then: --track '{name}')")
        }
        None => "or several tracks in one table".into(),
    };
    Ok(format!(
        "time goes back after row {row} ({time}): {} of {} rows lie before an earlier row and count as missing; \
         perhaps a wild time stamp, {cause}",
        backward.count, track.rows
    ))
}

/// The first column of text of which every cell is a number with a decimal comma (or with commas between thousands).
pub(crate) fn column_of_commas(columns: &[Column], head: &Head) -> Option<usize> {
    let reading = Reading::new(true, &[]);
    let number = |cell: &&str| cell.is_empty() || reading.number(cell.as_bytes()).is_some();
    let all = |c: usize| head.column(c).iter().any(|cell| cell.contains(',')) && head.column(c).iter().all(number);
    if head.reading.decimal_comma {
        None
    } else {
        (0..columns.len()).find(|c| columns[*c].kind == ColumnKind::Text && all(*c))
    }
}

/// What to do about such a column.
pub(crate) fn about_commas(name: &str) -> String {
    format!(
        "`{}` holds numbers with commas: use --decimal-comma, or remove the commas if they separate thousands",
        printable(name)
    )
}

/// A column of words that is named like a time, and its first cell.
fn unread_time<'a>(track: &'a Track, head: &'a Head) -> Option<(&'a str, &'a str)> {
    let named = |(_, c): &(usize, &Column)| c.kind == ColumnKind::Text && names::time_rank(&c.name) >= 3;
    let (column, found) = track.columns.iter().enumerate().find(named)?;
    let cell = head.column(column).into_iter().find(|cell| !cell.is_empty())?;
    Some((&found.name, cell))
}

/// Notes about rows of several kinds, about a time column that cannot be read unless the time was `told`, and about one
/// that has no name.
pub(crate) fn about_shape(track: &Track, head: &Head, told: bool) -> Vec<String> {
    let mut notes = Vec::new();
    let ragged = &track.faults.ragged_rows;
    if ragged.count * 10 > track.rows {
        let (line, cells) = ragged.first.first().cloned().unwrap_or_default();
        notes.push(format!(
            "{} of {} rows have another number of cells than the {} columns (line {line}: {cells}): perhaps rows of \
             several kinds in one table",
            ragged.count,
            track.rows,
            track.columns.len()
        ));
    }
    notes.extend(column_of_commas(&track.columns, head).map(|c| about_commas(&track.columns[c].name)));
    let counted = track.time.format == TimeFormat::SampleNumber;
    if counted && let Some((name, cell)) = unread_time(track, head).filter(|_| !told) {
        notes.push(format!(
            "time is the sample number, since `{}` holds no times that can be read: {}; times are {}",
            printable(name),
            printable(cell),
            timing::TIMES
        ));
    }
    if counted
        && track.columns.len() > 1
        && let Some(first) = track.columns.first().filter(|c| c.kind == ColumnKind::Number)
        && timing::increases(head, 0)
    {
        notes.push(format!(
            "time is the sample number; `{}` increases from row to row: if it is the time, use --time '#1'",
            printable(&first.name)
        ));
    }
    notes
}
