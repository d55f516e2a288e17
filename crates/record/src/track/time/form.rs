//! How the cells of a column write times: the order of a date, and what a number counts.

use super::super::calendar::{DAY, SECOND};
use super::super::names;
use super::super::{TimeFormat, TimeUnit};
use super::free::{DateOrder, fields};
use super::{Zero, parts};

/// In which order the dates in `cells` are written; none where nothing tells, and an example of such a cell.
///
/// The order that reads the most cells is taken; then the one that points (`04.03.2021`: day first) or the halves of
/// the day (`3/4/2021 10:00 AM`: month first) suggest; then the one in which time goes forward in the smallest steps.
pub(crate) fn order_of(cells: &[&str]) -> Option<DateOrder> {
    let filled: Vec<&str> = cells.iter().copied().filter(|c| !c.is_empty()).collect();
    let read = |order: DateOrder| -> Vec<Option<i64>> {
        let one = |c: &&str| {
            let told = fields(c.as_bytes(), order)?.told(c.as_bytes())?;
            told.days?.checked_mul(DAY)?.checked_add(told.of_day)
        };
        filled.iter().map(one).collect()
    };
    let all: Vec<(DateOrder, Vec<Option<i64>>)> = DateOrder::ALL.into_iter().map(|o| (o, read(o))).collect();
    let count = |moments: &[Option<i64>]| moments.iter().flatten().count();
    let most = all.iter().map(|(_, m)| count(m)).max().unwrap_or(0);
    if most == 0 {
        return None;
    }
    let mut kept: Vec<&(DateOrder, Vec<Option<i64>>)> = all.iter().filter(|(_, m)| count(m) == most).collect();
    let same = kept.iter().all(|(_, m)| *m == kept[0].1);
    if !same {
        // An order that reads every cell as another one does tells nothing more.
        kept =
            (0..kept.len()).filter(|i| !kept[i + 1..].iter().any(|(_, m)| *m == kept[*i].1)).map(|i| kept[i]).collect();
    }
    let suggested = || {
        let with = |text: &str| filled.iter().filter(|c| c.contains(text)).count() * 2 > filled.len();
        let half = |c: &&&str| {
            c.to_uppercase().split(' ').any(|w| matches!(w, "AM" | "PM") || (w.ends_with('M') && w.contains(':')))
        };
        let half = filled.iter().filter(half).count() * 2 > filled.len();
        match () {
            () if with("/") && half => Some(DateOrder::MonthFirst),
            () if !with("/") && dotted(&filled) => Some(DateOrder::DayFirst),
            () => None,
        }
    };
    if same || kept.len() == 1 {
        return kept.first().map(|(order, _)| *order);
    }
    if let Some(order) = suggested().filter(|o| kept.iter().any(|(k, _)| k == o)) {
        return Some(order);
    }
    let back = |moments: &[Option<i64>]| {
        let steps: Vec<i64> = moments
            .iter()
            .flatten()
            .copied()
            .collect::<Vec<_>>()
            .windows(2)
            .map(|w| w[1].saturating_sub(w[0]))
            .collect();
        let back = steps.iter().filter(|s| **s < 0).count();
        back.min(steps.iter().filter(|s| **s > 0).count())
    };
    let least = kept.iter().map(|(_, m)| back(m)).min()?;
    kept.retain(|(_, m)| back(m) == least);
    if let [(order, _)] = kept.as_slice() {
        return Some(*order);
    }
    if let Some(order) = even(&kept) {
        return Some(order);
    }
    // A month of days is a likelier record than years of months.
    let span = |moments: &[Option<i64>]| {
        let (min, max) = (moments.iter().flatten().min(), moments.iter().flatten().max());
        min.zip(max).map_or(0, |(a, b)| b.saturating_sub(*a))
    };
    let mut days: Vec<i64> = kept.first()?.1.iter().flatten().map(|ns| ns.div_euclid(DAY)).collect();
    days.sort_unstable();
    days.dedup();
    kept.sort_by_key(|(_, m)| span(m));
    let [first, second, ..] = kept.as_slice() else { return None };
    // The name of a month is between day and year, unless the steps show another order.
    let named = filled.iter().filter(|c| c.split(|x: char| !x.is_alphabetic()).any(super::is_month_name)).count() * 2
        > filled.len();
    if named && days.len() < 8 {
        return kept.iter().map(|(order, _)| *order).find(|o| *o == DateOrder::DayFirst);
    }
    (days.len() >= 8 && span(&first.1) < span(&second.1) / 2).then_some(first.0)
}

/// The only order in which samples of parts of a day follow each other without a jump.
fn even(kept: &[&(DateOrder, Vec<Option<i64>>)]) -> Option<DateOrder> {
    const FEW: usize = 8;
    /// Longer than the usual step by so much is a jump.
    const JUMP: i64 = 20;
    let jumps = |moments: &[Option<i64>]| -> Option<usize> {
        let known: Vec<i64> = moments.iter().flatten().copied().collect();
        let steps: Vec<i64> = known.windows(2).map(|w| w[1].saturating_sub(w[0]).saturating_abs()).collect();
        let mut sorted: Vec<i64> = steps.iter().copied().filter(|s| *s > 0).collect();
        sorted.sort_unstable();
        let usual = sorted.get(sorted.len() / 2).copied().filter(|usual| sorted.len() >= FEW && *usual < DAY)?;
        Some(steps.iter().filter(|s| **s > usual.saturating_mul(JUMP)).count())
    };
    let counted: Vec<(DateOrder, usize)> =
        kept.iter().map(|(order, m)| Some((*order, jumps(m)?))).collect::<Option<_>>()?;
    let mut smooth = counted.iter().filter(|(_, jumps)| *jumps == 0);
    smooth.next().filter(|_| smooth.next().is_none()).map(|(order, _)| *order)
}

/// Do most cells start with a date with points?
fn dotted(cells: &[&str]) -> bool {
    let points = |c: &&&str| c.split([' ', 'T']).next().is_some_and(|date| date.matches('.').count() >= 2);
    cells.iter().filter(points).count() * 2 > cells.len()
}

/// What the numbers of a column count, as times.
pub(crate) struct Numbers<'a> {
    /// The name of the column.
    pub(crate) name: &'a str,
    /// The unit that its name or a row of units tells.
    pub(crate) unit: Option<i64>,
    /// The unit that the user told.
    pub(crate) told: Option<TimeUnit>,
    /// The cells as texts, and as numbers.
    pub(crate) cells: &'a [&'a str],
    pub(crate) values: &'a [f64],
}

/// How the numbers of a column are times, and what was assumed for it.
pub(crate) fn number_form(numbers: &Numbers<'_>) -> (TimeFormat, Option<String>) {
    if numbers.told.is_some() {
        return (counted(numbers, numbers.told.map(|u| u.ns)), None);
    }
    let (values, words) = (numbers.values, named(numbers.name));
    let has = |wanted: &[&str]| words.iter().any(|w| wanted.contains(&w.as_str()));
    let rank = names::time_rank(numbers.name);
    let assumed = |format: TimeFormat| {
        let said = format!("`{}` is read as {}", super::super::printable(numbers.name), format.words());
        (format, Some(said))
    };
    if digits_are_dates(numbers.cells) {
        return assumed(TimeFormat::Stamp { order: DateOrder::YearFirst });
    }
    let typical = middle(values.to_vec());
    let step = middle(values.windows(2).map(|w| (w[1] - w[0]).abs()).filter(|s| *s > 0.0).collect());
    let decimals =
        numbers.cells.iter().filter_map(|c| c.find(['.', ',']).map(|at| c.len() - at - 1)).max().unwrap_or(0);
    let within = |low: f64, high: f64| (low..high).contains(&typical);
    let days = |zero| TimeFormat::Since { unit_ns: DAY, zero };
    let of_days = matches!(numbers.unit, None | Some(DAY));
    let dated =
        has(&["date", "datum", "day", "days", "serial", "excel", "fecha"]) || (decimals >= 4 && step < 1.0 && rank > 0);
    if has(&["mjd"]) && within(10_000.0, 100_000.0) || of_days && dated && within(51_136.0, 70_000.0) {
        return assumed(days(Zero::ModifiedJulian));
    }
    if (has(&["jd", "julian", "jdate", "hjd", "bjd"]) || (rank > 0 && of_days)) && within(2_300_000.0, 2_600_000.0) {
        return assumed(days(Zero::Julian));
    }
    if of_days && dated && within(20_000.0, 51_136.0) {
        return assumed(days(Zero::Spreadsheet));
    }
    if (has(&["datenum", "matlab"]) || (rank > 0 && of_days))
        && within(700_000.0, 770_000.0)
        && (step <= 1.0 || has(&["datenum"]))
    {
        return assumed(days(Zero::Matlab));
    }
    let yearly = has(&["year", "years", "jahr", "decyear", "yyyy", "yr", "decimal", "epoch", "date"])
        || (rank > 0 && decimals >= 3);
    if yearly && within(1850.0, 2150.0) && step <= 1.0 && !has(&["month"]) && numbers.unit.is_none_or(|u| u >= DAY) {
        return assumed(TimeFormat::DecimalYear);
    }
    let gps = has(&["gps", "gnss", "gpst", "gpstime"]);
    if gps && !has(&["tow", "week"]) {
        for unit_ns in [SECOND, 1_000_000, 1_000, 1] {
            #[expect(clippy::cast_precision_loss, reason = "a power of ten")]
            let seconds = typical * (unit_ns as f64 / 1e9);
            // 1995 to 2050.
            if (473_000_000.0..2_210_000_000.0).contains(&seconds) && numbers.unit.is_none_or(|u| u == unit_ns) {
                return assumed(TimeFormat::Since { unit_ns, zero: Zero::Gps });
            }
        }
    }
    if rank > 0
        && within(3_400_000_000.0, 4_000_000_000.0)
        && numbers.unit.is_none_or(|u| u == SECOND)
        && step < 864_000.0
    {
        return assumed(TimeFormat::Since { unit_ns: SECOND, zero: Zero::Labview });
    }
    if digits_are_clocks(numbers, rank, &words) {
        return assumed(TimeFormat::Parts(vec![super::Part::Clock]));
    }
    match counted(numbers, numbers.unit) {
        TimeFormat::Seconds
            if numbers.unit.is_none() && rank >= 3 && decimals == 0 && are_microseconds(values, step) =>
        {
            assumed(TimeFormat::Elapsed { unit_ns: 1_000 })
        }
        format => (format, None),
    }
}

/// True for whole numbers that go on by a thousandth of a second to a second, if they count microseconds: steps of about one
/// size that are not round, as a clock that was read gives them. Seconds would be hours apart, to the second.
fn are_microseconds(values: &[f64], step: f64) -> bool {
    const FEWEST: usize = 8;
    let typical = middle(values.to_vec());
    let steps: Vec<f64> = values.windows(2).map(|w| w[1] - w[0]).collect();
    let most = |fits: &dyn Fn(&f64) -> bool| steps.iter().filter(|s| fits(s)).count() * 5 >= steps.len() * 4;
    let odd = steps.iter().filter(|s| **s % 10.0 != 0.0).count();
    steps.len() >= FEWEST
        && (1e6..1e13).contains(&typical)
        && (1e3..1e6).contains(&step)
        && most(&|s| (0.5 * step..=1.5 * step).contains(s))
        && odd * 2 > steps.len()
}

/// Seconds, another unit, or time since 1970: by the unit, and by the size of the numbers where that and name or steps
/// make dates from 1990 to 2100.
fn counted(numbers: &Numbers<'_>, unit: Option<i64>) -> TimeFormat {
    let values = numbers.values;
    let step = middle(values.windows(2).map(|w| (w[1] - w[0]).abs()).filter(|s| *s > 0.0).collect());
    let typical = middle(values.to_vec());
    // 1990-01-01 and 2100-01-01 in seconds since 1970.
    let dated = |unit_ns: i64| {
        #[expect(clippy::cast_precision_loss, reason = "a power of ten")]
        let unit = unit_ns as f64 / 1e9;
        let plausible = names::time_rank(numbers.name) > 0 || (1e-6..864_000.0).contains(&(step * unit));
        (631_152_000.0..4_102_444_800.0).contains(&(typical * unit)) && plausible
    };
    let told = numbers.told.map(|u| u.ns);
    let other_zero = named(numbers.name).iter().any(|w| matches!(w.as_str(), "gps" | "tow" | "gnss"));
    let epoch = [SECOND, 1_000_000, 1_000, 1]
        .into_iter()
        .find(|u| told.is_none_or(|told| told == *u) && dated(*u))
        .filter(|_| !other_zero);
    match (unit, epoch) {
        (Some(unit), Some(epoch)) if unit == epoch => TimeFormat::Epoch { unit_ns: epoch },
        (None, Some(epoch)) => TimeFormat::Epoch { unit_ns: epoch },
        (Some(unit), _) if unit != SECOND => TimeFormat::Elapsed { unit_ns: unit },
        _ => TimeFormat::Seconds,
    }
}

fn named(name: &str) -> Vec<String> {
    names::words(name).iter().map(|w| w.to_lowercase()).collect()
}

fn middle(mut values: Vec<f64>) -> f64 {
    values.sort_by(f64::total_cmp);
    values.get(values.len() / 2).copied().unwrap_or(0.0)
}

/// True where every cell is a date, or a date with hours, minutes and seconds, of digits alone: 20210304, 2021030410.
pub(crate) fn digits_are_dates(cells: &[&str]) -> bool {
    let is_date = |c: &&str| {
        let told = fields(c.as_bytes(), DateOrder::YearFirst).and_then(|p| p.told(c.as_bytes()));
        let year = c.get(..4).and_then(|y| y.parse::<i64>().ok()).unwrap_or(0);
        told.is_some_and(|t| t.days.is_some()) && (1850..2150).contains(&year)
    };
    let filled: Vec<&str> = cells.iter().copied().filter(|c| !c.is_empty()).collect();
    let digits = |c: &&str| matches!(c.len(), 8 | 10 | 12 | 14) && c.bytes().all(|b| b.is_ascii_digit());
    !filled.is_empty() && filled.iter().all(digits) && {
        // One wild stamp may be no date.
        let dates = filled.iter().filter(|c| is_date(c)).count();
        dates * 20 >= filled.len() * 19
    }
}

/// True where the numbers are times of day without colons: 100059 and, a second later, 100100.
fn digits_are_clocks(numbers: &Numbers<'_>, rank: u8, words: &[String]) -> bool {
    let named = words.iter().any(|w| matches!(w.as_str(), "hhmmss" | "hhmm" | "utc" | "hms" | "tod" | "uhrzeit"));
    let filled: Vec<&str> = numbers.cells.iter().copied().filter(|c| !c.is_empty()).collect();
    let six = |c: &&str| c.split('.').next().is_some_and(|whole| whole.len() == 6);
    let reads = filled.iter().all(|c| !c.contains(':') && parts::clock(c.as_bytes()).is_some());
    // Seconds that are counted come to 60 sooner or later.
    let jumps = numbers.values.windows(2).any(|w| {
        let (a, b) = (w[0] % 100.0, w[1] % 100.0);
        w[1] > w[0] && a < 60.0 && b < a
    });
    reads && numbers.unit.is_none() && filled.len() > 1 && (named || (rank > 0 && filled.iter().all(six) && jumps))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn samples_of_parts_of_a_day_tell_the_order_of_their_dates() {
        let hourly = |write: &dyn Fn(usize, usize) -> String| -> Vec<String> {
            (10..60).map(|h| write(4 + h / 24, h % 24)).collect()
        };
        let order = |cells: &[String]| order_of(&cells.iter().map(String::as_str).collect::<Vec<_>>());
        // The letters of a zone are no month.
        assert_eq!(order(&hourly(&|d, h| format!("03/{d:02}/2021 {h:02}:00 EST"))), Some(DateOrder::MonthFirst));
        assert_eq!(order(&hourly(&|d, h| format!("{d:02}/03/2021 {h:02}:00"))), Some(DateOrder::DayFirst));
        // One day says nothing.
        let day: Vec<String> = (0..20).map(|h| format!("03/04/2021 {h:02}:00")).collect();
        assert_eq!(order(&day), None);
    }
}
