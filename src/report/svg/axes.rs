//! The frame of a picture: where values lie in it, and the labels around it.

use std::fmt::Write as _;

use super::super::html::escaped;
use super::Size;
use crate::plot::{TimeTicks, ValueLabels, View};
use crate::track::{TimeAxis, without_signed_zero};

/// Room left of the plot for labels.
const LEFT: f64 = 62.0;
/// Room right of it.
const RIGHT: f64 = 12.0;
/// Room above it, for what the values are.
const TOP: f64 = 20.0;
/// Room below it.
const BOTTOM: f64 = 24.0;
/// Width of a character of the labels.
const CHARACTER: f64 = 6.6;

/// Where x and y lie in a picture.
#[derive(Debug, Clone, Copy)]
pub(super) struct Frame {
    pub(super) size: Size,
    pub(super) view: View,
    /// The y range.
    pub(super) y: (f64, f64),
}

impl Frame {
    pub(super) fn left(self) -> f64 {
        LEFT
    }

    pub(super) fn top(self) -> f64 {
        TOP
    }

    pub(super) fn width(self) -> f64 {
        f64::from(self.size.width) - LEFT - RIGHT
    }

    pub(super) fn height(self) -> f64 {
        f64::from(self.size.height) - TOP - BOTTOM
    }

    /// Where an x lies.
    pub(super) fn x(self, x: f64) -> f64 {
        LEFT + (x - self.view.from) / self.view.width().max(f64::MIN_POSITIVE) * self.width()
    }

    /// Where a value lies; far outside, but finite, for what is out of range.
    pub(super) fn at(self, y: f64) -> f64 {
        // Half values, so that the range of the largest doubles does not overflow.
        let share = (self.y.1 * 0.5 - y * 0.5) / (self.y.1 * 0.5 - self.y.0 * 0.5);
        TOP + (share * self.height()).clamp(-1e4, 1e4)
    }

    /// Where a flag is drawn: at the edge when it is out of range, and whether that is so.
    pub(super) fn marked(self, y: f64) -> (f64, Option<Edge>) {
        if y > self.y.1 {
            (TOP + 5.0, Some(Edge::Above))
        } else if y < self.y.0 {
            (TOP + self.height() - 5.0, Some(Edge::Below))
        } else {
            (self.at(y), None)
        }
    }
}

/// The edge beyond which a value lies.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Edge {
    /// Higher than what is shown.
    Above,
    /// Lower than what is shown.
    Below,
}

/// A coordinate with a tenth of a unit.
pub(super) fn c(value: f64) -> String {
    let text = without_signed_zero(format!("{value:.1}"));
    let text = text.strip_suffix(".0").unwrap_or(&text);
    if text == "-0" { "0".into() } else { text.into() }
}

/// The frame with its grid, ticks and labels.
pub(super) fn draw(frame: Frame, time: &TimeAxis, what: &str, out: &mut String) {
    let (left, top, width, height) = (frame.left(), frame.top(), frame.width(), frame.height());
    let _ = write!(out, r#"<text x="{}" y="{}">{}</text>"#, c(left), c(top - 7.0), escaped(what));
    values(frame, out);
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a picture has few columns")]
    let columns = (width / CHARACTER) as u16;
    let ticks = TimeTicks::new(time, frame.view, columns);
    let last = frame.left() + width;
    let base = top + height;
    let unit_at = last - ticks.unit.len() as f64 * CHARACTER;
    for x in ticks.at(frame.view, columns) {
        let at = frame.x(x);
        let _ = write!(out, r#"<path class="grid" d="M{} {}v{}"/>"#, c(at), c(top), c(height));
        let text = ticks.label(time, x);
        if at + text.len() as f64 * CHARACTER / 2.0 + CHARACTER < unit_at {
            let _ = write!(out, r#"<text class="x" x="{}" y="{}">{text}</text>"#, c(at), c(base + 16.0));
        }
    }
    let _ = write!(out, r#"<text class="u" x="{}" y="{}">{}</text>"#, c(last), c(base + 16.0), ticks.unit);
    border(frame, out);
}

/// The grid and the labels of the values.
pub(super) fn values(frame: Frame, out: &mut String) {
    let (left, top, width, height) = (frame.left(), frame.top(), frame.width(), frame.height());
    let labels = ValueLabels::new(frame.y.0, frame.y.1, if height > 120.0 { 5 } else { 3 });
    for (value, text) in &labels.ticks {
        let y = frame.at(*value);
        let _ = write!(out, r#"<path class="grid" d="M{} {}h{}"/>"#, c(left), c(y), c(width));
        let _ = write!(out, r#"<text class="y" x="{}" y="{}">{text}</text>"#, c(left - 6.0), c(y + 3.5));
    }
    if !labels.note.is_empty() {
        // What turns the labels into values stands above the first of them.
        let _ = write!(out, r#"<text class="y" x="{}" y="{}">{}</text>"#, c(left - 6.0), c(top + 3.5), labels.note);
    }
}

/// The frame itself.
pub(super) fn border(frame: Frame, out: &mut String) {
    let (x, y, width, height) = (c(frame.left()), c(frame.top()), c(frame.width()), c(frame.height()));
    let _ = write!(out, r#"<rect class="frame" x="{x}" y="{y}" width="{width}" height="{height}"/>"#);
}
