//! Filtered values: in the cleaned file and its session, in the diagnostics, and as a layer on the screen.

#![expect(clippy::unwrap_used, reason = "a failed expectation is a failed test")]

#[expect(dead_code, reason = "other tests use what this does not")]
mod program;
#[expect(dead_code, reason = "other tests use what this does not")]
mod workbench;

use program::Folder;
use wildpoint::stop::Stop;
use wildpoint::tui::message::Message;
use wildpoint::tui::smoothing::{Job, Smoothed};
use wildpoint::tui::update::update;
use workbench::{ASCII_MONO, Bench, UNICODE_DARK};

/// A record of which nothing is flagged, and the means of three of it.
const FEW: &str = "t_s,v\n0,2.00\n1,1.00\n2,2.00\n3,1.00\n4,2.00\n5,1.00\n6,2.00\n7,1.00\n8,2.00\n";
const MEANS: &str = "--method mean-window --set window=3 --set detrend=off --set floor=0 --set k=1000";

/// A wavy track of 300 samples with an outlier and a run.
fn wavy() -> String {
    let mut text = String::from("t_s,v\n");
    for i in 0..300 {
        let t = f64::from(i);
        let wild = if i == 100 || (200..206).contains(&i) { 80.0 } else { 0.0 };
        let noise = f64::from(i * 7919 % 13) / 6.0 - 1.0;
        text.push_str(&format!("{i},{:.3}\n", 50.0 * (t / 40.0).sin() + noise + wild));
    }
    text
}

/// The values of a column.
fn column(text: &str, name: &str) -> Vec<String> {
    let mut lines = text.lines();
    let at = lines.next().unwrap().split(',').position(|n| n == name).unwrap();
    lines.map(|line| line.split(',').nth(at).unwrap().to_owned()).collect()
}

/// The mean of three values is (1 + 2 + 1) / 3 = 1.33 or (2 + 1 + 2) / 3 = 1.67; at the ends the three nearest.
#[test]
fn the_cleaned_file_has_the_values_of_the_model() {
    let folder = Folder::with(&[("few.csv", FEW.as_bytes())]);
    folder.done(&format!(
        "clean few.csv {MEANS} --output-value filtered -o out.csv --save-session s.toml --changed c.csv"
    ));
    let means = ["1.67", "1.67", "1.33", "1.67", "1.33", "1.67", "1.33", "1.67", "1.67"];
    assert_eq!(column(&folder.text("out.csv"), "v"), means);
    assert_eq!(column(&folder.text("c.csv"), "by"), ["filtered"; 9]);
    // What is not asked for is as it was.
    folder.done(&format!("clean few.csv {MEANS} -o clean.csv --save-session clean.toml"));
    assert_eq!(folder.text("clean.csv"), FEW);
    assert!(!folder.text("clean.toml").contains("output_value"), "sessions without it are those of before");
    folder.done(&format!("clean few.csv {MEANS} --diagnostics d.csv"));
    assert_eq!(column(&folder.text("d.csv"), "filtered"), means);
    assert_eq!(column(&folder.text("d.csv"), "clean"), ["2", "1", "2", "1", "2", "1", "2", "1", "2"]);
}

#[test]
fn a_session_records_which_values_were_written_and_replays_to_the_same_bytes() {
    let folder = Folder::with(&[("wavy.csv", wavy().as_bytes())]);
    folder.done("clean wavy.csv --method kalman --output-value filtered -o out.csv --save-session s.toml");
    assert!(folder.text("s.toml").contains("\noutput_value = \"filtered\"\n"));
    assert!(folder.done("replay s.toml --check").contains("same result"));
    folder.done("replay s.toml -o again.csv");
    assert_eq!(folder.text("again.csv"), folder.text("out.csv"));
    // The same session asked for the clean values is another one.
    let other = folder.text("s.toml").replace("output_value = \"filtered\"\n", "");
    std::fs::write(folder.path("other.toml"), other).unwrap();
    assert_eq!(folder.run("replay other.toml --check").status, 1);
    let wrong = folder.text("s.toml").replace("\"filtered\"", "\"smooth\"");
    std::fs::write(folder.path("wrong.toml"), wrong).unwrap();
    let failed = folder.run("replay wrong.toml --check");
    assert!(failed.status == 2 && failed.err.contains("output_value") && failed.err.contains("clean, filtered"));
}

#[test]
fn the_filtered_track_goes_through_the_noise_and_says_how_well() {
    let folder = Folder::with(&[("wavy.csv", wavy().as_bytes())]);
    folder.done("clean wavy.csv --method kalman --diagnostics d.csv");
    let text = folder.text("d.csv");
    let numbers =
        |name| column(&text, name).into_iter().map(|v| v.parse::<f64>().unwrap_or(f64::NAN)).collect::<Vec<_>>();
    let (track, deviation) = (numbers("filtered"), numbers("filtered_deviation"));
    for (i, (value, deviation)) in track.iter().zip(&deviation).enumerate().skip(10) {
        let truth = 50.0 * (i as f64 / 40.0).sin();
        assert!((value - truth).abs() < 2.5, "sample {i}: {value} where {truth} is true");
        assert!(*deviation > 0.0 && *deviation < 2.5, "sample {i}: {deviation}");
    }
}

#[test]
fn a_method_without_a_model_is_refused_and_those_with_one_are_named() {
    let folder = Folder::with(&[("wavy.csv", wavy().as_bytes())]);
    let ran = folder.run("clean wavy.csv --method wright --output-value filtered -o out.csv");
    assert_eq!(ran.status, 2);
    assert!(ran.err.contains("wright has no filtered values for v") && ran.err.contains("kalman"), "{}", ran.err);
    assert_eq!(folder.names(), ["wavy.csv"], "nothing is written");
    folder.done("clean wavy.csv --method wright --set trend_order=2 --output-value filtered -o out.csv");
}

/// What the worker sends when it has smoothed the result on the screen.
fn smoothed(mut bench: Bench) -> Bench {
    let answer = Job::wanted(&mut bench.0).unwrap().run(&Stop::never()).unwrap();
    assert!(Job::wanted(&mut bench.0).is_none(), "it is asked once");
    update(&mut bench.0, Message::Smoothed(Box::new(answer)));
    assert!(Job::wanted(&mut bench.0).is_none(), "and not again when it is answered");
    bench
}

/// The heading of the card, whose panel is called flag.
fn card(bench: &Bench) -> String {
    bench.frame().lines().find(|line| line.contains("5 flag")).unwrap().to_owned()
}

#[test]
fn the_card_tells_the_residual_before_and_after_the_repair() {
    for size in [(80, 24), (120, 40)] {
        let before = Bench::on("demo.csv", UNICODE_DARK).size(size);
        assert!(!card(&before).contains("residual "), "nothing is told before it is known");
        let bench = smoothed(before);
        let residual = Smoothed::of(&bench.0).unwrap().residual.unwrap();
        assert!(residual.after < residual.before);
        let told = card(&bench);
        assert!(told.contains("residual ") && told.contains(" → "), "{size:?}: {told}");
    }
    let bench = smoothed(Bench::on("demo.csv", ASCII_MONO).size((120, 40)));
    assert!(card(&bench).contains(" -> "));
    // Under other settings the result is another: what was known of the one before is marked as old until more is.
    let mut bench = bench.keys(".");
    bench.judge(0);
    assert!(Smoothed::of(&bench.0).is_none());
    assert!(card(&bench).contains("residual ") && card(&bench).contains('~'), "{}", card(&bench));
    let told = card(&smoothed(bench));
    assert!(told.contains("residual ") && !told.contains('~'), "{told}");
}

#[test]
fn a_key_shows_the_filtered_track_and_a_second_press_hides_it() {
    let bench = Bench::on("demo.csv", ASCII_MONO).size((120, 40));
    let usual = bench.frame();
    let asked = bench.keys("T");
    assert!(asked.0.state().layers.filtered && asked.frame().contains("filtered track: polynomial"));
    let bench = smoothed(asked);
    let shown = bench.frame();
    assert!(shown.contains('~') && shown.contains("with filtered track"), "{shown}");
    let hidden = bench.keys("T").keys("Esc");
    assert!(!hidden.0.state().layers.filtered);
    assert_eq!(usual.matches('~').count(), hidden.frame().matches('~').count());
    let named = hidden.keys(":layers Space +filtered Enter");
    assert!(named.0.state().layers.filtered);
}
