//! Times in any usual spelling, read without a pattern: numbers and words in the order in which people write them.

use super::pieces::{Field, Pieces};
use super::words;

/// In which order a date of three short numbers is written, where its look does not tell.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum DateOrder {
    /// 21-03-04 is the fourth of March.
    YearFirst,
    /// 04/03/21.
    DayFirst,
    /// 03/04/21.
    MonthFirst,
}

impl DateOrder {
    /// All of them.
    pub(crate) const ALL: [Self; 3] = [Self::YearFirst, Self::DayFirst, Self::MonthFirst];
}

/// A run of digits, of letters, or of anything else.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Kind {
    Number,
    Word,
    Other,
}

#[derive(Debug, Clone, Copy)]
struct Token {
    kind: Kind,
    start: usize,
    end: usize,
}

impl Token {
    fn len(self) -> usize {
        self.end - self.start
    }
}

/// No time is longer, or has more parts.
const LONGEST: usize = 48;
const MOST: usize = 20;

/// The tokens of a text.
struct Tokens<'a> {
    text: &'a [u8],
    list: [Token; MOST],
    count: usize,
}

impl<'a> Tokens<'a> {
    fn of(text: &'a [u8]) -> Option<Self> {
        if text.is_empty() || text.len() > LONGEST {
            return None;
        }
        let mut tokens = Self { text, list: [Token { kind: Kind::Other, start: 0, end: 0 }; MOST], count: 0 };
        let kind = |b: u8| match b {
            b'0'..=b'9' => Kind::Number,
            b if b.is_ascii_alphabetic() || b >= 128 => Kind::Word,
            _ => Kind::Other,
        };
        let mut at = 0;
        while at < text.len() {
            let this = kind(text[at]);
            let end = at + text[at..].iter().take_while(|b| kind(**b) == this).count();
            *tokens.list.get_mut(tokens.count)? = Token { kind: this, start: at, end };
            tokens.count += 1;
            at = end;
        }
        Some(tokens)
    }

    fn get(&self, at: usize) -> Option<Token> {
        self.list[..self.count].get(at).copied()
    }

    fn bytes(&self, token: Token) -> &'a [u8] {
        &self.text[token.start..token.end]
    }

    fn is(&self, at: usize, text: &[u8]) -> bool {
        self.get(at).is_some_and(|t| self.bytes(t) == text)
    }

    fn number(&self, at: usize) -> Option<Token> {
        self.get(at).filter(|t| t.kind == Kind::Number)
    }

    fn value(&self, token: Token) -> i64 {
        super::super::timestamp::integer(self.bytes(token)).unwrap_or(i64::MAX)
    }
}

/// The fields of `text`, trimmed; none where it is no time. `order` is for dates that can be read in several ways.
pub(crate) fn fields(text: &[u8], order: DateOrder) -> Option<Pieces> {
    let tokens = Tokens::of(text)?;
    let mut used = [false; MOST];
    let mut pieces = Pieces::new();
    clock(&tokens, &mut used, &mut pieces)?;
    words_of(&tokens, &mut used, &mut pieces)?;
    date(&tokens, &used, &mut pieces, order)?;
    others_are_separators(&tokens, &used)?;
    Some(pieces.sorted())
}

/// Takes the time of day, where it is written with colons (or in digits after a `T`).
fn clock(tokens: &Tokens<'_>, used: &mut [bool; MOST], pieces: &mut Pieces) -> Option<()> {
    let mut at = 0;
    while at < tokens.count {
        let length = chain(tokens, at);
        if length >= 2 {
            let first = tokens.get(at)?;
            // A date with colons (2021:03:04 10:00:00) stands before its time.
            let dated = length == 3 && first.len() == 4;
            if !dated {
                return colons(tokens, at, length, used, pieces);
            }
            at += 2 * length - 1;
            continue;
        }
        let after_t = at > 0 && tokens.get(at - 1).is_some_and(|t| matches!(tokens.bytes(t), b"T" | b"t"));
        if let Some(number) = tokens.number(at).filter(|n| after_t && matches!(n.len(), 2 | 4 | 6)) {
            used[at] = true;
            compact_clock(number.start, number.len(), pieces)?;
            let zone_at = if number.len() == 6 { decimals(tokens, at + 1, used, pieces)? } else { at + 1 };
            return zone(tokens, zone_at, used, pieces);
        }
        at += 1;
    }
    Some(())
}

/// How many numbers with single colons between them start at `at`.
fn chain(tokens: &Tokens<'_>, at: usize) -> usize {
    if tokens.number(at).is_none() {
        return 0;
    }
    let mut length = 1;
    while tokens.is(at + 2 * length - 1, b":") && tokens.number(at + 2 * length).is_some() {
        length += 1;
    }
    length
}

fn colons(tokens: &Tokens<'_>, at: usize, length: usize, used: &mut [bool; MOST], pieces: &mut Pieces) -> Option<()> {
    use Field::{Day, DayOfYear, Fraction, Hour, Minute, Month, Second, Year};
    let number = |i: usize| tokens.get(at + 2 * i);
    let after = at + 2 * length - 1;
    let decimal =
        tokens.get(after).is_some_and(|t| matches!(tokens.bytes(t), b"." | b",")) && tokens.number(after + 1).is_some();
    let last = number(length - 1)?;
    let fields: &[Field] = match length {
        2 if decimal => &[Minute, Second],
        2 => &[Hour, Minute],
        3 => &[Hour, Minute, Second],
        4 if number(0)?.len() == 3 => &[DayOfYear, Hour, Minute, Second],
        4 if number(0)?.len() == 4 && number(1)?.len() == 3 => &[Year, DayOfYear, Hour, Minute],
        4 if last.len() == 3 || last.len() == 6 => &[Hour, Minute, Second, Fraction],
        5 if number(1)?.len() == 3 => &[Year, DayOfYear, Hour, Minute, Second],
        5 => &[Year, Month, Day, Hour, Minute],
        6 => &[Year, Month, Day, Hour, Minute, Second],
        _ => return None,
    };
    for (i, field) in fields.iter().enumerate() {
        let token = number(i)?;
        let short = match field {
            Minute | Second => token.len() <= 2,
            Hour => token.len() <= 6,
            _ => true,
        };
        if !short {
            return None;
        }
        used[at + 2 * i] = true;
        pieces.push(*field, token.start, token.end)?;
    }
    let next = if decimal && fields.last() == Some(&Second) { decimals(tokens, after, used, pieces)? } else { after };
    zone(tokens, next, used, pieces)
}

/// Takes a decimal point and what follows it; gives what comes after.
fn decimals(tokens: &Tokens<'_>, at: usize, used: &mut [bool; MOST], pieces: &mut Pieces) -> Option<usize> {
    let point = tokens.get(at).is_some_and(|t| matches!(tokens.bytes(t), b"." | b","));
    match tokens.number(at + 1).filter(|_| point) {
        Some(number) => {
            (used[at], used[at + 1]) = (true, true);
            pieces.push(Field::Fraction, number.start, number.end)?;
            Some(at + 2)
        }
        None => Some(at),
    }
}

/// Takes an offset like `+01:00`, `-0700` or ` -07` at the end; names of zones are words.
fn zone(tokens: &Tokens<'_>, at: usize, used: &mut [bool; MOST], pieces: &mut Pieces) -> Option<()> {
    // `UTC+1`: the name says nothing then.
    let named = tokens.get(at).is_some_and(|t| t.kind == Kind::Word && matches!(tokens.bytes(t), b"UTC" | b"GMT"));
    let blank = usize::from(
        tokens.is(at, b" ") && tokens.get(at + 1).is_some_and(|t| matches!(tokens.bytes(t), b"UTC" | b"GMT")),
    );
    let sign_at = at + blank + usize::from(named || blank == 1);
    let Some(sign) = tokens.get(sign_at).filter(|t| t.kind == Kind::Other) else { return Some(()) };
    let text = tokens.bytes(sign);
    if !matches!(text.last(), Some(b'+' | b'-')) || !text[..text.len() - 1].iter().all(|b| *b == b' ') {
        return Some(());
    }
    let hours = tokens.number(sign_at + 1).filter(|n| matches!(n.len(), 1 | 2 | 4));
    let Some(hours) = hours else { return Some(()) };
    let end = match tokens.count - (sign_at + 2) {
        0 => hours.end,
        2 if tokens.is(sign_at + 2, b":") && hours.len() == 2 => {
            tokens.number(sign_at + 3).filter(|m| m.len() == 2)?.end
        }
        _ => return Some(()),
    };
    used[at..tokens.count].fill(true);
    pieces.push(Field::Zone, sign.end - 1, end)
}

/// Takes the words: months, halves of the day, zones, days of the week, `T` and `W`.
fn words_of(tokens: &Tokens<'_>, used: &mut [bool; MOST], pieces: &mut Pieces) -> Option<()> {
    for at in 0..tokens.count {
        let token = tokens.get(at)?;
        if token.kind != Kind::Word || used[at] {
            continue;
        }
        let word = tokens.bytes(token);
        let before = at.checked_sub(1).and_then(|b| tokens.get(b));
        let after_number = before.is_some_and(|t| t.kind == Kind::Number);
        let clocked = pieces.has(Field::Hour);
        // a.m. and p.m.
        let dotted = matches!(word, b"a" | b"p") && tokens.is(at + 1, b".") && tokens.is(at + 2, b"m");
        if words::month(word).is_some() && !pieces.has(Field::MonthName) {
            pieces.push(Field::MonthName, token.start, token.end)?;
        } else if dotted && clocked {
            pieces.push(Field::Half, token.start, token.end)?;
            used[at + 1..(at + 4).min(tokens.count)].fill(true);
        } else if words::afternoon(word).is_some()
            && (word.len() == 2 || after_number && at + 1 == tokens.count)
            && clocked
        {
            pieces.push(Field::Half, token.start, token.end)?;
        } else if matches!(word, b"T" | b"t") && after_number && tokens.number(at + 1).is_some() {
            // Between date and time.
        } else if matches!(word, b"W" | b"w") && tokens.number(at + 1).is_some() {
            week(tokens, at + 1, used, pieces)?;
        } else if words::is_weekday(word) {
            // It says what the date says.
        } else if words::zone(word).is_some() && clocked && !pieces.has(Field::Zone) {
            pieces.push(Field::Zone, token.start, token.end)?;
        } else if matches!(word, b"st" | b"nd" | b"rd" | b"th") && after_number {
            // 4th
        } else {
            return None;
        }
        used[at] = true;
    }
    Some(())
}

/// The week and its day, after a `W`: `W09-4`, `W094`.
fn week(tokens: &Tokens<'_>, at: usize, used: &mut [bool; MOST], pieces: &mut Pieces) -> Option<()> {
    let number = tokens.number(at)?;
    used[at] = true;
    match number.len() {
        3 => {
            pieces.push(Field::Week, number.start, number.start + 2)?;
            pieces.push(Field::WeekDay, number.start + 2, number.end)
        }
        1 | 2 => {
            pieces.push(Field::Week, number.start, number.end)?;
            match tokens.number(at + 2).filter(|n| n.len() == 1 && tokens.is(at + 1, b"-")) {
                Some(day) => {
                    used[at + 2] = true;
                    pieces.push(Field::WeekDay, day.start, day.end)
                }
                None => Some(()),
            }
        }
        _ => None,
    }
}

/// Gives each number that is left its place in the date.
fn date(tokens: &Tokens<'_>, used: &[bool; MOST], pieces: &mut Pieces, order: DateOrder) -> Option<()> {
    let mut left = [Token { kind: Kind::Number, start: 0, end: 0 }; 7];
    let mut count = 0;
    for at in (0..tokens.count).filter(|at| !used[*at]) {
        if let Some(number) = tokens.number(at) {
            *left.get_mut(count)? = number;
            count += 1;
        }
    }
    let left = &left[..count];
    let put = |pieces: &mut Pieces, field, token: Token| pieces.push(field, token.start, token.end);
    let lens: Vec<usize> = left.iter().map(|t| t.len()).collect();
    let short = |n: usize| n == 1 || n == 2;
    if pieces.has(Field::MonthName) {
        return with_month_name(tokens, left, pieces, order);
    }
    if pieces.has(Field::Week) {
        return match left {
            [year] if year.len() == 4 => pieces.push(Field::Year, year.start, year.end),
            _ => None,
        };
    }
    if pieces.has(Field::DayOfYear) {
        return if left.is_empty() { Some(()) } else { None };
    }
    match lens.as_slice() {
        // A day of the year, or nothing, beside a time of day.
        [] => pieces.has(Field::Minute).then_some(()),
        [8 | 10 | 12 | 14 | 7 | 6] => compact_date(left[0], pieces, order),
        [8, 4 | 6] if !pieces.has(Field::Hour) => {
            compact_date(left[0], pieces, order)?;
            compact_clock(left[1].start, left[1].len(), pieces)
        }
        [4, 3] => {
            put(pieces, Field::Year, left[0])?;
            put(pieces, Field::DayOfYear, left[1])
        }
        [2, 3] => {
            put(pieces, Field::YearOfCentury, left[0])?;
            put(pieces, Field::DayOfYear, left[1])
        }
        [4, m] if short(*m) && !pieces.has(Field::Hour) => {
            put(pieces, Field::Year, left[0])?;
            put(pieces, Field::Month, left[1])
        }
        [4, m, d] if short(*m) && short(*d) => {
            put(pieces, Field::Year, left[0])?;
            put(pieces, Field::Month, left[1])?;
            put(pieces, Field::Day, left[2])
        }
        [4, 3, h, m, s] if short(*h) && short(*m) && short(*s) => {
            let fields = [Field::Year, Field::DayOfYear, Field::Hour, Field::Minute, Field::Second];
            fields.into_iter().zip(left).try_for_each(|(f, t)| put(pieces, f, *t))
        }
        [4, rest @ ..] if (3..=6).contains(&rest.len()) && rest[..rest.len().min(5)].iter().all(|n| short(*n)) => {
            if pieces.has(Field::Hour) {
                return None;
            }
            let fields =
                [Field::Year, Field::Month, Field::Day, Field::Hour, Field::Minute, Field::Second, Field::Fraction];
            fields.into_iter().zip(left).try_for_each(|(f, t)| pieces.push(f, t.start, t.end))
        }
        [a, b, 4] if short(*a) && short(*b) => {
            let (first, second) =
                if order == DateOrder::DayFirst { (Field::Day, Field::Month) } else { (Field::Month, Field::Day) };
            put(pieces, first, left[0])?;
            put(pieces, second, left[1])?;
            put(pieces, Field::Year, left[2])
        }
        // Day, month and year, then a time of day with points.
        [a, b, 4, h, m, s] if [a, b, h, m, s].iter().all(|n| short(**n)) && !pieces.has(Field::Hour) => {
            let (first, second) =
                if order == DateOrder::DayFirst { (Field::Day, Field::Month) } else { (Field::Month, Field::Day) };
            let fields = [first, second, Field::Year, Field::Hour, Field::Minute, Field::Second];
            fields.into_iter().zip(left).try_for_each(|(f, t)| pieces.push(f, t.start, t.end))
        }
        [a, b, 2] if short(*a) && short(*b) => {
            let fields = match order {
                DateOrder::YearFirst if *a == 2 => [Field::YearOfCentury, Field::Month, Field::Day],
                DateOrder::YearFirst => return None,
                DateOrder::DayFirst => [Field::Day, Field::Month, Field::YearOfCentury],
                DateOrder::MonthFirst => [Field::Month, Field::Day, Field::YearOfCentury],
            };
            fields.into_iter().zip(left).try_for_each(|(f, t)| put(pieces, f, *t))
        }
        _ => None,
    }
}

/// Day and year beside the name of a month.
fn with_month_name(tokens: &Tokens<'_>, left: &[Token], pieces: &mut Pieces, order: DateOrder) -> Option<()> {
    let [first, second] = left else {
        // `Mar 2021`.
        let [year] = left else { return None };
        return if year.len() == 4 { pieces.push(Field::Year, year.start, year.end) } else { None };
    };
    // `21MAR04` where the year is said to stand first.
    let year_first =
        order == DateOrder::YearFirst && first.len() == 2 && second.len() == 2 && tokens.value(*second) <= 31;
    let year_first = year_first || first.len() == 4 || tokens.value(*first) > 31;
    let (day, year) = if year_first { (second, first) } else { (first, second) };
    let field = if year.len() == 4 { Field::Year } else { Field::YearOfCentury };
    if day.len() > 2 || !matches!(year.len(), 2 | 4) {
        return None;
    }
    pieces.push(field, year.start, year.end)?;
    pieces.push(Field::Day, day.start, day.end)
}

/// `20210304`, and with hours, minutes and seconds after it; `2021063`; `210304` in the order that is told.
fn compact_date(token: Token, pieces: &mut Pieces, order: DateOrder) -> Option<()> {
    let at = token.start;
    match token.len() {
        7 => {
            pieces.push(Field::Year, at, at + 4)?;
            pieces.push(Field::DayOfYear, at + 4, at + 7)
        }
        6 => {
            let fields = match order {
                DateOrder::YearFirst => [Field::YearOfCentury, Field::Month, Field::Day],
                DateOrder::DayFirst => [Field::Day, Field::Month, Field::YearOfCentury],
                DateOrder::MonthFirst => [Field::Month, Field::Day, Field::YearOfCentury],
            };
            fields.into_iter().enumerate().try_for_each(|(i, f)| pieces.push(f, at + 2 * i, at + 2 * i + 2))
        }
        length => {
            if length > 8 && pieces.has(Field::Hour) {
                return None;
            }
            pieces.push(Field::Year, at, at + 4)?;
            pieces.push(Field::Month, at + 4, at + 6)?;
            pieces.push(Field::Day, at + 6, at + 8)?;
            compact_clock(at + 8, length - 8, pieces)
        }
    }
}

/// `10`, `1000`, `100000` from `at` on.
fn compact_clock(at: usize, length: usize, pieces: &mut Pieces) -> Option<()> {
    let fields = [Field::Hour, Field::Minute, Field::Second];
    fields.into_iter().take(length / 2).enumerate().try_for_each(|(i, f)| pieces.push(f, at + 2 * i, at + 2 * i + 2))
}

/// What is left between the fields parts them: blanks, points, slashes.
fn others_are_separators(tokens: &Tokens<'_>, used: &[bool; MOST]) -> Option<()> {
    let plain = |t: Token| tokens.bytes(t).iter().all(|b| b" -/.,:_()[]".contains(b)) && t.len() <= 4;
    let fits = |at: usize| used[at] || tokens.get(at).is_some_and(|t| t.kind != Kind::Other || plain(t));
    let starts = tokens.get(0).is_some_and(|t| t.kind != Kind::Other || matches!(tokens.bytes(t), b"[" | b"("));
    let last = tokens.count - 1;
    let ends = used[last]
        || tokens.get(last).is_some_and(|t| t.kind != Kind::Other || matches!(tokens.bytes(t), b"]" | b")" | b"."));
    ((0..tokens.count).all(fits) && starts && ends).then_some(())
}

#[cfg(test)]
mod tests {
    use super::super::super::calendar::DAY;
    use super::*;

    /// Nanoseconds since 1970 in UTC.
    fn moment(text: &str, order: DateOrder) -> Option<i64> {
        let told = fields(text.as_bytes(), order)?.told(text.as_bytes())?;
        Some(told.days? * DAY + told.of_day - told.offset.unwrap_or(0))
    }

    #[test]
    fn spellings_of_one_moment_are_read_as_it() {
        let expected = "2021-03-04T10:00:30Z".parse::<jiff::Timestamp>().unwrap().as_nanosecond();
        for text in [
            "2021-03-04T10:00:30Z",
            "2021-03-04 10:00:30",
            "2021/3/4 10:00:30",
            "20210304T100030Z",
            "20210304 100030",
            "20210304100030",
            "2021-063T10:00:30",
            "2021-063 10:00:30.000",
            "2021:063:10:00:30",
            "2021:03:04 10:00:30",
            "2021-W09-4T10:00:30",
            "2021W094T100030",
            "04 Mar 2021 10:00:30.000",
            "04-Mar-2021 10:00:30",
            "4. März 2021 10:00:30",
            "Mar 4, 2021 10:00:30 AM",
            "Mar 04 2021 10:00:30",
            "Thu, 04 Mar 2021 10:00:30 GMT",
            "Thu 4 March 2021, 10:00:30 a.m.",
            "2021-03-04 10:00:30:000",
            "2021-03-04 11:00:30 CET",
            "2021-03-04 03:00:30-07",
            "2021-03-04 03:00:30 -0700",
            "2021-03-04T15:30:30+05:30",
            "2021-03-04 12:00:30 UTC+2",
            "2021_03_04_10_00_30",
            "2021-03-04-10-00-30",
            "10:00:30 2021-03-04",
        ] {
            assert_eq!(moment(text, DateOrder::YearFirst).map(i128::from), Some(expected), "{text}");
        }
        for (text, order) in [
            ("04.03.2021 10:00:30", DateOrder::DayFirst),
            ("04.03.21 10:00:30", DateOrder::DayFirst),
            ("03/04/2021 10:00:30 AM", DateOrder::MonthFirst),
            ("3/4/21 10:00:30", DateOrder::MonthFirst),
            ("04-MAR-21 10:00:30", DateOrder::DayFirst),
            ("21MAR04 10:00:30", DateOrder::YearFirst),
            ("21-03-04 10:00:30", DateOrder::YearFirst),
            ("04.03.2021 10.00.30", DateOrder::DayFirst),
        ] {
            assert_eq!(moment(text, order).map(i128::from), Some(expected), "{text}");
        }
    }

    #[test]
    fn what_is_no_time_is_not_read_as_one() {
        for text in [
            "",
            "1.5",
            "-3",
            "99.92 m",
            "12A",
            "4CA1B2",
            "a b",
            "2021-13-04",
            "10:61:00",
            "v1.2.3",
            "north",
            "2021-02-30",
            "5 of 7",
        ] {
            let read = fields(text.as_bytes(), DateOrder::YearFirst).and_then(|p| p.told(text.as_bytes()));
            assert_eq!(read, None, "{text}");
        }
    }

    #[test]
    fn times_are_written_in_the_form_of_a_sample() {
        let days = Some(18_691); // 2021-03-05
        let of_day = ((13 * 60 + 5) * 60 + 7) * 1_000_000_000 + 250_000_000;
        for (sample, order, text) in [
            ("04 Mar 2021 10:00:00.000", DateOrder::YearFirst, "05 Mar 2021 13:05:07.250"),
            ("03/04/2021 10:00:00 AM", DateOrder::MonthFirst, "03/05/2021 01:05:07 PM"),
            ("20210304T100000Z", DateOrder::YearFirst, "20210305T130507Z"),
            ("2021-063T10:00:00", DateOrder::YearFirst, "2021-064T13:05:07"),
            ("2021/3/4 9:00", DateOrder::YearFirst, "2021/3/5 13:05"),
            ("2021-W09-4 10:00", DateOrder::YearFirst, "2021-W09-5 13:05"),
            ("2021-03-04 10:00:00:000", DateOrder::YearFirst, "2021-03-05 13:05:07:250"),
        ] {
            let pieces = fields(sample.as_bytes(), order).unwrap();
            assert_eq!(pieces.written(sample, days, of_day), text);
        }
    }
}
