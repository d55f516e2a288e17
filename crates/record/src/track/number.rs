//! Numbers and missing markers of a cell, both ways.

use std::borrow::Cow;

use super::Rules;

/// What a cell of a numeric column holds.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Cell {
    /// A finite number.
    Number(f64),
    /// No value: empty, or a marker for it.
    Missing,
    /// A number too large for a double, or `inf`.
    Infinite,
    /// Something else.
    Text,
}

/// Markers for "no value" that need not be told, in lower case.
pub(crate) const MARKERS: [&str; 7] = ["nan", "na", "n/a", "null", "none", "-", "--"];

/// Powers of ten that are doubles exactly.
pub(crate) const POWERS: [f64; 23] = [
    1e0, 1e1, 1e2, 1e3, 1e4, 1e5, 1e6, 1e7, 1e8, 1e9, 1e10, 1e11, 1e12, 1e13, 1e14, 1e15, 1e16, 1e17, 1e18, 1e19, 1e20,
    1e21, 1e22,
];

/// How the cells of a file are read.
#[derive(Debug, Clone, Default)]
pub struct Reading {
    /// True when a comma is the decimal sign.
    pub(crate) decimal_comma: bool,
    texts: Vec<String>,
    values: Vec<f64>,
    /// By which rules it is told what a cell looks like.
    pub(crate) rules: Rules,
}

impl Reading {
    /// With the markers for "no value" that the user names, beside the usual ones.
    #[must_use]
    pub fn new(decimal_comma: bool, markers: &[String]) -> Self {
        let mut reading = Self { decimal_comma, ..Self::default() };
        for marker in markers {
            match reading.number(marker.trim().as_bytes()) {
                Some(value) => reading.values.push(value),
                None => reading.texts.push(marker.trim().to_owned()),
            }
        }
        reading
    }

    /// The same by other rules.
    pub(crate) fn by(self, rules: Rules) -> Self {
        Self { rules, ..self }
    }

    /// What `cell`, trimmed and unquoted, holds.
    #[inline]
    #[must_use]
    pub fn cell(&self, cell: &[u8]) -> Cell {
        let value = match short_decimal(cell, if self.decimal_comma { b',' } else { b'.' }) {
            Some(value) => value,
            None if self.is_marker(cell) => return Cell::Missing,
            None => match self.number(cell) {
                None => return Cell::Text,
                Some(value) if value.is_finite() => value,
                Some(value) if value.is_nan() => return Cell::Missing,
                Some(_) => return Cell::Infinite,
            },
        };
        if self.is_missing(value) { Cell::Missing } else { Cell::Number(value) }
    }

    /// True when the user told that `value` is a fill value.
    #[inline]
    pub(crate) fn is_missing(&self, value: f64) -> bool {
        self.values.contains(&value)
    }

    /// True when `cell` is empty or a marker that is not a number.
    pub(crate) fn is_marker(&self, cell: &[u8]) -> bool {
        cell.is_empty()
            || (cell.len() <= 4 && MARKERS.iter().any(|m| cell.eq_ignore_ascii_case(m.as_bytes())))
            || self.texts.iter().any(|m| cell == m.as_bytes())
    }

    /// The number in `text`, in the form of the file.
    pub(crate) fn number(&self, text: &[u8]) -> Option<f64> {
        let text = std::str::from_utf8(text).ok()?;
        if !self.decimal_comma {
            return text.parse().ok();
        }
        // A point would be taken for thousands by one reader and for decimals by another.
        if text.contains('.') { None } else { text.replacen(',', ".", 1).parse().ok() }
    }

    /// `value` as the file writes numbers.
    pub(crate) fn written(&self, value: f64) -> Cow<'static, str> {
        let text = number_text(value);
        if self.decimal_comma { Cow::Owned(text.replace('.', ",")) } else { Cow::Owned(text) }
    }
}

/// A plain decimal number whose digits make an integer below 2^53: one division gives the correctly rounded double,
/// because both operands are exact (Clinger, "How to read floating point numbers accurately", 1990).
#[inline]
fn short_decimal(cell: &[u8], point: u8) -> Option<f64> {
    let (negative, digits) = match cell {
        [b'-', rest @ ..] => (true, rest),
        [b'+', rest @ ..] => (false, rest),
        _ => (false, cell),
    };
    // 18 digits cannot overflow a u64; the loop then needs no check.
    if digits.is_empty() || digits.len() > 19 {
        return None;
    }
    let mut mantissa = 0_u64;
    let mut decimals = None;
    for (i, &byte) in digits.iter().enumerate() {
        let digit = byte.wrapping_sub(b'0');
        if digit < 10 {
            mantissa = mantissa.wrapping_mul(10).wrapping_add(u64::from(digit));
        } else if byte == point && decimals.is_none() {
            decimals = Some(digits.len() - 1 - i);
        } else {
            return None;
        }
    }
    let count = digits.len() - usize::from(decimals.is_some());
    if count == 0 || count > 18 || mantissa >= 1 << 53 {
        return None;
    }
    #[expect(clippy::cast_precision_loss, reason = "below 2^53")]
    let value = match decimals {
        None => mantissa as f64,
        Some(decimals) => mantissa as f64 / POWERS[decimals],
    };
    Some(if negative { -value } else { value })
}

/// The shortest text that reads back as the same double: plain from 1e-5 to 1e16, with an exponent beyond, `NaN` for
/// what is no number.
#[must_use]
pub fn number_text(value: f64) -> String {
    let size = value.abs();
    if value == 0.0 || !value.is_finite() || (1e-5..1e16).contains(&size) {
        format!("{value}")
    } else {
        format!("{value:e}")
    }
}

/// A number that was rounded for people: without a sign where nothing but zeros is left of it, since -0.0 would say
/// that there is something below zero.
#[must_use]
pub fn without_signed_zero(text: String) -> String {
    let signed =
        text.starts_with(['-', '+']) && !text.contains(|c: char| matches!(c, '1'..='9' | 'a'..='d' | 'f'..='z'));
    if signed { text[1..].to_owned() } else { text }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn what_is_rounded_to_nothing_has_no_sign() {
        let shown = |text: &str| without_signed_zero(text.to_owned());
        assert_eq!(["-0.0", "+0.0", "-0", "-0e0"].map(shown), ["0.0", "0.0", "0", "0e0"]);
        assert_eq!(["-0.1", "+0.1", "-1e-5", "-inf", "0.0"].map(shown), ["-0.1", "+0.1", "-1e-5", "-inf", "0.0"]);
    }

    #[test]
    fn cells_hold_numbers_markers_or_text() {
        let point = Reading::new(false, &["-9999".into(), "void".into()]);
        for (text, cell) in [
            ("1.5", Cell::Number(1.5)),
            ("+.5", Cell::Number(0.5)),
            ("5.", Cell::Number(5.0)),
            ("1E+05", Cell::Number(1e5)),
            ("-5.391191E-05", Cell::Number(-5.391_191e-5)),
            ("-9999.0", Cell::Missing),
            ("void", Cell::Missing),
            ("", Cell::Missing),
            ("-", Cell::Missing),
            ("NaN", Cell::Missing),
            ("n/A", Cell::Missing),
            ("-nan", Cell::Missing),
            ("NULL", Cell::Missing),
            ("inf", Cell::Infinite),
            ("-1e400", Cell::Infinite),
            ("1,5", Cell::Text),
            (".", Cell::Text),
            ("+", Cell::Text),
            ("1-2", Cell::Text),
            ("1.2.3", Cell::Text),
            ("Void", Cell::Text),
            ("0x10", Cell::Text),
        ] {
            assert_eq!(point.cell(text.as_bytes()), cell, "{text}");
        }
        let comma = Reading::new(true, &["-1,5".into()]);
        assert_eq!(comma.cell(b"2,5"), Cell::Number(2.5));
        assert_eq!(comma.cell(b"2,5e3"), Cell::Number(2500.0));
        assert_eq!(comma.cell(b"-1,50"), Cell::Missing);
        assert_eq!(comma.cell(b"1.234"), Cell::Text);
        assert_eq!(comma.written(-0.25), "-0,25");
    }

    #[test]
    fn numbers_are_written_plain_where_people_write_them_plain() {
        for (value, text) in [
            (812.4, "812.4"),
            (1e15, "1000000000000000"),
            (1e16, "1e16"),
            (1e-5, "0.00001"),
            (9.5e-6, "9.5e-6"),
            (-0.0, "-0"),
            (f64::NAN, "NaN"),
        ] {
            assert_eq!(number_text(value), text);
        }
    }

    proptest! {
        #[test]
        fn written_numbers_read_back_as_the_same_double(bits: u64) {
            let value = f64::from_bits(bits);
            prop_assume!(value.is_finite());
            for decimal_comma in [false, true] {
                let reading = Reading::new(decimal_comma, &[]);
                prop_assert_eq!(reading.cell(reading.written(value).as_bytes()), Cell::Number(value));
            }
        }

        #[test]
        fn the_short_way_gives_what_the_standard_library_gives(text in "[+-]?[0-9]{0,12}[.]?[0-9]{0,12}") {
            if let Some(value) = short_decimal(text.as_bytes(), b'.') {
                prop_assert_eq!(value.to_bits(), text.parse::<f64>().unwrap().to_bits());
            }
        }
    }
}
