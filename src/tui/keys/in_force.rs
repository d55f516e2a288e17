//! The key map in force: the table, or what the user's configuration puts in its place.

use ratatui::crossterm::event::KeyEvent;

use super::name::name_of;
use super::{Binding, Context, KEYMAP, shown};
use crate::tui::action::{Action, Panel};

/// A row of the key map with the keys that do it.
#[derive(Debug, Clone)]
pub struct Bound {
    /// The row.
    pub row: &'static Binding,
    /// The keys, as the table writes them; none when the configuration takes them all away.
    pub keys: Vec<String>,
}

/// The key map in force.
#[derive(Debug, Clone)]
pub struct Keys {
    rows: Vec<Bound>,
}

impl Default for Keys {
    fn default() -> Self {
        let own = |row: &'static Binding| row.keys.iter().map(|k| (*k).to_owned()).collect();
        Self { rows: KEYMAP.iter().map(|row| Bound { row, keys: own(row) }).collect() }
    }
}

/// What a key means.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Meaning {
    /// An action.
    Action(Action),
    /// The first key of several: wait for the next.
    Prefix(char),
    /// Nothing.
    Nothing,
}

impl Keys {
    /// All rows, in the order of the table.
    #[must_use]
    pub fn rows(&self) -> &[Bound] {
        &self.rows
    }

    /// The rows of a context.
    pub fn of(&self, context: Context) -> impl Iterator<Item = &Bound> {
        self.rows.iter().filter(move |b| b.row.context == context)
    }

    /// The rows of an action, to be changed by the configuration.
    pub fn rows_mut(&mut self) -> impl Iterator<Item = &mut Bound> {
        self.rows.iter_mut()
    }

    /// The meaning of a key after `prefix`, with the focus on `panel`. The panel's own rows go first.
    #[must_use]
    pub fn meaning(&self, key: KeyEvent, prefix: Option<char>, panel: Panel) -> Meaning {
        let Some(name) = name_of(key) else { return Meaning::Nothing };
        let name = prefix.map_or(name.clone(), |p| format!("{p} {name}"));
        let own = Context::of(panel);
        let has = |b: &&Bound| b.keys.contains(&name);
        let of_panel = self.rows.iter().filter(|b| Some(b.row.context) == own).find(has);
        let anywhere = || self.rows.iter().filter(|b| !b.row.context.is_own()).find(has);
        if let Some(bound) = of_panel.or_else(anywhere) {
            return Meaning::Action(bound.row.action);
        }
        let start = format!("{name} ");
        match name.chars().next() {
            Some(first) if prefix.is_none() && self.keys().any(|k| k.starts_with(&start)) => Meaning::Prefix(first),
            _ => Meaning::Nothing,
        }
    }

    fn keys(&self) -> impl Iterator<Item = &String> {
        self.rows.iter().flat_map(|b| &b.keys)
    }

    /// The first key of an action as people write it; none when no key does it.
    #[must_use]
    pub fn key_of(&self, action: Action) -> Option<String> {
        self.rows.iter().filter(|b| b.row.action == action).find_map(|b| b.keys.first()).map(|k| shown(k))
    }
}

impl Bound {
    /// Its keys as people write them.
    #[must_use]
    pub fn shown(&self) -> String {
        self.keys.iter().map(|k| shown(k)).collect::<Vec<_>>().join(" ")
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use ratatui::crossterm::event::{KeyCode, KeyModifiers};

    fn plain(c: char) -> KeyEvent {
        KeyEvent::new(KeyCode::Char(c), KeyModifiers::NONE)
    }

    #[test]
    fn panels_use_arrows_for_themselves_and_g_waits() {
        let keys = Keys::default();
        let left = KeyEvent::new(KeyCode::Left, KeyModifiers::NONE);
        assert_eq!(keys.meaning(left, None, Panel::Trace), Meaning::Action(Action::PanLeft));
        assert_eq!(keys.meaning(left, None, Panel::Parameters), Meaning::Action(Action::StepDown));
        assert_eq!(keys.meaning(plain('g'), None, Panel::Trace), Meaning::Prefix('g'));
        assert_eq!(keys.meaning(plain('a'), Some('g'), Panel::Trace), Meaning::Action(Action::AcceptView));
        assert_eq!(keys.meaning(plain('q'), Some('g'), Panel::Trace), Meaning::Nothing);
    }

    #[test]
    fn another_key_takes_the_place_of_the_table_s() {
        let mut keys = Keys::default();
        keys.rows_mut().filter(|b| b.row.action == Action::NextFlag).for_each(|b| b.keys = vec!["V".into()]);
        assert_eq!(keys.meaning(plain('V'), None, Panel::Trace), Meaning::Action(Action::NextFlag));
        assert_eq!(keys.meaning(plain('n'), None, Panel::Trace), Meaning::Nothing);
        assert_eq!(keys.key_of(Action::NextFlag).as_deref(), Some("V"));
    }
}
