//! The picker of files.

use std::path::{Path, PathBuf};

use ratatui::crossterm::event::{KeyCode, KeyEvent};

use super::super::super::files::{FileKind, Glance, Listing, Request, Seen, Task};
use super::super::super::message::Effect;
use super::super::super::model::{Browser, Dialog, Model, Overlay};
use super::super::overlay::edit;
use super::{effect, keep, loader, opening};
use crate::error::{Error, Result, on_one_line};
use crate::session::folder_of;
use crate::track::Source;

/// Opens the picker in the folder of the record.
pub(in super::super) fn browse(model: &mut Model) -> Vec<Effect> {
    let folder = model.track.source.path().map_or_else(|| PathBuf::from("."), folder_of);
    list(model, Browser::default(), folder)
}

fn list(model: &mut Model, browser: Browser, folder: PathBuf) -> Vec<Effect> {
    let browser = Browser { listing: true, said: None, ..browser };
    keep(model, Dialog::Browser(browser));
    effect(Task::List(folder))
}

pub(super) fn key(model: &mut Model, mut browser: Browser, key: KeyEvent) -> Vec<Effect> {
    let n = browser.narrowed().len();
    let last = n.saturating_sub(1);
    match key.code {
        KeyCode::Enter => return enter(model, browser),
        KeyCode::Tab => return correct(model, browser),
        KeyCode::Backspace if browser.filter.value().is_empty() => {
            let parent = browser.folder.parent().map(Path::to_path_buf);
            return match parent {
                Some(parent) => list(model, browser, parent),
                None => keep(model, Dialog::Browser(browser)),
            };
        }
        KeyCode::Down => browser.choice = (browser.choice + 1) % n.max(1),
        KeyCode::Up => browser.choice = (browser.choice + last) % n.max(1),
        KeyCode::PageDown => browser.choice = (browser.choice + 10).min(last),
        KeyCode::PageUp => browser.choice = browser.choice.saturating_sub(10),
        KeyCode::Home if browser.filter.value().is_empty() => browser.choice = 0,
        KeyCode::End if browser.filter.value().is_empty() => browser.choice = last,
        _ => {
            let before = browser.filter.value().to_owned();
            edit(&mut browser.filter, key);
            if before != browser.filter.value() {
                browser.choice = 0;
            }
        }
    }
    browser.said = None;
    let effects = look(&browser);
    keep(model, Dialog::Browser(browser));
    effects
}

/// Moves the cursor to a line.
pub(super) fn choose(browser: &mut Browser, to: usize) -> Vec<Effect> {
    (browser.choice, browser.said) = (to, None);
    look(browser)
}

/// Asks what the choice is, unless that is known.
fn look(browser: &Browser) -> Vec<Effect> {
    match browser.chosen() {
        Some(e) if browser.seen.as_ref().is_none_or(|(path, _)| *path != e.path) => {
            effect(Task::Look(Glance::file(e.path.clone())))
        }
        _ => Vec::new(),
    }
}

fn enter(model: &mut Model, browser: Browser) -> Vec<Effect> {
    if let Some(entry) = browser.chosen() {
        let (path, kind) = (entry.path.clone(), entry.kind);
        return match kind {
            FileKind::Folder => list(model, Browser { filter: Default::default(), ..browser }, path),
            FileKind::Session | FileKind::File => {
                opening::ask(model, Request::file(path), Some(Box::new(Dialog::Browser(browser))))
            }
        };
    }
    let typed = browser.filter.value().trim().to_owned();
    if typed.is_empty() || browser.listing {
        return keep(model, Dialog::Browser(browser));
    }
    // Nothing in the list fits: it may be a path.
    let path = if typed.starts_with('~') { PathBuf::from(typed) } else { browser.folder.join(typed) };
    list(model, browser, path)
}

/// The dialog that corrects how the choice is loaded.
fn correct(model: &mut Model, mut browser: Browser) -> Vec<Effect> {
    match browser.chosen() {
        Some(entry) if entry.kind == FileKind::File => {
            let source = Source::File(entry.path.clone());
            loader::form(model, source, Some(Box::new(Dialog::Browser(browser))))
        }
        chosen => {
            let what = match chosen.map(|entry| entry.kind) {
                Some(FileKind::Session) => "a session already says how its record is loaded: Enter opens it",
                Some(_) => "only records have loader settings",
                None => "nothing is chosen",
            };
            browser.said = Some((what.into(), true));
            keep(model, Dialog::Browser(browser))
        }
    }
}

pub(super) fn listed(model: &mut Model, result: Result<Listing>) -> Vec<Effect> {
    let browser = match std::mem::take(&mut model.overlay) {
        Overlay::Files(dialog) => match *dialog {
            Dialog::Browser(browser) if browser.listing => browser,
            other => return keep(model, other),
        },
        other => {
            model.overlay = other;
            return Vec::new();
        }
    };
    let mut browser = Browser { listing: false, ..browser };
    match result {
        Ok(Listing { file: Some(path), .. }) => {
            return opening::ask(model, Request::file(path), Some(Box::new(Dialog::Browser(browser))));
        }
        Ok(listing) => {
            browser.said = listing.note.map(|note| (note, false));
            browser.filter = Default::default();
            // Coming from a folder inside, that is where one is.
            let from = listing.entries.iter().filter(|e| !e.recent).position(|e| e.path == browser.folder);
            let recent = listing.entries.iter().filter(|e| e.recent).count();
            browser.choice = from.map_or(0, |at| at + recent);
            (browser.folder, browser.entries) = (listing.folder, listing.entries);
        }
        Err(e) => browser.said = Some((on_one_line(&e), true)),
    }
    let effects = look(&browser);
    keep(model, Dialog::Browser(browser));
    effects
}

pub(super) fn seen(model: &mut Model, glance: &Glance, result: &Result<Seen>) {
    let Overlay::Files(dialog) = &mut model.overlay else { return };
    let (Dialog::Browser(browser), Source::File(path)) = (&mut **dialog, &glance.source) else { return };
    if matches!(result, Err(Error::Stopped)) || browser.chosen().is_none_or(|e| e.path != *path) {
        return;
    }
    let result = match result {
        Ok(seen) => Ok(seen.clone()),
        Err(e) => Err(on_one_line(e)),
    };
    browser.seen = Some((path.clone(), result));
}
