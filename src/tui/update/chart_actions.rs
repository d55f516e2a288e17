//! What the plots show of the record: axes, layers, and which picture lies below the trace.

use super::super::action::Action;
use super::super::chart_data::Picture;
use super::super::layout;
use super::super::message::Effect;
use super::super::model::{LowerKind, Model, PickerKind, Second, Tone, YMode};
use super::super::plot::Layers;
use super::picker;
use crate::track::printable;

/// Does an action that is about the pictures; none when it is about something else.
pub(super) fn act(model: &mut Model, action: Action) -> Option<Vec<Effect>> {
    match action {
        Action::YFit => next_y_fit(model),
        Action::Layers => next_layers(model),
        Action::FilteredTrack => filtered(model),
        Action::BeforeAfter => {
            let after = !model.state().after;
            model.state_mut().after = after;
            model.say(Tone::Done, if after { "after repair: as it will be written" } else { "before repair" });
        }
        Action::XAxis => other_x(model),
        Action::NextLower => next_lower(model),
        Action::LogScale => log_scale(model),
        Action::Second => return Some(picker(model, PickerKind::Second)),
        _ => return None,
    }
    Some(Vec::new())
}

fn next_y_fit(model: &mut Model) {
    let next = match model.state().y_fit {
        YMode::Kept => YMode::All,
        YMode::All => YMode::Robust,
        YMode::Robust => as_it_is(model),
        YMode::Fixed(..) => YMode::Kept,
    };
    set_y_fit(model, next);
}

/// The range that is on the screen, for good.
fn as_it_is(model: &Model) -> YMode {
    let (low, high) = Picture::of(model, model.shown).y_range();
    YMode::Fixed(low, high)
}

fn set_y_fit(model: &mut Model, mode: YMode) {
    model.state_mut().y_fit = mode;
    let words = match mode {
        YMode::Kept => "from the kept samples",
        YMode::All => "from all samples",
        YMode::Robust => "from the middle 99.8 % of the samples",
        YMode::Fixed(..) => "stays as it is (:y LOW HIGH sets another)",
    };
    model.say(Tone::Done, format!("vertical range {words}"));
}

/// `:y kept`, `:y fixed`, `:y -10 250`.
pub(super) fn y_command(model: &mut Model, text: &str) -> Result<Vec<Effect>, String> {
    let numbers: Vec<f64> = text.split_whitespace().filter_map(|w| w.parse().ok()).collect();
    let mode = match (text, numbers.as_slice()) {
        ("kept", _) => YMode::Kept,
        ("all", _) => YMode::All,
        ("robust", _) => YMode::Robust,
        ("fixed", _) => as_it_is(model),
        (_, [low, high]) if low.is_finite() && high.is_finite() && low < high => YMode::Fixed(*low, *high),
        _ => return Err(format!("{}: expected kept, all, robust, fixed, or LOW HIGH", printable(text))),
    };
    set_y_fit(model, mode);
    Ok(Vec::new())
}

/// Where a layer is on or off.
type Switch = fn(&mut Layers) -> &mut bool;

/// The layers by name.
const LAYERS: [(&str, Switch); 5] = [
    ("raw", |l| &mut l.raw),
    ("expected", |l| &mut l.expected),
    ("band", |l| &mut l.band),
    ("repaired", |l| &mut l.repaired),
    ("filtered", |l| &mut l.filtered),
];

fn next_layers(model: &mut Model) {
    let filtered = model.state().layers.filtered;
    let next = match (Layers { filtered: false, ..model.state().layers }) {
        Layers::USUAL => Layers { band: false, ..Layers::USUAL },
        Layers { raw: true, expected: true, band: false, .. } => Layers::RAW,
        _ => Layers::USUAL,
    };
    let state = model.state_mut();
    (state.layers, state.after) = (Layers { filtered, ..next }, false);
    let words = match next {
        Layers::USUAL => "curve, tolerance band and repair",
        Layers::RAW => "curve alone",
        _ => "curve, expected value and repair",
    };
    model.say(Tone::Done, words);
}

/// Shows the filtered track, or hides it.
fn filtered(model: &mut Model) {
    let setup = &model.plan().setup;
    let about = setup.method.filter(&setup.settings).map(crate::method::Filter::about);
    let id = setup.method.about().id;
    let state = model.state_mut();
    state.layers.filtered = !state.layers.filtered && about.is_some();
    state.after = false;
    let on = state.layers.filtered;
    match about {
        Some(about) if on => model.say(Tone::Done, format!("filtered track: {about}")),
        Some(_) => model.say(Tone::Done, "without the filtered track"),
        None => model.say(Tone::Warning, format!("{id} has no model of the track to show")),
    }
}

/// The names of the layers that are on.
pub(in crate::tui) fn layer_names(mut layers: Layers) -> Vec<&'static str> {
    LAYERS.iter().filter(|(_, of)| *of(&mut layers)).map(|(name, _)| *name).collect()
}

/// `:layers raw band` shows these, `:layers -raw +band` changes what is shown, `:layers all` and `:layers none`.
pub(super) fn layers_command(model: &mut Model, text: &str) -> Result<Vec<Effect>, String> {
    let mut layers = model.state().layers;
    for (i, word) in text.split_whitespace().enumerate() {
        let (name, on) = match (word.strip_prefix('-'), word.strip_prefix('+')) {
            (Some(name), _) => (name, false),
            (_, Some(name)) => (name, true),
            _ => {
                layers = if i == 0 { Layers::NONE } else { layers };
                (word, true)
            }
        };
        match (name, LAYERS.iter().find(|(n, _)| *n == name)) {
            ("all", _) => layers = Layers::ALL,
            ("none", _) => layers = Layers::NONE,
            (_, Some((_, of))) => *of(&mut layers) = on,
            _ => {
                let names = LAYERS.map(|(name, _)| name).join(", ");
                return Err(format!("{}: layers are {names}; -NAME takes one away, all, none", printable(name)));
            }
        }
    }
    let state = model.state_mut();
    (state.layers, state.after) = (layers, false);
    let names = layer_names(layers);
    let names = if names.is_empty() { "none but the flags".to_owned() } else { names.join(", ") };
    model.say(Tone::Done, format!("layers: {names}"));
    Ok(Vec::new())
}

fn next_lower(model: &mut Model) {
    model.lower.kind = model.lower.kind.next();
    let words = match model.lower.kind {
        LowerKind::Residual => "residuals along the record",
        LowerKind::Histogram => "histogram of the residuals of the whole record",
        LowerKind::Steps => "time steps between samples",
        LowerKind::Consensus => "number of methods that flag each sample",
        LowerKind::Detectability => "share of wild points of known size that is found",
    };
    model.say(Tone::Done, format!("{words} · {} next picture", model.key(Action::NextLower)));
}

fn log_scale(model: &mut Model) {
    let lower = &mut model.lower;
    let (on, of) = match lower.kind {
        LowerKind::Residual => (&mut lower.log_residual, "the residual"),
        LowerKind::Histogram => (&mut lower.log_counts, "the counts"),
        LowerKind::Steps | LowerKind::Consensus | LowerKind::Detectability => {
            let name = lower.kind.name();
            model.say(Tone::Warning, format!("{name}: there is only one scale"));
            return;
        }
    };
    *on = !*on;
    let words = if *on { "logarithmic" } else { "linear" };
    model.say(Tone::Done, format!("{words} scale of {of}"));
}

/// The entry that shows no second channel.
pub(super) const NO_SECOND: &str = "(none)";

/// Chooses the channel beside the one on the screen by its name.
pub(super) fn set_second(model: &mut Model, name: &str) {
    let plan = model.session.plans.iter().position(|p| p.channel == name);
    model.second = match plan {
        Some(plan) => Second::Plan(plan),
        None => Second::Off,
    };
    let room = if model.size.0 < layout::SECOND { " (the screen has room for it from 160 columns on)" } else { "" };
    let text = match plan {
        Some(_) => format!("beside it: {}{room}", printable(name)),
        None => "no second channel".to_owned(),
    };
    model.say(Tone::Done, text);
}

/// From time to sample number, or back: every channel keeps the samples that it has in view.
fn other_x(model: &mut Model) {
    for plan in 0..model.channels.len() {
        let picture = Picture::of(model, plan);
        let axis = picture.axis();
        let state = &model.channels[plan];
        let view = state.view.on_other(axis);
        let views = state.views.iter().map(|view| view.on_other(axis)).collect();
        let state = &mut model.channels[plan];
        (state.view, state.views) = (view, views);
    }
    model.by_number = !model.by_number;
    let words = if model.by_number { "x axis: sample number (gaps take no room)" } else { "x axis: time" };
    model.say(Tone::Done, words);
}
