//! The picker of files: a list, and what the file under the cursor is.

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::text::{Line, Span};
use ratatui::widgets::Widget;

use super::super::super::files::{FileEntry, FileKind};
use super::super::super::model::{Browser, Model};
use super::super::overlay::{Choice, choices, popup, rows, typed};
use super::{end_of, known, padded};
use crate::track::printable;

/// From this width on, what is known of a file stands beside the list.
const BESIDE: u16 = 100;

pub(super) fn draw(model: &Model, browser: &Browser, area: Rect, buffer: &mut Buffer) -> Vec<Choice> {
    let folder = end_of(&printable(&browser.folder.display().to_string()), usize::from(area.width).saturating_sub(12));
    let title = if folder.is_empty() { "open".to_owned() } else { format!("open: {folder}") };
    let inside = popup(model, &title, (area.width, area.height), area, buffer);
    let head = Rect { height: inside.height.min(1), ..inside };
    typed(model, "filter or path: ", &browser.filter, inside.width).render(head, buffer);
    let body = Rect { y: inside.y + head.height, height: inside.height - head.height, ..inside };
    let (list, pane) = if area.width >= BESIDE {
        let width = body.width * 3 / 5;
        (Rect { width, ..body }, Rect { x: body.x + width + 2, width: body.width.saturating_sub(width + 2), ..body })
    } else {
        let height = body.height * 3 / 5;
        (Rect { height, ..body }, Rect { y: body.y + height, height: body.height - height, ..body })
    };
    preview(model, browser, pane, area.width >= BESIDE, buffer);
    entries(model, browser, list, buffer)
}

fn entries(model: &Model, browser: &Browser, area: Rect, buffer: &mut Buffer) -> Vec<Choice> {
    let theme = &model.theme;
    let found = browser.narrowed();
    let mut lines = Vec::new();
    let (mut recent, mut choice_row) = (false, 0);
    for (i, entry) in found.iter().enumerate() {
        if entry.recent && !recent {
            lines.push((Line::styled("recent", theme.dim), None));
        } else if !entry.recent && recent {
            lines.push((Line::styled("in this folder", theme.dim), None));
        }
        recent = entry.recent;
        let chosen = i == browser.choice;
        if chosen {
            choice_row = lines.len();
        }
        lines.push((line(model, entry, chosen, usize::from(area.width)), Some(i)));
    }
    if found.is_empty() {
        let words = if browser.listing { "reading the folder …" } else { "no match; Enter opens it as a path" };
        lines.push((Line::styled(words, theme.dim), None));
    }
    let from = (choice_row + 1).saturating_sub(usize::from(area.height));
    choices(model, lines, from, area, buffer)
}

fn line(model: &Model, entry: &FileEntry, chosen: bool, width: usize) -> Line<'static> {
    let theme = &model.theme;
    // Names keep most of the width; where it is small, the time of change goes first.
    let changed = if width >= 56 { entry.changed.clone() } else { String::new() };
    let size = match entry.kind {
        FileKind::Folder => "folder".into(),
        FileKind::Session | FileKind::File => bytes(entry.size),
    };
    let right = format!(" {size:>8}  {changed}");
    let room = width.saturating_sub(right.chars().count() + 2);
    let name = match entry.kind {
        FileKind::Folder => format!("{}/", entry.name),
        FileKind::Session | FileKind::File => entry.name.clone(),
    };
    let name = if entry.recent { padded(&end_of(&name, room), room) } else { padded(&name, room) };
    let style = match (chosen, entry.kind) {
        (true, _) => theme.focus,
        (_, FileKind::Session | FileKind::Folder) => theme.title,
        _ => theme.text,
    };
    let mark = if chosen { "> " } else { "  " };
    Line::from(vec![Span::styled(format!("{mark}{name}"), style), Span::styled(right, theme.dim)])
}

fn preview(model: &Model, browser: &Browser, area: Rect, beside: bool, buffer: &mut Buffer) {
    let theme = &model.theme;
    let mut lines = Vec::new();
    if let Some((text, wrong)) = &browser.said {
        let style = if *wrong { theme.error } else { theme.warning };
        let wrapped = super::super::parameters::wrapped(&printable(text), usize::from(area.width).max(1));
        lines.extend(wrapped.into_iter().map(|l| Line::styled(l.to_string(), style)));
    }
    if let Some(entry) = browser.chosen() {
        let seen = browser.seen.as_ref().filter(|(path, _)| *path == entry.path).map(|(_, seen)| seen);
        // What stands above already is not said twice.
        let said = browser.said.as_ref().map(|(text, _)| text);
        if !matches!(seen, Some(Err(error)) if Some(error) == said) {
            if !beside {
                lines.push(Line::styled("what it is", theme.dim));
            }
            lines.extend(known(model, seen, usize::from(area.width)));
        }
    }
    rows(model, lines, 0, area, buffer);
}

/// A size in few characters: `812`, `4.2k`, `1.3M`.
fn bytes(n: u64) -> String {
    #[expect(clippy::cast_precision_loss, reason = "two digits of it are shown")]
    let mut size = n as f64;
    if n < 1000 {
        return n.to_string();
    }
    for unit in ["k", "M", "G"] {
        size /= 1000.0;
        if size < 9.95 {
            return format!("{size:.1}{unit}");
        }
        if size < 999.5 {
            return format!("{size:.0}{unit}");
        }
    }
    format!("{:.0}T", size / 1000.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sizes_are_short() {
        let sizes = [0, 999, 1000, 9_949, 9_950, 999_499, 999_500, 210_000_000, 3_000_000_000_000];
        assert_eq!(sizes.map(bytes), ["0", "999", "1.0k", "9.9k", "10k", "999k", "1.0M", "210M", "3T"]);
    }
}
