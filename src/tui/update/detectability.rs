//! How small a wild point is found: by each method, in the list of methods; by the settings in force, below the trace.

use super::super::action::Action;
use super::super::detectability::{Finding, Subject};
use super::super::message::Effect;
use super::super::model::{LowerKind, Model, Overlay, PickerKind, Tone};
use super::set_up;
use crate::session::Setup;
use crate::session::detectability::Tuned;
use crate::track::printable;

/// Does an action that is about detectability; none when it is about something else.
pub(super) fn act(model: &mut Model, action: Action) -> Option<Vec<Effect>> {
    (action == Action::Detectability).then(|| toggle(model))
}

fn toggle(model: &mut Model) -> Vec<Effect> {
    if model.lower.kind == LowerKind::Detectability {
        model.lower.kind = LowerKind::Residual;
        model.say(Tone::Done, "residuals along the record");
    } else {
        model.lower.kind = LowerKind::Detectability;
        let list = model.key(Action::Methods);
        model.say(
            Tone::Done,
            format!("wild points of known size are put into copies of this record · {list} compares the methods"),
        );
    }
    Vec::new()
}

/// What is shown: the methods while their list is open, the settings while their picture is.
fn subject(model: &Model) -> Option<Subject> {
    let list = matches!(&model.overlay, Overlay::Picker(picker) if picker.kind == PickerKind::Method);
    if list {
        Some(Subject::methods(model))
    } else {
        (model.lower.kind == LowerKind::Detectability).then(|| Subject::setting(model))
    }
}

/// Measures what is shown and not known, and nothing else.
pub(super) fn follow(model: &mut Model) -> Vec<Effect> {
    if model.studying.as_ref().is_some_and(|s| matches!(s.subject, Subject::Tuning(_))) {
        return Vec::new();
    }
    let Some(subject) = subject(model) else {
        // Nobody waits for the rest.
        return if model.studying.take().is_some() { vec![Effect::CancelStudy] } else { Vec::new() };
    };
    let asked = model.studying.as_ref().is_some_and(|s| s.plan == model.shown && s.subject == subject);
    // A result that is under way goes first.
    let busy = model.awaited.is_some();
    if asked || busy || is_known(model, &subject) { Vec::new() } else { vec![Effect::Study(model.shown, subject)] }
}

fn is_known(model: &Model, subject: &Subject) -> bool {
    let state = model.state();
    state.unmeasurable.is_some()
        || match subject {
            Subject::Methods(question) => {
                state.studied.as_ref().is_some_and(|s| s.question == *question && s.advice.is_over())
            }
            Subject::Setting(setup) => state.measured.as_ref().is_some_and(|m| m.setup.same_detection(setup)),
            Subject::Tuning(_) => false,
        }
}

/// The entry of the list of methods that takes the recommended one.
pub(super) const AUTO: &str = "auto";

/// Takes the method that finds most on the record, with the settings with which it was measured: one undo step.
pub(super) fn take_recommended(model: &mut Model) -> Vec<Effect> {
    let studied = model.state().studied.clone();
    let advice = studied.as_ref().map(|studied| &studied.advice);
    let Some((advice, best)) = advice.and_then(|advice| Some((advice, advice.best()?))) else {
        let list = model.key(Action::Methods);
        model.say(Tone::Warning, format!("the methods have not been compared yet: wait a moment in the list ({list})"));
        return Vec::new();
    };
    let reasons = advice.reasons(&model.channel().unit);
    let after = Setup { repair: model.plan().setup.repair.clone(), ..best.setup.clone() };
    let effects = set_up(model, after);
    model.say(Tone::Done, printable(&reasons.first().cloned().unwrap_or_default()));
    effects
}

/// Something has become known.
pub(super) fn studied(
    model: &mut Model,
    generation: u64,
    plan: usize,
    finding: Finding,
    rounds: [usize; 2],
) -> Vec<Effect> {
    let Some(studying) = model.studying.as_mut().filter(|s| s.generation == generation) else { return Vec::new() };
    studying.rounds = rounds;
    if rounds[0] >= rounds[1] {
        model.studying = None;
    }
    let state = &mut model.channels[plan];
    match finding {
        Finding::Methods(studied) => state.studied = Some(std::sync::Arc::new(*studied)),
        Finding::Setting(measured) => state.measured = Some(std::sync::Arc::new(*measured)),
        Finding::Tuned(tuned) => return take_tuned(model, plan, *tuned),
        Finding::Nothing(why) => {
            model.studying = None;
            state.unmeasurable = Some(why.clone());
            model.say(Tone::Warning, format!("detectability cannot be measured on this channel: {why}"));
        }
    }
    Vec::new()
}

/// Searches settings of the method that find more.
pub(super) fn tune(model: &mut Model) -> Vec<Effect> {
    if let Some(why) = model.state().unmeasurable.clone() {
        model.say(Tone::Warning, format!("detectability cannot be measured on this channel: {why}"));
        return Vec::new();
    }
    let id = model.plan().setup.method.about().id;
    let stop = model.key(Action::Back);
    model.say(Tone::Done, format!("searching settings with which {id} finds more, 20 s at most · {stop} stops"));
    vec![Effect::Study(model.shown, Subject::Tuning(Box::new(model.plan().setup.clone())))]
}

/// Takes settings that find more: one undo step. Those of a channel whose settings have changed meanwhile are not taken.
fn take_tuned(model: &mut Model, plan: usize, tuned: Tuned) -> Vec<Effect> {
    let Tuned { before, after, tried, .. } = tuned;
    let id = before.setup.method.about().id;
    if plan != model.shown || !model.plan().setup.same_detection(&before.setup) {
        model.say(Tone::Warning, "the settings have changed since the search began: nothing is taken");
        return Vec::new();
    }
    if after.setup.same_detection(&before.setup) {
        model.say(Tone::Done, format!("{tried} settings of {id} were tried: none finds more"));
        return Vec::new();
    }
    let after_setup = Setup { repair: model.plan().setup.repair.clone(), ..after.setup.clone() };
    let effects = set_up(model, after_setup);
    let share = |recall: f64| format!("{:.0}", 100.0 * recall);
    let undo = model.key(Action::Undo);
    model.say(
        Tone::Done,
        format!(
            "{id} finds {} % of the wild points that were tried, {} % before; {tried} settings tried · {undo} undo",
            share(after.recall),
            share(before.recall)
        ),
    );
    effects
}
