//! Walking the flags: sample by sample or run by run, in the order of the queue.

use super::super::action::Action;
use super::super::message::Effect;
use super::super::model::{Model, Sort, Tone, Unit};
use super::super::plot::FlagState;
use super::{navigate, note, queue};
use crate::plot::state;
use crate::session::Mark;

pub(super) fn act(model: &mut Model, action: Action) -> Option<Vec<Effect>> {
    match action {
        Action::NextFlag => go(model, true, Stops::Flags),
        Action::PreviousFlag => go(model, false, Stops::Flags),
        Action::NextUnreviewed => go(model, true, Stops::Undecided),
        Action::PreviousUnreviewed => go(model, false, Stops::Undecided),
        Action::NextSuspect => go(model, true, Stops::Suspects),
        Action::PreviousSuspect => go(model, false, Stops::Suspects),
        Action::NextConflict => go(model, true, Stops::Conflicts),
        Action::PreviousConflict => go(model, false, Stops::Conflicts),
        Action::NextInQueue => go(model, true, Stops::All),
        Action::PreviousInQueue => go(model, false, Stops::All),
        Action::Sort => sort(model),
        Action::Unit => unit(model),
        Action::AutoAdvance => {
            let on = !model.review.auto_advance;
            set_auto_advance(model, on);
        }
        Action::Note => return Some(note::ask(model)),
        _ => return None,
    }
    Some(Vec::new())
}

/// The mark of a sample under the decisions as they are now (the result on the screen may be older).
pub(in crate::tui) fn mark_at(model: &Model, position: usize) -> Option<Mark> {
    let series = model.series();
    let row = u32::try_from(series.row_of(position)?).ok()?;
    let decision = model.plan().decisions.get(row);
    let (ruling, said) = (decision.map(|d| d.ruling), decision.and_then(|d| d.said));
    let drawn = model.state().drawn.as_ref()?;
    let verdict = drawn.outcome.detection.judged.verdict().get(position).copied()?;
    let mark = Mark { position: u32::try_from(position).ok()?, verdict, ruling, said };
    state(&mark).map(|_| mark)
}

/// Which flags a walk stops at.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Stops {
    /// All but suspects, which are a class of their own.
    Flags,
    /// Undecided flags.
    Undecided,
    /// Undecided suspects.
    Suspects,
    /// Decisions that the method contradicts now.
    Conflicts,
    /// Everything in the queue.
    All,
}

impl Stops {
    /// Whether the walk stops at an entry of the queue: at any sample of a run.
    fn at(self, model: &Model, position: usize) -> bool {
        let group = model.group(position).filter(|_| model.review.unit == Unit::Run);
        let samples = group.map_or(position..position + 1, |g| g.positions());
        samples.into_iter().any(|i| self.at_sample(model, i))
    }

    fn at_sample(self, model: &Model, position: usize) -> bool {
        let mark = mark_at(model, position);
        let shown = mark.as_ref().and_then(state);
        match self {
            Self::Flags => shown.is_some_and(|s| s != FlagState::Suspect),
            Self::Undecided => shown == Some(FlagState::Unreviewed),
            Self::Suspects => shown == Some(FlagState::Suspect),
            Self::Conflicts => mark.is_some_and(|m| m.conflict()),
            Self::All => shown.is_some(),
        }
    }
}

/// The next flag in the order of the queue, and whether the walk went over the end.
pub(super) fn neighbour(model: &Model, forward: bool, stops: Stops) -> Option<(usize, bool)> {
    let queue = &model.state().queue;
    let cursor = match model.review.unit {
        Unit::Run => model.group(model.state().cursor).map_or(model.state().cursor, |g| g.start as usize),
        Unit::Sample => model.state().cursor,
    };
    let by_time = model.review.sort == Sort::Time;
    let n = queue.len();
    // How many flags of the queue are behind the cursor, and where the walk starts.
    let start = if by_time {
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
        stops.at(model, position).then_some((position, wrapped && by_time))
    })
}

fn go(model: &mut Model, forward: bool, stops: Stops) {
    let Some((position, wrapped)) = neighbour(model, forward, stops) else {
        let text = match (model.state().queue.is_empty(), stops) {
            (_, Stops::Conflicts) => "no decision contradicts the method".to_owned(),
            (true, _) => "no flags under these settings".into(),
            (false, Stops::Undecided) => "every flag is decided".into(),
            (false, Stops::Suspects) => "no undecided suspect".into(),
            (false, Stops::Flags) => {
                format!("no flags, only suspects: {} goes to the next", model.key(Action::NextSuspect))
            }
            (false, Stops::All) => "no other flag".into(),
        };
        model.say(Tone::Warning, text);
        return;
    };
    navigate::go_to(model, position);
    if wrapped {
        model.say(Tone::Warning, if forward { "from the first flag again" } else { "from the last flag again" });
    }
}

fn sort(model: &mut Model) {
    let (next, by) = match model.review.sort {
        Sort::Time => (Sort::Ratio, "ratio, largest first"),
        Sort::Ratio => (Sort::State, "state, undecided first"),
        Sort::State => (Sort::Run, "run, longest first"),
        Sort::Run => (Sort::Time, "time"),
    };
    model.review.sort = next;
    rearrange(model);
    if next != Sort::Time
        && let Some(&first) = model.state().queue.first()
    {
        navigate::go_to(model, first as usize);
    }
    model.say(Tone::Done, format!("queue by {by}"));
}

fn unit(model: &mut Model) {
    let (next, words) = match model.review.unit {
        Unit::Sample => (Unit::Run, "adjacent flags are one: n, a, r, x and space act on the whole run"),
        Unit::Run => (Unit::Sample, "sample by sample"),
    };
    model.review.unit = next;
    rearrange(model);
    model.say(Tone::Done, words);
}

fn rearrange(model: &mut Model) {
    for plan in 0..model.channels.len() {
        queue::arrange(model, plan);
    }
}

/// Whether a decision goes on to the next flag.
pub(super) fn set_auto_advance(model: &mut Model, on: bool) {
    model.review.auto_advance = on;
    let words = if on { "goes to the next flag" } else { "stays; n goes to the next flag" };
    model.say(Tone::Done, format!("auto-advance {}: a decision {words}", if on { "on" } else { "off" }));
}
