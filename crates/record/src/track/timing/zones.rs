//! Zones of clocks: a column that tells one for each row, and whether anything tells one.

use super::super::head::Head;
use super::super::time::{DateOrder, Part, offset_in, zone_in};
use super::super::{Clocks, TimeFormat, names, printable};
use super::{Timing, fields};

/// True for times of local clocks with a date, as far as their form says.
pub(super) fn are_local(format: &TimeFormat) -> bool {
    match format {
        TimeFormat::Iso | TimeFormat::YearLast { .. } | TimeFormat::Stamp { .. } => true,
        TimeFormat::Pattern(pattern) => pattern.has_date(),
        TimeFormat::Parts(parts) => {
            let absolute = |part: &Part| matches!(part, Part::GpsWeek | Part::Seconds | Part::Zone);
            parts.iter().any(|part| part.dates()) && !parts.iter().any(absolute)
        }
        _ => false,
    }
}

/// True for a cell that ends with its zone.
fn tells_zone(cell: &str) -> bool {
    let told = |order: DateOrder| fields(cell.as_bytes(), order)?.told(cell.as_bytes())?.offset;
    DateOrder::ALL.into_iter().any(|order| told(order).is_some())
}

/// Whether anything tells the zone of the clocks.
pub(super) fn clocks(head: &Head, timing: &Timing) -> Clocks {
    let in_name = |text: &str| {
        let is_utc = |word: &str| matches!(word, "UTC" | "GMT" | "UT" | "UTCG" | "utc" | "gmt" | "Utc" | "Z" | "Zulu");
        zone_in(text).is_some() || text.split(|c: char| !c.is_ascii_alphabetic()).any(is_utc)
    };
    let told = |column: usize| {
        let first = head.column(column).into_iter().find(|cell| !cell.is_empty());
        in_name(&head.names[column]) || in_name(&head.units[column]) || first.is_some_and(tells_zone)
    };
    let stated = !are_local(&timing.format) || timing.zone.is_some() || head.utc || timing.all_columns().any(told);
    if stated { Clocks::Stated } else { Clocks::Unstated }
}

/// Takes the zone of each row from a column beside the time, where there is one: `EST` in winter and `EDT` in summer.
pub(super) fn with_column(head: &Head, timing: Timing) -> Timing {
    if !are_local(&timing.format) || timing.all_columns().any(|c| head.column(c).into_iter().any(tells_zone)) {
        return timing;
    }
    let Some(zone) = (0..head.names.len()).filter(|c| !timing.has(*c)).find(|c| tells_zones(head, *c, &timing)) else {
        return timing;
    };
    let Some((columns, parts)) = parts_of(&timing) else { return timing };
    let columns: Vec<usize> = std::iter::once(zone).chain(columns).collect();
    let parts: Vec<Part> = std::iter::once(Part::Zone).chain(parts).collect();
    let mut told: Vec<&str> = head.column(zone);
    told.sort_unstable();
    told.dedup();
    let (name, told) = (printable(&head.names[zone]), printable(&told.join(", ")));
    let mut said = timing.said;
    said.push(format!(
        "clocks are those of the zone in `{name}` ({told}) in each row (--time-zone names another zone)"
    ));
    Timing { said, ..Timing::of_parts(columns, parts) }
}

/// True for a column of zones: by its name, or because names of zones stand beside the time.
fn tells_zones(head: &Head, column: usize, timing: &Timing) -> bool {
    let name = head.names[column].to_lowercase();
    let words: Vec<String> = names::words(&head.names[column]).iter().map(|word| word.to_lowercase()).collect();
    let has = |wanted: &[&str]| words.iter().any(|word| wanted.contains(&word.as_str()));
    let named = has(&["tz", "timezone", "tzone", "zeitzone"])
        || name.contains("time zone")
        || name.contains("time_zone")
        || words == ["zone"]
        || has(&["utc", "gmt"]) && has(&["offset"]);
    let beside = timing.all_columns().any(|c| c.abs_diff(column) == 1);
    let cells = head.column(column);
    let offset = |cell: &&str| offset_in(cell, named).is_some();
    let is_word = |cell: &&str| cell.len() >= 3 && cell.bytes().all(|b| b.is_ascii_uppercase());
    let utc = |cell: &&str| matches!(*cell, "UTC" | "Z" | "UT");
    // Names of time scales stand beside times, too.
    let away = || cells.iter().any(|cell| offset_in(cell, false).is_some_and(|ns| ns != 0));
    !cells.is_empty()
        && cells.iter().all(offset)
        && !cells.iter().all(utc)
        && (named || beside && cells.iter().all(is_word) && away())
}

/// A time as columns and what each of them tells.
fn parts_of(timing: &Timing) -> Option<(Vec<usize>, Vec<Part>)> {
    let order = match &timing.format {
        TimeFormat::Iso => DateOrder::YearFirst,
        TimeFormat::YearLast { day_first: true } => DateOrder::DayFirst,
        TimeFormat::YearLast { day_first: false } => DateOrder::MonthFirst,
        TimeFormat::Stamp { order } => *order,
        TimeFormat::Parts(parts) => return Some((timing.columns.clone(), parts.clone())),
        _ => return None,
    };
    Some(match timing.date_column {
        Some(date) => (vec![date, timing.column], vec![Part::Date(order), Part::Clock]),
        None => (vec![timing.column], vec![Part::Date(order)]),
    })
}
