//! The mouse: pointing, zooming and panning. It decides on nothing: a slip of the hand changes no result, but for
//! the wheel over the parameters and a second click on what was chosen in a list, which say what they do and can be
//! undone.

use ratatui::crossterm::event::{KeyModifiers, MouseButton, MouseEvent, MouseEventKind};

use super::super::action::Action;
use super::super::hit_test::{Spot, spot};
use super::super::message::Effect;
use super::super::model::{Model, Overlay, Tone};
use super::super::words::{self, counted};
use super::{act as perform, navigate, rows};

/// How much of the view a step of the wheel pans.
const WHEEL_PAN: f64 = 0.1;
/// How much narrower a step of the wheel makes the view.
const WHEEL_ZOOM: f64 = 0.8;

pub(super) fn act(model: &mut Model, event: MouseEvent) -> Vec<Effect> {
    let wheel = match event.kind {
        MouseEventKind::ScrollUp => Some(true),
        MouseEventKind::ScrollDown => Some(false),
        _ => None,
    };
    if !matches!(model.overlay, Overlay::None) {
        return match (event.kind, wheel) {
            (_, Some(up)) => rows::scroll(model, up),
            (MouseEventKind::Down(MouseButton::Left), _) => rows::click(model, (event.column, event.row)),
            _ => Vec::new(),
        };
    }
    let under = spot(model, event.column, event.row);
    let sideways = event.modifiers.contains(KeyModifiers::SHIFT);
    match (event.kind, wheel) {
        (_, Some(up)) => return turn(model, under, up, sideways),
        (MouseEventKind::ScrollLeft, _) => navigate::pan(model, -WHEEL_PAN),
        (MouseEventKind::ScrollRight, _) => navigate::pan(model, WHEEL_PAN),
        (MouseEventKind::Down(MouseButton::Left), _) => return press(model, under, (event.column, event.row)),
        (MouseEventKind::Down(MouseButton::Right), _) => model.pressed = Some((event.column, event.row)),
        (MouseEventKind::Drag(MouseButton::Left), _) => select(model, (event.column, event.row)),
        (MouseEventKind::Drag(MouseButton::Right), _) => drag(model, (event.column, event.row)),
        (MouseEventKind::Up(_), _) => model.pressed = None,
        _ => {}
    }
    Vec::new()
}

/// The wheel zooms the plots at the pointer, walks through the queue, and turns the active parameter over the
/// parameters.
fn turn(model: &mut Model, under: Spot, up: bool, sideways: bool) -> Vec<Effect> {
    match under {
        Spot::Queue(_) => return perform(model, if up { Action::PreviousInQueue } else { Action::NextInQueue }),
        Spot::Parameters(_) => return perform(model, if up { Action::StepUp } else { Action::StepDown }),
        _ => {}
    }
    let Some(x) = under.x() else { return Vec::new() };
    model.toast = None;
    if sideways {
        navigate::pan(model, if up { -WHEEL_PAN } else { WHEEL_PAN });
    } else {
        navigate::zoom_at(model, x, if up { WHEEL_ZOOM } else { 1.0 / WHEEL_ZOOM });
    }
    Vec::new()
}

/// A button goes down: what is there gets the keyboard, and the cursor.
fn press(model: &mut Model, under: Spot, cell: (u16, u16)) -> Vec<Effect> {
    model.toast = None;
    if let Some(panel) = under.panel() {
        model.focus = panel;
    }
    match under {
        Spot::Trace(_, sample) | Spot::Rail(_, sample) | Spot::Residual(_, sample) => {
            model.pressed = Some(cell);
            if let Some(position) = sample {
                navigate::go_to(model, position);
            }
        }
        // The other channel is over the same times.
        Spot::Second(_, Some(position)) => navigate::go_to(model, position),
        Spot::Overview(x) => {
            let position = model.nearest_x(x);
            navigate::centre(model, x);
            if let Some(position) = position {
                navigate::go_to(model, position);
            }
        }
        // The second click of two finds the flag already there.
        Spot::Queue(Some(position)) if position as usize == model.state().cursor => {
            return perform(model, Action::ZoomFlag);
        }
        Spot::Queue(Some(position)) => navigate::go_to(model, position as usize),
        Spot::Parameters(Some(index)) if index == model.state().knob => return perform(model, Action::TypeValue),
        Spot::Parameters(Some(index)) => model.state_mut().knob = index,
        Spot::Second(_, None) | Spot::Queue(None) | Spot::Parameters(None) | Spot::Card | Spot::Elsewhere => {}
    }
    Vec::new()
}

/// The right button holds the record and moves it.
fn drag(model: &mut Model, (column, row): (u16, u16)) {
    let Some(before) = model.pressed else { return };
    let places = [before.0, column].map(|c| spot(model, c, row).x());
    if let [Some(from), Some(to)] = places {
        let width = model.state().view.width();
        if width > 0.0 && from != to {
            navigate::pan(model, (from - to) / width);
        }
    }
    model.pressed = Some((column, row));
}

/// The left button draws over samples: they are selected from where it went down, as `v` selects them.
fn select(model: &mut Model, (column, row): (u16, u16)) {
    let Some(pressed) = model.pressed.filter(|pressed| pressed.0 != column) else { return };
    // The pointer may leave the plot upwards or downwards: its column counts.
    let places = [pressed.0, column].map(|c| spot(model, c, pressed.1).x().or_else(|| spot(model, c, row).x()));
    let [Some(from), Some(to)] = places else { return };
    if let (Some(anchor), Some(cursor)) = (model.nearest_x(from), model.nearest_x(to)) {
        model.review.anchor.get_or_insert(anchor);
        model.state_mut().cursor = cursor;
        if let Some(range) = model.selection() {
            let (keys, back) = (words::of_range(&model.keys), words::key(&model.keys, Action::Back));
            let text = format!("{} selected · {keys} are about them, {back} leaves", counted(range.len(), "sample"));
            model.say(Tone::Done, text);
        }
    }
}
