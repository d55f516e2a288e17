use super::axes::Frame;
use super::{Figure, Size, figures, marks};
use crate::plot::{FlagState, View};
use crate::session::{Analysed, Session, Setup};
use crate::stop::Stop;
use crate::track::{LoadOptions, Source, Track, load};

/// A record of `y` at one sample a second.
fn record(y: &[f64]) -> Track {
    let mut text = String::from("t,y\n");
    y.iter().enumerate().for_each(|(i, y)| text.push_str(&format!("{i},{y}\n")));
    let source = Source::BuiltIn { name: "test", bytes: text.into_bytes().into() };
    load(&source, &LoadOptions::default()).unwrap()
}

fn figures_of(y: &[f64]) -> (Vec<Figure>, usize) {
    let track = record(y);
    let session = Session::new(&track, LoadOptions::default(), &Setup::standard());
    let analysed = Analysed::of(&session, &track, &Stop::never()).unwrap();
    let (index, samples, outcome) = &analysed.channels[0];
    let flagged = outcome.outliers.len();
    let channel = &track.channels[*index];
    (figures(&track, channel, samples.series(channel, &track.time), outcome, None).figures, flagged)
}

/// A slow wave with `wild` samples 50 above it.
fn wave(n: usize, wild: &[usize]) -> Vec<f64> {
    #[expect(clippy::cast_precision_loss, reason = "small numbers")]
    let y = |i: usize| (i as f64 / 40.0).sin() + 0.01 * ((i * 7919) % 13) as f64;
    (0..n).map(|i| y(i) + if wild.contains(&i) { 50.0 } else { 0.0 }).collect()
}

/// How many marks of a state a picture has.
fn count(svg: &str, class: &str) -> usize {
    let paths = svg.split("<path class=\"mark").skip(1).filter(|p| p.split('"').next().unwrap().ends_with(class));
    paths.map(|p| p.split(" d=\"").nth(1).unwrap().split('"').next().unwrap().matches('M').count()).sum()
}

#[test]
fn every_flag_has_its_mark_in_every_picture_of_the_whole_record() {
    let wild = [30, 31, 32, 70, 110, 150, 199, 240, 300];
    let (figures, flagged) = figures_of(&wave(400, &wild));
    assert!(flagged >= wild.len(), "{flagged}");
    for figure in &figures[..3] {
        assert_eq!(count(&figure.svg, "unreviewed"), flagged, "{}", figure.caption);
    }
    // At the scale of the kept samples all of them lie beyond the edge.
    assert_eq!(figures[1].svg.matches("mark beyond unreviewed").count(), 1);
    assert!(figures[5..].iter().all(|f| f.small && count(&f.svg, "unreviewed") > 0));
    assert_eq!(figures.len(), 5 + 7, "each event close up: six isolated and a run");
}

#[test]
fn of_very_many_flags_each_has_a_mark_near_it() {
    let frame = Frame { size: Size { width: 960, height: 320 }, view: View { from: 0.0, to: 1e5 }, y: (-1.0, 1.0) };
    let flags: Vec<_> = (0..50_000)
        .map(|i| (f64::from(i) * 2.0, ((i * 7919) % 2000) as f64 / 900.0 - 1.1, FlagState::Suspect))
        .collect();
    let mut svg = String::new();
    marks::draw(&flags, frame, &mut svg);
    let places: Vec<(f64, f64)> = svg
        .split('M')
        .skip(1)
        .map(|part| {
            let mut numbers = part.split([' ', 'l']).map(|n| n.parse::<f64>().unwrap_or(0.0));
            (numbers.next().unwrap(), numbers.next().unwrap())
        })
        .collect();
    assert!(places.len() < 40_000, "{} marks", places.len());
    for (x, y, _) in flags.iter().step_by(97) {
        let (x, (y, _)) = (frame.x(*x), frame.marked(*y));
        assert!(places.iter().any(|p| (p.0 - x).abs() < 6.0 && (p.1 - y).abs() < 9.0), "nothing near {x} {y}");
    }
}

#[test]
fn lines_break_where_samples_are_lost_and_the_stretch_is_shaded() {
    let mut text = String::from("t,y\n");
    wave(300, &[])
        .iter()
        .enumerate()
        .for_each(|(i, y)| text.push_str(&format!("{},{y}\n", if i < 150 { i } else { i + 60 })));
    let source = Source::BuiltIn { name: "test", bytes: text.into_bytes().into() };
    let track = load(&source, &LoadOptions::default()).unwrap();
    let session = Session::new(&track, LoadOptions::default(), &Setup::standard());
    let analysed = Analysed::of(&session, &track, &Stop::never()).unwrap();
    let (index, samples, outcome) = &analysed.channels[0];
    let channel = &track.channels[*index];
    let figures = figures(&track, channel, samples.series(channel, &track.time), outcome, None).figures;
    let overview = &figures[0].svg;
    let raw = overview.split("class=\"raw\" d=\"").nth(1).unwrap().split('"').next().unwrap();
    assert_eq!(raw.matches('M').count(), 2, "{raw}");
    assert_eq!(overview.matches("class=\"gap\"").count(), 1);
}

#[test]
fn numbers_of_pictures_are_finite_for_any_record() {
    let nasty: [&[f64]; 5] =
        [&[1.0], &[5.0; 40], &[1e308, -1e308, 1e308, 0.0, 1.0, 2.0, 3.0], &[5e-324, 0.0, 5e-324, 1.0], &[6.4e6; 3]];
    for y in nasty {
        let (figures, _) = figures_of(y);
        for figure in figures {
            assert!(!figure.svg.contains("NaN") && !figure.svg.contains("inf"), "{}", figure.svg);
        }
    }
}

#[test]
fn repair_takes_the_residual_inside_the_threshold() {
    let (figures, _) = figures_of(&wave(400, &[70, 150, 240]));
    let height = |figure: &Figure| {
        let raw = figure.svg.split("class=\"raw\" d=\"").nth(1).unwrap().split('"').next().unwrap();
        let ys = raw.split(['M', 'L', 'V']).filter_map(|part| part.split(' ').next_back()?.parse::<f64>().ok());
        ys.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), y| (low.min(y), high.max(y)))
    };
    // The middle of the frame is 0; wild points lie far above it before the repair, nothing does after it.
    let (before, after) = (height(&figures[2]), height(&figures[3]));
    assert!(before.0 < 20.0 && after.0 > 50.0, "{before:?} {after:?}");
}

#[test]
fn of_many_events_the_largest_are_close_up_and_the_others_counted() {
    let wild: Vec<usize> = (1..=20).map(|i| i * 30).collect();
    let track = record(&wave(700, &wild));
    let session = Session::new(&track, LoadOptions::default(), &Setup::standard());
    let analysed = Analysed::of(&session, &track, &Stop::never()).unwrap();
    let (index, samples, outcome) = &analysed.channels[0];
    let channel = &track.channels[*index];
    let pictures = figures(&track, channel, samples.series(channel, &track.time), outcome, None);
    let events = outcome.runs.len();
    assert!(events >= 20 && pictures.figures.len() == 5 + 12, "{events} events");
    assert!(pictures.close.starts_with(&format!("The 12 largest of {events} events")), "{}", pictures.close);
}
