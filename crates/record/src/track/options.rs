//! How a record is to be loaded.

use super::{Delimiter, Encoding, Pattern, TimeUnit};

/// What the user tells about a file. What is not told is detected.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct LoadOptions {
    /// The time column, by name or as `#3`; `sample` for the sample number. Recognised: the column that looks most
    /// like a time, otherwise the sample number.
    pub time: Option<String>,
    /// The channels, by name or as `#3`. None: every numeric column that is neither time nor truth.
    pub channels: Vec<String>,
    /// Columns of numbers that are needed beside the channels, whatever they look like: a rate, a reference.
    pub beside: Vec<String>,
    /// The column that tells several tracks in one table apart, by name or as `#3`. None: all rows are one track.
    pub track: Option<String>,
    /// The truth column. Recognised: the only column of 0 and 1 with `truth` in its name.
    pub truth: Option<String>,
    /// Cells that mean "no value", besides the usual ones; numbers are compared by value.
    pub missing: Vec<String>,
    /// The field separator.
    pub delimiter: Option<Delimiter>,
    /// True when a comma is the decimal sign.
    pub decimal_comma: Option<bool>,
    /// The encoding of the text, where it is not UTF-16 with its mark.
    pub encoding: Option<Encoding>,
    /// Whether the first line names the columns.
    pub header: Option<bool>,
    /// False where quotes are ordinary characters.
    pub quotes: Option<bool>,
    /// Whether 1/2/2005 is in February. Needed where the file does not show it.
    pub day_first: Option<bool>,
    /// The unit of times that are numbers. Recognised: that of the column, otherwise seconds.
    pub time_unit: Option<TimeUnit>,
    /// How times are written.
    pub time_format: Option<Pattern>,
    /// The zone of clocks that write none, by its name in the IANA database.
    pub time_zone: Option<String>,
    /// The line (from 1) that names the columns.
    pub header_line: Option<usize>,
    /// Lines at the start that are not looked at.
    pub skip: Option<usize>,
    /// The line (from 1) of the units.
    pub units_line: Option<usize>,
    /// What comments begin with, besides `#`, `%` and `//`.
    pub comment: Option<String>,
    /// The names of the columns, where the file has none or others.
    pub names: Vec<String>,
    /// Which table of a file with several, from 1. Recognised: the longest.
    pub table: Option<usize>,
    /// By which rules what is not told is detected.
    pub rules: Rules,
}

impl LoadOptions {
    /// True where the user says where the table stands.
    pub(crate) fn tells_table(&self) -> bool {
        let lines = [self.header_line, self.skip, self.units_line, self.table];
        lines.iter().any(Option::is_some) || self.comment.is_some() || !self.names.is_empty()
    }
}

/// The rules by which a file is understood. A session says by which it was made, so that later rules change no result.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub enum Rules {
    /// Those of sessions that say nothing.
    First,
    /// Times in any spelling and order, roles of columns, repaired cells in the form of their column.
    #[default]
    Second,
}

impl Rules {
    /// Their number in a session.
    #[must_use]
    pub fn number(self) -> i64 {
        match self {
            Self::First => 1,
            Self::Second => 2,
        }
    }

    /// Those of a number.
    #[must_use]
    pub fn of_number(number: i64) -> Option<Self> {
        [Self::First, Self::Second].into_iter().find(|rules| rules.number() == number)
    }
}
