//! Deciding: on the flag under the cursor, on its run, on a range, on all in view.

use std::ops::Range;

use super::super::action::Action;
use super::super::message::Effect;
use super::super::model::{Model, Tone, Unit};
use super::super::plot::FlagState;
use super::super::words::counted;
use super::review::{Stops, mark_at, neighbour};
use super::{commit, navigate};
use crate::plot::state;
use crate::review::{Change, Decision, Ruling};
use crate::session::Edit;

pub(super) fn act(model: &mut Model, action: Action) -> Option<Vec<Effect>> {
    Some(match action {
        Action::Accept => decide(model, Some(Ruling::Outlier)),
        Action::Reject => decide(model, Some(Ruling::Normal)),
        Action::Clear => decide(model, None),
        Action::Toggle => toggle(model),
        Action::ByHand => by_hand(model),
        Action::AcceptView => in_view(model, Some(Ruling::Outlier)),
        Action::RejectView => in_view(model, Some(Ruling::Normal)),
        Action::ClearView => in_view(model, None),
        Action::SelectRange => {
            select(model);
            Vec::new()
        }
        _ => return None,
    })
}

/// What a decision is about.
struct Targets {
    /// Positions of the flags, ascending.
    positions: Vec<usize>,
    /// What they are, for the user; the row where it is one sample.
    what: String,
    /// Whether the walk goes on afterwards.
    goes_on: bool,
}

/// Begins a range at the cursor, or gives it up.
fn select(model: &mut Model) {
    if model.review.anchor.take().is_some() {
        return;
    }
    if model.series().is_empty() {
        model.say(Tone::Warning, "no sample to begin a range at");
        return;
    }
    model.review.anchor = Some(model.state().cursor);
}

/// The flags in a range of positions, with the decisions as they are now.
pub(in crate::tui) fn flags_in(model: &Model, range: &Range<usize>) -> Vec<usize> {
    let series = model.series();
    let Some(drawn) = &model.state().drawn else { return Vec::new() };
    let found = &drawn.positions;
    let from = found.partition_point(|&p| (p as usize) < range.start);
    let to = found.partition_point(|&p| (p as usize) < range.end);
    let mut positions: Vec<usize> = found[from..to].iter().map(|&p| p as usize).collect();
    let decided = model.plan().decisions.iter().filter_map(|(row, _)| series.position(row as usize));
    positions.extend(decided.filter(|p| range.contains(p)));
    positions.sort_unstable();
    positions.dedup();
    positions.retain(|&p| mark_at(model, p).is_some());
    positions
}

/// What `a`, `r`, `x` and the space bar are about now.
fn targets(model: &Model) -> Targets {
    if let Some(range) = model.selection() {
        let positions = flags_in(model, &range);
        let what = format!("{} of {} selected", counted(positions.len(), "flag"), counted(range.len(), "sample"));
        return Targets { positions, what, goes_on: false };
    }
    let cursor = model.state().cursor;
    let series = model.series();
    let run = model.group(cursor).filter(|g| model.review.unit == Unit::Run && g.length > 1);
    let positions: Vec<usize> = run.map_or(cursor..cursor + 1, |g| g.positions()).collect();
    let positions: Vec<usize> = positions.into_iter().filter(|&p| mark_at(model, p).is_some()).collect();
    let what = match positions.as_slice() {
        [first, .., last] => {
            format!("a run of {}, rows {} to {}", positions.len(), series.row(*first) + 1, series.row(*last) + 1)
        }
        _ => series.row_of(cursor).map_or_else(String::new, |row| format!("row {}", row + 1)),
    };
    Targets { positions, what, goes_on: true }
}

/// A decision on the sample at `position`; none when nothing changes.
pub(super) fn change(model: &Model, position: usize, ruling: Option<Ruling>) -> Option<Change> {
    let row = u32::try_from(model.series().row_of(position)?).ok()?;
    let before = model.plan().decisions.get(row).cloned();
    let waiting = model.review.waiting.as_ref().filter(|(plan, r, _)| (*plan, *r) == (model.shown, row));
    let waits = || waiting.map(|(_, _, note)| note.clone()).unwrap_or_default();
    let note = before.as_ref().map_or_else(waits, |d| d.note.clone());
    let said = model.state().drawn.as_ref().and_then(|d| d.outcome.detection.judged.verdict().get(position).copied());
    let signature = model.signature();
    let after = ruling.map(|ruling| Decision { ruling, note, said, signature });
    changed(row, before, after)
}

/// The change of a decision; none where both say the same: the first signature stays.
pub(super) fn changed(row: u32, before: Option<Decision>, after: Option<Decision>) -> Option<Change> {
    let same = match (&before, &after) {
        (Some(before), Some(after)) => before.says_the_same(after) && before.said == after.said,
        (None, None) => true,
        _ => false,
    };
    (!same).then_some(Change { row, before, after })
}

/// Makes decisions about the channel on the screen, one undo step.
fn make(model: &mut Model, changes: Vec<Change>) -> Vec<Effect> {
    if changes.is_empty() {
        return Vec::new();
    }
    let plan = model.shown;
    let taken = |c: &Change| model.review.waiting.as_ref().is_some_and(|(p, row, _)| (*p, *row) == (plan, c.row));
    if changes.iter().any(taken) {
        model.review.waiting = None;
    }
    commit(model, Edit::Decide { plan, changes })
}

fn word(ruling: Option<Ruling>) -> &'static str {
    match ruling {
        Some(Ruling::Outlier) => "accepted",
        Some(Ruling::Normal) => "rejected",
        None => "decision cleared:",
    }
}

fn decide(model: &mut Model, ruling: Option<Ruling>) -> Vec<Effect> {
    let targets = targets(model);
    if targets.positions.is_empty() {
        let text = if model.review.anchor.is_some() {
            format!("no flag in the range: {} flags all of its samples by hand", model.key(Action::ByHand))
        } else {
            format!(
                "no flag under the cursor: {} goes to the next, {} flags this sample by hand",
                model.key(Action::NextFlag),
                model.key(Action::ByHand)
            )
        };
        model.say(Tone::Warning, text);
        return Vec::new();
    }
    // A suspect may be a real change of the trajectory: it is not accepted in passing.
    let spared = if targets.goes_on { 0 } else { suspects(model, &targets.positions, ruling) };
    let spare = spared > 0;
    let positions = targets.positions.iter().copied().filter(|&p| !spare || !is_suspect(model, p));
    let changes: Vec<Change> = positions.filter_map(|p| change(model, p, ruling)).collect();
    let effects = make(model, changes);
    let mut text = format!("{} {} · {} undo", word(ruling), targets.what, model.key(Action::Undo));
    if spare {
        text.push_str(&format!(" · not {}", counted(spared, "suspect")));
    }
    after(model, targets.goes_on && ruling.is_some(), &mut text);
    model.say(Tone::Done, text);
    effects
}

/// After a decision: the range is done with, and the walk goes on.
pub(super) fn after(model: &mut Model, goes_on: bool, text: &mut String) {
    model.review.anchor = None;
    if goes_on {
        match neighbour(model, true, Stops::Undecided) {
            Some((next, _)) if model.review.auto_advance => navigate::go_to(model, next),
            Some(_) => {}
            None => text.push_str(" · every flag is decided"),
        }
    }
    model.review.left_at = Some(model.state().cursor);
}

fn is_suspect(model: &Model, position: usize) -> bool {
    mark_at(model, position).as_ref().and_then(state) == Some(FlagState::Suspect)
}

/// How many suspects a decision on many flags passes over.
fn suspects(model: &Model, positions: &[usize], ruling: Option<Ruling>) -> usize {
    if ruling != Some(Ruling::Outlier) {
        return 0;
    }
    positions.iter().filter(|p| is_suspect(model, **p)).count()
}

fn toggle(model: &mut Model) -> Vec<Effect> {
    let targets = targets(model);
    if targets.positions.is_empty() {
        return decide(model, None);
    }
    let accepted = |p: &usize| mark_at(model, *p).is_some_and(|m| m.ruling == Some(Ruling::Outlier));
    let ruling = if targets.positions.iter().all(accepted) { Ruling::Normal } else { Ruling::Outlier };
    let changes = targets.positions.iter().filter_map(|&p| change(model, p, Some(ruling))).collect();
    let effects = make(model, changes);
    let mut text = format!("{} {} · {} undo", word(Some(ruling)), targets.what, model.key(Action::Undo));
    after(model, false, &mut text);
    model.say(Tone::Done, text);
    effects
}

fn by_hand(model: &mut Model) -> Vec<Effect> {
    if let Some(range) = model.selection() {
        let decided = |p: &usize| mark_at(model, *p).is_some_and(|m| m.ruling == Some(Ruling::Outlier));
        let changes: Vec<Change> =
            range.clone().filter(|p| !decided(p)).filter_map(|p| change(model, p, Some(Ruling::Outlier))).collect();
        let n = changes.len();
        let effects = make(model, changes);
        let mut text = format!(
            "flagged by hand: {} of {} selected · {} undo",
            n,
            counted(range.len(), "sample"),
            model.key(Action::Undo)
        );
        after(model, false, &mut text);
        model.say(Tone::Done, text);
        return effects;
    }
    let cursor = model.state().cursor;
    let (ruling, text) = match mark_at(model, cursor).as_ref().and_then(state) {
        Some(FlagState::ByHand) => (None, "no longer flagged by hand"),
        Some(FlagState::Unreviewed | FlagState::Accepted) => {
            model.say(
                Tone::Warning,
                format!(
                    "already flagged: {} accepts it, {} rejects it",
                    model.key(Action::Accept),
                    model.key(Action::Reject)
                ),
            );
            return Vec::new();
        }
        Some(FlagState::Rejected | FlagState::Suspect) | None => (Some(Ruling::Outlier), "flagged by hand"),
    };
    let Some(change) = change(model, cursor, ruling) else { return Vec::new() };
    let mut text = format!("{text}: row {} · {} undo", change.row + 1, model.key(Action::Undo));
    let effects = make(model, vec![change]);
    after(model, false, &mut text);
    model.say(Tone::Done, text);
    effects
}

fn in_view(model: &mut Model, ruling: Option<Ruling>) -> Vec<Effect> {
    let range = model.in_view();
    let positions = flags_in(model, &range);
    let spared = suspects(model, &positions, ruling);
    let wanted = positions.into_iter().filter(|&p| spared == 0 || !is_suspect(model, p));
    let changes: Vec<Change> = wanted.filter_map(|p| change(model, p, ruling)).collect();
    if changes.is_empty() {
        model.say(Tone::Warning, "no flag in view to decide on");
        return Vec::new();
    }
    let mut text =
        format!("{} {} in view · {} undo", word(ruling), counted(changes.len(), "flag"), model.key(Action::Undo));
    let effects = make(model, changes);
    after(model, false, &mut text);
    model.say(Tone::Done, text);
    effects
}
