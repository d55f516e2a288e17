//! CCSDS OEM: ephemerides below a block of keywords.

use super::{Format, name};
use crate::track::LoadOptions;

pub(super) const FORMAT: Format = Format {
    name: "CCSDS OEM",
    about: "ephemerides of satellites (orbit ephemeris messages)",
    known: |text| text.trim_start().starts_with("CCSDS_OEM_VERS"),
    complete,
};

fn complete(_: &str, options: &mut LoadOptions) {
    options.comment.get_or_insert_with(|| "COMMENT".to_owned());
    name(options, &["EPOCH", "X", "Y", "Z", "X_DOT", "Y_DOT", "Z_DOT", "X_DDOT", "Y_DDOT", "Z_DDOT"]);
}
