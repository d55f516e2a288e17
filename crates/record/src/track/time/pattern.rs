//! Times by a pattern that the user gives: the letters of `strftime`.

use super::free::DateOrder;
use super::pieces::{Field, Pieces};
use super::words;
use crate::error::{Error, Result};

/// A pattern like `%d.%m.%Y %H:%M:%S%.f`.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Pattern {
    text: String,
    items: Vec<Item>,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Item {
    /// Up to this many digits.
    Digits(Field, usize),
    /// The name of a month.
    Month,
    /// A name that says nothing more: a day of the week.
    Name,
    /// AM or PM.
    Half,
    /// An offset or the name of a zone.
    Zone,
    /// A point (or comma) and decimals of a second, or nothing.
    Decimals,
    /// One byte as it is.
    Byte(u8),
    /// Any number of blanks.
    Blanks,
}

/// What letters there are, for messages.
const LETTERS: &str = "letters are %Y %y %m %d %b %j %H %I %M %S %f (digits of a second) %.f %p %z %s %G %V %u %a, \
                       and %F %T %D %R for the usual groups";

impl Pattern {
    /// The pattern in `text`.
    ///
    /// # Errors
    /// [`Error::Usage`] for a letter that is not known, and where nothing in it tells a time.
    pub fn new(text: &str) -> Result<Self> {
        let mut items = Vec::new();
        let mut rest = text.chars();
        while let Some(c) = rest.next() {
            match c {
                '%' => Self::letter(rest.next(), &mut rest, &mut items)
                    .ok_or_else(|| Error::usage(format!("`{text}` is not a time format"), LETTERS))?,
                c if c.is_ascii_whitespace() => items.push(Item::Blanks),
                c => items.extend(c.encode_utf8(&mut [0; 4]).bytes().map(Item::Byte)),
            }
        }
        let tells = |i: &Item| matches!(i, Item::Digits(..));
        if !items.iter().any(tells) {
            return Err(Error::usage(format!("`{text}` is not a time format"), LETTERS));
        }
        Ok(Self { text: text.to_owned(), items })
    }

    /// The order of year, month and day in a pattern of these three alone.
    pub(crate) fn date_order(&self) -> Option<DateOrder> {
        let field = |item: &Item| match item {
            Item::Digits(field, _) => Some(*field),
            Item::Month => Some(Field::Month),
            _ => None,
        };
        let fields: Vec<Field> = self.items.iter().filter_map(field).collect();
        match fields.as_slice() {
            [Field::Year | Field::YearOfCentury, Field::Month, Field::Day] => Some(DateOrder::YearFirst),
            [Field::Day, Field::Month, Field::Year | Field::YearOfCentury] => Some(DateOrder::DayFirst),
            [Field::Month, Field::Day, Field::Year | Field::YearOfCentury] => Some(DateOrder::MonthFirst),
            _ => None,
        }
    }

    fn letter(letter: Option<char>, rest: &mut std::str::Chars<'_>, items: &mut Vec<Item>) -> Option<()> {
        use Field::{Day, DayOfYear, Epoch, Fraction, Hour, Minute, Month, Second, Week, WeekDay, Year, YearOfCentury};
        let digits = |field, most| Item::Digits(field, most);
        let byte = Item::Byte;
        let one = match letter? {
            'Y' | 'G' => digits(Year, 4),
            'y' | 'g' => digits(YearOfCentury, 2),
            'm' => digits(Month, 2),
            'd' | 'e' => digits(Day, 2),
            'j' => digits(DayOfYear, 3),
            'H' | 'k' => digits(Hour, 6),
            'I' | 'l' => digits(Hour, 2),
            'M' => digits(Minute, 2),
            'S' => digits(Second, 2),
            'f' | 'N' | 'L' => digits(Fraction, 18),
            's' => digits(Epoch, 12),
            'V' | 'W' => digits(Week, 2),
            'u' => digits(WeekDay, 1),
            'b' | 'B' | 'h' => Item::Month,
            'a' | 'A' => Item::Name,
            'p' | 'P' => Item::Half,
            'z' | 'Z' => Item::Zone,
            '%' => byte(b'%'),
            '.' | '3' | '6' | '9' => {
                // `%.f`, `%.3f`, `%3f`.
                let dot = letter == Some('.');
                let letters: String = rest.by_ref().take_while(|c| !matches!(c, 'f' | 'N')).collect();
                return letters.bytes().all(|b| b.is_ascii_digit()).then(|| {
                    items.push(if dot { Item::Decimals } else { digits(Fraction, 18) });
                });
            }
            'F' => {
                items.extend([digits(Year, 4), byte(b'-'), digits(Month, 2), byte(b'-'), digits(Day, 2)]);
                return Some(());
            }
            'T' | 'X' => {
                items.extend([digits(Hour, 6), byte(b':'), digits(Minute, 2), byte(b':'), digits(Second, 2)]);
                return Some(());
            }
            'R' => {
                items.extend([digits(Hour, 6), byte(b':'), digits(Minute, 2)]);
                return Some(());
            }
            'D' | 'x' => {
                items.extend([digits(Month, 2), byte(b'/'), digits(Day, 2), byte(b'/'), digits(YearOfCentury, 2)]);
                return Some(());
            }
            _ => return None,
        };
        items.push(one);
        Some(())
    }

    /// As it was given.
    #[must_use]
    pub fn text(&self) -> &str {
        &self.text
    }

    /// True where it tells dates.
    pub(crate) fn has_date(&self) -> bool {
        self.items.iter().any(|i| matches!(i, Item::Digits(Field::Year | Field::YearOfCentury | Field::Epoch, _)))
    }

    /// The fields of `text`, trimmed; none where it does not fit.
    pub(crate) fn fields(&self, text: &[u8]) -> Option<Pieces> {
        let mut pieces = Pieces::new();
        let mut at = 0;
        for (i, item) in self.items.iter().enumerate() {
            let rest = text.get(at..)?;
            let run = |fits: fn(&u8) -> bool| rest.iter().take_while(|b| fits(b)).count();
            match *item {
                Item::Digits(field, most) => {
                    // Digits that stand right before others are as many as the letter has.
                    let joined = matches!(self.items.get(i + 1), Some(Item::Digits(..)));
                    let most = if joined && field == Field::Hour { 2 } else { most };
                    let count = run(u8::is_ascii_digit).min(most);
                    if count == 0 {
                        return None;
                    }
                    pieces.push(field, at, at + count)?;
                    at += count;
                }
                Item::Month => {
                    let count = run(|b| b.is_ascii_alphabetic() || *b >= 128);
                    words::month(&rest[..count])?;
                    pieces.push(Field::MonthName, at, at + count)?;
                    at += count
                        + usize::from(
                            rest.get(count) == Some(&b'.') && self.items.get(i + 1) != Some(&Item::Byte(b'.')),
                        );
                }
                Item::Name => at += run(|b| b.is_ascii_alphabetic() || *b >= 128),
                Item::Half => {
                    let count = run(u8::is_ascii_alphabetic);
                    pieces.push(Field::Half, at, at + count)?;
                    at += count;
                }
                Item::Zone => {
                    let count = run(|b| b.is_ascii_alphanumeric() || matches!(b, b'+' | b'-' | b':'));
                    pieces.push(Field::Zone, at, at + count)?;
                    at += count;
                }
                Item::Decimals => {
                    if matches!(rest.first(), Some(b'.' | b',')) {
                        let count = rest[1..].iter().take_while(|b| b.is_ascii_digit()).count();
                        pieces.push(Field::Fraction, at + 1, at + 1 + count.max(1))?;
                        at += 1 + count;
                    }
                }
                Item::Byte(byte) => {
                    if rest.first() != Some(&byte) {
                        return None;
                    }
                    at += 1;
                }
                Item::Blanks => at += run(u8::is_ascii_whitespace),
            }
        }
        (at == text.len()).then_some(pieces)
    }
}

#[cfg(test)]
mod tests {
    use super::super::super::calendar::DAY;
    use super::*;

    #[test]
    fn patterns_read_what_they_say() {
        let expected = "2021-03-04T10:00:30.5Z".parse::<jiff::Timestamp>().unwrap().as_nanosecond();
        for (pattern, text) in [
            ("%d.%m.%Y %H:%M:%S%.f", "04.03.2021 10:00:30.5"),
            ("%Y%m%d%H%M%S%.f", "20210304100030,5"),
            ("%m/%d/%y %I:%M:%S%.f %p", "3/4/21 10:00:30.500 AM"),
            ("%d-%b-%Y %T:%f", "04-Mar-2021 10:00:30:500"),
            ("%Y.%j/%H%M%S.%f", "2021.063/100030.5"),
            ("%FT%T%.f%z", "2021-03-04T12:00:30.5+02:00"),
            ("%a %d %B %Y um %Hh%Mm%S%.3fs", "Do 04 März 2021 um 10h00m30.5s"),
            ("%s%.f", "1614852030.5"),
        ] {
            let pattern = Pattern::new(pattern).unwrap();
            let told = pattern.fields(text.as_bytes()).and_then(|p| p.told(text.as_bytes())).unwrap();
            let ns = told.days.unwrap() * DAY + told.of_day - told.offset.unwrap_or(0);
            assert_eq!(i128::from(ns), expected, "{text}");
        }
        let pattern = Pattern::new("%Y-%m-%d").unwrap();
        assert!(pattern.fields(b"2021-03-04 10:00").is_none() && pattern.fields(b"2021/03/04").is_none());
    }

    #[test]
    fn what_is_no_pattern_is_refused_with_the_letters() {
        for text in ["", "yyyy-mm-dd", "%Q", "%Y-%"] {
            let e = Pattern::new(text).unwrap_err().to_string();
            assert!(e.contains("not a time format") && e.contains("%.f"), "{e}");
        }
    }
}
