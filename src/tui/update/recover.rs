//! The answer to the question whether work that was not saved is wanted back.

use ratatui::crossterm::event::{KeyCode, KeyEvent, KeyModifiers};

use super::super::action::Action;
use super::super::journal::Found;
use super::super::message::{Effect, Fate};
use super::super::model::{Model, Overlay, Tone};
use super::super::words::counted;
use super::overlay;
use crate::session::journal;

/// A key while `offered` are offered: the first is asked about.
pub(super) fn key(model: &mut Model, mut offered: Vec<Found>, key: KeyEvent) -> Vec<Effect> {
    if offered.is_empty() {
        return Vec::new();
    }
    let control_c = key.code == KeyCode::Char('c') && key.modifiers.contains(KeyModifiers::CONTROL);
    match overlay::answer(key) {
        Some('r') if offered[0].missing.is_none() => {
            let first = offered.remove(0);
            let mut effects = left(&offered);
            effects.extend(take(model, first));
            effects
        }
        Some('d') => {
            let first = offered.remove(0);
            model.say(Tone::Done, format!("dropped {} of {}", counted(first.changes, "change"), first.when));
            if !offered.is_empty() {
                model.overlay = Overlay::Recover(offered);
            }
            vec![Effect::Offered { path: first.path, fate: Fate::Dropped }]
        }
        _ if key.code == KeyCode::Esc || control_c => {
            model.say(Tone::Done, "kept for later: they are offered again when the record is opened");
            left(&offered)
        }
        _ => {
            model.overlay = Overlay::Recover(offered);
            Vec::new()
        }
    }
}

fn left(offered: &[Found]) -> Vec<Effect> {
    offered.iter().map(|f| Effect::Offered { path: f.path.clone(), fate: Fate::Left }).collect()
}

/// Takes the changes in, one edit after the other, so that each can be undone.
fn take(model: &mut Model, found: Found) -> Vec<Effect> {
    for edit in journal::replay(&mut model.session, &found.entries) {
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
    let fate = Fate::Taken { changes: found.changes };
    vec![Effect::Offered { path: found.path, fate }, Effect::Analyse(model.shown)]
}

#[cfg(test)]
mod tests;
