//! The analyst's layer: decisions about single samples, kept apart from what any method says, and the history that
//! undoes and redoes.

use std::collections::BTreeMap;
use std::sync::Arc;

use crate::method::Verdict;

/// What an analyst says of a sample.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Ruling {
    /// It is wild: it will be repaired or removed.
    Outlier,
    /// It is good: it stays as it was measured.
    Normal,
}

impl serde::Serialize for Ruling {
    fn serialize<S: serde::Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        self.verdict().serialize(serializer)
    }
}

impl Ruling {
    /// The verdict it amounts to.
    #[must_use]
    #[inline]
    pub fn verdict(self) -> Verdict {
        match self {
            Self::Outlier => Verdict::Outlier,
            Self::Normal => Verdict::Normal,
        }
    }

    /// The ruling of this word.
    #[must_use]
    pub fn of_word(word: &str) -> Option<Self> {
        [Self::Outlier, Self::Normal].into_iter().find(|r| r.verdict().word() == word)
    }
}

/// By whom and when something was decided, as far as it is known.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct Signature {
    /// The name of the analyst.
    pub by: Option<Arc<str>>,
    /// Seconds since 1970-01-01 00:00 UTC.
    pub at: Option<i64>,
}

/// A decision about one sample.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Decision {
    /// What was decided.
    pub ruling: Ruling,
    /// Why, in the analyst's words; often empty.
    pub note: String,
    /// What the method said when it was decided, where that is known: a decision that agreed with it then and does
    /// not now is a conflict. Not part of a saved session, whose method is the one it was decided under.
    pub said: Option<Verdict>,
    /// By whom and when; nothing in a session of a program that did not record it.
    pub signature: Signature,
}

impl Decision {
    /// The decision itself: two that differ in nothing else say the same.
    #[must_use]
    pub fn says_the_same(&self, other: &Self) -> bool {
        (self.ruling, &self.note) == (other.ruling, &other.note)
    }
}

/// The decisions about one channel, by row (from 0).
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct Decisions(BTreeMap<u32, Decision>);

/// One decision made, changed or cleared; its inverse swaps `before` and `after`.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Change {
    /// Row (from 0) of the sample.
    pub row: u32,
    /// What was decided before, if anything.
    pub before: Option<Decision>,
    /// What is decided now, if anything.
    pub after: Option<Decision>,
}

impl Decisions {
    /// The decision about `row`, if there is one.
    #[must_use]
    #[inline]
    pub fn get(&self, row: u32) -> Option<&Decision> {
        self.0.get(&row)
    }

    /// All decisions by ascending row.
    pub fn iter(&self) -> impl ExactSizeIterator<Item = (u32, &Decision)> {
        self.0.iter().map(|(row, d)| (*row, d))
    }

    /// How many there are.
    #[must_use]
    pub fn len(&self) -> usize {
        self.0.len()
    }

    /// True when nothing is decided.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.0.is_empty()
    }

    /// Makes a decision or, with none, takes it back.
    pub fn set(&mut self, row: u32, decision: Option<Decision>) {
        match decision {
            Some(decision) => self.0.insert(row, decision),
            None => self.0.remove(&row),
        };
    }
}

/// What was done, with what it takes to undo and redo it. Unlimited.
#[derive(Debug, Clone)]
pub struct History<E> {
    done: Vec<E>,
    undone: Vec<E>,
}

impl<E> Default for History<E> {
    fn default() -> Self {
        Self { done: Vec::new(), undone: Vec::new() }
    }
}

impl<E: Clone> History<E> {
    /// Remembers an edit that has been made; what was undone before can no longer be redone.
    pub fn push(&mut self, edit: E) {
        self.done.push(edit);
        self.undone.clear();
    }

    /// The edit to undo, if any.
    pub fn undo(&mut self) -> Option<E> {
        let edit = self.done.pop()?;
        self.undone.push(edit.clone());
        Some(edit)
    }

    /// The edit to make again, if any.
    pub fn redo(&mut self) -> Option<E> {
        let edit = self.undone.pop()?;
        self.done.push(edit.clone());
        Some(edit)
    }

    /// The last edit that is in force, for joining a further one to it.
    pub fn last_mut(&mut self) -> Option<&mut E> {
        if self.undone.is_empty() { self.done.last_mut() } else { None }
    }

    /// The last edit that is in force.
    #[must_use]
    pub fn last(&self) -> Option<&E> {
        self.done.last()
    }

    /// The edits that are in force, the oldest first.
    #[must_use]
    pub fn done(&self) -> &[E] {
        &self.done
    }

    /// The edits that were undone, the one that is redone first last.
    #[must_use]
    pub fn undone(&self) -> &[E] {
        &self.undone
    }

    /// How many edits are in force.
    #[must_use]
    pub fn len(&self) -> usize {
        self.done.len()
    }

    /// True when no edit is in force.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.done.is_empty()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn undo_and_redo_walk_back_and_forth_until_something_new_is_done() {
        let mut history = History::default();
        (1..=3).for_each(|i| history.push(i));
        assert_eq!((history.undo(), history.undo(), history.redo()), (Some(3), Some(2), Some(2)));
        history.push(9);
        assert_eq!((history.redo(), history.undo(), history.undo(), history.len()), (None, Some(9), Some(2), 1));
    }
}
