//! How the flags are reviewed: in which order, sample by sample or run by run, and what is selected. None of it
//! changes a result, so none of it is in the session.

use std::ops::Range;

use super::Model;

/// Order of the queue.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Sort {
    /// By time.
    #[default]
    Time,
    /// The largest residual in tolerances first.
    Ratio,
    /// Those that the method contradicts first, then the undecided ones.
    State,
    /// The longest runs first.
    Run,
}

/// What is decided on with one key.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Unit {
    /// One sample.
    #[default]
    Sample,
    /// All adjacent flags.
    Run,
}

/// How the flags are reviewed.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Reviewing {
    /// Order of the queue.
    pub sort: Sort,
    /// What is decided on with one key.
    pub unit: Unit,
    /// Whether a decision goes on to the next flag.
    pub auto_advance: bool,
    /// Position at which a range was begun; its other end is the cursor.
    pub anchor: Option<usize>,
    /// Plans and rows (from 0) that the note being written is about.
    pub noting: Vec<(usize, u32)>,
    /// A note that waits for a decision on its row (from 0): index of the plan, row, words.
    pub waiting: Option<(usize, u32, String)>,
    /// Where the last decision left the cursor: a note written there is about that decision.
    pub left_at: Option<usize>,
}

impl Reviewing {
    /// Takes over how its owner likes to work, but nothing that is about a record.
    pub(super) fn keep_habits_of(&mut self, old: Self) {
        let Self { sort, unit, auto_advance, .. } = old;
        (self.sort, self.unit, self.auto_advance) = (sort, unit, auto_advance);
    }
}

impl Default for Reviewing {
    fn default() -> Self {
        Self {
            sort: Sort::default(),
            unit: Unit::default(),
            auto_advance: true,
            anchor: None,
            noting: Vec::new(),
            waiting: None,
            left_at: None,
        }
    }
}

/// Adjacent flags of the queue within a segment, suspects and others apart.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Group {
    /// Position of the first.
    pub start: u32,
    /// How many.
    pub length: u32,
}

impl Group {
    /// The positions of its flags.
    #[must_use]
    pub fn positions(self) -> Range<usize> {
        self.start as usize..(self.start + self.length) as usize
    }
}

impl Model {
    /// The selected positions of the channel on the screen, both ends among them; none without a selection.
    #[must_use]
    pub fn selection(&self) -> Option<Range<usize>> {
        let last = self.series().len().checked_sub(1)?;
        let anchor = self.review.anchor?.min(last);
        let cursor = self.state().cursor.min(last);
        Some(anchor.min(cursor)..anchor.max(cursor) + 1)
    }

    /// The run of flags that holds the flag at `position` of the channel on the screen.
    #[must_use]
    pub fn group(&self, position: usize) -> Option<Group> {
        let groups = &self.state().groups;
        let after = groups.partition_point(|g| g.start as usize <= position);
        let group = *groups.get(after.checked_sub(1)?)?;
        group.positions().contains(&position).then_some(group)
    }
}
