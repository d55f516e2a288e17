//! What is done with a channel before its method sees it: checks, the period, and what the method learns from decisions.

use super::super::action::Action;
use super::super::message::Effect;
use super::super::model::{Knob, Model, Tone};
use super::{commit, set_up};
use crate::check::Applied;
use crate::error::{on_one_line, one_of};
use crate::session::{Edit, Preparation, Setup, Suggestion, parse_period, position_check, suggestions};
use crate::track::printable;

pub(super) fn act(model: &mut Model, action: Action) -> Option<Vec<Effect>> {
    Some(match action {
        Action::SuggestedChecks => take_suggestions(model),
        Action::Checks => switch_all(model),
        Action::ExcludeDecided => switch(model, Knob::ExcludeDecided),
        _ => return None,
    })
}

/// What the channel on the screen suggests and does not do yet.
fn offered(model: &Model) -> Vec<Suggestion> {
    let done = &model.plan().setup.preparation;
    suggestions(model.channel()).into_iter().filter(|s| !done.has(&s.remedy)).collect()
}

/// Changes what is done before the method, and says so.
fn prepare(model: &mut Model, preparation: Preparation, words: &str) -> Vec<Effect> {
    let after = model.plan().setup.clone().prepared(&preparation);
    let effects = set_up(model, after);
    model.say(Tone::Done, format!("{words} · {} undo", model.key(Action::Undo)));
    effects
}

fn take_suggestions(model: &mut Model) -> Vec<Effect> {
    let offered = offered(model);
    if offered.is_empty() {
        let words = if model.plan().setup.preparation.is_empty() {
            "no check is suggested for this channel: no fill value, no stuck stretch, no period"
        } else {
            "everything suggested for this channel is already set"
        };
        model.say(Tone::Warning, words);
        return Vec::new();
    }
    let mut preparation = model.plan().setup.preparation.clone();
    let words: Vec<String> = offered.iter().map(|s| s.words.clone()).collect();
    offered.into_iter().for_each(|s| preparation.take(s.remedy));
    prepare(model, preparation, &words.join("; "))
}

/// All checks off, or on where they are off.
fn switch_all(model: &mut Model) -> Vec<Effect> {
    let mut preparation = model.plan().setup.preparation.clone();
    if preparation.checks.is_empty() {
        let words = format!(
            "no checks yet: :check adds one, {} adds those suggested for the record",
            model.key(Action::SuggestedChecks)
        );
        model.say(Tone::Warning, words);
        return Vec::new();
    }
    let on = !preparation.checks_anything();
    preparation.checks.iter_mut().for_each(|check| check.on = on);
    prepare(model, preparation, if on { "all checks on" } else { "all checks off" })
}

/// Switches the check of a parameter, or the learning from decisions.
pub(super) fn switch(model: &mut Model, knob: Knob) -> Vec<Effect> {
    let setup = &model.plan().setup;
    let on = match knob {
        Knob::Check(index, _) => setup.preparation.checks.get(index).is_some_and(|check| check.on),
        _ => setup.preparation.exclude_decided,
    };
    step(model, knob, !on)
}

/// A step of a parameter that is on or off.
pub(super) fn step(model: &mut Model, knob: Knob, on: bool) -> Vec<Effect> {
    let mut preparation = model.plan().setup.preparation.clone();
    let words = match knob {
        Knob::Check(index, id) => {
            if let Some(check) = preparation.checks.get_mut(index) {
                check.on = on;
            }
            format!("{id} {}", if on { "on" } else { "off" })
        }
        Knob::ExcludeDecided => {
            preparation.exclude_decided = on;
            if on {
                "samples accepted as outliers are excluded from the method"
            } else {
                "the method sees every sample"
            }
            .to_owned()
        }
        _ => {
            model.say(Tone::Warning, "a period is typed: 360, 24, 2pi, or off");
            return Vec::new();
        }
    };
    prepare(model, preparation, &words)
}

/// The value of a parameter of this group, as text.
pub(super) fn value_text(setup: &Setup, knob: Knob) -> String {
    let preparation = &setup.preparation;
    let word = |on: bool| if on { "on" } else { "off" }.to_owned();
    match knob {
        Knob::Check(index, _) => {
            let check = preparation.checks.get(index);
            let channels = check.map(|c| c.channels.join(",")).filter(|names| !names.is_empty());
            let on = word(check.is_some_and(|c| c.on));
            channels.map_or(on.clone(), |names| format!("{on} {names}"))
        }
        Knob::OfCheck(index, p) => {
            let value = preparation.checks.get(index).and_then(|check| check.settings.get(p.key));
            value.map(|v| v.to_string()).unwrap_or_default()
        }
        Knob::Period => preparation.period.map_or_else(|| "off".into(), |period| period.to_string()),
        Knob::ExcludeDecided => word(preparation.exclude_decided),
        _ => String::new(),
    }
}

/// `:check`: makes a check of the channel on the screen.
pub(super) fn add(model: &mut Model, text: &str) -> Result<Vec<Effect>, String> {
    let check = Applied::parse(text).map_err(|e| on_one_line(&e))?;
    for name in &check.channels {
        if model.track.beside(model.channel(), name).is_none() {
            let names: Vec<&str> = model.track.channels.iter().map(|c| c.name.as_str()).collect();
            let hint = one_of("channels", name, &names);
            return Err(format!("{}: there is no such channel; {}", printable(name), printable(&hint)));
        }
    }
    let words = printable(&format!("check {check}"));
    let mut preparation = model.plan().setup.preparation.clone();
    preparation.add(check);
    Ok(prepare(model, preparation, &words))
}

/// `:uncheck`: makes a check, or all, no more.
pub(super) fn take_away(model: &mut Model, id: &str) -> Result<Vec<Effect>, String> {
    let mut preparation = model.plan().setup.preparation.clone();
    let before = preparation.checks.len();
    preparation.checks.retain(|check| id != "all" && check.id() != id);
    if preparation.checks.len() == before {
        let ids: Vec<&str> = preparation.checks.iter().map(Applied::id).collect();
        let there = if ids.is_empty() { "none".into() } else { ids.join(", ") };
        return Err(format!("{}: no such check is made; checks: {there}", printable(id)));
    }
    let words = if id == "all" { "no checks".to_owned() } else { format!("no check {id}") };
    Ok(prepare(model, preparation, &words))
}

/// Makes the check of this index no more.
pub(super) fn remove(model: &mut Model, index: usize) -> Vec<Effect> {
    let mut preparation = model.plan().setup.preparation.clone();
    if index >= preparation.checks.len() {
        return Vec::new();
    }
    let id = preparation.checks.remove(index).id();
    prepare(model, preparation, &format!("no check {id}"))
}

/// `:period`: the period of the channel on the screen.
pub(super) fn set_period(model: &mut Model, text: &str) -> Result<Vec<Effect>, String> {
    let period = parse_period(text).map_err(|e| on_one_line(&e))?;
    let preparation = Preparation { period, ..model.plan().setup.preparation.clone() };
    let words = period.map_or_else(|| "not circular".to_owned(), |p| format!("circular, with the period {p}"));
    Ok(prepare(model, preparation, &words))
}

/// `:position`: channels that are one position, each of which gets the check.
pub(super) fn position(model: &mut Model, names: &str) -> Result<Vec<Effect>, String> {
    let mut edits = Vec::new();
    for (plan, other) in model.session.plans.iter().enumerate() {
        let Some(channel) = model.track.channel(&other.channel).filter(|c| c.same_target(model.channel())) else {
            continue;
        };
        let Some(check) = position_check(&model.track, channel, names).map_err(|e| on_one_line(&e))? else { continue };
        let mut preparation = other.setup.preparation.clone();
        preparation.checks.retain(|known| known.id() != check.id());
        preparation.add(check);
        let after = other.setup.clone().prepared(&preparation);
        edits.push(Edit::Setup { plan, before: Box::new(other.setup.clone()), after: Box::new(after) });
    }
    let effects = commit(model, Edit::Several(edits));
    let words = format!("{} are one position · {} undo", printable(names), model.key(Action::Undo));
    model.say(Tone::Done, words);
    Ok(effects)
}

/// A change of what is done before the method, in few words.
pub(super) fn describe(before: &Preparation, after: &Preparation) -> String {
    if before.exclude_decided != after.exclude_decided {
        return format!("exclude_decided {}", if after.exclude_decided { "on" } else { "off" });
    }
    if before.period != after.period {
        let text = |p: Option<f64>| p.map_or_else(|| "off".into(), |p| p.to_string());
        return format!("period {} → {}", text(before.period), text(after.period));
    }
    let new = after.checks.iter().find(|check| !before.checks.contains(check));
    let old = before.checks.iter().find(|check| !after.checks.contains(check));
    match (new, old) {
        (Some(check), _) if !check.on => format!("{} off", check.id()),
        (Some(check), _) => printable(&format!("check {check}")),
        (None, Some(check)) => format!("no check {}", check.id()),
        (None, None) => "checks".into(),
    }
}
