//! What lies over the panels: help, lists, prompts, the question before quitting.

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::style::Style;
use ratatui::text::{Line, Span};
use ratatui::widgets::{Block, Borders, Widget};
use tui_input::Input;

use super::super::keys::Context;
use super::super::model::{Model, Overlay, Picker, PickerKind, Prompt, PromptKind};
use super::super::plot::{FlagState, Glyphs};
use super::super::update::{COMMANDS, narrowed, note, value_text};
use super::{clear, fit};
use crate::track::printable;

pub(super) fn draw(model: &Model, area: Rect, buffer: &mut Buffer) {
    match &model.overlay {
        Overlay::None => {}
        Overlay::Help(filter, from) => help(model, filter, *from, area, buffer),
        Overlay::Picker(picker) => list(model, picker, area, buffer),
        Overlay::Prompt(prompt) => line(model, prompt, area, buffer),
        Overlay::ConfirmQuit => confirm(model, area, buffer),
        Overlay::Journal(at) => super::journal::draw(model, *at, area, buffer),
        Overlay::Recover(found) => super::recover::draw(model, found, area, buffer),
    }
}

/// A box of at most this size in the middle of the screen, the footer left free; gives its inside.
pub(super) fn popup(model: &Model, title: &str, size: (u16, u16), area: Rect, buffer: &mut Buffer) -> Rect {
    let room = Rect { height: area.height.saturating_sub(1), ..area };
    // A few columns left over would show strips of what lies below.
    let width = if size.0 + 8 >= room.width { room.width } else { size.0 };
    let height = size.1.min(room.height);
    let place = Rect { x: room.x + (room.width - width) / 2, y: room.y + (room.height - height) / 2, width, height };
    clear(place, buffer);
    let block = Block::new()
        .borders(Borders::ALL)
        .border_style(model.theme.dim)
        .title(Span::styled(format!(" {title} "), model.theme.focus));
    let block = if model.glyphs == Glyphs::Unicode { block } else { block.border_set(PLAIN) };
    let inside = block.inner(place);
    block.render(place, buffer);
    Rect { x: inside.x + 1, width: inside.width.saturating_sub(2), ..inside }
}

const PLAIN: ratatui::symbols::border::Set<'static> = ratatui::symbols::border::Set {
    top_left: "+",
    top_right: "+",
    bottom_left: "+",
    bottom_right: "+",
    vertical_left: "|",
    vertical_right: "|",
    horizontal_top: "-",
    horizontal_bottom: "-",
};

/// Lines from one on; where some are out of sight, the right edge says which way.
pub(super) fn rows(model: &Model, lines: Vec<Line<'_>>, from: usize, inside: Rect, buffer: &mut Buffer) {
    let below = lines.len() > from + usize::from(inside.height);
    let marks = [(from > 0, inside.y, "↑ more"), (below, inside.bottom().saturating_sub(1), "↓ more")];
    for (row, line) in lines.into_iter().skip(from).take(usize::from(inside.height)).enumerate() {
        let row = u16::try_from(row).unwrap_or(u16::MAX);
        line.render(Rect { y: inside.y + row, height: 1, ..inside }, buffer);
    }
    for (shown, y, words) in marks {
        if shown && inside.width > 8 && inside.height > 1 {
            let place = Rect { x: inside.right() - 6, y, width: 6, height: 1 };
            Line::styled(words, model.theme.warning).render(place, buffer);
        }
    }
}

/// A line of text with its cursor.
fn typed(model: &Model, before: &str, input: &Input) -> Line<'static> {
    let text: String = input.value().chars().map(|c| if c.is_control() { '\u{fffd}' } else { c }).collect();
    let at = input.cursor();
    let head: String = text.chars().take(at).collect();
    let under = text.chars().nth(at).unwrap_or(' ');
    let tail: String = text.chars().skip(at + 1).collect();
    Line::from(vec![
        Span::styled(before.to_owned(), model.theme.key),
        Span::raw(head),
        Span::styled(under.to_string(), Style::new().patch(model.theme.cursor)),
        Span::raw(tail),
    ])
}

/// The lines of the help that hold what was typed: keys by where they work, then commands.
fn help_lines(model: &Model, filter: &str) -> Vec<Line<'static>> {
    let theme = &model.theme;
    let wanted = filter.to_lowercase();
    let mut lines = Vec::new();
    let mut group = |heading: &str, entries: Vec<(String, String)>| {
        let fits = |(keys, help): &(String, String)| {
            wanted.is_empty() || format!("{heading} {keys} {help}").to_lowercase().contains(&wanted)
        };
        let entries: Vec<_> = entries.into_iter().filter(fits).collect();
        if entries.is_empty() {
            return;
        }
        if !lines.is_empty() {
            lines.push(Line::default());
        }
        lines.push(Line::styled(heading.to_owned(), theme.title));
        for (keys, help) in entries {
            lines.push(Line::from(vec![
                Span::styled(format!("  {keys:18}"), theme.key),
                Span::styled(format!(" {help}"), theme.text),
            ]));
        }
    };
    for context in Context::ALL {
        let of = model.keys.of(context).filter(|b| !b.keys.is_empty());
        group(context.heading(), of.map(|b| (b.shown(), b.row.help.to_owned())).collect());
    }
    let command =
        |c: &super::super::update::Command| (format!(":{} {}", c.name.replace('|', " :"), c.takes), c.help.to_owned());
    let mark = |s: FlagState| (model.glyphs.flag(s).to_string(), super::card::state_word(s).to_owned());
    let mut marks: Vec<(String, String)> = FlagState::BY_URGENCY.into_iter().map(mark).collect();
    let beyond = format!("{} {}", model.glyphs.beyond(true, false), model.glyphs.beyond(false, true));
    marks.push((beyond, "a sample off the scale (y changes the scale)".into()));
    marks.push(("!".into(), "decisions that the method now contradicts".into()));
    group("marks", marks);
    group("commands", COMMANDS.iter().map(command).collect());
    lines
}

fn help(model: &Model, filter: &Input, from: usize, area: Rect, buffer: &mut Buffer) {
    let inside = popup(model, "keys and commands", (78, area.height), area, buffer);
    let head = Rect { height: inside.height.min(1), ..inside };
    typed(model, "filter: ", filter).render(head, buffer);
    let body = Rect { y: inside.y + head.height, height: inside.height - head.height, ..inside };
    let lines = help_lines(model, filter.value());
    let last = lines.len().saturating_sub(usize::from(body.height));
    rows(model, lines, from.min(last), body, buffer);
}

fn list(model: &Model, picker: &Picker, area: Rect, buffer: &mut Buffer) {
    let theme = &model.theme;
    let title = match picker.kind {
        PickerKind::Method => "method",
        PickerKind::Repair => "repair",
        PickerKind::Channel => "channel",
        PickerKind::Rate => "channel that measures the rate",
        PickerKind::Second => "channel beside the one on the screen",
    };
    let found = narrowed(model, picker);
    let groups = found.windows(2).filter(|w| w[0].group != w[1].group).count();
    let wanted = u16::try_from(found.len() + groups + 5).unwrap_or(u16::MAX);
    let inside = popup(model, title, (76, wanted.max(8)), area, buffer);
    typed(model, "filter: ", &picker.filter).render(Rect { height: inside.height.min(1), ..inside }, buffer);
    let body = Rect { y: inside.y + 1, height: inside.height.saturating_sub(1), ..inside };
    let mut lines = Vec::new();
    let (mut group, mut choice_row) = ("", 0);
    for (i, entry) in found.iter().enumerate() {
        if entry.group != group {
            group = entry.group;
            lines.push(Line::styled(group.to_owned(), theme.dim));
        }
        let chosen = i == picker.choice;
        if chosen {
            choice_row = lines.len();
        }
        let mark = if entry.current { '*' } else { ' ' };
        let text = format!("{}{mark} {:20}", if chosen { '>' } else { ' ' }, fit(&printable(&entry.id), 20));
        let style = if chosen { theme.focus } else { theme.text };
        lines.push(Line::from(vec![Span::styled(text, style), Span::styled(format!(" {}", entry.help), theme.dim)]));
    }
    if found.is_empty() {
        lines.push(Line::styled("nothing fits", theme.dim));
    }
    let from = (choice_row + 1).saturating_sub(usize::from(body.height));
    rows(model, lines, from, body, buffer);
}

/// A prompt takes the line on which the program speaks, with what is wrong above it.
fn line(model: &Model, prompt: &Prompt, area: Rect, buffer: &mut Buffer) {
    if area.height < 3 {
        return;
    }
    let before = match prompt.kind {
        PromptKind::Command => ":".to_owned(),
        PromptKind::Jump => "to time, #row or +seconds: ".to_owned(),
        PromptKind::Value => {
            let knob = model.knob();
            format!("{} (now {}): ", knob.name(), value_text(&model.plan().setup, knob))
        }
        PromptKind::Note => note::subject_words(model),
    };
    let row = Rect { y: area.bottom() - 2, height: 1, ..area };
    clear(row, buffer);
    typed(model, &before, &prompt.input).render(row, buffer);
    if prompt.kind == PromptKind::Note && prompt.error.is_none() {
        super::reasons::draw(model, prompt, row, buffer);
    }
    if let Some(error) = &prompt.error {
        let width = usize::from(area.width).saturating_sub(2).max(1);
        let lines = super::parameters::wrapped(&printable(error), width);
        let most = usize::from(area.height).saturating_sub(2).min(4);
        for (up, text) in lines.iter().take(most).rev().enumerate() {
            let up = u16::try_from(up).unwrap_or(0);
            let row = Rect { y: area.bottom() - 3 - up, height: 1, ..area };
            clear(row, buffer);
            Line::from(Span::styled(format!(" {text}"), model.theme.error)).render(row, buffer);
        }
    }
}

fn confirm(model: &Model, area: Rect, buffer: &mut Buffer) {
    let inside = popup(model, "not saved", (64, 7), area, buffer);
    let path = model.file.clone().unwrap_or_else(|| super::super::update::default_session(&model.track.source));
    let key = |k: &str, words: String| {
        Line::from(vec![Span::styled(format!("{k:5}"), model.theme.key), Span::styled(words, model.theme.text)])
    };
    let changes = model.history.len();
    let lines = vec![
        Line::styled(format!("The session has changes that are not saved ({changes} to undo)."), model.theme.warning),
        Line::default(),
        key("w", format!("save to {} and quit", path.display())),
        key("d", "drop them and quit".into()),
        key("Esc", "stay".into()),
    ];
    rows(model, lines, 0, inside, buffer);
}
