//! The question whether work that was not saved is wanted back.

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::text::{Line, Span};

use super::super::journal::Found;
use super::super::model::Model;
use super::super::words::counted;
use super::overlay::{popup, rows};
use crate::track::printable;

pub(super) fn draw(model: &Model, offered: &[Found], area: Rect, buffer: &mut Buffer) {
    let Some(found) = offered.first() else { return };
    let lines = lines(model, found, offered.len() - 1);
    let height = u16::try_from(lines.len() + 2).unwrap_or(u16::MAX);
    let inside = popup(model, "unsaved work was found", (74, height), area, buffer);
    rows(model, lines, 0, inside, buffer);
}

fn lines(model: &Model, found: &Found, more: usize) -> Vec<Line<'static>> {
    let theme = &model.theme;
    let key = |k: &str, words: &str| {
        Line::from(vec![Span::styled(format!("{k:5}"), theme.key), Span::styled(words.to_owned(), theme.text)])
    };
    let (are, last) = if found.changes == 1 { ("was", "") } else { ("were", "the last ") };
    let what = format!("{} {are} never saved, {last}of {}.", counted(found.changes, "change"), found.when);
    let mut lines = vec![Line::styled(what, theme.warning)];
    let mut note = |text: String| lines.push(Line::styled(text, theme.dim));
    if let Some(session) = &found.session {
        let name = session.file_name().unwrap_or(session.as_os_str()).to_string_lossy().into_owned();
        let since = if found.session_changed { ", which has changed since" } else { "" };
        note(format!("It continues {}{since}.", printable(&name)));
    }
    if found.added > 0 {
        note(format!(
            "Since then {} {} added to the record.",
            counted(found.added, "row"),
            if found.added == 1 { "was" } else { "were" }
        ));
    }
    if !found.complete {
        note("Its last line is incomplete: that change is lost.".into());
    }
    if let Some(channel) = &found.missing {
        note(format!("It is about {} too, which is not loaded:", printable(channel)));
        note("open the record with all of its channels to restore it.".into());
    }
    if more > 0 {
        note(format!("({more} more after this)"));
    }
    lines.push(Line::default());
    if found.missing.is_none() {
        lines.push(key("r", "restore it"));
    }
    lines.push(key("d", "discard it"));
    lines.push(key("Esc", "decide later; it is kept"));
    lines
}
