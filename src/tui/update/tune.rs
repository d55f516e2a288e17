//! Turning the parameters: method, parameters, repair.

use super::super::action::Action;
use super::super::advice::BY_ITSELF;
use super::super::message::Effect;
use super::super::model::{Knob, Model, PickerKind, PromptKind, Tone};
use super::{checks, list_of, picker, prompt, set_up};
use crate::error::on_one_line;
use crate::method::{METHODS, Method};
use crate::param::{Settings, Value};
use crate::session::sweep::{Threshold, multiplier};
use crate::session::{Outcome, Preset, Setup};

pub(super) fn act(model: &mut Model, action: Action) -> Option<Vec<Effect>> {
    Some(match action {
        Action::Methods => picker(model, PickerKind::Method),
        Action::Repairs => picker(model, PickerKind::Repair),
        Action::StepUp => step(model, 1),
        Action::StepDown => step(model, -1),
        Action::StepUpFar => step(model, 10),
        Action::StepDownFar => step(model, -10),
        Action::NextKnob => choose(model, 1),
        Action::PreviousKnob => choose(model, -1),
        Action::TypeValue => type_value(model),
        Action::DefaultValue => to_default(model),
        Action::Preset => other_preset(model),
        Action::Suggested => take_suggestion(model),
        _ => return None,
    })
}

/// The single parameter by which two setups differ, with its values; none when they differ in more, or in the method.
pub(super) fn knob_between(before: &Setup, after: &Setup) -> Option<(&'static str, String, String)> {
    let other = before.rate != after.rate || before.preparation != after.preparation;
    if before.method.about().id != after.method.about().id || other {
        return None;
    }
    let of = |a: &Settings, b: &Settings, repair: bool| {
        let name = move |key: &'static str| if repair && key == "method" { "repair" } else { key };
        let pairs = a.iter().zip(b.iter()).filter(|((_, x), (_, y))| x != y);
        pairs.map(move |((p, x), (_, y))| (name(p.key), x.to_string(), y.to_string())).collect::<Vec<_>>()
    };
    let mut all = of(&before.settings, &after.settings, false);
    all.extend(of(&before.repair, &after.repair, true));
    if all.len() == 1 { all.pop() } else { None }
}

/// Why more is flagged although the multiplier went up; none where it did not, or other settings differ too.
pub(super) fn more_flags(before: &Outcome, after: &Outcome) -> Option<String> {
    let more = after.counts.flagged.checked_sub(before.counts.flagged).filter(|more| *more > 0)?;
    let (old, new) = (&before.detection.setup, &after.detection.setup);
    let key = multiplier(new).ok()?.key;
    let up = old.settings.get(key).zip(new.settings.get(key)).is_some_and(|(old, new)| match (old, new) {
        (Value::Real(old), Value::Real(new)) => new > old,
        _ => false,
    });
    let alone = knob_between(old, new).is_some_and(|(knob, ..)| knob == key);
    (up && alone).then(|| {
        format!("{more} more flagged with a larger {key}: accepted samples change the model and so what it expects")
    })
}

/// The value of a parameter, as text.
pub(in crate::tui) fn value_text(setup: &Setup, knob: Knob) -> String {
    match knob {
        Knob::Method => setup.method.about().id.to_owned(),
        Knob::Rate => setup.rate.clone().unwrap_or_else(|| "(none)".into()),
        Knob::Detection(p) => setup.settings.get(p.key).map(|v| v.to_string()).unwrap_or_default(),
        Knob::Repair(p) => setup.repair.get(p.key).map(|v| v.to_string()).unwrap_or_default(),
        Knob::Check(..) | Knob::OfCheck(..) | Knob::Period | Knob::ExcludeDecided => checks::value_text(setup, knob),
    }
}

/// The value of a parameter that turns a parameter.
pub(in crate::tui) fn value(setup: &Setup, knob: Knob) -> Option<Value> {
    match knob {
        Knob::Detection(p) => setup.settings.get(p.key),
        Knob::Repair(p) => setup.repair.get(p.key),
        Knob::OfCheck(i, p) => setup.preparation.checks.get(i).and_then(|check| check.settings.get(p.key)),
        _ => None,
    }
}

/// The setup with another value of a parameter.
///
/// # Errors
/// What is wrong with the value: for example a check that could not object to anything.
fn with_value(setup: &Setup, knob: Knob, value: Value) -> Result<Setup, String> {
    let mut after = setup.clone();
    match knob {
        Knob::Detection(p) => after.settings.set(p.key, p.key, value),
        Knob::Repair(p) => after.repair.set(p.key, p.key, value),
        Knob::OfCheck(i, p) => match after.preparation.checks.get_mut(i) {
            Some(check) => check.set(p.key, value).and_then(|()| check.verify()),
            None => Ok(()),
        },
        _ => Ok(()),
    }
    .map_err(|e| on_one_line(&e))?;
    Ok(after)
}

pub(super) fn step(model: &mut Model, steps: i64) -> Vec<Effect> {
    let knob = model.knob();
    let setup = model.plan().setup.clone();
    let forward = steps > 0;
    match knob {
        Knob::Method => {
            let at = METHODS.iter().position(|m| m.about().id == setup.method.about().id).unwrap_or(0);
            let next = if forward { at + 1 } else { at + METHODS.len() - 1 } % METHODS.len();
            use_method(model, METHODS[next])
        }
        Knob::Rate => picker(model, super::PickerKind::Rate),
        Knob::Check(..) | Knob::Period | Knob::ExcludeDecided => checks::step(model, knob, forward),
        Knob::Detection(param) | Knob::Repair(param) | Knob::OfCheck(_, param) => {
            let Some(now) = value(&setup, knob) else { return Vec::new() };
            let next = param.step(now, steps);
            if next == now {
                model.say(Tone::Warning, format!("{} ends at {now} ({})", param.key, param.range()));
                return Vec::new();
            }
            let after = match with_value(&setup, knob, next) {
                Ok(after) => after,
                Err(why) => {
                    model.say(Tone::Warning, why);
                    return Vec::new();
                }
            };
            let effects = set_up(model, after);
            model.say(Tone::Done, format!("{} {now} → {next} · {} undo", knob.name(), model.key(Action::Undo)));
            effects
        }
    }
}

pub(super) fn choose(model: &mut Model, by: isize) -> Vec<Effect> {
    let n = model.knobs().len();
    let at = model.state().knob.min(n.saturating_sub(1));
    model.state_mut().knob = (at + n).saturating_add_signed(by) % n.max(1);
    if model.focus != super::Panel::Parameters {
        let knob = model.knob();
        let text = format!("{} {} · , . step", knob.name(), value_text(&model.plan().setup, knob));
        model.say(Tone::Done, text);
    }
    advise(model, model.shown)
}

pub(super) fn type_value(model: &mut Model) -> Vec<Effect> {
    let knob = model.knob();
    match (list_of(knob), knob) {
        (Some(kind), _) => picker(model, kind),
        (None, Knob::Check(..) | Knob::ExcludeDecided) => checks::switch(model, knob),
        // The value now stands in the prompt's words: what is typed takes its place.
        (None, _) => prompt(model, PromptKind::Value, ""),
    }
}

/// Sets the active parameter from typed text.
pub(super) fn set_value(model: &mut Model, text: &str) -> Result<Vec<Effect>, String> {
    let knob = model.knob();
    match knob {
        Knob::Detection(p) | Knob::Repair(p) | Knob::OfCheck(_, p) => {
            let value = p.parse(text).map_err(|e| e.to_string())?;
            let after = with_value(&model.plan().setup, knob, value)?;
            Ok(set_up(model, after))
        }
        Knob::Period => checks::set_period(model, text),
        Knob::Method | Knob::Rate | Knob::Check(..) | Knob::ExcludeDecided => Ok(Vec::new()),
    }
}

/// Sets any parameter of the method or of repair by its key, and makes it the active one.
pub(super) fn set_key(model: &mut Model, key: &str, text: &str) -> Result<Vec<Effect>, String> {
    let mut after = model.plan().setup.clone();
    after.set_text(key, text).map_err(|e| e.to_string())?;
    let effects = set_up(model, after);
    if let Some(at) = model.knobs().iter().position(|k| k.name() == key) {
        model.state_mut().knob = at;
    }
    Ok(effects)
}

pub(super) fn to_default(model: &mut Model) -> Vec<Effect> {
    let knob = model.knob();
    match knob {
        Knob::Detection(p) | Knob::Repair(p) | Knob::OfCheck(_, p) => {
            match with_value(&model.plan().setup, knob, p.default) {
                Ok(after) => {
                    let effects = set_up(model, after);
                    model.say(Tone::Done, format!("{} at its default, {}", knob.name(), p.default));
                    effects
                }
                Err(why) => {
                    model.say(Tone::Warning, why);
                    Vec::new()
                }
            }
        }
        Knob::Check(index, _) => checks::remove(model, index),
        Knob::Method | Knob::Rate | Knob::Period | Knob::ExcludeDecided => Vec::new(),
    }
}

pub(super) fn use_method(model: &mut Model, method: &'static dyn Method) -> Vec<Effect> {
    let mut after = model.plan().setup.clone();
    let left = after.method.about().id;
    let id = method.about().id;
    if left == id {
        return Vec::new();
    }
    let state = model.state_mut();
    state.tuned.insert(left, after.settings.clone());
    // A method that was tuned before comes back as it was left.
    after.settings = state.tuned.get(id).cloned().unwrap_or_else(|| Settings::defaults(method.about().params));
    after.method = method;
    let active = model.knob().name();
    let effects = set_up(model, after);
    let knobs = model.knobs();
    let wanted = |name: &str| knobs.iter().position(|k| k.name() == name);
    model.state_mut().knob = wanted(active).or_else(|| wanted("k")).or_else(|| wanted("c")).unwrap_or(0);
    model.say(Tone::Done, format!("{id}: {} · {} undo", method.about().name, model.key(Action::Undo)));
    if method.about().needs_rate && model.plan().setup.rate.is_none() {
        // What it says without one stays on the screen when the list is left.
        picker(model, super::PickerKind::Rate);
    }
    effects
}

pub(super) fn use_preset(model: &mut Model, preset: Preset) -> Vec<Effect> {
    let mut after = model.plan().setup.clone();
    after.settings = preset.settings(after.method);
    let words = match preset {
        Preset::Default => "every parameter at its default",
        Preset::Paper => "every parameter as the paper has it",
    };
    let effects = set_up(model, after);
    model.say(Tone::Done, format!("{words} · {} undo", model.key(Action::Undo)));
    effects
}

pub(super) fn other_preset(model: &mut Model) -> Vec<Effect> {
    let setup = &model.plan().setup;
    let at_paper = setup.settings == Preset::Paper.settings(setup.method);
    use_preset(model, if at_paper { Preset::Default } else { Preset::Paper })
}

/// Chooses another repair.
pub(super) fn set_repair(model: &mut Model, id: &str) -> Result<Vec<Effect>, String> {
    let mut after = model.plan().setup.clone();
    let found = crate::repair::find(id).map_err(|e| e.to_string())?;
    after.repair.set_text("repair", crate::repair::METHOD.key, found.id).map_err(|e| e.to_string())?;
    let effects = set_up(model, after);
    model.say(Tone::Done, format!("repair {id} · {} undo", model.key(Action::Undo)));
    Ok(effects)
}

/// Asks for what a step of the active parameter changes, and for the counts along the multiplier where they are cheap
/// enough to be found unasked, unless they are known.
pub(super) fn advise(model: &Model, plan: usize) -> Vec<Effect> {
    let state = &model.channels[plan];
    let setup = &model.session.plans[plan].setup;
    let n = state.drawn.as_ref().map_or(0, |d| d.hidden.len());
    if state.stale || n == 0 {
        return Vec::new();
    }
    let known = state.advice.as_ref().is_some_and(|advice| advice.is_for(setup));
    let sweep = !known && n <= BY_ITSELF && multiplier(setup).is_ok();
    let knob = model.knob_of(plan);
    let steps = matches!(knob, Knob::Detection(_)) && !state.steps.as_ref().is_some_and(|s| s.is_for(setup, knob));
    if sweep || steps { vec![Effect::Advise(plan)] } else { Vec::new() }
}

/// Sets the multiplier to the suggested threshold.
pub(super) fn take_suggestion(model: &mut Model) -> Vec<Effect> {
    let plan = model.shown;
    let Some(sweep) = model.advice().map(|a| a.sweep.clone()) else {
        return match multiplier(&model.plan().setup) {
            Ok(param) => {
                model.state_mut().sweep_asked = true;
                model.say(
                    Tone::Done,
                    format!(
                        "searching {} for a threshold; press {} again to use it",
                        param.key,
                        model.key(Action::Suggested)
                    ),
                );
                vec![Effect::Advise(plan)]
            }
            Err(e) => {
                model.say(Tone::Warning, on_one_line(&e));
                Vec::new()
            }
        };
    };
    match sweep.threshold {
        Threshold::Suggested { suggestion, range } => {
            let effects = set_key(model, sweep.key, &suggestion.to_string()).unwrap_or_default();
            let (from, to, undo) = (range.from, range.to, model.key(Action::Undo));
            model.say(
                Tone::Done,
                format!("{} {suggestion}: {range} from {from:.1} to {to:.1} · {undo} undo", sweep.key),
            );
            effects
        }
        Threshold::None { no_suggestion } => {
            model.say(Tone::Warning, format!("no threshold suggested: {no_suggestion}"));
            Vec::new()
        }
    }
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use super::*;
    use wildpoint_core::analysis::{Detection, Input, Rows, settle};

    use crate::method::find;
    use crate::review::Decisions;
    use crate::stop::Stop;
    use crate::track::Series;

    fn outcome(id: &str, k: &str, flagged: usize) -> Outcome {
        let t: Vec<f64> = (0..50).map(f64::from).collect();
        let series = Series::new(&t, &t);
        let mut setup = Setup::new(find(id).unwrap(), Preset::Default);
        setup.set_text("k", k).unwrap();
        let detection = Detection::of(Input::new(&series, None), &setup, &Stop::never()).unwrap();
        let rows = Rows { seconds: &t, own: None };
        let found = settle(&series, rows, Arc::new(detection), &Decisions::default(), &Stop::never()).unwrap();
        Outcome { counts: crate::session::Counts { flagged, ..found.counts }, ..found }
    }

    #[test]
    fn a_larger_multiplier_that_flags_more_is_explained() {
        let words = more_flags(&outcome("two-sided", "4", 3), &outcome("two-sided", "4.1", 5)).unwrap();
        assert!(words.starts_with("2 more flagged with a larger k"), "{words}");
        for (before, after) in [
            (outcome("two-sided", "4.1", 3), outcome("two-sided", "4", 5)),
            (outcome("two-sided", "4", 5), outcome("two-sided", "4.1", 5)),
            (outcome("hampel", "4", 3), outcome("two-sided", "4.1", 5)),
        ] {
            assert_eq!(more_flags(&before, &after), None);
        }
    }
}
