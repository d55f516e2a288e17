//! Clocks of a place: local times to UTC and back.

use jiff::Timestamp;
use jiff::civil::DateTime;
use jiff::tz::TimeZone;

use crate::error::{Error, Result};

/// A time zone by its name in the IANA database, like `Europe/Berlin`, or an offset like `+01:00`.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Zone {
    name: String,
    zone: TimeZone,
}

impl Zone {
    /// The zone of this name.
    ///
    /// # Errors
    /// [`Error::Usage`] for a name that is not known.
    pub fn find(name: &str) -> Result<Self> {
        let offset =
            super::super::timestamp::offset(name.as_bytes()).filter(|_| name.starts_with(['+', '-', 'Z', 'U']));
        let zone = match offset.and_then(|ns| i32::try_from(ns / super::super::calendar::SECOND).ok()) {
            Some(seconds) => jiff::tz::Offset::from_seconds(seconds).ok().map(TimeZone::fixed),
            None => TimeZone::get(name).ok(),
        };
        let unknown = || {
            let help =
                "name it as the IANA database does (Europe/Berlin, America/New_York, UTC), or as an offset (+01:00)";
            Error::usage(format!("there is no time zone `{name}`"), help)
        };
        zone.map(|zone| Self { name: name.to_owned(), zone }).ok_or_else(unknown)
    }

    /// Its name, as it was given.
    #[must_use]
    pub fn name(&self) -> &str {
        &self.name
    }

    /// The moment at which clocks of the zone show `local`, both in nanoseconds since 1970: the first of two, where
    /// clocks were set back; and one that clocks never showed is counted on from before they were set forward.
    pub(crate) fn utc(&self, local: i64) -> Option<i64> {
        let moment = self.zone.to_ambiguous_zoned(civil(local)?).compatible().ok()?;
        i64::try_from(moment.timestamp().as_nanosecond()).ok()
    }

    /// The later moment at which clocks showed the same as at `utc`, where there is one.
    pub(crate) fn repeated(&self, utc: i64) -> Option<i64> {
        let later = self.zone.to_ambiguous_zoned(civil(self.local(utc))?).later().ok()?;
        i64::try_from(later.timestamp().as_nanosecond()).ok().filter(|later| *later > utc)
    }

    /// What clocks of the zone show at `utc`.
    pub(crate) fn local(&self, utc: i64) -> i64 {
        let moment = Timestamp::from_nanosecond(i128::from(utc)).ok();
        let offset = moment.map_or(0, |m| i64::from(self.zone.to_offset(m).seconds()));
        utc.saturating_add(offset.saturating_mul(super::super::calendar::SECOND))
    }
}

fn civil(local: i64) -> Option<DateTime> {
    let as_if_utc = Timestamp::from_nanosecond(i128::from(local)).ok()?;
    Some(as_if_utc.to_zoned(TimeZone::UTC).datetime())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn clocks_of_a_place_are_read_and_a_repeated_hour_has_two_moments() {
        let ns = |text: &str| i64::try_from(text.parse::<Timestamp>().unwrap().as_nanosecond()).unwrap();
        let berlin = Zone::find("Europe/Berlin").unwrap();
        assert_eq!(berlin.utc(ns("2021-03-04T10:00:00Z")), Some(ns("2021-03-04T09:00:00Z")));
        assert_eq!(berlin.utc(ns("2021-07-04T10:00:00Z")), Some(ns("2021-07-04T08:00:00Z")));
        // Clocks were set back from 3:00 to 2:00 on 2021-10-31.
        let first = berlin.utc(ns("2021-10-31T02:30:00Z")).unwrap();
        assert_eq!(first, ns("2021-10-31T00:30:00Z"));
        assert_eq!(berlin.repeated(first), Some(ns("2021-10-31T01:30:00Z")));
        assert_eq!(berlin.repeated(ns("2021-07-04T08:00:00Z")), None);
        assert_eq!(berlin.local(first), ns("2021-10-31T02:30:00Z"));
        assert_eq!(Zone::find("-07:00").unwrap().utc(0), Some(7 * 3600 * 1_000_000_000));
        assert!(Zone::find("Middle/Earth").unwrap_err().to_string().contains("IANA"));
    }
}
