//! Lists over the panels, whatever they list: rows, one of them under the cursor. What the mouse does with all of them.

use ratatui::crossterm::event::{KeyCode, KeyEvent, KeyModifiers};

use super::super::hit_test;
use super::super::message::Effect;
use super::super::model::{Dialog, Model, Overlay, PromptKind};
use super::{dialog, overlay, palette};

/// Lines by which a step of the wheel moves the help.
const HELP_LINES: usize = 3;

/// The row under the cursor, if any is, and how many there are; none where nothing lists rows, or one of them is being
/// typed in.
fn rows(model: &Model) -> Option<(Option<usize>, usize)> {
    match &model.overlay {
        Overlay::Picker(picker) => Some((Some(picker.choice), overlay::narrowed(model, picker).len())),
        Overlay::Prompt(prompt) if prompt.kind == PromptKind::Command => {
            let found = palette::suggestions(model, prompt.input.value());
            Some((palette::chosen(prompt, &found), found.len()))
        }
        Overlay::Journal(at) => Some((Some(*at), model.history.len() + model.history.undone().len() + 1)),
        Overlay::Files(dialog) => dialog::rows(dialog).map(|(at, n)| (Some(at), n)),
        Overlay::Overview(overview) if !overview.filtering => {
            let rows = overview.rows(model);
            Some((rows.iter().position(|plan| *plan == overview.plan), rows.len()))
        }
        Overlay::None
        | Overlay::Overview(_)
        | Overlay::Prompt(_)
        | Overlay::Help(..)
        | Overlay::CommandLine(..)
        | Overlay::ConfirmQuit
        | Overlay::Recover(_)
        | Overlay::Merge(_) => None,
    }
}

/// Moves the cursor to a row that is there.
fn choose(model: &mut Model, to: usize) -> Vec<Effect> {
    if let Overlay::Overview(overview) = &model.overlay {
        let plan = overview.rows(model).get(to).copied();
        if let (Overlay::Overview(overview), Some(plan)) = (&mut model.overlay, plan) {
            overview.plan = plan;
        }
        return Vec::new();
    }
    match &mut model.overlay {
        Overlay::Picker(picker) => picker.choice = to,
        Overlay::Prompt(prompt) => prompt.choice = Some(to),
        Overlay::Journal(at) => *at = to,
        Overlay::Files(dialog) => return dialog::choose(dialog, to),
        _ => {}
    }
    Vec::new()
}

/// A click on a row moves the cursor to it; on the row under the cursor it does what the key about that row does. So
/// does the second of two clicks in one place, though the list may have moved under it so that the chosen row is seen.
pub(super) fn click(model: &mut Model, cell: (u16, u16)) -> Vec<Effect> {
    let second = model.clicked.take() == Some(cell);
    let Some((at, n)) = rows(model) else { return Vec::new() };
    let at = at.filter(|at| *at < n);
    let under = hit_test::choice(model, cell.0, cell.1).filter(|row| *row < n);
    if at.is_none() || (!second && under != at) {
        let Some(row) = under else { return Vec::new() };
        model.clicked = Some(cell);
        return choose(model, row);
    }
    let code = match &model.overlay {
        Overlay::Files(dialog) => about_row(dialog),
        _ => KeyCode::Enter,
    };
    overlay::key(model, KeyEvent::new(code, KeyModifiers::NONE))
}

/// The key that is about the row under the cursor. Where Enter is about all of the rows, it is not that one: a slip of
/// the hand loads or writes nothing.
fn about_row(dialog: &Dialog) -> KeyCode {
    match dialog {
        Dialog::Export(_) => KeyCode::Char(' '),
        Dialog::Loader(form) => dialog::change_key(form),
        Dialog::Browser(_) | Dialog::Waiting(_) | Dialog::Unsaved(_) | Dialog::Over(_) => KeyCode::Enter,
    }
}

/// The wheel moves the cursor by a row, the help by a few lines; at the ends it stays.
pub(super) fn scroll(model: &mut Model, up: bool) -> Vec<Effect> {
    model.clicked = None;
    if let Overlay::Help(_, from) = &mut model.overlay {
        *from = if up { from.saturating_sub(HELP_LINES) } else { *from + HELP_LINES };
        return Vec::new();
    }
    let to = match (rows(model), up) {
        (Some((Some(at), _)), true) => at.checked_sub(1),
        (Some((Some(at), n)), false) => Some(at + 1).filter(|to| *to < n),
        (Some((None, n)), false) => (n > 0).then_some(0),
        (Some((None, _)), true) | (None, _) => None,
    };
    to.map(|to| choose(model, to)).unwrap_or_default()
}
