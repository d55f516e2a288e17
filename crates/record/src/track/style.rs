//! How the numbers of a column are written, and a number written so.

use super::number::Reading;
use super::odd::{Oddity, odd};

/// How the numbers of a column are written, by the sampled rows.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Style {
    /// Decimals of the longest.
    decimals: usize,
    /// Zeros at the end are left out.
    trimmed: bool,
    /// Numbers above zero have a plus sign.
    plus: bool,
    /// Digits before the point where zeros fill them up; else 0.
    zeros: usize,
}

impl Style {
    /// The style of these cells; none where no number tells it.
    pub(crate) fn of<'a>(cells: impl Iterator<Item = &'a str>, reading: &Reading) -> Option<Self> {
        let numbers: Vec<&str> = cells.filter_map(|cell| Some(&cell[number_in(cell, reading)?])).collect();
        let point = if reading.decimal_comma { ',' } else { '.' };
        let plain: Vec<&str> = numbers.iter().copied().filter(|n| !n.contains(['e', 'E', 'd', 'D', 'x'])).collect();
        let decimals = |n: &&str| n.find(point).map_or(0, |at| n.len() - at - 1);
        let most = plain.iter().map(decimals).max()?;
        let zero_ends = plain.iter().any(|n| decimals(n) > 0 && n.ends_with('0'));
        let fewer = plain.iter().any(|n| decimals(n) < most);
        let positive = || plain.iter().filter(|n| !n.starts_with('-'));
        let whole = |n: &str| n.trim_start_matches(['+', '-']).split(point).next().map_or(0, str::len);
        let filled = plain.iter().any(|n| whole(n) > 1 && n.trim_start_matches(['+', '-']).starts_with('0'));
        Some(Self {
            decimals: most,
            trimmed: fewer && !zero_ends,
            plus: positive().count() > 0 && positive().all(|n| n.starts_with('+')),
            zeros: if filled { plain.iter().map(|n| whole(n)).max().unwrap_or(0) } else { 0 },
        })
    }

    /// This many decimals.
    pub(crate) fn with_decimals(decimals: usize) -> Self {
        Self { decimals, ..Self::default() }
    }

    /// `value` as a cell of the column in place of `old`: what stands around the number there stays.
    pub(crate) fn written(&self, value: f64, old: &str, reading: &Reading) -> String {
        let Some(range) = number_in(old, reading) else { return self.number(value, "", reading) };
        let number = self.number(value, &old[range.clone()], reading);
        format!("{}{number}{}", &old[..range.start], &old[range.end..])
    }

    /// `value` with the decimals of the column.
    #[must_use]
    pub fn rounded(&self, value: f64) -> f64 {
        self.fixed(value).parse().unwrap_or(value)
    }

    fn number(&self, value: f64, old: &str, reading: &Reading) -> String {
        if old.starts_with("0x") || old.starts_with("0X") {
            #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "saturates")]
            let whole = value.max(0.0).round() as u64;
            let width = old.len() - 2;
            let lower = old[2..].contains(|c: char| c.is_ascii_lowercase());
            let digits = if lower { format!("{whole:0width$x}") } else { format!("{whole:0width$X}") };
            return format!("{}{digits}", &old[..2]);
        }
        let text = match old.find(['e', 'E', 'd', 'D']) {
            Some(at) => with_exponent(value, old, at, if reading.decimal_comma { ',' } else { '.' }),
            None => self.fixed(value),
        };
        let text = super::number::without_signed_zero(text);
        let text = match separator(old, reading) {
            Some(separator) => grouped(&text, separator, reading.decimal_comma),
            None if reading.decimal_comma => text.replace('.', ","),
            None => text,
        };
        // `+ 0.5` keeps the blank after its sign.
        let spaced = old.starts_with(['+', '-']) && old[1..].starts_with(' ');
        let signed = if self.plus && value >= 0.0 && !text.starts_with('+') { format!("+{text}") } else { text };
        if spaced && signed.starts_with(['+', '-']) { format!("{} {}", &signed[..1], &signed[1..]) } else { signed }
    }

    fn fixed(&self, value: f64) -> String {
        let decimals = self.decimals;
        let size = value.abs();
        // A number far out of the column needs its own form.
        if size >= 1e16 {
            return super::number_text(value);
        }
        let mut text = format!("{size:.decimals$}");
        if self.trimmed && text.contains('.') {
            text = text.trim_end_matches('0').trim_end_matches('.').to_owned();
        }
        let whole = text.find('.').unwrap_or(text.len());
        if whole < self.zeros {
            text = format!("{}{text}", "0".repeat(self.zeros - whole));
        }
        if value < 0.0 { format!("-{text}") } else { text }
    }
}

/// Where the number stands in a cell.
fn number_in(cell: &str, reading: &Reading) -> Option<std::ops::Range<usize>> {
    if reading.is_marker(cell.as_bytes()) {
        return None;
    }
    if reading.number(cell.as_bytes()).is_some_and(f64::is_finite) {
        return Some(0..cell.len());
    }
    odd(cell.as_bytes(), reading.decimal_comma).map(|odd| odd.start..odd.end)
}

/// The separator of thousands in a number.
fn separator(number: &str, reading: &Reading) -> Option<char> {
    let thousands = odd(number.as_bytes(), reading.decimal_comma).is_some_and(|o| o.oddity == Oddity::Thousands);
    let point = if reading.decimal_comma { ',' } else { '.' };
    number
        .trim_start_matches(['+', '-', ' '])
        .chars()
        .find(|c| !c.is_ascii_digit() && *c != point)
        .filter(|_| thousands)
}

fn grouped(text: &str, separator: char, decimal_comma: bool) -> String {
    let (sign, digits) = text.strip_prefix('-').map_or(("", text), |rest| ("-", rest));
    let (whole, part) = digits.split_once('.').map_or((digits, None), |(w, p)| (w, Some(p)));
    let mut out = sign.to_owned();
    for (i, digit) in whole.chars().enumerate() {
        if i > 0 && (whole.len() - i).is_multiple_of(3) {
            out.push(separator);
        }
        out.push(digit);
    }
    if let Some(part) = part {
        out.push(if decimal_comma { ',' } else { '.' });
        out.push_str(part);
    }
    out
}

/// `value` with an exponent in the form of the one in `old`, whose letter stands at `at`.
fn with_exponent(value: f64, old: &str, at: usize, point: char) -> String {
    let decimals = old[..at].find(point).map_or(0, |p| at - p - 1);
    let text = format!("{value:.decimals$e}");
    let (mantissa, exponent) = text.split_once('e').unwrap_or((&text, "0"));
    let exponent: i32 = exponent.parse().unwrap_or(0);
    let form = &old[at + 1..];
    let width = form.trim_start_matches(['+', '-']).len();
    // Exponents of two digits and more are written with either sign.
    let signed = form.starts_with('+') || (form.starts_with('-') && width > 1);
    let sign = if exponent < 0 {
        "-"
    } else if signed {
        "+"
    } else {
        ""
    };
    format!("{mantissa}{}{sign}{:0width$}", &old[at..=at], exponent.unsigned_abs())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn written(cells: &[&str], comma: bool, old: usize, value: f64) -> String {
        let reading = Reading::new(comma, &[]);
        Style::of(cells.iter().copied(), &reading).unwrap_or_default().written(value, cells[old], &reading)
    }

    #[test]
    fn a_number_looks_like_those_of_its_column() {
        for (cells, comma, value, text) in [
            (&["1.50", "2.25"][..], false, 3.0, "3.00"),
            (&["1.5", "2.25"], false, 3.0, "3"),
            (&["9", "12"], false, 10.6, "11"),
            (&["+1.5", "-2.5"], false, 3.25, "+3.2"),
            (&["0012", "0140"], false, 7.2, "0007"),
            (&["1,50", "2,25"], true, -3.125, "-3,12"),
            (&["9.992324D+01", "1.0D+02"], false, 101.0, "1.010000D+02"),
            (&["9.992324e-1", "1.0e2"], false, 101.0, "1.010000e2"),
            (&["99.92 m", "100.49 m"], false, 101.0, "101.00 m"),
            (&["=\"99.92\""], false, 101.0, "=\"101.00\""),
            (&["9.971,78", "10.000,00"], true, 12345.678, "12.345,68"),
            (&["$ 1,234.50"], false, 1_000_000.0, "$ 1,000,000.00"),
            (&["+ 0.5"], false, -0.7, "- 0.7"),
            (&["0x1F"], false, 32.0, "0x20"),
            (&["0.04", "-0.02"], false, -0.001, "0.00"),
        ] {
            assert_eq!(written(cells, comma, 0, value), text, "{cells:?}");
        }
        let reading = Reading::new(false, &[]);
        let style = Style::of(["1.50", "", "NaN"].into_iter(), &reading).unwrap();
        assert_eq!(
            (style.written(2.0, "", &reading), style.written(2.0, "NaN", &reading)),
            ("2.00".into(), "2.00".into())
        );
    }
}
