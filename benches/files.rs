//! Cost of the way from a file to a screen and back to a file: loading, cleaning, and one step of the threshold,
//! from the key to the drawn frame. Two columns, 1e5 and 1e6 rows.

use std::hint::black_box;
use std::path::PathBuf;
use std::sync::Arc;
use std::time::Duration;

use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use ratatui::buffer::Buffer;
use ratatui::crossterm::event::{KeyCode, KeyEvent, KeyModifiers};
use ratatui::layout::Rect;
use wildpoint::experiment::Random;
use wildpoint::session::{Analysed, Preset, Session, Setup, method_of_id, write_cleaned};
use wildpoint::stop::Stop;
use wildpoint::track::{LoadOptions, Source, Track, load};
use wildpoint::tui::message::{Effect, Message};
use wildpoint::tui::model::Model;
use wildpoint::tui::office::Judge;
use wildpoint::tui::plot::Glyphs;
use wildpoint::tui::theme::{ColorDepth, Theme};
use wildpoint::tui::update::update;
use wildpoint::tui::view::draw;
use wildpoint::tui::{Look, Opening};

/// A file of `n` rows in a folder that goes away with the first part of the pair.
fn file(n: usize) -> (tempfile::TempDir, PathBuf) {
    let folder = tempfile::tempdir().unwrap_or_else(|e| panic!("no folder for the data: {e}"));
    let path = folder.path().join("record.csv");
    let mut random = Random::new(2);
    let mut text = String::from("time_s,range_m\n");
    for i in 0..n {
        let spike = if random.uniform() < 0.01 { 40.0 * random.sign() } else { 0.0 };
        let t = i as f64 * 0.1;
        text.push_str(&format!("{t:.1},{:.4}\n", 2000.0 + 0.3 * t + random.normal() + spike));
    }
    std::fs::write(&path, text).unwrap_or_else(|e| panic!("{}: {e}", path.display()));
    (folder, path)
}

fn loaded(path: &std::path::Path) -> Track {
    let options = LoadOptions::default();
    load(&Source::File(path.to_path_buf()), &options).unwrap_or_else(|e| panic!("{e}"))
}

fn hampel(window: &str) -> Setup {
    let method = method_of_id("hampel").unwrap_or_else(|e| panic!("{e}"));
    let mut setup = Setup::new(method, Preset::Default);
    setup.set_text("window", window).unwrap_or_else(|e| panic!("{e}"));
    setup
}

fn files(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("file");
    for n in [100_000, 1_000_000] {
        let (_folder, path) = file(n);
        let track = loaded(&path);
        group.throughput(Throughput::Elements(n as u64));
        group.bench_function(BenchmarkId::new("load", n), |b| b.iter(|| black_box(loaded(&path).rows)));
        let session = Session::new(&track, LoadOptions::default(), &hampel("21"));
        let analysed = Analysed::of(&session, &track, &Stop::never()).unwrap_or_else(|e| panic!("{e}"));
        let changes = analysed.changes(&track);
        group.bench_function(BenchmarkId::new("write cleaned", n), |b| {
            b.iter(|| write_cleaned(&track, &changes, &mut std::io::sink()).map(|sha| sha.len()).unwrap_or(0));
        });
        group.bench_function(BenchmarkId::new("load, hampel, repair, write", n), |b| {
            b.iter(|| {
                let track = loaded(&path);
                let analysed = Analysed::of(&session, &track, &Stop::never()).unwrap_or_else(|e| panic!("{e}"));
                write_cleaned(&track, &analysed.changes(&track), &mut std::io::sink()).map(|sha| sha.len()).unwrap_or(0)
            });
        });
    }
    group.finish();
}

/// The workbench with its first result.
fn bench(track: Track, setup: &Setup) -> Model {
    let session = Session::new(&track, LoadOptions::default(), setup);
    let opening = Opening { track, session, file: None, notes: Vec::new() };
    let theme = Theme::choose(ColorDepth::Indexed256, false);
    let mut model = opening.model(Look { theme, glyphs: Glyphs::Unicode });
    model.size = (120, 40);
    answer(&mut model, vec![Effect::Analyse(0)]);
    model
}

/// Does what the worker would do.
fn answer(model: &mut Model, effects: Vec<Effect>) {
    for effect in effects {
        if let Effect::Analyse(plan) = effect {
            let result = Judge::new(model, plan).run(&Stop::never()).map(Box::new);
            model.awaited = Some(1);
            update(model, Message::Analysed { generation: 1, plan, result });
        }
    }
}

fn steps(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("from key to frame");
    let area = Rect { x: 0, y: 0, width: 120, height: 40 };
    for n in [100_000, 1_000_000] {
        let (_folder, path) = file(n);
        for (name, setup) in [("hampel 11", hampel("11")), ("two-sided", Setup::standard())] {
            let mut model = bench(loaded(&path), &setup);
            let mut buffer = Buffer::empty(area);
            let mut up = false;
            group.bench_function(BenchmarkId::new(format!("threshold step, {name}"), n), |b| {
                b.iter(|| {
                    up = !up;
                    let key = KeyEvent::new(KeyCode::Char(if up { '.' } else { ',' }), KeyModifiers::NONE);
                    let effects = update(&mut model, Message::Key(key));
                    answer(&mut model, effects);
                    draw(&model, area, &mut buffer);
                });
            });
            if name == "hampel 11" {
                group.bench_function(BenchmarkId::new("frame alone, whole screen", n), |b| {
                    b.iter(|| draw(black_box(&model), area, &mut buffer));
                });
                group.bench_function(BenchmarkId::new("first result of", n), |b| {
                    let track = Arc::clone(&model.track);
                    b.iter(|| black_box(Judge::new(&model, 0).run(&Stop::never()).is_ok() && track.rows > 0));
                });
            }
        }
    }
    group.finish();
}

criterion_group! {
    name = benches;
    config = Criterion::default()
        .sample_size(10)
        .warm_up_time(Duration::from_millis(300))
        .measurement_time(Duration::from_secs(2));
    targets = files, steps
}
criterion_main!(benches);
