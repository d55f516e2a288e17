//! The card: what there is to know about the sample under the cursor.

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::text::{Line, Span};
use ratatui::widgets::Widget;

use super::super::action::{Action, Panel};
use super::super::model::{Model, Unit};
use super::super::plot::{FlagState, Glyphs};
use super::super::smoothing::Smoothed;
use super::super::update::mark_at;
use super::queue::ratio_text;
use super::{NOT_JUDGED, clear, compare, fit, heading, several_days, short};
use crate::method::{Direction, Verdict};
use crate::plot::{Drawn, state};
use crate::review::Decision;
use crate::score::SplineResidual;
use crate::session::{Mark, signature_words};
use crate::track::{Series, printable};

mod whole;

/// Columns of a note in the heading.
const NOTE: usize = 44;

pub(super) fn draw(model: &Model, area: Rect, buffer: &mut Buffer) {
    clear(area, buffer);
    let series = model.series();
    let cursor = model.state().cursor;
    let mark = mark_at(model, cursor);
    let words = heading_words(model, mark.as_ref());
    let body = heading(model, Panel::Card, &words, area, buffer);
    if cursor >= series.len() {
        Line::styled(" no sample has both a time and a value", model.theme.dim).render(body, buffer);
        return;
    }
    if body.height >= whole::LEAST {
        whole::draw(model, &series, mark.as_ref(), body, buffer);
        return;
    }
    let narrow = area.width < 100;
    let width = usize::from(area.width);
    let mut lines = vec![
        whole_pieces(measured(model, &series, cursor, narrow), width),
        whole_pieces(judged(model, &series, cursor, mark.as_ref(), narrow), width),
        neighbours(model, &series, cursor, width),
        remarks(model, &series, cursor, mark.as_ref()),
    ];
    // What all methods say goes before the neighbours.
    lines.splice(2..2, compare::votes(model, cursor, area.width));
    // Where there is room for two lines, the neighbours go first, then the remarks.
    for (i, line) in lines.into_iter().enumerate() {
        let i = u16::try_from(i).unwrap_or(0);
        if i < body.height {
            line.render(Rect { y: body.y + i, height: 1, ..body }, buffer);
        }
    }
}

/// As many of the pieces as there is room for, each whole: half a number reads as another one.
fn whole_pieces(pieces: Vec<Vec<Span<'static>>>, width: usize) -> Line<'static> {
    let mut room = width;
    let fits = |piece: &Vec<Span<'static>>| {
        let wide = piece.iter().map(Span::width).sum::<usize>();
        let fits = wide <= room;
        room -= if fits { wide } else { room };
        fits
    };
    Line::from(pieces.into_iter().take_while(fits).flatten().collect::<Vec<_>>())
}

/// Which flag of how many, and its state.
fn heading_words(model: &Model, mark: Option<&Mark>) -> Vec<Span<'static>> {
    let theme = &model.theme;
    let state_of = mark.and_then(state);
    let queue = &model.state().queue;
    // In a queue of runs, the run is what has a place.
    let head = |m: &Mark| match model.review.unit {
        Unit::Run => model.group(m.position as usize).map_or(m.position, |g| g.start),
        Unit::Sample => m.position,
    };
    let at = mark.map(head).and_then(|head| queue.iter().position(|p| *p == head));
    let place = match at {
        Some(at) => format!("{} of {}  ", at + 1, queue.len()),
        None if model.state().drawn.is_none() => format!("{NOT_JUDGED}  "),
        None => format!("none here, {} in all  ", queue.len()),
    };
    let mut spans = vec![Span::styled(place, theme.dim)];
    if let Some(state) = state_of {
        let word = format!("{} {}  ", model.glyphs.flag(state), state_word(state));
        spans.push(Span::styled(word, theme.flag(state)));
    }
    if mark.is_some_and(Mark::conflict) {
        spans.push(Span::styled("! contradicts the method  ", theme.warning));
    }
    if let Some(who) = compare::who(model, model.state().cursor) {
        spans.push(Span::styled(format!("{who}  "), theme.title));
    }
    if let Some(words) = why(model) {
        spans.push(Span::styled(format!("{}  ", fit(&words, NOTE)), theme.dim));
    }
    // That of the result before stays, marked as old, until the new one has come: numbers that go and come again are
    // sent twice.
    if let Some(residual) = model.state().smoothed.as_ref().and_then(|smoothed| smoothed.residual) {
        let old = if Smoothed::of(model).is_some() { ' ' } else { '…' };
        spans.push(Span::styled(format!("{}{old} ", residual_words(model, &residual)), theme.dim));
    }
    if model.review.unit == Unit::Run {
        spans.push(Span::styled("run by run  ", theme.title));
    }
    if !model.review.auto_advance {
        spans.push(Span::styled("auto-advance off  ", theme.title));
    }
    spans
}

/// The residual of eq. (2) of \[000\] before the repair and after it.
fn residual_words(model: &Model, residual: &SplineResidual) -> String {
    let arrow = if model.glyphs == Glyphs::Unicode { "→" } else { "->" };
    format!("residual {} {arrow} {}", rounded(residual.before), rounded(residual.after))
}

/// Who has decided on the sample under the cursor, and why; none where nobody has.
fn why(model: &Model) -> Option<String> {
    let row = model.series().row_of(model.state().cursor).and_then(|r| u32::try_from(r).ok())?;
    if let Some((_, _, note)) = model.review.waiting.as_ref().filter(|(p, r, _)| (*p, *r) == (model.shown, row)) {
        return Some(format!("note for the next decision: {}", printable(note)));
    }
    let decision = model.plan().decisions.get(row)?;
    let note = printable(&decision.note);
    let who = decided_by(decision);
    Some(if note.is_empty() { who } else { format!("{who}: {note}") })
}

/// By whom and when a decision was made, as far as the session knows.
fn decided_by(decision: &Decision) -> String {
    let who = signature_words(&decision.signature).unwrap_or_else(|| "the analyst".into());
    format!("by {}", printable(&who))
}

pub(super) fn state_word(state: FlagState) -> &'static str {
    match state {
        FlagState::Unreviewed => "undecided",
        FlagState::Accepted => "accepted",
        FlagState::Rejected => "rejected",
        FlagState::ByHand => "by hand",
        FlagState::Suspect => "suspect",
    }
}

/// Row, time, raw value, expected value, tolerance, ratio.
fn measured(model: &Model, series: &Series<'_>, i: usize, narrow: bool) -> Vec<Vec<Span<'static>>> {
    let theme = &model.theme;
    let full = model.track.time.full_label(series.t[i]);
    // On a narrow screen the date has to go, unless the record has several.
    let time = match (narrow, full.split_once(' ')) {
        (true, Some((_, rest))) if model.track.time.date(0.0).is_some() && !several_days(model) => {
            rest.trim_end_matches(" UTC").to_owned()
        }
        (true, _) => full.trim_end_matches(" UTC").to_owned(),
        _ => full,
    };
    let mut pieces = vec![
        vec![Span::styled(format!(" #{} ", series.row(i) + 1), theme.title)],
        vec![Span::styled(format!(" {time} "), theme.text)],
    ];
    let mut item = |name: &str, value: String| {
        pieces.push(vec![Span::styled(format!("  {name} "), theme.dim), Span::styled(value, theme.text)]);
    };
    item("raw", short(series.y[i]));
    if let Some(drawn) = &model.state().drawn {
        let judged = &drawn.outcome.detection.judged;
        match judged.expected().get(i) {
            Some(p) if p.is_finite() => {
                let p = drawn.outcome.detection.written(*p);
                item(if narrow { "exp" } else { "expected" }, short(p));
            }
            _ => item("expected", "none".into()),
        }
        if let Some(h) = judged.tolerance(i).filter(|h| *h > 0.0) {
            item(if model.glyphs == Glyphs::Unicode { "±" } else { "+-" }, rounded(h));
        }
        if let Some(ratio) = drawn.ratio(series, i) {
            item("ratio", ratio_text(ratio));
        }
    }
    pieces
}

/// A tolerance in four digits, more than it is good for: always as many, so that what follows stays where it is.
fn rounded(tolerance: f64) -> String {
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a few digits")]
    match tolerance.log10().floor() {
        power @ -4.0..10.0 => format!("{tolerance:.*}", (3.0 - power).max(0.0) as usize),
        _ => short(tolerance),
    }
}

/// What method and analyst say, and what will be written.
fn judged(model: &Model, series: &Series<'_>, i: usize, mark: Option<&Mark>, narrow: bool) -> Vec<Vec<Span<'static>>> {
    let theme = &model.theme;
    let Some(drawn) = &model.state().drawn else { return Vec::new() };
    let judged = &drawn.outcome.detection.judged;
    let verdict = judged.verdict().get(i).copied().unwrap_or(Verdict::Missing);
    // In fewer words where they would run out of the panel: half a word looks like a whole one.
    let says = if narrow { ":" } else { " says" };
    let method = format!("  {}{says} {}", drawn.outcome.detection.by(i), verdict.word());
    let mut said = vec![method];
    if let Some(objected) = drawn.outcome.detection.objected(i) {
        said.push(format!(": {}", objected.evidence));
    }
    if let Some(d) = judged.directions().get(i) {
        let (forth, back) = if narrow { ("fwd", "bwd") } else { ("forward", "backward") };
        let both = [(forth, d.forward), (back, d.backward)];
        let words: Vec<String> = if d.forward == d.backward {
            d.forward.map(|d| format!("both ways {}", Direction::word(d))).into_iter().collect()
        } else {
            both.iter().filter_map(|(name, d)| d.map(|d| format!("{name} {}", Direction::word(d)))).collect()
        };
        if !words.is_empty() {
            let words = words.join(", ");
            said.push(if narrow { format!(", {words}") } else { format!(": {words}") });
        }
    }
    if let Some(run) = drawn.outcome.run(i) {
        match run.length {
            1 => said.push("  isolated".into()),
            n if narrow => said.push(format!("  run {}/{n}", i - run.start + 1)),
            n => said.push(format!("  {} of a run of {n}", i - run.start + 1)),
        }
    }
    let outcome = written(model, drawn, series, i, mark, narrow);
    let outcome = vec![Span::styled(format!(" → {outcome}"), theme.text)];
    let said = said.into_iter().map(|text| vec![Span::styled(text, theme.dim)]);
    std::iter::once(outcome).chain(said).collect()
}

/// What the cleaned file will have.
fn written(model: &Model, drawn: &Drawn, series: &Series<'_>, i: usize, mark: Option<&Mark>, narrow: bool) -> String {
    let wild = mark.map_or(Verdict::Normal, Mark::effective) == Verdict::Outlier;
    match drawn.outcome.fix(i) {
        Some(fix) if wild && fix.is_finite() => {
            format!("repaired to {}", short(model.track.rounded(model.channel(), fix)))
        }
        Some(_) if wild && narrow => "removed, empty".into(),
        Some(_) if wild => "removed, the cell stays empty".into(),
        _ if wild => "…".into(),
        _ => format!("kept as {}", short(series.y[i])),
    }
}

/// The values around, as many on each side as there is room for.
fn neighbours(model: &Model, series: &Series<'_>, i: usize, width: usize) -> Line<'static> {
    let all = (0..=3).rev().map(|reach| around(model, series, i, reach));
    all.into_iter().find(|line| line.width() <= width).unwrap_or_default()
}

/// This many values on each side.
fn around(model: &Model, series: &Series<'_>, i: usize, reach: usize) -> Line<'static> {
    let theme = &model.theme;
    let mut spans = vec![Span::styled(" neighbours", theme.dim)];
    let first = i.saturating_sub(reach);
    for k in first..(i + reach + 1).min(series.len()) {
        if k > first && series.lost_before(k) > 0 {
            spans.push(Span::styled(format!("  ({} lost)", series.lost_before(k)), theme.dim));
        }
        let value = short(series.y[k]);
        if k == i {
            spans.push(Span::styled(format!("  [{value}]"), theme.title));
        } else {
            let style = mark_at(model, k).as_ref().and_then(state).map_or(theme.text, |s| theme.flag(s));
            spans.push(Span::styled(format!("  {value}"), style));
        }
    }
    Line::from(spans)
}

/// The note, and where a model was started again.
fn remarks(model: &Model, series: &Series<'_>, i: usize, mark: Option<&Mark>) -> Line<'static> {
    let theme = &model.theme;
    let mut spans = Vec::new();
    if mark.is_some_and(|m| m.ruling.is_some()) {
        let row = u32::try_from(series.row(i)).unwrap_or(u32::MAX);
        let decision = model.plan().decisions.get(row);
        let note = decision.map(|d| d.note.clone()).unwrap_or_default();
        let who = decision.map_or_else(|| "by the analyst".into(), decided_by);
        let note = if note.is_empty() {
            format!("no note ({} writes one)", model.key(Action::Note))
        } else {
            format!("note: {}", printable(&note))
        };
        spans.push(Span::styled(format!(" decided {who}  {note}"), theme.dim));
    }
    if let Some(drawn) = &model.state().drawn {
        let restarts = drawn.outcome.detection.judged.restarts();
        if restarts.iter().any(|r| r.at == i) {
            let text = " the model restarted here: a manoeuvre, or a long run of outliers";
            spans.push(Span::styled(text, theme.warning));
        }
    }
    Line::from(spans)
}
