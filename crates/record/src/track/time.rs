//! Times as files write them: in words and numbers, by a pattern, in several columns, in the zone of a place.

mod form;
mod free;
mod parts;
mod pattern;
mod pieces;
mod words;
mod zone;
mod zone_name;

pub(crate) use form::{Numbers, digits_are_dates, number_form, order_of};
pub use free::DateOrder;
pub(crate) use free::fields;
pub use parts::Part;
pub(crate) use parts::{clock as part_clock, moment as parts_moment, offset_in, written as part_written};
pub use pattern::Pattern;
pub(crate) use pieces::{Field, Pieces};
pub use zone::Zone;
pub(crate) use zone_name::zone_in;

/// True for the name of a month, or its beginning.
pub(crate) fn is_month_name(word: &str) -> bool {
    words::month(word.as_bytes()).is_some()
}

/// True for the name of a month.
pub(crate) fn is_month(cell: &[u8]) -> bool {
    words::month(cell).is_some()
}

use std::borrow::Cow;

use super::calendar::{DAY, Date, SECOND};

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
    /// This many seconds after 1970, as the file tells.
    At(i64),
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
            Self::At(seconds) => seconds,
        }
    }

    /// What is counted from it, in words.
    pub(crate) fn words(self) -> Cow<'static, str> {
        Cow::Borrowed(match self {
            Self::Spreadsheet => "since 1899-12-30, as in spreadsheets",
            Self::ModifiedJulian => "since 1858-11-17 (modified Julian)",
            Self::Julian => "Julian",
            Self::Gps => "since 1980-01-06 (GPS time)",
            Self::Labview => "since 1904-01-01 (LabVIEW)",
            Self::Matlab => "since the year 0 (Matlab)",
            Self::At(seconds) => {
                let date = Date::of_days(seconds.div_euclid(DAY / SECOND));
                return Cow::Owned(format!("since {}-{:02}-{:02}", date.year, date.month, date.day));
            }
        })
    }
}
