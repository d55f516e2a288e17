//! The dialog that writes files.

use std::path::PathBuf;

use ratatui::crossterm::event::{KeyCode, KeyEvent};

use super::super::super::files::Task;
use super::super::super::message::{Effect, Output, OutputKind};
use super::super::super::model::{Dialog, ExportForm, ExportRow, Model, Overlay, Tone};
use super::super::files::{beside, default_export};
use super::super::overlay::edit;
use super::{effect, keep};
use crate::error::on_one_line;
use crate::report::ReportForm;

/// Opens the dialog, with names beside the record; what was saved as a session keeps its name.
pub(in super::super) fn dialog(model: &mut Model) -> Vec<Effect> {
    let row = |kind: OutputKind| {
        let session = model.file.clone().filter(|_| kind == OutputKind::Session);
        let path = session.unwrap_or_else(|| match kind {
            OutputKind::Cleaned => default_export(&model.track),
            _ => beside(&model.track.source, kind.ending()),
        });
        ExportRow { kind, on: kind == OutputKind::Cleaned, path, there: false }
    };
    let form = ExportForm { rows: OutputKind::ALL.into_iter().map(row).collect(), choice: 0, typing: None };
    check(model, form)
}

/// Shows the dialog, and asks which of its files are there.
fn check(model: &mut Model, form: ExportForm) -> Vec<Effect> {
    let paths = form.rows.iter().map(|r| r.path.clone()).collect();
    keep(model, Dialog::Export(form));
    effect(Task::Check(paths))
}

pub(super) fn key(model: &mut Model, mut form: ExportForm, key: KeyEvent) -> Vec<Effect> {
    let n = form.rows.len();
    if let Some(mut input) = form.typing.take() {
        match key.code {
            KeyCode::Esc => {}
            KeyCode::Enter => {
                let text = input.value().trim();
                if !text.is_empty() {
                    form.rows[form.choice].path = PathBuf::from(text);
                    form.rows[form.choice].on = true;
                }
                return check(model, form);
            }
            _ => {
                edit(&mut input, key);
                form.typing = Some(input);
            }
        }
        return keep(model, Dialog::Export(form));
    }
    match key.code {
        KeyCode::Enter => return write(model, form),
        KeyCode::Down | KeyCode::Tab => form.choice = (form.choice + 1) % n,
        KeyCode::Up | KeyCode::BackTab => form.choice = (form.choice + n - 1) % n,
        KeyCode::Char(' ') => form.rows[form.choice].on ^= true,
        KeyCode::Char('e') | KeyCode::Right => {
            form.typing = Some(form.rows[form.choice].path.to_string_lossy().into_owned().into());
        }
        _ => {}
    }
    keep(model, Dialog::Export(form))
}

fn write(model: &mut Model, form: ExportForm) -> Vec<Effect> {
    let on = form.rows.iter().filter(|r| r.on);
    let outputs: Vec<Output> = on.map(|r| Output { kind: r.kind, path: r.path.clone() }).collect();
    let wrong = outputs.iter().filter(|o| o.kind == OutputKind::Report).find_map(|o| ReportForm::of(&o.path).err());
    if let Some(e) = wrong {
        model.say(Tone::Error, on_one_line(&e));
        return keep(model, Dialog::Export(form));
    }
    if outputs.is_empty() {
        model.say(Tone::Warning, "nothing is selected: space selects");
        return keep(model, Dialog::Export(form));
    }
    // The dialog stays until all has been written.
    let words =
        if outputs.len() == 1 { "writing 1 file …".into() } else { format!("writing {} files …", outputs.len()) };
    model.say(Tone::Done, words);
    keep(model, Dialog::Export(form));
    vec![Effect::Export { outputs, overwrite: false }]
}

/// Writes one file without the dialog.
pub(in super::super) fn one(model: &mut Model, kind: OutputKind, path: PathBuf, overwrite: bool) -> Vec<Effect> {
    if kind == OutputKind::Report
        && let Err(e) = ReportForm::of(&path)
    {
        model.say(Tone::Error, on_one_line(&e));
        return Vec::new();
    }
    model.say(Tone::Done, format!("writing {} …", path.display()));
    vec![Effect::Export { outputs: vec![Output { kind, path }], overwrite }]
}

pub(super) fn checked(model: &mut Model, found: &[(PathBuf, bool)]) {
    let Overlay::Files(dialog) = &mut model.overlay else { return };
    let Dialog::Export(form) = &mut **dialog else { return };
    for row in &mut form.rows {
        row.there = found.iter().any(|(path, there)| *there && *path == row.path);
    }
}
