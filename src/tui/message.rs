//! What can happen to the workbench, and what it asks the outside for.

use std::path::PathBuf;

use ratatui::crossterm::event::{KeyEvent, MouseEvent};

use super::advice::{Advice, Steps};
use super::consensus::Consensus;
use crate::error::{Error, Result};
use crate::plot::Drawn;

/// Something that happened.
#[derive(Debug)]
pub enum Message {
    /// A key was pressed.
    Key(KeyEvent),
    /// The mouse did something.
    Mouse(MouseEvent),
    /// Text was pasted.
    Paste(String),
    /// The screen has another size.
    Resize(u16, u16),
    /// The worker has judged a channel.
    Analysed {
        /// The job it answers.
        generation: u64,
        /// Index of the plan.
        plan: usize,
        /// The result, ready to draw.
        result: Result<Box<Drawn>>,
    },
    /// The counts along the multiplier of a channel are known.
    Advised {
        /// Index of the plan.
        plan: usize,
        /// The counts, and what they were found for.
        advice: Box<Advice>,
    },
    /// So many methods have answered about a channel.
    Polling {
        /// The job it answers.
        generation: u64,
        /// How many.
        done: usize,
    },
    /// All methods have answered about a channel.
    Polled {
        /// The job it answers.
        generation: u64,
        /// Index of the plan.
        plan: usize,
        /// Their votes.
        consensus: Box<Consensus>,
    },
    /// What one step of the active knob of a channel changes is known.
    Stepped {
        /// Index of the plan.
        plan: usize,
        /// The changes, and what they were found for.
        steps: Box<Steps>,
    },
    /// There is nothing to sweep under the settings as they were.
    NoAdvice,
    /// A file was written, or not.
    Written {
        /// What it was.
        what: Written,
        /// Where.
        path: PathBuf,
        /// A few words for the user, or what went wrong.
        result: Result<String>,
    },
    /// The journal can no longer be written.
    Unjournalled(Error),
}

/// What was written.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Written {
    /// The session, when the document was at this revision.
    Session {
        /// The revision of the document.
        revision: u64,
        /// Quit when it has worked.
        then_quit: bool,
    },
    /// The cleaned file.
    Cleaned,
}

/// What becomes of a journal that was offered.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Fate {
    /// Its changes are in the session now: the own journal takes its place.
    Taken {
        /// How many they are.
        changes: usize,
    },
    /// It is not wanted any more.
    Dropped,
    /// It is kept for another time.
    Left,
}

/// Something that the outside has to do.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Effect {
    /// Judge the channel of this plan under the session as it is now.
    Analyse(usize),
    /// Find what a step of the active knob of this plan changes and, where they are not known, the counts along its
    /// multiplier, when nothing else is to do.
    Advise(usize),
    /// Ask all methods about the channel of this plan.
    Poll(usize),
    /// Abandon asking them.
    CancelPoll,
    /// Abandon the running judgement.
    Cancel,
    /// Write the session.
    Save {
        /// Where.
        path: PathBuf,
        /// Whether it may take the place of a file that is there.
        overwrite: bool,
        /// Quit when it has worked.
        then_quit: bool,
    },
    /// Write the cleaned file.
    Export {
        /// Where.
        path: PathBuf,
        /// Whether it may take the place of a file that is there.
        overwrite: bool,
    },
    /// Do what was decided with a journal that was offered.
    Offered {
        /// The journal.
        path: PathBuf,
        /// What becomes of it.
        fate: Fate,
    },
    /// Put a text on the clipboard of the terminal.
    Copy(String),
    /// Take the mouse, or give it to the terminal.
    Mouse(bool),
    /// Draw everything again, whatever the terminal shows.
    Redraw,
    /// Hand the terminal back to the shell until it lets the program go on.
    Suspend,
    /// End the program.
    Quit,
}
