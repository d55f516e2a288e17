//! STK ephemerides (`.e`): seconds after an epoch, position and velocity.

use super::{Format, name};
use crate::track::LoadOptions;

pub(super) const FORMAT: Format = Format {
    name: "STK ephemeris",
    about: "ephemerides of satellites and vehicles, as STK writes them",
    known: |text| text.trim_start().starts_with("stk.v."),
    complete,
};

fn complete(_: &str, options: &mut LoadOptions) {
    name(options, &["time_s", "x", "y", "z", "vx", "vy", "vz", "ax", "ay", "az"]);
}
