//! DWD: station data of the German weather service.

use super::{Format, Known, PLAIN};

pub(super) const FORMAT: Format = Format {
    name: "DWD",
    about: "station data of the German weather service (CDC)",
    known_by: "the names `STATIONS_ID;MESS_DATUM`",
    maps: "time `MESS_DATUM`, -999 is no value",
    known: |text| text.lines().next().is_some_and(|l| l.starts_with("STATIONS_ID;MESS_DATUM")),
    complete,
    utc: true,
    ..PLAIN
};

fn complete(_: &str, known: &mut Known) {
    known.missing(["-999"]);
}
