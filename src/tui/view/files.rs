//! Dialogs about files.

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::style::Style;
use ratatui::text::{Line, Span};

use super::super::model::{Dialog, Model, Over, Waiting};
use super::fit;
use super::overlay::{Choice, popup, rows};
use crate::track::printable;

mod browser;
mod export;
mod loader;

/// Draws a dialog; gives the rows that can be chosen.
pub(super) fn draw(model: &Model, dialog: &Dialog, area: Rect, buffer: &mut Buffer) -> Vec<Choice> {
    match dialog {
        Dialog::Browser(browser) => return browser::draw(model, browser, area, buffer),
        Dialog::Loader(form) => return loader::draw(model, form, area, buffer),
        Dialog::Export(form) => return export::draw(model, form, area, buffer),
        Dialog::Waiting(waiting) => wait(model, waiting, area, buffer),
        Dialog::Unsaved(request) => {
            let name = fit(&printable(&request.source.name()), 40);
            let path = model.file.clone().unwrap_or_else(|| super::super::update::default_session(&model.track.source));
            let path = end_of(&printable(&path.display().to_string()), 38);
            let (save, drop) = (format!("save to {path}, then open it"), format!("discard them and open {name}"));
            let first = "The session has unsaved changes.";
            question(model, "not saved", first, &[("w", &save), ("d", &drop), ("Esc", "stay")], area, buffer);
        }
        Dialog::Over(Over { path, .. }) => {
            let name = printable(&path.display().to_string());
            // Its own file is asked about only then.
            let first = if model.file.as_ref() == Some(path) {
                format!("{name} has changed since it was read or saved here.")
            } else {
                format!("{name} already exists.")
            };
            question(model, "overwrite?", &first, &[("o", "overwrite it"), ("Esc", "leave it")], area, buffer);
        }
    }
    Vec::new()
}

/// A question with the keys that answer it.
fn question(model: &Model, title: &str, first: &str, keys: &[(&str, &str)], area: Rect, buffer: &mut Buffer) {
    let height = u16::try_from(keys.len() + 4).unwrap_or(u16::MAX);
    let inside = popup(model, title, (70, height), area, buffer);
    let width = usize::from(inside.width);
    let mut lines = vec![Line::styled(end_of(first, width), model.theme.warning), Line::default()];
    lines.extend(keys.iter().map(|(key, words)| {
        let words = fit(words, width.saturating_sub(5));
        Line::from(vec![Span::styled(format!("{key:5}"), model.theme.key), Span::styled(words, model.theme.text)])
    }));
    rows(model, lines, 0, inside, buffer);
}

fn wait(model: &Model, waiting: &Waiting, area: Rect, buffer: &mut Buffer) {
    let inside = popup(model, "opening", (60, 4), area, buffer);
    let name = fit(&waiting.name, usize::from(inside.width).saturating_sub(12));
    let key = Line::from(vec![Span::styled("Esc  ", model.theme.key), Span::styled("leave it", model.theme.text)]);
    rows(model, vec![Line::styled(format!("loading {name} …"), model.theme.warning), key], 0, inside, buffer);
}

/// Text cut at its beginning: of a path, the end says most.
pub(super) fn end_of(text: &str, width: usize) -> String {
    use unicode_width::{UnicodeWidthChar, UnicodeWidthStr};
    if text.width() <= width {
        return text.to_owned();
    }
    let mut kept = Vec::new();
    let mut used = 1;
    for c in text.chars().rev() {
        let w = c.width().unwrap_or(0);
        if used + w > width {
            break;
        }
        kept.push(c);
        used += w;
    }
    let end: String = kept.into_iter().rev().collect();
    if width == 0 { String::new() } else { format!("…{end}") }
}

/// Text filled up with blanks to a width, or cut to it.
fn padded(text: &str, width: usize) -> String {
    use unicode_width::UnicodeWidthStr;
    let text = fit(text, width);
    let room = width.saturating_sub(text.width());
    text + &" ".repeat(room)
}

/// What is known of a file: what it is, then what deserves a second look.
fn known(model: &Model, seen: Option<&Result<super::super::files::Seen, String>>, width: usize) -> Vec<Line<'static>> {
    let theme = &model.theme;
    match seen {
        None => vec![Line::styled("looking …", theme.dim)],
        Some(Err(error)) => wrapped(&printable(error), width, theme.error),
        Some(Ok(seen)) => {
            let mut lines: Vec<Line<'static>> = seen.lines.iter().flat_map(|l| wrapped(l, width, theme.text)).collect();
            lines.extend(seen.warnings.iter().flat_map(|w| wrapped(w, width, theme.warning)));
            lines
        }
    }
}

/// Text broken into lines of a width.
fn wrapped(text: &str, width: usize, style: Style) -> Vec<Line<'static>> {
    super::parameters::wrapped(text, width.max(1)).into_iter().map(|line| Line::styled(line, style)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn of_a_long_path_the_end_is_kept() {
        assert_eq!(end_of("/data/run42.csv", 10), "…run42.csv");
        assert_eq!((end_of("ab", 4), end_of("abc", 0)), ("ab".into(), String::new()));
        assert_eq!(end_of("/高さ.csv", 7), "…さ.csv");
        assert_eq!((padded("a", 3), padded("abcd", 3)), ("a  ".into(), "ab…".into()));
    }
}
