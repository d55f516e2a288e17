//! The dialog that corrects how a record is loaded: the options, and what they make of it.

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::text::{Line, Span};

use super::super::super::files::Seen;
use super::super::super::model::{LoaderForm, Model};
use super::super::super::update::FIELDS;
use super::super::fit;
use super::super::overlay::{Choice, choices, popup, rows, typed};
use super::{known, padded};
use crate::track::{FileLine, LinePart, printable};

/// Width of the names of fields.
const NAMES: usize = 17;
/// Rows below the fields for what they make of the record.
const BELOW: u16 = 12;
/// Width of a column of the first rows at most.
const CELL: usize = 16;

pub(super) fn draw(model: &Model, form: &LoaderForm, area: Rect, buffer: &mut Buffer) -> Vec<Choice> {
    let title = format!("how to load {}", fit(&printable(&form.source.name()), 40));
    let inside = popup(model, &title, (area.width, area.height), area, buffer);
    let width = usize::from(inside.width);
    let (choices, inside) = fields(model, form, inside, buffer);
    let mut lines: Vec<Line<'static>> = Vec::new();
    let theme = &model.theme;
    let what = if form.again {
        "Enter: reload with these settings. Decisions stay where rows are unchanged."
    } else {
        "Enter: open with these settings."
    };
    let (what, style) = if form.stale { ("looking …", theme.warning) } else { (what, theme.dim) };
    lines.push(Line::styled(what, style));
    if let Some(Ok(seen)) = &form.seen {
        let room = Room::of(area.height);
        let mut warnings: Vec<Line<'static>> =
            seen.warnings.iter().take(4).flat_map(|w| super::wrapped(w, width, theme.warning)).collect();
        warnings.truncate(room.warnings);
        lines.extend(warnings);
        lines.extend(table(model, seen, width, room.rows));
        lines.extend(file_lines(model, &around_header(&form.lines, room.file), width));
        lines.extend(seen.lines.iter().flat_map(|l| super::wrapped(l, width, theme.text)));
    } else {
        lines.extend(known(model, form.seen.as_ref(), width));
        lines.extend(file_lines(model, &form.lines, width));
    }
    rows(model, lines, 0, inside, buffer);
    choices
}

/// Lines for what is wrong, for rows in columns, and for the file as it is.
struct Room {
    warnings: usize,
    rows: usize,
    file: usize,
}

impl Room {
    /// In a window of this many lines.
    fn of(height: u16) -> Self {
        match height {
            0..30 => Self { warnings: 3, rows: 1, file: 4 },
            30..40 => Self { warnings: 6, rows: 5, file: 8 },
            _ => Self { warnings: 8, rows: 8, file: 12 },
        }
    }
}

/// At most this many lines: what stands right above the rows, and the first of these; the last one where it is not a
/// row.
fn around_header(lines: &[FileLine], most: usize) -> Vec<FileLine> {
    if lines.len() <= most {
        return lines.to_vec();
    }
    let footer = lines.last().filter(|l| l.part == LinePart::Footer && most > 2);
    let room = most - usize::from(footer.is_some());
    let row = lines.iter().position(|l| l.part == LinePart::Row).unwrap_or(0);
    let from = row.saturating_sub(room.saturating_sub(1)).min(lines.len() - room);
    lines[from..from + room].iter().chain(footer).cloned().collect()
}

/// The first lines of the file, each in the style of what it is taken for.
fn file_lines(model: &Model, lines: &[FileLine], width: usize) -> Vec<Line<'static>> {
    let theme = &model.theme;
    let line = |line: &FileLine| {
        let (word, style) = match line.part {
            LinePart::Preamble => ("text", theme.dim),
            LinePart::Header => ("names", theme.title),
            LinePart::Units => ("units", theme.warning),
            LinePart::Row => ("row", theme.text),
            LinePart::Footer => ("below", theme.dim),
            LinePart::Unknown => ("", theme.text),
        };
        Line::styled(fit(&format!("{:>4} {word:5} {}", line.number, printable(&line.text)), width), style)
    };
    lines.iter().map(line).collect()
}

/// Draws the fields, as many of them as leave room for what they make of the record; gives them and that room. Where
/// not all of them fit, they scroll with the one that is chosen.
fn fields(model: &Model, form: &LoaderForm, inside: Rect, buffer: &mut Buffer) -> (Vec<Choice>, Rect) {
    let most = u16::try_from(FIELDS.len()).unwrap_or(u16::MAX);
    let height = inside.height.saturating_sub(BELOW).max(inside.height / 2).clamp(inside.height.min(1), most);
    let lines = (0..FIELDS.len()).map(|at| (field(model, form, at, usize::from(inside.width)), Some(at))).collect();
    // The one after it, too, so that what lies below is seen to be there.
    let last = (form.choice + 2).min(FIELDS.len());
    let from = last.saturating_sub(usize::from(height)).min(form.choice);
    let choices = choices(model, lines, from, Rect { height, ..inside }, buffer);
    (choices, Rect { y: inside.y + height, height: inside.height - height, ..inside })
}

fn field(model: &Model, form: &LoaderForm, at: usize, width: usize) -> Line<'static> {
    let theme = &model.theme;
    let field = &FIELDS[at];
    let chosen = at == form.choice;
    let name = format!("{}{}", if chosen { "> " } else { "  " }, padded(field.name, NAMES));
    if let (true, Some(input)) = (chosen, &form.typing) {
        return typed(model, &name, input, u16::try_from(width).unwrap_or(u16::MAX));
    }
    let told = (field.text)(&form.options);
    let (text, style) = match &told {
        Some(text) => (printable(text), theme.title),
        None => ("detected".to_owned(), theme.dim),
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
