//! How often which residual occurs.

use std::fmt::Write as _;

use super::axes::{self, Frame, c};
use super::picture::{WIDE, open, unit};
use super::{Figure, Size, Subject};
use crate::plot::{Tally, View};
use crate::report::short;

/// Bars of the picture.
const BARS: u16 = 80;

/// The histogram of the residuals before repair: kept samples and flagged ones, with the threshold on both sides. Counts
/// are logarithmic, so that a single flag is seen beside a million samples.
pub(super) fn histogram(subject: &Subject<'_>) -> Figure {
    let histogram = &subject.drawn.histogram;
    let top = histogram.top();
    let bars = histogram.columns(BARS);
    let most = bars.iter().map(|bar| bar.all).max().unwrap_or(0);
    let decades = f64::from(most.max(9) + 1).log10().ceil();
    let frame =
        Frame { size: Size { width: WIDE, height: 180 }, view: View { from: -top, to: top }, y: (0.0, decades) };
    let mut out = open(frame.size);
    labels(frame, decades, unit(subject), &mut out);
    let step = frame.width() / f64::from(BARS);
    for (class, of) in [("bar", (|bar| bar.all) as fn(&Tally) -> u32), ("bar over", |bar| bar.flagged)] {
        let mut path = String::new();
        for (column, bar) in bars.iter().enumerate().filter(|(_, bar)| of(bar) > 0) {
            #[expect(clippy::cast_precision_loss, reason = "a picture has few columns")]
            let x = frame.left() + column as f64 * step;
            let y = frame.at(f64::from(of(bar) + 1).log10());
            let _ = write!(path, "M{} {}V{}h{}V{}z", c(x), c(frame.at(0.0)), c(y), c(step - 1.0), c(frame.at(0.0)));
        }
        let _ = write!(out, r#"<path class="{class}" d="{path}"/>"#);
    }
    for threshold in [subject.drawn.threshold, -subject.drawn.threshold] {
        let _ = write!(
            out,
            r#"<path class="threshold" d="M{} {}v{}"/>"#,
            c(frame.x(threshold)),
            c(frame.top()),
            c(frame.height())
        );
    }
    axes::border(frame, &mut out);
    out.push_str("</svg>");
    Figure { caption: caption(subject), svg: out, small: false }
}

fn caption(subject: &Subject<'_>) -> String {
    let histogram = &subject.drawn.histogram;
    let beyond = histogram.below.all + histogram.above.all;
    let beyond = if beyond > 0 { format!(" {beyond} samples are beyond the edges.") } else { String::new() };
    format!(
        "Histogram of the residual before repair, in {}; counts on a logarithmic scale. Flagged samples are coloured, \
         dashed lines are the threshold.{beyond}",
        unit(subject)
    )
}

/// The counts at the left, the residuals below.
fn labels(frame: Frame, decades: f64, unit: &str, out: &mut String) {
    let (left, bottom) = (frame.left(), frame.top() + frame.height());
    let _ = write!(out, r#"<text x="{}" y="{}">samples</text>"#, c(left), c(frame.top() - 7.0));
    let mut decade = 0.0;
    while decade <= decades {
        let y = frame.at((10_f64.powf(decade) + 1.0).log10());
        if y >= frame.top() {
            let _ = write!(out, r#"<path class="grid" d="M{} {}h{}"/>"#, c(left), c(y), c(frame.width()));
            let count = short(10_f64.powf(decade));
            let _ = write!(out, r#"<text class="y" x="{}" y="{}">{count}</text>"#, c(left - 6.0), c(y + 3.5));
        }
        decade += 1.0;
    }
    for quarter in [-1.0, -0.5, 0.0, 0.5, 1.0] {
        let value = quarter * frame.view.to;
        let class = if quarter > 0.9 {
            "u"
        } else if quarter < -0.9 {
            "s"
        } else {
            "x"
        };
        let words = if quarter == 0.0 { format!("0 {unit}") } else { short(value) };
        let _ =
            write!(out, r#"<text class="{class}" x="{}" y="{}">{words}</text>"#, c(frame.x(value)), c(bottom + 16.0));
    }
}
