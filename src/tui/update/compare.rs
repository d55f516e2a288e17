//! A against B: a result that is pinned, and the one that goes on changing.

use super::super::action::Action;
use super::super::message::Effect;
use super::super::model::{Model, Pinned, Tone};
use super::{commit, navigate};
use crate::method::Verdict;
use crate::plot::{Drawn, Side, Sides};
use crate::session::Edit;

/// Does an action that is about A and B; none when it is about something else.
pub(super) fn act(model: &mut Model, action: Action) -> Option<Vec<Effect>> {
    match action {
        Action::Pin => pin(model),
        Action::NextDifference => step(model, true),
        Action::PreviousDifference => step(model, false),
        Action::AdoptPinned => return Some(adopt(model)),
        _ => return None,
    }
    Some(Vec::new())
}

/// Positions that the method flags, whatever the analyst decided: decisions are the same for A and B.
fn flagged(drawn: &Drawn) -> Vec<u32> {
    let marks = drawn.outcome.marks.iter();
    marks.filter(|m| m.verdict == Verdict::Outlier).map(|m| m.position).collect()
}

fn pin(model: &mut Model) {
    let [next, back, unpin] = [Action::NextDifference, Action::AdoptPinned, Action::Pin].map(|a| model.key(a));
    let state = model.state_mut();
    if state.pinned.take().is_some() {
        model.say(Tone::Done, "A is no longer pinned; the result on the screen stays");
        return;
    }
    let Some(drawn) = state.drawn.clone() else {
        model.say(Tone::Warning, "there is no result to pin yet");
        return;
    };
    let setup = drawn.outcome.detection.setup.clone();
    let flagged = flagged(&drawn);
    let text = format!(
        "A is {} with {} flagged: go on tuning B · {next} next difference, {back} back to A, {unpin} unpins",
        setup.method.about().id,
        flagged.len()
    );
    state.pinned = Some(Box::new(Pinned { sides: Some(Sides::of(&flagged, &flagged)), setup, flagged }));
    model.say(Tone::Done, text);
}

/// Brings the comparison up to the result that was just taken in.
pub(super) fn refresh(model: &mut Model, plan: usize) {
    let state = &mut model.channels[plan];
    let now = state.drawn.as_deref().map(flagged);
    if let Some(pinned) = &mut state.pinned {
        pinned.sides = now.map(|now| Sides::of(&pinned.flagged, &now));
    }
}

fn step(model: &mut Model, forward: bool) {
    let state = model.state();
    let Some(pinned) = &state.pinned else {
        model.say(
            Tone::Warning,
            format!("nothing is pinned: {} pins the result on the screen as A", model.key(Action::Pin)),
        );
        return;
    };
    let Some(sides) = &pinned.sides else {
        model.say(Tone::Warning, "B has no result to compare with A");
        return;
    };
    let Some((position, index, wrapped)) = sides.next(state.cursor, forward) else {
        model.say(Tone::Done, "A and B flag the same samples");
        return;
    };
    let [a, b, _] = sides.counts();
    let who = match sides.side(position) {
        Some(Side::OnlyA) => "A flags it, B does not",
        _ => "B flags it, A does not",
    };
    let over = match (wrapped, forward) {
        (false, _) => "",
        (true, true) => " · from the start again",
        (true, false) => " · from the end again",
    };
    let text = format!("difference {} of {}: {who}{over}", index + 1, a + b);
    navigate::go_to(model, position);
    model.say(Tone::Done, text);
}

/// A's setup comes back as one edit. Nothing is pinned then: there would be no difference left.
fn adopt(model: &mut Model) -> Vec<Effect> {
    let Some(pinned) = model.state_mut().pinned.take() else {
        model.say(
            Tone::Warning,
            format!("nothing is pinned: {} pins the result on the screen as A", model.key(Action::Pin)),
        );
        return Vec::new();
    };
    let before = model.plan().setup.clone();
    if before == pinned.setup {
        model.say(Tone::Done, "B has the settings of A; A is no longer pinned");
        return Vec::new();
    }
    let plan = model.shown;
    let id = pinned.setup.method.about().id;
    let edit = Edit::Setup { plan, before: Box::new(before), after: Box::new(pinned.setup) };
    // In an envelope: it is not joined to steps of the same parameter before it.
    let effects = commit(model, Edit::Several(vec![edit]));
    model.say(
        Tone::Done,
        format!("A is back: {id} with its settings; no longer pinned · {} undo", model.key(Action::Undo)),
    );
    effects
}
