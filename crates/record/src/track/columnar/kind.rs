//! What the values of a column mean, and their text in CSV.

use std::io::Write as _;

use parquet::basic::{ConvertedType, LogicalType, TimeUnit, Type};
use parquet::schema::types::ColumnDescriptor;

use super::super::calendar::Date;
use super::value::Value;

/// What the values of a column mean: its logical type, or what its physical type says alone.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Kind {
    Boolean,
    /// A whole number of so many bits.
    Signed(u32),
    /// A whole number from 0 of so many bits.
    Unsigned(u32),
    Float,
    Double,
    /// A number of 16 bits.
    Half,
    /// A whole number of units of 10^-scale, of so many digits at most.
    Decimal {
        scale: u32,
        precision: u32,
    },
    /// Days since 1970.
    Date,
    /// Units since midnight.
    Clock(Unit),
    /// Units since 1970.
    Timestamp {
        unit: Unit,
        /// True for moments, false for what a local clock shows.
        utc: bool,
    },
    /// A timestamp of nanoseconds as old writers store it.
    Int96,
    Text,
    /// Bytes that may be text or not.
    Bytes,
    Uuid,
    /// Months, days and milliseconds.
    Interval,
}

/// A part of a second.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Unit {
    /// Decimals of a second.
    pub(super) digits: u32,
}

impl Unit {
    pub(super) const NANOS: Self = Self { digits: 9 };

    fn of(unit: TimeUnit) -> Self {
        let digits = match unit {
            TimeUnit::MILLIS => 3,
            TimeUnit::MICROS => 6,
            TimeUnit::NANOS => 9,
        };
        Self { digits }
    }

    /// So many make a second.
    pub(super) fn per_second(self) -> i64 {
        10_i64.pow(self.digits)
    }
}

impl Kind {
    /// What the values of a column mean.
    pub(super) fn of(column: &ColumnDescriptor) -> Self {
        column.logical_type_ref().and_then(Self::logical).or_else(|| Self::converted(column)).unwrap_or_else(|| {
            match column.physical_type() {
                Type::BOOLEAN => Self::Boolean,
                Type::INT32 => Self::Signed(32),
                Type::INT64 => Self::Signed(64),
                Type::INT96 => Self::Int96,
                Type::FLOAT => Self::Float,
                Type::DOUBLE => Self::Double,
                Type::BYTE_ARRAY | Type::FIXED_LEN_BYTE_ARRAY => Self::Bytes,
            }
        })
    }

    fn logical(logical: &LogicalType) -> Option<Self> {
        Some(match logical {
            LogicalType::String | LogicalType::Enum | LogicalType::Json => Self::Text,
            LogicalType::Decimal(d) => Self::decimal(d.scale, d.precision),
            LogicalType::Date => Self::Date,
            LogicalType::Time(time) => Self::Clock(Unit::of(time.unit)),
            LogicalType::Timestamp(t) => Self::Timestamp { unit: Unit::of(t.unit), utc: t.is_adjusted_to_u_t_c },
            LogicalType::Integer(int) if int.is_signed => Self::Signed(int.bit_width.unsigned_abs().into()),
            LogicalType::Integer(int) => Self::Unsigned(int.bit_width.unsigned_abs().into()),
            LogicalType::Uuid => Self::Uuid,
            LogicalType::Float16 => Self::Half,
            _ => return None,
        })
    }

    fn converted(column: &ColumnDescriptor) -> Option<Self> {
        let moment = |unit| Self::Timestamp { unit: Unit::of(unit), utc: true };
        Some(match column.converted_type() {
            ConvertedType::UTF8 | ConvertedType::ENUM | ConvertedType::JSON => Self::Text,
            ConvertedType::DECIMAL => Self::decimal(column.type_scale(), column.type_precision()),
            ConvertedType::DATE => Self::Date,
            ConvertedType::TIME_MILLIS => Self::Clock(Unit::of(TimeUnit::MILLIS)),
            ConvertedType::TIME_MICROS => Self::Clock(Unit::of(TimeUnit::MICROS)),
            ConvertedType::TIMESTAMP_MILLIS => moment(TimeUnit::MILLIS),
            ConvertedType::TIMESTAMP_MICROS => moment(TimeUnit::MICROS),
            ConvertedType::UINT_8 => Self::Unsigned(8),
            ConvertedType::UINT_16 => Self::Unsigned(16),
            ConvertedType::UINT_32 => Self::Unsigned(32),
            ConvertedType::UINT_64 => Self::Unsigned(64),
            ConvertedType::INT_8 => Self::Signed(8),
            ConvertedType::INT_16 => Self::Signed(16),
            ConvertedType::INT_32 => Self::Signed(32),
            ConvertedType::INT_64 => Self::Signed(64),
            ConvertedType::INTERVAL => Self::Interval,
            _ => return None,
        })
    }

    fn decimal(scale: i32, precision: i32) -> Self {
        Self::Decimal { scale: scale.unsigned_abs(), precision: precision.unsigned_abs() }
    }

    /// How many decimals a number of the column has; none where it has as many as it needs, or is no number.
    pub(super) fn decimals(self) -> Option<usize> {
        match self {
            Self::Signed(_) | Self::Unsigned(_) => Some(0),
            Self::Decimal { scale, .. } => Some(scale as usize),
            _ => None,
        }
    }

    /// True for a number without decimals of its own.
    pub(super) fn is_float(self) -> bool {
        matches!(self, Self::Float | Self::Double | Self::Half)
    }

    /// Writes the text of a value as a cell of CSV.
    pub(super) fn write(self, value: &Value<'_>, out: &mut Vec<u8>) {
        match (self, value) {
            (_, Value::Bool(true)) => out.extend_from_slice(b"TRUE"),
            (_, Value::Bool(false)) => out.extend_from_slice(b"FALSE"),
            (Self::Decimal { scale, .. }, _) => decimal(value, scale, out),
            (Self::Date, Value::I32(days)) => date((*days).into(), out),
            (Self::Clock(unit), Value::I32(_) | Value::I64(_)) => clock(whole(value), unit, out),
            (Self::Timestamp { unit, utc }, Value::I64(_)) => timestamp(whole(value).into(), unit, utc, out),
            // Bits that a number from 0 gives another meaning than a signed one.
            (Self::Unsigned(_), Value::I32(v)) => shown(out, v.cast_unsigned()),
            (Self::Unsigned(_), Value::I64(v)) => shown(out, v.cast_unsigned()),
            (_, Value::I32(v)) => shown(out, v),
            (_, Value::I64(v)) => shown(out, v),
            (_, Value::F32(v)) => float(*v, out),
            (_, Value::F64(v)) => float(*v, out),
            (_, Value::I96(parts)) => timestamp(nanoseconds(*parts), Unit::NANOS, false, out),
            (Self::Half, Value::Bytes(bytes)) => match bytes.as_ref() {
                [low, high] => float(half::f16::from_le_bytes([*low, *high]).to_f32(), out),
                other => hexadecimal(other, out),
            },
            (Self::Uuid, Value::Bytes(bytes)) => uuid(bytes, out),
            (Self::Interval, Value::Bytes(bytes)) => interval(bytes, out),
            (_, Value::Bytes(bytes)) => text(bytes, out),
        }
    }
}

fn shown(out: &mut Vec<u8>, value: impl std::fmt::Display) {
    let _ = write!(out, "{value}");
}

fn whole(value: &Value<'_>) -> i64 {
    match value {
        Value::I32(v) => (*v).into(),
        Value::I64(v) => *v,
        _ => 0,
    }
}

/// The shortest text that reads back as the same number, as [`number_text`](super::super::number_text()) writes it.
fn float<F: Into<f64> + Copy + std::fmt::Display + std::fmt::LowerExp>(value: F, out: &mut Vec<u8>) {
    let size = value.into().abs();
    if size == 0.0 || !size.is_finite() || (1e-5..1e16).contains(&size) {
        shown(out, value);
    } else {
        let _ = write!(out, "{value:e}");
    }
}

fn decimal(value: &Value<'_>, scale: u32, out: &mut Vec<u8>) {
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
fn nanoseconds([low, high, day]: [u32; 3]) -> i128 {
    const JULIAN_DAY_OF_1970: i128 = 2_440_588;
    let of_day = i128::from(u64::from(high) << 32 | u64::from(low));
    (i128::from(day) - JULIAN_DAY_OF_1970) * 86_400_000_000_000 + of_day
}

fn date(days: i64, out: &mut Vec<u8>) {
    let Date { year, month, day } = Date::of_days(days);
    digits(out, year, 4);
    out.push(b'-');
    digits(out, month, 2);
    out.push(b'-');
    digits(out, day, 2);
}

fn clock(of_day: i64, unit: Unit, out: &mut Vec<u8>) {
    let (seconds, part) = (of_day.div_euclid(unit.per_second()), of_day.rem_euclid(unit.per_second()));
    digits(out, seconds / 3600, 2);
    out.push(b':');
    digits(out, seconds / 60 % 60, 2);
    out.push(b':');
    digits(out, seconds % 60, 2);
    out.push(b'.');
    digits(out, part, unit.digits as usize);
}

fn timestamp(units: i128, unit: Unit, utc: bool, out: &mut Vec<u8>) {
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

fn uuid(bytes: &[u8], out: &mut Vec<u8>) {
    for (i, byte) in bytes.iter().enumerate() {
        if matches!(i, 4 | 6 | 8 | 10) {
            out.push(b'-');
        }
        let _ = write!(out, "{byte:02x}");
    }
}

/// As ISO 8601 writes durations.
fn interval(bytes: &[u8], out: &mut Vec<u8>) {
    let part = |at: usize| bytes.get(at..at + 4).and_then(|b| b.try_into().ok()).map_or(0, u32::from_le_bytes);
    let (months, days, millis) = (part(0), part(4), part(8));
    let _ = write!(out, "P{months}M{days}DT{}.{:03}S", millis / 1000, millis % 1000);
}

/// Bytes that are no text, as far as they are shown.
fn hexadecimal(bytes: &[u8], out: &mut Vec<u8>) {
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
fn text(bytes: &[u8], out: &mut Vec<u8>) {
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
