//! SURFRAD: surface radiation, minute by minute.

use super::{Format, Known, PLAIN};

pub(super) const FORMAT: Format = Format {
    name: "SURFRAD",
    about: "surface radiation, as NOAA distributes it",
    known_by: "`m version` in the second line",
    maps: "year to minute are the time, -9999.9 is no value",
    known: |text| {
        let mut lines = text.lines();
        let second = lines.nth(1).unwrap_or("");
        second.contains("m version") && second.split_whitespace().count() >= 5
    },
    complete,
    closed: true,
    utc: true,
    ..PLAIN
};

fn complete(_: &str, known: &mut Known) {
    known.name([
        "year",
        "doy",
        "month",
        "day",
        "hour",
        "minute",
        "decimal_hour",
        "zenith_deg",
        "dw_solar",
        "qc_dw_solar",
    ]);
    known.missing(["-9999.9"]);
}
