//! Taking a journal into a session that has changes of its own: decision by decision. What only one side changed
//! since the work began is taken from that side; where both changed it, and not alike, somebody has to choose.

use std::collections::BTreeSet;

use super::{Entry, replay};
use crate::review::{Change, Decision};
use crate::session::{Edit, Plan, Session, Setup};

/// What a conflict is about.
#[derive(Debug, Clone, PartialEq)]
pub enum Disputed {
    /// A sample.
    Decision {
        /// Its row, from 0.
        row: u32,
        /// What the session says, if anything.
        here: Option<Decision>,
        /// What the journal says, if anything.
        there: Option<Decision>,
    },
    /// Method, settings and repair.
    Setup {
        /// That of the session.
        here: Box<Setup>,
        /// That of the journal.
        there: Box<Setup>,
    },
}

/// Something that session and journal have both changed, and not alike.
#[derive(Debug, Clone, PartialEq)]
pub struct Conflict {
    /// Index of the plan.
    pub plan: usize,
    /// What it is about.
    pub about: Disputed,
}

/// What becomes of one thing that can differ.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Side {
    Here,
    There,
    Both,
}

/// A place where something can differ: a sample by its row, or the setup.
type Place = (usize, Option<u32>);

/// A journal beside the session that it is taken into.
pub struct Merge<'a> {
    entries: &'a [Entry],
    /// The session as the journal's work began.
    base: Session,
    /// Where the session holds; everywhere else the journal does.
    kept: BTreeSet<Place>,
    conflicts: Vec<Conflict>,
}

impl<'a> Merge<'a> {
    /// Compares what `entries` make of `base`, the plans that their work began from, with `session`. There is a plan of
    /// `base` for each of the session.
    #[must_use]
    pub fn new(session: &Session, base: &[Plan], entries: &'a [Entry]) -> Self {
        let base = Session { plans: base.to_vec(), ..session.clone() };
        let mut theirs = base.clone();
        replay(&mut theirs, entries);
        let mut merge = Self { entries, base, kept: BTreeSet::new(), conflicts: Vec::new() };
        for plan in 0..session.plans.len() {
            if let (Some(here), Some(there)) = (session.plans.get(plan), theirs.plans.get(plan)) {
                merge.compare(plan, here, there);
            }
        }
        merge
    }

    fn compare(&mut self, plan: usize, here: &Plan, there: &Plan) {
        let Some(base) = self.base.plans.get(plan).cloned() else { return };
        let side = side(&here.setup, &base.setup, &there.setup);
        let dispute = || Disputed::Setup { here: here.setup.clone().into(), there: there.setup.clone().into() };
        self.settle((plan, None), side, dispute);
        let all = [here, &base, there].map(|p| p.decisions.iter().map(|(row, _)| row));
        for row in all.into_iter().flatten().collect::<BTreeSet<u32>>() {
            let [here, base, there] = [here, &base, there].map(|p| p.decisions.get(row));
            let dispute = || Disputed::Decision { row, here: here.cloned(), there: there.cloned() };
            self.settle((plan, Some(row)), side_of_decision(here, base, there), dispute);
        }
    }

    fn settle(&mut self, place: Place, side: Side, about: impl FnOnce() -> Disputed) {
        if side != Side::There {
            self.kept.insert(place);
        }
        if side == Side::Both {
            self.conflicts.push(Conflict { plan: place.0, about: about() });
        }
    }

    /// What both have changed, by plan; of each the setup first, then the samples by row.
    #[must_use]
    pub fn conflicts(&self) -> &[Conflict] {
        &self.conflicts
    }

    /// Takes the journal into `session`, which is as it was compared; of the conflicts, those of `chosen`, by their
    /// indices, as the journal has it. Gives the edits that did it, one for each change of the journal, for undoing
    /// them.
    #[must_use]
    pub fn take(mut self, session: &mut Session, chosen: &[usize]) -> Vec<Edit> {
        for conflict in chosen.iter().filter_map(|index| self.conflicts.get(*index)) {
            let row = match conflict.about {
                Disputed::Decision { row, .. } => Some(row),
                Disputed::Setup { .. } => None,
            };
            self.kept.remove(&(conflict.plan, row));
        }
        let mut theirs = self.base.clone();
        let mut done = Vec::new();
        for entry in self.entries {
            let Some(edit) = entry.edit(&theirs) else { continue };
            theirs.apply(&edit);
            let mut own: Vec<Edit> = edit.parts().into_iter().filter_map(|part| self.part(part, session)).collect();
            let Some(own) = (if own.len() > 1 { Some(Edit::Several(own)) } else { own.pop() }) else { continue };
            session.apply(&own);
            done.push(own);
        }
        done
    }

    /// As much of an edit as is taken, on the session as it is; none when nothing is left.
    fn part(&self, edit: &Edit, session: &Session) -> Option<Edit> {
        match edit {
            Edit::Decide { plan, changes } => {
                let decisions = &session.plans.get(*plan)?.decisions;
                let taken = changes.iter().filter(|change| !self.kept.contains(&(*plan, Some(change.row))));
                let own = taken.map(|c| Change { before: decisions.get(c.row).cloned(), ..c.clone() });
                let changes: Vec<Change> = own.filter(|c| c.before != c.after).collect();
                (!changes.is_empty()).then_some(Edit::Decide { plan: *plan, changes })
            }
            Edit::Setup { plan, after, .. } => {
                let before = &session.plans.get(*plan)?.setup;
                let taken = !self.kept.contains(&(*plan, None)) && *before != **after;
                taken.then(|| Edit::Setup { plan: *plan, before: before.clone().into(), after: after.clone() })
            }
            Edit::Several(_) => None,
        }
    }
}

fn side<T: PartialEq>(here: &T, base: &T, there: &T) -> Side {
    if here == base {
        Side::There
    } else if here == there || there == base {
        Side::Here
    } else {
        Side::Both
    }
}

/// The same of decisions. A note beside none is no conflict.
fn side_of_decision(here: Option<&Decision>, base: Option<&Decision>, there: Option<&Decision>) -> Side {
    // What the method said then is nothing that anybody decided.
    let plain = |d: Option<&Decision>| d.map(|d| (d.ruling, d.note.clone()));
    let side = side(&plain(here), &plain(base), &plain(there));
    match (here, there) {
        (Some(here), Some(there)) if side == Side::Both && here.ruling == there.ruling => {
            match (here.note.is_empty(), there.note.is_empty()) {
                (true, _) => Side::There,
                (_, true) => Side::Here,
                _ => side,
            }
        }
        _ => side,
    }
}

#[cfg(test)]
mod tests;
