//! How a record is to be loaded.

use super::{Delimiter, Encoding, TimeUnit};

/// What the user tells about a file. What is not told is recognised.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct LoadOptions {
    /// The time column, by name or as `#3`; `sample` for the sample number. Recognised: the column that looks most
    /// like a time, otherwise the sample number.
    pub time: Option<String>,
    /// The channels, by name or as `#3`. None: every numeric column that is neither time nor truth.
    pub channels: Vec<String>,
    /// The column that tells several tracks in one table apart, by name or as `#3`. None: all rows are one track.
    pub track: Option<String>,
    /// The truth column. Recognised: the only column of 0 and 1 with `truth` in its name.
    pub truth: Option<String>,
    /// Cells that mean "no value", besides the usual ones; numbers are compared by value.
    pub missing: Vec<String>,
    /// What stands between two cells.
    pub delimiter: Option<Delimiter>,
    /// True when `1,5` means one and a half.
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
}
