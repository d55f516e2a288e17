//! Moving around: what is in view, and the cursor.

use super::super::action::Action;
use super::super::layout;
use super::super::model::{Layers, Model, Tone, YMode};
use super::super::plot::{Axis, View};

/// Zooming in stops at so few nominal intervals across the plot.
const NARROWEST: f64 = 6.0;

/// Samples on each side of a run that `z` shows.
const AROUND_RUN: usize = 20;

/// How many views `Z` can go back.
const VIEWS_KEPT: usize = 50;

pub(super) fn act(model: &mut Model, action: Action) {
    match action {
        Action::PanLeft => pan(model, -0.1),
        Action::PanRight => pan(model, 0.1),
        Action::PanLeftFar => pan(model, -0.5),
        Action::PanRightFar => pan(model, 0.5),
        Action::ZoomIn => zoom(model, 0.5),
        Action::ZoomOut => zoom(model, 2.0),
        Action::FitAll => {
            let whole = whole(model);
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
        Action::YFit => {
            let (mode, words) = match model.state().y_fit {
                YMode::Kept => (YMode::All, "all samples"),
                YMode::All => (YMode::Robust, "the middle 99.8 % of the samples"),
                YMode::Robust => (YMode::Kept, "the kept samples"),
            };
            model.state_mut().y_fit = mode;
            model.say(Tone::Done, format!("vertical range from {words}"));
        }
        Action::Layers => {
            let (layers, words) = match model.state().layers {
                Layers::Band => (Layers::Expected, "curve, expected value and repair"),
                Layers::Expected => (Layers::Raw, "curve alone"),
                Layers::Raw | Layers::After => (Layers::Band, "curve, tolerance band and repair"),
            };
            model.state_mut().layers = layers;
            model.say(Tone::Done, words);
        }
        Action::BeforeAfter => {
            let (layers, words) = match model.state().layers {
                Layers::After => (Layers::Band, "before repair"),
                _ => (Layers::After, "after repair: as it will be written"),
            };
            model.state_mut().layers = layers;
            model.say(Tone::Done, words);
        }
        _ => {}
    }
}

fn whole(model: &Model) -> View {
    View::whole(Axis::Time(&model.series().t))
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

fn pan(model: &mut Model, share: f64) {
    let view = model.state().view.panned(share).within(whole(model));
    if view == model.state().view {
        model.say(Tone::Warning, "this is the end of the record");
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
    let view = model.state().view;
    let range = view.positions(Axis::Time(&model.series().t));
    if !range.is_empty() {
        let state = model.state_mut();
        state.cursor = state.cursor.clamp(range.start, range.end - 1);
    }
}

fn zoom(model: &mut Model, factor: f64) {
    let series = model.series();
    let Some(&at) = series.t.get(model.state().cursor) else { return };
    let view = model.state().view;
    let narrowest = NARROWEST * series.interval;
    let factor = if view.width() * factor < narrowest { narrowest / view.width() } else { factor };
    if (1.0..2.0).contains(&factor) {
        model.say(Tone::Warning, "this is as near as it goes");
        return;
    }
    // The first zoom of a wide view would leave a cursor at the edge at the edge: the sample is what is of interest.
    let view = view.zoomed(at, factor).within(whole(model));
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
    let t = |i: usize| series.t[i.min(last)];
    // Neighbours across a long gap would make the view wide and empty.
    let reach = 2.0 * series.interval * (AROUND_RUN as f64);
    let from = t(start.saturating_sub(AROUND_RUN)).max(t(start) - reach);
    let to = t(end + AROUND_RUN).min(t(end) + reach);
    let view = View { from, to };
    if view.width() > 0.0 {
        let view = view.within(whole(model));
        look(model, view);
    }
}

/// Puts the cursor on a sample; a view that does not hold it moves there and keeps its width.
pub(super) fn go_to(model: &mut Model, position: usize) {
    let series = model.series();
    let Some(last) = series.len().checked_sub(1) else { return };
    let position = position.min(last);
    let t = series.t[position];
    let view = model.state().view;
    let margin = view.width() / 20.0;
    let all = whole(model);
    let state = model.state_mut();
    state.cursor = position;
    if t < view.from + margin || t > view.to - margin {
        let half = view.width() / 2.0;
        state.view = View { from: t - half, to: t + half }.within(all);
    }
}

/// The cursor to the next sample, or to the next column where a column holds several.
fn walk(model: &mut Model, forward: bool) {
    let series = model.series();
    let cursor = model.state().cursor;
    let view = model.state().view;
    let Some(&now) = series.t.get(cursor) else { return };
    let columns = f64::from(layout::plot_columns(model).max(1));
    let column = view.width() / columns;
    let target = if forward {
        series.before(now + column).max(cursor + 1)
    } else {
        series.before(now - column).min(cursor.saturating_sub(1))
    };
    let dense = view.positions(Axis::Time(&series.t)).len() as f64 > columns;
    let next = match (dense, forward) {
        (true, _) => target,
        (false, true) => cursor + 1,
        (false, false) => cursor.saturating_sub(1),
    };
    go_to(model, next);
}
