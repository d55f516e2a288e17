//! The tables of flags and decisions, with their evidence.

use super::super::inspection::short;
use super::Table;
use crate::error::Result;
use crate::session::flags::{Evidence, InRun, evidence};
use crate::session::table::{time_text, walk};
use crate::session::{Analysed, Session};
use crate::track::{Track, number_text};

/// Rows of a table at most.
const MOST: usize = 200;

/// A table, and what it leaves out in words; empty when it has all.
pub(super) type Flagged = (Table, String);

/// One table for each channel: outliers, suspects and decisions by row.
///
/// # Errors
/// When the input cannot be read again, or is no longer the one that was loaded.
pub(super) fn tables(track: &Track, session: &Session, analysed: &Analysed) -> Result<Vec<Flagged>> {
    let mut tables: Vec<Table> =
        session.plans.iter().map(|_| Table { head: HEAD.to_vec(), ..Table::default() }).collect();
    let mut rest = vec![(0_usize, 0_usize); session.plans.len()];
    walk(track, session, analysed, |row, cells, channel| {
        let Some(position) = channel.position(row) else { return Ok(()) };
        // Samples that could not be judged are counted, not listed.
        if channel.outcome.mark(position).is_none() {
            return Ok(());
        }
        let Some(found) = evidence(session, channel, row, position) else { return Ok(()) };
        let plan = channel.plan;
        if tables[plan].rows.len() < MOST {
            tables[plan].marks.push(found.mark.as_ref().and_then(crate::plot::state));
            tables[plan].rows.push(cells_of(&found, time_text(track, row, cells)));
        } else {
            rest[plan].0 += 1;
            rest[plan].1 += usize::from(found.decided);
        }
        Ok(())
    })?;
    Ok(tables.into_iter().zip(rest).map(|(table, rest)| (table, in_words(rest))).collect())
}

const HEAD: [(&str, bool); 12] = [
    ("row", true),
    ("time", true),
    ("raw", true),
    ("verdict", false),
    ("run", false),
    ("expected", true),
    ("tolerance", true),
    ("ratio", true),
    ("forward, backward", false),
    ("clean", true),
    ("decided by", false),
    ("note", false),
];

fn cells_of(e: &Evidence, time: String) -> Vec<String> {
    let run = match e.run {
        None => String::new(),
        Some(InRun { length: 1, .. }) => "isolated".into(),
        Some(InRun { length, place, .. }) => format!("{place} of {length}"),
    };
    let number = |x: Option<f64>| x.map(short).unwrap_or_default();
    let directions = [e.forward, e.backward].map(|d| d.map_or("", crate::method::Direction::word));
    let directions = if directions == ["", ""] { String::new() } else { directions.join(", ") };
    vec![
        e.row.to_string(),
        time,
        number_text(e.raw),
        e.verdict.word().to_owned(),
        run,
        number(e.expected),
        number(e.tolerance),
        e.ratio().map(|r| format!("{r:.2}")).unwrap_or_default(),
        directions,
        match (e.action(), e.clean) {
            ("removed", _) => "removed".into(),
            ("kept", _) => "kept".into(),
            (_, clean) => number(clean),
        },
        match (&e.objected, e.decided) {
            (Some(o), false) => format!("{}: {}", o.by, o.evidence),
            _ => e.decided_by().to_owned(),
        },
        e.note.clone(),
    ]
}

fn in_words((more, decided): (usize, usize)) -> String {
    if more == 0 {
        return String::new();
    }
    let decided = if decided == 0 { String::new() } else { format!(" ({decided} of them decided by the analyst)") };
    let all = MOST + more;
    format!(
        "The first {MOST} of {all} are listed; the other {more}{decided} are in the table that `--flags FILE` writes."
    )
}
