//! The text of a cell.

use super::super::columnar::{float, quoted, timestamp};
use super::array::Bytes;
use super::cf_time::{Stamp, rounded};
use super::columns::{Column, Meaning, Scale};
use super::errors::Trouble;
use super::scalar::{Kind, Scalar, write_text};

/// Writes the cell of a row; nothing where there is no value.
///
/// # Errors
/// When a text that stands elsewhere in the file cannot be read.
pub(super) fn write(
    column: &Column,
    stored: &[u8],
    row: u64,
    file: &dyn Bytes,
    out: &mut Vec<u8>,
) -> Result<(), Trouble> {
    match &column.kind {
        Kind::Text { size } => {
            if let Some(text) = column.bytes(stored, row).and_then(|bytes| bytes.get(..*size)) {
                write_text(text, out);
            }
        }
        Kind::TextElsewhere { size } => {
            if let Some(reference) = column.bytes(stored, row).and_then(|bytes| bytes.get(..*size)) {
                write_text(&file.text(column.place, reference)?, out);
            }
        }
        Kind::Named { names, .. } => {
            let Some(value) = column.number(stored, row) else { return Ok(()) };
            match names.iter().find(|(number, _)| Scalar::Int(*number) == value) {
                Some((_, name)) => quoted(name.as_bytes(), out),
                None => value.write(out),
            }
        }
        Kind::Int { .. } | Kind::Float { .. } => {
            if let Some(value) = column.number(stored, row) {
                write_number(column.meaning, value, out);
            }
        }
    }
    Ok(())
}

fn write_number(meaning: Meaning, value: Scalar, out: &mut Vec<u8>) {
    match meaning {
        Meaning::Moment { stamp, digits } => write_moment(stamp, digits, value, out),
        Meaning::Scaled(scale) => scale.write(value, out),
        Meaning::Plain => value.write(out),
    }
}

/// A number that is no moment stays what it is: its row has no time then.
fn write_moment(stamp: Stamp, digits: u32, value: Scalar, out: &mut Vec<u8>) {
    match stamp.moment(value) {
        Some(ns) => timestamp(rounded(ns, digits), digits, out),
        None if value.as_f64().is_nan() => {}
        None => value.write(out),
    }
}

impl Scale {
    fn write(self, value: Scalar, out: &mut Vec<u8>) {
        match (self, value) {
            (Self::Exact { factor, offset, decimals }, Scalar::Int(raw)) => {
                match raw.checked_mul(factor).and_then(|product| product.checked_add(offset)) {
                    Some(units) => write_decimal(units, decimals as usize, out),
                    None => value.write(out),
                }
            }
            (Self::Exact { .. }, other) => other.write(out),
            #[expect(clippy::cast_possible_truncation, reason = "the file says that 32 bits are meant")]
            (Self::Float { factor, offset, single: true }, raw) => {
                float(raw.as_f64().mul_add(factor, offset) as f32, out);
            }
            (Self::Float { factor, offset, single: false }, raw) => float(raw.as_f64() * factor + offset, out),
        }
    }
}

/// Whole units of this many decimals as a number.
fn write_decimal(units: i128, decimals: usize, out: &mut Vec<u8>) {
    if units < 0 {
        out.push(b'-');
    }
    let digits = format!("{:0>1$}", units.unsigned_abs(), decimals + 1);
    let (whole, part) = digits.split_at(digits.len() - decimals);
    out.extend_from_slice(whole.as_bytes());
    if decimals > 0 {
        out.push(b'.');
        out.extend_from_slice(part.as_bytes());
    }
}
