//! Cost of a frame of the whole workbench on a record of 10^7 samples: unchanged, after a pan, and with each picture below
//! the trace. The bar is 2 ms.

use std::hint::black_box;
use std::time::Duration;

use criterion::{Criterion, criterion_group, criterion_main};
use ratatui::buffer::Buffer;
use ratatui::crossterm::event::{KeyCode, KeyEvent, KeyModifiers};
use ratatui::layout::Rect;
use wildpoint::experiment::Random;
use wildpoint::session::{Preset, Session, Setup, method_of_id};
use wildpoint::stop::Stop;
use wildpoint::track::{LoadOptions, Source, Track, load};
use wildpoint::tui::jobs::Judge;
use wildpoint::tui::message::Message;
use wildpoint::tui::model::Model;
use wildpoint::tui::plot::Glyphs;
use wildpoint::tui::theme::{ColorDepth, Theme};
use wildpoint::tui::update::update;
use wildpoint::tui::view::draw;
use wildpoint::tui::{Look, Opening};

const AREA: Rect = Rect { x: 0, y: 0, width: 120, height: 40 };

/// A line with noise, one sample in a thousand wild and known to be, one in ten thousand lost.
fn record(n: usize) -> Track {
    let mut track = load(&Source::demo(), &LoadOptions::default()).unwrap_or_else(|e| panic!("{e}"));
    let mut random = Random::new(4);
    let (mut t, mut seconds, mut values, mut truth) = (0.0, Vec::new(), Vec::new(), Vec::new());
    for _ in 0..n {
        t += if random.uniform() < 1e-4 { 0.3 } else { 0.1 };
        let wild = random.uniform() < 1e-3;
        seconds.push(t);
        values.push(0.3 * t + random.normal() + if wild { 40.0 * random.sign() } else { 0.0 });
        truth.push(wild);
    }
    track.rows = n;
    track.time.seconds = seconds;
    track.channels.truncate(1);
    track.channels[0].values = values;
    track.truth = Some(truth);
    track
}

fn workbench() -> Model {
    let track = record(10_000_000);
    let method = method_of_id("hampel").unwrap_or_else(|e| panic!("{e}"));
    let session = Session::new(&track, LoadOptions::default(), &Setup::new(method, Preset::Default));
    let opening = Opening { track, session, file: None, notes: Vec::new(), own: Vec::new() };
    let theme = Theme::choose(ColorDepth::Indexed256, false);
    let mut model = opening.model(Look { theme, glyphs: Glyphs::Unicode });
    model.size = (AREA.width, AREA.height);
    let result = Judge::new(&model, 0).run(&Stop::never()).map(Box::new);
    model.awaited = Some(1);
    update(&mut model, Message::Analysed { generation: 1, plan: 0, result });
    model
}

fn press(model: &mut Model, key: char) {
    update(model, Message::Key(KeyEvent::new(KeyCode::Char(key), KeyModifiers::NONE)));
}

fn frames(criterion: &mut Criterion) {
    let mut model = workbench();
    let mut buffer = Buffer::empty(AREA);
    let mut group = criterion.benchmark_group("whole screen, 1e7");
    for lower in ["residual", "histogram", "steps"] {
        group.bench_function(format!("unchanged, {lower}"), |b| {
            b.iter(|| draw(black_box(&model), AREA, &mut buffer));
        });
        press(&mut model, 'R');
    }
    for (name, y) in [("kept", 0), ("robust", 2)] {
        (0..y).for_each(|_| press(&mut model, 'y'));
        press(&mut model, '+');
        let mut right = false;
        group.bench_function(format!("pan, y {name}"), |b| {
            b.iter(|| {
                right = !right;
                press(&mut model, if right { 'l' } else { 'h' });
                draw(&model, AREA, &mut buffer);
            });
        });
    }
    // From the first frame of a result on, whose columns nobody has made yet.
    group.bench_function("everything new", |b| {
        b.iter(|| {
            model.channels[0].results += 1;
            draw(&model, AREA, &mut buffer);
        });
    });
    group.finish();
}

criterion_group! {
    name = benches;
    config = Criterion::default()
        .sample_size(10)
        .warm_up_time(Duration::from_millis(200))
        .measurement_time(Duration::from_secs(1));
    targets = frames
}
criterion_main!(benches);
