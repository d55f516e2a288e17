//! Changes of a session that can be undone and redone.

use super::{Session, Setup};
use crate::review::Change;

/// A change of the session that can be undone.
#[derive(Debug, Clone, PartialEq)]
pub enum Edit {
    /// Decisions about the channel of a plan.
    Decide {
        /// Index of the plan.
        plan: usize,
        /// The decisions, all made at once.
        changes: Vec<Change>,
    },
    /// Another method, setting or repair for the channel of a plan.
    Setup {
        /// Index of the plan.
        plan: usize,
        /// What it was.
        before: Box<Setup>,
        /// What it is.
        after: Box<Setup>,
    },
    /// Several edits, made in their order and undone together.
    Several(Vec<Edit>),
}

impl Edit {
    /// The single edits it consists of, in their order.
    #[must_use]
    pub fn parts(&self) -> Vec<&Self> {
        match self {
            Self::Several(parts) => parts.iter().flat_map(Self::parts).collect(),
            single => vec![single],
        }
    }

    /// Indices of the plans it changes, with the rows (from 0) whose decisions change; no rows when it is the setup.
    #[must_use]
    pub fn touched(&self) -> Vec<(usize, Vec<u32>)> {
        let of = |part: &Self| match part {
            Self::Decide { plan, changes } => Some((*plan, changes.iter().map(|c| c.row).collect())),
            Self::Setup { plan, .. } => Some((*plan, Vec::new())),
            Self::Several(_) => None,
        };
        self.parts().into_iter().filter_map(of).collect()
    }
}

impl Session {
    /// Makes an edit.
    pub fn apply(&mut self, edit: &Edit) {
        match edit {
            Edit::Several(parts) => parts.iter().for_each(|part| self.apply(part)),
            single => self.step(single, true),
        }
    }

    /// Takes an edit back.
    pub fn revert(&mut self, edit: &Edit) {
        match edit {
            Edit::Several(parts) => parts.iter().rev().for_each(|part| self.revert(part)),
            single => self.step(single, false),
        }
    }

    fn step(&mut self, edit: &Edit, forth: bool) {
        match edit {
            Edit::Decide { plan, changes } => {
                let Some(plan) = self.plans.get_mut(*plan) else { return };
                for change in changes {
                    let to = if forth { &change.after } else { &change.before };
                    plan.decisions.set(change.row, to.clone());
                }
            }
            Edit::Setup { plan, before, after } => {
                let Some(plan) = self.plans.get_mut(*plan) else { return };
                plan.setup = Setup::clone(if forth { after } else { before });
            }
            Edit::Several(_) => {}
        }
    }
}
