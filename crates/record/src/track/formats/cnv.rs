//! Sea-Bird CNV: names and units in comments, numbers in columns of a fixed width.

use super::{Format, Known, Label, PLAIN};
use crate::track::calendar::{DAY, Date, SECOND};
use crate::track::time::{DateOrder, fields};
use crate::track::{Aside, Zero};

pub(super) const FORMAT: Format = Format {
    name: "Sea-Bird CNV",
    about: "profiles and moorings of Sea-Bird instruments",
    known_by: "`* Sea-Bird` at the start, or `# name 0 =` above `*END*`",
    maps: "names and units from `# name N`; time `timeJ` (days of the year of `start_time`), `timeK` and `timeQ` (seconds since \
           2000), `timeN` and `timeY` (since 1970), else seconds, minutes or hours elapsed; `bad_flag` means missing, `flag` is \
           not a channel",
    known: |text| text.starts_with("* Sea-Bird") || (text.contains("\n# name 0 = ") && text.contains("*END*")),
    complete,
    label,
    closed: true,
    ..PLAIN
};

fn complete(text: &str, known: &mut Known) {
    let head = text.split("*END*").next().unwrap_or(text);
    let value = |line: &str, key: &str| line.strip_prefix(key)?.split_once('=').map(|(_, v)| v.trim().to_owned());
    let names: Vec<String> = head.lines().filter_map(|l| value(l, "# name ")).collect();
    known.name(names.iter().map(|n| n.split(':').next().unwrap_or("").trim()));
    known.options.comment.get_or_insert_with(|| "*".to_owned());
    if let Some(bad) = head.lines().find_map(|l| value(l, "# bad_flag")) {
        known.missing([bad.as_str()]);
    }
    let start = head.lines().find_map(|l| value(l, "# start_time")).and_then(|text| year(&text));
    if let Some((name, counted)) = known.options.names.iter().find_map(|n| Some((n.clone(), counted(n, start)?))) {
        known.time(&name);
        known.counted = Some(counted);
    }
}

/// What a time of this name counts, in nanoseconds, and from when.
fn counted(name: &str, start: Option<i64>) -> Option<(i64, Zero)> {
    let midnight = |year, month, day| Date { year, month, day }.days().map(|d| Zero::At(d * (DAY / SECOND)));
    match name {
        // The first of January is day 1.
        "timeJ" | "timeJV2" | "timeSCP" => Some((DAY, midnight(start? - 1, 12, 31)?)),
        "timeK" | "timeQ" => Some((SECOND, midnight(2000, 1, 1)?)),
        "timeN" | "timeY" => Some((SECOND, Zero::At(0))),
        _ => None,
    }
}

/// The year in `Mar 04 2021 10:00:00 [Instrument's time stamp]`.
fn year(text: &str) -> Option<i64> {
    let text = text.split('[').next()?.trim();
    let days = fields(text.as_bytes(), DateOrder::MonthFirst)?.told(text.as_bytes())?.days?;
    Some(Date::of_days(days).year)
}

/// The unit in the brackets of `# name 1 = t090C: Temperature [ITS-90, deg C]`.
fn label(text: &str, name: &str) -> Label {
    if name == "flag" {
        return Label::aside(Aside::Flag);
    }
    let of = |line: &str| {
        let (_, rest) = line.strip_prefix("# name ")?.split_once('=')?;
        let (short, long) = rest.split_once(':')?;
        let unit = long.trim().strip_suffix(']')?.rsplit_once('[')?.1;
        (short.trim() == name).then(|| unit.rsplit(',').next().unwrap_or(unit).trim().to_owned())
    };
    Label { unit: text.lines().find_map(of), aside: None }
}
