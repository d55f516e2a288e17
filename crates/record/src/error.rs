//! The error of the program: what the numbers complain of, and what goes wrong with files. Every variant says what went wrong, where, and the way out.

use std::path::{Path, PathBuf};

use wildpoint_core::error::{Error as CoreError, MORE};
pub use wildpoint_core::error::{nearest, one_of};
use wildpoint_core::memory::{Full, words};
use wildpoint_core::stop::Stopped;

/// What every fallible function of the library returns.
pub type Result<T> = std::result::Result<T, Error>;

/// Everything that can go wrong, worded for the person at the keyboard.
#[derive(Debug, thiserror::Error)]
pub enum Error {
    /// A file or folder could not be read or written.
    #[error("{}: cannot {action}: {source}\n  {}", shown(path), way_out(action, source.kind()))]
    Io {
        /// What was being done: `read`, `write`, …
        action: &'static str,
        /// The file or folder.
        path: PathBuf,
        /// What the operating system said.
        source: std::io::Error,
    },
    /// An input file is not what the loader can use.
    #[error("{}{}: {what}\n  {help}", shown(path), line.map(|l| format!(":{l}")).unwrap_or_default())]
    Input {
        /// The input file.
        path: PathBuf,
        /// Line in the file, from 1, where one can be named.
        line: Option<u64>,
        /// What is wrong.
        what: String,
        /// What the user can do.
        help: String,
    },
    /// A session file cannot be used.
    #[error("{}{}: {what}\n  {help}", shown(path), line.map(|l| format!(":{l}")).unwrap_or_default())]
    Session {
        /// The session file.
        path: PathBuf,
        /// Line in the file, from 1, where one can be named.
        line: Option<usize>,
        /// What is wrong, naming the key.
        what: String,
        /// What the user can do.
        help: String,
    },
    /// A method, parameter, column or other name or value given by the user does not fit.
    #[error("{what}\n  {help}")]
    Usage {
        /// What does not fit.
        what: String,
        /// What would fit.
        help: String,
    },
    /// An output would overwrite a file.
    #[error("{}: already exists, nothing was written\n  give another name, or --force to overwrite it", shown(.0))]
    Exists(PathBuf),
    /// An output would overwrite the input.
    #[error("{}: this is the input, which is never overwritten\n  give the output another name", shown(.0))]
    IsInput(PathBuf),
    /// The input is not the one the session was made with.
    #[error(
        "{}: the data are not those of the session: {what}\n  restore the file, or go on with --accept-changed-data",
        shown(path)
    )]
    Changed {
        /// The input file.
        path: PathBuf,
        /// The first difference that can be seen.
        what: String,
    },
    /// Rows were added to the input since the session was saved.
    #[error("{}: {what}\n  --accept-appended judges them too, every decision stays", shown(path))]
    Appended {
        /// The input file.
        path: PathBuf,
        /// How many rows.
        what: String,
    },
    /// Something takes more memory than the program may use.
    #[error("{subject}: this needs more than the {} of memory that the program may use\n  {MORE}", words(full.limit))]
    Memory {
        /// The file, or what is to be done.
        subject: String,
        /// The limit.
        full: Full,
    },
    /// Work was abandoned because nobody waits for it any more.
    #[error("the work was stopped before it ended\n  run it again")]
    Stopped,
}

impl From<CoreError> for Error {
    fn from(e: CoreError) -> Self {
        match e {
            CoreError::Usage { what, help } => Self::Usage { what, help },
            CoreError::Memory { subject, full } => Self::Memory { subject, full },
            CoreError::Stopped => Self::Stopped,
        }
    }
}

impl From<Stopped> for Error {
    fn from(_: Stopped) -> Self {
        Self::Stopped
    }
}

impl Error {
    /// An [`Error::Io`] for `path`.
    pub fn io(action: &'static str, path: impl AsRef<Path>) -> impl FnOnce(std::io::Error) -> Self {
        let path = path.as_ref().to_path_buf();
        move |source| Self::Io { action, path, source }
    }

    /// An [`Error::Memory`] for the file `path`.
    pub fn memory(path: impl AsRef<Path>) -> impl FnOnce(Full) -> Self {
        let subject = shown(path.as_ref());
        move |full| Self::Memory { subject, full }
    }

    /// An [`Error::Usage`].
    pub fn usage(what: impl Into<String>, help: impl Into<String>) -> Self {
        Self::Usage { what: what.into(), help: help.into() }
    }

    /// An [`Error::Input`] without a line.
    pub fn input(path: impl AsRef<Path>, what: impl Into<String>, help: impl Into<String>) -> Self {
        Self::Input { path: path.as_ref().to_path_buf(), line: None, what: what.into(), help: help.into() }
    }
}

/// An error on one line: what is wrong; the way out.
#[must_use]
pub fn on_one_line(error: &dyn std::fmt::Display) -> String {
    error.to_string().replace("\n  ", "; ")
}

/// A path on one line: a line end in a name would pass for the end of what we say.
fn shown(path: &Path) -> String {
    path.display().to_string().replace('\n', "\\n")
}

/// What helps against a refusal of the operating system.
fn way_out(action: &str, kind: std::io::ErrorKind) -> &'static str {
    use std::io::ErrorKind as Kind;
    match kind {
        Kind::NotFound if action == "read" => "check its name; it is looked for from the current folder",
        Kind::NotFound => "make the folder first, or name one that is there",
        Kind::PermissionDenied => "change its permissions, or name another place",
        Kind::StorageFull | Kind::QuotaExceeded => "make room, or name a place on another disk",
        Kind::FileTooLarge => {
            "raise the limit on the size of a file (ulimit -f), or name a place that takes larger ones"
        }
        Kind::ReadOnlyFilesystem => "name a place that can be written to",
        _ => "see to what the system says, then try again",
    }
}
