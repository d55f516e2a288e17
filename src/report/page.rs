//! A report: what the record is, what was done with it and what came out, as plain data that HTML and Markdown lay
//! out each in its way.

use std::path::Path;

use super::svg::Figure;
use super::{Byline, Inspection, Summary};
use crate::error::{Error, Result};
use crate::plot::FlagState;
use crate::session::{Analysed, Session, clean_command, document};
use crate::track::{Source, Track};

mod channel;
mod citations;
mod flagged;
mod measured;
mod record;

pub(super) use citations::numbered;
pub(super) use measured::Compared;

/// A session text longer than this is not put into a report.
const LONGEST_SESSION: usize = 256 << 10;

/// A report before it is laid out. Texts are as they are in the file: whoever lays them out makes them safe.
#[derive(Debug)]
pub(super) struct Page {
    /// Name of the record.
    pub(super) title: String,
    /// When it was made, and by whom.
    pub(super) byline: String,
    /// What came out, in a line.
    pub(super) outcome: String,
    /// Names and values about record and program.
    pub(super) facts: Vec<(&'static str, String)>,
    /// The columns of the record.
    pub(super) columns: Table,
    /// What the reader should know of the record.
    pub(super) notes: Vec<String>,
    /// One section for each channel.
    pub(super) channels: Vec<Section>,
    /// The documents that the methods come from: what cites them, and what they are.
    pub(super) references: Vec<(String, String)>,
    /// What to type to get the same result.
    pub(super) command: String,
    /// What is to be known about that.
    pub(super) command_note: String,
    /// The session file; none where it is too long for a report.
    pub(super) session: Option<String>,
}

/// What a report says of a channel.
#[derive(Debug)]
pub(super) struct Section {
    /// Name of the channel, with its unit.
    pub(super) title: String,
    /// Method and repair, in words.
    pub(super) method: String,
    /// What the method is for, and where it fails.
    pub(super) advice: String,
    /// Names and numbers.
    pub(super) counts: Vec<(String, String)>,
    /// The settings that matter.
    pub(super) settings: Table,
    /// What the reader should know of the result.
    pub(super) notes: Vec<String>,
    /// The methods side by side, where they were compared on the record.
    pub(super) compared: Option<Compared>,
    /// The pictures.
    pub(super) figures: Vec<Figure>,
    /// True where they show the filtered track.
    pub(super) filtered: bool,
    /// How many of the runs are shown close up; empty when all are.
    pub(super) close: String,
    /// Flags and decisions with their evidence.
    pub(super) flags: Table,
    /// How much of the table is listed, and where the rest is, or that there is nothing to list; empty when all is.
    pub(super) listed: String,
    /// The file beside the report that has the rest, where there is one.
    pub(super) beside: Option<String>,
}

/// A table of texts.
#[derive(Debug, Default)]
pub(super) struct Table {
    /// Heads of the columns, and whether they hold numbers.
    pub(super) head: Vec<(&'static str, bool)>,
    /// The rows, as wide as the head.
    pub(super) rows: Vec<Vec<String>>,
    /// For each row how its sample is marked in pictures; empty for a table that is not about samples.
    pub(super) marks: Vec<Option<FlagState>>,
    /// For each row the analyst's note, often empty; empty for a table without notes.
    pub(super) notes: Vec<String>,
}

impl Page {
    /// The report on a result, to be written to `path`.
    ///
    /// # Errors
    /// When the input cannot be read again, or is no longer the one that was loaded.
    pub(super) fn of(
        track: &Track,
        session: &Session,
        analysed: &Analysed,
        byline: &Byline,
        path: &Path,
    ) -> Result<Self> {
        let inspection = Inspection::of(track);
        let summary = Summary::of(track, session, analysed);
        let mut saved = session.clone();
        // Of standard input there can be no session.
        let text = match track.source {
            Source::Input(_) => {
                saved.result = Some(analysed.recorded(session, track)?);
                None
            }
            _ => Some(document(&mut saved, track, analysed, path)?),
        };
        let clean_sha256 = saved.result.map(|r| r.clean_sha256).unwrap_or_default();
        let tables = flagged::tables(track, session, analysed)?;
        let sections = summary.channels.iter().enumerate().zip(tables);
        let sections = sections.map(|((plan, summary), flags)| {
            let (index, samples, outcome) = &analysed.channels[plan];
            let beside = byline.flags.as_deref();
            channel::section(
                track,
                (&session.plans[plan], session.value),
                (*index, samples, outcome),
                summary,
                (flags, beside),
            )
        });
        // Of a session beside its record, the path begins with `./`.
        let mut said = session.clone();
        if let Source::File(path) = &mut said.data.source {
            *path = record::plain(path).into();
        }
        let command = clean_command(&said, track, Path::new("cleaned.csv"));
        Ok(Self {
            title: track.source.name(),
            byline: byline.words(),
            outcome: record::outcome(&summary),
            facts: record::facts(&inspection, &summary, &clean_sha256),
            columns: record::columns(&inspection),
            notes: record::notes(&inspection),
            channels: sections.collect(),
            references: citations::cited(session),
            command_note: record::command_note(command.is_some()),
            command: command.unwrap_or_else(|| "wildpoint replay session.toml -o cleaned.csv".into()),
            session: text.filter(|text| text.len() <= LONGEST_SESSION),
        })
    }
}

/// The forms a report can have.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ReportForm {
    /// One HTML file, pictures inside.
    Html,
    /// One Markdown file, pictures inside as data.
    Markdown,
}

impl ReportForm {
    /// The form that the name of a file asks for.
    ///
    /// # Errors
    /// [`Error::Usage`] for an ending other than `.html`, `.htm` and `.md`.
    pub fn of(path: &Path) -> Result<Self> {
        let ending = path.extension().map(|e| e.to_string_lossy().to_lowercase()).unwrap_or_default();
        match ending.as_str() {
            "html" | "htm" => Ok(Self::Html),
            "md" | "markdown" => Ok(Self::Markdown),
            _ => Err(Error::usage(
                format!("{}: unknown report format", path.display()),
                "use a name that ends in .html (one page) or .md (Markdown); print the page to make a PDF",
            )),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_ending_says_the_form() {
        let form = |name: &str| ReportForm::of(Path::new(name)).ok();
        assert_eq!(form("a/b.html"), Some(ReportForm::Html));
        assert_eq!(form("B.MD"), Some(ReportForm::Markdown));
        assert_eq!((form("report"), form("report.pdf"), form("html")), (None, None, None));
    }
}
