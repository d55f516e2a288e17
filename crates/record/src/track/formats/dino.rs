//! DINOloket: groundwater levels of the Geological Survey of the Netherlands.

use super::{Format, Label, PLAIN, has, line_where, names_in};
use crate::track::Aside;

pub(super) const FORMAT: Format = Format {
    name: "DINO",
    about: "groundwater levels of the Netherlands, as DINOloket gives them",
    known_by: "the names `Locatie`, `Filternummer`, `Peildatum`",
    maps: "time `Peildatum`, day first; `Stand (cm t.o.v. …)` in cm; the number of the filter is not a channel",
    known: |text| header(text).is_some(),
    complete: |text, known| {
        known.header(header(text));
        known.time("Peildatum");
        known.options.day_first.get_or_insert(true);
    },
    label: |_, name| match name {
        "Filternummer" | "Locatie" => Label::aside(Aside::Id),
        _ if name.contains("(cm ") => Label::unit("cm"),
        _ => Label::default(),
    },
    ..PLAIN
};

fn header(text: &str) -> Option<usize> {
    if !has(text, "Peildatum") {
        return None;
    }
    line_where(text, |line| {
        let names = names_in(line);
        ["Locatie", "Filternummer", "Peildatum"].iter().all(|n| names.contains(n))
    })
}
