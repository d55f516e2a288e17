//! Flags as marks: one shape and one colour for each state.

use std::collections::BTreeSet;
use std::fmt::Write as _;

use super::axes::{Edge, Frame, c};
use crate::plot::FlagState;

/// The states in the order of legends, with their classes, shapes as characters, and words.
pub(in crate::report) const STATES: [(FlagState, &str, &str, &str); 5] = [
    (FlagState::Unreviewed, "unreviewed", "●", "flagged by the method"),
    (FlagState::Accepted, "accepted", "×", "accepted by the analyst"),
    (FlagState::ByHand, "byhand", "◆", "flagged by the analyst"),
    (FlagState::Rejected, "rejected", "○", "overruled: kept"),
    (FlagState::Suspect, "suspect", "△", "suspect: kept"),
];

/// The class under which a state is styled.
fn class_of(state: FlagState) -> &'static str {
    STATES.iter().find(|s| s.0 == state).map_or("", |s| s.1)
}

/// From this many marks on, marks closer together than a few units are drawn once.
const MANY: usize = 2000;
/// How close that is.
const CLOSE: f64 = 3.0;

/// The marks of flags at x and y with their states; each has its mark, or one within [`CLOSE`] units of it.
pub(super) fn draw(flags: &[(f64, f64, FlagState)], frame: Frame, out: &mut String) {
    // The most urgent state is drawn last, over the others.
    for state in FlagState::BY_URGENCY.into_iter().rev() {
        let mut places = Places::new(flags.len());
        let mut path = String::new();
        let mut beyond = String::new();
        for (x, y, _) in flags.iter().filter(|f| f.2 == state && f.0.is_finite() && !f.1.is_nan()) {
            let x = frame.x(*x);
            let (y, edge) = frame.marked(*y);
            if places.is_free(x, y, edge) {
                match edge {
                    Some(edge) => beyond.push_str(&arrow(x, y, edge)),
                    None => path.push_str(&shape(state, x, y)),
                }
            }
        }
        for (class, path) in [("mark", path), ("mark beyond", beyond)] {
            if !path.is_empty() {
                let _ = write!(out, r#"<path class="{class} {}" d="{path}"/>"#, class_of(state));
            }
        }
    }
}

/// Places in a picture that are taken.
pub(super) struct Places {
    cell: f64,
    taken: BTreeSet<(i64, i64, Option<Edge>)>,
}

impl Places {
    /// For this many marks.
    pub(super) fn new(marks: usize) -> Self {
        Self { cell: if marks > MANY { CLOSE } else { 0.1 }, taken: BTreeSet::new() }
    }

    /// Takes a place; false when there is a mark already.
    #[expect(clippy::cast_possible_truncation, reason = "within a picture")]
    pub(super) fn is_free(&mut self, x: f64, y: f64, edge: Option<Edge>) -> bool {
        self.taken.insert(((x / self.cell) as i64, (y / self.cell) as i64, edge))
    }
}

fn shape(state: FlagState, x: f64, y: f64) -> String {
    match state {
        FlagState::Unreviewed => format!("M{} {}a3.2 3.2 0 1 0 6.4 0a3.2 3.2 0 1 0-6.4 0z", c(x - 3.2), c(y)),
        FlagState::Accepted => format!("M{} {}l7 7m0-7l-7 7", c(x - 3.5), c(y - 3.5)),
        FlagState::ByHand => format!("M{} {}l4.2 4.2-4.2 4.2-4.2-4.2z", c(x), c(y - 4.2)),
        FlagState::Rejected => format!("M{} {}a3.5 3.5 0 1 0 7 0a3.5 3.5 0 1 0-7 0z", c(x - 3.5), c(y)),
        FlagState::Suspect => format!("M{} {}l4 7h-8z", c(x), c(y - 4.5)),
    }
}

fn arrow(x: f64, y: f64, edge: Edge) -> String {
    match edge {
        Edge::Above => format!("M{} {}l4 7h-8z", c(x), c(y - 4.0)),
        Edge::Below => format!("M{} {}l4-7h-8z", c(x), c(y + 4.0)),
    }
}
