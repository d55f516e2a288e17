//! What lies over the panels: help, lists, prompts, the question before quitting.

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::style::Style;
use ratatui::text::{Line, Span};
use ratatui::widgets::{Block, Borders, Widget};
use tui_input::Input;
use unicode_width::UnicodeWidthStr;

use super::super::model::{Model, Overlay, Picker, PickerKind, Prompt, PromptKind};
use super::super::plot::Glyphs;
use super::super::update::{narrowed, note, value_text};
use super::files::end_of;
use super::{clear, detectability, fit};
use crate::experiment::{self, CHOICES};
use crate::track::printable;

/// A row that can be chosen: where it is on the screen, and its index.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(in super::super) struct Choice {
    pub(in super::super) place: Rect,
    pub(in super::super) index: usize,
}

/// Draws what lies over the panels; gives the rows that can be chosen, for the mouse: where they are is decided here
/// alone.
pub(in super::super) fn draw(model: &Model, area: Rect, buffer: &mut Buffer) -> Vec<Choice> {
    match &model.overlay {
        Overlay::Picker(picker) => return list(model, picker, area, buffer),
        Overlay::Prompt(prompt) => return line(model, prompt, area, buffer),
        Overlay::Files(dialog) => return super::files::draw(model, dialog, area, buffer),
        Overlay::Journal(at) => return super::journal::draw(model, *at, area, buffer),
        Overlay::Overview(overview) => return super::channels_overview::draw(model, overview, area, buffer),
        Overlay::None => {}
        Overlay::Help(filter, from) => super::help::draw(model, filter, *from, area, buffer),
        Overlay::ConfirmQuit => confirm(model, area, buffer),
        Overlay::CommandLine(line, about) => command_line(model, line, about, area, buffer),
        Overlay::Recover(found) => super::recover::draw(model, found, area, buffer),
        Overlay::Merge(merging) => super::merge::draw(model, merging, area, buffer),
    }
    Vec::new()
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

/// Lines as [`rows`] draws them, each with the index of what it stands for, if it can be chosen.
pub(super) fn choices(
    model: &Model,
    lines: Vec<(Line<'_>, Option<usize>)>,
    from: usize,
    inside: Rect,
    buffer: &mut Buffer,
) -> Vec<Choice> {
    let indices = lines.iter().skip(from).map(|(_, index)| *index);
    let choice = |(place, index): (Rect, Option<usize>)| index.map(|index| Choice { place, index });
    let choices = inside.rows().zip(indices).filter_map(choice).collect();
    rows(model, lines.into_iter().map(|(line, _)| line).collect(), from, inside, buffer);
    choices
}

/// A line of text with its cursor, which is in sight: of what does not fit into `width` columns the beginning is left
/// out, where one is not typing.
pub(super) fn typed(model: &Model, before: &str, input: &Input, width: u16) -> Line<'static> {
    // One character for one, so that the cursor stays where it is: what would be shown as an escape is a blot.
    let visible = |c: char| if printable(c.encode_utf8(&mut [0; 4])).chars().eq([c]) { c } else { '\u{fffd}' };
    let text: String = input.value().chars().map(visible).collect();
    let at = input.cursor();
    // One column for the cursor behind the last character.
    let room = usize::from(width).saturating_sub(before.width() + 1).max(1);
    let head = end_of(&text.chars().take(at).collect::<String>(), room);
    let under = text.chars().nth(at).unwrap_or(' ');
    let tail: String = text.chars().skip(at + 1).collect();
    Line::from(vec![
        Span::styled(before.to_owned(), model.theme.key),
        Span::raw(head),
        Span::styled(under.to_string(), Style::new().patch(model.theme.cursor)),
        Span::raw(tail),
    ])
}

fn list(model: &Model, picker: &Picker, area: Rect, buffer: &mut Buffer) -> Vec<Choice> {
    let theme = &model.theme;
    let title = match picker.kind {
        PickerKind::Method => "method",
        PickerKind::Repair => "repair",
        PickerKind::Channel => "channel",
        PickerKind::Rate => "channel that measures the rate",
        PickerKind::Second => "channel beside the one on the screen",
    };
    let methods = picker.kind == PickerKind::Method;
    let about = if methods { detectability::about_list(model) } else { None };
    let title = about.map_or_else(|| title.to_owned(), |about| format!("{title}: {about}"));
    let found = narrowed(model, picker);
    let groups = found.windows(2).filter(|w| w[0].group != w[1].group).count();
    let advises = picker.kind == PickerKind::Method;
    let below = if advises { ADVICE } else { 0 };
    let wanted = u16::try_from(found.len() + groups + 5).unwrap_or(u16::MAX).saturating_add(below);
    let inside = popup(model, &title, (76, wanted.max(8)), area, buffer);
    typed(model, "filter: ", &picker.filter, inside.width)
        .render(Rect { height: inside.height.min(1), ..inside }, buffer);
    // The list comes first.
    let below = if inside.height > 4 * ADVICE { below } else { 0 };
    let body = Rect { y: inside.y + 1, height: inside.height.saturating_sub(1 + below), ..inside };
    if let Some(entry) = found.get(picker.choice).filter(|_| below > 0) {
        let foot = Rect { y: body.bottom(), height: below, ..inside };
        let lines = when(&entry.id, usize::from(foot.width));
        for (line, row) in lines.into_iter().zip(foot.rows()) {
            Line::styled(line, theme.dim).render(row, buffer);
        }
    }
    let mut lines = Vec::new();
    if methods && model.state().studied.is_some() {
        lines.push((Line::styled(format!("{:23}{}", "", detectability::CELLS), theme.dim), None));
    }
    let (mut group, mut choice_row) = ("", 0);
    for (i, entry) in found.iter().enumerate() {
        if entry.group != group {
            group = entry.group;
            lines.push((Line::styled(group.to_owned(), theme.dim), None));
        }
        let chosen = i == picker.choice;
        if chosen {
            choice_row = lines.len();
        }
        let mark = if entry.current { '*' } else { ' ' };
        let text = format!("{}{mark} {:20}", if chosen { '>' } else { ' ' }, fit(&printable(&entry.id), 20));
        let style = if chosen { theme.focus } else { theme.text };
        let help = Span::styled(format!(" {}", entry.help), theme.dim);
        let cells = if methods { detectability::cells(model, &entry.id) } else { None };
        let cells = cells.map(|cells| Span::styled(format!(" {cells} "), theme.text));
        let spans = [Some(Span::styled(text, style)), cells, Some(help)];
        lines.push((Line::from(spans.into_iter().flatten().collect::<Vec<_>>()), Some(i)));
    }
    if found.is_empty() {
        lines.push((Line::styled("nothing fits", theme.dim), None));
    }
    let from = (choice_row + 1).saturating_sub(usize::from(body.height));
    choices(model, lines, from, body, buffer)
}

/// Rows below the list of methods that say when the chosen one is to be taken.
const ADVICE: u16 = 3;

/// When a method is to be taken, as the documents and our figures have it.
fn when(id: &str, width: usize) -> Vec<String> {
    let of = CHOICES.iter().filter(|choice| choice.method == id);
    let text = |c: &experiment::Choice| {
        format!("{} ({}), {}: {}. Here: {}.", c.outliers, c.mode(), c.record, c.document, c.measured())
    };
    of.flat_map(|choice| super::parameters::wrapped(&text(choice), width)).collect()
}

/// A prompt takes the line on which the program speaks, with what is wrong above it.
fn line(model: &Model, prompt: &Prompt, area: Rect, buffer: &mut Buffer) -> Vec<Choice> {
    if area.height < 3 {
        return Vec::new();
    }
    let before = match prompt.kind {
        PromptKind::Command => ":".to_owned(),
        PromptKind::Jump => "/".to_owned(),
        PromptKind::SaveAs => "save as: ".to_owned(),
        PromptKind::Value => {
            let knob = model.knob();
            format!("{} (now {}): ", knob.name(), value_text(&model.plan().setup, knob))
        }
        PromptKind::Note => note::subject_words(model),
    };
    let row = Rect { y: area.bottom() - 2, height: 1, ..area };
    let error = prompt.error.as_ref().map(|error| {
        let width = usize::from(area.width).saturating_sub(2).max(1);
        super::parameters::wrapped(&printable(error), width)
    });
    let most = usize::from(area.height).saturating_sub(2).min(usize::from(area.height / 2).max(4));
    let wrong = error.into_iter().flatten().take(most).collect::<Vec<_>>();
    let above = row.y - u16::try_from(wrong.len()).unwrap_or(0);
    let choices = super::palette::draw(model, prompt, above, area, buffer);
    clear(row, buffer);
    typed(model, &before, &prompt.input, row.width).render(row, buffer);
    if prompt.kind == PromptKind::Note && prompt.error.is_none() {
        super::reasons::draw(model, prompt, row, buffer);
    }
    for (i, text) in wrong.into_iter().enumerate() {
        let row = Rect { y: above + u16::try_from(i).unwrap_or(0), height: 1, ..area };
        clear(row, buffer);
        Line::from(Span::styled(format!(" {text}"), model.theme.error)).render(row, buffer);
    }
    choices
}

/// The command line that is equivalent, without a screen, to be read or copied.
fn command_line(model: &Model, line: &str, about: &str, area: Rect, buffer: &mut Buffer) {
    let width = usize::from(area.width.min(100)).saturating_sub(4).max(1);
    // Cut anywhere: a blank at the end of a row would not be seen, and is part of it.
    let text: Vec<char> = printable(line).chars().collect();
    let mut lines: Vec<Line<'_>> =
        text.chunks(width).map(|chunk| Line::styled(chunk.iter().collect::<String>(), model.theme.title)).collect();
    lines.push(Line::default());
    let copied = "Copied to the clipboard, where the terminal lets programs do that; in tmux after \
                  `set -g set-clipboard on`.";
    for text in [about, copied] {
        let rows = super::parameters::wrapped(text, width);
        lines.extend(rows.into_iter().map(|row| Line::styled(row, model.theme.dim)));
    }
    let height = u16::try_from(lines.len() + 2).unwrap_or(u16::MAX);
    let inside = popup(model, "equivalent command", (area.width.min(100), height), area, buffer);
    rows(model, lines, 0, inside, buffer);
}

fn confirm(model: &Model, area: Rect, buffer: &mut Buffer) {
    let inside = popup(model, "not saved", (64, 7), area, buffer);
    let path = model.file.clone().unwrap_or_else(|| super::super::update::default_session(&model.track.source));
    let key = |k: &str, words: String| {
        Line::from(vec![Span::styled(format!("{k:5}"), model.theme.key), Span::styled(words, model.theme.text)])
    };
    let room = usize::from(inside.width).saturating_sub("w    save to  and quit".len());
    let lines = vec![
        Line::styled("The session has unsaved changes.", model.theme.warning),
        Line::default(),
        // The end of a path says most, and what the key does is after it.
        key("w", format!("save to {} and quit", end_of(&printable(&path.display().to_string()), room))),
        key("d", "discard them and quit".into()),
        key("Esc", "stay".into()),
    ];
    rows(model, lines, 0, inside, buffer);
}
