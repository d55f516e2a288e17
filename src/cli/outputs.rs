//! The options of what is written.

use std::path::{Path, PathBuf};

use clap::Args;
use clap::builder::{PossibleValuesParser, TypedValueParser};

use crate::error::{Error, Result};
use crate::session::{SCHEMES, Scheme};
use crate::track::DASH;

/// What to write, and how.
#[derive(Debug, Clone, Default, Args)]
pub struct OutputArgs {
    /// Write the cleaned file: the input with outliers repaired or removed, all other bytes unchanged. A name that ends in
    /// .parquet writes Parquet.
    #[arg(short, long, value_name = "CLEANED")]
    pub output: Option<PathBuf>,
    /// Columns of flags in the cleaned file.
    #[arg(long, value_name = "SCHEME", requires = "output", value_parser = scheme(), help = scheme_help())]
    pub flag_columns: Option<&'static Scheme>,
    /// Write only the changed cells: row, time, channel, old and new text, verdict, and what flagged it (CSV).
    #[arg(long, value_name = "CHANGED")]
    pub changed: Option<PathBuf>,
    /// Write the audit table: every flag with its evidence (CSV).
    #[arg(long, value_name = "FLAGS")]
    pub flags: Option<PathBuf>,
    /// Write a row for every sample (CSV).
    #[arg(long, value_name = "DIAG")]
    pub diagnostics: Option<PathBuf>,
    /// Write a report with pictures: one HTML file (.html) or one Markdown file (.md).
    #[arg(long, value_name = "REPORT")]
    pub report: Option<PathBuf>,
    /// Name of the analyst, for the report [default: `analyst` in the configuration].
    #[arg(long, value_name = "NAME", requires = "report")]
    pub analyst: Option<String>,
    /// Do all the work and report what would be written, but write nothing.
    #[arg(long)]
    pub dry_run: bool,
    /// Overwrite existing outputs (never the input).
    #[arg(long)]
    pub force: bool,
    /// Print a summary in JSON.
    #[arg(long)]
    pub json: bool,
    /// Print nothing but errors.
    #[arg(short, long)]
    pub quiet: bool,
}

impl OutputArgs {
    /// True when one of the outputs is standard output.
    #[must_use]
    pub fn takes_standard_output(&self) -> bool {
        self.on_standard_output(None) > 0
    }

    /// That standard output is one thing at most.
    ///
    /// # Errors
    /// [`Error::Usage`] when it is not.
    pub fn check_standard_output(&self, session: Option<&Path>) -> Result<()> {
        match self.on_standard_output(session) + usize::from(self.json) {
            0 | 1 => Ok(()),
            _ => Err(Error::usage("only one output can be `-` (standard output)", "give the others file names")),
        }
    }

    fn on_standard_output(&self, session: Option<&Path>) -> usize {
        let named =
            [&self.output, &self.changed, &self.flags, &self.diagnostics, &self.report].map(|path| path.as_deref());
        named.into_iter().chain([session]).flatten().filter(|path| *path == Path::new(DASH)).count()
    }
}

/// One of the schemes of flags.
fn scheme() -> impl TypedValueParser<Value = &'static Scheme> {
    PossibleValuesParser::new(SCHEMES.iter().map(|scheme| scheme.id))
        .try_map(|id| Scheme::of(&id).ok_or("not one of the schemes"))
}

fn scheme_help() -> String {
    let schemes: Vec<String> = SCHEMES.iter().map(|scheme| format!("{} ({})", scheme.id, scheme.about())).collect();
    let what = "Add columns of flags on the right of the cleaned file, COLUMN_flag for each judged column";
    format!("{what}: {}", schemes.join("; "))
}
