//! What lies over the panels.

use tui_input::Input;

use super::super::journal::Found;
use super::{ChannelsOverview, Dialog};
use crate::session::journal::Conflict;

/// What lies over the panels.
#[derive(Debug, Default)]
pub enum Overlay {
    /// Nothing.
    #[default]
    None,
    /// The help, from this line on, filtered by what was typed.
    Help(Input, usize),
    /// A list to choose from.
    Picker(Picker),
    /// All channels, a row for each.
    Overview(Box<ChannelsOverview>),
    /// A line to type in.
    Prompt(Prompt),
    /// The command line that is equivalent, without a screen, and what to know about it.
    CommandLine(String, &'static str),
    /// A dialog about files.
    Files(Box<Dialog>),
    /// Quit although something is not saved?
    ConfirmQuit,
    /// What was done, at the moment after this many edits.
    Journal(usize),
    /// Recover what an earlier workbench left? The newest first.
    Recover(Vec<Found>),
    /// Which side holds, where session and journal contradict each other?
    Merge(Box<Merging>),
}

/// Work that is being taken in although some of it contradicts the session.
#[derive(Debug)]
pub struct Merging {
    /// What is offered; the first is taken in.
    pub offered: Vec<Found>,
    /// In what it contradicts the session.
    pub conflicts: Vec<Conflict>,
    /// The conflicts in which the journal holds, by their indices.
    pub chosen: Vec<usize>,
    /// The conflict that is asked about.
    pub at: usize,
}

/// A list to choose from.
#[derive(Debug)]
pub struct Picker {
    /// What is chosen.
    pub kind: PickerKind,
    /// What was typed to narrow it.
    pub filter: Input,
    /// Index of the choice among those that fit.
    pub choice: usize,
}

/// What a picker chooses.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum PickerKind {
    /// A method.
    Method,
    /// A repair.
    Repair,
    /// A channel.
    Channel,
    /// The channel that measures the rate.
    Rate,
    /// The channel beside the one on the screen.
    Second,
}

/// A line to type in.
#[derive(Debug)]
pub struct Prompt {
    /// What it is for.
    pub kind: PromptKind,
    /// What has been typed.
    pub input: Input,
    /// What is wrong with it.
    pub error: Option<String>,
    /// The line of the list that was walked to.
    pub choice: Option<usize>,
    /// The earlier line that was recalled, by its index.
    pub recalled: Option<usize>,
}

impl Prompt {
    /// A line that begins with `text`.
    #[must_use]
    pub fn new(kind: PromptKind, text: &str) -> Self {
        Self { kind, input: text.into(), error: None, choice: None, recalled: None }
    }
}

/// What a prompt is for.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum PromptKind {
    /// A command after `:`.
    Command,
    /// Where to jump.
    Jump,
    /// Where the session is saved.
    SaveAs,
    /// The value of the active parameter.
    Value,
    /// A note on decisions.
    Note,
}
