//! When a report was made, by whom, and what lies beside it.

use std::path::Path;

use crate::clock;

/// What a report says of itself.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Byline {
    /// The analyst.
    pub analyst: Option<String>,
    /// The day, as in 2026-03-04.
    pub date: String,
    /// The file of all flags, as a link from the report finds it; none where it is not written.
    pub flags: Option<String>,
}

impl Byline {
    /// Today, in UTC.
    #[must_use]
    pub fn today(analyst: Option<String>) -> Self {
        let date = clock::now().to_zoned(jiff::tz::TimeZone::UTC).date().to_string();
        Self { analyst: analyst.filter(|name| !name.trim().is_empty()), date, flags: None }
    }

    /// The same of a report at `report` with the table of flags at `flags`: a link where both are in one folder.
    #[must_use]
    pub fn beside(&self, report: &Path, flags: Option<&Path>) -> Self {
        let name = flags.filter(|flags| flags.parent() == report.parent()).and_then(Path::file_name);
        Self { flags: name.map(|name| name.to_string_lossy().into_owned()), ..self.clone() }
    }

    /// In a line.
    pub(super) fn words(&self) -> String {
        match &self.analyst {
            Some(analyst) => format!("{}, {analyst}", self.date),
            None => self.date.clone(),
        }
    }
}
