//! What a command wrote, and what it did not.

use std::path::{Path, PathBuf};

use serde::Serialize;

use crate::counted::counted;
use crate::track::printable;

/// A file that a command can write: what it is, and the option that asks for it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Kind {
    /// What it is.
    pub name: &'static str,
    /// Its option.
    pub option: &'static str,
}

const fn kind(name: &'static str, option: &'static str) -> Kind {
    Kind { name, option }
}

/// The cleaned record.
pub const CLEANED: Kind = kind("cleaned record", "-o");
/// The table of flags.
pub const FLAGS: Kind = kind("flags", "--flags");
/// The report.
pub const REPORT: Kind = kind("report", "--report");
/// The session.
pub const SESSION: Kind = kind("session", "--save-session");
/// The changed cells.
pub const CHANGES: Kind = kind("changes", "--changed");
/// A row for each sample.
pub const DIAGNOSTICS: Kind = kind("diagnostics", "--diagnostics");

/// A file that was written.
#[derive(Debug, Clone, Serialize)]
pub struct WrittenFile {
    /// What it is.
    pub what: &'static str,
    /// Where it is.
    pub path: PathBuf,
    /// Cells that differ from the record, and rows that were added; of the cleaned record alone.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub changed_cells: Option<usize>,
}

/// What a command wrote, and what it could have written.
#[derive(Debug, Clone, Default)]
pub struct Written {
    /// The files, in the order in which they were asked for.
    pub files: Vec<WrittenFile>,
    /// What was not asked for.
    pub absent: Vec<Kind>,
    /// True for a dry run, which writes nothing.
    pub dry: bool,
}

impl Written {
    /// Notes that a file is written to `path`, if it is asked for.
    pub fn note(&mut self, kind: Kind, path: Option<&Path>, changed_cells: Option<usize>) {
        match path {
            Some(path) => {
                self.files.push(WrittenFile { what: kind.name, path: path.to_path_buf(), changed_cells });
            }
            None => self.absent.push(kind),
        }
    }

    /// In a line or two.
    #[must_use]
    pub fn text(&self) -> String {
        let file = |f: &WrittenFile| {
            let changed = f.changed_cells.map_or(String::new(), |n| format!(", {} changed", counted(n, "cell")));
            format!("{} ({}{changed})", printable(&f.path.display().to_string()), f.what)
        };
        let files: Vec<String> = self.files.iter().map(file).collect();
        let absent: Vec<String> = self.absent.iter().map(|kind| format!("{} ({})", kind.name, kind.option)).collect();
        let verb = if self.dry { "would write" } else { "wrote" };
        match (files.is_empty(), absent.is_empty()) {
            (true, _) => format!("wrote nothing; options: {}\n", absent.join(", ")),
            (false, true) => format!("{verb} {}\n", files.join(", ")),
            (false, false) => format!("{verb} {}\nnot written: {}\n", files.join(", "), absent.join(", ")),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_written_and_what_is_not_is_told() {
        let mut written = Written::default();
        written.note(CLEANED, Some(Path::new("clean.csv")), Some(1));
        written.note(FLAGS, None, None);
        assert_eq!(written.text(), "wrote clean.csv (cleaned record, 1 cell changed)\nnot written: flags (--flags)\n");
        assert!(Written { dry: true, ..written }.text().starts_with("would write clean.csv"));
        let nothing = Written { absent: vec![CLEANED], ..Written::default() };
        assert_eq!(nothing.text(), "wrote nothing; options: cleaned record (-o)\n");
    }
}
