//! What names told by the rules of [`super::super::Rules::First`]: sessions that were saved then go on meaning what they
//! meant.

use super::{UNITS, nanoseconds_in, words};

fn known_unit(text: &str) -> Option<&'static str> {
    UNITS.iter().find(|(end, _)| text.eq_ignore_ascii_case(end)).map(|(_, unit)| *unit)
}

/// The unit that a name ends with; empty where it does not.
pub(crate) fn unit_of(name: &str) -> String {
    let name = name.trim();
    let bracketed =
        |open, close| name.strip_suffix(close).and_then(|n: &str| n.rsplit_once(open)).map(|(_, unit)| unit.trim());
    if let Some(unit) = bracketed('[', ']') {
        return unit.to_owned();
    }
    if let Some(unit) = bracketed('(', ')') {
        return known_unit(unit).or(unit.contains('/').then_some(unit)).unwrap_or_default().to_owned();
    }
    let end = name.rsplit_once(['_', ' ']).map(|(_, end)| end).or_else(|| words(name).get(1..)?.last().copied());
    // `igniter_c` counts igniters.
    let of_temperature = name.to_lowercase().contains("temp");
    let end = end.filter(|e| of_temperature || !(e.eq_ignore_ascii_case("c") || e.eq_ignore_ascii_case("k")));
    end.and_then(known_unit).unwrap_or_default().to_owned()
}

/// How clearly a name says that its column is a time.
pub(crate) fn time_rank(name: &str) -> u8 {
    let words: Vec<String> = words(name).iter().map(|w| w.to_lowercase()).collect();
    let Some(first) = words.first() else { return 0 };
    let is_time =
        |w: &str| matches!(w, "time" | "times" | "timestamp" | "timestamps" | "datetime" | "utc" | "时间" | "时刻");
    let without_unit = match words.split_last() {
        Some((last, rest)) if !rest.is_empty() && known_unit(last).is_some() => rest,
        _ => &words[..],
    };
    let last = without_unit.last().unwrap_or(first);
    if is_time(first) {
        4
    } else if is_time(last) || matches!(first.as_str(), "epoch" | "date" | "unix" | "unixtime") || last == "epoch" {
        3
    } else if without_unit.len() == 1 && matches!(first.as_str(), "t" | "tow" | "sec" | "secs" | "seconds" | "elapsed")
    {
        2
    } else {
        0
    }
}

/// True for `truth`, `truth_outlier`, `do_truth`, ….
pub(crate) fn is_truth(name: &str) -> bool {
    words(name).iter().any(|w| w.eq_ignore_ascii_case("truth"))
}

/// Nanoseconds in one unit of time of this name.
pub(crate) fn time_unit_ns(unit: &str) -> Option<i64> {
    nanoseconds_in(known_unit(unit).unwrap_or(unit))
}
