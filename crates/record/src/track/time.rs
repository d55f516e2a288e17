//! Times as files write them: in words and numbers, by a pattern, in several columns, in the zone of a place.

mod form;
mod free;
mod parts;
mod pattern;
mod pieces;
mod words;
mod zone;

pub(crate) use form::{Numbers, digits_are_dates, number_form, order_of};
pub use free::DateOrder;
pub(crate) use free::fields;
pub use parts::Part;
pub(crate) use parts::{clock as part_clock, moment as parts_moment, written as part_written};
pub use pattern::Pattern;
pub(crate) use pieces::{Field, Pieces};
pub use zone::Zone;

/// True for the name of a month.
pub(crate) fn is_month(cell: &[u8]) -> bool {
    words::month(cell).is_some()
}

use super::calendar::{DAY, SECOND};

/// The zero of times that are counted from a known moment.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Zero {
    /// 1899-12-30, as spreadsheets count days.
    Spreadsheet,
    /// 1858-11-17: modified Julian days.
    ModifiedJulian,
    /// Noon of -4712-01-01: Julian days.
    Julian,
    /// 1980-01-06: GPS time, without leap seconds.
    Gps,
    /// 1904-01-01, as LabVIEW and old Macintoshes count seconds.
    Labview,
    /// The year 0, as Matlab counts days.
    Matlab,
}

impl Zero {
    /// Seconds from 1970 to it.
    pub(crate) fn seconds(self) -> i64 {
        let day = DAY / SECOND;
        match self {
            Self::Spreadsheet => -25_569 * day,
            Self::ModifiedJulian => -40_587 * day,
            Self::Julian => -2_440_587 * day - day / 2,
            Self::Gps => 3_657 * day,
            Self::Labview => -24_107 * day,
            Self::Matlab => -719_529 * day,
        }
    }

    /// What is counted from it, in words.
    pub(crate) fn words(self) -> &'static str {
        match self {
            Self::Spreadsheet => "since 1899-12-30, as in spreadsheets",
            Self::ModifiedJulian => "since 1858-11-17 (modified Julian)",
            Self::Julian => "Julian",
            Self::Gps => "since 1980-01-06 (GPS time)",
            Self::Labview => "since 1904-01-01 (LabVIEW)",
            Self::Matlab => "since the year 0 (Matlab)",
        }
    }
}
