//! `[theme]`: the base, and colours for single roles.

use ratatui::style::Color;
use toml::Spanned;
use toml::de::{DeTable, DeValue};

use super::{Fault, entries, unknown, wrong};
use crate::tui::theme::{Base, Paints, ROLES};

pub(super) fn read(table: &DeTable<'_>, faults: &mut Vec<Fault>) -> Paints {
    let mut paints = Paints::default();
    for (name, value, span) in entries(table) {
        if name == "base" {
            paints.base = base(value, faults);
        } else if let Some(role) = ROLES.iter().find(|role| role.name == name) {
            if let Some(color) = color(name, value, faults) {
                paints.roles.push((role.name, color));
            }
        } else {
            let names: Vec<&str> = std::iter::once("base").chain(ROLES.iter().map(|role| role.name)).collect();
            faults.push(unknown(&span, name, "role", &names));
        }
    }
    paints
}

fn base(value: &Spanned<DeValue<'_>>, faults: &mut Vec<Fault>) -> Option<Base> {
    let names = Base::ALL.map(Base::word);
    let Some(word) = value.get_ref().as_str() else {
        faults.push(wrong(value, "base", &names.join(", ")));
        return None;
    };
    let found = Base::ALL.into_iter().find(|b| b.word() == word);
    if found.is_none() {
        faults.push(unknown(&value.span(), word, "base", &names));
    }
    found
}

/// A colour: a name, a number of the palette of 256, or `#rrggbb`.
fn color(name: &str, value: &Spanned<DeValue<'_>>, faults: &mut Vec<Fault>) -> Option<Color> {
    const WANTED: &str = "a name (\"bright-red\"), a number from 0 to 255, or \"#rrggbb\"";
    let text = match value.get_ref() {
        DeValue::String(text) => text.to_string(),
        DeValue::Integer(number) => number.to_string(),
        _ => {
            faults.push(wrong(value, name, WANTED));
            return None;
        }
    };
    // Names of digits are numbers of the palette.
    let found = text.parse::<Color>().ok();
    if found.is_none() {
        faults.push(Fault::new(&value.span(), format!("{text}: no such colour"), format!("{name} takes {WANTED}")));
    }
    found
}
