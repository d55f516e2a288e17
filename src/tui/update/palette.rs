//! The command palette: what fits the line after `:`, and what Enter, Tab and the arrows do with it.

use super::super::action::Action;
use super::super::fuzzy::ranked;
use super::super::message::Effect;
use super::super::model::{Model, Prompt};
use super::act;
use super::command::{self, COMMANDS, Command};
use crate::check::CHECKS;
use crate::method::METHODS;
use crate::param::{Kind, Param};
use crate::repair::REPAIRS;
use crate::session::Preset;
use crate::track::printable;

/// How many lines are remembered.
const REMEMBERED: usize = 100;

/// One line of the list under the palette.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Suggestion {
    /// What it is called.
    pub name: String,
    /// Its keys, or what follows the command.
    pub keys: String,
    /// What it does.
    pub help: String,
    /// The line that it stands for.
    pub line: String,
    /// What taking it does.
    take: Take,
}

/// What taking a suggestion does.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Take {
    Act(Action),
    Run,
    /// More has to be typed: the line is put into the prompt.
    Fill,
}

/// What fits the line, the best first: commands and actions while its first word is typed, then what can follow.
#[must_use]
pub fn suggestions(model: &Model, line: &str) -> Vec<Suggestion> {
    match line.split_once(' ') {
        Some((name, rest)) if command::find(name).is_some() => following(model, name, rest),
        _ => {
            let all = everything(model);
            let ranked = ranked(line, all.iter().map(|s| (s.name.as_str(), s.help.as_str())));
            ranked.into_iter().map(|i| all[i].clone()).collect()
        }
    }
}

/// The index of the suggestion that Enter takes; none when it runs the line as it was typed.
#[must_use]
pub fn chosen(prompt: &Prompt, suggestions: &[Suggestion]) -> Option<usize> {
    let line = prompt.input.value().trim();
    let first = line.split(' ').next().unwrap_or_default();
    let as_typed = line.is_empty() || command::find(first).is_some();
    prompt.choice.or(if as_typed { None } else { Some(0) }).filter(|i| *i < suggestions.len())
}

/// All commands, and all actions but those that only mean something to the palette itself.
fn everything(model: &Model) -> Vec<Suggestion> {
    let of_command = |c: &Command| {
        let name = c.name.split('|').next().unwrap_or_default().to_owned();
        let optional = c.takes.is_empty() || c.takes.starts_with('[');
        let line = if optional { name.clone() } else { format!("{name} ") };
        let take = if optional { Take::Run } else { Take::Fill };
        Suggestion { name, keys: c.takes.into(), help: c.help.into(), line, take }
    };
    let mut all: Vec<Suggestion> = COMMANDS.iter().map(of_command).collect();
    for bound in model.keys.rows() {
        let action = bound.row.action;
        let name = action.name();
        match all.iter_mut().find(|s| s.name == name) {
            Some(known) => known.keys = format!("{} {}", known.keys, bound.shown()).trim().to_owned(),
            None if action == Action::Command => {}
            None => {
                let (keys, help) = (bound.shown(), bound.row.help.to_owned());
                all.push(Suggestion { line: name.clone(), name, keys, help, take: Take::Act(action) });
            }
        }
    }
    all
}

/// What can follow the name of a command.
fn following(model: &Model, name: &str, rest: &str) -> Vec<Suggestion> {
    let plan = model.plan();
    let word = |word: &str, help: &str| (word.to_owned(), help.to_owned());
    let words: Vec<(String, String)> = match name {
        "set" => return settings(model, rest),
        "method" => METHODS.iter().map(|m| word(m.about().id, m.about().name)).collect(),
        "repair" => REPAIRS.iter().map(|r| word(r.id, r.help)).collect(),
        "preset" => vec![word("default", "values that work on real tracks"), word("paper", "as the documents have it")],
        "check" => return checks(rest),
        "uncheck" => plan.setup.preparation.checks.iter().map(|c| word(c.id(), &c.to_string())).collect(),
        "channel" => model.session.plans.iter().map(|p| (p.channel.clone(), channel_help(model, &p.channel))).collect(),
        "goto" => super::jump::FORMS.iter().map(|(form, help)| word(form, help)).collect(),
        _ => return Vec::new(),
    };
    if name == "goto" {
        // Forms are to be read, not to be taken.
        let form = |(form, help): (String, String)| Suggestion {
            name: form,
            keys: String::new(),
            help,
            line: format!("goto {rest}"),
            take: Take::Fill,
        };
        return words.into_iter().map(form).collect();
    }
    let now = [plan.setup.method.about().id, crate::repair::chosen(&plan.setup.repair).id, plan.channel.as_str()];
    let ranked = ranked(rest, words.iter().map(|(w, h)| (w.as_str(), h.as_str())));
    let entry = |i: usize| {
        let (word, help) = words[i].clone();
        let keys = if now.contains(&word.as_str()) { "now".to_owned() } else { String::new() };
        Suggestion { line: format!("{name} {word}"), name: printable(&word), keys, help, take: Take::Run }
    };
    ranked.into_iter().map(entry).collect()
}

/// Checks, each to be completed with its settings.
fn checks(rest: &str) -> Vec<Suggestion> {
    let abouts: Vec<_> = CHECKS.iter().map(|check| check.about()).collect();
    let entry = |i: usize| {
        let about = abouts[i];
        let keys: Vec<&str> = about.params.iter().map(|p| p.key).collect();
        let line = format!("check {}:", about.id);
        Suggestion { name: about.id.into(), keys: keys.join(" "), help: about.help.into(), line, take: Take::Fill }
    };
    ranked(rest, abouts.iter().map(|a| (a.id, a.help))).into_iter().map(entry).collect()
}

fn channel_help(model: &Model, name: &str) -> String {
    let unit = model.track.channels.iter().find(|c| c.name == name).map(|c| printable(&c.unit));
    unit.unwrap_or_default()
}

/// Keys of parameters and, after one, its values.
fn settings(model: &Model, rest: &str) -> Vec<Suggestion> {
    let setup = &model.plan().setup;
    let params = setup.settings.iter().chain(setup.repair.iter().skip(1));
    let Some((key, typed)) = rest.split_once([' ', '=']) else {
        let all: Vec<_> = params.collect();
        let entry = |i: usize| {
            let (p, value) = all[i];
            let unit = if p.unit.is_empty() { String::new() } else { format!(" {}", p.unit) };
            let help = format!("{} [{}]{unit}", p.help, p.range());
            let keys = value.to_string();
            Suggestion { name: p.key.into(), keys, help, line: format!("set {} ", p.key), take: Take::Fill }
        };
        return ranked(rest, all.iter().map(|(p, _)| (p.key, p.help))).into_iter().map(entry).collect();
    };
    let Some((param, now)) = params.into_iter().find(|(p, _)| p.key == key) else { return Vec::new() };
    let values = values(param, setup.method.about().id, Preset::Paper.settings(setup.method).get(key), now);
    let fitting = values.into_iter().filter(|(value, _)| value.starts_with(typed.trim()));
    let entry = |(value, help): (String, String)| {
        let line = format!("set {key} {value}");
        Suggestion { name: value, keys: String::new(), help, line, take: Take::Run }
    };
    fitting.map(entry).collect()
}

/// Values worth offering, and what they are.
fn values(
    param: &Param,
    method: &str,
    paper: Option<crate::param::Value>,
    now: crate::param::Value,
) -> Vec<(String, String)> {
    let mut values = vec![(now.to_string(), "as it is now".to_owned())];
    let mut add = |value: String, help: String| {
        if values.iter().all(|(known, _)| *known != value) {
            values.push((value, help));
        }
    };
    add(param.default.to_string(), "the default".to_owned());
    if let Some(paper) = paper {
        add(paper.to_string(), format!("as the document of {method} has it"));
    }
    let words: &[&str] = match param.kind {
        Kind::Choice(words) | Kind::RealOr { words, .. } => words,
        Kind::Words(_) => &["all"],
        Kind::Switch => &["true", "false"],
        Kind::WholeOrOff { .. } => &["off"],
        Kind::Whole { .. } | Kind::Real { .. } | Kind::Numbers => &[],
    };
    words.iter().for_each(|word| add((*word).to_owned(), String::new()));
    for (steps, help) in [(-1, "one step down"), (1, "one step up")] {
        let value = param.step(now, steps);
        if value != now {
            add(value.to_string(), help.to_owned());
        }
    }
    values
}

/// Enter: takes what is chosen, or runs the line.
///
/// # Errors
/// What is wrong with the line; it stays in the prompt then.
pub(super) fn enter(model: &mut Model, prompt: &mut Prompt) -> Result<Option<Vec<Effect>>, String> {
    let line = prompt.input.value().trim().to_owned();
    let mut found = suggestions(model, prompt.input.value());
    let Some(index) = chosen(prompt, &found) else {
        let effects = command::run(model, &line)?;
        remember(model, line);
        return Ok(Some(effects));
    };
    let suggestion = found.swap_remove(index);
    match suggestion.take {
        Take::Act(action) => {
            remember(model, suggestion.line);
            Ok(Some(act(model, action)))
        }
        Take::Run => {
            let effects = command::run(model, &suggestion.line)?;
            remember(model, suggestion.line);
            Ok(Some(effects))
        }
        Take::Fill => {
            fill(prompt, &suggestion.line);
            Ok(None)
        }
    }
}

fn fill(prompt: &mut Prompt, line: &str) {
    prompt.input = line.into();
    (prompt.choice, prompt.recalled) = (None, None);
}

fn remember(model: &mut Model, line: String) {
    if line.is_empty() {
        return;
    }
    model.lines.retain(|known| *known != line);
    model.lines.push(line);
    if model.lines.len() > REMEMBERED {
        model.lines.remove(0);
    }
}

/// Tab: the line as far as it is clear, or else what is chosen.
pub(super) fn complete(model: &Model, prompt: &mut Prompt) {
    let line = prompt.input.value().to_owned();
    let found = suggestions(model, &line);
    let common = command::complete(model, &line).filter(|c| c.len() > line.len() && prompt.choice.is_none());
    // A whole name is followed by what can follow it.
    let whole = |c: String| found.iter().find(|s| s.line.trim_end() == c).map_or(c, |s| s.line.clone());
    let at = prompt.choice.unwrap_or(0);
    if let Some(line) = common.map(whole).or_else(|| found.get(at).map(|s| s.line.clone())) {
        fill(prompt, &line);
    }
}

/// Up and Down: through the list or, from an empty line upwards, through what was typed before.
pub(super) fn walk(model: &Model, prompt: &mut Prompt, down: bool) {
    let browsing = prompt.recalled.is_some() || (prompt.input.value().is_empty() && prompt.choice.is_none() && !down);
    if browsing && !model.lines.is_empty() {
        return recall(model, prompt, down);
    }
    let found = suggestions(model, prompt.input.value());
    let n = found.len().max(1);
    let next = match (chosen(prompt, &found), down) {
        (None, true) => 0,
        (None, false) => n - 1,
        (Some(at), true) => (at + 1) % n,
        (Some(at), false) => (at + n - 1) % n,
    };
    prompt.choice = Some(next);
}

/// The line before or after the one that was recalled; after the last there is an empty one.
pub(super) fn recall(model: &Model, prompt: &mut Prompt, down: bool) {
    let n = model.lines.len();
    let at = match (prompt.recalled, down) {
        (None, true) => return,
        (None, false) => n.checked_sub(1),
        (Some(at), true) => (at + 1 < n).then_some(at + 1),
        (Some(at), false) => Some(at.saturating_sub(1)),
    };
    let line = at.and_then(|i| model.lines.get(i)).cloned().unwrap_or_default();
    fill(prompt, &line);
    prompt.recalled = at;
}
