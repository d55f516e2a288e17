//! The pictures themselves.

use std::fmt::Write as _;

use super::axes::{self, Frame, c};
use super::curve::{Along, area, line};
use super::{Figure, Size, Subject, marks};
use crate::plot::{Columns, Curve, FlagState, Grid, Pyramid, Span, View, YFit, residual_top};
use crate::stop::Stop;
use crate::track::printable;

/// Width of a picture that takes the whole page.
pub(super) const WIDE: u16 = 960;

/// A scale that shows everything is taken up to this many times the range of the kept samples: a fill value would leave
/// them a line.
const MOST_RANGES: f64 = 20.0;

/// The scale that shows everything in view; where some lie so far off that nothing else would be seen, that of the kept
/// samples.
pub(super) fn all_or_kept(subject: &Subject<'_>, view: View) -> YFit {
    let kept = kept_or_robust(subject, view);
    if is_far(subject, view, (YFit::All, kept)) { kept } else { YFit::All }
}

/// The scale of the kept samples, or of most of them where a few lie far off.
fn kept_or_robust(subject: &Subject<'_>, view: View) -> YFit {
    if is_far(subject, view, (YFit::Kept, YFit::Robust)) { YFit::Robust } else { YFit::Kept }
}

fn is_far(subject: &Subject<'_>, view: View, (wide, narrow): (YFit, YFit)) -> bool {
    // Halves, so that the range of the largest doubles does not overflow.
    let half = |fit: YFit| {
        let (low, high) = subject.with_trace(|trace| fit.range(trace, view));
        high * 0.5 - low * 0.5
    };
    half(wide) > MOST_RANGES * half(narrow)
}

/// The whole record with all of its flags in range, if that leaves the others their shape.
pub(super) fn overview(subject: &Subject<'_>) -> Figure {
    let size = Size { width: WIDE, height: 160 };
    let fit = all_or_kept(subject, subject.whole());
    let caption = match fit {
        YFit::All => "Overview: the whole record, flags to scale.",
        _ => "Overview: the whole record at the scale of the kept samples; flags far beyond it are arrows at the edge.",
    };
    Figure { svg: of_trace(subject, subject.whole(), fit, size, false), caption: caption.to_owned(), small: false }
}

/// The whole record at the scale of its kept samples, with band, repair and flags.
pub(super) fn trace(subject: &Subject<'_>) -> Figure {
    let size = Size { width: WIDE, height: 332 };
    let filtered = if subject.filtered.is_some() { ", filtered" } else { "" };
    let caption = format!(
        "Trace at the scale of the kept samples: measured, expected with its tolerance, repaired{filtered}. Arrows at \
         the edge are flags beyond it."
    );
    let fit = kept_or_robust(subject, subject.whole());
    Figure { svg: of_trace(subject, subject.whole(), fit, size, true), caption, small: false }
}

/// A picture of a part of the trace.
pub(super) fn of_trace(subject: &Subject<'_>, view: View, fit: YFit, size: Size, layers: bool) -> String {
    subject.with_trace(|trace| {
        let mut y = fit.range(trace, view);
        if layers && view != subject.whole() {
            // Close up, the band is what matters: it is in range.
            let band =
                trace.band.as_ref().map_or(Span::EMPTY, |b| b.pyramid.span_over(b.span, view.positions(trace.axis)));
            y = if band.is_empty() { y } else { (y.0.min(band.low), y.1.max(band.high)) };
        }
        let frame = Frame { size, view, y };
        let columns = Columns::new(trace, grid(frame));
        let along = Along { axis: trace.axis, columns: &columns, frame, gap: trace.gap };
        let mut out = begun(subject, &columns, frame, &subject.channel);
        let mut path = |class: &str, d: String| {
            if !d.is_empty() {
                let _ = write!(out, r#"<path class="{class}" d="{d}"/>"#);
            }
        };
        let of = |curve: Option<&Curve<'_>>| curve.map(|curve| along.vertices(curve)).unwrap_or_default();
        if layers {
            path("band", area(&of(trace.band.as_ref()), frame));
            path("expected", line(&of(trace.expected.as_ref()), frame));
        }
        path("raw", line(&of(Some(&trace.kept)), frame));
        if layers {
            path("filtered", line(&of(trace.filtered.as_ref()), frame));
        }
        out.push_str("</svg>");
        let positions = columns.in_view();
        if layers {
            repaired(subject, &positions, frame, &mut out);
        }
        let at = |(i, state): (usize, _)| (subject.series.t[i], subject.series.y[i], state);
        let flags: Vec<_> = subject.flags_in(&positions).into_iter().map(at).collect();
        marks::draw(&flags, frame, &mut out);
        out.push_str("</svg>");
        out
    })
}

/// A picture with its gaps and axes, up to the curves, which are cut at its frame.
fn begun(subject: &Subject<'_>, columns: &Columns, frame: Frame, what: &str) -> String {
    let mut out = open(frame.size);
    gaps(columns, frame, &mut out);
    axes::draw(frame, subject.time, what, &mut out);
    out.push_str(&cut(frame));
    out
}

/// The unit of the residual.
pub(super) fn unit(subject: &Subject<'_>) -> &'static str {
    if subject.drawn.in_scales() { "sigma" } else { "tolerances" }
}

/// The residual before repair, with the threshold on both sides.
pub(super) fn residual(subject: &Subject<'_>) -> Figure {
    let (d, series) = (&subject.drawn, &subject.series);
    let ratio = |i: usize| d.residual(series, i).map_or(Span::EMPTY, Span::at);
    let at = |(i, state): (usize, _)| (series.t[i], d.residual(series, i).unwrap_or(0.0), state);
    let flags: Vec<_> = subject.flags_in(&(0..series.len())).into_iter().map(at).collect();
    let svg = of_residual(subject, &Curve { pyramid: &d.ratios, span: &ratio }, &flags);
    let caption = format!(
        "Residual before repair (measured - expected) in {}; the threshold is at the dashed lines ({}). A flag \
         without an expected value is at 0.",
        unit(subject),
        super::super::inspection::short(d.threshold)
    );
    Figure { caption, svg, small: false }
}

/// The residual of what the cleaned file has.
pub(super) fn residual_after(subject: &Subject<'_>) -> Figure {
    let (d, series) = (&subject.drawn, &subject.series);
    let after = |i: usize| {
        let raw = d.residual(series, i)?;
        match (d.hidden[i], d.outcome.fix(i)) {
            (true, Some(fix)) => {
                // The residual is a line in the value: its slope is the same for the repaired one.
                let expected = *d.outcome.detection.judged.expected().get(i)?;
                Some(raw * (fix - expected) / (series.y[i] - expected)).filter(|r| r.is_finite())
            }
            (true, None) => None,
            (false, _) => Some(raw),
        }
    };
    let span = |i: usize| after(i).map_or(Span::EMPTY, Span::at);
    let pyramid = Pyramid::build_spans_unless(series.len(), span, &Stop::never()).unwrap_or_default();
    let svg = of_residual(subject, &Curve { pyramid: &pyramid, span: &span }, &[]);
    let caption = format!("Residual after repair, at the same scale, in {}. Removed values have none.", unit(subject));
    Figure { caption, svg, small: false }
}

/// A picture of residuals.
fn of_residual(subject: &Subject<'_>, curve: &Curve<'_>, flags: &[(f64, f64, FlagState)]) -> String {
    let d = &subject.drawn;
    let size = Size { width: WIDE, height: 212 };
    // The threshold lies between a quarter and half of the way up, as on the screen.
    let top = residual_top(d.threshold);
    let frame = Frame { size, view: subject.whole(), y: (-top, top) };
    subject.with_trace(|trace| {
        let columns = Columns::new(trace, grid(frame));
        let along = Along { axis: trace.axis, columns: &columns, frame, gap: trace.gap };
        let mut out = begun(subject, &columns, frame, &format!("residual [{}]", unit(subject)));
        let _ = write!(out, r#"<path class="raw" d="{}"/>"#, line(&along.vertices(curve), frame));
        for threshold in [d.threshold, -d.threshold] {
            let y = frame.at(threshold);
            let _ = write!(out, r#"<path class="threshold" d="M{} {}h{}"/>"#, c(frame.left()), c(y), c(frame.width()));
        }
        out.push_str("</svg>");
        marks::draw(flags, frame, &mut out);
        out.push_str("</svg>");
        out
    })
}

/// Where outliers go: a stroke from the flag to its new value.
fn repaired(subject: &Subject<'_>, positions: &std::ops::Range<usize>, frame: Frame, out: &mut String) {
    let outcome = &subject.drawn.outcome;
    let from = outcome.outliers.partition_point(|&i| i < positions.start);
    let to = outcome.outliers.partition_point(|&i| i < positions.end);
    let mut path = String::new();
    let mut places = marks::Places::new(to - from);
    for (&i, &fix) in outcome.outliers[from..to].iter().zip(&outcome.fixes[from..to]) {
        let (x, y) = (frame.x(subject.series.t[i]), frame.at(fix));
        let inside = fix.is_finite() && y >= frame.top() && y <= frame.top() + frame.height();
        if inside && places.is_free(x, y, None) {
            let _ = write!(path, "M{} {}h4m-2-2v4", c(x - 2.0), c(y));
        }
    }
    if !path.is_empty() {
        let _ = write!(out, r#"<path class="repaired" d="{path}"/>"#);
    }
}

fn grid(frame: Frame) -> Grid {
    // A column of dots is a unit wide, a cell two.
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a picture is small")]
    let (width, height) = ((frame.width() / 2.0) as u16, (frame.height() / 4.0) as u16);
    Grid { view: frame.view, y: frame.y, width, height }
}

/// Shades stretches of lost samples.
fn gaps(columns: &Columns, frame: Frame, out: &mut String) {
    let cells = columns.gap_columns();
    let step = frame.width() / cells.len().max(1) as f64;
    let mut path = String::new();
    let mut from = None;
    for (column, lost) in cells.iter().chain([&false]).enumerate() {
        match (from, lost) {
            (None, true) => from = Some(column),
            (Some(start), false) => {
                let (x, width) = (frame.left() + start as f64 * step, (column - start) as f64 * step);
                let _ = write!(path, "M{} {}h{}v{}h-{}z", c(x), c(frame.top()), c(width), c(frame.height()), c(width));
                from = None;
            }
            _ => {}
        }
    }
    if !path.is_empty() {
        let _ = write!(out, r#"<path class="gap" d="{path}"/>"#);
    }
}

pub(super) fn open(Size { width, height }: Size) -> String {
    format!(
        r#"<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width} {height}" width="{width}" height="{height}" role="img">"#
    )
}

/// An element that cuts what is drawn in it at the frame: a picture in the picture, which needs no name as a clipping
/// path would.
fn cut(frame: Frame) -> String {
    let (x, y, width, height) = (c(frame.left()), c(frame.top()), c(frame.width()), c(frame.height()));
    format!(r#"<svg x="{x}" y="{y}" width="{width}" height="{height}" viewBox="{x} {y} {width} {height}">"#)
}

/// The words under a small picture.
pub(super) fn place(subject: &Subject<'_>, start: usize, length: usize) -> String {
    let row = subject.series.row(start) + 1;
    let time = printable(&subject.time.full_label(subject.series.t[start]));
    if length == 1 { format!("row {row}, {time}") } else { format!("{length} samples from row {row}, {time}") }
}
