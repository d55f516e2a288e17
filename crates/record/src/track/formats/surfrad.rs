//! SURFRAD: surface radiation, minute by minute.

use super::{Format, missing, name};
use crate::track::LoadOptions;

pub(super) const FORMAT: Format = Format {
    name: "SURFRAD",
    about: "surface radiation, as NOAA distributes it",
    known: |text| {
        let mut lines = text.lines();
        let second = lines.nth(1).unwrap_or("");
        second.contains("m version") && second.split_whitespace().count() >= 5
    },
    complete,
};

fn complete(_: &str, options: &mut LoadOptions) {
    name(
        options,
        &["year", "doy", "month", "day", "hour", "minute", "decimal_hour", "zenith_deg", "dw_solar", "qc_dw_solar"],
    );
    missing(options, &["-9999.9"]);
}
