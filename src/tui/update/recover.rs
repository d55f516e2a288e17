//! The answers to the questions whether work that was not saved is wanted back, and whose decision holds where it is
//! not that of the session.

use ratatui::crossterm::event::{KeyCode, KeyEvent, KeyModifiers};

use super::super::action::Action;
use super::super::journal::Found;
use super::super::message::{Effect, Fate};
use super::super::model::{Merging, Model, Overlay, Tone};
use super::super::words::counted;
use super::overlay;
use crate::session::journal::Merge;

/// A key while `offered` are offered: the first is asked about.
pub(super) fn key(model: &mut Model, mut offered: Vec<Found>, key: KeyEvent) -> Vec<Effect> {
    if offered.is_empty() {
        return Vec::new();
    }
    match overlay::answer(key) {
        Some('r') if offered[0].missing.is_none() => begin(model, offered),
        Some('d') => {
            let first = offered.remove(0);
            model.say(Tone::Done, format!("dropped {} of {}", counted(first.changes, "change"), first.when));
            offer(model, offered);
            vec![Effect::Offered { path: first.path, fate: Fate::Dropped }]
        }
        _ if gives_up(key) => {
            model.say(Tone::Done, "kept for later: they are offered again when the record is opened");
            left(&offered)
        }
        _ => {
            offer(model, offered);
            Vec::new()
        }
    }
}

/// A key while it is asked whose decision holds.
pub(super) fn choose(model: &mut Model, mut merging: Merging, key: KeyEvent) -> Vec<Effect> {
    let all = merging.conflicts.len();
    match overlay::answer(key) {
        Some('h') => merging.at += 1,
        Some('t') => {
            merging.chosen.push(merging.at);
            merging.at += 1;
        }
        Some('H') => merging.at = all,
        Some('T') => {
            merging.chosen.extend(merging.at..all);
            merging.at = all;
        }
        _ if gives_up(key) => {
            model.say(Tone::Done, "nothing was restored");
            offer(model, merging.offered);
            return Vec::new();
        }
        _ => {}
    }
    if merging.at < all {
        model.overlay = Overlay::Merge(Box::new(merging));
        return Vec::new();
    }
    take(model, merging.offered, &merging.chosen)
}

fn gives_up(key: KeyEvent) -> bool {
    let control_c = key.code == KeyCode::Char('c') && key.modifiers.contains(KeyModifiers::CONTROL);
    key.code == KeyCode::Esc || control_c
}

/// Asks about the first of these; nothing when there is none.
fn offer(model: &mut Model, offered: Vec<Found>) {
    if !offered.is_empty() {
        model.overlay = Overlay::Recover(offered);
    }
}

fn left(offered: &[Found]) -> Vec<Effect> {
    offered.iter().map(|f| Effect::Offered { path: f.path.clone(), fate: Fate::Left }).collect()
}

/// Takes the first in, or asks first where it and the session contradict each other.
fn begin(model: &mut Model, offered: Vec<Found>) -> Vec<Effect> {
    let conflicts = offered
        .first()
        .map_or_else(Vec::new, |found| Merge::new(&model.session, &found.base, &found.entries).conflicts().to_vec());
    if conflicts.is_empty() {
        return take(model, offered, &[]);
    }
    model.overlay = Overlay::Merge(Box::new(Merging { offered, conflicts, chosen: Vec::new(), at: 0 }));
    Vec::new()
}

/// Takes the changes of the first in, one edit after the other, so that each can be undone, and offers the next. Of the
/// conflicts, those that were `chosen` are as the journal has them.
fn take(model: &mut Model, mut offered: Vec<Found>, chosen: &[usize]) -> Vec<Effect> {
    let found = offered.remove(0);
    let merge = Merge::new(&model.session, &found.base, &found.entries);
    for edit in merge.take(&mut model.session, chosen) {
        for (plan, _) in edit.touched() {
            let state = &mut model.channels[plan];
            (state.touched, state.stale, state.error) = (true, true, None);
        }
        model.history.push(edit);
    }
    model.revision += 1;
    if let Some(last) = found.entries.last()
        && let Some(plan) = model.session.plans.iter().position(|p| last.channels().contains(&p.channel.as_str()))
    {
        model.shown = plan;
    }
    // The work goes on where it was saved last, unless somebody else has saved there since.
    if model.file.is_none() && !found.session_changed {
        model.file = found.session;
    }
    let are = if found.changes == 1 { "is" } else { "are" };
    let what = counted(found.changes, "change");
    model.say(Tone::Done, format!("{what} {are} back, not saved yet · {} undoes one by one", model.key(Action::Undo)));
    offer(model, offered);
    let fate = Fate::Taken { changes: found.changes };
    vec![Effect::Offered { path: found.path, fate }, Effect::Analyse(model.shown)]
}

#[cfg(test)]
mod tests;
