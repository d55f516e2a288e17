//! The session: all that changes a result, and the pipeline from it to that result. The screen edits it, `replay`
//! renders it; this is the only place where method, review and repair meet.

use std::path::PathBuf;

use crate::error::{Error, Result, nearest};
use crate::method::{self, METHODS, Method};
use crate::param::{Settings, find};
use crate::repair;
use crate::review::Decisions;
use crate::track::{LoadOptions, Source, Track};

mod analysis;
mod ballot;
mod cleaned;
mod command_line;
mod document;
mod edit;
pub mod journal;
mod replay;
mod save;
pub mod sweep;

pub use analysis::{Counts, Detection, Fill, Mark, Outcome, Place, Run, detect, detect_together, settle};
pub use ballot::{Agreement, Ballot, candidates};
pub use cleaned::{changes, clean_sha256, write_cleaned};
pub use command_line::{clean_command, quoted, replay_command};
pub use document::{parse, read, render};
pub use edit::Edit;
pub use replay::{Analysed, Opened, check, open, open_all};
pub use save::document;

/// The method when none is named.
pub const DEFAULT_METHOD: &str = "two-sided";

/// A document: which data, what to do with which channel, and what came out when it was saved.
#[derive(Debug, Clone)]
pub struct Session {
    /// The record it belongs to.
    pub data: Data,
    /// One plan for each channel that is worked on.
    pub plans: Vec<Plan>,
    /// What came out when it was saved.
    pub result: Option<Recorded>,
}

/// The record of a session.
#[derive(Debug, Clone)]
pub struct Data {
    /// Where the record is.
    pub source: Source,
    /// SHA-256 of its bytes, lower-case hexadecimal.
    pub sha256: String,
    /// Its data rows.
    pub rows: usize,
    /// Sums that name the row when a single one has changed; not in sessions written by hand.
    pub row_check: Option<String>,
    /// How to load it.
    pub options: LoadOptions,
}

/// What to do with one channel.
#[derive(Debug, Clone, PartialEq)]
pub struct Plan {
    /// Name of the channel.
    pub channel: String,
    /// The machine's part.
    pub setup: Setup,
    /// The analyst's part.
    pub decisions: Decisions,
}

/// Method and repair with their settings.
#[derive(Clone)]
pub struct Setup {
    /// How wild points are found.
    pub method: &'static dyn Method,
    /// Its knobs.
    pub settings: Settings,
    /// Name of the channel that measures the rate, for methods that need one.
    pub rate: Option<String>,
    /// The knobs of repair, [`repair::PARAMS`].
    pub repair: Settings,
}

/// What came out when the session was saved.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Recorded {
    /// Outliers in all channels, after the analyst's decisions.
    pub flagged: usize,
    /// SHA-256 of the cleaned file.
    pub clean_sha256: String,
}

impl std::fmt::Debug for Setup {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Setup")
            .field("method", &self.method.about().id)
            .field("settings", &self.settings)
            .field("rate", &self.rate)
            .field("repair", &self.repair)
            .finish()
    }
}

impl PartialEq for Setup {
    fn eq(&self, other: &Self) -> bool {
        self.same_detection(other) && self.repair == other.repair
    }
}

/// Which set of values a method starts with.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Preset {
    /// Values that work on real tracks.
    #[default]
    Default,
    /// What the source document prescribes.
    Paper,
}

impl Preset {
    /// The values of `method`.
    #[must_use]
    pub fn settings(self, method: &dyn Method) -> Settings {
        match self {
            Self::Default => Settings::defaults(method.about().params),
            Self::Paper => Settings::paper(method.about().params),
        }
    }
}

/// The method with this id.
///
/// # Errors
/// [`Error::Usage`] with the methods there are and the nearest.
pub fn method_of_id(id: &str) -> Result<&'static dyn Method> {
    method::find(id).ok_or_else(|| {
        let ids: Vec<&str> = METHODS.iter().map(|m| m.about().id).collect();
        let hint = nearest(id, ids.iter().copied()).map_or(String::new(), |k| format!("did you mean {k}? "));
        Error::usage(format!("{id}: there is no such method"), format!("{hint}methods: {}", ids.join(", ")))
    })
}

impl Setup {
    /// `method` with a preset and the default repair.
    #[must_use]
    pub fn new(method: &'static dyn Method, preset: Preset) -> Self {
        Self { method, settings: preset.settings(method), rate: None, repair: Settings::defaults(repair::PARAMS) }
    }

    /// True when both find the same outliers: they differ in the repair at most.
    #[must_use]
    pub fn same_detection(&self, other: &Self) -> bool {
        self.method.about().id == other.method.about().id && self.settings == other.settings && self.rate == other.rate
    }

    /// True when this channel's detection depends on the other channels that share the setup.
    #[must_use]
    pub fn together(&self) -> bool {
        self.method.together(&self.settings)
    }

    /// The default method with its defaults.
    #[must_use]
    pub fn standard() -> Self {
        let method = method::find(DEFAULT_METHOD).unwrap_or(METHODS[0]);
        Self::new(method, Preset::Default)
    }

    /// Sets a parameter of the method or of repair from text.
    ///
    /// # Errors
    /// [`Error::Usage`] for an unknown key or an illegal value; nothing is changed then.
    pub fn set_text(&mut self, key: &str, text: &str) -> Result<()> {
        let id = self.method.about().id;
        let of_repair = key != repair::METHOD.key && repair::PARAMS.iter().any(|p| p.key == key);
        if of_repair && self.settings.get(key).is_none() {
            return self.repair.set_text("repair", key, text);
        }
        find(self.method.about().params, id, key)?;
        self.settings.set_text(id, key, text)
    }
}

impl Session {
    /// A session on `track` with one plan for each of its channels.
    #[must_use]
    pub fn new(track: &Track, mut options: LoadOptions, setup: &Setup) -> Self {
        // What was recognised is recorded, so that a later version recognises nothing else.
        options.time.get_or_insert_with(|| match track.time.column {
            Some(_) if !track.time.part_columns.is_empty() => {
                let names: Vec<&str> =
                    track.time.part_columns.iter().map(|c| track.columns[*c].name.as_str()).collect();
                names.join(",")
            }
            Some(column) => track.columns[column].name.clone(),
            None => "sample".into(),
        });
        if let Some(column) = track.track_column() {
            options.track.get_or_insert_with(|| track.columns[column].name.clone());
        }
        let plan = |name: &str| Plan { channel: name.into(), setup: setup.clone(), decisions: Decisions::default() };
        Self {
            data: Data {
                source: track.source.clone(),
                sha256: track.sha256.clone(),
                rows: track.rows,
                row_check: None,
                options,
            },
            plans: track.channels.iter().map(|c| plan(&c.name)).collect(),
            result: None,
        }
    }
}

/// A path without folders that it enters only to leave them again: it is read by people, and from it the names of
/// outputs are made. A link is kept with the `..` after it, which leads to where the link points.
fn tidied(path: &std::path::Path) -> PathBuf {
    use std::path::Component;
    let mut out = PathBuf::new();
    for part in path.components() {
        let entered = matches!(out.components().next_back(), Some(Component::Normal(_)));
        if part == Component::ParentDir && entered && !out.is_symlink() {
            out.pop();
        } else {
            out.push(part);
        }
    }
    if out.as_os_str().is_empty() { PathBuf::from(".") } else { out }
}

/// The folder a path lies in, `.` for a bare name.
#[must_use]
pub fn folder_of(path: &std::path::Path) -> PathBuf {
    match path.parent() {
        Some(p) if !p.as_os_str().is_empty() => p.to_path_buf(),
        _ => PathBuf::from("."),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_path_enters_no_folder_to_leave_it_again() {
        let given = ["/a/b/../../c/d.csv", "../c/d.csv", "a/../d.csv", "d.csv"];
        let made = given.map(|p| tidied(std::path::Path::new(p)).display().to_string());
        assert_eq!(made, ["/c/d.csv", "../c/d.csv", "d.csv", "d.csv"]);
    }
}
