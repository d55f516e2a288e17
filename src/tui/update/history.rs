//! Edits of the document: made, undone, redone.

use super::super::action::Action;
use super::super::message::Effect;
use super::super::model::{Model, Tone};
use super::{describe, journal, navigate, tune};
use crate::session::{Edit, Setup};

pub(super) fn act(model: &mut Model, action: Action) -> Option<Vec<Effect>> {
    match action {
        Action::Undo => Some(undo(model)),
        Action::Redo => Some(redo(model)),
        Action::Journal => Some(journal::open(model)),
        _ => None,
    }
}

/// Makes an edit that can be undone; the channels it is about are judged again.
pub(super) fn commit(model: &mut Model, edit: Edit) -> Vec<Effect> {
    let alike = alike(model, &edit);
    model.session.apply(&edit);
    let effects = changed(model, &edit, &alike);
    if !join(model, &edit) {
        model.history.push(edit);
    }
    effects
}

/// Joins a step of a parameter to the steps of the same parameter just before it, so that one undo takes them all back.
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

/// Other channels that are judged together with those whose setup changes, under what it was or what it is: what
/// they belong with changes, and so does their result.
fn alike(model: &Model, edit: &Edit) -> Vec<usize> {
    let mut found = Vec::new();
    for part in edit.parts() {
        let Edit::Setup { before, after, .. } = part else { continue };
        for setup in [before, after].into_iter().filter(|s| s.together()) {
            let same = |(_, plan): &(usize, &crate::session::Plan)| plan.setup.same_method(setup);
            found.extend(model.session.plans.iter().enumerate().filter(same).map(|(i, _)| i));
        }
    }
    found
}

/// The session has changed: it is not saved, and its result is not the one on the screen.
fn changed(model: &mut Model, edit: &Edit, alike: &[usize]) -> Vec<Effect> {
    let touched = edit.touched();
    for (plan, _) in &touched {
        model.channels[*plan].touched = true;
    }
    for plan in touched.iter().map(|(plan, _)| *plan).chain(alike.iter().copied()) {
        let state = &mut model.channels[plan];
        (state.stale, state.summary_stale, state.error) = (true, true, None);
    }
    model.unjournalled.push(touched);
    model.revision += 1;
    // The others are judged when they are shown.
    if model.state().stale { vec![Effect::Analyse(model.shown)] } else { Vec::new() }
}

/// Changes method, settings or repair of the channel on the screen.
pub(super) fn set_up(model: &mut Model, after: Setup) -> Vec<Effect> {
    let before = model.plan().setup.clone();
    if before == after {
        return Vec::new();
    }
    let plan = model.shown;
    commit(model, Edit::Setup { plan, before: Box::new(before), after: Box::new(after) })
}

pub(super) fn undo(model: &mut Model) -> Vec<Effect> {
    let Some(edit) = step(model, false) else {
        model.say(Tone::Warning, "nothing to undo");
        return Vec::new();
    };
    let back = format!("{} redo", model.key(Action::Redo));
    say(model, &edit, "undone", &back)
}

pub(super) fn redo(model: &mut Model) -> Vec<Effect> {
    let Some(edit) = step(model, true) else {
        model.say(Tone::Warning, "nothing to redo");
        return Vec::new();
    };
    let back = format!("{} undo", model.key(Action::Undo));
    say(model, &edit, "done again", &back)
}

/// Undoes or redoes until this many edits are in force.
pub(super) fn go_back_to(model: &mut Model, edits: usize) -> Vec<Effect> {
    let from = model.history.len();
    let forth = edits > from;
    let mut last = None;
    while model.history.len() != edits {
        let Some(edit) = step(model, forth) else { break };
        last = Some(edit);
    }
    let Some(edit) = last else {
        model.say(Tone::Done, "this is where the session is");
        return Vec::new();
    };
    let effects = say(model, &edit, "", "");
    let steps = model.history.len().abs_diff(from);
    let (verb, way, back) = if forth { ("done again", Action::Undo, "undo") } else { ("undone", Action::Redo, "redo") };
    let (key, journal) = (model.key(way), model.key(Action::Journal));
    model.say(Tone::Done, format!("{steps} {verb} · {key} {back} one by one · {journal} journal"));
    effects
}

/// Takes the last edit back or makes the next again.
fn step(model: &mut Model, forth: bool) -> Option<Edit> {
    let edit = if forth { model.history.redo() } else { model.history.undo() }?;
    let mut alike = alike(model, &edit);
    if forth {
        model.session.apply(&edit)
    } else {
        model.session.revert(&edit)
    }
    alike.extend(self::alike(model, &edit));
    // The channel that is shown is judged when it is known which that is.
    let _ = changed(model, &edit, &alike);
    Some(edit)
}

/// Shows where an edit was, and says what it was.
fn say(model: &mut Model, edit: &Edit, verb: &str, way_back: &str) -> Vec<Effect> {
    let touched = edit.touched();
    // What was done to all channels at once is shown where the user is.
    if let (Some((plan, _)), false) = (touched.first(), matches!(edit, Edit::Several(_))) {
        super::turn_to(model, *plan);
    }
    let here = touched.iter().find(|(plan, _)| *plan == model.shown);
    let position = here.and_then(|(_, rows)| model.series().position(*rows.first()? as usize));
    if let Some(position) = position {
        navigate::go_to(model, position);
    }
    let text = format!("{verb}: {} · {way_back}", describe::edit(model, edit));
    model.say(Tone::Done, text);
    if model.state().stale { vec![Effect::Analyse(model.shown)] } else { Vec::new() }
}
