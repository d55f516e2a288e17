//! Drawing: the model in, cells out. Nothing is changed here.

use ratatui::Frame;
use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::style::Style;
use ratatui::text::{Line, Span};
use ratatui::widgets::Widget;

use super::action::{Action, Panel};
use super::layout::{self, LEAST};
use super::model::{Model, Overlay, Tone};
use super::update::journal::not_journalled;
use super::words;
use crate::track::without_signed_zero;

mod card;
mod channels_overview;
mod compare;
mod detectability;
mod files;
mod footer;
mod help;
mod journal;
mod merge;
pub(super) mod overlay;
mod palette;
pub(super) mod parameters;
mod plain;
mod plots;
mod queue;
mod reasons;
mod recover;
mod second;
mod secondary_chart;
mod title;

/// What panels say that need a result while there is none: nothing flagged would be an answer.
const NOT_JUDGED: &str = "not judged yet";

/// Draws the workbench.
pub fn view(model: &Model, frame: &mut Frame<'_>) {
    let area = frame.area();
    draw(model, area, frame.buffer_mut());
}

/// Draws the workbench into a buffer.
pub fn draw(model: &Model, area: Rect, buffer: &mut Buffer) {
    draw_panels(model, area, buffer);
    plain::restrict(model.glyphs, area, buffer);
}

fn draw_panels(model: &Model, area: Rect, buffer: &mut Buffer) {
    let Some(areas) = layout::arrange(model, area) else {
        too_small(model, area, buffer);
        return;
    };
    title::draw(model, areas.title, buffer);
    let plots = plots::Plots::new(model);
    if let Some(area) = areas.overview {
        plots.overview(area, buffer);
    }
    if let Some(area) = areas.trace {
        plots.trace(area, buffer);
    }
    if let Some(area) = areas.second {
        plots.second(area, buffer);
    }
    if let Some(area) = areas.residual {
        plots.lower(area, buffer);
    }
    if let Some(area) = areas.voters {
        compare::voters(model, area, buffer);
    }
    if let Some(area) = areas.card {
        card::draw(model, area, buffer);
    }
    if let Some(area) = areas.knobs {
        parameters::one_line(model, area, buffer);
    }
    // Where there is no column for them, they are a drawer over the plots.
    let place =
        |area: Rect, buffer: &mut Buffer| if areas.knobs.is_some() { drawer(model, area, buffer) } else { area };
    if let Some(area) = areas.parameters {
        parameters::draw(model, place(area, buffer), buffer);
    }
    if let Some(area) = areas.queue {
        queue::draw(model, areas.card.is_some(), place(area, buffer), buffer);
    }
    toast(model, areas.toast, buffer);
    footer::draw(model, areas.footer, buffer);
    if !matches!(model.overlay, Overlay::None) {
        overlay::draw(model, area, buffer);
    }
}

/// Sets a drawer off from what lies below it; gives its inside.
fn drawer(model: &Model, area: Rect, buffer: &mut Buffer) -> Rect {
    clear(area, buffer);
    let edge = if model.glyphs == super::plot::Glyphs::Unicode { '│' } else { '|' };
    for y in area.top()..area.bottom() {
        buffer[(area.x, y)].set_char(edge).set_style(reset(model.theme.focus));
    }
    layout::drawer(area)
}

fn too_small(model: &Model, area: Rect, buffer: &mut Buffer) {
    let Rect { width, height, .. } = area;
    let text = format!("terminal too small ({width}x{height}), need {}x{}", LEAST.0, LEAST.1);
    for (i, words) in [text.as_str(), "q quits"].into_iter().enumerate() {
        let row = Rect { y: area.y + u16::try_from(i).unwrap_or(0), height: 1, ..area };
        if row.y < area.bottom() {
            Line::styled(words, model.theme.warning).render(row, buffer);
        }
    }
}

/// What the program says, or the job it is about.
fn toast(model: &Model, area: Rect, buffer: &mut Buffer) {
    let theme = &model.theme;
    let line = if let Some(toast) = &model.toast {
        let style = match toast.tone {
            Tone::Done => theme.ok,
            Tone::Warning => theme.warning,
            Tone::Error => theme.error,
        };
        said(&toast.text, style)
    } else if let Some(error) = &model.state().error {
        said(error, theme.error)
    } else if let Some(why) = &model.not_journalled {
        said(&not_journalled(why), theme.error)
    } else if let Some(range) = model.selection() {
        said(&range_words(model, &range), theme.focus)
    } else if let Some(warning) = doubts(model) {
        said(&warning, theme.warning)
    } else {
        Line::default()
    };
    clear(area, buffer);
    // What does not fit goes on upwards: its end is the way out.
    let width = usize::from(area.width).saturating_sub(2).max(1);
    let style = line.spans.first().map(|s| s.style).unwrap_or_default();
    let text: String = line.spans.iter().map(|s| s.content.as_ref()).collect();
    let lines = parameters::wrapped(&text, width);
    let most = usize::from(area.y).min(usize::from(area.y / 2).max(4));
    for (up, text) in lines.iter().take(most.max(1)).rev().enumerate() {
        let row = Rect { y: area.y - u16::try_from(up).unwrap_or(0), ..area };
        clear(row, buffer);
        said(text, style).render(row, buffer);
    }
}

/// What is selected, and what can be done with it.
fn range_words(model: &Model, range: &std::ops::Range<usize>) -> String {
    let series = model.series();
    let (first, last) = (series.row(range.start) + 1, series.row(range.end - 1) + 1);
    let flags = super::update::decide::flags_in(model, range).len();
    let count = |n: usize, noun: &str| format!("{} {noun}{}", thousands(n), words::plural(n));
    let counts = format!("{}, {}", count(range.len(), "sample"), count(flags, "flag"));
    let (keys, back) = (words::of_range(&model.keys), words::key(&model.keys, Action::Back));
    format!("rows {first} to {last}: {counts} · {keys}, {back} leaves")
}

/// What of the result should be looked at before it is trusted; otherwise why nothing is flagged, where the settings do
/// not allow it. (Where there is a panel for the settings, it says so too; the line is for screens without.)
fn doubts(model: &Model) -> Option<String> {
    let outcome = &model.state().drawn.as_ref()?.outcome;
    if !outcome.doubts.is_empty() {
        return Some(outcome.doubts.join(" · "));
    }
    (outcome.counts.flagged == 0).then(|| outcome.warnings().into_iter().next())?
}

/// Words of the program. The style ends with them: styled blanks up to the edge would go over the wire each time.
fn said(text: &str, style: Style) -> Line<'static> {
    Line::from(Span::styled(format!(" {}", crate::track::printable(text)), style))
}

/// A heading: a rule with the name of a panel, its digit, and a few words.
fn heading(model: &Model, panel: Panel, words: &[Span<'_>], area: Rect, buffer: &mut Buffer) -> Rect {
    heading_named(model, panel, panel.name(), words, area, buffer)
}

/// The heading of a panel that goes by several names.
fn heading_named(model: &Model, panel: Panel, name: &str, words: &[Span<'_>], area: Rect, buffer: &mut Buffer) -> Rect {
    let theme = &model.theme;
    let focused = model.focus == panel;
    let style = if focused { theme.focus } else { theme.title };
    let mut spans = vec![
        Span::styled(format!("{} ", rule_glyph(model)), theme.dim),
        Span::styled(format!("{} {name}", panel.digit()), style),
        Span::raw(" "),
    ];
    // Words that do not fit are left out whole: a number cut short reads as another number.
    let mut room = usize::from(area.width).saturating_sub(spans.iter().map(Span::width).sum::<usize>() + 1);
    for word in words {
        let width = word.content.trim_end().chars().count();
        if width <= room {
            room = room.saturating_sub(word.width());
            spans.push(word.clone());
        }
    }
    rule(model, spans, area, buffer);
    Rect { y: area.y + 1, height: area.height.saturating_sub(1), ..area }
}

/// A row that starts with `spans` and goes on as a rule.
fn rule(model: &Model, spans: Vec<Span<'_>>, area: Rect, buffer: &mut Buffer) {
    let area = Rect { height: area.height.min(1), ..area };
    if area.height == 0 {
        return;
    }
    let glyph = rule_glyph(model);
    for x in area.left()..area.right() {
        buffer[(x, area.y)].set_char(glyph).set_style(reset(model.theme.dim));
    }
    let mut line = Line::from(spans);
    line.spans.push(Span::raw(" "));
    let width = u16::try_from(line.width()).unwrap_or(u16::MAX).min(area.width);
    for x in area.left()..area.left() + width {
        buffer[(x, area.y)].reset();
    }
    line.render(area, buffer);
}

fn rule_glyph(model: &Model) -> char {
    if model.glyphs == super::plot::Glyphs::Unicode { '─' } else { '-' }
}

/// The style with nothing left of what a cell had before.
fn reset(style: Style) -> Style {
    Style::reset().patch(style)
}

/// Blanks an area, the left half of wide characters that reach into it too.
fn clear(area: Rect, buffer: &mut Buffer) {
    ratatui::widgets::Clear.render(area, buffer);
    if area.x == 0 {
        return;
    }
    for y in area.top()..area.bottom() {
        let cell = &mut buffer[(area.x - 1, y)];
        if unicode_width::UnicodeWidthStr::width(cell.symbol()) > 1 {
            cell.set_symbol(" ");
        }
    }
}

/// Text cut to a width, with an ellipsis where something is left out.
fn fit(text: &str, width: usize) -> String {
    use unicode_width::{UnicodeWidthChar, UnicodeWidthStr};
    if text.width() <= width {
        return text.to_owned();
    }
    let mut out = String::new();
    let mut used = 0;
    for c in text.chars() {
        let w = c.width().unwrap_or(0);
        if used + w + 1 > width {
            break;
        }
        out.push(c);
        used += w;
    }
    if width > 0 {
        out.push('…');
    }
    out
}

/// True when times of day alone would not tell the samples of the record apart.
fn several_days(model: &Model) -> bool {
    let series = model.series();
    let date = |t: Option<&f64>| t.and_then(|t| model.track.time.date(*t));
    date(series.t.first()) != date(series.t.last())
}

/// A whole number with thousands set apart.
fn thousands(n: usize) -> String {
    let digits = n.to_string();
    let mut out = String::new();
    for (i, c) in digits.chars().enumerate() {
        if i > 0 && (digits.len() - i).is_multiple_of(3) {
            out.push(',');
        }
        out.push(c);
    }
    out
}

/// A value on the screen: about seven significant digits.
fn short(x: f64) -> String {
    if !x.is_finite() {
        return "-".into();
    }
    let size = x.abs();
    if size != 0.0 && !(1e-4..1e10).contains(&size) {
        return format!("{x:.5e}");
    }
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "clamped to small digits")]
    let digits = if size < 1.0 { 6 } else { (6.0 - size.log10().floor()).clamp(0.0, 6.0) as usize };
    let text = format!("{x:.digits$}");
    let text = if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.').to_owned() } else { text };
    without_signed_zero(text)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_and_texts_are_cut_to_what_people_read() {
        assert_eq!(["1,234,567", "999", "0"], [1_234_567, 999, 0].map(thousands).each_ref().map(String::as_str));
        assert_eq!(short(-3.870_912_345), "-3.870912");
        assert_eq!(short(30975.0), "30975");
        assert_eq!([short(-0.0), short(-0.5)], ["0", "-0.5"]);
        assert_eq!(short(4.94e13), "4.94000e13");
        assert_eq!(fit("abcdef", 4), "abc…");
        assert_eq!(fit("ab", 4), "ab");
    }
}
