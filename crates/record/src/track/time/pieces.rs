//! A time as a text, taken apart: which bytes are the year, which the minute. Reading and writing both go by that.

use std::fmt::Write as _;

use jiff::civil::{ISOWeekDate, Weekday};

use super::super::calendar::{DAY, Date, SECOND};
use super::super::timestamp;
use super::words;

/// What a part of the text says.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Field {
    Year,
    /// A year of two digits: 69 to 99 are of the last century.
    YearOfCentury,
    Month,
    MonthName,
    Day,
    DayOfYear,
    /// The week of an ISO year.
    Week,
    /// 1 for Monday.
    WeekDay,
    Hour,
    Minute,
    Second,
    /// Decimals of a second, or thousandths after a colon.
    Fraction,
    /// AM or PM.
    Half,
    /// `Z`, `+01:00`, `CET`.
    Zone,
    /// Seconds since 1970.
    Epoch,
}

/// Where a field stands in the text.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Piece {
    pub(crate) field: Field,
    pub(crate) start: usize,
    pub(crate) end: usize,
}

/// No time has more fields.
const MOST: usize = 12;

/// The fields of a text, in the order in which they stand in it.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Pieces {
    list: [Piece; MOST],
    count: usize,
}

/// What the fields say together.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Told {
    /// Days since 1970, where there is a date.
    pub(crate) days: Option<i64>,
    /// Nanoseconds after midnight; more than a day for hours beyond 24.
    pub(crate) of_day: i64,
    /// How far the zone lies ahead of UTC, where one is written.
    pub(crate) offset: Option<i64>,
    /// True where a time of day is written.
    pub(crate) clock: bool,
}

impl Pieces {
    pub(crate) fn new() -> Self {
        Self { list: [Piece { field: Field::Year, start: 0, end: 0 }; MOST], count: 0 }
    }

    /// Adds a field; none when there are too many.
    pub(crate) fn push(&mut self, field: Field, start: usize, end: usize) -> Option<()> {
        *self.list.get_mut(self.count)? = Piece { field, start, end };
        self.count += 1;
        Some(())
    }

    pub(crate) fn iter(&self) -> impl Iterator<Item = &Piece> {
        self.list[..self.count].iter()
    }

    pub(crate) fn has(&self, field: Field) -> bool {
        self.iter().any(|p| p.field == field)
    }

    /// In the order of the text.
    pub(crate) fn sorted(mut self) -> Self {
        self.list[..self.count].sort_by_key(|p| p.start);
        self
    }

    /// What the fields of `text` say; none where they are no time.
    pub(crate) fn told(&self, text: &[u8]) -> Option<Told> {
        let mut said = Said::default();
        for piece in self.iter() {
            said.take(piece.field, text.get(piece.start..piece.end)?)?;
        }
        said.told()
    }

    /// `sample` with its fields those of another time: `days` since 1970 (none for a file of times of day alone) and
    /// nanoseconds after midnight, both in the zone of the sample.
    pub(crate) fn written(&self, sample: &str, days: Option<i64>, of_day: i64) -> String {
        let mut out = String::with_capacity(sample.len());
        let mut done = 0;
        for piece in self.iter() {
            out.push_str(sample.get(done..piece.start).unwrap_or_default());
            let old = sample.get(piece.start..piece.end).unwrap_or_default();
            out.push_str(&self.field_text(piece.field, old, days, of_day));
            done = piece.end;
        }
        out.push_str(sample.get(done..).unwrap_or_default());
        out
    }

    fn field_text(&self, field: Field, old: &str, days: Option<i64>, of_day: i64) -> String {
        let date = days.map(Date::of_days);
        let number = |value: i64| {
            let width = if old.len() > 1 { old.len() } else { 0 };
            format!("{value:0width$}")
        };
        let of_date = |get: fn(Date) -> i64| date.map_or_else(|| old.to_owned(), |d| number(get(d)));
        let seconds = of_day / SECOND;
        let hour = seconds / 3600;
        match field {
            Field::Year if self.has(Field::Week) => {
                iso(days).map_or_else(|| old.to_owned(), |w| number(w.year().into()))
            }
            Field::Year => of_date(|d| d.year),
            Field::YearOfCentury => of_date(|d| d.year.rem_euclid(100)),
            Field::Month => of_date(|d| d.month),
            Field::Day => of_date(|d| d.day),
            Field::DayOfYear => days.zip(date).map_or_else(
                || number(of_day / DAY),
                |(days, d)| number(days - Date { month: 1, day: 1, ..d }.days().unwrap_or(days) + 1),
            ),
            Field::MonthName => date.map_or_else(|| old.to_owned(), |d| month_like(old, d.month)),
            Field::Week => iso(days).map_or_else(|| old.to_owned(), |w| number(w.week().into())),
            Field::WeekDay => {
                iso(days).map_or_else(|| old.to_owned(), |w| number(w.weekday().to_monday_one_offset().into()))
            }
            Field::Hour if self.has(Field::Half) => number(if hour % 12 == 0 { 12 } else { hour % 12 }),
            Field::Hour if self.has(Field::DayOfYear) => number(hour % 24),
            Field::Hour => number(hour),
            Field::Minute if !self.has(Field::Hour) => number(seconds / 60),
            Field::Minute => number(seconds / 60 % 60),
            Field::Second => number(seconds % 60),
            Field::Fraction => {
                let mut text = String::new();
                let _ = write!(text, "{:09}", of_day.rem_euclid(SECOND));
                text.chars().chain(std::iter::repeat('0')).take(old.len()).collect()
            }
            Field::Half => half_like(old, hour % 24 >= 12),
            Field::Epoch => number(days.unwrap_or(0) * 86_400 + seconds),
            Field::Zone => old.to_owned(),
        }
    }

    /// Nanoseconds of the last decimal that is written.
    pub(crate) fn step(&self) -> i64 {
        let digits = |p: &Piece| SECOND / 10_i64.pow(u32::try_from((p.end - p.start).min(9)).unwrap_or(9));
        let fraction = self.iter().find(|p| p.field == Field::Fraction).map(digits);
        let coarse = [
            (Field::Second, SECOND),
            (Field::Epoch, SECOND),
            (Field::Minute, 60 * SECOND),
            (Field::Hour, 3600 * SECOND),
        ];
        fraction.or_else(|| coarse.into_iter().find(|(f, _)| self.has(*f)).map(|(_, ns)| ns)).unwrap_or(DAY)
    }
}

fn iso(days: Option<i64>) -> Option<ISOWeekDate> {
    let date = Date::of_days(days?);
    let civil = jiff::civil::Date::new(i16::try_from(date.year).ok()?, date.month as i8, date.day as i8).ok()?;
    Some(civil.iso_week_date())
}

/// A month in the form of `old`: as many letters, in its case. English: other languages are read, not written.
fn month_like(old: &str, month: i64) -> String {
    let name = words::month_name(month);
    let letters = old.chars().count();
    let short = letters <= 4
        || letters < name.len() && words::month(old.as_bytes()).is_some_and(|m| words::month_name(m).len() != letters);
    let name = if short { &name[..3] } else { name };
    let upper = old.chars().all(|c| !c.is_lowercase());
    let lower = old.chars().all(|c| !c.is_uppercase());
    if upper {
        name.to_uppercase()
    } else if lower {
        name.to_lowercase()
    } else {
        name.to_owned()
    }
}

fn half_like(old: &str, afternoon: bool) -> String {
    let lower = old.chars().any(char::is_lowercase);
    let text = match (old.len(), afternoon) {
        (1, false) => "A",
        (1, true) => "P",
        (_, false) => "AM",
        (_, true) => "PM",
    };
    if lower { text.to_lowercase() } else { text.to_owned() }
}

/// The fields read so far.
#[derive(Default)]
struct Said {
    year: Option<i64>,
    month: Option<i64>,
    day: Option<i64>,
    day_of_year: Option<i64>,
    week: Option<i64>,
    week_day: Option<i64>,
    hour: Option<i64>,
    minute: Option<i64>,
    second: Option<i64>,
    fraction: i64,
    afternoon: Option<bool>,
    offset: Option<i64>,
    epoch: Option<i64>,
}

/// How far a zone lies ahead of UTC: `+01:00`, `-7`, `CET`.
fn offset(text: &[u8]) -> Option<i64> {
    match text {
        [sign @ (b'+' | b'-'), hour] => timestamp::offset(&[*sign, b'0', *hour]),
        _ => timestamp::offset(text).or_else(|| words::zone(text)),
    }
}

impl Said {
    fn take(&mut self, field: Field, text: &[u8]) -> Option<()> {
        match field {
            Field::MonthName => self.month = Some(words::month(text)?),
            Field::Half => self.afternoon = Some(words::afternoon(text)?),
            Field::Zone => self.offset = Some(offset(text)?),
            Field::Fraction => self.fraction = timestamp::fraction_ns(text)?,
            _ => {
                let value = timestamp::integer(text)?;
                let place = match field {
                    Field::Year => &mut self.year,
                    Field::YearOfCentury => {
                        self.year = Some(if value < 69 { 2000 + value } else { 1900 + value });
                        return Some(());
                    }
                    Field::Month => &mut self.month,
                    Field::Day => &mut self.day,
                    Field::DayOfYear => &mut self.day_of_year,
                    Field::Week => &mut self.week,
                    Field::WeekDay => &mut self.week_day,
                    Field::Hour => &mut self.hour,
                    Field::Minute => &mut self.minute,
                    Field::Second => &mut self.second,
                    _ => &mut self.epoch,
                };
                *place = Some(value);
            }
        }
        Some(())
    }

    fn told(&self) -> Option<Told> {
        let clock = self.hour.is_some() || self.minute.is_some() || self.second.is_some();
        if let Some(epoch) = self.epoch {
            let of_day = epoch.rem_euclid(86_400) * SECOND + self.fraction;
            return Some(Told { days: Some(epoch.div_euclid(86_400)), of_day, offset: self.offset, clock: true });
        }
        let (minute, second) = (self.minute.unwrap_or(0), self.second.unwrap_or(0));
        // Minutes may go beyond 60 where no hours are written.
        if second > 60 || (minute > 59 && self.hour.is_some()) {
            return None;
        }
        let hour = match (self.hour.unwrap_or(0), self.afternoon) {
            (hour, None) => hour,
            (12, Some(afternoon)) => {
                if afternoon {
                    12
                } else {
                    0
                }
            }
            (hour @ 0..=11, Some(afternoon)) => hour + if afternoon { 12 } else { 0 },
            _ => return None,
        };
        let days = self.days()?;
        // A day of the year without a year is time elapsed in the year.
        let hour = match (days, self.day_of_year) {
            (None, Some(day)) if (1..=366).contains(&day) && hour <= 24 => day * 24 + hour,
            (None, Some(_)) => return None,
            _ => hour,
        };
        // A date has a day of 24 hours: 24:00 is the midnight that ends it.
        if days.is_some() && (hour > 24 || (hour == 24 && minute + second + self.fraction > 0)) || hour > 1_000_000 {
            return None;
        }
        let of_day = ((hour * 60 + minute) * 60 + second).checked_mul(SECOND)?.checked_add(self.fraction)?;
        Some(Told { days, of_day, offset: self.offset, clock })
    }

    /// Days since 1970 where there is a date; none where there is one that is not in the calendar.
    #[expect(clippy::option_option, reason = "no such date, or no date")]
    fn days(&self) -> Option<Option<i64>> {
        let Some(year) = self.year else {
            return if self.month.is_none() && self.day.is_none() { Some(None) } else { None };
        };
        let first = || Date { year, month: 1, day: 1 }.days();
        if let Some(day) = self.day_of_year {
            let leap = Date { year, month: 2, day: 29 }.days().is_some();
            return (1..=365 + i64::from(leap)).contains(&day).then(|| first().map(|f| f + day - 1));
        }
        if let Some(week) = self.week {
            let day = Weekday::from_monday_one_offset(i8::try_from(self.week_day.unwrap_or(1)).ok()?).ok()?;
            let date = ISOWeekDate::new(i16::try_from(year).ok()?, i8::try_from(week).ok()?, day).ok()?.date();
            let (month, day) = (i64::from(date.month()), i64::from(date.day()));
            return Some(Some(Date { year: i64::from(date.year()), month, day }.days()?));
        }
        Some(Some(Date { year, month: self.month?, day: self.day.unwrap_or(1) }.days()?))
    }
}
