//! The view of all methods at once.

use super::super::action::Action;
use super::super::consensus::{Consensus, Question};
use super::super::message::Effect;
use super::super::model::{LowerKind, Model, Tone};
use super::super::words::counted;
use super::{navigate, set_up};
use crate::error::on_one_line;
use crate::method::consensus::Consensus as Method;
use crate::plot::step;
use crate::session::{Preset, Setup};

/// Does an action that is about all methods at once; none when it is about something else.
pub(super) fn act(model: &mut Model, action: Action) -> Option<Vec<Effect>> {
    match action {
        Action::Consensus => Some(toggle(model)),
        Action::NextAgreed => {
            next_agreed(model);
            Some(Vec::new())
        }
        Action::AdoptConsensus => Some(adopt(model)),
        _ => None,
    }
}

fn toggle(model: &mut Model) -> Vec<Effect> {
    if model.lower.kind == LowerKind::Consensus {
        model.lower.kind = LowerKind::Residual;
        model.say(Tone::Done, "residuals along the record");
        // Nobody waits for the rest.
        return if model.polling.take().is_some() { vec![Effect::CancelPoll] } else { Vec::new() };
    }
    model.lower.kind = LowerKind::Consensus;
    let effects = wanted(model);
    if effects.is_empty()
        && let Some(consensus) = model.state().consensus.as_deref()
    {
        let text = in_words(model, consensus);
        model.say(Tone::Done, text);
    }
    effects
}

/// Asks the methods about the channel on the screen where the view of them is open and their answer is not there.
pub(super) fn wanted(model: &Model) -> Vec<Effect> {
    let question = Question::of(&model.plan().setup);
    let known = model.state().consensus.as_ref().is_some_and(|c| c.question == question);
    let asked = model.polling.as_ref().is_some_and(|p| p.plan == model.shown && p.question == question);
    let open = model.lower.kind == LowerKind::Consensus;
    if open && !known && !asked { vec![Effect::Poll(model.shown)] } else { Vec::new() }
}

/// This many methods have answered.
pub(super) fn polling(model: &mut Model, generation: u64, done: usize) {
    if let Some(polling) = model.polling.as_mut().filter(|p| p.generation == generation) {
        polling.done = done;
    }
}

/// All methods have answered.
pub(super) fn polled(model: &mut Model, generation: u64, plan: usize, consensus: Box<Consensus>) {
    if model.polling.as_ref().is_none_or(|p| p.generation != generation) {
        return;
    }
    model.polling = None;
    if plan == model.shown && model.lower.kind == LowerKind::Consensus {
        let text = in_words(model, &consensus);
        model.say(Tone::Done, text);
    }
    model.channels[plan].consensus = Some(std::sync::Arc::new(*consensus));
}

/// Who was asked, what they agree on, and who was left out.
fn in_words(model: &Model, consensus: &Consensus) -> String {
    let (ballot, agreed) = (&consensus.ballot, consensus.agreed.len());
    let half = ballot.half();
    let agreed = counted(agreed, "sample");
    let mut text = format!("{} methods; {half} or more flag {agreed}", ballot.methods());
    if !consensus.left_out.is_empty() {
        let left_out: Vec<String> = consensus.left_out.iter().map(|(id, why)| format!("{id} ({why})")).collect();
        text.push_str(&format!(" · left out: {}", left_out.join(", ")));
    }
    let (next, adopt) = (model.key(Action::NextAgreed), model.key(Action::AdoptConsensus));
    text.push_str(&format!(" · {next} next of them · {adopt} takes them"));
    text
}

/// The consensus of the methods that were asked becomes the detection, at their majority: one undo step. Before they were
/// asked, of all that can vote.
fn adopt(model: &mut Model) -> Vec<Effect> {
    let setup = model.plan().setup.clone();
    let settings = match model.state().consensus.as_deref().filter(|c| c.question == Question::of(&setup)) {
        Some(consensus) => Method::majority_of(consensus.ballot.ids()),
        None => Ok(Preset::Default.settings(&Method)),
    };
    let settings = match settings {
        Ok(settings) => settings,
        Err(e) => {
            model.say(Tone::Warning, on_one_line(&e));
            return Vec::new();
        }
    };
    let after = Setup { method: &Method, settings, ..setup };
    let (votes, voters) = Method::votes(&after.settings);
    let effects = set_up(model, after);
    let undo = model.key(Action::Undo);
    model.say(
        Tone::Done,
        format!("consensus: an outlier is what {votes} or more of {voters} methods flag · {undo} undo"),
    );
    effects
}

fn next_agreed(model: &mut Model) {
    let Some(consensus) = model.state().consensus.clone() else {
        let text = match model.polling {
            Some(_) => "the methods are still running".into(),
            None => format!("{} runs all methods first", model.key(Action::Consensus)),
        };
        model.say(Tone::Warning, text);
        return;
    };
    let (half, methods) = (consensus.ballot.half(), consensus.ballot.methods());
    let Some((position, index, wrapped)) = step(&consensus.agreed, model.state().cursor, true) else {
        model.say(Tone::Warning, format!("no sample is flagged by {half} or more of {methods} methods"));
        return;
    };
    navigate::go_to(model, position);
    let votes = consensus.ballot.votes(position);
    let over = if wrapped { " · from the start again" } else { "" };
    let of = consensus.agreed.len();
    model.say(
        Tone::Done,
        format!("{votes} of {methods} methods flag it; sample {} of {of} with {half} or more{over}", index + 1),
    );
}
