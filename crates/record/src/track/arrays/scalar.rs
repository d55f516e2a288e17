//! Single values as files store them, and their texts.

use std::io::Write as _;

use super::super::columnar::{float, quoted};

/// A number.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Scalar {
    Int(i128),
    F32(f32),
    F64(f64),
}

impl Scalar {
    #[expect(clippy::cast_precision_loss, reason = "a number for arithmetic")]
    pub(super) fn as_f64(self) -> f64 {
        match self {
            Self::Int(v) => v as f64,
            Self::F32(v) => v.into(),
            Self::F64(v) => v,
        }
    }

    /// True where a value of a column is this marker, which may be of another type.
    #[expect(clippy::cast_possible_truncation, reason = "the marker as the column would hold it")]
    #[expect(clippy::float_cmp, reason = "a marker is equal bit for bit")]
    pub(super) fn marks(self, value: Self) -> bool {
        match (self, value) {
            (Self::Int(marker), Self::Int(value)) => marker == value,
            (marker, Self::F32(value)) => marker.as_f64() as f32 == value,
            (marker, value) => marker.as_f64() == value.as_f64(),
        }
    }

    /// The shortest text that reads back as the same number.
    pub(super) fn write(self, out: &mut Vec<u8>) {
        match self {
            Self::Int(v) => {
                let _ = write!(out, "{v}");
            }
            Self::F32(v) => float(v, out),
            Self::F64(v) => float(v, out),
        }
    }

    /// The same as a text.
    pub(super) fn text(self) -> String {
        let mut out = Vec::new();
        self.write(&mut out);
        String::from_utf8(out).unwrap_or_default()
    }
}

/// How a value is stored.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Kind {
    Int {
        size: usize,
        signed: bool,
        big: bool,
    },
    Float {
        size: usize,
        big: bool,
    },
    /// Text of this many bytes.
    Text {
        size: usize,
    },
    /// Where a text of any length stands.
    TextElsewhere {
        size: usize,
    },
    /// A number that stands for one of these names.
    Named {
        base: Box<Kind>,
        names: Vec<(i128, String)>,
    },
}

impl Kind {
    /// A truth in a byte.
    pub(super) fn truth() -> Self {
        let names = vec![(0, "FALSE".to_owned()), (1, "TRUE".to_owned())];
        Self::Named { base: Box::new(Self::Int { size: 1, signed: false, big: false }), names }
    }

    /// How many bytes a value has.
    pub(super) fn size(&self) -> usize {
        match self {
            Self::Int { size, .. } | Self::Float { size, .. } | Self::Text { size } | Self::TextElsewhere { size } => {
                *size
            }
            Self::Named { base, .. } => base.size(),
        }
    }

    /// True for numbers, which can be a channel.
    pub(super) fn is_number(&self) -> bool {
        matches!(self, Self::Int { .. } | Self::Float { .. })
    }

    /// True for numbers without decimals.
    pub(super) fn is_whole(&self) -> bool {
        matches!(self, Self::Int { .. })
    }

    /// The number in `bytes`; none for text, and where they are too few.
    pub(super) fn number(&self, bytes: &[u8]) -> Option<Scalar> {
        let bytes = bytes.get(..self.size())?;
        match self {
            Self::Int { signed, big, .. } => Some(Scalar::Int(whole(bytes, *signed, *big))),
            Self::Float { size: 2, big } => {
                let bits = u16::try_from(whole(bytes, false, *big)).ok()?;
                Some(Scalar::F32(half::f16::from_bits(bits).to_f32()))
            }
            Self::Float { size: 4, big } => {
                let bits = u32::try_from(whole(bytes, false, *big)).ok()?;
                Some(Scalar::F32(f32::from_bits(bits)))
            }
            Self::Float { size: 8, big } => {
                let bits = u64::try_from(whole(bytes, false, *big)).ok()?;
                Some(Scalar::F64(f64::from_bits(bits)))
            }
            Self::Named { base, .. } => base.number(bytes),
            Self::Float { .. } | Self::Text { .. } | Self::TextElsewhere { .. } => None,
        }
    }
}

/// A whole number in at most eight bytes.
fn whole(bytes: &[u8], signed: bool, big: bool) -> i128 {
    let add = |sum: i128, byte: &u8| sum << 8 | i128::from(*byte);
    let value = if big { bytes.iter().fold(0, add) } else { bytes.iter().rev().fold(0, add) };
    let bits = 8 * bytes.len();
    if signed && bits > 0 && value >> (bits - 1) & 1 == 1 { value - (1_i128 << bits) } else { value }
}

/// Writes the text in bytes of a fixed length, without what fills them up.
pub(super) fn write_text(bytes: &[u8], out: &mut Vec<u8>) {
    let end = bytes.iter().position(|b| *b == 0).unwrap_or(bytes.len());
    let kept = bytes[..end].trim_ascii_end();
    // What is no UTF-8 is written byte for byte as Latin-1, as old programs meant it.
    match std::str::from_utf8(kept) {
        Ok(_) => quoted(kept, out),
        Err(_) => quoted(kept.iter().map(|b| char::from(*b)).collect::<String>().as_bytes(), out),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_of_either_order_and_sign_are_read() {
        let int = |size, signed, big| Kind::Int { size, signed, big };
        assert_eq!(int(2, true, true).number(&[0xff, 0xfe]), Some(Scalar::Int(-2)));
        assert_eq!(int(2, false, false).number(&[0xfe, 0xff]), Some(Scalar::Int(65_534)));
        assert_eq!(int(8, true, false).number(&i64::MIN.to_le_bytes()), Some(Scalar::Int(i64::MIN.into())));
        assert_eq!(int(8, false, true).number(&u64::MAX.to_be_bytes()), Some(Scalar::Int(u64::MAX.into())));
        assert_eq!(Kind::Float { size: 4, big: true }.number(&1.5_f32.to_be_bytes()), Some(Scalar::F32(1.5)));
        assert_eq!(Kind::Float { size: 2, big: false }.number(&[0x00, 0x3e]), Some(Scalar::F32(1.5)));
        assert_eq!(Kind::Float { size: 8, big: false }.number(&[0; 7]), None);
    }

    #[test]
    fn a_marker_of_another_type_marks_what_the_column_would_hold() {
        assert!(Scalar::F64(9.969_209_968_386_869e36).marks(Scalar::F32(9.969_21e36)));
        assert!(Scalar::F64(-999.0).marks(Scalar::Int(-999)));
        assert!(!Scalar::Int(-999).marks(Scalar::F64(-999.5)));
    }
}
