//! `[keys]`: which keys do what. `[keys.CONTEXT]` where an action has keys in several contexts.

use std::collections::HashMap;
use std::ops::Range;

use toml::Spanned;
use toml::de::{DeTable, DeValue};

use super::{Fault, entries, unknown, wrong};
use crate::tui::action::Action;
use crate::tui::keys::{Context, Keys, hazardous, parsed};

/// Where the rows that the configuration changes stand in it, by index of the row.
type Places = HashMap<usize, Range<usize>>;

pub(super) fn read(table: &DeTable<'_>, faults: &mut Vec<Fault>) -> Keys {
    let mut keys = Keys::default();
    let mut places = Places::new();
    for (name, value, span) in entries(table) {
        let DeValue::Table(inner) = value.get_ref() else {
            bind(&mut keys, None, (name, value, span), &mut places, faults);
            continue;
        };
        match Context::ALL.into_iter().find(|c| c.word() == name) {
            Some(context) => {
                entries(inner).for_each(|entry| bind(&mut keys, Some(context), entry, &mut places, faults));
            }
            None => faults.push(unknown(&span, name, "context", &Context::ALL.map(Context::word))),
        }
    }
    check(&keys, &places, faults);
    keys
}

/// Gives the row of an action its keys.
fn bind(
    keys: &mut Keys,
    context: Option<Context>,
    (name, value, span): super::Entry<'_>,
    places: &mut Places,
    faults: &mut Vec<Fault>,
) {
    let within = |c: Context| context.is_none_or(|wanted| c == wanted);
    let rows: Vec<(usize, Context, Action)> = keys
        .rows()
        .iter()
        .map(|b| (b.row.context, b.row.action))
        .enumerate()
        .map(|(i, (c, a))| (i, c, a))
        .filter(|(_, c, _)| within(*c))
        .collect();
    let fitting: Vec<_> = rows.iter().filter(|(_, _, action)| action.name() == name).collect();
    let (index, action) = match fitting.as_slice() {
        [(index, _, action)] => (*index, *action),
        [] => {
            let names: Vec<String> = rows.iter().map(|(_, _, action)| action.name()).collect();
            let names: Vec<&str> = names.iter().map(String::as_str).collect();
            let kind = context.map_or("action".to_owned(), |c| format!("action in {}", c.word()));
            return faults.push(unknown(&span, name, &kind, &names));
        }
        several => {
            let words: Vec<&str> = several.iter().map(|(_, c, _)| c.word()).collect();
            let tables: Vec<String> = words.iter().map(|w| format!("[keys.{w}]")).collect();
            let what = format!("{name} has keys in {}", words.join(" and "));
            return faults.push(Fault::new(&span, what, format!("put it under {}", tables.join(" or "))));
        }
    };
    places.insert(index, span);
    let mut bound = Vec::new();
    for (text, at) in texts(name, value, faults) {
        match parsed(&text) {
            Err(what) => faults.push(Fault::new(&at, what, format!("give {name} another key"))),
            Ok(key) if hazardous(&key) && action.changes_result() => {
                let what = format!("{key} can be pressed by a torn escape sequence");
                let help = format!("{name} changes what comes out: give it a lower-case letter, space or a Ctrl key");
                faults.push(Fault::new(&at, what, help));
            }
            Ok(key) => bound.push(key),
        }
    }
    if let Some(row) = keys.rows_mut().nth(index) {
        row.keys = bound;
    }
}

/// The texts of one key or a list of keys.
fn texts(name: &str, value: &Spanned<DeValue<'_>>, faults: &mut Vec<Fault>) -> Vec<(String, Range<usize>)> {
    let wanted = "a key or a list of keys: \"n\", [\"n\", \"ctrl-n\"], or [] for none";
    let mut found = Vec::new();
    let mut one = |value: &Spanned<DeValue<'_>>| match value.get_ref() {
        DeValue::String(text) => found.push((text.to_string(), value.span())),
        _ => faults.push(wrong(value, name, wanted)),
    };
    match value.get_ref() {
        DeValue::Array(list) => list.iter().for_each(one),
        _ => one(value),
    }
    found
}

/// No key means two things at one place, none hides longer ones, and one key quits.
fn check(keys: &Keys, places: &Places, faults: &mut Vec<Fault>) {
    let rows = keys.rows();
    let together = |a: Context, b: Context| a == b || (!a.is_own() && !b.is_own());
    // A fault stands where the configuration does; the table by itself has none, as its tests see to.
    // Of two that are configured, the later one is at fault.
    let place = |i, j| [places.get(&i), places.get(&j)].into_iter().flatten().max_by_key(|span| span.start).cloned();
    for (i, a) in rows.iter().enumerate() {
        for (j, b) in rows.iter().enumerate() {
            let Some(span) = place(i, j) else { continue };
            let (first, second) = (a.row.action.name(), b.row.action.name());
            for key in &a.keys {
                if i < j && together(a.row.context, b.row.context) && b.keys.contains(key) {
                    let what = format!("{key} means {first} and {second}");
                    faults.push(Fault::new(&span, what, "give one of them another key; [] takes its keys away"));
                }
                let longer = b.keys.iter().find(|k| k.strip_prefix(key.as_str()).is_some_and(|k| k.starts_with(' ')));
                if let Some(longer) = longer {
                    let what = format!("{key} starts other keys ({longer}) and cannot mean {first}");
                    faults.push(Fault::new(&span, what, "give one of them another key"));
                }
            }
        }
    }
    let quit = rows.iter().position(|b| b.row.action == Action::Quit);
    if let Some((index, span)) = quit.and_then(|i| places.get(&i).map(|span| (i, span)))
        && rows[index].keys.is_empty()
    {
        faults.push(Fault::new(span, "no key would quit", "give quit a key"));
    }
}
