//! Edits that can be undone, undo and redo.

use super::super::message::Effect;
use super::super::model::{Model, Tone, Touched};
use super::{navigate, tune};
use crate::review::Change;
use crate::session::Edit;

/// Makes an edit that can be undone; the channel is judged again.
pub(super) fn commit(model: &mut Model, edit: Edit) -> Vec<Effect> {
    model.session.apply(&edit);
    let effects = changed(model, &edit);
    if !join(model, &edit) {
        model.history.push(edit);
    }
    effects
}

/// Joins a step of a knob to the steps of the same knob just before it, so that one undo takes them all back.
fn join(model: &mut Model, edit: &Edit) -> bool {
    let (Some(Edit::Setup { plan, before, after }), Edit::Setup { plan: now, before: middle, after: last }) =
        (model.history.last_mut(), edit)
    else {
        return false;
    };
    let same = *plan == *now && after == middle && tune::knob_between(before, after).is_some();
    if same && tune::knob_between(before, after) == tune::knob_between(middle, last) {
        after.clone_from(last);
        return true;
    }
    false
}

/// The session has changed: it is not saved, and its result is not the one on the screen.
fn changed(model: &mut Model, edit: &Edit) -> Vec<Effect> {
    let (plan, rows) = match edit {
        Edit::Decide { plan, changes } => (*plan, changes.iter().map(|c| c.row).collect()),
        Edit::Setup { plan, .. } => (*plan, Vec::new()),
    };
    model.unjournalled.push(Touched { plan, rows });
    model.revision += 1;
    let state = &mut model.channels[plan];
    state.touched = true;
    state.stale = true;
    state.error = None;
    vec![Effect::Analyse(plan)]
}

pub(super) fn undo(model: &mut Model) -> Vec<Effect> {
    let Some(edit) = model.history.undo() else {
        model.say(Tone::Warning, "nothing to undo");
        return Vec::new();
    };
    model.session.revert(&edit);
    after_history(model, &edit, "undone", "U redo")
}

pub(super) fn redo(model: &mut Model) -> Vec<Effect> {
    let Some(edit) = model.history.redo() else {
        model.say(Tone::Warning, "nothing to redo");
        return Vec::new();
    };
    model.session.apply(&edit);
    after_history(model, &edit, "done again", "u undo")
}

fn after_history(model: &mut Model, edit: &Edit, verb: &str, way_back: &str) -> Vec<Effect> {
    let (Edit::Decide { plan, .. } | Edit::Setup { plan, .. }) = edit;
    model.shown = *plan;
    if let Edit::Decide { changes, .. } = edit
        && let Some(first) = changes.first()
        && let Some(position) = model.series().position(first.row as usize)
    {
        navigate::go_to(model, position);
    }
    let text = format!("{verb}: {} · {way_back}", describe(model, edit));
    model.say(Tone::Done, text);
    changed(model, edit)
}

/// An edit in few words.
fn describe(model: &Model, edit: &Edit) -> String {
    match edit {
        Edit::Decide { changes, .. } => match changes.as_slice() {
            [Change { row, after, .. }] => {
                let what = after.as_ref().map_or("decision taken back", |d| d.ruling.verdict().word());
                format!("row {} {what}", row + 1)
            }
            several => format!("decisions on {} samples", several.len()),
        },
        Edit::Setup { before, after, .. } => {
            let _ = model;
            match tune::knob_between(before, after) {
                Some((name, from, to)) => format!("{name} {from} → {to}"),
                None => format!("{} → {}", before.method.about().id, after.method.about().id),
            }
        }
    }
}
