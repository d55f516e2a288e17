//! The pictures themselves.

use std::fmt::Write as _;

use super::axes::{self, Frame, c};
use super::curve::{Along, area, line};
use super::{Figure, Size, Subject, marks};
use crate::plot::{Columns, Curve, Grid, Span, View, YFit};
use crate::track::printable;

const WIDE: u16 = 960;

/// The whole record with all of its wild points in range.
pub(super) fn overview(subject: &Subject<'_>) -> Figure {
    let size = Size { width: WIDE, height: 150 };
    let caption = "Overview: the whole record, wild points to scale.".to_owned();
    Figure { svg: of_trace(subject, subject.whole(), YFit::All, size, false), caption, small: false }
}

/// The whole record at the scale of its kept samples, with band, repair and flags.
pub(super) fn trace(subject: &Subject<'_>) -> Figure {
    let size = Size { width: WIDE, height: 320 };
    let caption = "Trace at the scale of the kept samples: measured, expected with its tolerance, repaired. \
                   Arrows at the edge are flags beyond it."
        .to_owned();
    Figure { svg: of_trace(subject, subject.whole(), YFit::Kept, size, true), caption, small: false }
}

/// A picture of a part of the trace.
pub(super) fn of_trace(subject: &Subject<'_>, view: View, fit: YFit, size: Size, layers: bool) -> String {
    subject.with_trace(|trace| {
        let mut y = fit.range(trace, view);
        if layers && view != subject.whole() {
            // From near, the band is what matters: it is in range.
            let band =
                trace.band.as_ref().map_or(Span::EMPTY, |b| b.pyramid.span_over(b.span, view.positions(trace.axis)));
            y = if band.is_empty() { y } else { (y.0.min(band.low), y.1.max(band.high)) };
        }
        let frame = Frame { size, view, y };
        let columns = Columns::new(trace, grid(frame));
        let along = Along { axis: trace.axis, columns: &columns, frame, gap: trace.gap };
        let mut out = begun(subject, &columns, frame);
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
fn begun(subject: &Subject<'_>, columns: &Columns, frame: Frame) -> String {
    let mut out = open(frame.size);
    gaps(columns, frame, &mut out);
    axes::draw(frame, subject.time, &mut out);
    out.push_str(&cut(frame));
    out
}

/// The residual in scales or tolerances, with the threshold on both sides.
pub(super) fn residual(subject: &Subject<'_>) -> Figure {
    let (d, series) = (&subject.drawn, &subject.series);
    let size = Size { width: WIDE, height: 200 };
    // The threshold lies between a quarter and half of the way up, as on the screen.
    let top = 10.0 * (d.threshold / 2.5).log2().floor().exp2();
    let top = if top.is_finite() && top > 0.0 { top } else { 10.0 };
    let frame = Frame { size, view: subject.whole(), y: (-top, top) };
    let ratio = |i: usize| d.residual(series, i).map_or(Span::EMPTY, Span::at);
    let svg = subject.with_trace(|trace| {
        let columns = Columns::new(trace, grid(frame));
        let along = Along { axis: trace.axis, columns: &columns, frame, gap: trace.gap };
        let mut out = begun(subject, &columns, frame);
        let curve = Curve { pyramid: &d.ratios, span: &ratio };
        let _ = write!(out, r#"<path class="raw" d="{}"/>"#, line(&along.vertices(&curve), frame));
        for threshold in [d.threshold, -d.threshold] {
            let y = frame.at(threshold);
            let _ = write!(out, r#"<path class="threshold" d="M{} {}h{}"/>"#, c(frame.left()), c(y), c(frame.width()));
        }
        out.push_str("</svg>");
        let at = |(i, state): (usize, _)| (series.t[i], d.residual(series, i).unwrap_or(0.0), state);
        let flags: Vec<_> = subject.flags_in(&columns.in_view()).into_iter().map(at).collect();
        marks::draw(&flags, frame, &mut out);
        out.push_str("</svg>");
        out
    });
    let unit = if d.in_scales() { "scales" } else { "tolerances" };
    let caption = format!(
        "Residual (measured - expected) in {unit}; the dashed lines at {} flag. A flag without an expected value \
         lies at 0.",
        super::super::inspection::short(d.threshold)
    );
    Figure { caption, svg, small: false }
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

fn open(Size { width, height }: Size) -> String {
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
