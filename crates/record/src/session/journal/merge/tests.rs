use proptest::prelude::*;

use super::*;
use crate::review::{Decisions, Ruling, Signature};
use crate::session::{Data, OutputValue};
use crate::track::{LoadOptions, Source};

const ROWS: u32 = 6;

fn session() -> Session {
    let plan = |name: &str| Plan::new(name.into(), Setup::standard(), Decisions::default());
    let source = Source::File("/nowhere/record.csv".into());
    let data = Data {
        source,
        sha256: "ab".into(),
        bytes: None,
        record_was: None,
        rows: 50,
        row_check: None,
        options: LoadOptions::default(),
    };
    Session { data, plans: ["v", "w"].map(plan).into(), value: OutputValue::Clean, result: None }
}

fn decision(outlier: bool, note: &str) -> Option<Decision> {
    let ruling = if outlier { Ruling::Outlier } else { Ruling::Normal };
    Some(Decision { ruling, note: note.into(), said: None, signature: Signature::default() })
}

fn decide(row: u32, decision: Option<Decision>) -> Entry {
    Entry::Decide { channel: "v".into(), decisions: vec![(row, decision)] }
}

/// All of the channel with these decisions.
fn whole(decisions: &[(u32, Option<Decision>)]) -> Entry {
    let mut plan = session().plans.swap_remove(0);
    decisions.iter().for_each(|(row, d)| plan.decisions.set(*row, d.clone()));
    Entry::Whole(Box::new(plan))
}

/// Decisions by row: nothing, outlier, normal, outlier with a note.
fn states() -> impl Strategy<Value = Vec<Option<Decision>>> {
    let one = prop_oneof![
        2 => Just(None),
        1 => Just(decision(true, "")),
        1 => Just(decision(false, "")),
        1 => Just(decision(true, "glint")),
    ];
    prop::collection::vec(one, ROWS as usize)
}

fn with(states: &[Option<Decision>]) -> Session {
    let mut session = session();
    (0..).zip(states).for_each(|(row, d)| session.plans[0].decisions.set(row, d.clone()));
    session
}

proptest! {
    /// By the definition of a merge, row by row: what one side alone changed is as that side has it, what both changed
    /// alike is so, and the rest is asked about.
    #[test]
    fn a_merge_keeps_what_either_side_has_done(base in states(), here in states(), there in states(), all: bool) {
        let began = with(&base);
        let mut session = with(&here);
        let before = session.plans.clone();
        let whole: Vec<_> = (0..).zip(there.iter().cloned()).filter(|(_, d)| d.is_some()).collect();
        let entries = [super::tests::whole(&whole)];
        let merge = Merge::new(&session, &began.plans, &entries);
        let asked: Vec<u32> = merge.conflicts().iter().map(|c| match c.about {
            Disputed::Decision { row, .. } => row,
            Disputed::Setup { .. } => panic!("no setup was changed"),
        }).collect();
        let chosen: Vec<usize> = if all { (0..asked.len()).collect() } else { Vec::new() };
        let edits = merge.take(&mut session, &chosen);
        for row in 0..ROWS {
            let at = row as usize;
            let now = session.plans[0].decisions.get(row).cloned();
            let expected = if asked.contains(&row) {
                prop_assert!(here[at] != base[at] && there[at] != base[at] && here[at] != there[at]);
                if all { there[at].clone() } else { here[at].clone() }
            } else if here[at] == base[at] {
                there[at].clone()
            } else if there[at] == base[at] || here[at] == there[at] {
                here[at].clone()
            } else {
                // The same verdict, with a note on one side: the note is kept.
                decision(true, "glint")
            };
            prop_assert_eq!(now, expected, "row {}", row);
        }
        edits.iter().rev().for_each(|edit| session.revert(edit));
        prop_assert_eq!(session.plans, before, "undone to the last bit");
    }
}

#[test]
fn each_change_of_the_journal_can_be_undone_by_itself() {
    let mut session = with(&[decision(true, "")]);
    let base = self::session().plans;
    let entries = [whole(&[(3, decision(true, ""))]), decide(4, decision(false, "")), decide(3, None)];
    let merge = Merge::new(&session, &base, &entries);
    assert_eq!(merge.conflicts(), []);
    let edits = merge.take(&mut session, &[]);
    let rows = |session: &Session| session.plans[0].decisions.iter().map(|(row, _)| row).collect::<Vec<_>>();
    assert_eq!((rows(&session), edits.len()), (vec![0, 4], 3));
    session.revert(&edits[2]);
    assert_eq!(rows(&session), [0, 3, 4]);
}

#[test]
fn settings_that_both_have_changed_are_asked_about() {
    let mut session = session();
    let base = session.plans.clone();
    let turned = |k: &str| {
        let mut setup = Setup::standard();
        setup.set_text("k", k).unwrap();
        setup
    };
    session.plans[0].setup = turned("5");
    let entries = [Entry::Setup { channel: "v".into(), setup: turned("6").into() }];
    let merge = Merge::new(&session, &base, &entries);
    assert!(matches!(merge.conflicts(), [Conflict { plan: 0, about: Disputed::Setup { .. } }]));
    let mut kept = session.clone();
    assert_eq!(merge.take(&mut kept, &[]), []);
    let edits = Merge::new(&session, &base, &entries).take(&mut session, &[0]);
    assert_eq!((edits.len(), &session.plans[0].setup), (1, &turned("6")));
    // Where nobody here has turned it, the journal's holds.
    let mut fresh = self::session();
    let _ = Merge::new(&fresh, &base, &entries).take(&mut fresh, &[]);
    assert_eq!(fresh.plans[0].setup, turned("6"));
}
