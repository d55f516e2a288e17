//! Dialogs about files: what is chosen, typed and known in each.

use std::path::PathBuf;

use tui_input::Input;

use super::super::files::{FileEntry, Request, Seen};
use super::super::message::{Effect, OutputKind};
use crate::track::{FileLine, LoadOptions, Source};

/// A dialog about files.
#[expect(clippy::large_enum_variant, reason = "there are few of them, and each is moved a few times")]
#[derive(Debug)]
pub enum Dialog {
    /// A file to open is chosen.
    Browser(Browser),
    /// How a record is loaded is corrected.
    Loader(LoaderForm),
    /// What is written, and where.
    Export(ExportForm),
    /// A record is being loaded.
    Waiting(Waiting),
    /// Open this although something is not saved?
    Unsaved(Request),
    /// Write over a file that is there?
    Over(Over),
}

/// The picker of files.
#[derive(Debug, Default)]
pub struct Browser {
    /// The folder; relative until it has been listed.
    pub folder: PathBuf,
    /// Recent files, folders and files.
    pub entries: Vec<FileEntry>,
    /// What was typed to narrow them, or a path.
    pub filter: Input,
    /// Index of the choice among those that fit.
    pub choice: usize,
    /// True until the folder has been listed.
    pub listing: bool,
    /// What is known of the choice.
    pub seen: Option<(PathBuf, Result<Seen, String>)>,
    /// What the user should know, and whether it is an error.
    pub said: Option<(String, bool)>,
}

impl Browser {
    /// The lines that fit what was typed: every word of it occurs in the name. Hidden files only when they are asked
    /// for with a dot.
    #[must_use]
    pub fn narrowed(&self) -> Vec<&FileEntry> {
        let text = self.filter.value().to_lowercase();
        let words: Vec<&str> = text.split_whitespace().collect();
        let fits = |e: &&FileEntry| {
            let name = e.name.to_lowercase();
            let hidden = !e.recent && name.starts_with('.') && !text.starts_with('.');
            !hidden && words.iter().all(|w| name.contains(w))
        };
        self.entries.iter().filter(fits).collect()
    }

    /// The line under the cursor.
    #[must_use]
    pub fn chosen(&self) -> Option<&FileEntry> {
        self.narrowed().into_iter().nth(self.choice)
    }
}

/// How a record is loaded, to be corrected.
#[derive(Debug)]
pub struct LoaderForm {
    /// The record.
    pub source: Source,
    /// How it is loaded.
    pub options: LoadOptions,
    /// True for the record that is open.
    pub again: bool,
    /// Index of the field under the cursor.
    pub choice: usize,
    /// The text of that field while it is typed.
    pub typing: Option<Input>,
    /// What that makes of the record.
    pub seen: Option<Result<Seen, String>>,
    /// True until what is shown is that of the options.
    pub stale: bool,
    /// Names of the columns, as last seen.
    pub columns: Vec<String>,
    /// The first lines of the file.
    pub lines: Vec<FileLine>,
    /// The dialog that it was opened from.
    pub back: Option<Box<Dialog>>,
}

/// What is written, and where.
#[derive(Debug)]
pub struct ExportForm {
    /// One row for each kind of output.
    pub rows: Vec<ExportRow>,
    /// Index of the row under the cursor.
    pub choice: usize,
    /// The name in that row while it is typed.
    pub typing: Option<Input>,
}

/// A file that may be written.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct ExportRow {
    /// What it holds.
    pub kind: OutputKind,
    /// Whether it is written.
    pub on: bool,
    /// Where.
    pub path: PathBuf,
    /// True when such a file already exists.
    pub there: bool,
}

/// A record that is being loaded.
#[derive(Debug)]
pub struct Waiting {
    /// By which the answer is known.
    pub ticket: u64,
    /// Its name.
    pub name: String,
    /// The dialog that it was asked for in.
    pub back: Option<Box<Dialog>>,
}

/// A file that would be written over.
#[derive(Debug)]
pub struct Over {
    /// The file.
    pub path: PathBuf,
    /// What writes it, allowed to do so.
    pub again: Effect,
    /// The dialog that it was asked for in.
    pub back: Option<Box<Dialog>>,
}
