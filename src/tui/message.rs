//! What can happen to the workbench, and what it asks the outside for.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use ratatui::crossterm::event::{KeyEvent, MouseEvent};

use super::advice::{Advice, Steps};
use super::consensus::Consensus;
use super::detectability::{Finding, Subject};
use super::files::{News, Task};
use super::smoothing::Smoothed;
use super::survey::ChannelSummary;
use crate::error::{Error, Result};
use crate::plot::Drawn;
use crate::track::Standing;

/// Something that happened.
#[expect(clippy::large_enum_variant, reason = "there are few of them, and each is moved a few times")]
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
    /// This many methods have answered about a channel.
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
    /// More is known of how small a wild point is found on a channel.
    Studied {
        /// The job it answers.
        generation: u64,
        /// Index of the plan.
        plan: usize,
        /// What came out so far.
        finding: Finding,
        /// Rounds that are done, of all.
        rounds: [usize; 2],
    },
    /// A channel was judged for the overview.
    Surveyed {
        /// The job it answers.
        generation: u64,
        /// Index of the plan.
        plan: usize,
        /// What came out.
        summary: Result<Arc<ChannelSummary>>,
    },
    /// What one step of the active parameter of a channel changes is known.
    Stepped {
        /// Index of the plan.
        plan: usize,
        /// The changes, and what they were found for.
        steps: Box<Steps>,
    },
    /// The result on the screen was smoothed.
    Smoothed(Box<Smoothed>),
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
    /// Something about files that was asked for.
    Files(News),
    /// The file of the record is not as it was at the last look.
    Record(Standing),
    /// Something about the journal.
    Journal(JournalNews),
}

/// What happened to the journal.
#[derive(Debug)]
pub enum JournalNews {
    /// It cannot be written. The changes are kept in memory, and writing them is tried again.
    Failing(Error),
    /// All that was missing is written.
    Resumed,
}

/// What was written.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Written {
    /// The session, when the document was at this revision.
    Session {
        /// The revision of the document.
        revision: u64,
        /// Quit when it has worked.
        then_quit: bool,
    },
    /// Outputs of the result, all together.
    Exported {
        /// What they are.
        outputs: Vec<Output>,
        /// The revision of the document.
        revision: u64,
    },
}

impl Written {
    /// Where the session was written, if it was.
    #[must_use]
    pub fn session<'a>(&'a self, path: &'a Path) -> Option<&'a Path> {
        match self {
            Self::Session { .. } => Some(path),
            Self::Exported { outputs, .. } => {
                outputs.iter().find(|o| o.kind == OutputKind::Session).map(|o| o.path.as_path())
            }
        }
    }

    /// The revision of the document that was written.
    #[must_use]
    pub fn revision(&self) -> u64 {
        match self {
            Self::Session { revision, .. } | Self::Exported { revision, .. } => *revision,
        }
    }
}

/// A file to write.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Output {
    /// What it holds.
    pub kind: OutputKind,
    /// Where it goes.
    pub path: PathBuf,
}

/// What an output holds.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum OutputKind {
    /// The input with repaired and removed cells.
    Cleaned,
    /// Every flag with its evidence.
    Flags,
    /// A row for every sample.
    Diagnostics,
    /// The report.
    Report,
    /// The session.
    Session,
    /// The decisions alone: they need no record.
    Decisions,
}

impl OutputKind {
    /// All of them, in the order of the dialog.
    pub const ALL: [Self; 6] =
        [Self::Cleaned, Self::Flags, Self::Diagnostics, Self::Report, Self::Session, Self::Decisions];

    /// Its name, what a file of it is called after the name of the record, and what it is in a line.
    fn row(self) -> (&'static str, &'static str, &'static str) {
        match self {
            Self::Cleaned => {
                ("cleaned", ".clean.csv", "the record with outliers repaired or removed; all other bytes unchanged")
            }
            Self::Flags => ("flags", ".flags.csv", "a row for every flag and decision, with its evidence"),
            Self::Diagnostics => ("diagnostics", ".diagnostics.csv", "a row for every sample"),
            Self::Report => ("report", ".html", "one page: plots, settings, flags (.md: Markdown)"),
            Self::Session => ("session", ".wild.toml", "settings and decisions: reproduces this result"),
            Self::Decisions => ("decisions", ".decisions.csv", "a row for every decision; does not need the record"),
        }
    }

    /// Its name in the dialog.
    #[must_use]
    pub fn name(self) -> &'static str {
        self.row().0
    }

    /// What a file of it is called after the name of the record.
    #[must_use]
    pub fn ending(self) -> &'static str {
        self.row().1
    }

    /// What it is, in a line.
    #[must_use]
    pub fn help(self) -> &'static str {
        self.row().2
    }
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
#[expect(clippy::large_enum_variant, reason = "there are few of them, and each is moved a few times")]
#[derive(Debug, Clone, PartialEq)]
pub enum Effect {
    /// Judge the channel of this plan under the session as it is now.
    Analyse(usize),
    /// Find what a step of the active parameter of this plan changes and, where they are not known, the counts along
    /// its multiplier, when nothing else is to do.
    Advise(usize),
    /// Ask all methods about the channel of this plan.
    Poll(usize),
    /// Abandon asking them.
    CancelPoll,
    /// Measure on the channel of this plan how small a wild point is found.
    Study(usize, Subject),
    /// Judge the channels of these plans for the overview, the first first.
    Survey(Vec<usize>),
    /// Abandon judging for the overview: it was closed.
    CancelSurvey,
    /// Abandon measuring it.
    CancelStudy,
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
    /// Write outputs of the result: all of them, or none.
    Export {
        /// What, and where.
        outputs: Vec<Output>,
        /// Whether they may take the place of files that are there.
        overwrite: bool,
    },
    /// Something about files.
    Files(Task),
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
