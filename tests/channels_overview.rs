//! The overview of all channels, driven by keys, on a record whose wild points are known because they were put there.

#![expect(clippy::unwrap_used, reason = "a failed expectation is a failed test")]

#[expect(dead_code, reason = "other test programs use the rest")]
mod workbench;

use std::fmt::Write as _;

use insta::assert_snapshot;
use wildpoint::review::Ruling;
use wildpoint::track::Source;
use wildpoint::tui::model::Overlay;

use workbench::{ASCII_MONO, Bench, UNICODE_DARK};

const CHANNELS: usize = 24;

/// A record of 24 channels of slow sines with a little even noise. Channel `i` has a wild point in row 40 + 10 j for each
/// j < i mod 6; channel 7 is constant but for its noise, and one name is longer than the others.
fn record() -> Source {
    let names: Vec<String> = (0..CHANNELS)
        .map(|i| if i == 5 { "temperature_of_the_second_bearing_degC".into() } else { format!("sensor_{i:02}_m") })
        .collect();
    let mut text = format!("t_s,{}\n", names.join(","));
    for row in 1..=400_usize {
        write!(text, "{row}").unwrap();
        for i in 0..CHANNELS {
            // A fixed sequence that repeats only after 61 samples.
            let noise = ((row * 37 + i * 11) % 61) as f64 / 61.0 - 0.5;
            let wild = row >= 40 && (row - 40).is_multiple_of(10) && (row - 40) / 10 < i % 6;
            let spike = if wild { 50.0 + row as f64 } else { 0.0 };
            write!(text, ",{:.4}", (row as f64 / (30.0 + i as f64)).sin() * 5.0 + 0.1 * noise + spike).unwrap();
        }
        text.push('\n');
    }
    Source::BuiltIn { name: "campaign.csv", bytes: text.into_bytes().into() }
}

fn bench() -> Bench {
    let mut bench = Bench::of(record(), UNICODE_DARK);
    bench.judge(0);
    bench
}

/// Plans whose flags are decided on, with how many.
fn decided(bench: &Bench) -> Vec<(usize, usize)> {
    let plans = bench.0.session.plans.iter().enumerate();
    plans.map(|(plan, p)| (plan, p.decisions.len())).filter(|(_, n)| *n > 0).collect()
}

fn cursor(bench: &Bench) -> usize {
    let Overlay::Overview(overview) = &bench.0.overlay else { panic!("the overview is not open") };
    overview.plan
}

#[test]
fn every_channel_has_a_row() {
    for (label, size) in [("80x24", (80, 24)), ("120x40", (120, 40))] {
        let bench = bench().size(size).keys("go g Down Down Space Down");
        assert_snapshot!(format!("overview_{label}"), bench.frame());
    }
    let ascii = {
        let mut bench = Bench::of(record(), ASCII_MONO);
        bench.judge(0);
        bench.keys("go").frame()
    };
    assert_snapshot!("overview_ascii", ascii);
    let rows = bench().keys("go").frame().lines().filter(|line| line.contains("sensor_")).count();
    assert!(rows >= 18, "{rows} rows at 80x24");
}

#[test]
fn the_counts_are_those_of_the_channels() {
    let mut bench = bench().keys("go");
    for plan in [0, 3, 11] {
        let summary = bench.0.channels[plan].summary.clone().unwrap().unwrap();
        bench.0.shown = plan;
        bench.judge(plan);
        let counts = bench.0.state().drawn.as_ref().unwrap().outcome.counts;
        assert_eq!((summary.counts, summary.undecided.len()), (counts, counts.flagged), "{plan}");
        assert!(summary.counts.flagged >= plan % 6, "{plan}: {counts:?}");
    }
}

#[test]
fn flags_of_several_channels_are_accepted_in_one_step() {
    // The third and the fourth row: two and three wild points.
    let bench = bench().keys("go g Down Down Space Space a");
    assert_eq!(decided(&bench), [(2, 2), (3, 3)]);
    assert!(bench.0.session.plans[2].decisions.iter().all(|(_, d)| d.ruling == Ruling::Outlier));
    assert!(bench.frame().contains("5 flags accepted in 2 channels"), "{}", bench.frame());
    let row = |bench: &Bench| bench.frame().lines().find(|line| line.contains("sensor_02")).unwrap().to_owned();
    assert!(row(&bench).contains("all of 2"), "{}", row(&bench));
    let bench = bench.keys("u");
    assert_eq!(decided(&bench), []);
    assert!(row(&bench).contains("0 of 2"), "{}", row(&bench));
}

#[test]
fn settings_go_to_the_selected_channels_or_to_all() {
    let mut bench = bench();
    let hampel = wildpoint::session::method_of_id("hampel").unwrap();
    bench.0.session.plans[0].setup = wildpoint::session::Setup::new(hampel, wildpoint::session::Preset::Default);
    let ids = |bench: &Bench| bench.0.session.plans.iter().filter(|p| p.setup.method.about().id == "hampel").count();
    // Two rows are selected, and the cursor is on the first, from which the settings come.
    let bench = bench.keys("go g Down Space Space");
    let bench = bench.keys("k k k =");
    assert_eq!((cursor(&bench), ids(&bench)), (0, 3));
    let bench = bench.keys("Esc =");
    assert_eq!(ids(&bench), CHANNELS);
    let bench = bench.keys("u u");
    assert_eq!(ids(&bench), 1);
}

#[test]
fn rows_are_sorted_and_filtered_and_the_cursor_keeps_its_channel() {
    let bench = bench().keys("go g Down Down s");
    // By what is left to decide: five wild points first.
    let first = bench.frame().lines().nth(2).unwrap().to_owned();
    assert!(first.contains("temper") && first.contains("degC"), "the name is cut in its middle: {first}");
    assert_eq!(cursor(&bench), 2);
    let bench = bench.keys("/ sensor_1 Enter");
    let rows = |bench: &Bench| bench.frame().lines().filter(|line| line.contains("sensor_")).count();
    // Ten rows, and the title, which repeats what was typed. Of those with five wild points, 11 comes first.
    assert_eq!((rows(&bench), cursor(&bench)), (11, 11), "the cursor was on a row that is gone: now on the first");
    let bench = bench.keys("Enter");
    assert_eq!(bench.0.shown, 11);
    assert!(matches!(bench.0.overlay, Overlay::None));
    let bench = bench.keys("go");
    assert_eq!(cursor(&bench), 11, "it comes back to the row");
}
