//! The last line: the keys that matter now.

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::text::{Line, Span};
use ratatui::widgets::Widget;

use super::super::action::Panel;
use super::super::keys::{Binding, Context, KEYMAP, shown};
use super::super::model::{Model, Overlay, Prompt, PromptKind};
use super::clear;

pub(super) fn draw(model: &Model, area: Rect, buffer: &mut Buffer) {
    clear(area, buffer);
    let theme = &model.theme;
    let mut left: Vec<(String, &str)> = Vec::new();
    if model.prefix.is_some() {
        left.extend(
            KEYMAP
                .iter()
                .flat_map(|b| b.keys.iter().map(move |k| (k, b)))
                .filter_map(|(k, b)| k.strip_prefix("g ").map(|rest| (format!("g{rest}"), in_few_words(b.help)))),
        );
    } else {
        left.extend(items(model));
    }
    // Help and quit keep their place at the right, whatever is cut.
    let right = match model.overlay {
        // After a first key, these would be its second.
        Overlay::None if model.prefix.is_some() => Vec::new(),
        Overlay::None => vec![(":".to_owned(), ""), ("?".to_owned(), "help"), ("q".to_owned(), "quit")],
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
    let own = match model.focus {
        Panel::Parameters => Some(Context::Parameters),
        Panel::Queue => Some(Context::Queue),
        Panel::Trace | Panel::Residual | Panel::Card => None,
    };
    let of = |context: Context| KEYMAP.iter().filter(move |b| b.context == context && !b.short.is_empty());
    let item = |b: &'static Binding| {
        let key = match b.short {
            // Pairs that belong together are shown together.
            "next" if b.context == Context::Queue => "↑↓".to_owned(),
            "choose" => "↑↓".to_owned(),
            "step" if b.context == Context::Parameters => "←→".to_owned(),
            "step" => ", .".to_owned(),
            "zoom" => "+ -".to_owned(),
            _ => shown(b.keys[0]),
        };
        (key, b.short)
    };
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

fn overlay_items(overlay: &Overlay) -> Option<Vec<(String, &'static str)>> {
    let items: &[(&str, &'static str)] = match overlay {
        Overlay::None => return None,
        Overlay::Help(..) => &[("type", "to filter"), ("↑↓", "scroll"), ("Esc", "close")],
        Overlay::Picker(_) => &[("type", "to filter"), ("↑↓", "choose"), ("Enter", "take it"), ("Esc", "leave it")],
        Overlay::Journal(_) => &[("↑↓", "choose"), ("Enter", "go there"), ("Esc", "close")],
        Overlay::Prompt(Prompt { kind: PromptKind::Note, .. }) => {
            &[("↑↓", "reason"), ("type", "in your words"), ("Enter", "keep it"), ("Esc", "leave it")]
        }
        Overlay::Prompt(_) => &[("Enter", "do it"), ("Tab", "complete"), ("Esc", "leave it")],
        Overlay::Recover(found) if found.first().is_some_and(|f| f.missing.is_some()) => {
            &[("d", "drop it"), ("Esc", "decide later")]
        }
        Overlay::Recover(_) => &[("r", "take it back in"), ("d", "drop it"), ("Esc", "decide later")],
        Overlay::ConfirmQuit => &[("w", "save and quit"), ("d", "drop and quit"), ("Esc", "stay")],
    };
    Some(items.iter().map(|(k, w)| ((*k).to_owned(), *w)).collect())
}
