//! The one place where the state of the workbench changes: a message comes in, effects go out. No input or output
//! and no clock here.

use ratatui::crossterm::event::{KeyCode, KeyEvent, KeyModifiers};

use super::action::{Action, Panel};
use super::detectability::Subject;
use super::keys::Meaning;
use super::message::{Effect, Message};
use super::model::{Knob, Model, Overlay, Picker, PickerKind, Prompt, PromptKind, Tone};
use crate::error::{Error, on_one_line};
use crate::track::printable;

mod channels;
pub(super) mod channels_overview;
mod chart_actions;
mod checks;
mod command;
mod command_line;
mod compare;
mod consensus;
pub(super) mod decide;
pub(super) mod describe;
mod detectability;
mod dialog;
mod files;
mod history;
pub(super) mod journal;
mod jump;
mod mouse;
mod navigate;
pub(super) mod note;
mod overlay;
mod palette;
pub(super) mod queue;
mod record;
mod recover;
mod review;
mod rows;
pub(in crate::tui) mod tune;

pub(super) use chart_actions::layer_names;
pub use command::{COMMANDS, Command};
pub(in crate::tui) use dialog::misread;
pub use dialog::{FIELDS, Field};
pub use files::default_session;
use history::{commit, set_up};
pub use jump::FORMS;
pub use overlay::{Entry, narrowed};
pub use palette::{Suggestion, chosen, suggestions};
pub(super) use review::mark_at;
pub(super) use tune::value_text;

/// Takes a message in; gives what the outside has to do.
pub fn update(model: &mut Model, message: Message) -> Vec<Effect> {
    let mut effects = take(model, message);
    queue::keep_in_sight(model);
    let analyses = effects.iter().any(|effect| matches!(effect, Effect::Analyse(_)));
    if analyses {
        // What the user waits for goes before it.
        model.studying = None;
    } else {
        effects.extend(detectability::follow(model));
    }
    effects
}

fn take(model: &mut Model, message: Message) -> Vec<Effect> {
    match message {
        Message::Key(key) => {
            model.clicked = None;
            // Anywhere, also in lists and prompts, which keep what is chosen and typed; a letter may be text there.
            let letter = key.modifiers.difference(KeyModifiers::SHIFT).is_empty();
            if !letter && model.keys.meaning(key, None, model.focus) == Meaning::Action(Action::Redraw) {
                return vec![Effect::Redraw];
            }
            if !matches!(model.overlay, Overlay::None) {
                return overlay::key(model, key);
            }
            let prefix = model.prefix.take();
            match model.keys.meaning(key, prefix, model.focus) {
                Meaning::Action(action) => act(model, action),
                Meaning::Prefix(first) => {
                    model.prefix = Some(first);
                    Vec::new()
                }
                Meaning::Nothing => {
                    no_action(model, key, prefix);
                    Vec::new()
                }
            }
        }
        Message::Mouse(event) => mouse::act(model, event),
        Message::Paste(text) => overlay::paste(model, &text),
        Message::Resize(width, height) => {
            model.size = (width, height);
            // Between two looks at it the window may have been smaller, and have lost what it showed, though its size is
            // the same now.
            vec![Effect::Redraw]
        }
        Message::Analysed { generation, plan, result } => analysed(model, generation, plan, result),
        Message::Advised { plan, advice } => {
            let state = &mut model.channels[plan];
            (state.advice, state.sweep_asked) = (Some(*advice), false);
            Vec::new()
        }
        Message::Stepped { plan, steps } => {
            model.channels[plan].steps = Some(*steps);
            Vec::new()
        }
        Message::Smoothed(smoothed) => {
            let state = &mut model.channels[smoothed.question.plan()];
            state.smoothed = Some(*smoothed);
            Vec::new()
        }
        Message::NoAdvice => Vec::new(),
        Message::Polling { generation, done } => {
            consensus::polling(model, generation, done);
            Vec::new()
        }
        Message::Polled { generation, plan, consensus } => {
            consensus::polled(model, generation, plan, consensus);
            Vec::new()
        }
        Message::Studied { generation, plan, finding, rounds } => {
            detectability::studied(model, generation, plan, finding, rounds)
        }
        Message::Surveyed { generation, plan, summary } => {
            channels_overview::surveyed(model, generation, plan, summary);
            Vec::new()
        }
        Message::Written { what, path, result } => files::written(model, &what, &path, result),
        Message::Files(news) => dialog::news(model, news),
        Message::Record(standing) => {
            record::stands(model, standing);
            Vec::new()
        }
        Message::Journal(news) => {
            journal::news(model, news);
            Vec::new()
        }
    }
}

/// Says that a typed character means nothing. Keys without one (and what is left of a torn sequence) stay silent.
fn no_action(model: &mut Model, key: KeyEvent, prefix: Option<char>) {
    let KeyCode::Char(c) = key.code else { return };
    if key.modifiers.intersects(KeyModifiers::CONTROL | KeyModifiers::ALT) {
        return;
    }
    let typed: String = prefix.into_iter().chain([c]).collect();
    let help = model.key(Action::Help);
    model.say(Tone::Warning, format!("{} does nothing here · {help} shows the keys", printable(&typed)));
}

/// A part of what is done: its effects, or none where the action is another's.
type Part = fn(&mut Model, Action) -> Option<Vec<Effect>>;

/// The parts that carry actions out. Each action is one part's; the others leave it.
const PARTS: [Part; 14] = [
    review::act,
    decide::act,
    tune::act,
    navigate::act,
    history::act,
    chart_actions::act,
    compare::act,
    consensus::act,
    detectability::act,
    channels::act,
    channels_overview::act,
    checks::act,
    files::act,
    window,
];

/// Does what an action means.
pub(super) fn act(model: &mut Model, action: Action) -> Vec<Effect> {
    if action != Action::Interrupt {
        model.interrupted = false;
        model.toast = None;
    }
    PARTS.iter().find_map(|part| part(model, action)).unwrap_or_default()
}

/// What is about the window: its panels, what lies over them, and leaving it.
fn window(model: &mut Model, action: Action) -> Option<Vec<Effect>> {
    Some(match action {
        Action::Help => open(model, Overlay::Help(tui_input::Input::default(), 0)),
        Action::Command => prompt(model, PromptKind::Command, ""),
        Action::Jump => prompt(model, PromptKind::Jump, ""),
        Action::JumpAgain => {
            if let Err(why) = jump::jump(model, "") {
                model.say(Tone::Warning, why);
            }
            Vec::new()
        }
        Action::CommandLine => command_line::show(model, None),
        Action::Mouse => {
            model.mouse = !model.mouse;
            let words = if model.mouse { "the mouse points and zooms here" } else { "the mouse selects text" };
            model.say(Tone::Done, format!("{words} · {} the other way", model.key(action)));
            vec![Effect::Mouse(model.mouse)]
        }
        Action::NextPanel => focus(model, 1),
        Action::PreviousPanel => focus(model, Panel::ALL.len() - 1),
        Action::Panel(panel) => {
            model.focus = panel;
            Vec::new()
        }
        Action::Maximise => {
            model.maximised = !model.maximised;
            Vec::new()
        }
        Action::Quit => quit(model),
        Action::Interrupt => interrupt(model),
        Action::Redraw => vec![Effect::Redraw],
        Action::Suspend => vec![Effect::Suspend],
        Action::Back => back(model),
        _ => return None,
    })
}

/// Shows the channel of another plan.
pub(super) fn show(model: &mut Model, plan: usize) -> Vec<Effect> {
    if plan == model.shown || plan >= model.channels.len() {
        if model.channels.len() == 1 {
            model.say(Tone::Warning, "this record has one channel only");
        }
        return Vec::new();
    }
    turn_to(model, plan);
    let text = format!("{} · channel {} of {}", model.plan().channel, plan + 1, model.channels.len());
    model.say(Tone::Done, text);
    let judge = model.state().stale && model.state().error.is_none();
    let mut effects = if judge { vec![Effect::Analyse(plan)] } else { Vec::new() };
    effects.extend(consensus::wanted(model));
    effects
}

/// Puts another channel on the screen: a range that was selected has no meaning there.
fn turn_to(model: &mut Model, plan: usize) {
    if plan == model.shown {
        return;
    }
    model.shown = plan;
    (model.review.anchor, model.review.left_at) = (None, None);
}

fn analysed(
    model: &mut Model,
    generation: u64,
    plan: usize,
    result: crate::error::Result<Box<crate::plot::Drawn>>,
) -> Vec<Effect> {
    if model.awaited != Some(generation) {
        return Vec::new();
    }
    model.awaited = None;
    match result {
        Ok(drawn) => {
            let before = model.channels[plan].drawn.as_ref();
            let first = before.is_none();
            let explained = before.and_then(|before| tune::more_flags(&before.outcome, &drawn.outcome));
            files::arrange(model, plan, *drawn);
            if first && let Some(drawn) = model.channels[plan].drawn.clone() {
                let at = drawn.outcome.outliers.first().copied().or(drawn.positions.first().map(|p| *p as usize));
                model.channels[plan].cursor = at.unwrap_or(0);
                remember_what_was_said(model, plan);
            }
            if let Some(text) = explained.filter(|_| plan == model.shown) {
                model.say_too(Tone::Warning, &text);
            }
        }
        Err(Error::Stopped) => {}
        Err(e) => {
            let text = on_one_line(&e);
            // What other settings gave would pass for the result of these.
            let state = &mut model.channels[plan];
            (state.drawn, state.queue, state.flags) = (None, Vec::new(), super::plot::Flags::default());
            state.results += 1;
            state.error = Some(text.clone());
            compare::refresh(model, plan);
            model.say(Tone::Error, text);
        }
    }
    let mut effects = tune::advise(model, plan);
    effects.extend(consensus::wanted(model));
    effects
}

/// Decisions of a session that was opened were made under the method as it is now.
fn remember_what_was_said(model: &mut Model, plan: usize) {
    let Some(drawn) = model.channels[plan].drawn.clone() else { return };
    let channel = &model.track.channels[model.channels[plan].channel];
    let series = model.channels[plan].samples.series(channel, &model.track.time);
    let decisions = &mut model.session.plans[plan].decisions;
    for mark in drawn.outcome.marks.iter().filter(|m| m.ruling.is_some()) {
        let row = u32::try_from(series.row(mark.position as usize)).unwrap_or(u32::MAX);
        if let Some(decision) = decisions.get(row).cloned() {
            let said = decision.said.or(Some(mark.verdict));
            decisions.set(row, Some(crate::review::Decision { said, ..decision }));
        }
    }
}

fn focus(model: &mut Model, by: usize) -> Vec<Effect> {
    let at = Panel::ALL.iter().position(|p| *p == model.focus).unwrap_or(0);
    model.focus = Panel::ALL[(at + by) % Panel::ALL.len()];
    Vec::new()
}

fn open(model: &mut Model, overlay: Overlay) -> Vec<Effect> {
    model.overlay = overlay;
    Vec::new()
}

pub(super) fn prompt(model: &mut Model, kind: PromptKind, text: &str) -> Vec<Effect> {
    open(model, Overlay::Prompt(Prompt::new(kind, text)))
}

pub(super) fn picker(model: &mut Model, kind: PickerKind) -> Vec<Effect> {
    let choice = overlay::entries(model, kind).iter().position(|e| e.current).unwrap_or(0);
    open(model, Overlay::Picker(Picker { kind, filter: tui_input::Input::default(), choice }))
}

fn quit(model: &mut Model) -> Vec<Effect> {
    if model.unsaved() { open(model, Overlay::ConfirmQuit) } else { vec![Effect::Quit] }
}

/// Ctrl-C stops the computation; the second one in a row is about quitting.
fn interrupt(model: &mut Model) -> Vec<Effect> {
    if model.awaited.take().is_some() {
        model.say(Tone::Warning, "computation stopped; any change starts it again");
        model.interrupted = true;
        return vec![Effect::Cancel];
    }
    if model.interrupted {
        return quit(model);
    }
    model.interrupted = true;
    model
        .say(Tone::Warning, format!("{} again to quit (or {})", model.key(Action::Interrupt), model.key(Action::Quit)));
    Vec::new()
}

fn back(model: &mut Model) -> Vec<Effect> {
    if model.review.anchor.take().is_some() {
        model.say(Tone::Done, "range given up");
    } else if model.maximised {
        model.maximised = false;
    } else if model.awaited.take().is_some() {
        model.say(Tone::Warning, "computation stopped; any change starts it again");
        return vec![Effect::Cancel];
    } else if model.studying.as_ref().is_some_and(|s| matches!(s.subject, Subject::Tuning(_))) {
        model.studying = None;
        model.say(Tone::Warning, "the search for settings is stopped; nothing is taken");
        return vec![Effect::CancelStudy];
    } else if model.polling.take().is_some() {
        model.say(Tone::Warning, "stopped; press C twice to run all methods again");
        return vec![Effect::CancelPoll];
    } else {
        model.focus = Panel::Trace;
    }
    Vec::new()
}

/// What opens when the value of a parameter is to be chosen from a list.
pub(super) fn list_of(knob: Knob) -> Option<PickerKind> {
    match knob {
        Knob::Method => Some(PickerKind::Method),
        Knob::Rate => Some(PickerKind::Rate),
        Knob::Repair(p) if p.key == crate::repair::METHOD.key => Some(PickerKind::Repair),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::session::{Session, Setup};
    use crate::track::{LoadOptions, Source, load};
    use crate::tui::keys::KEYMAP;
    use crate::tui::plot::Glyphs;
    use crate::tui::theme::Theme;
    use std::sync::Arc;

    #[test]
    fn every_action_is_that_of_one_part() {
        let track = Arc::new(load(&Source::demo(), &LoadOptions::default()).unwrap());
        let session = Session::new(&track, LoadOptions::default(), &Setup::standard());
        let fresh = || Model::new(Arc::clone(&track), session.clone(), None, Theme::mono(), Glyphs::Unicode);
        for row in KEYMAP {
            let parts = PARTS.iter().filter(|part| part(&mut fresh(), row.action).is_some()).count();
            assert_eq!(parts, 1, "{:?}", row.action);
        }
    }
}
