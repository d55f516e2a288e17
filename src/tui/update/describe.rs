//! Edits in few words: for the footer, and for the journal panel.

use super::super::model::Model;
use super::{checks, tune};
use crate::review::Change;
use crate::session::{Edit, Setup};
use crate::track::printable;

/// An edit in few words.
pub(in crate::tui) fn edit(model: &Model, edit: &Edit) -> String {
    let parts = edit.parts();
    let text = match parts.as_slice() {
        [Edit::Decide { changes, .. }] => decisions(changes),
        [Edit::Setup { before, after, .. }] => setup(before, after),
        several => return format!("{} in {} channels", together(several), several.len()),
    };
    match edit.touched().first() {
        // Which channel it was, where it is not the one that everything is about.
        Some((plan, _)) if *plan != model.shown => {
            let name = model.session.plans.get(*plan).map(|p| printable(&p.channel)).unwrap_or_default();
            format!("{text} · {name}")
        }
        _ => text,
    }
}

/// What the parts of an edit have in common.
fn together(parts: &[&Edit]) -> String {
    let mut texts = parts.iter().map(|part| match part {
        Edit::Decide { changes, .. } => decisions(changes),
        Edit::Setup { after, .. } => format!("settings of {}", after.method.about().id),
        Edit::Several(_) => String::new(),
    });
    let first = texts.next().unwrap_or_default();
    if texts.all(|text| text == first) { first } else { "several changes".into() }
}

fn decisions(changes: &[Change]) -> String {
    let word = |change: &Change| match (&change.before, &change.after) {
        (_, None) => "decision cleared",
        (Some(before), Some(after)) if before.ruling == after.ruling => "note",
        (_, Some(after)) => after.ruling.verdict().word(),
    };
    match changes {
        [] => "nothing".into(),
        [change] => {
            let row = change.row + 1;
            let note = change.after.as_ref().map(|d| printable(&d.note)).filter(|n| !n.is_empty());
            format!("row {row} {}{}", word(change), note.map_or(String::new(), |note| format!(": {note}")))
        }
        [first, .., last] => {
            let n = changes.len();
            let rows = format!("rows {} to {}", first.row + 1, last.row + 1);
            if changes.iter().all(|c| word(c) == word(first)) {
                format!("{n} samples {}, {rows}", word(first))
            } else {
                format!("decisions on {n} samples, {rows}")
            }
        }
    }
}

fn setup(before: &Setup, after: &Setup) -> String {
    let (from, to) = (before.method.about().id, after.method.about().id);
    match tune::knob_between(before, after) {
        Some((name, from, to)) => format!("{name} {from} → {to}"),
        None if from != to => format!("{from} → {to}"),
        None if before.rate != after.rate => {
            let name = |rate: &Option<String>| rate.as_deref().map_or_else(|| "none".into(), printable);
            format!("rate {} → {}", name(&before.rate), name(&after.rate))
        }
        None if before.preparation != after.preparation => checks::describe(&before.preparation, &after.preparation),
        None => format!("settings of {to}"),
    }
}
