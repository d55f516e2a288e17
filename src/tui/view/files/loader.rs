//! The dialog that corrects how a record is loaded: the options, and what they make of it.

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::text::{Line, Span};

use super::super::super::files::Seen;
use super::super::super::model::{LoaderForm, Model};
use super::super::super::update::FIELDS;
use super::super::fit;
use super::super::overlay::{popup, rows, typed};
use super::{known, padded};
use crate::track::printable;

/// Width of the names of fields.
const NAMES: usize = 17;
/// Width of a column of the first rows at most.
const CELL: usize = 16;

pub(super) fn draw(model: &Model, form: &LoaderForm, area: Rect, buffer: &mut Buffer) {
    let title = format!("how to load {}", fit(&printable(&form.source.name()), 40));
    let inside = popup(model, &title, (area.width, area.height), area, buffer);
    let width = usize::from(inside.width);
    let mut lines: Vec<Line<'static>> = (0..FIELDS.len()).map(|at| field(model, form, at, width)).collect();
    let theme = &model.theme;
    let what = if form.again {
        "Enter loads it so; settings stay, and decisions where the rows are the same."
    } else {
        "Enter opens it so."
    };
    lines.push(Line::styled(what, theme.dim));
    let state = if form.stale { "looking …" } else { "" };
    lines.push(Line::styled(state, theme.warning));
    if let Some(Ok(seen)) = &form.seen {
        // Little room is for what is wrong first, then for the rows.
        let warnings = seen.warnings.iter().take(4).flat_map(|w| super::wrapped(w, width, theme.warning));
        lines.extend(warnings);
        lines.extend(table(model, seen, width, if area.height < 30 { 3 } else { 8 }));
        lines.extend(seen.lines.iter().flat_map(|l| super::wrapped(l, width, theme.text)));
    } else {
        lines.extend(known(model, form.seen.as_ref(), width));
    }
    // Where all does not fit, the field under the cursor does.
    let from = (form.choice + 2).saturating_sub(usize::from(inside.height));
    rows(model, lines, from, inside, buffer);
}

fn field(model: &Model, form: &LoaderForm, at: usize, width: usize) -> Line<'static> {
    let theme = &model.theme;
    let field = &FIELDS[at];
    let chosen = at == form.choice;
    let name = format!("{}{}", if chosen { "> " } else { "  " }, padded(field.name, NAMES));
    if let (true, Some(input)) = (chosen, &form.typing) {
        return typed(model, &name, input);
    }
    let told = (field.text)(&form.options);
    let (text, style) = match &told {
        Some(text) => (printable(text), theme.title),
        None => ("recognised".to_owned(), theme.dim),
    };
    let text = fit(&text, width.saturating_sub(NAMES + 4));
    let room = width.saturating_sub(NAMES + 4 + text.chars().count());
    let help = if chosen { fit(&format!("  {}", field.help), room) } else { String::new() };
    let style = if chosen { theme.focus } else { style };
    Line::from(vec![Span::styled(name, theme.text), Span::styled(text, style), Span::styled(help, theme.dim)])
}

/// The first rows under names and kinds, as many columns as there is room for.
fn table(model: &Model, seen: &Seen, width: usize, most: usize) -> Vec<Line<'static>> {
    use unicode_width::UnicodeWidthStr;
    let theme = &model.theme;
    let shown = seen.table.len().min(most + 2);
    let columns = seen.table.first().map_or(0, Vec::len);
    let mut lines: Vec<String> = vec![String::new(); shown];
    for column in 0..columns {
        let cell = |row: usize| seen.table[row].get(column).map_or("", String::as_str);
        let wide = (0..shown).map(|row| cell(row).width()).max().unwrap_or(0).clamp(1, CELL);
        if lines[0].width() + wide + 4 > width && column > 0 {
            lines[0].push_str(&format!(" +{}", columns - column));
            break;
        }
        for (row, line) in lines.iter_mut().enumerate() {
            line.push_str(&padded(cell(row), wide));
            line.push_str("  ");
        }
    }
    let style = |row: usize| match row {
        0 => theme.title,
        1 => theme.dim,
        _ => theme.text,
    };
    lines.into_iter().enumerate().map(|(row, text)| Line::styled(text, style(row))).collect()
}
