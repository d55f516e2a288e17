//! The dialog that corrects how a record is loaded.

use ratatui::crossterm::event::{KeyCode, KeyEvent};
use tui_input::Input;

use super::super::super::files::{Glance, Purpose, Request, Seen, Task};
use super::super::super::message::Effect;
use super::super::super::model::{Dialog, LoaderForm, Model, Overlay};
use super::super::overlay::edit;
use super::{effect, keep, opening};
use crate::error::{Error, Result, on_one_line};
use crate::track::{FileLine, LoadOptions, Source};

mod fields;

pub use fields::{FIELDS, Field};

/// The dialog about the record that is open.
pub(in super::super) fn correct(model: &mut Model) -> Vec<Effect> {
    let source = model.track.source.clone();
    form(model, source, None)
}

/// The dialog about `source`; with the options of the session when that is open.
pub(super) fn form(model: &mut Model, source: Source, back: Option<Box<Dialog>>) -> Vec<Effect> {
    let again = back.is_none();
    let options = if again { model.session.data.options.clone() } else { LoadOptions::default() };
    let form = LoaderForm {
        source,
        options,
        again,
        choice: 0,
        typing: None,
        seen: None,
        stale: true,
        columns: Vec::new(),
        lines: Vec::new(),
        back,
    };
    look(model, form)
}

/// The dialog about a file that could not be understood as the options have it.
pub(in crate::tui) fn misread(model: &mut Model, source: Source, options: LoadOptions) -> Vec<Effect> {
    let form = LoaderForm {
        source,
        options,
        again: false,
        choice: 0,
        typing: None,
        seen: None,
        stale: true,
        columns: Vec::new(),
        lines: Vec::new(),
        back: None,
    };
    look(model, form)
}

/// Shows the dialog, and asks what its options make of the record.
fn look(model: &mut Model, mut form: LoaderForm) -> Vec<Effect> {
    form.stale = true;
    let glance = Glance { source: form.source.clone(), options: form.options.clone() };
    keep(model, Dialog::Loader(form));
    effect(Task::Look(glance))
}

pub(super) fn key(model: &mut Model, mut form: LoaderForm, key: KeyEvent) -> Vec<Effect> {
    let (n, field) = (FIELDS.len(), &FIELDS[form.choice.min(FIELDS.len() - 1)]);
    if let Some(mut input) = form.typing.take() {
        match (key.code, field.take) {
            (KeyCode::Esc, _) => {}
            (KeyCode::Enter, Some(take)) => {
                take(&mut form.options, input.value().trim());
                return look(model, form);
            }
            _ => {
                edit(&mut input, key);
                form.typing = Some(input);
            }
        }
        return keep(model, Dialog::Loader(form));
    }
    match key.code {
        KeyCode::Enter => {
            let LoaderForm { source, options, again, .. } = &form;
            let purpose = if *again { Purpose::Correct } else { Purpose::Other };
            let request = Request { source: source.clone(), options: options.clone(), purpose };
            return opening::ask(model, request, Some(Box::new(Dialog::Loader(form))));
        }
        KeyCode::Down | KeyCode::Tab => form.choice = (form.choice + 1) % n,
        KeyCode::Up | KeyCode::BackTab => form.choice = (form.choice + n - 1) % n,
        KeyCode::Right | KeyCode::Char(' ') => return step(model, form, field, 1),
        KeyCode::Left => return step(model, form, field, -1),
        KeyCode::Backspace | KeyCode::Delete => {
            (field.clear)(&mut form.options);
            return look(model, form);
        }
        KeyCode::Char('e') if field.take.is_some() => {
            form.typing = Some(Input::from((field.text)(&form.options).unwrap_or_default()));
        }
        _ => {}
    }
    keep(model, Dialog::Loader(form))
}

/// The key that changes the field under the cursor: to its next value or, where values cannot be counted up, by typing.
pub(in super::super) fn change_key(form: &LoaderForm) -> KeyCode {
    let stepped = FIELDS.get(form.choice).is_some_and(|field| field.step.is_some());
    if stepped { KeyCode::Right } else { KeyCode::Char('e') }
}

fn step(model: &mut Model, mut form: LoaderForm, field: &Field, by: isize) -> Vec<Effect> {
    let Some(step) = field.step else { return keep(model, Dialog::Loader(form)) };
    step(&mut form.options, &form.columns, by);
    look(model, form)
}

pub(super) fn seen(model: &mut Model, glance: &Glance, result: Result<Seen>, lines: Vec<FileLine>) {
    let Overlay::Files(dialog) = &mut model.overlay else { return };
    let Dialog::Loader(form) = &mut **dialog else { return };
    if glance.source != form.source || glance.options != form.options || matches!(result, Err(Error::Stopped)) {
        return;
    }
    form.stale = false;
    form.lines = lines;
    if let Ok(seen) = &result {
        form.columns.clone_from(&seen.columns);
    }
    form.seen = Some(result.map_err(|e| on_one_line(&e)));
}
