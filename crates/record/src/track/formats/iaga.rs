//! IAGA-2002: geomagnetic observatories.

use super::{Format, Known, PLAIN};

pub(super) const FORMAT: Format = Format {
    name: "IAGA-2002",
    about: "records of geomagnetic observatories",
    known_by: "`IAGA-2002` in the first lines",
    maps: "date and time, 99999.00 and 88888.00 are no values",
    known: |text| text.lines().take(3).any(|l| l.contains("IAGA-2002")),
    complete,
    closed: true,
    utc: true,
    ..PLAIN
};

fn complete(_: &str, known: &mut Known) {
    known.missing(["99999.00", "88888.00"]);
}
