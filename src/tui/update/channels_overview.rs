//! The overview of all channels: opening it, its keys, and what comes back from judging them.

use std::sync::Arc;

use ratatui::crossterm::event::{KeyCode, KeyEvent, KeyModifiers};

use super::super::action::Action;
use super::super::message::Effect;
use super::super::model::{ChannelsOverview, Model, Overlay, Tone};
use super::super::survey::ChannelSummary;
use super::super::words::{counted, plural};
use super::{channels, commit, history, overlay, quit, show};
use crate::error::{Result, on_one_line};
use crate::method::Verdict;
use crate::review::{Decision, Ruling};
use crate::session::Edit;

pub(super) fn act(model: &mut Model, action: Action) -> Option<Vec<Effect>> {
    (action == Action::Overview).then(|| open(model))
}

/// Opens it with the cursor on the channel on the screen.
pub(in crate::tui) fn open(model: &mut Model) -> Vec<Effect> {
    let overview = ChannelsOverview::of(model);
    model.toast = None;
    put(model, overview)
}

/// Puts it on the screen again, and has the channels judged whose summaries do not hold, those in sight first.
fn put(model: &mut Model, overview: ChannelsOverview) -> Vec<Effect> {
    let mut wanted: Vec<usize> = overview.rows(model);
    let mut hidden = vec![true; model.channels.len()];
    wanted.iter().for_each(|plan| hidden[*plan] = false);
    wanted.extend((0..hidden.len()).filter(|plan| hidden[*plan]));
    wanted.retain(|plan| model.channels[*plan].summary_stale);
    // The rows in sight are those around the cursor.
    let at = wanted.iter().position(|plan| *plan == overview.plan).unwrap_or(0);
    wanted.rotate_left(at.saturating_sub(usize::from(model.size.1)));
    model.overlay = Overlay::Overview(Box::new(overview));
    if wanted.is_empty() { Vec::new() } else { vec![Effect::Survey(wanted)] }
}

/// A channel has been judged for the overview.
pub(super) fn surveyed(model: &mut Model, generation: u64, plan: usize, summary: Result<Arc<ChannelSummary>>) {
    // The answer to an earlier job may be about a session that has changed since.
    if model.surveying == Some(generation) {
        let state = &mut model.channels[plan];
        state.summary = Some(summary.map_err(|e| on_one_line(&e)));
        state.summary_stale = false;
    }
}

pub(super) fn key(model: &mut Model, mut overview: ChannelsOverview, key: KeyEvent) -> Vec<Effect> {
    if overview.filtering {
        return type_filter(model, overview, key);
    }
    let rows = overview.rows(model);
    let at = rows.iter().position(|plan| *plan == overview.plan).unwrap_or(0);
    let page = usize::from(model.size.1).saturating_sub(5).max(1);
    let last = rows.len().saturating_sub(1);
    let mut go = |to: usize| overview.plan = rows.get(to.min(last)).copied().unwrap_or(overview.plan);
    model.toast = None;
    if key.modifiers.contains(KeyModifiers::CONTROL) {
        return match key.code {
            KeyCode::Char('c') => leave(model, None),
            KeyCode::Char('r') => edited(model, overview, history::redo),
            _ => keep(model, overview),
        };
    }
    match key.code {
        KeyCode::Down | KeyCode::Char('j') => go(at + 1),
        KeyCode::Up | KeyCode::Char('k') => go(at.saturating_sub(1)),
        KeyCode::PageDown => go(at + page),
        KeyCode::PageUp => go(at.saturating_sub(page)),
        KeyCode::Home | KeyCode::Char('g') => go(0),
        KeyCode::End | KeyCode::Char('G') => go(last),
        KeyCode::Char('/') => overview.filtering = true,
        KeyCode::Char('s') => {
            (overview.sort, overview.reversed) = (overview.sort.next(), false);
            model.say(Tone::Done, format!("sorted by {}", overview.sort.words()));
        }
        KeyCode::Char('S') => overview.reversed = !overview.reversed,
        KeyCode::Char(' ') => {
            if !overview.selected.remove(&overview.plan) {
                overview.selected.insert(overview.plan);
            }
            overview.plan = rows.get((at + 1).min(last)).copied().unwrap_or(overview.plan);
        }
        KeyCode::Char('*') => {
            let all = rows.iter().all(|plan| overview.selected.contains(plan));
            overview.selected = if all { Default::default() } else { rows.into_iter().collect() };
        }
        KeyCode::Char('a') => return accept(model, overview),
        KeyCode::Char('=') => return copy_settings(model, overview),
        KeyCode::Char('u') => return edited(model, overview, history::undo),
        KeyCode::Char('U') => return edited(model, overview, history::redo),
        KeyCode::Char('q') => return quit(model),
        KeyCode::Enter => return leave(model, Some(overview.plan)),
        KeyCode::Esc if !overview.filter.value().is_empty() || !overview.selected.is_empty() => {
            overview.filter.reset();
            overview.selected.clear();
        }
        KeyCode::Esc => return leave(model, None),
        KeyCode::Char(c) => model.say(Tone::Warning, format!("{c} does nothing here: the last line names the keys")),
        _ => {}
    }
    keep(model, overview)
}

fn keep(model: &mut Model, overview: ChannelsOverview) -> Vec<Effect> {
    model.overlay = Overlay::Overview(Box::new(overview));
    Vec::new()
}

fn type_filter(model: &mut Model, mut overview: ChannelsOverview, key: KeyEvent) -> Vec<Effect> {
    match key.code {
        KeyCode::Enter => overview.filtering = false,
        KeyCode::Esc => {
            overview.filtering = false;
            overview.filter.reset();
        }
        _ => overlay::edit(&mut overview.filter, key),
    }
    // The cursor stays on a row that is there.
    let rows = overview.rows(model);
    if !rows.contains(&overview.plan) {
        overview.plan = rows.first().copied().unwrap_or(overview.plan);
    }
    keep(model, overview)
}

/// Back to the channels, to that of a plan or to the one that was on the screen.
fn leave(model: &mut Model, plan: Option<usize>) -> Vec<Effect> {
    let mut effects = vec![Effect::CancelSurvey];
    model.surveying = None;
    if let Some(plan) = plan.filter(|plan| *plan != model.shown) {
        effects.extend(show(model, plan));
    }
    effects
}

/// Does what changes the session; the overview stays, and what it changed is judged.
fn edited(model: &mut Model, overview: ChannelsOverview, edit: impl FnOnce(&mut Model) -> Vec<Effect>) -> Vec<Effect> {
    let mut effects = edit(model);
    effects.extend(put(model, overview));
    effects
}

/// Accepts all undecided flags of the channels.
fn accept(model: &mut Model, overview: ChannelsOverview) -> Vec<Effect> {
    let targets = overview.targets();
    let known = |plan: &usize| {
        let state = &model.channels[*plan];
        state.summary.as_ref().and_then(|s| s.as_ref().ok()).filter(|_| !state.summary_stale)
    };
    if targets.iter().any(|plan| known(plan).is_none()) {
        model.say(Tone::Warning, "not all of these channels are judged yet: wait for their counts");
        return keep(model, overview);
    }
    let signature = model.signature();
    let decision = || Decision {
        ruling: Ruling::Outlier,
        note: String::new(),
        said: Some(Verdict::Outlier),
        signature: signature.clone(),
    };
    let change = |row: &u32| crate::review::Change { row: *row, before: None, after: Some(decision()) };
    let edits: Vec<Edit> = targets
        .iter()
        .filter_map(|plan| Some((*plan, known(plan)?)))
        .filter(|(_, summary)| !summary.undecided.is_empty())
        .map(|(plan, summary)| Edit::Decide { plan, changes: summary.undecided.iter().map(change).collect() })
        .collect();
    let count: usize = edits.iter().flat_map(Edit::touched).map(|(_, rows)| rows.len()).sum();
    if edits.is_empty() {
        model.say(Tone::Warning, "no flag is undecided there");
        return keep(model, overview);
    }
    let channels = edits.len();
    edited(model, overview, |model| {
        let effects = commit(model, Edit::Several(edits));
        let undo = model.key(Action::Undo);
        model.say(
            Tone::Done,
            format!("{} accepted in {channels} channel{} · {undo} undo", counted(count, "flag"), plural(channels)),
        );
        effects
    })
}

/// Gives the method, the parameters and the repair of the row under the cursor to the selected channels, or to all.
fn copy_settings(model: &mut Model, overview: ChannelsOverview) -> Vec<Effect> {
    let from = overview.plan;
    let all = overview.selected.is_empty();
    let to: Vec<usize> =
        (0..model.channels.len()).filter(|plan| *plan != from && (all || overview.selected.contains(plan))).collect();
    edited(model, overview, |model| channels::copy_settings(model, from, &to))
}
