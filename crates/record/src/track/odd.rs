//! Numbers that are written with more than a number: units, signs of currencies, thousands, letters of quality.

use std::borrow::Cow;

use super::windows_1252;

/// What stands in a cell besides its number.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub(crate) enum Oddity {
    /// `12.5 m`, `45%`.
    Unit,
    /// `€ 12.50`, `$12`.
    Currency,
    /// `1,234.5`, `1.234,5`, `1 234.5`, `1'234.5`.
    Thousands,
    /// `1.5D+02`, as Fortran writes.
    DExponent,
    /// `="1.5"`, as spreadsheets are made to keep texts.
    Formula,
    /// `12.5 A`: a letter of quality.
    Letter,
    /// `<0.5`: below a limit, whose value is taken.
    Limit,
    /// `+ 0.5`.
    SpacedSign,
    /// `0x1F`.
    Hexadecimal,
}

impl Oddity {
    /// All of them, in the order of their bits.
    pub(crate) const ALL: [Self; 9] = [
        Self::Unit,
        Self::Currency,
        Self::Thousands,
        Self::DExponent,
        Self::Formula,
        Self::Letter,
        Self::Limit,
        Self::SpacedSign,
        Self::Hexadecimal,
    ];

    /// What such cells have, in words.
    pub(crate) fn words(self) -> &'static str {
        match self {
            Self::Unit => "a unit",
            Self::Currency => "a currency sign",
            Self::Thousands => "separators between thousands",
            Self::DExponent => "an exponent with D",
            Self::Formula => "the form =\"number\"",
            Self::Letter => "a letter or mark after the number",
            Self::Limit => "a limit (<), whose value is taken",
            Self::SpacedSign => "a blank after the sign",
            Self::Hexadecimal => "hexadecimal digits",
        }
    }
}

/// A number in a cell that holds more.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Odd {
    pub(crate) value: f64,
    pub(crate) oddity: Oddity,
    /// Where the number stands in the cell, with its sign.
    pub(crate) start: usize,
    pub(crate) end: usize,
}

/// The number in `cell`, trimmed and unquoted, which is no bare number; none where there is none.
pub(crate) fn odd(cell: &[u8], decimal_comma: bool) -> Option<Odd> {
    // Hard blanks and currencies in Windows-1252; where they stand is asked of text alone.
    let text = match std::str::from_utf8(cell) {
        Ok(text) => Cow::Borrowed(text),
        Err(_) => Cow::Owned(windows_1252::decode(cell)),
    };
    let text = text.as_ref();
    if text.len() > 40 || !text.bytes().any(|b| b.is_ascii_digit()) {
        return None;
    }
    let (mut start, mut end) = (0, text.len());
    let mut found: Option<Oddity> = None;
    let note = |o: Oddity, found: &mut Option<Oddity>| *found = found.or(Some(o));
    if let Some(hex) = text.strip_prefix("0x").or_else(|| text.strip_prefix("0X")) {
        #[expect(clippy::cast_precision_loss, reason = "53 bits are enough for a measurement")]
        let value = u64::from_str_radix(hex, 16).ok()? as f64;
        return Some(Odd { value, oddity: Oddity::Hexadecimal, start, end });
    }
    if let Some(inside) = text.strip_prefix("=\"").and_then(|t| t.strip_suffix('"')) {
        (start, end) = (2, 2 + inside.len());
        note(Oddity::Formula, &mut found);
    } else if let Some(inside) = text.strip_prefix("=\"\"").and_then(|t| t.strip_suffix("\"\"")) {
        (start, end) = (3, 3 + inside.len());
        note(Oddity::Formula, &mut found);
    }
    // What stands before the number.
    let before = text.get(start..end)?;
    let digit = before.find(|c: char| c.is_ascii_digit() || matches!(c, '+' | '-' | '.' | ','))?;
    match before[..digit].trim() {
        "" => {}
        "<" | ">" | "≤" | "≥" | "~" | "<=" | ">=" => note(Oddity::Limit, &mut found),
        sign if sign.chars().count() <= 3
            && (sign.contains(['€', '$', '£', '¥']) || matches!(sign, "EUR" | "USD" | "CHF" | "GBP")) =>
        {
            note(Oddity::Currency, &mut found);
        }
        _ => return None,
    }
    start += digit;
    let (number_end, value, how) = number(text.get(start..end)?, decimal_comma)?;
    if let Some(how) = how {
        note(how, &mut found);
    }
    let after = text.get(start + number_end..end)?;
    end = start + number_end;
    match after.trim() {
        "" => {}
        sign if sign.contains(['€', '$', '£', '¥']) || matches!(sign, "EUR" | "USD" | "CHF" | "GBP") => {
            note(Oddity::Currency, &mut found)
        }
        rest => note(suffix(rest, after.starts_with(' '))?, &mut found),
    }
    Some(Odd { value, oddity: found?, start, end })
}

/// What follows a number.
fn suffix(rest: &str, apart: bool) -> Option<Oddity> {
    let letters = rest.chars().count();
    let is_unit = super::names::is_unit(rest)
        || rest.contains(['°', '%', '/', 'µ', 'μ', '‰'])
        || matches!(rest, "Deg" | "in" | "ppm" | "ppb" | "W" | "A" | "Pa" | "bar" | "dBm" | "mA" | "kW" | "psi");
    let starts = rest
        .chars()
        .next()
        .is_some_and(|c| !c.is_ascii_digit() && !matches!(c, '.' | ',' | ':' | '-' | '+' | '/' | ';' | '|' | '='));
    let plain = rest.chars().all(|c| !c.is_ascii_digit() || matches!(c, '2' | '3' | '1'))
        && letters <= 12
        && !rest.contains([',', ';', '=', ':']);
    match () {
        () if !starts || !plain => None,
        () if is_unit
            && (letters > 1 || "mskgVKCFNJ%°".contains(rest))
            && (apart || rest.starts_with(['%', '°', '‰']) || letters <= 4) =>
        {
            Some(Oddity::Unit)
        }
        () if letters <= 2 && (apart || rest.starts_with(['*', '?', '#', '!'])) => Some(Oddity::Letter),
        () if apart && letters <= 8 && rest.chars().all(|c| c.is_alphabetic()) => Some(Oddity::Unit),
        () if letters == 1 && rest.chars().all(char::is_alphabetic) => Some(Oddity::Letter),
        () => None,
    }
}

/// The number at the start of `text`: its length, its value, and what is odd in it.
fn number(text: &str, decimal_comma: bool) -> Option<(usize, f64, Option<Oddity>)> {
    let bytes = text.as_bytes();
    let sign = usize::from(matches!(bytes.first(), Some(b'+' | b'-')));
    let blanks = bytes[sign..].iter().take_while(|b| **b == b' ').count();
    if sign == 0 && blanks > 0 {
        return None;
    }
    let from = sign + blanks;
    let in_number = |c: char| c.is_ascii_digit() || matches!(c, '.' | ',' | '\'' | '’' | '\u{a0}' | '\u{202f}' | ' ');
    let mut length = text[from..].find(|c| !in_number(c)).map_or(text.len(), |at| from + at);
    // A blank is one between thousands only with three digits after it.
    while let Some(last) =
        text[from..length].chars().next_back().filter(|c| !c.is_ascii_digit() && (*c != '.' || length > from + 40))
    {
        length -= last.len_utf8();
    }
    let body = text.get(from..length)?;
    let (plain, grouped) = ungrouped(body, decimal_comma)?;
    let mut mantissa = plain;
    let mut how = grouped.then_some(Oddity::Thousands);
    // An exponent.
    let rest = &text[length..];
    if let Some(mark) = rest.chars().next().filter(|c| matches!(c, 'e' | 'E' | 'd' | 'D')) {
        let digits = rest[1..].trim_start_matches(['+', '-']).bytes().take_while(u8::is_ascii_digit).count();
        let signed = rest[1..].len() - rest[1..].trim_start_matches(['+', '-']).len();
        if digits > 0 && signed <= 1 {
            mantissa = format!("{mantissa}e{}", &rest[1..1 + signed + digits]);
            length += 1 + signed + digits;
            if matches!(mark, 'd' | 'D') {
                how = Some(Oddity::DExponent);
            }
        }
    }
    if blanks > 0 {
        how = how.or(Some(Oddity::SpacedSign));
    }
    let value: f64 = mantissa.parse().ok()?;
    let value = if bytes[0] == b'-' { -value } else { value };
    value.is_finite().then_some((length, value, how))
}

/// The digits of a number with a decimal point and without separators, and whether it had any.
fn ungrouped(body: &str, decimal_comma: bool) -> Option<(String, bool)> {
    let point = if decimal_comma { ',' } else { '.' };
    let other = if decimal_comma { '.' } else { ',' };
    let (whole, decimals) = match body.rfind(point) {
        Some(at) => (&body[..at], Some(&body[at + point.len_utf8()..])),
        None => (body, None),
    };
    if decimals.is_some_and(|d| d.chars().any(|c| !c.is_ascii_digit())) {
        return None;
    }
    let separator = whole.chars().find(|c| !c.is_ascii_digit());
    let mut plain = match separator {
        None => whole.to_owned(),
        Some(s) if s == other || matches!(s, '\'' | '’' | '\u{a0}' | '\u{202f}' | ' ') => {
            let mut groups = whole.split(s);
            let first = groups.next().unwrap_or_default();
            let fits = (1..=3).contains(&first.len()) && first.bytes().all(|b| b.is_ascii_digit());
            let three = groups.all(|g| g.len() == 3 && g.bytes().all(|b| b.is_ascii_digit()));
            if !fits || !three {
                return None;
            }
            whole.replace(s, "")
        }
        Some(_) => return None,
    };
    if plain.is_empty() && decimals.is_none_or(str::is_empty) {
        return None;
    }
    if let Some(decimals) = decimals {
        plain = format!("{plain}.{decimals}0");
    }
    Some((plain, separator.is_some()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_sign_before_text_is_no_number() {
        for cell in ["-»¿\"Plot Title: 10056829\"", "-x7", "+ x7", "-"] {
            assert_eq!(odd(cell.as_bytes(), false), None, "{cell}");
        }
    }

    #[test]
    fn numbers_are_found_in_what_people_write_around_them() {
        for (cell, comma, value, oddity) in [
            ("99.92 m", false, 99.92, Oddity::Unit),
            ("12.5 m/s", false, 12.5, Oddity::Unit),
            ("45%", false, 45.0, Oddity::Unit),
            ("21.5°C", false, 21.5, Oddity::Unit),
            ("€ 12.50", false, 12.5, Oddity::Currency),
            ("12,50 €", true, 12.5, Oddity::Currency),
            ("1,234.5", false, 1234.5, Oddity::Thousands),
            ("9.971,78", true, 9971.78, Oddity::Thousands),
            ("1 234 567", false, 1_234_567.0, Oddity::Thousands),
            ("-1'234.5", false, -1234.5, Oddity::Thousands),
            ("9.992324D+01", false, 99.923_24, Oddity::DExponent),
            ("-1.5d-3", false, -0.0015, Oddity::DExponent),
            ("=\"99.92\"", false, 99.92, Oddity::Formula),
            ("99.7 A", false, 99.7, Oddity::Letter),
            ("99.7*", false, 99.7, Oddity::Letter),
            ("<0.5", false, 0.5, Oddity::Limit),
            ("< 0,5", true, 0.5, Oddity::Limit),
            ("+ 0.5", false, 0.5, Oddity::SpacedSign),
            ("- 7", false, -7.0, Oddity::SpacedSign),
            ("0x1F", false, 31.0, Oddity::Hexadecimal),
        ] {
            let odd = odd(cell.as_bytes(), comma).unwrap_or_else(|| panic!("{cell}"));
            assert_eq!((odd.value, odd.oddity), (value, oddity), "{cell}");
        }
    }

    #[test]
    fn what_is_no_number_is_not_made_one() {
        for cell in [
            "",
            "m",
            "4CA1B2",
            "1,23",
            "12,34.5",
            "1.2.3",
            "5 of 7",
            "2021-03-04",
            "10:00",
            "a 5",
            "1;2",
            "x=5",
            "north 5",
        ] {
            assert_eq!(odd(cell.as_bytes(), false), None, "{cell}");
        }
    }
}
