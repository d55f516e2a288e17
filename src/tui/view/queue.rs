//! The queue: the flags in order, the current one in the middle.

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::text::{Line, Span};
use ratatui::widgets::Widget;

use super::super::action::Panel;
use super::super::model::{Model, Sort};
use super::super::plot::FlagState;
use super::super::update::mark_at;
use super::{clear, heading, several_days, thousands};
use crate::plot::state;

pub(super) fn draw(model: &Model, area: Rect, buffer: &mut Buffer) {
    clear(area, buffer);
    let theme = &model.theme;
    let queue = &model.state().queue;
    let by = match model.sort {
        Sort::Time => "by time",
        Sort::Ratio => "by ratio",
        Sort::State => "by state",
    };
    let words = [Span::styled(format!("{by}  {} in all ", thousands(queue.len())), theme.dim)];
    let mut body = heading(model, Panel::Queue, &words, area, buffer);
    if queue.is_empty() {
        Line::styled(" nothing is flagged", theme.dim).render(body, buffer);
        return;
    }
    if body.height >= 6 {
        let in_scales = model.state().drawn.as_ref().is_some_and(|d| d.in_scales());
        let unit = if in_scales { "scales" } else { "ratio" };
        Line::styled(format!(" {:>9}  {:>11} {unit:>7}", "row", "time"), theme.dim)
            .render(Rect { height: 1, ..body }, buffer);
        body = Rect { y: body.y + 1, height: body.height - 1, ..body };
    }
    let cursor = model.state().cursor;
    let current = if model.sort == Sort::Time {
        queue.partition_point(|&p| (p as usize) < cursor).min(queue.len() - 1)
    } else {
        queue.iter().position(|&p| p as usize == cursor).unwrap_or(0)
    };
    let rows = usize::from(body.height);
    let from = current.saturating_sub(rows / 2).min(queue.len().saturating_sub(rows));
    let series = model.series();
    for (row, &position) in queue.iter().skip(from).take(rows).enumerate() {
        let i = position as usize;
        let here = i == cursor;
        let shown = mark_at(model, i).as_ref().and_then(state);
        let ratio = model.state().drawn.as_ref().and_then(|d| d.residual(&series, i));
        let ratio = ratio.map_or_else(|| "-".to_owned(), ratio_text);
        let time = match (several_days(model), model.track.time.date(series.t[i])) {
            // Month and day, and the minute.
            (true, Some(date)) => {
                let clock = model.track.time.label(series.t[i], 0);
                format!("{} {}", date.get(5..).unwrap_or(&date), clock.get(..5).unwrap_or(&clock))
            }
            _ => model.track.time.label(series.t[i], 1),
        };
        let glyph = shown.map_or(' ', |s| model.glyphs.flag(s));
        let text = format!("{}{:>9}  {time:>11} {ratio:>7} ", if here { '>' } else { ' ' }, series.row(i) + 1);
        let style = match (here, shown) {
            (true, _) => theme.focus,
            (false, Some(FlagState::Unreviewed | FlagState::ByHand)) => theme.text,
            (false, _) => theme.dim,
        };
        let mark = shown.map_or(theme.dim, |s| theme.flag(s));
        let line = Line::from(vec![Span::styled(text, style), Span::styled(glyph.to_string(), mark)]);
        let row = u16::try_from(row).unwrap_or(u16::MAX);
        line.render(Rect { y: body.y + row, height: 1, ..body }, buffer);
    }
}

/// A ratio in seven columns, whatever its size.
pub(super) fn ratio_text(ratio: f64) -> String {
    match ratio.abs() {
        size if size < 1000.0 => format!("{ratio:+.1}"),
        size if size < 100_000.0 => format!("{ratio:+.0}"),
        _ => format!("{ratio:+.0e}"),
    }
}
