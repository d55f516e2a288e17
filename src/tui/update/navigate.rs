//! Moving around: what is in view, and the cursor.

use super::super::action::Action;
use super::super::layout;
use super::super::message::Effect;
use super::super::model::{Model, Tone};
use super::super::plot::View;

/// Zooming in stops at so few nominal intervals across the plot.
const NARROWEST: f64 = 6.0;

/// Samples on each side of a run that `z` shows.
const AROUND_RUN: usize = 20;

/// How many views `Z` can go back.
const VIEWS_KEPT: usize = 50;

pub(super) fn act(model: &mut Model, action: Action) -> Option<Vec<Effect>> {
    match action {
        Action::PanLeft => pan(model, -0.1),
        Action::PanRight => pan(model, 0.1),
        Action::PanLeftFar => pan(model, -0.5),
        Action::PanRightFar => pan(model, 0.5),
        Action::ZoomIn => zoom(model, 0.5),
        Action::ZoomOut => zoom(model, 2.0),
        Action::FitAll => {
            let whole = model.whole();
            look(model, whole);
        }
        Action::ZoomFlag => zoom_flag(model),
        Action::PreviousView => match model.state_mut().views.pop() {
            Some(view) => model.state_mut().view = view,
            None => model.say(Tone::Warning, "no earlier view"),
        },
        Action::NextSample => walk(model, true),
        Action::PreviousSample => walk(model, false),
        Action::First => go_to(model, 0),
        Action::Last => go_to(model, usize::MAX),
        _ => return None,
    }
    Some(Vec::new())
}

/// The nominal interval in units of x.
fn nominal_step(model: &Model) -> f64 {
    if model.by_number { 1.0 } else { model.series().interval }
}

/// Shows another part of the record; `Z` leads back.
fn look(model: &mut Model, view: View) {
    let state = model.state_mut();
    if view != state.view {
        state.views.push(state.view);
        if state.views.len() > VIEWS_KEPT {
            state.views.remove(0);
        }
        state.view = view;
    }
}

/// Moves the view so that `x` is in its middle.
pub(super) fn centre(model: &mut Model, x: f64) {
    let half = model.state().view.width() / 2.0;
    let view = View { from: x - half, to: x + half }.within(model.whole());
    look(model, view);
}

pub(super) fn pan(model: &mut Model, share: f64) {
    let view = model.state().view.panned(share).within(model.whole());
    // With a range open the cursor still moves, and the line is needed for what is selected.
    if view == model.state().view && model.review.anchor.is_none() {
        model.say(Tone::Warning, "end of the record");
    }
    // Panning is no view to come back to: `Z` leads back to where it started from.
    let before = model.state().view;
    model.state_mut().view = view;
    if model.review.anchor.is_some() {
        carry_cursor(model, share * before.width());
    }
    cursor_into_view(model);
}

/// While a range is open, panning is a motion: the cursor goes along, at the end of the record too.
fn carry_cursor(model: &mut Model, seconds: f64) {
    let series = model.series();
    let Some(&t) = series.t.get(model.state().cursor) else { return };
    let cursor = series.before(t + seconds).min(series.len().saturating_sub(1));
    model.state_mut().cursor = cursor;
}

/// The cursor stays on the screen.
fn cursor_into_view(model: &mut Model) {
    let range = model.in_view();
    if !range.is_empty() {
        let state = model.state_mut();
        state.cursor = state.cursor.clamp(range.start, range.end - 1);
    }
}

fn zoom(model: &mut Model, factor: f64) {
    let at = model.axis(&model.series()).x(model.state().cursor);
    zoom_at(model, at, factor);
}

/// Zooms, with what is at `at` kept where it is.
pub(super) fn zoom_at(model: &mut Model, at: f64, factor: f64) {
    if model.series().is_empty() || at.is_nan() {
        return;
    }
    let view = model.state().view;
    let narrowest = NARROWEST * nominal_step(model);
    let factor = if view.width() * factor < narrowest { narrowest / view.width() } else { factor };
    if (1.0..2.0).contains(&factor) {
        model.say(Tone::Warning, "maximum zoom");
        return;
    }
    // The first zoom of a wide view would leave a cursor at the edge at the edge: the sample is what is of interest.
    let view = view.zoomed(at, factor).within(model.whole());
    look(model, view);
    cursor_into_view(model);
}

fn zoom_flag(model: &mut Model) {
    let cursor = model.state().cursor;
    let run = model.state().drawn.as_ref().and_then(|d| d.outcome.run(cursor).cloned());
    let (start, end) = run.map_or((cursor, cursor), |r| (r.start, r.start + r.length - 1));
    let series = model.series();
    if series.is_empty() {
        return;
    }
    let last = series.len() - 1;
    let x = |i: usize| model.axis(&series).x(i.min(last));
    // Neighbours across a long gap would make the view wide and empty.
    let reach = 2.0 * nominal_step(model) * (AROUND_RUN as f64);
    let from = x(start.saturating_sub(AROUND_RUN)).max(x(start) - reach);
    let to = x(end + AROUND_RUN).min(x(end) + reach);
    let view = View { from, to };
    if view.width() > 0.0 {
        let view = view.within(model.whole());
        look(model, view);
    }
}

/// Puts the cursor on a sample; a view that does not hold it moves there and keeps its width.
pub(super) fn go_to(model: &mut Model, position: usize) {
    let series = model.series();
    let Some(last) = series.len().checked_sub(1) else { return };
    let position = position.min(last);
    let x = model.axis(&series).x(position);
    let view = model.state().view;
    let margin = view.width() / 20.0;
    let all = model.whole();
    let state = model.state_mut();
    state.cursor = position;
    if x < view.from + margin || x > view.to - margin {
        let half = view.width() / 2.0;
        state.view = View { from: x - half, to: x + half }.within(all);
    }
}

/// The cursor to the next sample, or to the next column where a column holds several.
fn walk(model: &mut Model, forward: bool) {
    let series = model.series();
    let cursor = model.state().cursor;
    let view = model.state().view;
    let axis = model.axis(&series);
    let now = axis.x(cursor);
    if now.is_nan() {
        return;
    }
    let columns = f64::from(layout::plot_columns(model).max(1));
    let column = view.width() / columns;
    let target = if forward {
        axis.first_at(now + column).max(cursor + 1)
    } else {
        axis.first_at(now - column).min(cursor.saturating_sub(1))
    };
    let dense = view.positions(axis).len() as f64 > columns;
    let next = match (dense, forward) {
        (true, _) => target,
        (false, true) => cursor + 1,
        (false, false) => cursor.saturating_sub(1),
    };
    go_to(model, next);
}
