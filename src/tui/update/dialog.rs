//! Dialogs about files: keys in them, and the news they wait for.

use ratatui::crossterm::event::{KeyCode, KeyEvent, KeyModifiers};
use tui_input::{Input, InputRequest};

use super::super::files::{News, Request, Task};
use super::super::message::Effect;
use super::super::model::{Dialog, Model, Over, Overlay, PromptKind, Tone};
use super::{files, overlay};

mod browser;
mod export;
mod loader;
mod opening;

pub(super) use browser::browse;
pub(super) use export::{dialog as export_dialog, one as export_one};
pub(in crate::tui) use loader::misread;
pub use loader::{FIELDS, Field};
pub(super) use loader::{change_key, correct};
pub(super) use opening::open;

/// A key while a dialog is there.
pub(super) fn key(model: &mut Model, dialog: Dialog, key: KeyEvent) -> Vec<Effect> {
    let control_c = key.code == KeyCode::Char('c') && key.modifiers.contains(KeyModifiers::CONTROL);
    let typing = match &dialog {
        Dialog::Loader(form) => form.typing.is_some(),
        Dialog::Export(form) => form.typing.is_some(),
        _ => false,
    };
    if (key.code == KeyCode::Esc && !typing) || control_c {
        return leave(model, dialog);
    }
    match dialog {
        Dialog::Browser(browser) => browser::key(model, browser, key),
        Dialog::Loader(form) => loader::key(model, form, key),
        Dialog::Export(form) => export::key(model, form, key),
        Dialog::Waiting(_) => keep(model, dialog),
        Dialog::Unsaved(request) => unsaved(model, request, key),
        Dialog::Over(over) => overwrite(model, over, key),
    }
}

/// The row under the cursor and how many there are, in a dialog that lists rows and has none of them typed in.
pub(super) fn rows(dialog: &Dialog) -> Option<(usize, usize)> {
    match dialog {
        Dialog::Browser(browser) => Some((browser.choice, browser.narrowed().len())),
        Dialog::Loader(form) if form.typing.is_none() => Some((form.choice, FIELDS.len())),
        Dialog::Export(form) if form.typing.is_none() => Some((form.choice, form.rows.len())),
        Dialog::Loader(_) | Dialog::Export(_) | Dialog::Waiting(_) | Dialog::Unsaved(_) | Dialog::Over(_) => None,
    }
}

/// Moves the cursor to one of those rows.
pub(super) fn choose(dialog: &mut Dialog, to: usize) -> Vec<Effect> {
    match dialog {
        Dialog::Browser(browser) => return browser::choose(browser, to),
        Dialog::Loader(form) => form.choice = to,
        Dialog::Export(form) => form.choice = to,
        Dialog::Waiting(_) | Dialog::Unsaved(_) | Dialog::Over(_) => {}
    }
    Vec::new()
}

/// Pasted text goes where text is typed.
pub(super) fn paste(dialog: &mut Dialog, text: &str) {
    let input = match dialog {
        Dialog::Browser(browser) => Some(&mut browser.filter),
        Dialog::Loader(form) => form.typing.as_mut(),
        Dialog::Export(form) => form.typing.as_mut(),
        Dialog::Waiting(_) | Dialog::Unsaved(_) | Dialog::Over(_) => None,
    };
    insert(input, text);
    if let Dialog::Browser(browser) = dialog {
        browser.choice = 0;
    }
}

fn insert(input: Option<&mut Input>, text: &str) {
    let Some(input) = input else { return };
    for c in text.chars().filter(|c| !c.is_control()) {
        input.handle(InputRequest::InsertChar(c));
    }
}

/// News from the threads that work with files.
pub(super) fn news(model: &mut Model, news: News) -> Vec<Effect> {
    match news {
        News::Listed(result) => browser::listed(model, result),
        News::Seen { glance, result, lines } => {
            browser::seen(model, &glance, &result);
            loader::seen(model, &glance, result, lines);
            Vec::new()
        }
        News::Opened { ticket, result } => opening::opened(model, ticket, result),
        News::Checked(found) => {
            export::checked(model, &found);
            Vec::new()
        }
        News::Completed { typed, completed } => {
            if let Overlay::Prompt(prompt) = &mut model.overlay
                && prompt.kind == PromptKind::SaveAs
                && prompt.input.value() == typed
            {
                prompt.input = completed.into();
            }
            Vec::new()
        }
    }
}

/// Begins to open what waited for the session to be saved.
pub(super) fn begin_opening(model: &mut Model, request: Request) -> Vec<Effect> {
    opening::begin(model, request, None)
}

/// Puts a dialog back.
fn keep(model: &mut Model, dialog: Dialog) -> Vec<Effect> {
    model.overlay = Overlay::Files(Box::new(dialog));
    Vec::new()
}

/// One level back.
fn leave(model: &mut Model, dialog: Dialog) -> Vec<Effect> {
    let mut abandoned = Vec::new();
    let back = match dialog {
        Dialog::Browser(_) | Dialog::Export(_) | Dialog::Unsaved(_) => None,
        Dialog::Loader(form) => {
            // What lies under the dialog is another record.
            if !form.again && form.back.is_none() {
                let (name, open) = (form.source.name(), model.track.source.name());
                model.say(Tone::Warning, format!("{name} is not opened; this is {open}"));
            }
            form.back
        }
        Dialog::Waiting(waiting) => {
            model.say(Tone::Warning, format!("{} is not opened", waiting.name));
            abandoned = effect(Task::Abandon);
            waiting.back
        }
        Dialog::Over(over) => over.back,
    };
    if let Some(dialog) = back {
        model.overlay = Overlay::Files(dialog);
    }
    abandoned
}

/// Asks whether a file may be written over by `again`.
pub(super) fn ask_over(model: &mut Model, path: std::path::PathBuf, again: Effect) {
    let back = match std::mem::take(&mut model.overlay) {
        Overlay::Files(dialog) if matches!(*dialog, Dialog::Export(_)) => Some(dialog),
        _ => None,
    };
    model.overlay = Overlay::Files(Box::new(Dialog::Over(Over { path, again, back })));
}

fn overwrite(model: &mut Model, over: Over, key: KeyEvent) -> Vec<Effect> {
    match overlay::answer(key) {
        Some('o') => {
            model.say(Tone::Done, "writing …");
            vec![over.again]
        }
        _ => keep(model, Dialog::Over(over)),
    }
}

fn unsaved(model: &mut Model, request: Request, key: KeyEvent) -> Vec<Effect> {
    match overlay::answer(key) {
        Some('w') => {
            model.then_open = Some(request);
            files::save(model, None, false, false)
        }
        Some('d') => opening::begin(model, request, None),
        _ => keep(model, Dialog::Unsaved(request)),
    }
}

fn effect(task: Task) -> Vec<Effect> {
    vec![Effect::Files(task)]
}
