//! Cost of a frame: pyramid, trace with rail, residual, at 10^6 and 10^7 samples. The bar of the design is 1 ms a frame at
//! 10^6.

use std::hint::black_box;

use criterion::{Criterion, criterion_group, criterion_main};
use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::widgets::Widget;
use wildpoint::tui::plot::{
    Axis, Columns, Cursor, Curve, Flag, FlagRail, FlagState, Flags, Glyphs, Grid, Layers, Pyramid, ResidualPlot, Span,
    Trace, TracePlot, View, YFit,
};
use wildpoint::tui::theme::{ColorDepth, Theme};

const AREA: Rect = Rect { x: 0, y: 0, width: 120, height: 40 };

/// A slow wave with noise and wild points on both sides, some reviewed.
struct Record {
    t: Vec<f64>,
    y: Vec<f64>,
    hidden: Vec<bool>,
    flags: Vec<Flag>,
}

impl Record {
    fn new(n: usize, share_flagged: f64) -> Self {
        let mut state = 1_u64;
        let mut random = move || {
            // Knuth's MMIX constants; the upper 53 bits are good enough for a picture.
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            (state >> 11) as f64 / (1_u64 << 53) as f64
        };
        let (mut y, mut hidden, mut flags) = (Vec::new(), Vec::new(), Vec::new());
        for i in 0..n {
            let wave = (i as f64 / n as f64 * 40.0).sin() * 10.0 + random() - 0.5;
            let flagged = random() < share_flagged;
            let value = if flagged { wave + (random() - 0.5).signum() * (3.0 + 9.0 * random()) } else { wave };
            if flagged {
                let state = FlagState::ALL[(random() * 3.0) as usize];
                flags.push(Flag { position: i as u32, y: value, state });
            }
            y.push(value);
            hidden.push(flagged);
        }
        Self { t: (0..n).map(|i| i as f64 * 0.1).collect(), y, hidden, flags }
    }
}

fn frame(columns: &Columns, theme: &Theme, buffer: &mut Buffer) {
    let cursor = Some(Cursor { position: 7, y: 0.0 });
    let (glyphs, layers) = (Glyphs::Unicode, Layers::ALL);
    TracePlot { columns, theme, glyphs, layers, cursor, selection: None }
        .render(Rect { height: AREA.height - 1, ..AREA }, buffer);
    FlagRail { columns, theme, glyphs, label: "flags", cursor: None, selection: None }
        .render(Rect { y: AREA.height - 1, height: 1, ..AREA }, buffer);
}

fn residual(
    columns: &Columns,
    ratio: &dyn Fn(usize) -> Option<f64>,
    pyramid: &Pyramid,
    theme: &Theme,
    buffer: &mut Buffer,
) {
    let (threshold, top, log, glyphs, cursor) = (1.0, 3.0, false, Glyphs::Unicode, None);
    ResidualPlot { columns, ratio, pyramid, threshold, top, log, theme, glyphs, cursor }
        .render(Rect { height: 10, ..AREA }, buffer);
}

fn of_size(criterion: &mut Criterion, name: &str, n: usize, share_flagged: f64) {
    let record = Record::new(n, share_flagged);
    let theme = Theme::choose(ColorDepth::Indexed256, false);
    let hidden = |i: usize| record.hidden[i];
    let kept = |i: usize| if record.hidden[i] { Span::EMPTY } else { Span::at(record.y[i]) };
    let pyramid = Pyramid::build(&record.y, hidden);
    let index = Flags::new(&record.flags);
    let plot = TracePlot::plot_area(Rect { height: AREA.height - 1, ..AREA });
    let mut buffer = Buffer::empty(AREA);
    let mut group = criterion.benchmark_group(name);
    group.bench_function("pyramid", |b| b.iter(|| Pyramid::build(black_box(&record.y), hidden)));
    group.bench_function("flags", |b| b.iter(|| Flags::new(black_box(&record.flags))));
    for (layers, others) in [("raw", false), ("raw, expected, band, repaired", true)] {
        let curve = Curve { pyramid: &pyramid, span: &kept };
        let other = others.then_some(curve);
        let trace = Trace {
            axis: Axis::Time(&record.t),
            kept: curve,
            flags: &index,
            expected: other,
            band: other,
            repaired: other,
            filtered: None,
            gap: 1.0,
        };
        let view = View::whole(trace.axis);
        for (fit, mode) in [(YFit::Kept, "fit kept"), (YFit::All, "fit all")] {
            group.bench_function(format!("frame: {layers}, {mode}"), |b| {
                b.iter(|| {
                    let y = fit.range(&trace, view);
                    let grid = Grid { view, y, width: plot.width, height: plot.height };
                    frame(&Columns::new(black_box(&trace), grid), &theme, &mut buffer);
                });
            });
        }
        let y = YFit::All.range(&trace, view);
        let columns = Columns::new(&trace, Grid { view, y, width: plot.width, height: plot.height });
        if !others {
            group.bench_function("cursor step", |b| b.iter(|| frame(black_box(&columns), &theme, &mut buffer)));
            let ratio = |i: usize| Some(record.y[i] / 10.0);
            let ratios = ResidualPlot::pyramid(n, ratio);
            let pyramid = &ratios;
            group.bench_function("residual frame", |b| {
                b.iter(|| residual(black_box(&columns), &ratio, pyramid, &theme, &mut buffer));
            });
        }
    }
    group.finish();
}

fn frames(criterion: &mut Criterion) {
    of_size(criterion, "1e6, 0.1 % flagged", 1_000_000, 0.001);
    for (name, n) in [("1e5", 100_000), ("1e6", 1_000_000), ("1e7", 10_000_000)] {
        of_size(criterion, &format!("{name}, 5 % flagged"), n, 0.05);
    }
}

criterion_group! {
    name = benches;
    config = Criterion::default()
        .sample_size(20)
        .warm_up_time(std::time::Duration::from_millis(300))
        .measurement_time(std::time::Duration::from_secs(1));
    targets = frames
}
criterion_main!(benches);
