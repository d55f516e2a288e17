//! The dialog that writes files.

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::text::{Line, Span};

use super::super::super::model::{ExportForm, Model};
use super::super::overlay::{Choice, choices, popup, typed};
use super::{end_of, padded};
use crate::track::printable;

/// Width of the names of outputs.
const NAMES: usize = 12;

pub(super) fn draw(model: &Model, form: &ExportForm, area: Rect, buffer: &mut Buffer) -> Vec<Choice> {
    let theme = &model.theme;
    let height = u16::try_from(form.rows.len() + 6).unwrap_or(u16::MAX);
    let inside = popup(model, "write files", (76, height), area, buffer);
    let width = usize::from(inside.width);
    let mut lines = Vec::new();
    for (i, row) in form.rows.iter().enumerate() {
        let chosen = i == form.choice;
        let mark = if chosen { '>' } else { ' ' };
        let head = format!("{mark} [{}] {}", if row.on { 'x' } else { ' ' }, padded(row.kind.name(), NAMES));
        if let (true, Some(input)) = (chosen, &form.typing) {
            lines.push((typed(model, &head, input, inside.width), None));
            continue;
        }
        let there = if row.there { "  exists" } else { "" };
        let room = width.saturating_sub(head.chars().count() + there.len());
        let path = end_of(&printable(&row.path.display().to_string()), room);
        let style = if chosen {
            theme.focus
        } else if row.on {
            theme.title
        } else {
            theme.text
        };
        let line = Line::from(vec![
            Span::styled(head, style),
            Span::styled(path, if row.on { theme.text } else { theme.dim }),
            Span::styled(there, theme.warning),
        ]);
        lines.push((line, Some(i)));
    }
    let help = form.rows.get(form.choice).map_or("", |row| row.kind.help());
    let below = ["", help, "All chosen files are written together, or none."];
    lines.extend(below.map(|text| (Line::styled(text, theme.dim), None)));
    choices(model, lines, 0, inside, buffer)
}
