//! How a value stands in the text of a record.

use super::super::number::Reading;
use super::super::style::Style;

/// How a value stands in the text of a record.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Spelling {
    /// As a number.
    Number,
    /// As degrees and minutes with a hemisphere, `4807.038,N` (NMEA 0183). Read as degrees, south negative.
    Latitude,
    /// The same with three digits of degrees, `01131.000,E`. West is negative.
    Longitude,
}

/// Degrees and minutes with these letters for the hemispheres.
struct Angle {
    degrees: usize,
    positive: char,
    negative: char,
}

impl Spelling {
    fn angle(self) -> Option<Angle> {
        match self {
            Self::Number => None,
            Self::Latitude => Some(Angle { degrees: 2, positive: 'N', negative: 'S' }),
            Self::Longitude => Some(Angle { degrees: 3, positive: 'E', negative: 'W' }),
        }
    }

    /// The number that `text` stands for, as a text; empty where it stands for none.
    pub(crate) fn read(self, text: &str) -> String {
        let Some(angle) = self.angle() else { return text.to_owned() };
        angle.read(text).unwrap_or_default()
    }

    /// `value` in place of `old`.
    pub(crate) fn written(self, value: f64, old: &str, style: Option<&Style>, reading: &Reading) -> String {
        match (self.angle(), style) {
            (Some(angle), _) => angle.written(value, old),
            (None, Some(style)) => style.written(value, old, reading),
            (None, None) => reading.written(value).into_owned(),
        }
    }
}

impl Angle {
    fn read(&self, text: &str) -> Option<String> {
        let (number, letter) = text.split_once(',')?;
        let (number, letter) = (number.trim(), letter.trim());
        let point = number.find('.').unwrap_or(number.len());
        let (degrees, minutes) = (number.get(..point.checked_sub(2)?)?, number.get(point - 2..)?);
        let decimals = number.len().saturating_sub(point + 1);
        let degrees = if degrees.is_empty() { 0.0 } else { degrees.parse::<f64>().ok()? };
        let value = degrees + minutes.parse::<f64>().ok()? / 60.0;
        let negative = letter.eq_ignore_ascii_case(&self.negative.to_string());
        // Three decimals more than the minutes have tell every step of theirs apart.
        Some(format!("{:.*}", decimals + 3, if negative { -value } else { value }))
    }

    fn written(&self, value: f64, old: &str) -> String {
        let number = old.split(',').next().unwrap_or("").trim();
        let decimals = match (number.find('.'), number.is_empty()) {
            (Some(point), _) => (number.len() - point - 1).min(12),
            (None, true) => 4,
            (None, false) => 0,
        };
        let unit = 10_u64.pow(u32::try_from(decimals).unwrap_or(0));
        #[expect(clippy::cast_precision_loss, reason = "at most 10^12")]
        let size = (value.abs() * 60.0 * unit as f64).round();
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "degrees of an angle, saturates")]
        let units = size as u64;
        let (degrees, rest) = (units / (60 * unit), units % (60 * unit));
        let (minutes, fraction) = (rest / unit, rest % unit);
        let width = self.degrees;
        let letter = if value < 0.0 { self.negative } else { self.positive };
        let fraction = if decimals == 0 { String::new() } else { format!(".{fraction:0decimals$}") };
        format!("{degrees:0width$}{minutes:02}{fraction},{letter}")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn degrees_and_minutes_are_read_and_written() {
        let plain = Reading::default();
        for (spelling, text, degrees) in [
            (Spelling::Latitude, "4807.038,N", "48.117300"),
            (Spelling::Latitude, "3725.58362,S", "-37.42639367"),
            (Spelling::Longitude, "01131.000,E", "11.516667"),
            (Spelling::Longitude, "00000.6000,W", "-0.0100000"),
        ] {
            assert_eq!(spelling.read(text), degrees);
            assert_eq!(spelling.written(degrees.parse().unwrap(), text, None, &plain), text);
        }
        // Minutes carry into degrees.
        assert_eq!(Spelling::Latitude.written(47.999_999_99, "4759.99,N", None, &plain), "4800.00,N");
        assert_eq!(Spelling::Longitude.written(-7.5, ",", None, &plain), "00730.0000,W");
        assert_eq!(Spelling::Latitude.read(","), "");
    }
}
