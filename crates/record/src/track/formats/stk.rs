//! STK ephemerides (`.e`): seconds after an epoch, position and velocity.

use super::{Format, Known, PLAIN};

pub(super) const FORMAT: Format = Format {
    name: "STK ephemeris",
    about: "ephemerides of satellites and vehicles, as STK writes them",
    known_by: "`stk.v.` at the start",
    maps: "seconds after the epoch, position and velocity",
    known: |text| text.trim_start().starts_with("stk.v."),
    complete,
    closed: true,
    utc: true,
    ..PLAIN
};

fn complete(_: &str, known: &mut Known) {
    known.name(["time_s", "x", "y", "z", "vx", "vy", "vz", "ax", "ay", "az"]);
}
