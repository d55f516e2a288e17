//! Notes on decisions: free words, or a reason from a short list with words after it.

use super::super::action::Action;
use super::super::message::Effect;
use super::super::model::{Model, Overlay, Prompt, PromptKind, Tone, Unit};
use super::commit;
use super::decide::{self, flags_in};
use crate::review::Decision;
use crate::session::Edit;

/// Why samples are wild, or are not.
pub(in crate::tui) static REASONS: &[&str] = &[
    "glint",
    "multipath",
    "mis-read",
    "lost lock",
    "staging or manoeuvre, not wild",
    "telemetry error",
    "interference",
    "real, seen in another channel",
];

/// Separates a reason from further words.
const THEN: &str = ": ";

/// Asks for a note on what was decided. It is asked for in any case, so that what is typed next is never taken for
/// keys: without a decision the note waits for one.
pub(super) fn ask(model: &mut Model) -> Vec<Effect> {
    let rows = subject(model);
    let note = |(plan, row): &(usize, u32)| Some(model.session.plans.get(*plan)?.decisions.get(*row)?.note.clone());
    let waits = model.review.waiting.as_ref().filter(|(plan, row, _)| rows == [(*plan, *row)]);
    let text = rows.first().and_then(note).or(waits.map(|w| w.2.clone())).unwrap_or_default();
    let error = rows.is_empty().then(|| "there is no sample to write a note on: Esc leaves".to_owned());
    model.review.noting = rows;
    model.overlay = Overlay::Prompt(Prompt { error, ..Prompt::new(PromptKind::Note, &text) });
    Vec::new()
}

/// Plans and rows (from 0) that a note is about now: the decisions of the range, of the run or of the sample under
/// the cursor; since deciding goes on to the next flag, those made last; or else the sample under the cursor.
fn subject(model: &Model) -> Vec<(usize, u32)> {
    let (shown, cursor) = (model.shown, model.state().cursor);
    let series = model.series();
    let row = |p: usize| series.row_of(p).and_then(|r| u32::try_from(r).ok());
    let decided = |row: &u32| model.plan().decisions.get(*row).is_some();
    let here: Vec<usize> = match (model.selection(), model.group(cursor)) {
        (Some(range), _) => flags_in(model, &range),
        (None, Some(group)) if model.review.unit == Unit::Run => group.positions().collect(),
        _ => vec![cursor],
    };
    let rows: Vec<u32> = here.into_iter().filter_map(row).filter(decided).collect();
    if !rows.is_empty() {
        return rows.into_iter().map(|row| (shown, row)).collect();
    }
    let last = model.history.last().filter(|_| model.review.left_at == Some(cursor));
    let decisions = last.filter(|edit| edit.touched().iter().any(|(plan, _)| *plan == shown));
    let mut rows = Vec::new();
    for (plan, changed) in decisions.map(Edit::touched).unwrap_or_default() {
        let held = |row: &u32| model.session.plans.get(plan).is_some_and(|p| p.decisions.get(*row).is_some());
        rows.extend(changed.into_iter().filter(held).map(|row| (plan, row)));
    }
    if rows.is_empty() { row(cursor).map(|row| (shown, row)).into_iter().collect() } else { rows }
}

/// What a note is about, in words for the prompt.
#[must_use]
pub(in crate::tui) fn subject_words(model: &Model) -> String {
    match model.review.noting.as_slice() {
        [(_, row)] => format!("note on row {}: ", row + 1),
        rows => format!("note on {} decisions: ", rows.len()),
    }
}

/// Puts a note on what was asked about.
pub(super) fn set(model: &mut Model, text: &str) -> Vec<Effect> {
    let rows = std::mem::take(&mut model.review.noting);
    let text = text.trim();
    let mut edits: Vec<Edit> = Vec::new();
    let mut decided = 0;
    for &(plan, row) in &rows {
        let Some(before) = model.session.plans.get(plan).and_then(|p| p.decisions.get(row)).cloned() else { continue };
        decided += 1;
        let after = Decision { note: text.to_owned(), signature: model.signature(), ..before.clone() };
        let Some(change) = decide::changed(row, Some(before), Some(after)) else { continue };
        match edits.last_mut() {
            Some(Edit::Decide { plan: last, changes }) if *last == plan => changes.push(change),
            _ => edits.push(Edit::Decide { plan, changes: vec![change] }),
        }
    }
    if decided == 0 {
        wait(model, rows.first().copied(), text);
        return Vec::new();
    }
    let edit = if edits.len() > 1 { Some(Edit::Several(edits)) } else { edits.pop() };
    let Some(edit) = edit else { return Vec::new() };
    let effects = commit(model, edit);
    let on = match rows.as_slice() {
        [(_, row)] => format!("row {}", row + 1),
        several => format!("{} decisions", several.len()),
    };
    model.say(Tone::Done, format!("note on {on} · {} undo", model.key(Action::Undo)));
    effects
}

/// Keeps a note for the decision that it is about.
fn wait(model: &mut Model, about: Option<(usize, u32)>, text: &str) {
    model.review.waiting = about.filter(|_| !text.is_empty()).map(|(plan, row)| (plan, row, text.to_owned()));
    if let Some((_, row, _)) = &model.review.waiting {
        let text = format!("nothing is decided on row {}: the note waits for a, r or o there", row + 1);
        model.say(Tone::Warning, text);
    }
}

/// The place of a text's reason in [`REASONS`], if it begins with one, and the words after it.
#[must_use]
pub(in crate::tui) fn reason(text: &str) -> (Option<usize>, &str) {
    let found = REASONS.iter().enumerate().find_map(|(i, reason)| {
        let rest = text.strip_prefix(reason)?;
        if rest.is_empty() { Some((i, "")) } else { Some((i, rest.strip_prefix(THEN)?)) }
    });
    found.map_or((None, text), |(i, rest)| (Some(i), rest))
}

/// The text with the next or the previous reason of the list; past the ends stands none.
#[must_use]
pub(super) fn turned(text: &str, forward: bool) -> String {
    let (at, rest) = reason(text);
    let n = REASONS.len();
    // Place 0 is no reason.
    let at = at.map_or(0, |i| i + 1);
    let next = if forward { (at + 1) % (n + 1) } else { (at + n) % (n + 1) };
    match (next.checked_sub(1).and_then(|i| REASONS.get(i)), rest.is_empty()) {
        (None, _) => rest.to_owned(),
        (Some(reason), true) => (*reason).to_owned(),
        (Some(reason), false) => format!("{reason}{THEN}{rest}"),
    }
}

/// The text with the first reason that begins as it does; else as [`turned`].
#[must_use]
pub(super) fn completed(text: &str) -> String {
    let (at, rest) = reason(text);
    let begins = REASONS.iter().find(|r| at.is_none() && !rest.is_empty() && r.starts_with(rest));
    begins.map_or_else(|| turned(text, true), |reason| (*reason).to_owned())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn reasons_are_turned_through_and_words_after_them_stay() {
        assert_eq!(turned("", true), "glint");
        assert_eq!(turned("glint", true), "multipath");
        assert_eq!(turned("glint", false), "");
        assert_eq!(turned("at 12 km", true), "glint: at 12 km");
        assert_eq!(turned("glint: at 12 km", true), "multipath: at 12 km");
        assert_eq!(turned("glint: at 12 km", false), "at 12 km");
        assert_eq!(turned("", false), *REASONS.last().unwrap());
        let all = (0..=REASONS.len()).fold(String::from("why"), |text, _| turned(&text, true));
        assert_eq!(all, "why", "once around");
        assert_eq!(completed("lo"), "lost lock");
        assert_eq!(completed("lost lock"), REASONS[4]);
    }
}
