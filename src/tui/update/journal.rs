//! The journal panel: what was done to the document, and the way back to any moment of it.

use ratatui::crossterm::event::{KeyCode, KeyEvent};

use super::super::message::Effect;
use super::super::model::{Model, Overlay};
use super::history;

/// Opens the panel at the present moment.
pub(super) fn open(model: &mut Model) -> Vec<Effect> {
    model.overlay = Overlay::Journal(model.history.len());
    Vec::new()
}

/// A key while the panel is open at the moment after `at` edits.
pub(super) fn key(model: &mut Model, at: usize, key: KeyEvent) -> Vec<Effect> {
    let all = model.history.len() + model.history.undone().len();
    let to = match key.code {
        KeyCode::Enter => return history::go_back_to(model, at),
        KeyCode::Char('J' | 'q') => return Vec::new(),
        KeyCode::Up | KeyCode::Char('k') => at.saturating_sub(1),
        KeyCode::Down | KeyCode::Char('j') => at + 1,
        KeyCode::PageUp => at.saturating_sub(10),
        KeyCode::PageDown => at + 10,
        KeyCode::Home | KeyCode::Char('g') => 0,
        KeyCode::End | KeyCode::Char('G') => all,
        _ => at,
    };
    model.overlay = Overlay::Journal(to.min(all));
    Vec::new()
}
