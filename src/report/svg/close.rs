//! The largest flags, close up.

use super::picture::{all_or_kept, of_trace, place};
use super::{Figure, Size, Subject};
use crate::plot::View;
use crate::session::Run;

/// How many events are shown.
const MOST: usize = 12;
/// Samples left and right of a run.
const AROUND: usize = 25;

/// Pictures of the events (isolated outliers and runs) with the largest residuals, in the order of the record, and how
/// many of all they are; empty when they are all.
pub(super) fn largest(subject: &Subject<'_>) -> (Vec<Figure>, String) {
    let size = |run: &Run| {
        let ratio = |i: usize| subject.drawn.ratio(&subject.series, i).map_or(0.0, f64::abs);
        (run.start..run.start + run.length).map(ratio).fold(0.0, f64::max)
    };
    let mut runs: Vec<(f64, &Run)> = subject.drawn.outcome.runs.iter().map(|run| (size(run), run)).collect();
    // A record that all pictures show close up already needs none closer.
    if subject.series.len() <= 4 * AROUND {
        return (Vec::new(), String::new());
    }
    let all = runs.len();
    runs.sort_by(|a, b| b.0.total_cmp(&a.0).then(a.1.start.cmp(&b.1.start)));
    runs.truncate(MOST);
    runs.sort_by_key(|(_, run)| run.start);
    let words = if all > MOST {
        format!("The {MOST} largest of {all} events (isolated outliers and runs), in the order of the record.")
    } else {
        String::new()
    };
    (runs.into_iter().map(|(ratio, run)| near(subject, run, ratio)).collect(), words)
}

fn near(subject: &Subject<'_>, run: &Run, ratio: f64) -> Figure {
    let t = &subject.series.t;
    let around = AROUND.max(run.length);
    let (from, to) = (run.start.saturating_sub(around), (run.start + run.length + around).min(t.len()) - 1);
    // A long gap at the side would leave the run a dot: the view ends where the record is cut.
    let cut = |a: usize, b: usize| t[b] - t[a] > subject.gap;
    let from = (from..run.start).rev().find(|&i| cut(i, i + 1)).map_or(from, |i| i + 1);
    let to = (run.start + run.length..to + 1).find(|&i| cut(i - 1, i)).map_or(to, |i| i - 1);
    let (from, to) = (t[from], t[to]);
    let pad = if to > from { (to - from) * 0.01 } else { 0.5 };
    let view = View { from: from - pad, to: to + pad };
    let svg = of_trace(subject, view, all_or_kept(subject, view), Size { width: 470, height: 202 }, true);
    let ratio = if ratio > 0.0 { format!(", {ratio:.1} tolerances from the expected value") } else { String::new() };
    Figure { caption: place(subject, run.start, run.length) + &ratio, svg, small: true }
}
