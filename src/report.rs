//! Tables and summaries of a result.

use std::io::Write;
use std::path::Path;

use crate::error::{Error, Result};
use crate::session::{Analysed, Session};
use crate::track::Track;

mod byline;
mod diagnostics;
mod html;
mod inspection;
mod markdown;
mod page;
mod reproduced;
mod reproduction;
mod summary;
mod svg;
pub mod written;

pub use crate::session::flags::flags;
pub use byline::Byline;
pub use diagnostics::{DIAGNOSTIC_COLUMNS, diagnostics};
pub(crate) use inspection::short;
pub use inspection::{ChannelFacts, Inspection, TableFacts, TimeFacts, layout};
pub use page::ReportForm;
pub use reproduced::{Reproduced, reproduced_html};
pub use reproduction::reproduction_text;
pub use summary::{ChannelSummary, Summary};

/// Writes the report on a result that goes to `path`, in the form that its ending asks for: what the record is, the
/// settings, the counts, pictures, the flags and decisions with their evidence, and how to reproduce the result. The
/// same result on the same day makes the same bytes.
///
/// # Errors
/// [`Error::Usage`] for an ending without a form; when the input cannot be read again, or is no longer the one that
/// was loaded; when the report cannot be written.
pub fn report(
    track: &Track,
    session: &Session,
    analysed: &Analysed,
    (byline, path): (&Byline, &Path),
    out: &mut dyn Write,
) -> Result<()> {
    let form = ReportForm::of(path)?;
    let page = page::Page::of(track, session, analysed, byline, path)?;
    let text = match form {
        ReportForm::Html => html::html(&page),
        ReportForm::Markdown => markdown::markdown(&page),
    };
    out.write_all(text.as_bytes()).map_err(Error::io("write", path))
}
