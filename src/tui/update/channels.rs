//! Which channel is shown, and what is done to all of them at once: settings, and the decision about one epoch.

use super::super::action::Action;
use super::super::message::Effect;
use super::super::model::{Model, PickerKind, Tone};
use super::super::words::plural;
use super::review::mark_at;
use super::{commit, decide, picker, show};
use crate::review::{Change, Decision, Ruling};
use crate::session::{Edit, Setup};
use crate::track::printable;

pub(super) fn act(model: &mut Model, action: Action) -> Option<Vec<Effect>> {
    Some(match action {
        Action::Channels => picker(model, PickerKind::Channel),
        Action::NextChannel => {
            let next = (model.shown + 1) % model.channels.len();
            show(model, next)
        }
        Action::SettingsToAll => settings_to_all(model),
        Action::Epoch => epoch(model),
        _ => return None,
    })
}

/// Gives all other channels the method, the settings and the repair of the one on the screen.
pub(super) fn settings_to_all(model: &mut Model) -> Vec<Effect> {
    let shown = model.shown;
    let others: Vec<usize> = (0..model.channels.len()).filter(|plan| *plan != shown).collect();
    copy_settings(model, shown, &others)
}

/// Gives the channels of the plans `to` the method, the settings and the repair of another. The rate channel, and what
/// is done before the method, is each channel's own.
pub(super) fn copy_settings(model: &mut Model, from: usize, to: &[usize]) -> Vec<Effect> {
    let source = model.session.plans[from].setup.clone();
    let (mut edits, mut without_rate) = (Vec::new(), Vec::new());
    for (plan, other) in to.iter().map(|plan| (*plan, &model.session.plans[*plan])) {
        let after =
            Setup { rate: other.setup.rate.clone(), preparation: other.setup.preparation.clone(), ..source.clone() };
        if source.method.about().needs_rate && after.rate.is_none() {
            without_rate.push(printable(&other.channel));
        }
        if after != other.setup {
            edits.push(Edit::Setup { plan, before: Box::new(other.setup.clone()), after: Box::new(after) });
        }
    }
    let n = edits.len();
    if n == 0 {
        let words =
            if model.channels.len() == 1 { "this record has one channel only" } else { "all have them already" };
        model.say(Tone::Warning, words);
        return Vec::new();
    }
    let knob = model.channels[from].knob;
    for edit in &edits {
        edit.touched().iter().for_each(|(plan, _)| model.channels[*plan].knob = knob);
    }
    let effects = commit(model, Edit::Several(edits));
    let id = source.method.about().id;
    let mut text =
        format!("{id} with its settings and repair: {n} other channel{} · {} undo", plural(n), model.key(Action::Undo));
    if without_rate.is_empty() {
        model.say(Tone::Done, text);
    } else {
        text.push_str(&format!("; the rate is not copied, none is chosen for {}", without_rate.join(", ")));
        model.say(Tone::Warning, text);
    }
    effects
}

/// Makes the decision about the sample under the cursor (that it is an outlier, where nothing is decided) in every
/// channel: the whole epoch is bad, or good.
pub(super) fn epoch(model: &mut Model) -> Vec<Effect> {
    let cursor = model.state().cursor;
    let row = model.series().row_of(cursor).and_then(|r| u32::try_from(r).ok());
    let Some(row) = row.filter(|_| mark_at(model, cursor).is_some()) else {
        model.say(
            Tone::Warning,
            format!(
                "no flag under the cursor: {} goes to the next, {} flags this sample by hand",
                model.key(Action::NextFlag),
                model.key(Action::ByHand)
            ),
        );
        return Vec::new();
    };
    let waiting = model.review.waiting.take_if(|(plan, r, _)| (*plan, *r) == (model.shown, row));
    let own = model.plan().decisions.get(row);
    let ruling = own.map_or(Ruling::Outlier, |d| d.ruling);
    let note = own.map(|d| d.note.clone()).or(waiting.map(|w| w.2)).unwrap_or_default();
    let (mut edits, mut holds, mut absent) = (Vec::new(), 0, Vec::new());
    for (plan, state) in model.channels.iter().enumerate() {
        let series = state.samples.series(&model.track.channels[state.channel], &model.track.time);
        let Some(position) = series.position(row as usize) else {
            absent.push(printable(&model.session.plans[plan].channel));
            continue;
        };
        holds += 1;
        let said = state.drawn.as_ref().and_then(|d| d.outcome.detection.judged.verdict().get(position).copied());
        let before = model.session.plans[plan].decisions.get(row).cloned();
        // What another channel's note says stays.
        let note = before.as_ref().map(|d| d.note.clone()).filter(|n| !n.is_empty()).unwrap_or_else(|| note.clone());
        if before.as_ref().is_none_or(|d| d.ruling != ruling) {
            let after = Some(Decision { ruling, note, said, signature: model.signature() });
            edits.push(Edit::Decide { plan, changes: vec![Change { row, before, after }] });
        }
    }
    let mut text = format!("row {} {} in {holds} channel{}", row + 1, ruling.verdict().word(), plural(holds));
    if !absent.is_empty() {
        text.push_str(&format!(", no value in {}", absent.join(", ")));
    }
    if edits.is_empty() {
        model.say(Tone::Warning, format!("{text} already"));
        return Vec::new();
    }
    let effects = commit(model, Edit::Several(edits));
    text.push_str(&format!(" · {} undo", model.key(Action::Undo)));
    decide::after(model, true, &mut text);
    model.say(Tone::Done, text);
    effects
}
