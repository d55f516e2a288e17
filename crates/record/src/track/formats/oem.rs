//! CCSDS OEM: ephemerides below a block of keywords.

use super::{Format, Known, PLAIN};

pub(super) const FORMAT: Format = Format {
    name: "CCSDS OEM",
    about: "ephemerides of satellites (orbit ephemeris messages)",
    known_by: "`CCSDS_OEM_VERS` at the start",
    maps: "position and velocity below the keywords",
    known: |text| text.trim_start().starts_with("CCSDS_OEM_VERS"),
    complete,
    closed: true,
    utc: true,
    ..PLAIN
};

fn complete(_: &str, known: &mut Known) {
    known.options.comment.get_or_insert_with(|| "COMMENT".to_owned());
    known.name(["EPOCH", "X", "Y", "Z", "X_DOT", "Y_DOT", "Z_DOT", "X_DDOT", "Y_DDOT", "Z_DDOT"]);
}
