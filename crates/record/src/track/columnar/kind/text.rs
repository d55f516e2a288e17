//! The texts of values.

use std::io::Write as _;

use super::super::super::calendar::Date;
use super::super::value::Value;
use super::Unit;

pub(super) fn shown(out: &mut Vec<u8>, value: impl std::fmt::Display) {
    let _ = write!(out, "{value}");
}

pub(super) fn whole(value: &Value<'_>) -> i64 {
    match value {
        Value::I32(v) => (*v).into(),
        Value::I64(v) => *v,
        _ => 0,
    }
}

/// The shortest text that reads back as the same number, as [`number_text`](crate::track::number_text()) writes it.
pub(crate) fn float<F: Into<f64> + Copy + std::fmt::Display + std::fmt::LowerExp>(value: F, out: &mut Vec<u8>) {
    let size = value.into().abs();
    if size == 0.0 || !size.is_finite() || (1e-5..1e16).contains(&size) {
        shown(out, value);
    } else {
        let _ = write!(out, "{value:e}");
    }
}

pub(super) fn decimal(value: &Value<'_>, scale: u32, out: &mut Vec<u8>) {
    let unscaled = match value {
        Value::I32(v) => Some(i128::from(*v)),
        Value::I64(v) => Some(i128::from(*v)),
        Value::Bytes(bytes) => big_endian(bytes),
        _ => None,
    };
    let Some(unscaled) = unscaled else {
        // More digits than 128 bits hold.
        if let Value::Bytes(bytes) = value {
            hexadecimal(bytes, out);
        }
        return;
    };
    if unscaled < 0 {
        out.push(b'-');
    }
    let width = scale as usize;
    let digits = format!("{:0>1$}", unscaled.unsigned_abs(), width + 1);
    let (whole, part) = digits.split_at(digits.len() - width);
    out.extend_from_slice(whole.as_bytes());
    if width > 0 {
        out.push(b'.');
        out.extend_from_slice(part.as_bytes());
    }
}

/// A signed number, the highest byte first; none where it has more than 128 bits.
fn big_endian(bytes: &[u8]) -> Option<i128> {
    let fill = if bytes.first().is_some_and(|b| b & 0x80 != 0) { 0xff } else { 0 };
    let (beyond, kept) = bytes.split_at(bytes.len().saturating_sub(16));
    let sign = kept.first().is_none_or(|b| (b & 0x80 != 0) == (fill == 0xff));
    (beyond.iter().all(|b| *b == fill) && sign).then(|| {
        let mut all = [fill; 16];
        all[16 - kept.len()..].copy_from_slice(kept);
        i128::from_be_bytes(all)
    })
}

/// Nanoseconds since 1970.
pub(super) fn nanoseconds([low, high, day]: [u32; 3]) -> i128 {
    const JULIAN_DAY_OF_1970: i128 = 2_440_588;
    let of_day = i128::from(u64::from(high) << 32 | u64::from(low));
    (i128::from(day) - JULIAN_DAY_OF_1970) * 86_400_000_000_000 + of_day
}

pub(super) fn date(days: i64, out: &mut Vec<u8>) {
    let Date { year, month, day } = Date::of_days(days);
    digits(out, year, 4);
    out.push(b'-');
    digits(out, month, 2);
    out.push(b'-');
    digits(out, day, 2);
}

pub(super) fn clock(of_day: i64, unit: Unit, out: &mut Vec<u8>) {
    let (seconds, part) = (of_day.div_euclid(unit.per_second()), of_day.rem_euclid(unit.per_second()));
    digits(out, seconds / 3600, 2);
    out.push(b':');
    digits(out, seconds / 60 % 60, 2);
    out.push(b':');
    digits(out, seconds % 60, 2);
    if unit.digits > 0 {
        out.push(b'.');
        digits(out, part, unit.digits as usize);
    }
}

pub(super) fn timestamp(units: i128, unit: Unit, utc: bool, out: &mut Vec<u8>) {
    let day = i128::from(86_400 * unit.per_second());
    date(i64::try_from(units.div_euclid(day)).unwrap_or_default(), out);
    out.push(b'T');
    clock(i64::try_from(units.rem_euclid(day)).unwrap_or_default(), unit, out);
    if utc {
        out.push(b'Z');
    }
}

/// A number with zeros before it.
fn digits(out: &mut Vec<u8>, value: i64, width: usize) {
    let from = out.len();
    let mut rest = value.unsigned_abs();
    while rest > 0 || out.len() - from < width {
        out.push(b'0' + (rest % 10) as u8);
        rest /= 10;
    }
    if value < 0 {
        out.push(b'-');
    }
    out[from..].reverse();
}

pub(super) fn uuid(bytes: &[u8], out: &mut Vec<u8>) {
    for (i, byte) in bytes.iter().enumerate() {
        if matches!(i, 4 | 6 | 8 | 10) {
            out.push(b'-');
        }
        let _ = write!(out, "{byte:02x}");
    }
}

/// As ISO 8601 writes durations.
pub(super) fn interval(bytes: &[u8], out: &mut Vec<u8>) {
    let part = |at: usize| bytes.get(at..at + 4).and_then(|b| b.try_into().ok()).map_or(0, u32::from_le_bytes);
    let (months, days, millis) = (part(0), part(4), part(8));
    let _ = write!(out, "P{months}M{days}DT{}.{:03}S", millis / 1000, millis % 1000);
}

/// Bytes that are no text, as far as they are shown.
pub(super) fn hexadecimal(bytes: &[u8], out: &mut Vec<u8>) {
    const SHOWN: usize = 64;
    out.extend_from_slice(b"0x");
    for byte in &bytes[..bytes.len().min(SHOWN)] {
        let _ = write!(out, "{byte:02x}");
    }
    if bytes.len() > SHOWN {
        out.extend_from_slice("…".as_bytes());
    }
}

/// Bytes of the longest text that is a cell: a longer one would pass for a quote that is not closed.
const LONGEST: usize = 64 << 10;
/// Lines of such a text.
const MOST_LINES: usize = 500;

/// A text, in quotes where a cell needs them.
pub(crate) fn text(bytes: &[u8], out: &mut Vec<u8>) {
    let Ok(whole) = std::str::from_utf8(bytes) else { return hexadecimal(bytes, out) };
    if whole.contains('\0') {
        return hexadecimal(bytes, out);
    }
    let mut end = whole.len().min(LONGEST);
    while !whole.is_char_boundary(end) {
        end -= 1;
    }
    let lines = whole[..end].match_indices('\n').nth(MOST_LINES).map_or(end, |(at, _)| at);
    let shown = &whole[..lines];
    let needed = shown.contains([',', '"', '\n', '\r']) || shown.trim() != shown || shown.starts_with('\'');
    let cut = if lines < whole.len() { "…" } else { "" };
    if needed {
        shown_quoted(out, shown, cut);
    } else {
        out.extend_from_slice(shown.as_bytes());
        out.extend_from_slice(cut.as_bytes());
    }
}

fn shown_quoted(out: &mut Vec<u8>, text: &str, cut: &str) {
    let _ = write!(out, "\"{}{cut}\"", text.replace('"', "\"\""));
}
