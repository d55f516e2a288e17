//! The journal panel: every edit in its order, the undone ones dim, and where the session is among them.

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::text::{Line, Span};
use ratatui::widgets::Widget;

use super::super::model::Model;
use super::super::plot::Glyphs;
use super::super::update::describe;
use super::fit;
use super::overlay::{Choice, popup};

pub(super) fn draw(model: &Model, at: usize, area: Rect, buffer: &mut Buffer) -> Vec<Choice> {
    let theme = &model.theme;
    let (done, undone) = (model.history.done(), model.history.undone());
    let all = done.len() + undone.len();
    let title = format!("history: {} in effect, {} undone", done.len(), undone.len());
    let height = u16::try_from(all + 4).unwrap_or(u16::MAX).max(8);
    let inside = popup(model, &title, (76, height), area, buffer);
    let head = Line::styled("* is where the session is; Enter goes to a line, by undo or redo", theme.dim);
    head.render(Rect { height: inside.height.min(1), ..inside }, buffer);
    let body = Rect { y: inside.y + 1, height: inside.height.saturating_sub(1), ..inside };
    let rows = usize::from(body.height);
    // The chosen line in the middle, as long as there are others on both sides.
    let from = at.saturating_sub(rows / 2).min((all + 1).saturating_sub(rows));
    let separator = if model.glyphs == Glyphs::Unicode { '│' } else { '|' };
    let mut choices = Vec::new();
    for (place, line) in body.rows().zip(from..=all) {
        let edit = match line.checked_sub(1) {
            None => None,
            Some(index) if index < done.len() => done.get(index),
            // What was undone last is redone first.
            Some(index) => undone.get(all - 1 - index),
        };
        let words = edit.map_or_else(|| "as it was opened".to_owned(), |edit| describe::edit(model, edit));
        let chosen = if line == at { '>' } else { ' ' };
        let current = if line == done.len() { '*' } else { ' ' };
        let style = match (line == at, line > done.len()) {
            (true, _) => theme.focus,
            (false, true) => theme.dim,
            (false, false) => theme.text,
        };
        let number = format!("{chosen}{current}{line:>5} {separator} ");
        let room = usize::from(body.width).saturating_sub(number.chars().count());
        let mark = if line > done.len() { "  (undone)" } else { "" };
        let words = fit(&format!("{words}{mark}"), room);
        let text = Line::from(vec![Span::styled(number, theme.dim), Span::styled(words, style)]);
        text.render(place, buffer);
        choices.push(Choice { place, index: line });
    }
    choices
}
