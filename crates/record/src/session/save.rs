//! Saving: the texts of the decided cells are read from the input once more, so that the session can be verified.

use std::collections::BTreeMap;
use std::path::Path;

use super::{Analysed, Session, render};
use crate::error::Result;
use crate::track::{Lost, RowChecks, Track, for_each_row, number_text};

/// The text of the session file at `path` for `session` on `track`, with the result of `analysed` recorded in it.
///
/// # Errors
/// When the input cannot be read again, or is no longer the one that was loaded, and [`crate::error::Error::Input`] for a
/// record whose name no text can hold.
pub fn document(session: &mut Session, track: &Track, analysed: &Analysed, path: &Path) -> Result<String> {
    covers(session, track, None);
    session.data.row_check = Some(RowChecks::of(track)?.to_string());
    session.result = Some(analysed.recorded(session, track)?);
    let texts = texts(session, track)?;
    render(session, path, &texts)
}

/// The same when the record can no longer be read: the decisions have times and values as the program knows them, and no
/// result is recorded.
///
/// # Errors
/// [`crate::error::Error::Input`] for a record whose name no text can hold.
pub fn document_without_record(session: &mut Session, track: &Track, lost: Lost, path: &Path) -> Result<String> {
    covers(session, track, Some(lost));
    session.result = None;
    let of_plan = |plan: &super::Plan| {
        let known = |(row, _): (u32, _)| known(track, &plan.channel, row as usize);
        plan.decisions.iter().map(known).collect::<Vec<_>>()
    };
    let texts: Vec<_> = session.plans.iter().map(of_plan).collect();
    render(session, path, &texts)
}

/// Says which rows the session is about.
fn covers(session: &mut Session, track: &Track, lost: Option<Lost>) {
    let data = &mut session.data;
    data.sha256.clone_from(&track.sha256);
    (data.bytes, data.rows, data.record_was) = (Some(track.bytes), track.rows, lost);
}

/// Time and value of a row (from 0) as the program knows them: equal texts mean equal numbers.
pub(super) fn known(track: &Track, channel: &str, row: usize) -> (String, String) {
    let seconds = track.time.seconds.get(row).copied().filter(|_| track.time.column.is_some());
    let value = track.channel(channel).map(|c| c.value(row)).filter(|v| v.is_finite());
    (seconds.map(|s| track.time.exact_label(s)).unwrap_or_default(), value.map(number_text).unwrap_or_default())
}

/// For each plan, time and value of each decided row as the file has them.
fn texts(session: &Session, track: &Track) -> Result<Vec<Vec<(String, String)>>> {
    let mut wanted: BTreeMap<usize, Vec<usize>> = BTreeMap::new();
    for (index, plan) in session.plans.iter().enumerate() {
        plan.decisions.iter().for_each(|(row, _)| wanted.entry(row as usize).or_default().push(index));
    }
    let mut texts = vec![Vec::new(); session.plans.len()];
    if wanted.is_empty() {
        return Ok(texts);
    }
    let column = |plan: usize| track.channel(&session.plans[plan].channel).map(|c| c.column).unwrap_or_default();
    for_each_row(track, |row, cells| {
        for &plan in wanted.get(&row).into_iter().flatten() {
            let time = track.time.column.map(|c| cells.text(c).into_owned()).unwrap_or_default();
            texts[plan].push((time, cells.text(column(plan)).into_owned()));
        }
        Ok(())
    })?;
    Ok(texts)
}

#[cfg(test)]
mod tests;
