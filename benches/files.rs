//! Cost of the way from a file to a screen and back to a file: loading, cleaning, the first frame, and one step of the
//! threshold, from the key to the drawn frame. Two columns, 1e5 to 1e7 rows.

#![expect(clippy::print_stdout, reason = "one process tells another its peak memory")]

use std::fmt::Write as _;
use std::hint::black_box;
use std::io::Write as _;
use std::path::{Path, PathBuf};
use std::time::Duration;

use criterion::{BenchmarkId, Criterion, Throughput, criterion_group};
use ratatui::buffer::Buffer;
use ratatui::crossterm::event::{KeyCode, KeyEvent, KeyModifiers};
use ratatui::layout::Rect;
use wildpoint::experiment::Random;
use wildpoint::session::{Analysed, Preset, Session, Setup, method_of_id, write_cleaned};
use wildpoint::stop::Stop;
use wildpoint::track::{LoadOptions, Rules, Source, Track, load};
use wildpoint::tui::jobs::Judge;
use wildpoint::tui::message::{Effect, Message};
use wildpoint::tui::model::Model;
use wildpoint::tui::plot::Glyphs;
use wildpoint::tui::theme::{ColorDepth, Theme};
use wildpoint::tui::update::update;
use wildpoint::tui::view::draw;
use wildpoint::tui::{Look, Opening};

const SIZES: [usize; 3] = [100_000, 1_000_000, 10_000_000];
const AREA: Rect = Rect { x: 0, y: 0, width: 120, height: 40 };
/// Asks this program for its peak memory on the file that follows.
const PEAK: &str = "--peak-memory-of";

/// Files of `n` rows in a folder that goes away with them.
struct Files {
    _folder: tempfile::TempDir,
    plain: PathBuf,
    gzipped: PathBuf,
    quoted: PathBuf,
}

impl Files {
    fn new(n: usize) -> Self {
        let folder = tempfile::tempdir().unwrap_or_else(|e| panic!("no folder for the data: {e}"));
        let path = |name: &str| folder.path().join(name);
        let files = Self {
            plain: path("record.csv"),
            gzipped: path("record.csv.gz"),
            quoted: path("quoted.csv"),
            _folder: folder,
        };
        let text = text(n);
        write(&files.plain, text.as_bytes());
        let mut packer = flate2::write::GzEncoder::new(Vec::new(), flate2::Compression::fast());
        packer.write_all(text.as_bytes()).unwrap_or_else(|e| panic!("{e}"));
        write(&files.gzipped, &packer.finish().unwrap_or_else(|e| panic!("{e}")));
        write(
            &files.quoted,
            format!("\"{}\"\n", text.trim_end().replace(',', "\",\"").replace('\n', "\"\n\"")).as_bytes(),
        );
        files
    }
}

fn write(path: &Path, bytes: &[u8]) {
    std::fs::write(path, bytes).unwrap_or_else(|e| panic!("{}: {e}", path.display()));
}

/// A ramp with unit noise and a wild point in a hundred samples.
fn text(n: usize) -> String {
    let mut random = Random::new(2);
    let mut text = String::from("time_s,range_m\n");
    for i in 0..n {
        let spike = if random.uniform() < 0.01 { 40.0 * random.sign() } else { 0.0 };
        let t = i as f64 * 0.1;
        let _ = writeln!(text, "{t:.1},{:.4}", 2000.0 + 0.3 * t + random.normal() + spike);
    }
    text
}

fn loaded(path: &Path) -> Track {
    loaded_by(path, &LoadOptions::default())
}

fn loaded_by(path: &Path, options: &LoadOptions) -> Track {
    load(&Source::File(path.to_path_buf()), options).unwrap_or_else(|e| panic!("{e}"))
}

fn hampel(window: &str) -> Setup {
    let method = method_of_id("hampel").unwrap_or_else(|e| panic!("{e}"));
    let mut setup = Setup::new(method, Preset::Default);
    setup.set_text("window", window).unwrap_or_else(|e| panic!("{e}"));
    setup
}

/// The sum as numerical libraries take it: several sums side by side, each of which waits for itself alone.
fn in_lanes(x: &[f64]) -> f64 {
    let mut sums = [0.0; 8];
    for x in x.chunks_exact(8) {
        sums.iter_mut().zip(x).for_each(|(sum, x)| *sum += x);
    }
    sums.iter().sum()
}

fn files(criterion: &mut Criterion) {
    let doubles: Vec<f64> = (0..1_000_000).map(f64::from).collect();
    let mut yardstick = criterion.benchmark_group("yardstick");
    yardstick.bench_function("sum of 1e6 doubles", |b| b.iter(|| black_box(&doubles).iter().sum::<f64>()));
    yardstick.bench_function("sum of 1e6 doubles in lanes", |b| b.iter(|| in_lanes(black_box(&doubles))));
    yardstick.finish();
    for n in SIZES {
        let files = Files::new(n);
        let track = loaded(&files.plain);
        let mut group = criterion.benchmark_group("file");
        group.throughput(Throughput::Elements(n as u64));
        for (name, path) in [("load", &files.plain), ("load, gzipped", &files.gzipped), ("load, quoted", &files.quoted)]
        {
            group.bench_function(BenchmarkId::new(name, n), |b| b.iter(|| black_box(loaded(path).rows)));
        }
        // What recognition costs beside the rules of sessions that were saved before it.
        let first = LoadOptions { rules: Rules::First, ..LoadOptions::default() };
        group.bench_function(BenchmarkId::new("load, first rules", n), |b| {
            b.iter(|| black_box(loaded_by(&files.plain, &first).rows));
        });
        let session = Session::new(&track, LoadOptions::default(), &hampel("21"));
        let analysed = Analysed::of(&session, &track, &Stop::never()).unwrap_or_else(|e| panic!("{e}"));
        let changes = analysed.changes(&track);
        group.bench_function(BenchmarkId::new("write cleaned", n), |b| {
            b.iter(|| write_cleaned(&track, &changes, &mut std::io::sink()).map(|sha| sha.len()).unwrap_or(0));
        });
        group.bench_function(BenchmarkId::new("load, hampel, repair, write", n), |b| {
            b.iter(|| {
                let track = loaded(&files.plain);
                let analysed = Analysed::of(&session, &track, &Stop::never()).unwrap_or_else(|e| panic!("{e}"));
                write_cleaned(&track, &analysed.changes(&track), &mut std::io::sink()).map(|sha| sha.len()).unwrap_or(0)
            });
        });
        group.finish();
        let mut group = criterion.benchmark_group("from file to frame");
        group.bench_function(BenchmarkId::new("first frame", n), |b| b.iter(|| first_frame(&files.plain)));
        group.finish();
        if n == SIZES[2] {
            remember_peak(&files.plain);
        }
        steps(criterion, n, &files.plain);
    }
}

/// From a file to the frame that shows its samples, before anything is judged.
fn first_frame(path: &Path) -> Buffer {
    let model = opened(loaded(path), &Setup::standard());
    let mut buffer = Buffer::empty(AREA);
    draw(&model, AREA, &mut buffer);
    buffer
}

/// Has this program draw the first frame once in a process of its own, and keeps its peak memory for the table.
fn remember_peak(path: &Path) {
    let program = std::env::current_exe().unwrap_or_else(|e| panic!("{e}"));
    let Ok(output) = std::process::Command::new(&program).arg(PEAK).arg(path).output() else { return };
    let folder = program.ancestors().map(|folder| folder.join("criterion")).find(|folder| folder.is_dir());
    if let Some(folder) = folder {
        write(&folder.join("peak memory in MB"), &output.stdout);
    }
}

/// The most memory that this process has held, in MB; none where the system does not tell.
fn peak() -> Option<f64> {
    let status = std::fs::read_to_string("/proc/self/status").ok()?;
    let line = status.lines().find_map(|line| line.strip_prefix("VmHWM:"))?;
    let kib: f64 = line.trim().trim_end_matches(" kB").parse().ok()?;
    Some(kib * 1024.0 / 1e6)
}

/// The workbench before its first result.
fn opened(track: Track, setup: &Setup) -> Model {
    let session = Session::new(&track, LoadOptions::default(), setup);
    let opening = Opening { track, session, file: None, notes: Vec::new(), own: Vec::new() };
    let theme = Theme::choose(ColorDepth::Indexed256, false);
    let mut model = opening.model(Look { theme, glyphs: Glyphs::Unicode });
    model.size = (AREA.width, AREA.height);
    model
}

/// The workbench with its first result.
fn bench(track: Track, setup: &Setup) -> Model {
    let mut model = opened(track, setup);
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

fn steps(criterion: &mut Criterion, n: usize, path: &Path) {
    let mut group = criterion.benchmark_group("from key to frame");
    for (name, setup) in [("hampel", hampel("21")), ("two-sided", Setup::standard())] {
        // Where turning the multiplier runs the method again, 1e7 samples tell nothing that 1e6 do not.
        if name == "two-sided" && n > 1_000_000 {
            continue;
        }
        let mut model = bench(loaded(path), &setup);
        let mut buffer = Buffer::empty(AREA);
        let mut up = false;
        group.bench_function(BenchmarkId::new(format!("step, {name}"), n), |b| {
            b.iter(|| {
                up = !up;
                let key = KeyEvent::new(KeyCode::Char(if up { '.' } else { ',' }), KeyModifiers::NONE);
                let effects = update(&mut model, Message::Key(key));
                answer(&mut model, effects);
                draw(&model, AREA, &mut buffer);
            });
        });
        if name == "hampel" {
            group.bench_function(BenchmarkId::new("frame alone, whole screen", n), |b| {
                b.iter(|| draw(black_box(&model), AREA, &mut buffer));
            });
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
    targets = files
}

fn main() {
    let arguments: Vec<String> = std::env::args().collect();
    if let Some(at) = arguments.iter().position(|a| a == PEAK) {
        black_box(first_frame(Path::new(&arguments[at + 1])));
        println!("{}", peak().map_or_else(String::new, |mb| mb.round().to_string()));
        return;
    }
    benches();
    Criterion::default().configure_from_args().final_summary();
}
