//! Rows of bare decimal numbers, read in one pass over their bytes. Nearly every row of nearly every file is one;
//! any other row is left to the tokeniser, which gives the same for both.

use memchr::memchr_iter;

use super::number::{POWERS, Reading};
use super::timing::Timing;
use super::tokens::{Layout, inner};
use super::{Delimiter, TimeFormat};

/// Powers of ten; computing one for each row shows in the time of a load.
const UNITS: [i64; 19] = {
    let mut units = [1; 19];
    let mut power = 1;
    while power < units.len() {
        units[power] = 10 * units[power - 1];
        power += 1;
    }
    units
};

/// What a column is read for.
#[derive(Debug, Clone, Copy)]
enum Role {
    /// A time as a number of units of `10^power` nanoseconds.
    Count { power: u32 },
    /// A time in another form.
    Time,
    /// A number, for this slot.
    Number(usize),
    /// Nothing but the count of missing cells.
    Other,
}

/// How quick rows are read.
#[derive(Debug)]
pub(crate) struct Quick<'a> {
    delimiter: u8,
    line_end: u8,
    quote: Option<u8>,
    /// The first byte of what marks comments besides the usual.
    mark: Option<u8>,
    roles: Vec<Role>,
    reading: &'a Reading,
    timing: Option<&'a Timing>,
}

/// A row that was read.
#[derive(Debug, Default)]
pub(crate) struct QuickRow {
    /// By slot; NaN where there is none.
    pub(crate) values: Vec<f64>,
    /// The moment in nanoseconds, where there is a time column.
    pub(crate) moment: i64,
    /// Columns without a value.
    pub(crate) missing: Vec<usize>,
}

/// The digits of a cell.
struct Digits {
    mantissa: u64,
    decimals: usize,
    negative: bool,
}

impl<'a> Quick<'a> {
    /// None where the layout is not one of numbers between single bytes: blanks, decimal commas, rows of different
    /// lengths, date and time apart.
    pub(crate) fn new(
        layout: Layout,
        reading: &'a Reading,
        timing: Option<&'a Timing>,
        slots: &[Option<usize>],
        counts: [usize; 2],
    ) -> Option<Self> {
        let Delimiter::Byte(delimiter) = layout.delimiter else { return None };
        let apart = timing.is_some_and(|t| !t.is_single());
        if reading.decimal_comma || counts != [slots.len(); 2] || apart {
            return None;
        }
        let role = |(column, slot): (usize, &Option<usize>)| match (timing.filter(|t| t.column == column), slot) {
            (Some(timing), _) => match timing.format {
                TimeFormat::Seconds => Role::Count { power: 9 },
                TimeFormat::Epoch { unit_ns } => Role::Count { power: unit_ns.ilog10() },
                _ => Role::Time,
            },
            (None, Some(slot)) => Role::Number(*slot),
            (None, None) => Role::Other,
        };
        let roles = slots.iter().enumerate().map(role).collect();
        Some(Self {
            delimiter,
            line_end: layout.line_end,
            quote: layout.quote,
            mark: layout.mark.and_then(|m| m.bytes().first().copied()),
            roles,
            reading,
            timing,
        })
    }

    /// Reads the row at the start of `bytes` into `row` and gives its length with the line end; none where it is not a
    /// quick one.
    #[inline]
    pub(crate) fn read(&self, bytes: &[u8], row: &mut QuickRow) -> Option<usize> {
        row.missing.clear();
        let mut at = 0;
        let mut present = false;
        // A comment may stand after blanks.
        if bytes
            .first()
            .is_none_or(|b| matches!(b, b'#' | b'%' | b'/') || Some(*b) == self.mark || b.is_ascii_whitespace())
        {
            return None;
        }
        let last = self.roles.len() - 1;
        for (column, role) in self.roles.iter().enumerate() {
            let start = at;
            match role {
                Role::Count { .. } | Role::Number(_) => match self.number(bytes, &mut at)? {
                    Some(digits) => {
                        present = true;
                        match *role {
                            Role::Count { power } => row.moment = digits.nanoseconds(power)?,
                            Role::Number(slot) => {
                                let value = digits.value()?;
                                let missing = self.reading.is_missing(value);
                                row.values[slot] = if missing { f64::NAN } else { value };
                                if missing {
                                    row.missing.push(column);
                                }
                            }
                            Role::Time | Role::Other => return None,
                        }
                    }
                    None => {
                        let Role::Number(slot) = *role else { return None };
                        row.values[slot] = f64::NAN;
                        row.missing.push(column);
                    }
                },
                Role::Time | Role::Other => {
                    at += bytes[at..].iter().take_while(|b| **b != self.delimiter && **b != self.line_end).count();
                    let cell = self.plain(&bytes[start..at])?;
                    if matches!(role, Role::Other) {
                        if self.reading.is_marker(cell) {
                            row.missing.push(column);
                        }
                    } else if let Some(super::timestamp::Count::Exact(ns)) = self.timing?.read(|_| cell, false) {
                        row.moment = ns;
                        present = true;
                    } else {
                        return None;
                    }
                }
            }
            if column < last {
                if bytes.get(at) != Some(&self.delimiter) {
                    return None;
                }
                at += 1;
            }
        }
        present.then(|| self.end(bytes, at)).flatten()
    }

    /// The text of a cell that was cut at the first delimiter: none where a quote may hide one, or another quote.
    #[inline]
    fn plain<'b>(&self, cell: &'b [u8]) -> Option<&'b [u8]> {
        let Some(quote) = self.quote else { return Some(&cell[inner(cell, None)]) };
        match memchr_iter(quote, cell).count() {
            0 => Some(&cell[inner(cell, None)]),
            2 if cell.first() == Some(&quote) && cell.trim_ascii_end().last() == Some(&quote) => {
                Some(&cell[inner(cell, self.quote)])
            }
            _ => None,
        }
    }

    /// The digits from `at` to the end of the cell, in quotes or without; none inside for an empty cell.
    #[inline]
    #[expect(clippy::option_option, reason = "not quick, empty, or digits")]
    fn number(&self, bytes: &[u8], at: &mut usize) -> Option<Option<Digits>> {
        match self.quote {
            Some(quote) if bytes.get(*at) == Some(&quote) => {
                *at += 1;
                let digits = self.digits(bytes, at, |b| b == quote);
                // What follows another end is no end of the cell.
                (bytes.get(*at) == Some(&quote)).then(|| *at += 1)?;
                digits
            }
            _ => self.digits(bytes, at, |b| b == self.delimiter || b == self.line_end || b == b'\r'),
        }
    }

    /// The digits from `at` to the first byte that `ends` them; none inside where there is none.
    #[inline]
    #[expect(clippy::option_option, reason = "not quick, empty, or digits")]
    fn digits(&self, bytes: &[u8], at: &mut usize, ends: impl Fn(u8) -> bool) -> Option<Option<Digits>> {
        let start = *at;
        let negative = bytes.get(start) == Some(&b'-');
        let first = start + usize::from(negative);
        let mut mantissa = 0_u64;
        let mut point = usize::MAX;
        let mut here = first;
        for &byte in &bytes[first.min(bytes.len())..] {
            let digit = byte.wrapping_sub(b'0');
            if digit < 10 {
                mantissa = mantissa.wrapping_mul(10).wrapping_add(u64::from(digit));
            } else if byte == b'.' && point == usize::MAX {
                point = here;
            } else if ends(byte) {
                break;
            } else {
                return None;
            }
            here += 1;
        }
        *at = here;
        let count = here - first - usize::from(point != usize::MAX);
        match count {
            0 if here == start => Some(None),
            // 18 digits fit; more may have wrapped around.
            1..=18 => {
                let decimals = if point == usize::MAX { 0 } else { here - point - 1 };
                Some(Some(Digits { mantissa, decimals, negative }))
            }
            _ => None,
        }
    }

    /// The length of the row with its line end, when the row ends at `at`.
    #[inline]
    fn end(&self, bytes: &[u8], at: usize) -> Option<usize> {
        match bytes.get(at) {
            None => Some(at),
            Some(b) if *b == self.line_end => Some(at + 1),
            Some(b'\r') if bytes.get(at + 1) == Some(&b'\n') && self.line_end == b'\n' => Some(at + 2),
            Some(_) => None,
        }
    }
}

impl Digits {
    /// Exact operands make the quotient correctly rounded.
    #[inline]
    fn value(&self) -> Option<f64> {
        if self.mantissa >= 1 << 53 {
            return None;
        }
        #[expect(clippy::cast_precision_loss, reason = "below 2^53")]
        let value = self.mantissa as f64 / POWERS[self.decimals];
        Some(if self.negative { -value } else { value })
    }

    #[inline]
    fn nanoseconds(&self, power: u32) -> Option<i64> {
        let zeros = power.checked_sub(u32::try_from(self.decimals).ok()?)?;
        let ns = i64::try_from(self.mantissa).ok()?.checked_mul(*UNITS.get(zeros as usize)?)?;
        Some(if self.negative { -ns } else { ns })
    }
}

#[cfg(test)]
mod tests {
    use super::super::body::Plan;
    use super::super::parallel_parse::parse_bytes;
    use super::super::{Encoding, timestamp};
    use super::*;
    use proptest::prelude::*;

    fn layout(quote: Option<u8>) -> Layout {
        Layout { delimiter: Delimiter::Byte(b','), quote, line_end: b'\n', mark: None }
    }

    proptest! {
        /// The quick way and the tokeniser agree on any text, row by row.
        #[test]
        fn quick_rows_are_what_the_tokeniser_gives(
            cells in proptest::collection::vec("[-]?[0-9]{0,10}[.]?[0-9]{0,10}|nan|x| 1 |1e3| ?#|-5|\"-?[0-9.]{0,4}\" ?|\"a,b\"|\" c\"", 3 * 40),
            crlf: bool,
            quoted: bool,
        ) {
            let end = if crlf { "\r\n" } else { "\n" };
            let text: String = cells.chunks(3).map(|row| row.join(",") + end).collect();
            let reading = Reading::new(false, &["-5".into()]);
            let timing = Timing::of(0, None, TimeFormat::Seconds);
            let slots = vec![None, Some(0), Some(1)];
            let plan = |quote, counts| Plan {
                layout: layout(quote),
                encoding: Encoding::Utf8 { bom: false },
                reading: &reading,
                slots: slots.clone(),
                counts,
                timing: Some(timing.clone()),
                record_bytes: 10,
                repeats: &[],
                oddities: &[],
                truths: Vec::new(),
            late: &[],
                footer: true,
            };
            let quote = quoted.then_some(b'"');
            let quick = parse_bytes(text.as_bytes(), 1, &plan(quote, [3, 3])).unwrap();
            // Another allowed number of cells, which no row has, turns the quick way off.
            let slow = parse_bytes(text.as_bytes(), 1, &plan(quote, [3, 99])).unwrap();
            prop_assert_eq!((quick.rows, &quick.moments, &quick.missing), (slow.rows, &slow.moments, &slow.missing));
            prop_assert_eq!(quick.rounded, slow.rounded);
            for (a, b) in quick.numbers.iter().zip(&slow.numbers) {
                let bits = |v: &[f64]| v.iter().map(|v| if v.is_nan() { u64::MAX } else { v.to_bits() }).collect::<Vec<_>>();
                prop_assert_eq!(bits(&a.values), bits(&b.values));
                prop_assert_eq!((a.present, &a.unreadable, &a.infinite), (b.present, &b.unreadable, &b.infinite));
            }
        }
    }

    #[test]
    fn quick_rows_are_taken_and_others_left() {
        let reading = Reading::new(false, &[]);
        let timing = Timing::of(0, None, TimeFormat::Iso);
        let quick = Quick::new(layout(None), &reading, Some(&timing), &[None, Some(0), None], [3, 3]).unwrap();
        let mut row = QuickRow { values: vec![0.0], ..QuickRow::default() };
        assert_eq!(quick.read(b"2019-11-11T17:57:05Z,-1.5,abc\r\nx", &mut row), Some(31));
        assert_eq!((row.moment, row.values[0]), (timestamp::iso(b"2019-11-11T17:57:05Z").unwrap(), -1.5));
        assert_eq!(quick.read(b"2019-11-11,,", &mut row), Some(12));
        assert_eq!(row.missing, [1, 2]);
        for other in [
            "#,1,2\n",
            " #,1,2\n",
            "soon,1,2\n",
            "2019-11-11,1\n",
            "2019-11-11,1,2,3\n",
            "2019-11-11,1e3,2\n",
            ",,\n",
            "",
        ] {
            assert_eq!(quick.read(other.as_bytes(), &mut row), None, "{other}");
        }
        let quoted = Quick::new(layout(Some(b'"')), &reading, Some(&timing), &[None, Some(0), None], [3, 3]).unwrap();
        assert_eq!(quoted.read(b"\"2019-11-11\",\"-1.5\",\" a \"\nx", &mut row), Some(26));
        assert_eq!((row.moment, row.values[0], row.missing.len()), (timestamp::iso(b"2019-11-11").unwrap(), -1.5, 0));
        for other in
            ["2019-11-11,\"1,5\",\n", "2019-11-11,1,\"a,b\"\n", "2019-11-11,1,\"a\nb\"\n", "2019-11-11,1,\"a\"b\"\n"]
        {
            assert_eq!(quoted.read(other.as_bytes(), &mut row), None, "{other}");
        }
    }
}
