//! Walking the flags and deciding on them.

use super::super::action::Action;
use super::super::message::Effect;
use super::super::model::{Model, PromptKind, Sort, Tone};
use super::super::plot::{Axis, FlagState};
use super::{commit, navigate, prompt};
use crate::plot::state;
use crate::review::{Change, Decision, Ruling};
use crate::session::{Edit, Mark};

pub(super) fn act(model: &mut Model, action: Action) -> Vec<Effect> {
    match action {
        Action::NextFlag => go(model, true, Stops::Flags),
        Action::PreviousFlag => go(model, false, Stops::Flags),
        Action::NextUnreviewed => go(model, true, Stops::Undecided),
        Action::PreviousUnreviewed => go(model, false, Stops::Undecided),
        Action::NextSuspect => go(model, true, Stops::Suspects),
        Action::PreviousSuspect => go(model, false, Stops::Suspects),
        Action::NextInQueue => go(model, true, Stops::All),
        Action::PreviousInQueue => go(model, false, Stops::All),
        Action::Accept => return decide(model, Some(Ruling::Outlier)),
        Action::Reject => return decide(model, Some(Ruling::Normal)),
        Action::Clear => return decide(model, None),
        Action::Toggle => return toggle(model),
        Action::ByHand => return by_hand(model),
        Action::Note => return note(model),
        Action::AcceptView => return in_view(model, Some(Ruling::Outlier)),
        Action::RejectView => return in_view(model, Some(Ruling::Normal)),
        Action::ClearView => return in_view(model, None),
        _ => {}
    }
    Vec::new()
}

/// The mark of a sample under the decisions as they are now (the result on the screen may be older).
pub(in crate::tui) fn mark_at(model: &Model, position: usize) -> Option<Mark> {
    let series = model.series();
    let row = u32::try_from(series.row_of(position)?).ok()?;
    let decision = model.plan().decisions.get(row);
    let (ruling, said) = (decision.map(|d| d.ruling), decision.and_then(|d| d.said));
    let drawn = model.state().drawn.as_ref()?;
    let verdict = drawn.outcome.detection.judged.verdict.get(position).copied()?;
    let mark = Mark { position: u32::try_from(position).ok()?, verdict, ruling, said };
    state(&mark).map(|_| mark)
}

/// Which flags a walk stops at.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Stops {
    /// All but suspects, which are a class of their own.
    Flags,
    /// Flags that nobody decided on.
    Undecided,
    /// Suspects that nobody decided on.
    Suspects,
    /// Everything in the queue.
    All,
}

impl Stops {
    fn at(self, model: &Model, position: usize) -> bool {
        let shown = mark_at(model, position).as_ref().and_then(state);
        match self {
            Self::Flags => shown.is_some_and(|s| s != FlagState::Suspect),
            Self::Undecided => shown == Some(FlagState::Unreviewed),
            Self::Suspects => shown == Some(FlagState::Suspect),
            Self::All => shown.is_some(),
        }
    }
}

/// The next flag in the order of the queue, and whether the walk went over the end.
fn neighbour(model: &Model, forward: bool, stops: Stops) -> Option<(usize, bool)> {
    let queue = &model.state().queue;
    let cursor = model.state().cursor;
    let n = queue.len();
    // How many flags of the queue are behind the cursor, and where the walk starts.
    let start = if model.sort == Sort::Time {
        let after = queue.partition_point(|&p| (p as usize) <= cursor);
        let before = queue.partition_point(|&p| (p as usize) < cursor);
        if forward { after } else { (before + n).checked_sub(1)? % n.max(1) }
    } else {
        let at = queue.iter().position(|&p| p as usize == cursor);
        match (at, forward) {
            (Some(at), true) => at + 1,
            (Some(at), false) => (at + n).checked_sub(1)?,
            (None, true) => 0,
            (None, false) => n.checked_sub(1)?,
        }
    };
    (0..n).find_map(|step| {
        let index = if forward { (start + step) % n } else { (start % n + n - step) % n };
        let position = queue[index] as usize;
        let wrapped = if forward { position <= cursor } else { position >= cursor };
        stops.at(model, position).then_some((position, wrapped && model.sort == Sort::Time))
    })
}

fn go(model: &mut Model, forward: bool, stops: Stops) {
    let Some((position, wrapped)) = neighbour(model, forward, stops) else {
        let text = match (model.state().queue.is_empty(), stops) {
            (true, _) => "no flags under these settings",
            (false, Stops::Undecided) => "every flag has been decided on",
            (false, Stops::Suspects) => "no suspect that nobody decided on",
            (false, Stops::Flags) => "no flags, only suspects: g n goes to the next",
            (false, Stops::All) => "no other flag",
        };
        model.say(Tone::Warning, text);
        return;
    };
    navigate::go_to(model, position);
    if wrapped {
        model.say(Tone::Warning, if forward { "from the first flag again" } else { "from the last flag again" });
    }
}

/// A decision on the sample at `position`; none when nothing changes.
fn change(model: &Model, position: usize, ruling: Option<Ruling>) -> Option<Change> {
    let row = u32::try_from(model.series().row_of(position)?).ok()?;
    let before = model.plan().decisions.get(row).cloned();
    let note = before.as_ref().map(|d| d.note.clone()).unwrap_or_default();
    let said = model.state().drawn.as_ref().and_then(|d| d.outcome.detection.judged.verdict.get(position).copied());
    let after = ruling.map(|ruling| Decision { ruling, note, said });
    (before != after).then_some(Change { row, before, after })
}

fn make(model: &mut Model, changes: Vec<Change>) -> Vec<Effect> {
    let plan = model.shown;
    commit(model, Edit::Decide { plan, changes })
}

fn decide(model: &mut Model, ruling: Option<Ruling>) -> Vec<Effect> {
    let cursor = model.state().cursor;
    if mark_at(model, cursor).is_none() {
        model.say(Tone::Warning, "no flag under the cursor: n goes to the next, o flags this sample by hand");
        return Vec::new();
    }
    let effects = change(model, cursor, ruling).map(|c| make(model, vec![c])).unwrap_or_default();
    let row = model.series().row(cursor) + 1;
    let word = match ruling {
        Some(Ruling::Outlier) => "accepted",
        Some(Ruling::Normal) => "rejected",
        None => "decision taken back:",
    };
    let mut text = format!("{word} row {row} · u undo");
    if ruling.is_some() {
        match neighbour(model, true, Stops::Undecided) {
            Some((next, _)) => navigate::go_to(model, next),
            None => text.push_str(" · every flag has been decided on"),
        }
    }
    model.say(Tone::Done, text);
    effects
}

fn toggle(model: &mut Model) -> Vec<Effect> {
    let cursor = model.state().cursor;
    let Some(mark) = mark_at(model, cursor) else {
        return decide(model, None);
    };
    let ruling = if mark.ruling == Some(Ruling::Outlier) { Ruling::Normal } else { Ruling::Outlier };
    let effects = change(model, cursor, Some(ruling)).map(|c| make(model, vec![c])).unwrap_or_default();
    let word = if ruling == Ruling::Outlier { "accepted" } else { "rejected" };
    model.say(Tone::Done, format!("{word} · u undo"));
    effects
}

fn by_hand(model: &mut Model) -> Vec<Effect> {
    let cursor = model.state().cursor;
    let (ruling, text) = match mark_at(model, cursor).as_ref().and_then(state) {
        Some(FlagState::ByHand) => (None, "no longer flagged by hand"),
        Some(FlagState::Unreviewed | FlagState::Accepted) => {
            model.say(Tone::Warning, "already flagged: a accepts it, r rejects it");
            return Vec::new();
        }
        Some(FlagState::Rejected | FlagState::Suspect) | None => (Some(Ruling::Outlier), "flagged by hand"),
    };
    let Some(change) = change(model, cursor, ruling) else { return Vec::new() };
    let row = change.row + 1;
    let effects = make(model, vec![change]);
    model.say(Tone::Done, format!("{text}: row {row} · u undo"));
    effects
}

/// A note on the decision about the sample under the cursor or, since deciding goes on to the next flag, on the one
/// made last.
fn note(model: &mut Model) -> Vec<Effect> {
    let here = model.series().row_of(model.state().cursor).and_then(|r| u32::try_from(r).ok());
    let shown = model.shown;
    let last = match model.history.last() {
        Some(Edit::Decide { plan, changes }) if *plan == shown => match changes.as_slice() {
            [change] => Some(change.row),
            _ => None,
        },
        _ => None,
    };
    let decided = |row: &u32| model.plan().decisions.get(*row).is_some();
    match here.filter(decided).or(last.filter(decided)) {
        Some(row) => {
            let text = model.plan().decisions.get(row).map(|d| d.note.clone()).unwrap_or_default();
            prompt(model, PromptKind::Note(row), &text)
        }
        None => {
            model.say(Tone::Warning, "a note goes with a decision: a, r or o first");
            Vec::new()
        }
    }
}

/// Puts a note on the decision about `row`.
pub(super) fn set_note(model: &mut Model, row: u32, text: &str) -> Vec<Effect> {
    let Some(before) = model.plan().decisions.get(row).cloned() else { return Vec::new() };
    let after = Decision { note: text.trim().to_owned(), ..before.clone() };
    if before == after {
        return Vec::new();
    }
    let effects = make(model, vec![Change { row, before: Some(before), after: Some(after) }]);
    model.say(Tone::Done, format!("note on row {} · u undo", row + 1));
    effects
}

fn in_view(model: &mut Model, ruling: Option<Ruling>) -> Vec<Effect> {
    let range = model.state().view.positions(Axis::Time(&model.series().t));
    let inside = model.state().queue.iter().map(|&p| p as usize).filter(|p| range.contains(p));
    let changes: Vec<Change> = {
        let mut positions: Vec<usize> = inside.collect();
        positions.sort_unstable();
        // A suspect may be a real change of the trajectory: it is not accepted in passing.
        let passed_over = |p: &usize| {
            let shown = mark_at(model, *p).as_ref().and_then(state);
            ruling == Some(Ruling::Outlier) && shown == Some(FlagState::Suspect)
        };
        positions.into_iter().filter(|p| !passed_over(p)).filter_map(|p| change(model, p, ruling)).collect()
    };
    if changes.is_empty() {
        model.say(Tone::Warning, "no flag in view to decide on");
        return Vec::new();
    }
    let count = changes.len();
    let effects = make(model, changes);
    let word = match ruling {
        Some(Ruling::Outlier) => "accepted",
        Some(Ruling::Normal) => "rejected",
        None => "decisions taken back:",
    };
    model.say(Tone::Done, format!("{word} {count} flags in view · u undo"));
    effects
}
