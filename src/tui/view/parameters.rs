//! Method and parameters: the panel, and the one line that stands in for it.

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::text::{Line, Span};
use ratatui::widgets::Widget;

use super::super::action::Panel;
use super::super::model::{Knob, Model};
use super::super::update::value_text;
use super::{clear, fit, heading, thousands};
use crate::track::printable;

pub(super) fn draw(model: &Model, area: Rect, buffer: &mut Buffer) {
    clear(area, buffer);
    let body = heading(model, Panel::Parameters, &[], area, buffer);
    let theme = &model.theme;
    let knobs = model.knobs();
    let active = model.state().knob.min(knobs.len().saturating_sub(1));
    let notes = notes(model, usize::from(body.width).saturating_sub(1));
    // The last rows are for counts and warnings; the knobs come first, and scroll when they must.
    let height = usize::from(body.height);
    let least = notes.len().min(height / 3);
    let reserved = notes.len().min(height.saturating_sub(knobs.len())).max(least);
    let room = height - reserved;
    let from = (active + 1).saturating_sub(room);
    let setup = &model.plan().setup;
    let shown: Vec<(usize, &Knob)> = knobs.iter().enumerate().skip(from).take(room).collect();
    for (row, (index, knob)) in shown.into_iter().enumerate() {
        let value = printable(&value_text(setup, *knob));
        let changed = match knob {
            Knob::Detection(p) => setup.settings.get(p.key) != Some(p.default),
            Knob::Repair(p) => setup.repair.get(p.key) != Some(p.default),
            Knob::Method | Knob::Rate => false,
        };
        let name_style = if matches!(knob, Knob::Method) || knob.name() == "repair" { theme.title } else { theme.dim };
        let value = if index == active { format!("‹ {value} ›") } else { format!("  {value}") };
        let value_style = if index == active {
            theme.focus
        } else if changed {
            theme.title
        } else {
            theme.text
        };
        let unit = match knob {
            Knob::Detection(p) | Knob::Repair(p) => p.unit,
            Knob::Method | Knob::Rate => "",
        };
        let line = Line::from(vec![
            Span::styled(format!("{:15}", fit(knob.name(), 14)), name_style),
            Span::styled(value, value_style),
            Span::styled(format!(" {unit}"), theme.dim),
        ]);
        put(line, row, body, buffer);
    }
    for (i, (text, warn)) in notes.into_iter().take(reserved).enumerate() {
        let style = if warn { theme.warning } else { theme.dim };
        put(Line::styled(text, style), room + i, body, buffer);
    }
}

fn put(line: Line<'_>, row: usize, body: Rect, buffer: &mut Buffer) {
    let row = u16::try_from(row).unwrap_or(u16::MAX);
    if row < body.height {
        line.render(Rect { y: body.y + row, height: 1, ..body }, buffer);
    }
}

/// Counts, the help of the active knob, and warnings, as rows of at most `width` columns; true for a warning.
fn notes(model: &Model, width: usize) -> Vec<(String, bool)> {
    let mut notes = Vec::new();
    if let Some(drawn) = &model.state().drawn {
        let n = drawn.outcome.counts;
        let share = if n.present > 0 {
            #[expect(clippy::cast_precision_loss, reason = "counts are far below 2^53")]
            let share = 100.0 * n.flagged as f64 / n.present as f64;
            format!(" ({share:.2} %)")
        } else {
            String::new()
        };
        notes.push((String::new(), false));
        notes.push((format!("flagged        {}{share}", thousands(n.flagged)), false));
        notes.push((format!("isolated {}, patches {}", n.isolated, n.patches), false));
        let mut rest = vec![format!("repaired {}, removed {}", n.repaired, n.removed)];
        for (count, word) in [(n.suspects, "suspect"), (n.unchecked, "unchecked"), (n.filled, "filled")] {
            if count > 0 {
                rest.push(format!("{word} {}", thousands(count)));
            }
        }
        notes.extend(wrapped(&rest.join(", "), width).into_iter().map(|line| (line, false)));
        let detection = &drawn.outcome.detection;
        if !detection.judged.restarts.is_empty() {
            notes.push((format!("restarts       {}", detection.judged.restarts.len()), false));
        }
        let mut warnings = detection.setup.method.warnings(&detection.setup.settings);
        warnings.extend(detection.judged.warnings.iter().cloned());
        for warning in warnings {
            notes.extend(wrapped(&warning, width).into_iter().map(|line| (line, true)));
        }
    }
    for note in model.plan().setup.method.notes(&model.plan().setup.settings) {
        notes.extend(wrapped(&note, width).into_iter().map(|line| (line, false)));
    }
    if model.focus == Panel::Parameters
        && let Knob::Detection(p) | Knob::Repair(p) = model.knob()
    {
        notes.push((String::new(), false));
        let paper = p.paper.map_or(String::new(), |v| format!(", paper {v}"));
        let text = format!("{} [{}], default {}{paper}", p.help, p.range(), p.default);
        notes.extend(wrapped(&text, width).into_iter().map(|line| (line, false)));
    }
    notes
}

pub(super) fn wrapped(text: &str, width: usize) -> Vec<String> {
    let mut lines = Vec::new();
    let mut line = String::new();
    for word in text.split_whitespace() {
        if !line.is_empty() && line.chars().count() + 1 + word.chars().count() > width {
            lines.push(std::mem::take(&mut line));
        }
        if !line.is_empty() {
            line.push(' ');
        }
        line.push_str(word);
    }
    lines.push(line);
    lines
}

/// Method and parameters in one line, the active knob always among them.
pub(super) fn one_line(model: &Model, area: Rect, buffer: &mut Buffer) {
    clear(area, buffer);
    let theme = &model.theme;
    let setup = &model.plan().setup;
    let knobs = model.knobs();
    let active = model.state().knob.min(knobs.len().saturating_sub(1));
    let item = |i: usize| {
        let (name, value) = (knobs[i].name(), printable(&value_text(setup, knobs[i])));
        let name = if i == 0 { String::new() } else { format!("{name} ") };
        if i == active { format!("  {name}‹{value}›") } else { format!("  {name}{value}") }
    };
    let width = |i: usize| item(i).chars().count();
    // As many as fit, the first (the method) and the active one before all others.
    let mut shown = vec![0];
    if active > 0 {
        shown.push(active);
    }
    let mut used: usize = shown.iter().map(|i| width(*i)).sum();
    for i in 1..knobs.len() {
        if i != active && used + width(i) + 1 < usize::from(area.width) {
            used += width(i);
            shown.push(i);
        }
    }
    shown.sort_unstable();
    let span = |i: usize| {
        let style = if i == active {
            theme.focus
        } else if i == 0 {
            theme.title
        } else {
            theme.dim
        };
        Span::styled(item(i), style)
    };
    Line::from(shown.into_iter().map(span).collect::<Vec<_>>()).render(area, buffer);
}
