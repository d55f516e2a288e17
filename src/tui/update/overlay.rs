//! Keys while something lies over the panels: help, lists, prompts, the question before quitting.

use ratatui::crossterm::event::{KeyCode, KeyEvent, KeyModifiers};
use tui_input::{Input, InputRequest};

use super::super::files::Task;
use super::super::message::Effect;
use super::super::model::{Model, Overlay, Picker, PickerKind, Prompt, PromptKind};
use super::{
    channels_overview, chart_actions, detectability, dialog, files, journal, jump, note, palette, recover, set_up,
    show, tune,
};
use crate::error::on_one_line;
use crate::method::METHODS;
use crate::repair::REPAIRS;
use crate::track::printable;

/// One line of a list to choose from.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Entry {
    /// What is chosen.
    pub id: String,
    /// A few words beside it.
    pub help: String,
    /// The group it stands in; empty for none.
    pub group: &'static str,
    /// True for the one in force.
    pub current: bool,
}

/// The lines of a list, before it is narrowed.
#[must_use]
pub(super) fn entries(model: &Model, kind: PickerKind) -> Vec<Entry> {
    let setup = &model.plan().setup;
    match kind {
        PickerKind::Method => {
            let listed = METHODS.iter().map(|m| m.about()).map(|a| Entry {
                id: a.id.into(),
                help: a.name.into(),
                group: a.family,
                current: a.id == setup.method.about().id,
            });
            let help = "the method that finds most on this record".to_owned();
            let auto = Entry { id: detectability::AUTO.to_owned(), help, group: "", current: false };
            std::iter::once(auto).chain(listed).collect()
        }
        PickerKind::Repair => {
            let chosen = crate::repair::chosen(&setup.repair).id;
            REPAIRS
                .iter()
                .map(|r| Entry { id: r.id.into(), help: r.help.into(), group: "", current: r.id == chosen })
                .collect()
        }
        PickerKind::Second => {
            let current = model.second_plan();
            let others = model.session.plans.iter().enumerate().filter(|(plan, _)| *plan != model.shown);
            let entry = |id: &str, help: String, current: bool| Entry { id: id.to_owned(), help, group: "", current };
            let unit = |plan: usize| printable(&model.track.channels[model.channels[plan].channel].unit);
            let mut all: Vec<Entry> =
                others.map(|(plan, p)| entry(&p.channel, unit(plan), current == Some(plan))).collect();
            all.push(entry(chart_actions::NO_SECOND, "the channel on the screen alone".into(), current.is_none()));
            all
        }
        PickerKind::Channel | PickerKind::Rate => {
            let rate = kind == PickerKind::Rate;
            let current = if rate { setup.rate.clone() } else { Some(model.plan().channel.clone()) };
            let names = model.track.channels.iter().filter(|c| !rate || c.name != model.plan().channel);
            let names = names.filter(|c| rate || model.session.plans.iter().any(|p| p.channel == c.name));
            names
                .map(|c| Entry {
                    id: c.name.clone(),
                    help: printable(&c.unit),
                    group: "",
                    current: Some(&c.name) == current.as_ref(),
                })
                .collect()
        }
    }
}

/// The lines that fit what was typed: every word of it occurs in id, help or group.
#[must_use]
pub fn narrowed(model: &Model, picker: &Picker) -> Vec<Entry> {
    let words: Vec<String> = picker.filter.value().split_whitespace().map(str::to_lowercase).collect();
    let fits = |e: &Entry| {
        let text = format!("{} {} {}", e.id, e.help, e.group).to_lowercase();
        words.iter().all(|w| text.contains(w.as_str()))
    };
    entries(model, picker.kind).into_iter().filter(fits).collect()
}

/// A key while something lies over the panels.
pub(super) fn key(model: &mut Model, key: KeyEvent) -> Vec<Effect> {
    let overlay = match std::mem::take(&mut model.overlay) {
        Overlay::Recover(found) => return recover::key(model, found, key),
        Overlay::Merge(merging) => return recover::choose(model, *merging, key),
        Overlay::Files(files) => return dialog::key(model, *files, key),
        Overlay::Overview(overview) => return channels_overview::key(model, *overview, key),
        other => other,
    };
    let gone = key.code == KeyCode::Esc || (key.code == KeyCode::Char('c') && control(key));
    if gone {
        return Vec::new();
    }
    match overlay {
        Overlay::None | Overlay::Recover(_) | Overlay::Merge(_) | Overlay::Files(_) | Overlay::Overview(_) => {
            Vec::new()
        }
        Overlay::Help(filter, from) => {
            model.overlay = help(filter, from, key);
            Vec::new()
        }
        Overlay::Picker(picker) => pick(model, picker, key),
        Overlay::Prompt(prompt) => type_in(model, prompt, key),
        Overlay::ConfirmQuit => confirm(model, key),
        Overlay::Journal(at) => journal::key(model, at, key),
        // Any key has seen enough of it.
        Overlay::CommandLine(..) => Vec::new(),
    }
}

/// Pasted text goes where text is typed, and nowhere else.
pub(super) fn paste(model: &mut Model, text: &str) -> Vec<Effect> {
    let input = match &mut model.overlay {
        Overlay::Prompt(prompt) => &mut prompt.input,
        Overlay::Picker(picker) => &mut picker.filter,
        Overlay::Help(filter, _) => filter,
        Overlay::Files(files) => {
            dialog::paste(files, text);
            return Vec::new();
        }
        Overlay::None
        | Overlay::ConfirmQuit
        | Overlay::Recover(_)
        | Overlay::Merge(_)
        | Overlay::Overview(_)
        | Overlay::Journal(_)
        | Overlay::CommandLine(..) => return Vec::new(),
    };
    for c in text.chars().filter(|c| !c.is_control()) {
        input.handle(InputRequest::InsertChar(c));
    }
    Vec::new()
}

fn control(key: KeyEvent) -> bool {
    key.modifiers.contains(KeyModifiers::CONTROL)
}

/// The letter that answers a question. With Ctrl or Alt it is another key and answers nothing: Ctrl-D, which ends many
/// programs, must not drop work.
pub(super) fn answer(key: KeyEvent) -> Option<char> {
    let plain = !key.modifiers.intersects(KeyModifiers::CONTROL | KeyModifiers::ALT);
    key.code.as_char().filter(|_| plain)
}

fn help(mut filter: Input, from: usize, key: KeyEvent) -> Overlay {
    let from = match key.code {
        KeyCode::Enter => return Overlay::None,
        KeyCode::Down => from + 1,
        KeyCode::Up => from.saturating_sub(1),
        KeyCode::PageDown => from + 10,
        KeyCode::PageUp => from.saturating_sub(10),
        KeyCode::Home => 0,
        KeyCode::Char('q' | '?') if filter.value().is_empty() => return Overlay::None,
        _ => {
            edit(&mut filter, key);
            0
        }
    };
    Overlay::Help(filter, from)
}

fn pick(model: &mut Model, mut picker: Picker, key: KeyEvent) -> Vec<Effect> {
    let found = narrowed(model, &picker);
    let n = found.len();
    match key.code {
        KeyCode::Enter => {
            let Some(entry) = found.into_iter().nth(picker.choice) else {
                model.overlay = Overlay::Picker(picker);
                return Vec::new();
            };
            return chosen(model, picker.kind, entry.id);
        }
        KeyCode::Down | KeyCode::Tab => picker.choice = (picker.choice + 1) % n.max(1),
        KeyCode::Up | KeyCode::BackTab => picker.choice = (picker.choice + n.saturating_sub(1)) % n.max(1),
        KeyCode::PageDown => picker.choice = (picker.choice + 8).min(n.saturating_sub(1)),
        KeyCode::PageUp => picker.choice = picker.choice.saturating_sub(8),
        _ => {
            edit(&mut picker.filter, key);
            picker.choice = 0;
        }
    }
    model.overlay = Overlay::Picker(picker);
    Vec::new()
}

fn chosen(model: &mut Model, kind: PickerKind, id: String) -> Vec<Effect> {
    match kind {
        PickerKind::Method if id == detectability::AUTO => detectability::take_recommended(model),
        PickerKind::Method => crate::method::find(&id).map(|m| tune::use_method(model, m)).unwrap_or_default(),
        PickerKind::Repair => tune::set_repair(model, &id).unwrap_or_default(),
        PickerKind::Channel => {
            let plan = model.session.plans.iter().position(|p| p.channel == id);
            plan.map(|plan| show(model, plan)).unwrap_or_default()
        }
        PickerKind::Second => {
            chart_actions::set_second(model, &id);
            Vec::new()
        }
        PickerKind::Rate => {
            let mut after = model.plan().setup.clone();
            after.rate = Some(id);
            set_up(model, after)
        }
    }
}

fn type_in(model: &mut Model, mut prompt: Prompt, key: KeyEvent) -> Vec<Effect> {
    let command = prompt.kind == PromptKind::Command;
    match (key.code, control(key)) {
        (KeyCode::Enter, _) => match entered(model, &mut prompt) {
            Ok(Some(effects)) => return effects,
            Ok(None) => {}
            Err(error) => prompt.error = Some(on_one_line(&error)),
        },
        (KeyCode::Tab, _) if command => palette::complete(model, &mut prompt),
        (KeyCode::Down, _) if command => palette::walk(model, &mut prompt, true),
        (KeyCode::Up, _) if command => palette::walk(model, &mut prompt, false),
        (KeyCode::Char('n'), true) if command => palette::recall(model, &mut prompt, true),
        (KeyCode::Char('p'), true) if command => palette::recall(model, &mut prompt, false),
        (KeyCode::Tab, _) if prompt.kind == PromptKind::SaveAs => {
            let typed = prompt.input.value().to_owned();
            model.overlay = Overlay::Prompt(prompt);
            return vec![Effect::Files(Task::Complete(typed))];
        }
        (KeyCode::Tab, _) if prompt.kind == PromptKind::Note => {
            prompt.input = note::completed(prompt.input.value()).into();
        }
        (KeyCode::Down | KeyCode::Up, _) if prompt.kind == PromptKind::Note => {
            prompt.input = note::turned(prompt.input.value(), key.code == KeyCode::Down).into();
        }
        (KeyCode::Backspace, _) if command && prompt.input.value().is_empty() => return Vec::new(),
        _ => {
            edit(&mut prompt.input, key);
            (prompt.error, prompt.choice, prompt.recalled) = (None, None, None);
        }
    }
    model.overlay = Overlay::Prompt(prompt);
    Vec::new()
}

/// What Enter does in a prompt; none when more has to be typed.
fn entered(model: &mut Model, prompt: &mut Prompt) -> Result<Option<Vec<Effect>>, String> {
    let text = prompt.input.value().to_owned();
    match prompt.kind {
        PromptKind::Command => palette::enter(model, prompt),
        PromptKind::Jump => jump::jump(model, &text).map(|()| Some(Vec::new())),
        PromptKind::SaveAs if text.trim().is_empty() => Err("type a name".into()),
        PromptKind::SaveAs => Ok(Some(files::save(model, Some(text.trim().into()), false, false))),
        PromptKind::Value => tune::set_value(model, &text).map(Some),
        PromptKind::Note => Ok(Some(note::set(model, &text))),
    }
}

fn confirm(model: &mut Model, key: KeyEvent) -> Vec<Effect> {
    match answer(key) {
        Some('w') => files::save(model, None, false, true),
        Some('d') => vec![Effect::Quit],
        _ => {
            model.overlay = Overlay::ConfirmQuit;
            Vec::new()
        }
    }
}

/// The editing keys of a line, as shells have them.
pub(super) fn edit(input: &mut Input, key: KeyEvent) {
    let request = match (key.code, control(key)) {
        (KeyCode::Char('a'), true) | (KeyCode::Home, _) => InputRequest::GoToStart,
        (KeyCode::Char('e'), true) | (KeyCode::End, _) => InputRequest::GoToEnd,
        (KeyCode::Char('k'), true) => InputRequest::DeleteTillEnd,
        (KeyCode::Char('u'), true) => InputRequest::DeleteLine,
        (KeyCode::Char('w'), true) => InputRequest::DeletePrevWord,
        (KeyCode::Char('h'), true) | (KeyCode::Backspace, _) => InputRequest::DeletePrevChar,
        (KeyCode::Delete, _) => InputRequest::DeleteNextChar,
        (KeyCode::Left, _) => InputRequest::GoToPrevChar,
        (KeyCode::Right, _) => InputRequest::GoToNextChar,
        (KeyCode::Char(c), false) => InputRequest::InsertChar(c),
        _ => return,
    };
    input.handle(request);
}
