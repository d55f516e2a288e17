//! A text as a value of a column.

use std::borrow::Cow;

use parquet::basic::Type;

use super::super::timestamp;
use super::kind::Kind;
use super::value::Value;

/// How a column stores its values.
#[derive(Debug, Clone, Copy)]
pub(super) struct Storage {
    pub(super) kind: Kind,
    pub(super) physical: Type,
    /// Bytes of each value, where they have a fixed length.
    pub(super) length: i32,
}

impl Storage {
    /// The value that a text says; the nearest one that the column can hold. None where it says none.
    pub(super) fn value(self, text: &str) -> Option<Value<'static>> {
        match self.kind {
            Kind::Boolean => boolean(text).map(Value::Bool),
            Kind::Signed(bits) => self.whole(signed(text, bits)?),
            Kind::Unsigned(bits) => self.whole(unsigned(text, bits)?),
            Kind::Float => text.parse().ok().map(Value::F32),
            Kind::Double => text.parse().ok().map(Value::F64),
            Kind::Half => {
                let number = half::f16::from_f64(text.parse().ok()?);
                Some(Value::Bytes(Cow::Owned(number.to_le_bytes().to_vec())))
            }
            Kind::Decimal { scale, precision } => self.decimal(unscaled(text, scale, precision)?),
            Kind::Date => self.whole(timestamp::iso(text.as_bytes())?.div_euclid(super::super::calendar::DAY)),
            Kind::Clock(unit) => self.whole(timestamp::clock(text.as_bytes())? / (1_000_000_000 / unit.per_second())),
            Kind::Timestamp { unit, .. } => {
                self.whole(timestamp::iso(text.as_bytes())?.div_euclid(1_000_000_000 / unit.per_second()))
            }
            Kind::Int96 => Some(Value::I96(int96(timestamp::iso(text.as_bytes())?))),
            Kind::Text => Some(bytes(text)),
            Kind::Bytes if self.physical == Type::BYTE_ARRAY => Some(bytes(text)),
            Kind::Bytes | Kind::Uuid | Kind::Interval => None,
        }
    }

    /// The fill value in a column of floats that cannot be null.
    pub(super) fn not_a_number(self) -> Option<Value<'static>> {
        if self.kind.is_float() { self.value("NaN") } else { None }
    }

    fn whole(self, value: i64) -> Option<Value<'static>> {
        #[expect(clippy::cast_possible_truncation, reason = "the low half holds the bits of a number that fits")]
        match self.physical {
            Type::INT32 => Some(Value::I32(value as i32)),
            Type::INT64 => Some(Value::I64(value)),
            _ => None,
        }
    }

    fn decimal(self, unscaled: i128) -> Option<Value<'static>> {
        match self.physical {
            Type::INT32 => i32::try_from(unscaled).ok().map(Value::I32),
            Type::INT64 => i64::try_from(unscaled).ok().map(Value::I64),
            Type::BYTE_ARRAY => {
                let all = unscaled.to_be_bytes();
                let fill = if unscaled < 0 { 0xff } else { 0 };
                // The shortest bytes whose first bit is the sign.
                let spare = all.windows(2).take_while(|w| w[0] == fill && (w[1] ^ fill) & 0x80 == 0).count();
                Some(Value::Bytes(Cow::Owned(all[spare..].to_vec())))
            }
            Type::FIXED_LEN_BYTE_ARRAY => {
                let length = usize::try_from(self.length).ok()?;
                let all = unscaled.to_be_bytes();
                let fill = if unscaled < 0 { 0xff } else { 0 };
                let mut stored = vec![fill; length.saturating_sub(all.len())];
                stored.extend_from_slice(&all[all.len().saturating_sub(length)..]);
                Some(Value::Bytes(Cow::Owned(stored)))
            }
            _ => None,
        }
    }
}

fn bytes(text: &str) -> Value<'static> {
    Value::Bytes(Cow::Owned(text.as_bytes().to_vec()))
}

fn boolean(text: &str) -> Option<bool> {
    match text {
        "TRUE" => Some(true),
        "FALSE" => Some(false),
        number => number.parse::<f64>().ok().map(|n| n >= 0.5),
    }
}

/// The nearest number of this many bits.
#[expect(clippy::cast_possible_truncation, reason = "saturates")]
fn signed(text: &str, bits: u32) -> Option<i64> {
    let most = i64::MAX >> (64 - bits.clamp(8, 64));
    let value = text.parse::<i64>().ok().or_else(|| Some(finite(text)?.round() as i64))?;
    Some(value.clamp(-most - 1, most))
}

/// The nearest number from 0 of this many bits, as the bits that store it.
#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "saturates")]
fn unsigned(text: &str, bits: u32) -> Option<i64> {
    let most = u64::MAX >> (64 - bits.clamp(8, 64));
    let value = text.parse::<u64>().ok().or_else(|| Some(finite(text)?.round() as u64))?;
    Some(value.min(most).cast_signed())
}

fn finite(text: &str) -> Option<f64> {
    text.parse().ok().filter(|n: &f64| n.is_finite())
}

/// The nearest whole number of units of 10^-scale, of this many digits.
fn unscaled(text: &str, scale: u32, precision: u32) -> Option<i128> {
    let value = finite(text)?;
    let digits = format!("{value:.0$}", scale as usize).replace('.', "");
    let most = 10_i128.checked_pow(precision).map_or(i128::MAX, |p| p - 1);
    let nearest = if value < 0.0 { -most } else { most };
    Some(digits.parse().unwrap_or(nearest).clamp(-most, most))
}

/// Nanoseconds since 1970 as old writers store them.
#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "halves of a number of 64 bits")]
fn int96(ns: i64) -> [u32; 3] {
    const JULIAN_DAY_OF_1970: i64 = 2_440_588;
    let (day, of_day) =
        (ns.div_euclid(super::super::calendar::DAY), ns.rem_euclid(super::super::calendar::DAY).cast_unsigned());
    [of_day as u32, (of_day >> 32) as u32, (day + JULIAN_DAY_OF_1970) as u32]
}
