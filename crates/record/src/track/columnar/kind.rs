//! What the values of a column mean, and their text in CSV.

use parquet::basic::{ConvertedType, LogicalType, TimeUnit, Type};
use parquet::schema::types::ColumnDescriptor;

use super::value::Value;
use text::{clock, date, decimal, hexadecimal, interval, nanoseconds, shown, uuid, whole};

mod text;

/// A number as short as it reads back.
#[cfg(feature = "hdf5")]
pub(crate) use text::float;
/// A text, in quotes where a cell needs them.
#[cfg(feature = "hdf5")]
pub(crate) use text::text as quoted;

/// A moment in nanoseconds since 1970, which has this many decimals of a second, in ISO 8601.
#[cfg(feature = "hdf5")]
pub(crate) fn timestamp(ns: i128, digits: u32, out: &mut Vec<u8>) {
    let units = ns.div_euclid(10_i128.pow(9_u32.saturating_sub(digits)));
    text::timestamp(units, Unit { digits }, true, out);
}

/// What the values of a column mean: its logical type, or what its physical type says alone.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Kind {
    Boolean,
    /// A whole number of this many bits.
    Signed(u32),
    /// A whole number from 0 of this many bits.
    Unsigned(u32),
    Float,
    Double,
    /// A number of 16 bits.
    Half,
    /// A whole number of units of 10^-scale, of this many digits at most.
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

    /// This many make a second.
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
            (Self::Timestamp { unit, utc }, Value::I64(_)) => text::timestamp(whole(value).into(), unit, utc, out),
            // Bits that a number from 0 gives another meaning than a signed one.
            (Self::Unsigned(_), Value::I32(v)) => shown(out, v.cast_unsigned()),
            (Self::Unsigned(_), Value::I64(v)) => shown(out, v.cast_unsigned()),
            (_, Value::I32(v)) => shown(out, v),
            (_, Value::I64(v)) => shown(out, v),
            (_, Value::F32(v)) => text::float(*v, out),
            (_, Value::F64(v)) => text::float(*v, out),
            (_, Value::I96(parts)) => text::timestamp(nanoseconds(*parts), Unit::NANOS, false, out),
            (Self::Half, Value::Bytes(bytes)) => match bytes.as_ref() {
                [low, high] => text::float(half::f16::from_le_bytes([*low, *high]).to_f32(), out),
                other => hexadecimal(other, out),
            },
            (Self::Uuid, Value::Bytes(bytes)) => uuid(bytes, out),
            (Self::Interval, Value::Bytes(bytes)) => interval(bytes, out),
            (_, Value::Bytes(bytes)) => text::text(bytes, out),
        }
    }
}
