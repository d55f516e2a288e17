//! Days and nanoseconds of the proleptic Gregorian calendar, in integers. Time zones are offsets; leap seconds are
//! not counted, as in POSIX time.

/// Seconds in a day.
pub const SECONDS_PER_DAY: f64 = 86_400.0;
/// Nanoseconds in a second.
pub(crate) const SECOND: i64 = 1_000_000_000;
/// Nanoseconds in a day.
pub const DAY: i64 = 86_400 * SECOND;

/// A date.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Date {
    pub(crate) year: i64,
    pub(crate) month: i64,
    pub(crate) day: i64,
}

impl Date {
    /// The date of this day count since 1970-01-01.
    pub(crate) fn of_days(days: i64) -> Self {
        // Years are counted from March, so that a leap day ends one. 719,468 days lie before 1970-01-01 and
        // after 0000-03-01; 146,097 make 400 years.
        let days = days + 719_468;
        let era = days.div_euclid(146_097);
        let of_era = days.rem_euclid(146_097);
        let year_of_era = (of_era - of_era / 1_460 + of_era / 36_524 - of_era / 146_096) / 365;
        let of_year = of_era - (365 * year_of_era + year_of_era / 4 - year_of_era / 100);
        let from_march = (5 * of_year + 2) / 153;
        let day = of_year - (153 * from_march + 2) / 5 + 1;
        let month = if from_march < 10 { from_march + 3 } else { from_march - 9 };
        Self { year: era * 400 + year_of_era + i64::from(month <= 2), month, day }
    }

    /// Days since 1970-01-01; none when there is no such date.
    pub(crate) fn days(self) -> Option<i64> {
        let Self { year, month, day } = self;
        // No record is of other years, and days of all of them fit their integer.
        const YEARS: std::ops::RangeInclusive<i64> = -1_000_000..=1_000_000;
        if !YEARS.contains(&year) || !(1..=12).contains(&month) || day < 1 || day > days_in(year, month) {
            return None;
        }
        let year = if month <= 2 { year - 1 } else { year };
        let era = year.div_euclid(400);
        let year_of_era = year.rem_euclid(400);
        let from_march = (month + 9) % 12;
        let of_year = (153 * from_march + 2) / 5 + day - 1;
        Some(era * 146_097 + year_of_era * 365 + year_of_era / 4 - year_of_era / 100 + of_year - 719_468)
    }
}

fn days_in(year: i64, month: i64) -> i64 {
    match month {
        4 | 6 | 9 | 11 => 30,
        2 if year % 4 == 0 && (year % 100 != 0 || year % 400 == 0) => 29,
        2 => 28,
        _ => 31,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_day_of_eight_centuries_follows_the_one_before() {
        let mut date = Date { year: 1599, month: 12, day: 31 };
        for days in -135_140..160_000 {
            date = match date {
                Date { year, month: 12, day: 31 } => Date { year: year + 1, month: 1, day: 1 },
                Date { year, month, day } if day == days_in(year, month) => Date { year, month: month + 1, day: 1 },
                Date { day, .. } => Date { day: day + 1, ..date },
            };
            assert_eq!((Date::of_days(days), date.days()), (date, Some(days)));
        }
    }

    #[test]
    fn days_count_from_1970() {
        assert_eq!(Date { year: 1970, month: 1, day: 1 }.days(), Some(0));
        // Modified Julian Day 51544, which is 2000-01-01; MJD 40587 is 1970-01-01.
        assert_eq!(Date { year: 2000, month: 1, day: 1 }.days(), Some(51_544 - 40_587));
        for (year, month, day) in [(2019, 2, 29), (1900, 2, 29), (2019, 13, 1), (2019, 4, 31), (2019, 0, 1)] {
            assert_eq!(Date { year, month, day }.days(), None);
        }
    }

    #[test]
    fn a_year_that_no_record_is_of_has_no_days() {
        for year in [i64::MAX, 1_573_495_025_000_000_001, i64::MIN] {
            assert_eq!(Date { year, month: 1, day: 1 }.days(), None);
        }
        assert!(Date { year: -4712, month: 1, day: 1 }.days().is_some());
    }
}
