//! Words of what the program says: counts with their noun, and the key in force of an action.

use super::action::Action;
use super::keys::Keys;
pub(super) use crate::counted::{counted, plural};

/// The key of an action, or the command of its name where no key does it.
pub(super) fn key(keys: &Keys, action: Action) -> String {
    keys.key_of(action).unwrap_or_else(|| format!(":{}", action.name()))
}

/// The keys that are about a range.
pub(super) fn of_range(keys: &Keys) -> String {
    let about = [Action::Accept, Action::Reject, Action::Clear, Action::Toggle, Action::ByHand];
    about.map(|action| key(keys, action)).join(" ")
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
    fn hints_name_the_keys_in_force() {
        assert_eq!(key(&Keys::default(), Action::Undo), "u");
        assert_eq!(key(&with(Action::Undo, &["ctrl-u"]), Action::Undo), "Ctrl-U");
        assert_eq!(key(&with(Action::Undo, &[]), Action::Undo), ":undo");
        assert_eq!(of_range(&with(Action::Toggle, &["t"])), "a r x t o");
    }
}
