//! The lists over a prompt: what fits the command, and the forms of a jump.

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::text::{Line, Span};
use ratatui::widgets::Widget;
use unicode_width::UnicodeWidthStr;

use super::super::model::{Model, Prompt, PromptKind};
use super::super::update::{FORMS, Suggestion, chosen, suggestions};
use super::overlay::Choice;
use super::{clear, fit, rule};

/// Rows of the list at most.
const MOST: u16 = 12;

/// Draws the list that belongs to a prompt, its last row above `bottom`; gives the rows that can be chosen.
pub(super) fn draw(model: &Model, prompt: &Prompt, bottom: u16, area: Rect, buffer: &mut Buffer) -> Vec<Choice> {
    let rows = match prompt.kind {
        PromptKind::Command => commands(model, prompt),
        PromptKind::Jump => FORMS.iter().map(|(form, help)| Row::of(form, "", help)).collect(),
        PromptKind::Value | PromptKind::SaveAs | PromptKind::Note => return Vec::new(),
    };
    // A heading, and the panels above keep some rows.
    let room = bottom.saturating_sub(area.y).saturating_sub(4).min(MOST);
    let height = u16::try_from(rows.len()).unwrap_or(u16::MAX).min(room);
    if height == 0 {
        return Vec::new();
    }
    let at = rows.iter().position(|row| row.chosen).unwrap_or(0);
    let visible = usize::from(height);
    let from = at.saturating_sub(visible / 2).min(rows.len() - visible);
    let place = Rect { y: bottom - height - 1, height: height + 1, ..area };
    clear(place, buffer);
    let chosen = rows.iter().find(|row| row.chosen);
    let words = match (prompt.kind, chosen) {
        (PromptKind::Jump, _) => "where to? (empty: repeat the last jump)".to_owned(),
        // What the row has no room for.
        (_, Some(row)) => format!("{} of {}  {}", at + 1, rows.len(), row.help),
        (_, None) => format!("{} fit", rows.len()),
    };
    let words = fit(&words, usize::from(area.width).saturating_sub(2));
    rule(model, vec![Span::styled(format!(" {words}"), model.theme.dim)], place, buffer);
    let widths = widths(&rows, area.width);
    let mut choices = Vec::new();
    for (place, (index, row)) in place.rows().skip(1).zip(rows.iter().enumerate().skip(from).take(visible)) {
        row.line(model, widths, area.width).render(place, buffer);
        choices.push(Choice { place, index });
    }
    // The forms of a jump are there to be read.
    if prompt.kind == PromptKind::Command { choices } else { Vec::new() }
}

/// One row: a name, keys, and what it is.
struct Row {
    name: String,
    keys: String,
    help: String,
    chosen: bool,
}

impl Row {
    fn of(name: &str, keys: &str, help: &str) -> Self {
        Self { name: name.into(), keys: keys.into(), help: help.into(), chosen: false }
    }

    fn line(&self, model: &Model, (name, keys): (usize, usize), width: u16) -> Line<'static> {
        let theme = &model.theme;
        let mark = if self.chosen { '>' } else { ' ' };
        let style = if self.chosen { theme.focus } else { theme.text };
        let padded = |text: &str, width: usize| {
            let text = fit(text, width);
            let blanks = width.saturating_sub(text.width());
            format!("{text}{:blanks$}", "")
        };
        let keys = if keys == 0 { String::new() } else { format!("  {}", padded(&self.keys, keys)) };
        let help = fit(&self.help, usize::from(width).saturating_sub(name + keys.width() + 4));
        Line::from(vec![
            Span::styled(format!("{mark} {}", padded(&self.name, name)), style),
            Span::styled(keys, theme.key),
            Span::styled(format!("  {help}"), theme.dim),
        ])
    }
}

fn commands(model: &Model, prompt: &Prompt) -> Vec<Row> {
    let found = suggestions(model, prompt.input.value());
    let at = chosen(prompt, &found);
    let row = |(i, s): (usize, Suggestion)| Row { chosen: at == Some(i), ..Row::of(&s.name, &s.keys, &s.help) };
    found.into_iter().enumerate().map(row).collect()
}

/// Columns of names and keys: as wide as they need, the help keeps half of the screen.
fn widths(rows: &[Row], width: u16) -> (usize, usize) {
    let most = |of: fn(&Row) -> &str| rows.iter().map(|row| of(row).width()).max().unwrap_or(0);
    let half = usize::from(width) / 2;
    let name = most(|row| &row.name).min(half * 3 / 5);
    let keys = most(|row| &row.keys).min(half.saturating_sub(name));
    (name, keys)
}
