//! The overview of all channels: which rows it has, in which order, and which are selected.

use std::cmp::Ordering;
use std::collections::BTreeSet;

use tui_input::Input;

use super::super::survey::ChannelSummary;
use super::{ChannelState, Model};
use crate::track::printable;

/// The overview of all channels.
#[derive(Debug, Default)]
pub struct ChannelsOverview {
    /// What was typed to narrow the rows.
    pub filter: Input,
    /// True while it is being typed.
    pub filtering: bool,
    /// What the rows are sorted by.
    pub sort: SortColumn,
    /// True when the order is the other way round.
    pub reversed: bool,
    /// The plan of the row under the cursor.
    pub plan: usize,
    /// Plans that are selected.
    pub selected: BTreeSet<usize>,
}

/// What the rows of the overview are sorted by.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum SortColumn {
    /// The order of the file.
    #[default]
    File,
    /// What is left to decide, the most first.
    Undecided,
    /// The worst ratio, the largest first.
    Worst,
    /// Flags, the most first.
    Flagged,
    /// Suspects, the most first.
    Suspects,
    /// Samples that were not judged, the most first.
    Unchecked,
    /// Samples, the most first.
    Samples,
    /// The names, by the alphabet.
    Name,
}

impl SortColumn {
    /// All of them, in the order in which a key goes through them.
    pub const ALL: [Self; 8] = [
        Self::File,
        Self::Undecided,
        Self::Worst,
        Self::Flagged,
        Self::Suspects,
        Self::Unchecked,
        Self::Samples,
        Self::Name,
    ];

    /// What it sorts by, in words.
    #[must_use]
    pub fn words(self) -> &'static str {
        match self {
            Self::File => "the order of the file",
            Self::Undecided => "what is left to decide",
            Self::Worst => "the worst ratio",
            Self::Flagged => "flags",
            Self::Suspects => "suspects",
            Self::Unchecked => "unchecked samples",
            Self::Samples => "samples",
            Self::Name => "name",
        }
    }

    /// The next one.
    #[must_use]
    pub fn next(self) -> Self {
        let at = Self::ALL.iter().position(|c| *c == self).unwrap_or(0);
        Self::ALL[(at + 1) % Self::ALL.len()]
    }

    /// Which of two summaries stands first.
    fn order(self, a: &ChannelSummary, b: &ChannelSummary) -> Ordering {
        let descending = |of: fn(&ChannelSummary) -> usize| of(b).cmp(&of(a));
        match self {
            Self::File | Self::Name => Ordering::Equal,
            Self::Undecided => descending(|s| s.undecided.len()),
            Self::Worst => b.worst.unwrap_or(0.0).total_cmp(&a.worst.unwrap_or(0.0)),
            Self::Flagged => descending(|s| s.counts.flagged),
            Self::Suspects => descending(|s| s.counts.suspects),
            Self::Unchecked => descending(|s| s.counts.unchecked),
            Self::Samples => descending(|s| s.counts.present),
        }
    }
}

/// How far the review of a channel is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ReviewState {
    /// It has not been judged yet.
    Waiting,
    /// It could not be judged.
    Failed,
    /// Nothing is flagged, and nothing is decided.
    NothingFlagged,
    /// Nothing is decided yet.
    New,
    /// Some flags are decided on.
    InReview,
    /// All flags are decided on.
    Done,
}

impl ReviewState {
    /// That of a channel.
    #[must_use]
    pub fn of(state: &ChannelState) -> Self {
        match &state.summary {
            None => Self::Waiting,
            Some(Err(_)) => Self::Failed,
            Some(Ok(summary)) => match (summary.decided(), summary.undecided.len()) {
                (0, 0) => Self::NothingFlagged,
                (0, _) => Self::New,
                (_, 0) => Self::Done,
                _ => Self::InReview,
            },
        }
    }

    /// True where a person is still needed.
    #[must_use]
    pub fn needs_review(self) -> bool {
        matches!(self, Self::Failed | Self::New | Self::InReview)
    }
}

impl ChannelsOverview {
    /// The overview with the cursor on the channel that is on the screen.
    #[must_use]
    pub fn of(model: &Model) -> Self {
        Self { plan: model.shown, ..Self::default() }
    }

    /// The plans of the rows, in their order: those in whose names every word of the filter occurs.
    #[must_use]
    pub fn rows(&self, model: &Model) -> Vec<usize> {
        let words: Vec<String> = self.filter.value().split_whitespace().map(str::to_lowercase).collect();
        let name = |plan: usize| printable(&model.session.plans[plan].channel);
        let fits = |plan: &usize| {
            if words.is_empty() {
                return true;
            }
            let name = name(*plan).to_lowercase();
            words.iter().all(|word| name.contains(word.as_str()))
        };
        let mut rows: Vec<usize> = (0..model.session.plans.len()).filter(fits).collect();
        let summary = |plan: usize| model.channels[plan].summary.as_ref().and_then(|s| s.as_ref().ok());
        match self.sort {
            SortColumn::File => {}
            SortColumn::Name => rows.sort_by_cached_key(|plan| name(*plan).to_lowercase()),
            column => rows.sort_by(|a, b| match (summary(*a), summary(*b)) {
                (Some(a), Some(b)) => column.order(a, b),
                // Channels without a summary come last.
                (a, b) => b.is_some().cmp(&a.is_some()),
            }),
        }
        if self.reversed {
            rows.reverse();
        }
        rows
    }

    /// The plans that an action is about: those that are selected, or that of the row under the cursor.
    #[must_use]
    pub fn targets(&self) -> Vec<usize> {
        if self.selected.is_empty() { vec![self.plan] } else { self.selected.iter().copied().collect() }
    }
}
