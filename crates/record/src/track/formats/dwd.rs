//! DWD: station data of the German weather service.

use super::{Format, missing};
use crate::track::LoadOptions;

pub(super) const FORMAT: Format = Format {
    name: "DWD",
    about: "station data of the German weather service (CDC)",
    known: |text| text.lines().next().is_some_and(|l| l.starts_with("STATIONS_ID;MESS_DATUM")),
    complete,
};

fn complete(_: &str, options: &mut LoadOptions) {
    missing(options, &["-999"]);
}
