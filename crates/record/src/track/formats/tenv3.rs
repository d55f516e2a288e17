//! tenv3: daily positions of the Nevada Geodetic Laboratory.

use super::{Format, Known, Label, PLAIN};
use crate::track::{Aside, Delimiter};

pub(super) const FORMAT: Format = Format {
    name: "tenv3",
    about: "daily positions of GNSS stations of the Nevada Geodetic Laboratory",
    known_by: "the names `site YYMMMDD yyyy.yyyy`",
    maps: "time `YYMMMDD`; units from the names; site, week, day and the whole metres `e0`, `n0`, `u0` are no channels",
    known: |text| {
        let words: Vec<&str> = text.lines().next().unwrap_or("").split_whitespace().take(3).collect();
        words == ["site", "YYMMMDD", "yyyy.yyyy"]
    },
    complete: |_, known: &mut Known| {
        known.options.delimiter.get_or_insert(Delimiter::Blanks);
        known.header(Some(0));
        known.time("YYMMMDD");
    },
    label: |_, name| match name.trim_start_matches('_') {
        "site" => Label::aside(Aside::Id),
        "yyyy.yyyy" | "MJD" | "week" | "d" => Label::aside(Aside::Time),
        "reflon" => Label::aside(Aside::Constant),
        "e0(m)" | "n0(m)" | "u0(m)" => Label { unit: Some("m".to_owned()), aside: Some(Aside::Constant) },
        "corr_en" | "corr_eu" | "corr_nu" => Label::unit(""),
        _ => Label::default(),
    },
    utc: true,
    ..PLAIN
};
