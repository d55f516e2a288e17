//! The reasons that a note can begin with, above the line in which it is typed.

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::text::{Line, Span};
use ratatui::widgets::Widget;

use super::super::model::{Model, Prompt};
use super::super::update::note::{REASONS, reason};
use super::clear;

/// Draws the list so that it ends above `row`.
pub(super) fn draw(model: &Model, prompt: &Prompt, row: Rect, buffer: &mut Buffer) {
    let theme = &model.theme;
    let (at, _) = reason(prompt.input.value());
    let width = usize::from(row.width);
    let mut lines = vec![vec![Span::styled(" reason", theme.title)]];
    let mut used = 7;
    for (i, words) in REASONS.iter().enumerate() {
        let chosen = at == Some(i);
        let text = if chosen { format!("  [{words}]") } else { format!("   {words} ") };
        let wide = text.chars().count();
        if used + wide > width && used > 0 {
            lines.push(Vec::new());
            used = 0;
        }
        used += wide;
        let style = if chosen { theme.focus } else { theme.dim };
        if let Some(line) = lines.last_mut() {
            line.push(Span::styled(text, style));
        }
    }
    for (up, spans) in (1_u16..).zip(lines.into_iter().rev()) {
        if up > row.y {
            return;
        }
        let place = Rect { y: row.y - up, height: 1, ..row };
        clear(place, buffer);
        Line::from(spans).render(place, buffer);
    }
}
