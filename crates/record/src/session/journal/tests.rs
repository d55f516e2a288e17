use proptest::prelude::*;

use super::*;
use crate::method::{METHODS, Verdict};
use crate::review::{History, Ruling, Signature};
use crate::session::{Data, OutputValue, Preset};
use crate::track::{LoadOptions, Source};

const ROWS: usize = 50;

/// A session on a record that nobody reads.
fn session() -> Session {
    let plan = |name: &str| Plan::new(name.into(), Setup::standard(), Decisions::default());
    let source = Source::File("/nowhere/record.csv".into());
    let data = Data {
        source,
        sha256: "ab".into(),
        bytes: None,
        rows: ROWS,
        record_was: None,
        row_check: None,
        options: LoadOptions::default(),
    };
    Session { data, plans: ["v", "alt \"m\"\n", "高度"].map(plan).into(), value: OutputValue::Clean, result: None }
}

fn header(begun: usize) -> Header {
    let base = Some(Base { path: "/nowhere/a b.toml".into(), sha256: "cd".into() });
    Header {
        record: "/nowhere/record.csv".into(),
        sha256: "ab".into(),
        rows: ROWS,
        bytes: None,
        base,
        begun,
        carried: 0,
    }
}

/// Something an analyst does.
#[derive(Debug, Clone)]
enum Deed {
    Decide(usize, Vec<(u32, Option<bool>)>, String),
    Method(usize, usize, bool),
    Step(usize, usize, i64),
    Repair(usize, usize, i64),
    /// Deeds on the same channel or on others, at once.
    Several(Box<[Deed; 3]>),
    Undo,
    Redo,
}

fn deed() -> impl Strategy<Value = Deed> {
    prop_oneof![
        4 => single_deed(),
        1 => [single_deed(), single_deed(), single_deed()].prop_map(|deeds| Deed::Several(Box::new(deeds))),
    ]
}

fn single_deed() -> impl Strategy<Value = Deed> {
    let plan = 0..3_usize;
    let rows = prop::collection::vec((0..ROWS as u32, any::<Option<bool>>()), 1..4);
    prop_oneof![
        4 => (plan.clone(), rows, any::<String>()).prop_map(|(p, r, n)| Deed::Decide(p, r, n)),
        1 => (plan.clone(), 0..METHODS.len(), any::<bool>()).prop_map(|(p, m, paper)| Deed::Method(p, m, paper)),
        2 => (plan.clone(), 0..20_usize, -5..5_i64).prop_map(|(p, k, s)| Deed::Step(p, k, s)),
        1 => (plan, 0..20_usize, -5..5_i64).prop_map(|(p, k, s)| Deed::Repair(p, k, s)),
        3 => Just(Deed::Undo),
        2 => Just(Deed::Redo),
    ]
}

/// The edit a deed makes; none for one that changes nothing, or walks through the history.
fn edit_of(deed: &Deed, session: &Session) -> Option<Edit> {
    let setup = |plan: usize, after: Setup| {
        let before = Box::new(session.plans[plan].setup.clone());
        Some(Edit::Setup { plan, before, after: Box::new(after) })
    };
    let turned = |settings: &mut crate::param::Settings, knob: usize, steps: i64| {
        let (param, value) = settings.iter().nth(knob % settings.params().len()).unwrap();
        settings.set("test", param.key, param.step(value, steps)).unwrap();
    };
    match deed {
        Deed::Decide(plan, rows, note) => {
            let mut changes: Vec<Change> = Vec::new();
            for (row, wild) in rows {
                let ruling = wild.map(|wild| if wild { Ruling::Outlier } else { Ruling::Normal });
                let said = Some(Verdict::ALL[*row as usize % 5]).filter(|v| *v != Verdict::Missing);
                let by = (!note.is_empty()).then(|| note.as_str().into());
                let signature = Signature { by, at: wild.map(|_| i64::from(*row) * 86_399) };
                let after = ruling.map(|ruling| Decision { ruling, note: note.clone(), said, signature });
                if changes.iter().all(|c| c.row != *row) {
                    let before = session.plans[*plan].decisions.get(*row).cloned();
                    changes.push(Change { row: *row, before, after });
                }
            }
            Some(Edit::Decide { plan: *plan, changes })
        }
        Deed::Method(plan, method, paper) => {
            let preset = if *paper { Preset::Paper } else { Preset::Default };
            let mut after = Setup::new(METHODS[*method], preset);
            after.rate = paper.then(|| "高度".to_owned());
            setup(*plan, after)
        }
        Deed::Step(plan, knob, steps) => {
            let mut after = session.plans[*plan].setup.clone();
            turned(&mut after.settings, *knob, *steps);
            setup(*plan, after)
        }
        Deed::Repair(plan, knob, steps) => {
            let mut after = session.plans[*plan].setup.clone();
            turned(&mut after.repair, *knob, *steps);
            setup(*plan, after)
        }
        Deed::Several(deeds) => {
            // Each follows on what those before it have made of the session.
            let mut between = session.clone();
            let edits = deeds.iter().filter_map(|deed| edit_of(deed, &between).inspect(|e| between.apply(e)));
            Some(Edit::Several(edits.collect())).filter(|several| !several.parts().is_empty())
        }
        Deed::Undo | Deed::Redo => None,
    }
}

/// What came of some deeds: the bytes of the journal, and the plans after each of its lines.
fn lived(deeds: &[Deed], begun: bool) -> (Vec<u8>, Vec<Vec<Plan>>) {
    let mut session = session();
    let mut history: History<Edit> = History::default();
    let (mut scribe, first) = if begun { Scribe::beginning(&session.plans) } else { (Scribe::default(), Vec::new()) };
    let (mut encoder, mut text) = Encoder::new(&header(first.len()));
    let mut states = vec![session.plans.clone()];
    for entry in &first {
        text += &encoder.entry(entry);
        states.push(session.plans.clone());
    }
    for deed in deeds {
        let edit = match deed {
            Deed::Undo => history.undo().inspect(|e| session.revert(e)),
            Deed::Redo => history.redo().inspect(|e| session.apply(e)),
            _ => edit_of(deed, &session).inspect(|e| {
                session.apply(e);
                history.push(e.clone());
            }),
        };
        let Some(edit) = edit else { continue };
        text += &encoder.entry(&scribe.entry(&session.plans, &edit.touched()).unwrap());
        states.push(session.plans.clone());
    }
    (text.into_bytes(), states)
}

proptest! {
    #[test]
    fn an_edit_that_is_made_and_taken_back_leaves_nothing(deeds in prop::collection::vec(deed(), 1..12)) {
        let mut session = session();
        for deed in &deeds {
            let Some(edit) = edit_of(deed, &session) else { continue };
            let before = session.plans.clone();
            session.apply(&edit);
            let after = session.plans.clone();
            session.revert(&edit);
            prop_assert_eq!(&session.plans, &before);
            session.apply(&edit);
            prop_assert_eq!(&session.plans, &after);
        }
    }
}

fn plans_of(journal: &Journal) -> Vec<Plan> {
    let mut session = session();
    replay(&mut session, &journal.entries);
    session.plans
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(200))]

    #[test]
    fn a_replayed_journal_gives_the_plans_and_any_cut_gives_those_of_a_moment(
        deeds in prop::collection::vec(deed(), 0..25),
        begun in any::<bool>(),
        cuts in prop::collection::vec(any::<prop::sample::Index>(), 20),
    ) {
        let (bytes, states) = lived(&deeds, begun);
        let journal = decode(&bytes).unwrap();
        prop_assert!(journal.complete && journal.entries.len() + 1 == states.len());
        prop_assert_eq!(&plans_of(&journal), states.last().unwrap());
        for cut in cuts {
            let at = cut.index(bytes.len() + 1);
            let lines = bytes[..at].iter().filter(|b| **b == b'\n').count();
            match decode(&bytes[..at]) {
                None => prop_assert_eq!(lines, 0, "the first line is whole"),
                Some(part) => {
                    prop_assert_eq!(part.entries.len() + 1, lines);
                    prop_assert_eq!(part.complete, bytes[at - 1] == b'\n');
                    prop_assert_eq!(&plans_of(&part), &states[lines - 1]);
                }
            }
        }
    }

    #[test]
    fn taking_back_in_can_be_undone_edit_by_edit(deeds in prop::collection::vec(deed(), 0..25)) {
        let (bytes, _) = lived(&deeds, false);
        let mut now = session();
        // Something else was begun meanwhile: it must not show through.
        now.plans[0].decisions.set(7, Some(Decision { ruling: Ruling::Normal, note: "mine".into(), said: None, signature: Signature::default() }));
        let before = now.plans.clone();
        let edits = replay(&mut now, &decode(&bytes).unwrap().entries);
        edits.iter().rev().for_each(|edit| now.revert(edit));
        prop_assert_eq!(now.plans, before);
    }

    #[test]
    fn a_flipped_bit_ends_the_journal_before_its_line(
        deeds in prop::collection::vec(deed(), 1..10),
        at in any::<prop::sample::Index>(),
        bit in 0..8_u32,
    ) {
        let (mut bytes, states) = lived(&deeds, true);
        let at = at.index(bytes.len());
        let line = bytes[..at].iter().filter(|b| **b == b'\n').count();
        bytes[at] ^= 1 << bit;
        let read = decode(&bytes);
        prop_assert_eq!(read.as_ref().map_or(0, |j| j.entries.len() + 1), line);
        if let Some(journal) = read {
            prop_assert_eq!(&plans_of(&journal), &states[line - 1]);
        }
    }

    #[test]
    fn anything_at_all_is_read_without_a_panic(bytes in prop::collection::vec(any::<u8>(), 0..400)) {
        prop_assert!(decode(&bytes).is_none());
    }
}

#[test]
fn a_lost_line_and_a_line_of_another_journal_end_it() {
    let deeds: Vec<Deed> = (0..4).map(|row| Deed::Decide(0, vec![(row, Some(true))], String::new())).collect();
    let (bytes, states) = lived(&deeds, true);
    let text = String::from_utf8(bytes).unwrap();
    let lines: Vec<&str> = text.split_inclusive('\n').collect();
    let without: String = [&lines[..5], &lines[6..]].concat().concat();
    let read = decode(without.as_bytes()).unwrap();
    assert_eq!((read.entries.len(), read.complete, &plans_of(&read)), (4, false, &states[4]));
    let (other, _) = lived(&deeds, false);
    let other = String::from_utf8(other).unwrap();
    let foreign = format!("{text}{}", other.lines().last().unwrap().to_owned() + "\n");
    let read = decode(foreign.as_bytes()).unwrap();
    assert_eq!((read.changes(), read.complete), (4, false));
}

#[test]
fn rows_outside_the_record_and_words_that_mean_nothing_are_not_taken_in() {
    let first = header(0);
    let good = r#"{"channel":"v","changes":[{"row":50,"verdict":"outlier"}]}"#;
    assert!(written::entry_of(good, ROWS).is_some());
    for (from, to) in [("50", "51"), ("50", "0"), ("50", "99999999999"), ("outlier", "suspect"), ("row", "column")] {
        assert_eq!(written::entry_of(&good.replace(from, to), ROWS), None, "{to}");
    }
    let other = written::header_text(&first).replace("\"format\":1", "\"format\":2");
    assert_eq!((written::header_of(&other), written::header_of(&written::header_text(&first))), (None, Some(first)));
}

#[test]
fn what_is_done_before_the_method_comes_back() {
    use crate::check::Applied;
    let mut plan = session().plans.swap_remove(1);
    let preparation = &mut plan.setup.preparation;
    for text in ["missing-values:values=-9999,1e20", "stuck:fail=20", "position:channels=a,b,speed=30", "hampel:k=7"] {
        preparation.add(Applied::parse(text).unwrap());
    }
    preparation.checks[1].on = false;
    preparation.checks[2].channels[0] = "a, \"b\"".into();
    (preparation.period, preparation.exclude_decided) = (Some(std::f64::consts::TAU), true);
    let entry = Entry::of(&plan, &[]);
    assert_eq!(written::entry_of(&written::entry_text(&entry), ROWS), Some(entry));
}
