//! The journal of a session: what was changed since it was saved, one line per change, so that work outlives the
//! program. Here is what the lines mean and how they are made and recovered; files are the business of the
//! screen.
//!
//! The first entry about a channel holds all of its plan, so that a journal can be recovered whatever method the
//! record is opened with; the later ones hold what they changed.

use std::path::PathBuf;

use super::{Edit, Plan, Session, Setup};
use crate::review::{Change, Decision, Decisions};

mod line;
mod merge;
mod written;

pub use line::{Encoder, Foreign, Journal, decode, foreign};
pub use merge::{Conflict, Disputed, Merge};

/// What the first line of a journal says.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Header {
    /// The record: an absolute path, or the name of a built-in one.
    pub record: String,
    /// SHA-256 of the record, lower-case hexadecimal.
    pub sha256: String,
    /// How many bytes those are: the record may have been appended to since. None in journals of earlier versions.
    pub bytes: Option<u64>,
    /// Its data rows.
    pub rows: usize,
    /// The session file that the work goes on from, if there is one.
    pub base: Option<Base>,
    /// How many of the entries that follow say where the work began, and are no changes themselves.
    pub begun: usize,
    /// How many changes that are not saved are in those first entries (for example after work was recovered).
    pub carried: usize,
}

/// A session file at a moment.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Base {
    /// Its absolute path.
    pub path: PathBuf,
    /// SHA-256 of its bytes then, lower-case hexadecimal; empty when it could not be read.
    pub sha256: String,
}

/// One change of a session: not what was done but what holds since, so that undo and redo are changes like any other.
#[derive(Debug, Clone, PartialEq)]
pub enum Entry {
    /// All of a plan.
    Whole(Box<Plan>),
    /// Method, settings and repair for a channel.
    Setup {
        /// Name of the channel.
        channel: String,
        /// What holds now.
        setup: Box<Setup>,
    },
    /// Decisions about a channel.
    Decide {
        /// Name of the channel.
        channel: String,
        /// Rows (from 0) with what is decided about them now, if anything.
        decisions: Vec<(u32, Option<Decision>)>,
    },
    /// What one edit changed in several places: all of it comes back, or none.
    Several(Vec<Entry>),
}

impl Entry {
    /// The entry after a change of `plan`: of the decisions about `rows` (from 0) or, with none, of its setup.
    #[must_use]
    pub fn of(plan: &Plan, rows: &[u32]) -> Self {
        let channel = plan.channel.clone();
        if rows.is_empty() {
            return Self::Setup { channel, setup: Box::new(plan.setup.clone()) };
        }
        let decisions = rows.iter().map(|row| (*row, plan.decisions.get(*row).cloned())).collect();
        Self::Decide { channel, decisions }
    }

    /// The channels it is about.
    #[must_use]
    pub fn channels(&self) -> Vec<&str> {
        match self {
            Self::Whole(plan) => vec![&plan.channel],
            Self::Setup { channel, .. } | Self::Decide { channel, .. } => vec![channel],
            Self::Several(entries) => entries.iter().flat_map(Self::channels).collect(),
        }
    }

    /// The edit that brings `session` to what the entry says; none where it is so already, or where the session has
    /// no such channel.
    #[must_use]
    pub fn edit(&self, session: &Session) -> Option<Edit> {
        let mut edits = self.edits(session);
        if edits.len() > 1 { Some(Edit::Several(edits)) } else { edits.pop() }
    }

    fn edits(&self, session: &Session) -> Vec<Edit> {
        let (channel, setup, wanted) = match self {
            Self::Several(entries) => return entries.iter().flat_map(|e| e.edits(session)).collect(),
            Self::Whole(whole) => (&whole.channel, Some(&whole.setup), Some(&whole.decisions)),
            Self::Setup { channel, setup } => (channel, Some(setup.as_ref()), None),
            Self::Decide { channel, .. } => (channel, None, None),
        };
        let Some(index) = session.plans.iter().position(|p| p.channel == *channel) else { return Vec::new() };
        let Some(plan) = session.plans.get(index) else { return Vec::new() };
        let wanted = match (self, wanted) {
            (Self::Decide { decisions, .. }, _) => decisions.clone(),
            (_, Some(all)) => all_rows(&plan.decisions, all),
            (_, None) => Vec::new(),
        };
        let mut edits = Vec::new();
        if let Some(after) = setup.filter(|s| **s != plan.setup) {
            let (before, after) = (Box::new(plan.setup.clone()), Box::new(after.clone()));
            edits.push(Edit::Setup { plan: index, before, after });
        }
        let change = |(row, after): (u32, Option<Decision>)| {
            let before = plan.decisions.get(row).cloned();
            (before != after).then_some(Change { row, before, after })
        };
        let changes: Vec<Change> = wanted.into_iter().filter_map(change).collect();
        if !changes.is_empty() {
            edits.push(Edit::Decide { plan: index, changes });
        }
        edits
    }
}

/// Knows about which channels a journal has all, and so what the next entry has to hold.
#[derive(Debug, Clone, Default)]
pub struct Scribe {
    known: Vec<String>,
}

impl Scribe {
    /// A journal that begins with these plans, and the entries that say so.
    #[must_use]
    pub fn beginning<'a>(plans: impl IntoIterator<Item = &'a Plan>) -> (Self, Vec<Entry>) {
        let entries: Vec<Entry> = plans.into_iter().map(|p| Entry::Whole(Box::new(p.clone()))).collect();
        let known = entries.iter().flat_map(Entry::channels).map(str::to_owned).collect();
        (Self { known }, entries)
    }

    /// The entry after an edit that changed these of `plans`: indices, with rows as for [`Entry::of`].
    pub fn entry(&mut self, plans: &[Plan], touched: &[(usize, Vec<u32>)]) -> Option<Entry> {
        let known = touched.iter().filter_map(|(plan, rows)| Some((plans.get(*plan)?, rows)));
        let mut entries: Vec<Entry> = known.map(|(plan, rows)| self.single(plan, rows)).collect();
        if entries.len() > 1 { Some(Entry::Several(entries)) } else { entries.pop() }
    }

    /// The entry after a change of `plan`, as [`Entry::of`], or all of the plan when the journal does not have it yet.
    fn single(&mut self, plan: &Plan, rows: &[u32]) -> Entry {
        if self.known.contains(&plan.channel) {
            return Entry::of(plan, rows);
        }
        self.known.push(plan.channel.clone());
        Entry::Whole(Box::new(plan.clone()))
    }
}

/// Every row decided on in either, with what the second says.
fn all_rows(now: &Decisions, then: &Decisions) -> Vec<(u32, Option<Decision>)> {
    let gone = now.iter().filter(|(row, _)| then.get(*row).is_none()).map(|(row, _)| (row, None));
    gone.chain(then.iter().map(|(row, d)| (row, Some(d.clone())))).collect()
}

/// Takes entries back in, one after the other; gives the edits that did it, for undoing them.
pub fn replay(session: &mut Session, entries: &[Entry]) -> Vec<Edit> {
    let mut done = Vec::new();
    for entry in entries {
        if let Some(edit) = entry.edit(session) {
            session.apply(&edit);
            done.push(edit);
        }
    }
    done
}

#[cfg(test)]
mod tests;
