//! The first line: record, channel, size, and how many flags are in which state.

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::text::{Line, Span};
use ratatui::widgets::Widget;

use super::super::chart_data::Picture;
use super::super::model::Model;
use super::super::plot::FlagState;
use super::super::words::plural;
use super::{clear, fit, thousands};
use crate::score::Score;
use crate::track::{Standing, printable};

/// From this many columns on there is room for all words.
const ROOMY: u16 = 100;

pub(super) fn draw(model: &Model, area: Rect, buffer: &mut Buffer) {
    clear(area, buffer);
    let right = right_side(model, area.width);
    let right_width = u16::try_from(right.width()).unwrap_or(u16::MAX).min(area.width);
    let place = Rect { x: area.right() - right_width, width: right_width, ..area };
    right.render(place, buffer);
    let left = Rect { width: area.width - right_width, ..area };
    left_side(model, usize::from(left.width)).render(left, buffer);
}

fn left_side(model: &Model, width: usize) -> Line<'static> {
    let theme = &model.theme;
    let name = printable(&model.track.source.name());
    let channel = printable(&model.plan().channel);
    let (at, of) = (model.shown + 1, model.channels.len());
    let place = if of > 1 { format!(" ({at}/{of})") } else { String::new() };
    let unit = printable(model.channel().unit_beside_name());
    let unit = if unit.is_empty() { unit } else { format!(" [{unit}]") };
    let since = match model.standing {
        Standing::Same | Standing::Grown { rows: 0 } => String::new(),
        Standing::Grown { rows } => format!(" +{} rows", thousands(rows)),
        Standing::Lost(_) => format!(", record {}", model.standing.words().trim_start_matches("was ")),
    };
    let size = format!(" · {} samples{since}", thousands(model.series().len()));
    let fixed = channel.chars().count() + place.len() + 5;
    let room = width.saturating_sub(fixed + unit.chars().count());
    let mut spans = vec![Span::raw(" ")];
    // The channel is what the screen is about; the record's name goes first where there is no room for both.
    if room >= 8 {
        spans.push(Span::styled(fit(&name, room.min(40)), theme.text));
        spans.push(Span::styled(" · ", theme.dim));
    }
    spans.push(Span::styled(format!("{channel}{unit}"), theme.title));
    spans.push(Span::styled(place, theme.dim));
    let used: usize = spans.iter().map(Span::width).sum();
    if used + size.chars().count() < width {
        spans.push(Span::styled(size, theme.dim));
    }
    Line::from(spans)
}

fn right_side(model: &Model, width: u16) -> Line<'static> {
    let (theme, glyphs, state) = (&model.theme, model.glyphs, model.state());
    let mut spans = Vec::new();
    if model.not_journalled.is_some() || model.behind {
        spans.push(Span::styled("not journalled ", theme.error));
    }
    match &state.drawn {
        None if state.error.is_some() => spans.push(Span::styled("no result ", theme.error)),
        None => spans.push(Span::styled("computing … ", theme.warning)),
        Some(drawn) => {
            let counts = drawn.outcome.counts;
            let truth = model.track.truth_for(&model.plan().channel).filter(|_| width >= 80);
            if let Some(score) = truth.and_then(|truth| Picture::of(model, model.shown).score(truth)) {
                let text = truth_words(&score, width);
                spans.push(Span::styled(text, theme.dim));
            }
            spans.push(Span::styled(format!("{} flagged", thousands(counts.flagged)), theme.title));
            let by_state = state.flags.counts();
            for flag in FlagState::BY_URGENCY {
                let n = by_state[flag.index()];
                if n > 0 && !(flag == FlagState::Unreviewed && n == counts.flagged) {
                    // A count has room for a second digit, so that what stands before it seldom moves.
                    let count = format!(" {}{:<2}", glyphs.flag(flag), thousands(n));
                    spans.push(Span::styled(count, theme.flag(flag)));
                }
            }
            if counts.unchecked > 0 {
                spans.push(Span::styled(format!(" {} unchecked", thousands(counts.unchecked)), theme.dim));
            }
            if counts.conflicts > 0 {
                spans.push(Span::styled(format!(" !{}", counts.conflicts), theme.warning));
            }
        }
    }
    // The mark of an old result stands where a blank is without it: the counts stay put while a parameter is turned.
    let old = state.stale && state.drawn.is_some();
    let unsaved = if model.unsaved() { "[+] " } else { "    " };
    spans.push(Span::styled(format!("{}{unsaved}", if old { '…' } else { ' ' }), theme.warning));
    Line::from(spans)
}

/// The score by the truth column, in fewer words where the record's name would have to go for them.
fn truth_words(score: &Score, width: u16) -> String {
    let (missed, alarms) = (score.missed, score.false_alarms);
    if width < ROOMY {
        return format!("{missed} missed, {alarms} false  ");
    }
    format!("truth: {missed} missed, {alarms} false alarm{}  ", plural(alarms))
}
