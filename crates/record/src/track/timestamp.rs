//! Times as files write them, to integer nanoseconds.

use super::calendar::{DAY, Date, SECOND};

/// A time written as a number.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Count {
    /// Nanoseconds, exactly.
    Exact(i64),
    /// More decimals than nanoseconds have, an exponent, or out of the range of 64-bit nanoseconds.
    Inexact(f64),
}

/// `text`, a number of units of `unit_ns` nanoseconds.
#[inline]
pub(crate) fn count(text: &[u8], unit_ns: i64, decimal_comma: bool) -> Option<Count> {
    let point = if decimal_comma { b',' } else { b'.' };
    if let Some(ns) = decimal(text, unit_ns, point) {
        return Some(Count::Exact(ns));
    }
    let text = std::str::from_utf8(text).ok()?;
    let value: f64 = if decimal_comma { text.replacen(',', ".", 1).parse() } else { text.parse() }.ok()?;
    value.is_finite().then_some(Count::Inexact(value))
}

fn decimal(text: &[u8], unit_ns: i64, point: u8) -> Option<i64> {
    let (negative, digits) = match text {
        [b'-', rest @ ..] => (true, rest),
        [b'+', rest @ ..] => (false, rest),
        _ => (false, text),
    };
    let (whole, fraction) = match digits.iter().position(|b| *b == point) {
        Some(at) => (&digits[..at], &digits[at + 1..]),
        None => (digits, &[][..]),
    };
    if whole.is_empty() && fraction.is_empty() {
        return None;
    }
    let mut ns = if whole.is_empty() { 0 } else { integer(whole)?.checked_mul(unit_ns)? };
    if !fraction.is_empty() {
        let zeros = fraction.iter().rev().take_while(|b| **b == b'0').count();
        let fraction = &fraction[..fraction.len() - zeros];
        if !fraction.is_empty() {
            let scale = 10_i64.checked_pow(u32::try_from(fraction.len()).ok()?)?;
            let part = i128::from(integer(fraction)?) * i128::from(unit_ns);
            if part % i128::from(scale) != 0 {
                return None;
            }
            ns = ns.checked_add(i64::try_from(part / i128::from(scale)).ok()?)?;
        }
    }
    Some(if negative { -ns } else { ns })
}

#[inline]
pub(super) fn integer(digits: &[u8]) -> Option<i64> {
    if digits.is_empty() || digits.len() > 19 {
        return None;
    }
    digits.iter().try_fold(0_i64, |value, byte| {
        let digit = byte.wrapping_sub(b'0');
        if digit < 10 { value.checked_mul(10)?.checked_add(i64::from(digit)) } else { None }
    })
}

/// `2019-11-11T17:57:05.25Z` and its kin: date in ISO order with `-` or `/`, then nothing or a time of day after `T`
/// or blanks, then nothing (UTC), `Z`, `UTC` or an offset. Nanoseconds since 1970.
pub(crate) fn iso(text: &[u8]) -> Option<i64> {
    let (date, rest) = text.split_at_checked(10)?;
    let separator = date[4];
    if !matches!(separator, b'-' | b'/') || date[7] != separator {
        return None;
    }
    let (year, month, day) = (integer(&date[..4])?, integer(&date[5..7])?, integer(&date[8..])?);
    moment(Date { year, month, day }, rest)
}

/// [`iso`] by the rules of [`super::Rules::First`], which know no `24:00`.
pub(crate) fn iso_below_24(text: &[u8]) -> Option<i64> {
    iso(text).filter(|_| !ends_a_day(text))
}

/// True for a date with the time of day `24:00`.
pub(crate) fn ends_a_day(text: &[u8]) -> bool {
    memchr::memmem::find(text, b"24:00").is_some_and(|at| at > 0 && matches!(text[at - 1], b'T' | b't' | b' '))
}

/// The order of day and month in a date with the year last.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct YearLast {
    pub(crate) first: i64,
    pub(crate) second: i64,
    pub(crate) separator: u8,
}

/// The first two numbers of a date with the year last: `3/23/2005`, `23.03.2005 17:00`.
pub(crate) fn year_last_parts(text: &[u8]) -> Option<YearLast> {
    let (first, second, separator, _, _) = year_last_split(text)?;
    Some(YearLast { first, second, separator })
}

/// A date with the year last and perhaps a time of day after it. Nanoseconds since 1970.
pub(crate) fn year_last(text: &[u8], day_first: bool) -> Option<i64> {
    let (first, second, _, year, rest) = year_last_split(text)?;
    let (day, month) = if day_first { (first, second) } else { (second, first) };
    moment(Date { year, month, day }, rest)
}

fn year_last_split(text: &[u8]) -> Option<(i64, i64, u8, i64, &[u8])> {
    let one = text.iter().take(3).position(|b| matches!(b, b'/' | b'.' | b'-'))?;
    let separator = text[one];
    let two = one + 1 + text[one + 1..].iter().take(3).position(|b| *b == separator)?;
    let year = text.get(two + 1..two + 5)?;
    Some((integer(&text[..one])?, integer(&text[one + 1..two])?, separator, integer(year)?, &text[two + 5..]))
}

/// A date, and what follows it.
fn moment(date: Date, rest: &[u8]) -> Option<i64> {
    let midnight = date.days()?.checked_mul(DAY)?;
    let rest = match rest {
        [] => return Some(midnight),
        [b'T' | b't', rest @ ..] => rest,
        [b' ', ..] => rest.trim_ascii_start(),
        _ => return None,
    };
    let zone_at = rest.iter().position(|b| matches!(b, b'Z' | b'z' | b'+' | b'-' | b'U' | b' ')).unwrap_or(rest.len());
    let (time, zone) = rest.split_at(zone_at);
    midnight.checked_add(clock(time).or_else(|| end_of_day(time))?)?.checked_sub(offset(zone.trim_ascii_start())?)
}

/// `24:00` and `24:00:00` are the midnight that ends a day.
fn end_of_day(time: &[u8]) -> Option<i64> {
    let rest = time.strip_prefix(b"24:00")?;
    rest.iter().all(|b| matches!(b, b':' | b'0' | b'.')).then_some(DAY)
}

/// `17:57:05.25`, `17:57`, `7:05`: nanoseconds since midnight. A 60th second is the first of the next minute.
pub(crate) fn clock(text: &[u8]) -> Option<i64> {
    let colon = text.iter().take(3).position(|b| *b == b':')?;
    let hour = integer(&text[..colon])?;
    let minute = integer(text.get(colon + 1..colon + 3)?)?;
    let (second, fraction) = match &text[colon + 3..] {
        [] => (0, 0),
        [b':', seconds @ ..] => {
            let (whole, fraction) = seconds.split_at_checked(2)?;
            let fraction = match fraction {
                [] => 0,
                [b'.' | b',', digits @ ..] => fraction_ns(digits)?,
                _ => return None,
            };
            (integer(whole)?, fraction)
        }
        _ => return None,
    };
    (hour < 24 && minute < 60 && second <= 60).then(|| ((hour * 60 + minute) * 60 + second) * SECOND + fraction)
}

/// Decimals of a second; those after the ninth are cut off.
pub(super) fn fraction_ns(digits: &[u8]) -> Option<i64> {
    if !digits.iter().all(u8::is_ascii_digit) {
        return None;
    }
    let kept = &digits[..digits.len().min(9)];
    let power = 10_i64.pow(9 - u32::try_from(kept.len()).ok()?);
    Some(integer(kept)? * power)
}

/// How far a zone lies ahead of UTC, in nanoseconds.
pub(crate) fn offset(zone: &[u8]) -> Option<i64> {
    let (sign, digits) = match zone {
        [] | [b'Z' | b'z'] | b"UTC" => return Some(0),
        [b'+', rest @ ..] => (1, rest),
        [b'-', rest @ ..] => (-1, rest),
        _ => return None,
    };
    let (hours, minutes) = match digits.len() {
        2 => (integer(digits)?, 0),
        4 => (integer(&digits[..2])?, integer(&digits[2..])?),
        5 if digits[2] == b':' => (integer(&digits[..2])?, integer(&digits[3..])?),
        _ => return None,
    };
    (hours <= 18 && minutes < 60).then_some(sign * (hours * 60 + minutes) * 60 * SECOND)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_exact_to_the_nanosecond() {
        for (text, unit, ns) in [
            ("1700000000.1", SECOND, 1_700_000_000_100_000_000),
            ("-0.966", SECOND, -966_000_000),
            (".5", SECOND, 500_000_000),
            ("7.", SECOND, 7_000_000_000),
            ("0.1000000000000", SECOND, 100_000_000),
            ("1573495025250", 1_000_000, 1_573_495_025_250_000_000),
            ("2.5", 1_000, 2_500),
            ("54552.5", DAY, 54_552 * DAY + DAY / 2),
        ] {
            assert_eq!(count(text.as_bytes(), unit, false), Some(Count::Exact(ns)), "{text}");
        }
        assert_eq!(count(b"0,25", SECOND, true), Some(Count::Exact(250_000_000)));
        assert_eq!(count(b"0.1234567891", SECOND, false), Some(Count::Inexact(0.123_456_789_1)));
        assert_eq!(count(b"1e3", SECOND, false), Some(Count::Inexact(1000.0)));
        assert_eq!(count(b"1e18", SECOND, false), Some(Count::Inexact(1e18)));
        for bad in ["", "-", ".", "nan", "inf", "1:2", "12 "] {
            assert_eq!(count(bad.as_bytes(), SECOND, false), None, "{bad}");
        }
    }

    #[test]
    fn dates_and_times_agree_with_another_calendar() {
        for (text, rfc) in [
            ("2019-11-11T17:57:05Z", "2019-11-11T17:57:05Z"),
            ("2019-01-01 00:00", "2019-01-01T00:00:00Z"),
            ("2019-05-11 11:09:47.000", "2019-05-11T11:09:47Z"),
            ("2016-02-14T03:17:37,047", "2016-02-14T03:17:37.047Z"),
            ("2010-11-02T03:00:13.3851+05:30", "2010-11-02T03:00:13.3851+05:30"),
            ("2010-11-02 03:00:13 -0830", "2010-11-02T03:00:13-08:30"),
            ("1969/12/31 23:59:59.5 UTC", "1969-12-31T23:59:59.5Z"),
            ("1999-03-17", "1999-03-17T00:00:00Z"),
            ("1999-03-17 24:00", "1999-03-18T00:00:00Z"),
        ] {
            let expected = rfc.parse::<jiff::Timestamp>().unwrap().as_nanosecond();
            assert_eq!(iso(text.as_bytes()).map(i128::from), Some(expected), "{text}");
        }
        for bad in ["2019-02-29", "2019-01-01T", "2019-01-01 24:01", "2019-01-01x", "2019-1-1", "2019-01/01", ""] {
            assert_eq!(iso(bad.as_bytes()), None, "{bad}");
        }
    }

    #[test]
    fn dates_with_the_year_last_are_read_in_the_order_that_is_told() {
        assert_eq!(year_last(b"3/23/2005 17:00:00", false), iso(b"2005-03-23T17:00:00"));
        assert_eq!(year_last(b"23.03.2005", true), iso(b"2005-03-23"));
        assert_eq!(year_last(b"3/23/2005", true), None);
        let parts = YearLast { first: 3, second: 23, separator: b'/' };
        assert_eq!(year_last_parts(b"3/23/2005"), Some(parts));
        for not_a_date in ["1.5", "3/23/05", "-0.25", "-", "1/2"] {
            assert_eq!(year_last_parts(not_a_date.as_bytes()), None);
        }
    }

    #[test]
    fn times_of_day_have_two_colons_or_one() {
        assert_eq!(clock(b"17:57:05.25"), Some(64_625_250_000_000));
        assert_eq!(clock(b"7:05"), Some(25_500 * SECOND));
        assert_eq!(clock(b"23:59:60"), Some(DAY));
        for bad in ["17", "17:5", "25:00", "17:60", "17:57:05.", "17:57:5", "17:57:05x"] {
            assert_eq!(clock(bad.as_bytes()), None, "{bad}");
        }
    }
}
