//! WISKI: time series that the services of KISTERS (KiWIS) give as CSV. ZRXP has a file of its own.

use super::{Format, Label, PLAIN, line_where, names_in};
use crate::track::Aside;

pub(super) const FORMAT: Format = Format {
    name: "WISKI (KiWIS CSV)",
    about: "time series of WISKI, as its web services give them",
    known_by: "comments that begin with `#ts_id`, `#station_` or `#rows`, the last of which is `#Timestamp` and the names",
    maps: "time `Timestamp`; the unit from `#ts_unitsymbol`; quality codes are not channels",
    known: |text| {
        let keyed = |l: &str| ["#ts_", "#station_", "#rows", "#parametertype"].iter().any(|k| l.starts_with(k));
        text.lines().take(40).any(keyed) && header(text).is_some()
    },
    complete: |text, known| known.header(header(text)),
    label,
    ..PLAIN
};

fn header(text: &str) -> Option<usize> {
    line_where(text, |l| l.to_lowercase().starts_with("#timestamp"))
}

fn label(text: &str, name: &str) -> Label {
    let lower = name.to_lowercase();
    if ["quality", "status", "interpolation", "remark"].iter().any(|w| lower.contains(w)) {
        return Label { unit: Some(String::new()), aside: Some(Aside::Quality) };
    }
    if lower != "value" {
        return Label::default();
    }
    let told = |line: &str| {
        let cells = names_in(line);
        let key = matches!(*cells.first()?, "#ts_unitsymbol" | "#ts_unitname");
        cells.get(1).filter(|_| key).map(|unit| (*unit).to_owned())
    };
    Label { unit: text.lines().find_map(told), aside: None }
}
