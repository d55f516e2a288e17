//! NDBC: buoys of the National Data Buoy Center.

use super::{Format, missing};
use crate::track::LoadOptions;

pub(super) const FORMAT: Format = Format {
    name: "NDBC",
    about: "weather and waves of buoys (standard meteorological data)",
    known: |text| {
        let first = text.lines().next().unwrap_or("").trim_start_matches('#');
        first.starts_with("YY ") && first.contains("MM DD hh") || first.starts_with("YYYY MM DD hh")
    },
    complete,
};

fn complete(_: &str, options: &mut LoadOptions) {
    missing(options, &["MM"]);
}
