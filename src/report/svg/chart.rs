//! Curves in one frame, on logarithmic axes upwards.

use std::fmt::Write as _;

use super::axes::c;
use super::{Figure, Size};
use crate::experiment::Chart;

/// The classes of curves, in their order; the style of the page gives them their colours.
pub(in crate::report) const CURVES: [&str; 4] = ["curve-a", "curve-b", "curve-c", "curve-d"];

/// Room for labels left, right, above and below.
const LEFT: f64 = 62.0;
const RIGHT: f64 = 12.0;
const TOP: f64 = 8.0;
const BOTTOM: f64 = 24.0;

/// Where numbers lie along one side.
#[derive(Debug, Clone, Copy)]
struct Side {
    low: f64,
    high: f64,
    logarithmic: bool,
}

impl Side {
    /// The side that holds these numbers.
    fn of(numbers: impl Iterator<Item = f64>, logarithmic: bool) -> Self {
        let (low, high) = numbers.fold((f64::MAX, 0.0_f64), |(l, h), x| (l.min(x), h.max(x)));
        // A little room at both ends, and some where all numbers are one.
        let room = if low < high { 1.04 } else { 2.0 };
        if logarithmic {
            Self { low: low / room, high: high * room, logarithmic }
        } else {
            Self { low: (low - 1.0).max(0.0), high: high + 1.0, logarithmic }
        }
    }

    /// 0 at the low end, 1 at the high one.
    fn share(self, x: f64) -> f64 {
        if self.logarithmic {
            (x / self.low).ln() / (self.high / self.low).ln()
        } else {
            (x - self.low) / (self.high - self.low)
        }
    }

    /// Round numbers within: 1, 2 and 5 times powers of ten, or even steps.
    fn ticks(self) -> Vec<f64> {
        let decades = |from: f64| (-9..=9).flat_map(move |e| [1.0, 2.0, 5.0].map(|m| m * from * 10_f64.powi(e)));
        if self.logarithmic {
            return decades(1.0).filter(|x| (self.low..=self.high).contains(x)).collect();
        }
        let step = decades(1.0).find(|step| (self.high - self.low) / step <= 8.0).unwrap_or(self.high - self.low);
        (0..=8).map(|i| ((self.low / step).ceil() + f64::from(i)) * step).filter(|x| *x <= self.high).collect()
    }
}

/// The picture of a chart; none where there is nothing to draw.
pub(in crate::report) fn chart(chart: &Chart) -> Option<Figure> {
    let points = || chart.curves.iter().flat_map(|curve| curve.points.iter());
    points().next()?;
    let size = Size { width: 960, height: 300 };
    let (width, height) = (f64::from(size.width) - LEFT - RIGHT, f64::from(size.height) - TOP - BOTTOM);
    let across = Side::of(points().map(|p| p.0), chart.logarithmic_x);
    let up = Side::of(points().map(|p| p.1), true);
    let (x, y) = (|v: f64| LEFT + across.share(v) * width, |v: f64| TOP + (1.0 - up.share(v)) * height);
    let mut out = format!(
        r#"<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {0} {1}" width="{0}" height="{1}" role="img">"#,
        size.width, size.height
    );
    for tick in up.ticks() {
        let _ = write!(out, r#"<path class="grid" d="M{} {}h{}"/>"#, c(LEFT), c(y(tick)), c(width));
        let _ = write!(out, r#"<text class="y" x="{}" y="{}">{tick}</text>"#, c(LEFT - 6.0), c(y(tick) + 3.5));
    }
    let base = TOP + height;
    for tick in across.ticks() {
        let _ = write!(out, r#"<path class="grid" d="M{} {}v{}"/>"#, c(x(tick)), c(TOP), c(height));
        let _ = write!(out, r#"<text class="x" x="{}" y="{}">{tick}</text>"#, c(x(tick)), c(base + 16.0));
    }
    let _ = write!(
        out,
        r#"<rect class="frame" x="{}" y="{}" width="{}" height="{}"/>"#,
        c(LEFT),
        c(TOP),
        c(width),
        c(height)
    );
    for (curve, class) in chart.curves.iter().zip(CURVES.iter().cycle()) {
        let mut path = String::new();
        for (i, &(px, py)) in curve.points.iter().enumerate() {
            let _ = write!(path, "{}{} {}", if i == 0 { 'M' } else { 'L' }, c(x(px)), c(y(py)));
        }
        let _ = write!(out, r#"<path class="curve {class}" d="{path}"/>"#);
    }
    out.push_str("</svg>");
    let caption = format!("{}. To the right: {}; upwards: {}.", chart.title, chart.x, chart.y);
    Some(Figure { caption, svg: out, small: false })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_side_has_round_ticks_within() {
        let side = Side { low: 0.15, high: 60.0, logarithmic: true };
        assert_eq!(side.ticks(), [0.2, 0.5, 1.0, 2.0, 5.0, 10.0, 20.0, 50.0]);
        assert!((side.share(0.15)).abs() < 1e-12 && (side.share(60.0) - 1.0).abs() < 1e-12);
        assert!((side.share(3.0) - 0.5).abs() < 1e-9, "the geometric middle");
        let runs = Side { low: 0.0, high: 101.0, logarithmic: false };
        assert_eq!(runs.ticks(), [0.0, 20.0, 40.0, 60.0, 80.0, 100.0]);
    }
}
