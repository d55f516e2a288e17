//! NDBC: buoys of the National Data Buoy Center.

use super::{Format, Known, PLAIN};

pub(super) const FORMAT: Format = Format {
    name: "NDBC",
    about: "weather and waves of buoys (standard meteorological data)",
    known_by: "the names `#YY MM DD hh` (or `YYYY MM DD hh`)",
    maps: "year to minute are the time, MM is no value",
    known: |text| {
        let first = text.lines().next().unwrap_or("").trim_start_matches('#');
        first.starts_with("YY ") && first.contains("MM DD hh") || first.starts_with("YYYY MM DD hh")
    },
    complete,
    utc: true,
    ..PLAIN
};

fn complete(_: &str, known: &mut Known) {
    known.missing(["MM"]);
}
