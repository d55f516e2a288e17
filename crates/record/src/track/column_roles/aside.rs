//! Columns of numbers that are no measurement: other times, the number of the row, ids, flags.

use super::super::head::Head;
use super::super::timing::{Form, Timing};
use super::super::{Aside, ColumnKind, names};

/// With fewer rows, values alone tell nothing.
const LEAST: usize = 20;

/// What a column of numbers is by its name and the sampled rows, where it is no measurement.
pub(super) fn by_sample(head: &Head, column: usize, timing: Option<&Timing>) -> Option<Aside> {
    let name = &head.names[column];
    let cells: Vec<&str> = head.column(column).into_iter().filter(|c| !head.reading.is_marker(c.as_bytes())).collect();
    let values: Vec<f64> = cells.iter().filter_map(|c| head.reading.number(c.as_bytes())).collect();
    if values.len() < cells.len() || values.is_empty() || names::is_truth(name) {
        return None;
    }
    let whole = values.iter().all(|v| v.fract() == 0.0);
    let steps = || values.windows(2).map(|w| w[1] - w[0]);
    let rising = steps().filter(|s| *s > 0.0).count();
    let falling = steps().filter(|s| *s < 0.0).count();
    let one_way = rising.max(falling) > 0 && rising.min(falling) * 10 <= rising.max(falling);
    let distinct = distinct(&values);
    if is_id_column(name) && (whole && distinct * 2 <= values.len().max(2) || distinct == 1) {
        return Some(Aside::Id);
    }
    if is_time_like(head, column, name, one_way, timing) {
        return Some(Aside::Time);
    }
    if whole && timing.is_some() && rising > 0 && falling == 0 && are_moments(&values) {
        return Some(Aside::Time);
    }
    if whole && is_date_part(name, &values) && timing.is_some() {
        return Some(Aside::Time);
    }
    let decimals = cells.iter().any(|c| c.contains(['.', ',']));
    if whole && one_way && counts(name) && !decimals {
        return Some(Aside::Counter);
    }
    if values.len() >= LEAST && whole && !decimals && steps().all(|s| s == 1.0) {
        return Some(Aside::Index);
    }
    let few = if distinct <= 2 && is_flag(name) { Aside::Flag } else { Aside::Quality };
    (whole && distinct <= 12 && is_quality(name) && !decimals).then_some(few)
}

/// True for whole numbers that are milliseconds, microseconds or nanoseconds since 1970, of 2000 to 2100: no quantity
/// comes to them.
fn are_moments(values: &[f64]) -> bool {
    let dated = |units: f64| {
        let within = |value: &f64| (946_684_800.0 * units..4_102_444_800.0 * units).contains(value);
        values.iter().all(within)
    };
    values.len() >= LEAST && [1e3, 1e6, 1e9].into_iter().any(dated)
}

/// Another time than the one of the rows.
fn is_time_like(head: &Head, column: usize, name: &str, one_way: bool, timing: Option<&Timing>) -> bool {
    let Some(timing) = timing else { return false };
    let rank = names::time_rank(name);
    let cells = head.column(column);
    let dated = super::super::time::digits_are_dates(&cells) && one_way;
    let of_year = ["doy", "jday", "yday", "dayofyear"].iter().any(|w| name.eq_ignore_ascii_case(w));
    let named = of_year || rank >= 3 || (rank == 2 && column != timing.column) || names::is_gps_time(name);
    dated || (named && one_way) || matches!(Form::of(head, column, None), Some(f) if f.is_dated())
}

/// What a column is by all of its values.
pub(super) fn by_values(name: &str, values: &[f64]) -> Option<Aside> {
    let mut seen: Vec<f64> = Vec::new();
    let mut count = 0;
    for value in values.iter().filter(|v| !v.is_nan()) {
        count += 1;
        if !seen.iter().any(|s| s.to_bits() == value.to_bits()) {
            seen.push(*value);
            if seen.len() > 2 {
                return None;
            }
        }
    }
    if count < LEAST {
        // A setting that stands in the first row alone.
        return (values.len() >= LEAST && seen.len() == 1 && count * 10 <= values.len()).then_some(Aside::Constant);
    }
    match seen.as_slice() {
        [_] => Some(Aside::Constant),
        [a, b] => {
            let bits = (*a == 0.0 || *b == 0.0) && (*a == 1.0 || *b == 1.0);
            let few = a.fract() == 0.0 && b.fract() == 0.0 && is_flag(name);
            (bits || few).then_some(Aside::Flag)
        }
        _ => None,
    }
}

/// Where every column of numbers would be left aside, the first that are no times stay channels.
pub(super) fn keep_one_channel(kinds: &mut [ColumnKind], is_time: &impl Fn(usize) -> bool) {
    let numbers = kinds.iter().enumerate().any(|(c, k)| *k == ColumnKind::Number && !is_time(c));
    if numbers {
        return;
    }
    let order = [Aside::Index, Aside::Counter, Aside::Quality, Aside::Flag, Aside::Id, Aside::Time];
    for aside in order {
        let found = kinds.iter_mut().filter(|k| **k == ColumnKind::Aside(aside));
        let mut any = false;
        found.for_each(|k| {
            *k = ColumnKind::Number;
            any = true;
        });
        if any {
            return;
        }
    }
}

/// Where all columns were left aside by their values, the constant ones and flags are channels after all, as far as they
/// were read into one of `slots`.
pub(crate) fn release(kinds: &mut [ColumnKind], slots: &[Option<usize>]) {
    if kinds.contains(&ColumnKind::Number) {
        return;
    }
    for aside in [Aside::Flag, Aside::Constant] {
        let mut any = false;
        let read = kinds.iter_mut().zip(slots).filter(|(k, slot)| **k == ColumnKind::Aside(aside) && slot.is_some());
        read.for_each(|(k, _)| {
            *k = ColumnKind::Number;
            any = true;
        });
        if any {
            return;
        }
    }
}

/// True for the name of a column that tells what a row is about.
pub(crate) fn is_id_column(name: &str) -> bool {
    names::is_id(name) || names::is_id_name(name)
}

fn distinct(values: &[f64]) -> usize {
    let mut bits: Vec<u64> = values.iter().map(|v| v.to_bits()).collect();
    bits.sort_unstable();
    bits.dedup();
    bits.len()
}

fn has_word(name: &str, wanted: &[&str]) -> bool {
    names::words(name).iter().any(|w| wanted.iter().any(|x| w.eq_ignore_ascii_case(x)))
}

/// Names of numbers that count up.
fn counts(name: &str) -> bool {
    let alone =
        ["n", "i", "no", "nr", "num", "row", "line", "index", "idx", "obs", "scan", "sample", "samples", "rn", "id"];
    has_word(
        name,
        &[
            "record",
            "recnum",
            "recno",
            "seq",
            "sequence",
            "counter",
            "frame",
            "framecount",
            "packet",
            "msgid",
            "epochno",
            "serial",
            "unnamed",
        ],
    ) || (names::words(name).len() == 1 && has_word(name, &alone))
        || name == "#"
}

fn is_flag(name: &str) -> bool {
    has_word(
        name,
        &[
            "flag",
            "flags",
            "outlier",
            "anomaly",
            "valid",
            "invalid",
            "ok",
            "bad",
            "good",
            "label",
            "wild",
            "changepoint",
            "alarm",
            "state",
        ],
    )
}

fn is_quality(name: &str) -> bool {
    is_flag(name)
        || has_word(
            name,
            &[
                "quality",
                "qc",
                "qa",
                "qf",
                "qn",
                "qual",
                "status",
                "fix",
                "qcflag",
                "qflag",
                "eflag",
                "mode",
                "code",
                "güte",
                "qualität",
                "qualitätsbyte",
                "qualité",
                "calidad",
                "qualidade",
                "qualità",
                "kwaliteit",
                "jakości",
                "jakość",
                "kvalitet",
            ],
        )
        || name == "Q"
}

/// A year, a month, an hour, …, as far as its values fit.
fn is_date_part(name: &str, values: &[f64]) -> bool {
    let within = |low: f64, high: f64| values.iter().all(|v| (low..=high).contains(v));
    let any = |wanted: &[&str]| {
        wanted.iter().any(|w| names::words(name).len() == 1 && name.trim_start_matches('#').eq_ignore_ascii_case(w))
    };
    any(&["year", "yr", "yyyy", "yy", "jahr"]) && (within(1850.0, 2200.0) || within(0.0, 99.0))
        || any(&["month", "mo", "monat"]) && within(1.0, 12.0)
        || any(&["day", "dy", "tag", "dom"]) && within(1.0, 31.0)
        || any(&["doy", "jday", "yday"]) && within(0.0, 367.0)
        || any(&["hour", "hr", "hh", "stunde"]) && within(0.0, 24.0)
        || any(&["minute", "mn", "mins"]) && within(0.0, 60.0)
        || any(&["weekday", "dow", "d"]) && within(0.0, 7.0)
        || names::words(name).iter().any(|w| w.eq_ignore_ascii_case("week")) && within(0.0, 5000.0)
}
