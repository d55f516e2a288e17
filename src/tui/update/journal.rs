//! The journal: the panel of what was done to the document, with the way back to any moment of it, and what the user
//! has to know of the file.

use ratatui::crossterm::event::{KeyCode, KeyEvent};

use super::super::message::{Effect, JournalNews};
use super::super::model::{Model, Overlay, Tone};
use super::history;

/// Takes news of the journal's file in. That changes are not journalled stays on the screen until they are.
pub(in super::super) fn news(model: &mut Model, news: JournalNews) {
    match news {
        JournalNews::Failing(e) => {
            // The way out is another one than the error names: it is tried again by itself.
            let why = e.to_string().lines().next().unwrap_or_default().to_owned();
            model.say(Tone::Error, not_journalled(&why));
            model.not_journalled = Some(why);
        }
        JournalNews::Resumed => {
            model.not_journalled = None;
            model.say(Tone::Done, "changes are journalled again, with all that were missing");
        }
    }
}

/// What is said while changes are not journalled.
pub(in super::super) fn not_journalled(why: &str) -> String {
    format!("changes are not journalled: {why}; tried again every second, :w saves")
}

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
