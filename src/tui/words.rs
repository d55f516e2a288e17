//! Words of what the program says: counts with their noun, and hints that name the key in force.

use super::action::Action;
use super::keys::{Keys, shown};

/// A count with its noun.
pub(super) fn counted(n: usize, noun: &str) -> String {
    format!("{n} {noun}{}", plural(n))
}

/// The ending of a noun after a count.
pub(super) fn plural(n: usize) -> &'static str {
    if n == 1 { "" } else { "s" }
}

/// Hints in what the program says. They are written with the keys of the table, where they are easy to read; whoever
/// has other keys in its place reads those.
const HINTS: &[(&str, Action)] = &[
    ("{} undo", Action::Undo),
    ("{} redo", Action::Redo),
    ("{} next picture", Action::NextLower),
    ("{} next of them", Action::NextAgreed),
    ("{} next difference", Action::NextDifference),
    ("{} back to A", Action::AdoptPinned),
    ("{} unpins", Action::Pin),
    ("{} pins", Action::Pin),
    ("{} asks all", Action::Consensus),
    ("{} goes to the next, o", Action::NextFlag),
    ("{} goes to the next", Action::NextSuspect),
    ("{} accepts it", Action::Accept),
    ("{} rejects it", Action::Reject),
    ("{} flags", Action::ByHand),
    ("{} again takes it", Action::Suggested),
    ("{} again to quit", Action::Interrupt),
    ("(or {})", Action::Quit),
];

/// Text with the keys in force in its hints.
pub(super) fn in_force(keys: &Keys, text: &str) -> String {
    let mut text = text.to_owned();
    for (hint, action) in HINTS {
        let Some(bound) = keys.rows().iter().find(|b| b.row.action == *action) else { continue };
        let (Some(table), now) = (bound.row.keys.first(), bound.keys.first()) else { continue };
        if now.is_some_and(|now| now == table) {
            continue;
        }
        // Without a key, the command of that name is left.
        let now = now.map_or_else(|| format!(":{}", action.name()), |key| written(key));
        let (before, after) = (hint.replace("{}", &written(table)), hint.replace("{}", &now));
        if let Some(at) = text.find(&before).filter(|at| starts(&text[..*at], hint)) {
            text.replace_range(at..at + before.len(), &after);
        }
    }
    text
}

/// The key of an action, or the command of its name where no key does it.
pub(super) fn key(keys: &Keys, action: Action) -> String {
    keys.key_of(action).unwrap_or_else(|| format!(":{}", action.name()))
}

/// The keys that are about a range.
pub(super) fn of_range(keys: &Keys) -> String {
    let about = [Action::Accept, Action::Reject, Action::Clear, Action::Toggle, Action::ByHand];
    about.map(|action| key(keys, action)).join(" ")
}

/// A key as hints write it: of two in a row, both can be told apart.
fn written(key: &str) -> String {
    if key.contains(' ') { key.to_owned() } else { shown(key) }
}

/// True where a hint can start: at the beginning, or after a mark. `n` is not meant where it says `g n`.
fn starts(before: &str, hint: &str) -> bool {
    hint.starts_with('(') || before.trim_end().chars().next_back().is_none_or(|c| !c.is_alphanumeric())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn with(action: Action, keys: &[&str]) -> Keys {
        let mut all = Keys::default();
        let keys: Vec<String> = keys.iter().map(|k| (*k).to_owned()).collect();
        all.rows_mut().filter(|b| b.row.action == action).for_each(|b| b.keys.clone_from(&keys));
        all
    }

    #[test]
    fn one_is_not_many() {
        assert_eq!([0, 1, 2].map(|n| counted(n, "flag")), ["0 flags", "1 flag", "2 flags"]);
    }

    #[test]
    fn hints_name_the_keys_in_force() {
        let text = "accepted row 7 · u undo";
        assert_eq!(in_force(&Keys::default(), text), text);
        assert_eq!(in_force(&with(Action::Undo, &["ctrl-u"]), text), "accepted row 7 · Ctrl-U undo");
        assert_eq!(in_force(&with(Action::Undo, &[]), text), "accepted row 7 · :undo undo");
        let quit = "Ctrl-C again to quit (or q)";
        assert_eq!(in_force(&with(Action::Quit, &["ctrl-q"]), quit), "Ctrl-C again to quit (or Ctrl-Q)");
        assert_eq!(in_force(&with(Action::Interrupt, &["ctrl-x"]), quit), "Ctrl-X again to quit (or q)");
    }

    #[test]
    fn a_key_after_another_is_another() {
        let text = "no flags, only suspects: g n goes to the next";
        assert_eq!(in_force(&with(Action::NextFlag, &["j"]), text), text);
        let other = "no flags, only suspects: S goes to the next";
        assert_eq!(in_force(&with(Action::NextSuspect, &["S"]), text), other);
        let note = "menu undo is a word of the user";
        assert_eq!(in_force(&with(Action::Undo, &["X"]), note), note);
    }
}
