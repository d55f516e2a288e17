//! What a session records of an archive: `[archive]`.

use std::collections::HashSet;
use std::path::Path;

use serde::{Deserialize, Serialize};
use toml::Table;

use super::{Summary, archive_digest};
use crate::error::{Error, Result};
use crate::session::digest::Digest;
use crate::session::document::{quoted, read_with_texts};

/// The key of a session file.
const KEY: &str = "archive";

/// The result of a session on an archive.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Archive {
    /// The column that told tracks apart, where one was named beside the session.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub track: Option<String>,
    /// The column of the time, where one was named beside the session.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub time: Option<String>,
    /// Its tracks.
    pub tracks: usize,
    /// Its rows.
    pub rows: usize,
    /// Outliers in all channels of all tracks.
    pub flagged: usize,
    /// SHA-256 over the lines of all summaries.
    pub digest: String,
}

impl Archive {
    /// The result that `summaries` tell.
    #[must_use]
    pub fn of(summaries: &[Summary]) -> Self {
        let mut seen = HashSet::new();
        let first = summaries.iter().filter(|summary| seen.insert(summary.track.as_str()));
        let rows = first.map(|summary| summary.counts.rows).sum();
        Self {
            track: None,
            time: None,
            tracks: seen.len(),
            rows,
            flagged: summaries.iter().map(|summary| summary.counts.flagged).sum(),
            digest: archive_digest(summaries.iter().map(Summary::line).collect()),
        }
    }

    /// How this result differs from what a session recorded; empty when it does not.
    #[must_use]
    pub fn differences(&self, recorded: Option<&Self>) -> Vec<String> {
        let Some(then) = recorded else {
            return vec!["the session has no [archive] to compare with: --record writes it".into()];
        };
        let numbers = [
            ("tracks", self.tracks, then.tracks),
            ("rows", self.rows, then.rows),
            ("samples flagged", self.flagged, then.flagged),
        ];
        let differing = numbers.into_iter().filter(|(_, now, then)| now != then);
        let mut found: Vec<String> =
            differing.map(|(what, now, then)| format!("{now} {what}, the session recorded {then}")).collect();
        if self.digest != then.digest {
            found.push(format!("the digest of the archive is {}, the session recorded {}", self.digest, then.digest));
        }
        found
    }

    fn lines(&self) -> String {
        let mut lines = format!("\n[{KEY}]\n");
        for (key, name) in [("track", &self.track), ("time", &self.time)] {
            lines.extend(name.iter().map(|name| format!("{key} = {}\n", quoted(name))));
        }
        for (key, number) in [("tracks", self.tracks), ("rows", self.rows), ("flagged", self.flagged)] {
            lines += &format!("{key} = {number}\n");
        }
        lines + &format!("digest = {}\n", quoted(&self.digest))
    }
}

/// What the session at `path` recorded of an archive, and what was changed in it since it was saved.
#[derive(Debug)]
pub struct Recorded {
    /// What it recorded.
    pub archive: Option<Archive>,
    /// What was changed, in words; none where the file does not tell (format 1).
    pub altered: Option<Vec<String>>,
}

/// Reads what the session at `path` recorded of an archive.
///
/// # Errors
/// As [`crate::session::read`].
pub fn recorded(path: &Path) -> Result<Recorded> {
    let read = read_with_texts(path)?;
    Ok(Recorded { archive: read.archive, altered: read.altered })
}

/// The text of the session file at `path`, which is `text` now, with `archive` recorded in it.
///
/// # Errors
/// [`Error::Session`] for a session of format 1, one that was changed since it was saved, or one in whose text the place
/// is not found.
pub fn with_archive(path: &Path, text: &str, archive: &Archive) -> Result<String> {
    let fault = |what: &str| {
        let help = "save the session again, in the workbench or with --save-session".to_owned();
        Error::Session { path: path.to_path_buf(), line: None, what: what.to_owned(), help }
    };
    match recorded(path)?.altered {
        None => return Err(fault("format 1 has no [archive]")),
        // A new digest would hide the change.
        Some(altered) if !altered.is_empty() => return Err(fault(&altered.join("; "))),
        Some(_) => {}
    }
    let table = |text: &str| toml::from_str::<Table>(text).map_err(|e| fault(e.message()));
    let mut kept = String::new();
    let mut own = false;
    for line in text.lines() {
        if let Some(name) = line.trim_start().strip_prefix('[') {
            own = [KEY, "digest"].iter().any(|key| name.trim_end() == format!("{key}]"));
        }
        if !own {
            kept += line;
            kept.push('\n');
        }
    }
    let mut before = table(text)?;
    before.remove(KEY);
    before.remove("digest");
    if table(&kept)? != before {
        return Err(fault("its [archive] or [digest] is not written as this program writes it"));
    }
    let mut whole = kept.trim_end().to_owned() + "\n" + &archive.lines();
    whole += &Digest::of(path, &whole)?.lines();
    Ok(whole)
}
