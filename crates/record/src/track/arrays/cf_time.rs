//! Times as the CF conventions have them: `seconds since 1970-01-01`.

use super::super::calendar::{DAY, Date};
use super::scalar::Scalar;

/// What the numbers of an array mean as moments.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Stamp {
    /// Nanoseconds in a unit.
    pub(super) unit_ns: i128,
    /// Nanoseconds from 1970 to the moment of 0.
    pub(super) zero_ns: i128,
}

/// What units of a time say.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) enum Told {
    /// They count from a moment.
    Moments(Stamp),
    /// They count from a moment in a calendar, or in a unit, that has no dates of ours.
    Elsewhere,
    /// They are no such units.
    Other,
}

impl Stamp {
    /// Units of this many nanoseconds since 1970.
    pub(super) fn since_1970(unit_ns: i128) -> Self {
        Self { unit_ns, zero_ns: 0 }
    }

    /// Days as Matlab counts them, from the year 0.
    pub(super) fn datenum() -> Self {
        const DAYS_TO_1970: i128 = 719_529;
        Self { unit_ns: DAY.into(), zero_ns: -DAYS_TO_1970 * i128::from(DAY) }
    }

    /// What units and a calendar say.
    pub(super) fn of(units: &str, calendar: Option<&str>) -> Told {
        let Some((unit, zero)) = parted(units) else { return Told::Other };
        let calendar = calendar.unwrap_or("standard").trim().to_lowercase();
        let mixed = matches!(calendar.as_str(), "standard" | "gregorian" | "");
        if !mixed && calendar != "proleptic_gregorian" {
            return Told::Elsewhere;
        }
        let stamp = unit_ns(unit).zip(moment(zero, mixed)).map(|(unit_ns, zero_ns)| Self { unit_ns, zero_ns });
        stamp.map_or(Told::Elsewhere, Told::Moments)
    }

    /// The moment of a number, in nanoseconds since 1970; none for what is no number of years that are counted.
    pub(super) fn moment(self, value: Scalar) -> Option<i128> {
        const YEARS: i128 = 9999 * 366 * DAY as i128;
        let since = match value {
            Scalar::Int(v) => v.checked_mul(self.unit_ns)?,
            other => {
                let v = other.as_f64();
                let whole = v.trunc();
                if !v.is_finite() || whole.abs() > 1e20 {
                    return None;
                }
                #[expect(clippy::cast_possible_truncation, clippy::cast_precision_loss, reason = "a part of a unit")]
                let part = ((v - whole) * self.unit_ns as f64).round() as i128;
                #[expect(clippy::cast_possible_truncation, reason = "at most 10^20")]
                (whole as i128).checked_mul(self.unit_ns)?.checked_add(part)?
            }
        };
        since.checked_add(self.zero_ns).filter(|ns| ns.abs() < YEARS)
    }

    /// How far the stored number may be from the one that was meant, in nanoseconds.
    #[expect(clippy::cast_precision_loss, clippy::cast_possible_truncation, reason = "a distance")]
    fn slack(self, value: Scalar) -> i128 {
        let step = match value {
            Scalar::Int(_) => 0.0,
            Scalar::F32(v) => f64::from(v.abs().next_up() - v.abs()),
            Scalar::F64(v) => v.abs().next_up() - v.abs(),
        };
        (step * self.unit_ns as f64).ceil() as i128
    }

    /// How many decimals of a second write all of these numbers, as far as they are exact.
    pub(super) fn digits(self, values: impl Iterator<Item = Scalar>) -> u32 {
        let mut digits = 0;
        for value in values {
            let Some(ns) = self.moment(value) else { continue };
            let slack = self.slack(value);
            while digits < 9 && (rounded(ns, digits) - ns).abs() > slack {
                digits += 3;
            }
            if digits == 9 {
                break;
            }
        }
        digits
    }
}

/// A moment to this many decimals of a second, in nanoseconds.
pub(super) fn rounded(ns: i128, digits: u32) -> i128 {
    let unit = 10_i128.pow(9_u32.saturating_sub(digits));
    (ns + unit / 2).div_euclid(unit) * unit
}

/// `seconds since 1970-01-01` as its unit and its moment.
fn parted(units: &str) -> Option<(&str, &str)> {
    let lower = units.to_ascii_lowercase();
    let at = lower.find(" since ")?;
    Some((units[..at].trim(), units[at + " since ".len()..].trim()))
}

/// The nanoseconds of a unit of UDUNITS, where all of its kind are of one length.
fn unit_ns(unit: &str) -> Option<i128> {
    const SECOND: i128 = 1_000_000_000;
    Some(match unit.to_ascii_lowercase().as_str() {
        "ns" | "nsec" | "nsecs" | "nanosec" | "nanosecs" | "nanosecond" | "nanoseconds" => 1,
        "us" | "usec" | "usecs" | "microsec" | "microsecs" | "microsecond" | "microseconds" => 1000,
        "ms" | "msec" | "msecs" | "millisec" | "millisecs" | "millisecond" | "milliseconds" => 1_000_000,
        "s" | "sec" | "secs" | "second" | "seconds" => SECOND,
        "min" | "mins" | "minute" | "minutes" => 60 * SECOND,
        "h" | "hr" | "hrs" | "hour" | "hours" => 3600 * SECOND,
        "d" | "day" | "days" => DAY.into(),
        "week" | "weeks" => 7 * i128::from(DAY),
        _ => return None,
    })
}

/// The moment of a date, with or without a clock and a zone (`1950-01-01T00:00:00Z`, `1-1-1`), in nanoseconds since 1970.
/// Dates of a `mixed` calendar before 1582-10-15 are those of the Julian one.
fn moment(text: &str, mixed: bool) -> Option<i128> {
    let text = text.trim();
    let date_end = text.find(|c: char| c == 'T' || c == 't' || c.is_whitespace()).unwrap_or(text.len());
    let (date, rest) = text.split_at(date_end);
    let (sign, date) = date.strip_prefix('-').map_or((1, date), |rest| (-1, rest));
    let mut parts = date.split('-').map(|part| part.parse::<i64>().ok());
    let year = sign * parts.next()??;
    let (month, day) = (parts.next().unwrap_or(Some(1))?, parts.next().unwrap_or(Some(1))?);
    let date = Date { year, month, day };
    let days = if mixed && (year, month, day) < (1582, 10, 15) { julian_days(date)? } else { date.days()? };
    let (clock, offset) = clock_and_zone(rest.trim_start_matches(['T', 't']).trim())?;
    Some(i128::from(days) * i128::from(DAY) + clock - offset)
}

/// Days since 1970 of a date of the Julian calendar.
fn julian_days(Date { year, month, day }: Date) -> Option<i64> {
    if !(1..=12).contains(&month) || !(1..=31).contains(&day) {
        return None;
    }
    let (year, month) = if month <= 2 { (year - 1, month + 12) } else { (year, month) };
    const JULIAN_DAY_OF_1970: i64 = 2_440_588;
    let of_years = (1461 * (year + 4716)).div_euclid(4);
    Some(of_years + 306_001 * (month + 1) / 10_000 + day - 1524 - JULIAN_DAY_OF_1970)
}

/// The nanoseconds of a clock, and those that its zone is ahead.
fn clock_and_zone(text: &str) -> Option<(i128, i128)> {
    let is_zone = |(at, c): &(usize, char)| c.is_ascii_alphabetic() || (*at > 0 && matches!(c, '+' | '-'));
    let at = text.char_indices().find(is_zone).map_or(text.len(), |(at, _)| at);
    let (clock, zone) = if text.starts_with(['+', '-']) { ("", text) } else { text.split_at(at) };
    let offset = match zone.trim().trim_end_matches(['Z', 'z']) {
        "" | "UTC" | "utc" | "GMT" | "gmt" | "UT" => 0,
        zone => hours(zone.trim_start_matches(|c: char| c.is_ascii_alphabetic()))?,
    };
    Some((hours(clock.trim())?, offset))
}

/// `12:30:05.25`, `1230` or `-07:00` in nanoseconds; an empty text is 0.
fn hours(text: &str) -> Option<i128> {
    const SECOND: i128 = 1_000_000_000;
    let (sign, text) = match text.strip_prefix('-') {
        Some(rest) => (-1, rest),
        None => (1, text.strip_prefix('+').unwrap_or(text)),
    };
    if text.is_empty() {
        return Some(0);
    }
    let four = text.len() == 4 && text.bytes().all(|b| b.is_ascii_digit());
    let spelled = if four { format!("{}:{}", &text[..2], &text[2..]) } else { text.to_owned() };
    let mut parts = spelled.split(':');
    let hours: i128 = parts.next()?.parse().ok()?;
    let minutes: i128 = parts.next().map_or(Some(0), |m| m.parse().ok())?;
    let seconds: f64 = parts.next().map_or(Some(0.0), |s| s.parse().ok()).filter(|s| (0.0..62.0).contains(s))?;
    #[expect(clippy::cast_possible_truncation, reason = "a minute")]
    let seconds = (seconds * 1e9).round() as i128;
    (hours.abs() < 100 && minutes.abs() < 60 && parts.next().is_none())
        .then(|| sign * ((hours * 60 + minutes) * 60 * SECOND + seconds))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn stamp(units: &str) -> Stamp {
        match Stamp::of(units, None) {
            Told::Moments(stamp) => stamp,
            other => panic!("{units}: {other:?}"),
        }
    }

    #[test]
    fn units_tell_their_moment() {
        const S: i128 = 1_000_000_000;
        for (units, unit_ns, zero_s) in [
            ("seconds since 1970-01-01", S, 0),
            ("seconds since 1970-01-01T00:00:00Z", S, 0),
            ("ms since 1970-1-1 0:0:0", S / 1000, 0),
            ("days since 1950-01-01T00:00:00Z", 86_400 * S, -631_152_000),
            ("hours since 1900-01-01 00:00:0.0", 3600 * S, -2_208_988_800),
            ("Seconds since 2000-01-01 12:00:00 UTC", S, 946_728_000),
            ("minutes since 2021-03-04 10:00:00 +01:00", 60 * S, 1_614_848_400),
            ("s since 2021-03-04 10:00 -0730", S, 1_614_879_000),
            // Two days before the first of January of the calendar that is counted on.
            ("days since 1-1-1 00:00:00", 86_400 * S, -62_135_769_600),
        ] {
            assert_eq!(stamp(units), Stamp { unit_ns, zero_ns: zero_s * S }, "{units}");
        }
        let proleptic = Stamp::of("days since 0001-01-01", Some("proleptic_gregorian"));
        assert_eq!(proleptic, Told::Moments(Stamp { unit_ns: DAY.into(), zero_ns: -62_135_596_800 * S }));
    }

    #[test]
    fn other_units_and_calendars_are_told_apart() {
        assert_eq!(Stamp::of("seconds", None), Told::Other);
        assert_eq!(Stamp::of("months since 1970-01-01", None), Told::Elsewhere);
        assert_eq!(Stamp::of("days since 2000-01-01", Some("noleap")), Told::Elsewhere);
        assert_eq!(Stamp::of("days since the start", None), Told::Elsewhere);
    }

    #[test]
    fn digits_are_those_that_the_numbers_were_made_from() {
        let days = stamp("days since 1950-01-01");
        // Steps of 10 s, as doubles hold them.
        let tens = |i: u32| Scalar::F64(26_000.0 + f64::from(i) * 10.0 / 86_400.0);
        assert_eq!(days.digits((0..500).map(tens)), 0);
        let seconds = stamp("seconds since 1970-01-01");
        let milli = |i: u32| Scalar::F64(1.6e9 + f64::from(i) / 1000.0);
        assert_eq!(seconds.digits((0..500).map(milli)), 3);
        assert_eq!(seconds.digits([Scalar::Int(5)].into_iter()), 0);
        assert_eq!(Stamp::since_1970(1).digits([Scalar::Int(1_000_001)].into_iter()), 9);
        let ns = days.moment(tens(3)).unwrap();
        assert_eq!(rounded(ns, 0), days.moment(Scalar::Int(26_000)).unwrap() + 30_000_000_000);
    }
}
