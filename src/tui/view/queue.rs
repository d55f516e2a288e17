//! The queue: the flags in order, one row for each sample or for each run.

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::text::{Line, Span};
use ratatui::widgets::Widget;

use super::super::action::Panel;
use super::super::layout::queue_rows;
use super::super::model::{Group, Model, Sort, Unit};
use super::super::plot::{FlagState, Glyphs};
use super::super::update::{mark_at, queue};
use super::{NOT_JUDGED, clear, heading, several_days, thousands};
use crate::plot::state;
use crate::session::Counts;
use crate::track::{Series, without_signed_zero};

/// Columns of the rows of a run and of its length.
const ROWS: usize = 17;

/// That nothing is flagged, and of how much that is said.
fn nothing_flagged(counts: Counts) -> String {
    match counts.unchecked {
        0 => "nothing is flagged".into(),
        all if all == counts.present => "no sample could be judged".into(),
        some => format!("nothing is flagged, {} not judged", thousands(some)),
    }
}

/// Draws the queue. `beside_card`: whether the card is on the screen, which says how many flags there are; the queue
/// does not repeat it then, since it would go over the wire twice at each step.
pub(super) fn draw(model: &Model, beside_card: bool, area: Rect, buffer: &mut Buffer) {
    clear(area, buffer);
    let theme = &model.theme;
    let all = &model.state().queue;
    let by = match model.review.sort {
        Sort::Time => "by time",
        Sort::Ratio => "by ratio",
        Sort::State => "by state",
        Sort::Run => "by run",
    };
    let what = if model.review.unit == Unit::Run { "runs" } else { "in all" };
    let count = if beside_card { String::new() } else { format!("{} {what} ", thousands(all.len())) };
    let words = [Span::styled(format!("{by}  {count}"), theme.dim)];
    let mut body = heading(model, Panel::Queue, &words, area, buffer);
    if all.is_empty() {
        let counts = model.state().drawn.as_ref().map(|drawn| drawn.outcome.counts);
        let words = counts.map_or_else(|| NOT_JUDGED.into(), nothing_flagged);
        Line::styled(format!(" {words}"), theme.dim).render(body, buffer);
        return;
    }
    let rows = queue_rows(area);
    let listed = queue::listed(model, rows);
    let series = model.series();
    let days = several_days(model);
    let columns = Columns::of(model, &series, days, body.width >= 52);
    if usize::from(body.height) > rows {
        names(model, queue::goes_on_above(model, &listed), &columns).render(Rect { height: 1, ..body }, buffer);
        body = Rect { y: body.y + 1, height: body.height - 1, ..body };
    }
    for (row, start) in listed.into_iter().enumerate() {
        let single = Group { start, length: 1 };
        let item = match model.review.unit {
            Unit::Sample => single,
            Unit::Run => model.group(start as usize).unwrap_or(single),
        };
        let here = item.positions().contains(&model.state().cursor);
        let line = entry(model, &series, item, here, &columns);
        let row = u16::try_from(row).unwrap_or(u16::MAX);
        line.render(Rect { y: body.y + row, height: 1, ..body }, buffer);
    }
}

/// How wide the columns are, and what is in them: as narrow as the record allows. What stands close together costs
/// less on its way to the terminal, and is easier to read.
struct Columns {
    row: usize,
    time: usize,
    /// Times tell the day.
    days: bool,
    /// Runs have a time.
    wide: bool,
}

impl Columns {
    fn of(model: &Model, series: &Series<'_>, days: bool, wide: bool) -> Self {
        let ends = [0, series.len().saturating_sub(1)];
        let time = ends.map(|i| series.t.get(i).map_or(0, |_| time_text(model, series, i, days).chars().count()));
        let rows = series.len().checked_sub(1).map_or(0, |last| series.row(last) + 1);
        Self { row: rows.to_string().len().max(3), time: time[0].max(time[1]).max(4), days, wide }
    }
}

/// The names of the columns; the arrow says that there are flags above.
fn names(model: &Model, above: bool, columns: &Columns) -> Line<'static> {
    let in_scales = model.state().drawn.as_ref().is_some_and(|d| d.in_scales());
    let unit = if in_scales { "sigma" } else { "ratio" };
    let arrow = match (above, model.glyphs) {
        (false, _) => ' ',
        (true, Glyphs::Unicode) => '↑',
        (true, _) => '^',
    };
    let Columns { row, time, wide, .. } = *columns;
    let text = match model.review.unit {
        Unit::Sample => format!("{arrow} {:>row$}  {:>time$} {unit:>7}", "row", "time"),
        Unit::Run if wide => format!("{arrow}{:>ROWS$}  {:>time$} {unit:>7}", "rows", "time"),
        Unit::Run => format!("{arrow}{:>ROWS$} {unit:>7}", "rows"),
    };
    Line::styled(text, model.theme.dim)
}

/// A row of the panel: a sample, or a run.
fn entry(model: &Model, series: &Series<'_>, item: Group, here: bool, columns: &Columns) -> Line<'static> {
    let theme = &model.theme;
    let marks: Vec<_> = item.positions().filter_map(|i| mark_at(model, i)).collect();
    let states: Vec<FlagState> = marks.iter().filter_map(state).collect();
    let shown = FlagState::BY_URGENCY.into_iter().find(|s| states.contains(s));
    let conflict = marks.iter().any(crate::session::Mark::conflict);
    let residual = |i: usize| model.state().drawn.as_ref().and_then(|d| d.residual(series, i));
    let worst = item.positions().filter_map(residual).max_by(|a, b| a.abs().total_cmp(&b.abs()));
    let ratio = worst.map_or_else(|| "-".to_owned(), ratio_text);
    let first = item.start as usize;
    let &Columns { row, time: width, days, wide } = columns;
    let time = || time_text(model, series, first, days);
    let cursor = if here { '>' } else { ' ' };
    let text = match model.review.unit {
        Unit::Sample => format!("{cursor} {:>row$}  {:>width$} {ratio:>7} ", series.row(first) + 1, time()),
        Unit::Run if wide => {
            format!("{cursor}{:>ROWS$}  {:>width$} {ratio:>7} ", rows_text(model, series, item), time())
        }
        Unit::Run => format!("{cursor}{:>ROWS$} {ratio:>7} ", rows_text(model, series, item)),
    };
    let style = match (here, shown) {
        (true, _) => theme.focus,
        (false, Some(FlagState::Unreviewed | FlagState::ByHand)) => theme.text,
        (false, _) => theme.dim,
    };
    let mark = shown.map_or(theme.dim, |s| theme.flag(s));
    // Without a mark it is one that a parameter has just taken away.
    let glyph = shown.map_or(model.glyphs.gone(), |s| model.glyphs.flag(s));
    let mut spans = vec![Span::styled(text, style), Span::styled(glyph.to_string(), mark)];
    if conflict {
        spans.push(Span::styled("!", theme.warning));
    }
    Line::from(spans)
}

/// The rows of a run, and how many they are.
fn rows_text(model: &Model, series: &Series<'_>, item: Group) -> String {
    let samples = item.positions();
    let (first, last) = (series.row(samples.start) + 1, series.row(samples.end - 1) + 1);
    let times = if model.glyphs == Glyphs::Unicode { '×' } else { 'x' };
    match item.length {
        1 => format!("{first} {times}1"),
        n => {
            let full = format!("{first}..{last} {times}{n}");
            // The length says where it ends.
            if full.chars().count() > ROWS { format!("{first}.. {times}{n}") } else { full }
        }
    }
}

fn time_text(model: &Model, series: &Series<'_>, i: usize, days: bool) -> String {
    match (days, model.track.time.date(series.t[i])) {
        // Month and day, and the minute.
        (true, Some(date)) => {
            let clock = model.track.time.label(series.t[i], 0);
            format!("{} {}", date.get(5..).unwrap_or(&date), clock.get(..5).unwrap_or(&clock))
        }
        _ => model.track.time.label(series.t[i], 1),
    }
}

/// A ratio in seven columns, whatever its size.
pub(super) fn ratio_text(ratio: f64) -> String {
    match ratio.abs() {
        size if size < 1000.0 => without_signed_zero(format!("{ratio:+.1}")),
        size if size < 100_000.0 => format!("{ratio:+.0}"),
        _ => format!("{ratio:+.0e}"),
    }
}
