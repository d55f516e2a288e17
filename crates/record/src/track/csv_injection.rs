//! Text of a file on its way into a table of our own, which people open with a spreadsheet.

use std::borrow::Cow;

/// `text` as a cell that no spreadsheet runs as a formula: one that starts with `=`, `@`, `+`, `-`, a tab or a carriage
/// return gets an apostrophe in front, unless it is a number (`-0.966`). For the tables that this program makes (flags,
/// diagnostics, streams); the cells of a cleaned file are those of the input.
#[must_use]
pub fn escape_formula(text: &str) -> Cow<'_, str> {
    let starts = text.trim_start_matches(' ').starts_with(['=', '@', '+', '-', '\t', '\r']);
    // `+1-1` and `-inf` are none of ours: digits, one point or comma, an exponent.
    let is_number = text.trim().replace(',', ".").parse::<f64>().is_ok_and(f64::is_finite);
    if starts && !is_number { Cow::Owned(format!("'{text}")) } else { Cow::Borrowed(text) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn formulas_are_made_text_and_numbers_stay() {
        for formula in ["=1+1", "@SUM(A1)", "+1-1", "-2+3", "\t=1", "\r=1", "=HYPERLINK(\"http://x\")", "--", " =1"] {
            assert_eq!(escape_formula(formula), format!("'{formula}"));
        }
        for harmless in ["", "-0.966", "+1e3", "-1,5", "alt_m", "2019-01-01T00:00:00Z", "a=b", "'=1", "12:00"] {
            assert_eq!(escape_formula(harmless), harmless);
        }
    }
}
