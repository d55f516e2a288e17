//! Saving: the texts of the decided cells are read from the input once more, so that the session can be verified.

use std::collections::BTreeMap;
use std::path::Path;

use super::{Analysed, Session, render};
use crate::error::Result;
use crate::track::{RowChecks, Track, for_each_row};

/// The text of the session file at `path` for `session` on `track`, with the result of `analysed` recorded in it.
///
/// # Errors
/// When the input cannot be read again, or is no longer the one that was loaded, and [`crate::error::Error::Input`] for a
/// record whose name no text can hold.
pub fn document(session: &mut Session, track: &Track, analysed: &Analysed, path: &Path) -> Result<String> {
    session.data.row_check = Some(RowChecks::of(track)?.to_string());
    session.result = Some(analysed.recorded(track)?);
    let texts = texts(session, track)?;
    render(session, path, &texts)
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
