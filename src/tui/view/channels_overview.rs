//! The overview of all channels: a row for each, with its sparkline and its counts.

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::style::Style;
use ratatui::text::{Line, Span};
use ratatui::widgets::Widget;
use unicode_width::{UnicodeWidthChar, UnicodeWidthStr};

use super::super::model::{ChannelsOverview, Model, ReviewState};
use super::super::plot::FlagState;
use super::super::survey::ChannelSummary;
use super::super::words::counted;
use super::overlay::Choice;
use super::queue::ratio_text;
use super::{clear, fit, thousands};
use crate::method::shared::NOISE;
use crate::plot::SparkColumn;
use crate::session::Setup;
use crate::track::printable;

/// From this width on there is room for unit, samples and method.
const WIDE: u16 = 110;

/// How wide the columns are that have no fixed width; nothing where there is no room for one.
#[derive(Debug, Clone, Copy)]
struct Widths {
    name: usize,
    sparkline: usize,
    /// Unit, samples and method.
    more: Option<More>,
}

#[derive(Debug, Clone, Copy)]
struct More {
    unit: usize,
    method: usize,
}

const SAMPLES: usize = 10;
/// Mark of the cursor, of the selection and of what needs review, and a blank.
const MARKS: usize = 4;
const COUNT: usize = 8;
const STATE: usize = 13;
/// Rows that set the widths: a record may have tens of thousands, and every frame measures these.
const MEASURED: usize = 500;

impl Widths {
    fn of(model: &Model, rows: &[usize], width: usize) -> Self {
        let rows = &rows[..rows.len().min(MEASURED)];
        let longest =
            |of: &dyn Fn(usize) -> usize, most: usize| rows.iter().map(|p| of(*p)).max().unwrap_or(0).min(most);
        let unit = |plan: usize| printable(&channel(model, plan).unit).width();
        let method = |plan: usize| method_words(&model.session.plans[plan].setup).width();
        let more = (width >= usize::from(WIDE))
            .then(|| More { unit: longest(&unit, 8).max(4), method: longest(&method, 22).max(6) });
        let fixed = MARKS + 4 * COUNT + STATE + 2 + more.map_or(0, |m| m.unit + m.method + SAMPLES + 2);
        let room = width.saturating_sub(fixed);
        let name = longest(&|plan| printable(&model.session.plans[plan].channel).width(), room / 2).max(7);
        Self { name, sparkline: room.saturating_sub(name).min(64), more }
    }
}

pub(super) fn draw(model: &Model, overview: &ChannelsOverview, area: Rect, buffer: &mut Buffer) -> Vec<Choice> {
    // Messages and keys keep their lines.
    let area = Rect { height: area.height.saturating_sub(2), ..area };
    clear(area, buffer);
    let rows = overview.rows(model);
    title(model, overview, &rows).render(Rect { height: 1, ..area }, buffer);
    let widths = Widths::of(model, &rows, usize::from(area.width));
    let head = Rect { y: area.y + 1, height: 1, ..area };
    Line::styled(heading(widths), model.theme.dim).render(head, buffer);
    let inside = Rect { y: area.y + 2, height: area.height.saturating_sub(2), ..area };
    let at = rows.iter().position(|plan| *plan == overview.plan).unwrap_or(0);
    let from = (at + 1).saturating_sub(usize::from(inside.height));
    let mut choices = Vec::new();
    for (y, (index, &plan)) in (inside.y..inside.bottom()).zip(rows.iter().enumerate().skip(from)) {
        let place = Rect { y, height: 1, ..inside };
        row(model, overview, plan, widths).render(place, buffer);
        choices.push(Choice { place, index });
    }
    choices
}

fn channel(model: &Model, plan: usize) -> &crate::track::Channel {
    &model.track.channels[model.channels[plan].channel]
}

/// The record, how many channels there are, and how many need a person.
fn title(model: &Model, overview: &ChannelsOverview, rows: &[usize]) -> Line<'static> {
    let theme = &model.theme;
    let of = |wanted: fn(ReviewState) -> bool| model.channels.iter().filter(|s| wanted(ReviewState::of(s))).count();
    let (waiting, open) = (of(|s| s == ReviewState::Waiting), of(ReviewState::needs_review));
    let mut spans = vec![
        Span::styled(format!(" {}", fit(&printable(&model.track.source.name()), 40)), theme.text),
        Span::styled(" · ", theme.dim),
        Span::styled(counted(model.channels.len(), "channel"), theme.title),
    ];
    let mut note = |text: String, style: Style| spans.push(Span::styled(format!(" · {text}"), style));
    if waiting > 0 {
        note(format!("{} of {} judged …", model.channels.len() - waiting, model.channels.len()), theme.warning);
    }
    note(format!("{} to review", thousands(open)), if open > 0 { theme.title } else { theme.dim });
    if !overview.selected.is_empty() {
        note(format!("{} selected", thousands(overview.selected.len())), theme.focus);
    }
    let filter = overview.filter.value();
    if overview.filtering || !filter.is_empty() {
        let cursor = if overview.filtering { "_" } else { "" };
        note(format!("/{}{cursor} {}", printable(filter), counted(rows.len(), "row")), theme.focus);
    }
    Line::from(spans)
}

fn heading(widths: Widths) -> String {
    let Widths { name, sparkline, more } = widths;
    let unit = more.map(|m| format!(" {:m$}", "unit", m = m.unit)).unwrap_or_default();
    let samples = more.map(|_| format!("{:>SAMPLES$}", "samples")).unwrap_or_default();
    let method = more.map(|_| "method").unwrap_or_default();
    format!(
        "{:MARKS$}{:name$}{unit} {:sparkline$}{samples}{:>COUNT$}{:>COUNT$}{:>COUNT$}{:>COUNT$} {:STATE$}{method}",
        "", "channel", "", "flagged", "suspect", "uncheck", "worst", "decided"
    )
}

fn row(model: &Model, overview: &ChannelsOverview, plan: usize, widths: Widths) -> Line<'static> {
    let theme = &model.theme;
    let state = &model.channels[plan];
    let here = plan == overview.plan;
    let progress = ReviewState::of(state);
    let style = if here { theme.focus } else { theme.text };
    let selected = if overview.selected.contains(&plan) { '+' } else { ' ' };
    let needs = if progress.needs_review() { model.glyphs.flag(FlagState::Unreviewed) } else { ' ' };
    let name = cut_middle(&printable(&model.session.plans[plan].channel), widths.name);
    let mut spans = vec![
        Span::styled(format!("{}{selected}", if here { '>' } else { ' ' }), style),
        Span::styled(format!("{needs} "), theme.flag(FlagState::Unreviewed)),
        Span::styled(padded(&name, widths.name), style),
    ];
    if let Some(more) = widths.more {
        let unit = fit(&printable(&channel(model, plan).unit), more.unit);
        spans.push(Span::styled(format!(" {}", padded(&unit, more.unit)), theme.dim));
    }
    spans.push(Span::raw(" "));
    match &state.summary {
        Some(Ok(summary)) => {
            let dim = state.summary_stale;
            spans.extend(sparkline(model, &summary.sparkline.columns(widths.sparkline), widths.sparkline, dim));
            let plain = if dim { theme.dim } else { theme.text };
            counts(model, summary, widths, plain, &mut spans);
            spans.push(Span::styled(format!(" {}", padded(&decided(progress, summary), STATE)), plain));
        }
        Some(Err(why)) => {
            let room = widths.sparkline + 4 * COUNT + STATE + 1 + widths.more.map_or(0, |_| SAMPLES);
            spans.push(Span::styled(padded(&fit(why, room), room), theme.error));
        }
        None => {
            let room = widths.sparkline + 4 * COUNT + STATE + 1 + widths.more.map_or(0, |_| SAMPLES);
            spans.push(Span::styled(padded("…", room), theme.dim));
        }
    }
    if let Some(more) = widths.more {
        spans.push(Span::styled(fit(&method_words(&model.session.plans[plan].setup), more.method), theme.dim));
    }
    Line::from(spans)
}

/// The numbers of a row. A zero is dim: what matters stands out.
fn counts(model: &Model, summary: &ChannelSummary, widths: Widths, plain: Style, spans: &mut Vec<Span<'static>>) {
    let theme = &model.theme;
    let c = &summary.counts;
    if widths.more.is_some() {
        spans.push(Span::styled(format!("{:>SAMPLES$}", thousands(c.present)), theme.dim));
    }
    for (count, strong) in [
        (c.flagged, theme.flag(FlagState::Unreviewed)),
        (c.suspects, theme.flag(FlagState::Suspect)),
        (c.unchecked, plain),
    ] {
        let (text, style) = if count == 0 { ("·".to_owned(), theme.dim) } else { (thousands(count), strong) };
        let text =
            if text == "·" && model.glyphs != super::super::plot::Glyphs::Unicode { "-".to_owned() } else { text };
        spans.push(Span::styled(format!("{text:>COUNT$}"), style));
    }
    let worst = summary.worst.map(ratio_text).map(|text| text.trim_start_matches('+').to_owned()).unwrap_or_default();
    spans.push(Span::styled(format!("{worst:>COUNT$}"), plain));
}

/// How far the review is.
fn decided(progress: ReviewState, summary: &ChannelSummary) -> String {
    match progress {
        ReviewState::NothingFlagged => "no flags".to_owned(),
        ReviewState::Done => format!("all of {}", thousands(summary.to_decide())),
        _ => format!("{} of {}", thousands(summary.decided()), thousands(summary.to_decide())),
    }
}

/// A record in one row of cells: its level, or the flag of a column in which something is flagged.
fn sparkline(model: &Model, columns: &[SparkColumn], width: usize, dim: bool) -> Vec<Span<'static>> {
    let theme = &model.theme;
    let mut spans: Vec<Span<'static>> = columns
        .iter()
        .map(|column| match (column.flag, column.level) {
            (Some(flag), _) => Span::styled(model.glyphs.flag(flag).to_string(), theme.flag(flag)),
            (None, Some(level)) => {
                Span::styled(model.glyphs.level(level).to_string(), if dim { theme.dim } else { theme.raw })
            }
            (None, None) => Span::raw(" "),
        })
        .collect();
    spans.push(Span::raw(" ".repeat(width.saturating_sub(columns.len()))));
    spans
}

/// The method, its multiplier, and what its limit comes from where that is not the record.
fn method_words(setup: &Setup) -> String {
    let about = setup.method.about();
    let value = |key: &str| setup.settings.mattering().find(|(p, _)| p.key == key).map(|(_, v)| v.to_string());
    let multiplier = ["k", "c"].iter().find_map(|key| value(key).map(|v| format!(" {key} {v}")));
    let floor = value("floor").filter(|floor| floor != NOISE).map(|floor| format!(" {floor}"));
    format!("{}{}{}", about.id, multiplier.unwrap_or_default(), floor.unwrap_or_default())
}

fn padded(text: &str, width: usize) -> String {
    format!("{text}{}", " ".repeat(width.saturating_sub(text.width())))
}

/// A text cut in its middle: names differ at their ends as often as at their beginnings.
fn cut_middle(text: &str, width: usize) -> String {
    if text.width() <= width {
        return text.to_owned();
    }
    let keep = |chars: &mut dyn Iterator<Item = char>, room: usize| {
        let mut used = 0;
        chars
            .take_while(|c| {
                used += c.width().unwrap_or(0);
                used <= room
            })
            .collect::<Vec<char>>()
    };
    let room = width.saturating_sub(1);
    let front: String = keep(&mut text.chars(), room - room / 2).into_iter().collect();
    let back: String = keep(&mut text.chars().rev(), room / 2).into_iter().rev().collect();
    format!("{front}…{back}")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_cut_in_the_middle() {
        assert_eq!(cut_middle("alt_ft@4CA1B2", 13), "alt_ft@4CA1B2");
        assert_eq!(cut_middle("geoaltitude_ft@4CA1B2", 12), "geoalt…CA1B2");
        assert_eq!(cut_middle("温度温度温度", 7), "温…度");
    }
}
