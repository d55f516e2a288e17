//! The plots: overview, trace, residual.

use std::cell::OnceCell;

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::text::Span as Words;
use ratatui::widgets::Widget;

use super::super::action::Panel;
use super::super::model::{Layers, Model, YMode};
use super::super::plot::{
    self, Axis, AxisLabels, Columns, Cursor, Curve, FlagRail, Flags, Grid, Overview, Pyramid, ResidualPlot, Span,
    TickSteps, Trace, TracePlot, View, YFit, tick_step,
};
use super::{heading, short, thousands};
use crate::method::shared::MAX_GAP;
use crate::plot::Drawn;
use crate::track::{Series, TimeFormat};

/// What the plots of one frame share.
pub(super) struct Plots<'a> {
    model: &'a Model,
    series: Series<'a>,
    drawn: Option<&'a Drawn>,
    no_flags: Flags,
    /// The samples while there is no result yet.
    plain: Pyramid,
    /// The samples in view, reduced for the trace; the panels below it show the same columns.
    in_view: OnceCell<Columns>,
}

impl<'a> Plots<'a> {
    pub(super) fn new(model: &'a Model) -> Self {
        let series = model.series();
        let drawn = model.state().drawn.as_deref();
        let plain = if drawn.is_none() { Pyramid::build(&series.y, |_| false) } else { Pyramid::default() };
        Self { model, series, drawn, no_flags: Flags::default(), plain, in_view: OnceCell::new() }
    }

    fn axis(&self) -> Axis<'_> {
        Axis::Time(&self.series.t)
    }

    /// Calls `draw` with the trace that the model's layers want.
    fn with_trace<R>(&self, layers: Layers, draw: impl FnOnce(&Trace<'_>) -> R) -> R {
        let y = &self.series.y;
        let gap = self.gap();
        let Some(d) = self.drawn else {
            let span = |i: usize| y.get(i).copied().map_or(Span::EMPTY, Span::at);
            let kept = Curve { pyramid: &self.plain, span: &span };
            let (axis, flags) = (self.axis(), &self.no_flags);
            return draw(&Trace { axis, kept, flags, expected: None, band: None, repaired: None, gap });
        };
        let kept = |i: usize| d.kept_span(&self.series, i);
        let after = |i: usize| d.after_span(&self.series, i);
        let expected = |i: usize| d.expected_span(i);
        let band = |i: usize| d.band_span(i);
        let repaired = |i: usize| d.repaired_span(i);
        let axis = self.axis();
        if layers == Layers::After {
            let kept = Curve { pyramid: &d.after, span: &after };
            let repaired = Some(Curve { pyramid: &d.repaired, span: &repaired });
            return draw(&Trace { axis, kept, flags: &self.no_flags, expected: None, band: None, repaired, gap });
        }
        let with = |on: bool, pyramid, span| on.then_some(Curve { pyramid, span });
        draw(&Trace {
            axis,
            kept: Curve { pyramid: &d.kept, span: &kept },
            flags: &self.model.state().flags,
            expected: with(layers != Layers::Raw, &d.expected, &expected),
            band: with(layers == Layers::Band, &d.band, &band),
            repaired: with(layers != Layers::Raw, &d.repaired, &repaired),
            gap,
        })
    }

    /// Neighbours further apart than this are not joined: the record is cut there.
    fn gap(&self) -> f64 {
        let settings = &self.model.plan().setup.settings;
        #[expect(clippy::cast_precision_loss, reason = "counts are far below 2^53")]
        let lost = settings.whole_or_off(MAX_GAP.key).map(|n| n as f64 + 1.5 - 1e-6);
        lost.map_or(f64::INFINITY, |steps| steps * self.series.interval)
    }

    fn y_fit(&self) -> YFit {
        match self.model.state().y_fit {
            YMode::Kept => YFit::Kept,
            YMode::All => YFit::All,
            YMode::Robust => YFit::Robust,
        }
    }

    pub(super) fn overview(&self, area: Rect, buffer: &mut Buffer) {
        let (theme, glyphs) = (&self.model.theme, self.model.glyphs);
        let view = View::whole(self.axis());
        let plot = TracePlot::plot_area(area);
        let columns = self.with_trace(Layers::Raw, |trace| {
            let y = YFit::Kept.range(trace, view);
            Columns::new(trace, Grid { view, y, width: plot.width, height: area.height.saturating_sub(1) })
        });
        Overview { columns: &columns, viewport: self.model.state().view, theme, glyphs }.render(area, buffer);
    }

    pub(super) fn trace(&self, area: Rect, buffer: &mut Buffer) {
        let model = self.model;
        let (theme, glyphs, state) = (&model.theme, model.glyphs, model.state());
        let head = Rect { height: area.height.min(1), ..area };
        let mut body = Rect { y: area.y + head.height, height: area.height - head.height, ..area };
        let axis_row = (body.height >= 5).then(|| take_bottom(&mut body));
        let rail_row = take_bottom(&mut body);
        let plot = TracePlot::plot_area(body);
        let view = state.view;
        let columns = self.in_view.get_or_init(|| {
            self.with_trace(state.layers, |trace| {
                let y = self.y_fit().range(trace, view);
                Columns::new(trace, Grid { view, y, width: plot.width, height: body.height })
            })
        });
        // The rail never goes away, not even while the record is shown as it will be after repair, without its flags.
        let with_flags = (state.layers == Layers::After).then(|| {
            self.with_trace(Layers::Raw, |trace| {
                Columns::new(trace, Grid { view, y: columns.grid().y, width: plot.width, height: 1 })
            })
        });
        let cursor = self.series.y.get(state.cursor).map(|&y| Cursor { position: state.cursor, y });
        let selection = model.selection();
        let widget = TracePlot { columns, theme, glyphs, layers: plot::Layers::ALL, cursor, selection };
        let note = widget.y_note();
        let words = self.trace_words(columns, &note);
        let words: Vec<Words<'_>> = words.iter().map(|w| Words::styled(w.as_str(), theme.dim)).collect();
        heading(model, Panel::Trace, &words, head, buffer);
        widget.render(body, buffer);
        let cursor = Some(state.cursor);
        FlagRail { columns: with_flags.as_ref().unwrap_or(columns), theme, glyphs, label: "flags", cursor }
            .render(rail_row, buffer);
        if let Some(row) = axis_row {
            self.axis_labels(row, view, buffer);
        }
    }

    fn trace_words(&self, columns: &Columns, note: &str) -> Vec<String> {
        let state = self.model.state();
        let inside = columns.in_view().len();
        let n = self.series.len();
        let mut words = Vec::new();
        if inside < n {
            words.push(format!("{} of {} samples  ", thousands(inside), thousands(n)));
        } else {
            words.push(format!("all {} samples  ", thousands(n)));
        }
        if !note.is_empty() {
            words.push(format!("y {note}  "));
        }
        let fit = match state.y_fit {
            YMode::Kept => "",
            YMode::All => "y: all  ",
            YMode::Robust => "y: robust  ",
        };
        let layers = match state.layers {
            Layers::Band => "",
            Layers::Expected => "with expected  ",
            Layers::Raw => "curve alone  ",
            Layers::After => "AFTER REPAIR  ",
        };
        words.extend([fit, layers].iter().filter(|w| !w.is_empty()).map(|w| (*w).to_owned()));
        words
    }

    fn axis_labels(&self, row: Rect, view: View, buffer: &mut Buffer) {
        let time = &self.model.track.time;
        let calendar = time.date(0.0).is_some();
        let clock = calendar || time.format == TimeFormat::Clock;
        let steps = if clock { TickSteps::Clock } else { TickSteps::Decimal };
        let width = TracePlot::plot_area(row).width;
        // Days need the date, short steps the fraction of a second.
        let step = tick_step(view, width, 12, steps);
        let digits = decimals(step);
        let label_width = if clock { 8 + if digits > 0 { digits + 1 } else { 0 } } else { 10 };
        let label = |x: f64| {
            let date = if step >= 43_200.0 { time.date(x) } else { None };
            date.unwrap_or_else(|| time.label(x, digits))
        };
        #[expect(clippy::cast_precision_loss, reason = "the remainder of a day fits a double")]
        let phase = if clock {
            (time.origin_ns.rem_euclid(86_400_000_000_000)) as f64 / 1e9
        } else {
            time.origin_ns as f64 / 1e9
        };
        let unit = match time.format {
            TimeFormat::Iso | TimeFormat::YearLast { .. } | TimeFormat::Epoch { .. } => "UTC",
            TimeFormat::Seconds => "s",
            TimeFormat::SampleNumber => "sample",
            TimeFormat::Elapsed { .. } | TimeFormat::Clock => "",
        };
        let label_width = u16::try_from(label_width).unwrap_or(12);
        let theme = &self.model.theme;
        AxisLabels { view, steps, phase, label_width, label: &label, unit, theme }.render(row, buffer);
    }

    pub(super) fn residual(&self, area: Rect, buffer: &mut Buffer) {
        let model = self.model;
        let (theme, glyphs, state) = (&model.theme, model.glyphs, model.state());
        let head = Rect { height: area.height.min(1), ..area };
        let body = Rect { y: area.y + head.height, height: area.height - head.height, ..area };
        let view = state.view;
        let plot = TracePlot::plot_area(body);
        let columns = self.in_view.get_or_init(|| {
            self.with_trace(Layers::Raw, |trace| {
                Columns::new(trace, Grid { view, y: (0.0, 1.0), width: plot.width, height: body.height })
            })
        });
        let nothing = Pyramid::default();
        let pyramid = self.drawn.map_or(&nothing, |d| &d.ratios);
        let ratio = |i: usize| self.drawn.and_then(|d| d.residual(&self.series, i));
        let cursor = Some(state.cursor);
        let threshold = self.drawn.map_or(1.0, |d| d.threshold);
        let top = ResidualPlot::top_for(threshold);
        let widget = ResidualPlot { columns, ratio: &ratio, pyramid, threshold, top, theme, glyphs, cursor };
        let unit = if self.drawn.is_some_and(Drawn::in_scales) { "scales" } else { "tolerances" };
        let what = if widget.is_signed() { "in" } else { "worst per column in" };
        let at = format!("{what} {unit}, flagged from {}  ", short(threshold));
        let words = [Words::styled(at, theme.dim)];
        heading(model, Panel::Residual, &words, head, buffer);
        widget.render(body, buffer);
    }
}

fn take_bottom(rest: &mut Rect) -> Rect {
    let height = rest.height.min(1);
    rest.height -= height;
    Rect { y: rest.y + rest.height, height, ..*rest }
}

/// Decimals that tell labels `step` seconds apart from each other.
fn decimals(step: f64) -> usize {
    (0..9).find(|&d| (step * 10_f64.powi(d)).fract().abs() < 1e-9).map_or(9, |d| usize::try_from(d).unwrap_or(0))
}
