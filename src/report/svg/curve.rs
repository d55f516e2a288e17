//! Curves and bands as paths: sample by sample where few are in view, otherwise the extremes of each column.

use std::fmt::Write as _;

use super::axes::{Frame, c};
use crate::plot::{Axis, Columns, Curve, Span};

/// A place along a curve.
#[derive(Debug, Clone, Copy)]
pub(super) struct Vertex {
    /// Where it lies in the picture.
    x: f64,
    span: Span,
    /// True where samples are lost before it.
    broken: bool,
}

/// What a curve is drawn along.
pub(super) struct Along<'a> {
    pub(super) axis: Axis<'a>,
    pub(super) columns: &'a Columns,
    pub(super) frame: Frame,
    pub(super) gap: f64,
}

impl Along<'_> {
    /// The places of a curve that have a value. A sample left and right of the view belongs to them, so that lines
    /// go on to the edge.
    pub(super) fn vertices(&self, curve: &Curve<'_>) -> Vec<Vertex> {
        let inside = self.columns.in_view();
        let mut vertices = Vec::new();
        let mut broken = false;
        let lost = |i: usize| i > 0 && self.axis.times()[i] - self.axis.times()[i - 1] > self.gap;
        let columns = self.columns.dot_columns();
        if inside.len() <= columns.len() {
            for i in inside.start.saturating_sub(1)..(inside.end + 1).min(self.axis.len()) {
                broken |= lost(i);
                let span = (curve.span)(i);
                if !span.is_empty() {
                    vertices.push(Vertex { x: self.frame.x(self.axis.x(i)), span, broken });
                    broken = false;
                }
            }
            return vertices;
        }
        #[expect(clippy::cast_precision_loss, reason = "a picture has few columns")]
        let step = self.frame.width() / columns.len() as f64;
        for (column, range) in columns.into_iter().enumerate() {
            if range.is_empty() {
                continue;
            }
            broken |= lost(range.start);
            let span = curve.pyramid.span_over(curve.span, range);
            if !span.is_empty() {
                #[expect(clippy::cast_precision_loss, reason = "a picture has few columns")]
                let x = self.frame.left() + (column as f64 + 0.5) * step;
                vertices.push(Vertex { x, span, broken });
                broken = false;
            }
        }
        vertices
    }
}

/// The line through the places: at each the nearer extreme first, then the other.
pub(super) fn line(vertices: &[Vertex], frame: Frame) -> String {
    let mut path = String::new();
    let mut last: Option<f64> = None;
    for (i, v) in vertices.iter().enumerate() {
        let (high, low) = (frame.at(v.span.high), frame.at(v.span.low));
        let (first, second) = match last {
            Some(last) if (last - low).abs() < (last - high).abs() => (low, high),
            _ => (high, low),
        };
        let start = v.broken || i == 0;
        let _ = write!(path, "{}{} {}", if start { 'M' } else { 'L' }, c(v.x), c(first));
        if (first - second).abs() >= 0.05 {
            let _ = write!(path, "V{}", c(second));
        }
        // A place alone between two breaks would be a line of no length.
        let alone = start && vertices.get(i + 1).is_none_or(|next| next.broken) && (first - second).abs() < 0.05;
        if alone {
            path.push_str("h.1");
        }
        last = Some(second);
    }
    path
}

/// The area between the extremes of the places.
pub(super) fn area(vertices: &[Vertex], frame: Frame) -> String {
    let mut path = String::new();
    let mut rest = vertices;
    while !rest.is_empty() {
        let next = rest.iter().skip(1).position(|v| v.broken).map_or(rest.len(), |at| at + 1);
        let (stretch, later) = rest.split_at(next);
        for (i, v) in stretch.iter().enumerate() {
            let _ = write!(path, "{}{} {}", if i == 0 { 'M' } else { 'L' }, c(v.x), c(frame.at(v.span.high)));
        }
        for v in stretch.iter().rev() {
            let _ = write!(path, "L{} {}", c(v.x), c(frame.at(v.span.low)));
        }
        path.push('Z');
        rest = later;
    }
    path
}
