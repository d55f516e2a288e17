//! Several columns that are one time, found by their names and by what they hold.

use super::super::calendar::SECOND;
use super::super::names;
use super::super::time::{DateOrder, Part};
use super::Timing;
use super::candidates::Candidates;
use super::form::{Form, numbers};

/// What the name of a column says it is of a time.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Named {
    Year,
    Month,
    Day,
    DayOfYear,
    Hour,
    Minute,
    Second,
    Fraction(i64),
    SecondOfDay,
    Week,
    SecondOfWeek(i64),
}

/// Names in lower case, of letters and digits alone.
const NAMES: [(&[&str], Named); 13] = [
    (&["year", "yr", "yy", "yyyy", "jahr", "annee", "année", "ano", "year4", "anno"], Named::Year),
    (&["month", "mo", "mon", "mm", "monat", "mois", "mes"], Named::Month),
    (&["day", "dy", "dd", "dom", "tag", "jour", "dia", "dayofmonth", "mday"], Named::Day),
    (
        &["doy", "jday", "yday", "ddd", "dayofyear", "julianday", "jd", "dayyear", "yearday", "day_of_year"],
        Named::DayOfYear,
    ),
    (&["hour", "hr", "hh", "h", "stunde", "std", "heure", "hora", "hours", "hod"], Named::Hour),
    (&["minute", "min", "mn", "mi", "minutes", "mins", "minuten"], Named::Minute),
    (&["second", "sec", "ss", "seconds", "secs", "sekunde", "s"], Named::Second),
    (&["millisecond", "milliseconds", "millis", "msec", "ms", "msecs", "milli"], Named::Fraction(1_000_000)),
    (&["microsecond", "microseconds", "micros", "usec", "us", "usecs", "micro"], Named::Fraction(1_000)),
    (&["nanosecond", "nanoseconds", "nanos", "nsec", "ns", "nsecs", "nanosec", "nano"], Named::Fraction(1)),
    (&["sod", "secofday", "secondsofday", "secondofday", "tod", "utcsec", "secs_of_day"], Named::SecondOfDay),
    (&["week", "wk", "gpsweek", "wn", "gwk", "weekno", "weeknumber", "gps_week"], Named::Week),
    (
        &[
            "tow",
            "gpstow",
            "sow",
            "gpssow",
            "timeofweek",
            "gpstimeofweek",
            "secofweek",
            "secondsofweek",
            "secondofweek",
            "gpssec",
            "gpssecs",
            "gpssecond",
            "gpsseconds",
            "weeksec",
            "weekseconds",
            "itow",
        ],
        Named::SecondOfWeek(0),
    ),
];

/// What a name says; the words of a path (`header.stamp.nsecs`) by its last.
fn named(name: &str) -> Option<Named> {
    let lower = name.to_lowercase();
    // A unit in brackets is none of the name.
    let bare = lower.split(['(', '[']).next().unwrap_or("").trim();
    let plain: String = bare.chars().filter(|c| c.is_alphanumeric()).collect();
    let of = |text: &str| NAMES.iter().find(|(names, _)| names.contains(&text)).map(|(_, named)| *named);
    let last = names::words(bare).last().map(|w| w.to_lowercase()).unwrap_or_default();
    let unit = if lower.contains("ms") || lower.contains("milli") || plain == "itow" { 1_000_000 } else { SECOND };
    // `tow_s` ends in its unit, which is the name of a part, too.
    let without_unit = plain.strip_suffix("ms").or_else(|| plain.strip_suffix('s'));
    let with_unit = without_unit.and_then(of).filter(|n| matches!(n, Named::SecondOfWeek(_) | Named::SecondOfDay));
    let found = of(&plain)
        .or(with_unit)
        .or_else(|| of(&last).filter(|n| !matches!(n, Named::Second) || names::words(bare).len() > 1));
    let week = |n: Named| if let Named::SecondOfWeek(_) = n { Named::SecondOfWeek(unit) } else { n };
    found.map(week)
}

/// True for the name of a part of a time.
pub(super) fn is_named_part(name: &str) -> bool {
    named(name).is_some()
}

/// True for the name of seconds of the GPS week.
pub(super) fn is_second_of_week(name: &str) -> bool {
    matches!(named(name), Some(Named::SecondOfWeek(_)))
}

/// The parts that are there, each with its column.
#[derive(Default)]
struct Found {
    year: Option<usize>,
    month: Option<usize>,
    day: Option<usize>,
    day_of_year: Option<usize>,
    hour: Option<usize>,
    minute: Option<usize>,
    second: Option<usize>,
    fraction: Option<(usize, i64)>,
    second_of_day: Option<usize>,
    week: Option<usize>,
    second_of_week: Option<(usize, i64)>,
}

impl Found {
    /// By the names of columns whose cells fit them.
    fn by_name(c: &Candidates<'_>, places: impl Iterator<Item = usize>) -> Self {
        let mut found = Self::default();
        for column in places {
            let Some(mut part) = named(&c.head.names[column]) else { continue };
            // Months before the hours, minutes after them.
            let is_mm = c.head.names[column].trim_start_matches(['#', ' ']).eq_ignore_ascii_case("mm");
            if is_mm && (found.month.is_some() || found.hour.is_some()) {
                part = Named::Minute;
            }
            if fits(c, column, part) {
                found.take(part, column);
            }
        }
        found
    }

    /// By what the first columns hold, where none has a name.
    fn by_place(c: &Candidates<'_>) -> Self {
        let mut found = Self::default();
        let order = [Named::Year, Named::Month, Named::Day, Named::Hour, Named::Minute, Named::Second];
        let first = usize::from(!fits(c, 0, Named::Year));
        let mut skipped = 0;
        for (i, part) in order.into_iter().enumerate() {
            let column = first + i + skipped;
            // A day of the year may stand between the year and the month.
            let column = if part == Named::Month && !fits(c, column, part) && fits(c, column, Named::DayOfYear) {
                skipped = 1;
                column + 1
            } else {
                column
            };
            // The second may have decimals; the others are whole.
            if column >= c.head.names.len() || !fits(c, column, part) {
                break;
            }
            found.take(part, column);
        }
        if found.day.is_none() && hours_after_day_of_year(c, first) {
            let hour = Some(first + 2);
            return Self { year: Some(first), day_of_year: Some(first + 1), hour, ..Self::default() };
        }
        found
    }

    fn take(&mut self, part: Named, column: usize) {
        let place = match part {
            Named::Year => &mut self.year,
            Named::Month => &mut self.month,
            Named::Day => &mut self.day,
            Named::DayOfYear => &mut self.day_of_year,
            Named::Hour => &mut self.hour,
            Named::Minute => &mut self.minute,
            Named::Second => &mut self.second,
            Named::SecondOfDay => &mut self.second_of_day,
            Named::Week => &mut self.week,
            Named::Fraction(unit) => {
                self.fraction.get_or_insert((column, unit));
                return;
            }
            Named::SecondOfWeek(unit) => {
                self.second_of_week.get_or_insert((column, unit));
                return;
            }
        };
        place.get_or_insert(column);
    }

    /// The columns and parts of a time that begins with `start`, and goes on with the time of day that is there.
    fn with_clock(&self, c: &Candidates<'_>, mut start: Vec<(usize, Part)>) -> Vec<(usize, Part)> {
        let taken: Vec<usize> = start.iter().map(|(c, _)| *c).collect();
        let is_clock = |i: &usize| matches!(c.forms[*i], Some(Form::Clock | Form::OtherClock)) && !taken.contains(i);
        let count = |unit_ns| Part::Count { unit_ns };
        if let Some(second) = self.second_of_day {
            start.push((second, count(SECOND)));
        } else if let Some(hour) = self.hour {
            // `hour` may hold 1030 where it means half past ten.
            let clock = numbers(c.head, hour).iter().any(|v| *v > 24.0);
            start.push((hour, if clock { Part::Clock } else { Part::Hour }));
            start.extend(self.minute.filter(|_| !clock).map(|m| (m, count(60 * SECOND))));
            let minutes = self.minute.is_some();
            start.extend(self.second.filter(|_| minutes && !clock).map(|s| (s, count(SECOND))));
            start.extend(self.fraction.filter(|_| self.second.is_some()).map(|(f, unit)| (f, count(unit))));
        } else if let Some(clock) = (0..c.forms.len()).find(is_clock) {
            start.push((clock, Part::Clock));
        } else if let Some(second) = self.second.filter(|s| numbers(c.head, *s).iter().any(|v| *v > 60.0)) {
            start.push((second, count(SECOND)));
        } else if let Some(clock) = digits_clock(c, &taken) {
            start.push((clock, Part::Clock));
        }
        start
    }
}

/// A year, a day of the year and a time of day like `1030` in columns from `first` on, as loggers write them that name no
/// column.
fn hours_after_day_of_year(c: &Candidates<'_>, first: usize) -> bool {
    let (day, clock) = (first + 1, first + 2);
    if !fits(c, first, Named::Year) || !fits(c, day, Named::DayOfYear) || !fits(c, clock, Named::Hour) {
        return false;
    }
    let whole = |column: usize| numbers(c.head, column).iter().all(|v| v.fract() == 0.0);
    let reads = |cell: &&str| super::super::time::part_clock(cell.as_bytes()).is_some();
    let minutes = numbers(c.head, clock).iter().any(|v| *v > 24.0);
    whole(day) && whole(clock) && minutes && c.head.column(clock).iter().all(reads)
}

/// A column of whole numbers that are times of day (`1030`), named like a time.
fn digits_clock(c: &Candidates<'_>, taken: &[usize]) -> Option<usize> {
    let fits = |i: &usize| {
        let cells = c.head.column(*i);
        let name = c.head.names[*i].to_lowercase();
        let named = names::time_rank(&name) > 0 || name.contains("hhmm") || name.contains("hour");
        let reads = |cell: &&str| super::super::time::part_clock(cell.as_bytes()).is_some();
        let moves = name.contains("hhmm") || numbers(c.head, *i).windows(2).any(|w| w[0].to_bits() != w[1].to_bits());
        c.forms[*i] == Some(Form::Number) && named && !taken.contains(i) && moves && cells.iter().all(reads)
    };
    (0..c.forms.len()).find(fits)
}

/// Do the cells of the column hold what its name says?
fn fits(c: &Candidates<'_>, column: usize, part: Named) -> bool {
    if column >= c.head.names.len() {
        return false;
    }
    if part == Named::Month && c.forms[column] != Some(Form::Number) {
        let cells = c.head.column(column);
        return !cells.is_empty() && cells.iter().all(|cell| super::super::time::is_month(cell.as_bytes()));
    }
    let values = numbers(c.head, column);
    let (whole, low, high) = match part {
        Named::Year => (true, 0.0, 2200.0),
        Named::Month => (true, 1.0, 12.0),
        Named::Day => (true, 1.0, 31.0),
        Named::DayOfYear => (false, 0.0, 367.0),
        Named::Hour => (false, 0.0, 2400.0),
        Named::Minute => (false, 0.0, 60.0),
        Named::Second => (false, 0.0, 9.3e9),
        #[expect(clippy::cast_precision_loss, reason = "a short number")]
        Named::Fraction(unit) => (true, 0.0, (SECOND / unit) as f64),
        Named::SecondOfDay => (false, 0.0, 86_400.0),
        Named::Week => (true, 0.0, 5000.0),
        #[expect(clippy::cast_precision_loss, reason = "a week of units")]
        Named::SecondOfWeek(unit) => (false, 0.0, 604_800.0 * (SECOND / unit) as f64),
    };
    // One wild stamp is none of them.
    let fitting = values.iter().filter(|v| (low..=high).contains(*v) && (!whole || v.fract() == 0.0)).count();
    let year =
        part != Named::Year || values.iter().filter(|v| **v >= 1850.0 || **v < 100.0).count() * 20 >= values.len() * 19;
    !values.is_empty() && fitting * 20 >= values.len() * 19 && year
}

/// The time in several columns, where there is one that goes forward.
pub(super) fn recognised(c: &Candidates<'_>) -> Option<Timing> {
    let nameless = c.head.names.iter().enumerate().all(|(i, n)| *n == format!("column_{}", i + 1));
    if let Some(timing) = week_by_place(c) {
        return Some(timing);
    }
    let found = if nameless { Found::by_place(c) } else { Found::by_name(c, 0..c.head.names.len()) };
    let timing = assembled(c, &found)?;
    // Seconds without a name are seconds only where minutes stand still.
    let without = assembled(c, &Found { second: None, ..found }).filter(|_| nameless);
    let timing = without.filter(|t| c.steps(t).repeated == 0).unwrap_or(timing);
    let steps = c.steps(&timing);
    // Tracks may each start again.
    let fits = steps.one_way() || (!nameless && steps.forward > steps.back && steps.forward > 0);
    fits.then_some(timing)
}

/// A week of the GPS calendar under the name of a time, and seconds of the week in the column after it, without a name.
fn week_by_place(c: &Candidates<'_>) -> Option<Timing> {
    let nameless = c.head.names.get(1).is_some_and(|n| n == "column_2");
    let week = fits(c, 0, Named::Week) && numbers(c.head, 0).iter().all(|w| *w >= 500.0);
    if !nameless || !week || !fits(c, 1, Named::SecondOfWeek(SECOND)) || names::time_rank(&c.head.names[0]) == 0 {
        return None;
    }
    let timing = Timing::of_parts(vec![0, 1], vec![Part::GpsWeek, Part::Count { unit_ns: SECOND }]);
    c.steps(&timing).one_way().then_some(timing)
}

/// The columns that the user says are one time, in any order.
pub(super) fn told(c: &Candidates<'_>, places: &[usize]) -> Option<Timing> {
    let found = Found::by_name(c, places.iter().copied());
    let timing = assembled(c, &found).filter(|t| places.iter().all(|p| t.has(*p)));
    timing.or_else(|| {
        // A date, then what is counted after it.
        let mut parts = Vec::new();
        for (i, place) in places.iter().enumerate() {
            let part = match c.forms[*place]? {
                form if form.is_dated() => Part::Date(c.date_order(*place)?),
                Form::Clock | Form::OtherClock | Form::Duration => Part::Clock,
                _ if super::super::time::digits_are_dates(&c.head.column(*place)) => Part::Date(DateOrder::YearFirst),
                _ if i > 0 && parts.iter().any(|p| matches!(p, Part::Date(_))) => Part::Clock,
                _ => return None,
            };
            parts.push(part);
        }
        Some(Timing::of_parts(places.to_vec(), parts))
    })
}

fn assembled(c: &Candidates<'_>, found: &Found) -> Option<Timing> {
    let of = |list: Vec<(usize, Part)>| {
        let (columns, parts): (Vec<usize>, Vec<Part>) = list.into_iter().unzip();
        (columns.len() > 1).then(|| Timing::of_parts(columns, parts))
    };
    if let (Some(week), Some((second, unit_ns))) = (found.week, found.second_of_week) {
        return of(vec![(week, Part::GpsWeek), (second, Part::Count { unit_ns })]);
    }
    if let (Some(year), Some(month), Some(day)) = (found.year, found.month, found.day) {
        return of(found.with_clock(c, vec![(year, Part::Year), (month, Part::Month), (day, Part::Day)]));
    }
    if let (Some(year), Some(day)) = (found.year, found.day_of_year) {
        return of(found.with_clock(c, vec![(year, Part::Year), (day, Part::DayOfYear)]));
    }
    if let (Some(year), Some(month)) = (found.year, found.month) {
        return of(vec![(year, Part::Year), (month, Part::Month)]);
    }
    let date = (0..c.forms.len()).find(|i| is_date(c, *i));
    if let Some(date) = date {
        let order = c.date_order(date)?;
        let timing = of(found.with_clock(c, vec![(date, Part::Date(order))]));
        // What is read as two columns of texts has a form of its own.
        return timing.filter(|t| {
            !t.columns.iter().any(|i| c.forms[*i] == Some(Form::Clock)) || c.forms[date] == Some(Form::Number)
        });
    }
    if let (Some((fraction, unit_ns)), Some(second)) =
        (found.fraction, found.second.or_else(|| seconds_before(c, found)))
    {
        return of(vec![(second, Part::Seconds), (fraction, Part::Count { unit_ns })]);
    }
    None
}

/// A column of dates without times of day.
fn is_date(c: &Candidates<'_>, column: usize) -> bool {
    match c.forms[column] {
        Some(Form::Number) => {
            let cells = c.head.column(column);
            cells.iter().all(|cell| cell.len() == 8) && super::super::time::digits_are_dates(&cells)
        }
        form => form.is_some_and(Form::is_date_only),
    }
}

/// The whole seconds that a column of nanoseconds belongs to: the column before it, with a name of a time.
fn seconds_before(c: &Candidates<'_>, found: &Found) -> Option<usize> {
    let (fraction, _) = found.fraction?;
    let before = fraction.checked_sub(1)?;
    let whole = numbers(c.head, before).iter().all(|v| v.fract() == 0.0);
    (whole && names::time_rank(&c.head.names[before]) > 0).then_some(before)
}

/// True where the parts tell a date.
pub(super) fn tells_date(timing: &Timing) -> bool {
    match &timing.format {
        super::TimeFormat::Parts(parts) => parts.iter().any(|p| p.dates()),
        _ => false,
    }
}
