//! Frames of the pictures below, beside and over the trace: histogram, steps of time, A against B, all methods at once,
//! a second channel.

#![expect(clippy::unwrap_used, reason = "a failed expectation is a failed test")]

mod workbench;

use insta::assert_snapshot;
use wildpoint::param::Value;
use wildpoint::plot::Side;
use wildpoint::stop::Stop;
use wildpoint::tui::detectability::{Copies, Finding, Job};
use wildpoint::tui::message::{Effect, Message};
use wildpoint::tui::update::update;

use workbench::{ASCII_MONO, Bench, UNICODE_DARK, frames};

/// Keeps a frame at both sizes, under `name` and the size.
fn both(name: &str, keys: &str) {
    for (label, frame) in frames(keys) {
        assert_snapshot!(format!("{name}_{label}"), frame);
    }
}

#[test]
fn histogram_below_the_trace() {
    both("histogram", "R");
}

#[test]
fn steps_of_time_below_the_trace() {
    both("steps", "R R");
}

#[test]
fn residual_with_its_logarithm_over_sample_numbers() {
    both("by_number", "L X n z -");
}

#[test]
fn a_range_that_stays_and_chosen_layers() {
    both("fixed_range", ":y Space -50 Space 150 Enter :layers Space raw Space band Enter");
}

#[test]
fn pictures_in_ascii() {
    for (name, keys) in [("histogram", "R"), ("steps", "R R")] {
        let bench = Bench::on("demo.csv", ASCII_MONO).keys(keys);
        assert_snapshot!(format!("ascii_{name}"), bench.frame());
        assert!(bench.frame().is_ascii());
    }
}

#[test]
fn x_keeps_the_samples_in_view_when_it_becomes_the_number_and_back() {
    let time = Bench::on("demo.csv", UNICODE_DARK).keys("n n z");
    let (view, samples) = (time.0.state().view, time.0.in_view());
    let number = time.keys("X");
    assert_eq!(number.0.in_view(), samples);
    // All rows of the record have a value: the number of a sample is its row.
    assert!((number.0.state().view.from - samples.start as f64).abs() < 1.0);
    let back = number.keys("X");
    assert_eq!(back.0.in_view(), samples);
    let near = |a: f64, b: f64| (a - b).abs() < 1e-9 * b.abs();
    assert!(near(back.0.state().view.from, view.from) && near(back.0.state().view.to, view.to));
}

#[test]
fn a_against_b() {
    both("a_against_b", "B :set Space k Space 12 Enter g d z");
}

#[test]
fn a_against_another_method_in_ascii() {
    let bench = Bench::on("demo.csv", ASCII_MONO).size((120, 40)).keys("B :method Space hampel Enter g d");
    assert_snapshot!("ascii_a_against_b", bench.frame());
    assert!(bench.frame().is_ascii());
}

#[test]
fn all_methods_at_once() {
    both("consensus", "C g h");
}

/// At 80 columns the card is too small for their names: with room it has them.
#[test]
fn the_whole_card_names_the_methods_that_flag_the_sample() {
    for size in [(80, 24), (120, 40)] {
        let bench = Bench::on("demo.csv", UNICODE_DARK).size(size).keys("C g h 5 w");
        let (ballot, at) = (&bench.0.state().consensus.as_ref().unwrap().ballot, bench.0.state().cursor);
        let others = ballot.others(at);
        assert!(!others.is_empty() && others.len() < ballot.methods() - others.len(), "{others:?}");
        let shown: String = bench.frame().split_whitespace().collect::<Vec<_>>().join(" ");
        let said =
            format!("{} of {} methods flag it: all but {}", ballot.votes(at), ballot.methods(), others.join(", "));
        assert!(shown.contains(&said), "{said}\n{}", bench.frame());
    }
}

/// Where the card has no room for their names, they stand below the picture; there the picture keeps its place.
#[test]
fn below_its_picture_the_methods_that_flag_the_sample_are_named() {
    for (size, keys) in [((80, 24), "C"), ((109, 40), "C"), ((80, 24), "C 2 w"), ((60, 16), "C 2 w")] {
        let mut bench = Bench::on("demo.csv", UNICODE_DARK).size(size).keys(keys);
        let heading = |bench: &Bench| bench.frame().lines().position(|line| line.contains("2 all methods"));
        let (at, mut seen) = (heading(&bench), Vec::new());
        assert!(at.is_some(), "{}", bench.frame());
        // Single votes and most of them, few names and many.
        for row in (1..2356).step_by(97).chain([61, 91, 200, 323, 485]) {
            bench = bench.keys(&format!("/#{row} Enter"));
            let (ballot, cursor) = (&bench.0.state().consensus.as_ref().unwrap().ballot, bench.0.state().cursor);
            let (voters, others) = (ballot.voters(cursor), ballot.others(cursor));
            let names = match (voters.len(), others.len()) {
                (0, _) => "no method".to_owned(),
                (a, b) if a <= b => voters.join(", "),
                _ => format!("all but {}", others.join(", ")),
            };
            let shown: String = bench.frame().split_whitespace().collect::<Vec<_>>().join(" ");
            assert!(shown.contains(&format!("#{row} flagged by {names}")), "{names}\n{}", bench.frame());
            assert_eq!(heading(&bench), at);
            seen.push(voters.len());
        }
        assert!(seen.contains(&0) && seen.iter().any(|n| *n > 9), "{seen:?}");
    }
}

#[test]
fn a_second_channel_on_a_wide_screen() {
    let bench = Bench::on("demo.csv", UNICODE_DARK).size((200, 60)).keys("d d n n n");
    assert_snapshot!("second_channel_200x60", bench.frame());
    let zoomed = bench.keys("z X C");
    assert_snapshot!("second_channel_by_number_200x60", zoomed.frame());
    let alone = zoomed.keys("V none Enter");
    assert!(!alone.frame().contains("V another"), "{}", alone.frame());
}

/// The counts of only A, only B and both, of the channel on the screen.
fn sides(bench: &Bench) -> [usize; 3] {
    bench.0.state().pinned.as_ref().unwrap().sides.as_ref().unwrap().counts()
}

/// Positions that the method flags now.
fn flagged(bench: &Bench) -> Vec<u32> {
    let drawn = bench.0.state().drawn.as_ref().unwrap();
    let verdicts = drawn.outcome.detection.judged.verdict().iter();
    (0..).zip(verdicts).filter(|(_, v)| **v == wildpoint::method::Verdict::Outlier).map(|(i, _)| i).collect()
}

#[test]
fn what_only_a_flags_is_counted_walked_and_taken_back_as_one_edit() {
    let bench = Bench::on("demo.csv", UNICODE_DARK).size((120, 40));
    let a = flagged(&bench);
    let bench = bench.keys("B");
    assert_eq!(sides(&bench), [0, 0, a.len()], "B is A until something changes");
    let bench = bench.keys(". . . . . . . . . . . . . . . . . . . . . . . . . . . . . . . . . . . . . . . .");
    let b = flagged(&bench);
    let only_a: Vec<u32> = a.iter().copied().filter(|p| !b.contains(p)).collect();
    assert!(!only_a.is_empty() && b.iter().all(|p| a.contains(p)), "a larger k flags less");
    assert_eq!(sides(&bench), [only_a.len(), 0, b.len()]);
    // Every difference is walked once, then it starts again.
    let mut bench = bench.keys("g g");
    let mut walked = Vec::new();
    for _ in 0..only_a.len() {
        bench = bench.keys("g d");
        walked.push(u32::try_from(bench.0.state().cursor).unwrap());
        assert!(bench.frame().contains("A flags it, B does not"), "{}", bench.frame());
    }
    assert_eq!(walked, only_a);
    let bench = bench.keys("g d");
    assert!(bench.frame().contains("from the start again"), "{}", bench.frame());
    assert_eq!(bench.0.state().cursor, only_a[0] as usize);
    // Back to A, and one undo leads to B again, though A differs from B in a parameter that was stepped just before.
    let k = |bench: &Bench| bench.0.plan().setup.settings.get("k");
    let (k_b, bench) = (k(&bench), bench.keys("g b"));
    assert_eq!((k(&bench), flagged(&bench)), (Some(Value::Real(4.0)), a.clone()));
    assert!(bench.0.state().pinned.is_none());
    let bench = bench.keys("u");
    assert_eq!(k(&bench), k_b);
    assert_eq!(flagged(&bench), b);
}

#[test]
fn what_only_b_flags_is_marked_and_a_result_that_is_not_there_compares_with_nothing() {
    let bench = Bench::on("demo.csv", UNICODE_DARK).keys(":set Space k Space 12 Enter B :set Space k Space 4 Enter");
    let [only_a, only_b, _] = sides(&bench);
    assert!(only_a == 0 && only_b > 0);
    let bench = bench.keys("g d z");
    let side = bench.0.state().pinned.as_ref().unwrap().sides.as_ref().unwrap().side(bench.0.state().cursor);
    assert_eq!(side, Some(Side::OnlyB));
    let frame = bench.frame();
    assert!(frame.contains("B flags it, A does not") && frame.contains("A/B "), "{frame}");
    let gone = bench.keys(":method Space matched Enter Esc");
    assert!(gone.0.state().pinned.as_ref().unwrap().sides.is_none());
    assert!(gone.keys("g d").frame().contains("B has no result"));
    let bench = Bench::on("demo.csv", UNICODE_DARK).keys("B B");
    assert!(bench.0.state().pinned.is_none() && bench.frame().contains("no longer pinned"));
}

#[test]
fn all_methods_are_asked_once_and_again_when_the_question_changes() {
    let mut bench = Bench::on("demo.csv", UNICODE_DARK).keys("C");
    let consensus = bench.0.state().consensus.clone().unwrap();
    // `matched` needs a rate channel and has none.
    assert_eq!(consensus.ballot.methods(), wildpoint::method::voting().count() - 1);
    assert_eq!(consensus.left_out.iter().map(|(id, _)| *id).collect::<Vec<_>>(), ["matched"]);
    assert!(bench.frame().contains("left out: matched"), "{}", bench.frame());
    // Row 61 is 100 m/s off: most methods say so, the one of the session among them.
    assert!(
        consensus.ballot.voters(60).contains(&"two-sided") && consensus.ballot.votes(60) >= consensus.ballot.half()
    );
    // A late answer to another question is not taken.
    let late = Box::new(wildpoint::tui::consensus::Consensus { agreed: vec![], ..(*consensus).clone() });
    update(&mut bench.0, Message::Polled { generation: 6, plan: 0, consensus: late });
    assert!(std::sync::Arc::ptr_eq(bench.0.state().consensus.as_ref().unwrap(), &consensus));
    // A parameter does not change what the others say; the paper's values do.
    let bench = bench.keys(". .");
    assert!(std::sync::Arc::ptr_eq(bench.0.state().consensus.as_ref().unwrap(), &consensus));
    let bench = bench.keys("i");
    assert_eq!(bench.0.state().consensus.as_ref().unwrap().question.preset, wildpoint::session::Preset::Paper);
    let bench = bench.keys("g h");
    let (state, agreed) = (bench.0.state(), &bench.0.state().consensus.as_ref().unwrap().agreed);
    assert!(agreed.contains(&u32::try_from(state.cursor).unwrap()));
}

#[test]
fn what_most_methods_flag_is_taken_as_the_detection_in_one_step() {
    let bench = Bench::on("demo.csv", UNICODE_DARK).keys("C");
    let agreed = bench.0.state().consensus.as_ref().unwrap().agreed.clone();
    let before = bench.0.plan().setup.clone();
    let bench = bench.keys("g v");
    let setup = &bench.0.plan().setup;
    assert_eq!((setup.method.about().id, setup.settings.whole("votes")), ("consensus", 9));
    assert!(bench.frame().contains("9 or more of 18 methods flag"), "{}", bench.frame());
    let marks = &bench.0.state().drawn.as_ref().unwrap().outcome.marks;
    let flagged = marks.iter().filter(|m| m.verdict == wildpoint::method::Verdict::Outlier).map(|m| m.position);
    assert_eq!(flagged.collect::<Vec<_>>(), agreed);
    assert_eq!(bench.keys("u").0.plan().setup, before);
}

#[test]
fn what_was_measured_is_saved_while_it_holds() {
    let bench = measured(Bench::on("demo.csv", UNICODE_DARK).keys("g m"));
    let detectability = |bench: &Bench| bench.0.document().plans[0].measured.detectability.is_some();
    assert!(detectability(&bench));
    let bench = measured(bench.keys("g m m"));
    let compared = bench.0.document().plans[0].measured.advice.clone().unwrap();
    assert_eq!(compared.rows.len(), wildpoint::method::voting().count() - 1);
    let turned = bench.keys("Esc .");
    let measured = &turned.0.document().plans[0].measured;
    assert!(measured.detectability_of(&turned.0.plan().setup).is_none() && measured.advice.is_some());
}

/// The measurement that is under way is over.
fn measured(mut bench: Bench) -> Bench {
    let Some(studying) = bench.0.studying.clone() else { panic!("nothing is being measured") };
    let job = Job::new(&bench.0, studying.plan, studying.subject);
    let mut last = None;
    job.run(&Copies::default(), &Stop::never(), |finding, rounds| last = Some((finding, rounds))).unwrap();
    let Some((mut finding, rounds)) = last else { panic!("nothing was found") };
    if let Finding::Methods(studied) = &mut finding {
        // A still frame has no clock.
        studied.advice.methods.iter_mut().for_each(|m| m.milliseconds = 0.0);
    }
    let message = Message::Studied { generation: 7, plan: studying.plan, finding, rounds };
    for effect in update(&mut bench.0, message) {
        match effect {
            Effect::Analyse(plan) => bench.judge(plan),
            other => panic!("{other:?} follows on a measurement"),
        }
    }
    bench
}

#[test]
fn detectability_of_the_settings_in_force() {
    for (label, size) in [("80x24", (80, 24)), ("120x40", (120, 40))] {
        let bench = Bench::on("demo.csv", UNICODE_DARK).size(size).keys("g m");
        assert!(bench.frame().contains("measuring"), "{}", bench.frame());
        let bench = measured(bench);
        assert_snapshot!(format!("detectability_{label}"), bench.frame());
        // Another parameter is another measurement; the same settings again are known.
        assert!(bench.0.studying.is_none());
        let turned = bench.keys(".");
        assert!(turned.0.studying.is_some() && turned.frame().contains("the settings before"), "{}", turned.frame());
    }
}

#[test]
fn the_list_of_methods_shows_what_each_finds_and_takes_the_best() {
    for (label, size) in [("80x24", (80, 24)), ("120x40", (120, 40))] {
        let bench = measured(Bench::on("demo.csv", UNICODE_DARK).size(size).keys("m"));
        assert_snapshot!(format!("methods_compared_{label}"), bench.frame());
        let best = bench.0.state().studied.as_ref().unwrap().advice.best().unwrap().setup.clone();
        let bench = bench.keys("auto Enter");
        assert!(bench.0.plan().setup.same_method(&best));
        assert!(bench.frame().contains("recommended: "), "{}", bench.frame());
        assert!(bench.keys("u").0.plan().setup.same_method(&wildpoint::session::Setup::standard()));
    }
}
