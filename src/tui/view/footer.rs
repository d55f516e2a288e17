//! The last line: the keys that matter now.

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::text::{Line, Span};
use ratatui::widgets::Widget;

use super::super::action::Action;
use super::super::keys::{Bound, Context, shown};
use super::super::model::{Dialog, ExportForm, LoaderForm, Model, Overlay, Prompt, PromptKind};
use super::clear;

pub(super) fn draw(model: &Model, area: Rect, buffer: &mut Buffer) {
    clear(area, buffer);
    let theme = &model.theme;
    let mut left: Vec<(String, &str)> = Vec::new();
    if let Some(first) = model.prefix {
        let keys = model.keys.rows().iter().flat_map(|b| b.keys.iter().map(move |k| (k, b)));
        let after = |k: &str| k.strip_prefix(first)?.strip_prefix(' ').map(|rest| format!("{first}{}", shown(rest)));
        left.extend(keys.filter_map(|(k, b)| after(k).map(|key| (key, in_few_words(b.row.help)))));
    } else {
        left.extend(items(model));
    }
    // Help and quit keep their place at the right, whatever is cut.
    let right = match model.overlay {
        // After a first key, these would be its second.
        Overlay::None if model.prefix.is_some() => Vec::new(),
        Overlay::None => [(Action::Command, ""), (Action::Help, "help"), (Action::Quit, "quit")]
            .into_iter()
            .filter_map(|(action, word)| model.keys.key_of(action).map(|key| (key, word)))
            .collect(),
        _ => Vec::new(),
    };
    let width = |(key, word): &(String, &str)| key.chars().count() + word.chars().count() + 3;
    let mut room = usize::from(area.width).saturating_sub(1 + right.iter().map(width).sum::<usize>());
    let mut spans = vec![Span::raw(" ")];
    for item in left {
        if width(&item) > room {
            break;
        }
        room -= width(&item);
        push(model, &mut spans, item);
    }
    spans.push(Span::raw(" ".repeat(room)));
    right.into_iter().for_each(|item| push(model, &mut spans, item));
    Line::from(spans).style(theme.text).render(area, buffer);
}

fn push(model: &Model, spans: &mut Vec<Span<'static>>, (key, word): (String, &str)) {
    spans.push(Span::styled(key, model.theme.key));
    spans.push(Span::styled(if word.is_empty() { " ".to_owned() } else { format!(" {word}  ") }, model.theme.dim));
}

/// What a key after a prefix does, up to what all of them share.
fn in_few_words(help: &'static str) -> &'static str {
    let end = [" flags", " decisions", " sample", " ("].iter().filter_map(|w| help.find(w)).min();
    &help[..end.unwrap_or(help.len())]
}

/// Keys and their words, most wanted first.
fn items(model: &Model) -> Vec<(String, &'static str)> {
    if let Some(items) = overlay_items(&model.overlay) {
        return items;
    }
    let own = Context::of(model.focus);
    let of = |context: Context| model.keys.of(context).filter(|b| !b.row.short.is_empty() && !b.keys.is_empty());
    let item = |b: &Bound| (together(model, b), b.row.short);
    let mut items: Vec<(String, &'static str)> = own.into_iter().flat_map(of).map(item).collect();
    if own != Some(Context::Queue) || !items.is_empty() {
        let more = [Context::Review, Context::Everywhere, Context::View].into_iter().flat_map(of).map(item);
        items.extend(more.filter(|(_, word)| !matches!(*word, "command" | "help" | "quit")));
    }
    let mut seen = Vec::new();
    items.retain(|(_, word)| {
        let new = !seen.contains(word);
        seen.push(*word);
        new
    });
    items
}

/// The key of a row; pairs that belong together are shown together.
fn together(model: &Model, bound: &Bound) -> String {
    let key = bound.keys.first().map(|k| shown(k)).unwrap_or_default();
    let other = match bound.row.action {
        Action::NextInQueue => Action::PreviousInQueue,
        Action::NextKnob => Action::PreviousKnob,
        Action::StepDown => Action::StepUp,
        Action::StepUp => Action::StepDown,
        Action::ZoomIn => Action::ZoomOut,
        _ => return key,
    };
    let other = model.keys.of(bound.row.context).find(|b| b.row.action == other).and_then(|b| b.keys.first());
    match other.map(|k| shown(k)) {
        Some(other) if "←→↑↓".contains(&key) && "←→↑↓".contains(&other) => {
            if "→↓".contains(&key) {
                format!("{other}{key}")
            } else {
                format!("{key}{other}")
            }
        }
        Some(other) => format!("{key} {other}"),
        None => key,
    }
}

fn overlay_items(overlay: &Overlay) -> Option<Vec<(String, &'static str)>> {
    let items: &[(&str, &'static str)] = match overlay {
        Overlay::None => return None,
        Overlay::Help(..) => &[("type", "to filter"), ("↑↓", "scroll"), ("Esc", "close")],
        Overlay::Picker(_) => &[("type", "to filter"), ("↑↓", "choose"), ("Enter", "take it"), ("Esc", "leave it")],
        Overlay::Overview(overview) if overview.filtering => {
            &[("type", "to filter"), ("Enter", "keep it"), ("Esc", "show all")]
        }
        Overlay::Overview(_) => &[
            ("Enter", "open"),
            ("/", "filter"),
            ("s", "sort"),
            ("Space", "select"),
            ("a", "accept"),
            ("=", "settings"),
            ("Esc", "back"),
        ],
        Overlay::Journal(_) => &[("↑↓", "choose"), ("Enter", "go there"), ("Esc", "close")],
        Overlay::Prompt(Prompt { kind: PromptKind::Note, .. }) => {
            &[("↑↓", "reason"), ("type", "in your words"), ("Enter", "keep it"), ("Esc", "leave it")]
        }
        Overlay::Prompt(Prompt { kind: PromptKind::Command, .. }) => {
            &[("Enter", "do it"), ("↑↓", "choose"), ("Tab", "complete"), ("Esc", "leave it")]
        }
        Overlay::Prompt(Prompt { kind: PromptKind::SaveAs, .. }) => {
            &[("Enter", "save"), ("Tab", "complete"), ("Esc", "leave it")]
        }
        Overlay::Prompt(_) => &[("Enter", "do it"), ("Esc", "leave it")],
        Overlay::CommandLine(..) => &[("any key", "goes back")],
        Overlay::Recover(found) if found.first().is_some_and(|f| f.missing.is_some()) => {
            &[("d", "discard it"), ("Esc", "decide later")]
        }
        Overlay::Recover(_) => &[("r", "restore it"), ("d", "discard it"), ("Esc", "decide later")],
        Overlay::Merge(_) => &[("h", "keep what is here"), ("t", "take what is there"), ("Esc", "take nothing in")],
        Overlay::Files(dialog) => of_dialog(dialog),
        Overlay::ConfirmQuit => &[("w", "save and quit"), ("d", "discard and quit"), ("Esc", "stay")],
    };
    Some(items.iter().map(|(k, w)| ((*k).to_owned(), *w)).collect())
}

fn of_dialog(dialog: &Dialog) -> &'static [(&'static str, &'static str)] {
    match dialog {
        Dialog::Browser(_) => &[
            ("Enter", "open"),
            ("type", "to filter"),
            ("↑↓", "choose"),
            ("Backspace", "up"),
            ("Tab", "loader"),
            ("Esc", "leave"),
        ],
        Dialog::Loader(LoaderForm { typing: Some(_), .. }) | Dialog::Export(ExportForm { typing: Some(_), .. }) => {
            &[("Enter", "take it"), ("Esc", "leave it")]
        }
        Dialog::Loader(_) => &[
            ("Enter", "load"),
            ("↑↓", "choose"),
            ("←→", "change"),
            ("e", "type"),
            ("Backspace", "recognise"),
            ("Esc", "leave"),
        ],
        Dialog::Export(_) => {
            &[("Enter", "write"), ("↑↓", "choose"), ("Space", "on or off"), ("e", "edit the name"), ("Esc", "leave")]
        }
        Dialog::Waiting(_) => &[("Esc", "leave it")],
        Dialog::Unsaved(_) => &[("w", "save, then open"), ("d", "discard, then open"), ("Esc", "stay")],
        Dialog::Over(_) => &[("o", "overwrite"), ("Esc", "leave it")],
    }
}
