//! IAGA-2002: geomagnetic observatories.

use super::{Format, missing};
use crate::track::LoadOptions;

pub(super) const FORMAT: Format = Format {
    name: "IAGA-2002",
    about: "records of geomagnetic observatories",
    known: |text| text.lines().take(3).any(|l| l.contains("IAGA-2002")),
    complete,
};

fn complete(_: &str, options: &mut LoadOptions) {
    missing(options, &["99999.00", "88888.00"]);
}
