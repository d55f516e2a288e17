//! Table 1 of \[003\] and its figures 6, 11 and 16 as curves.

use super::{ERROR, LINES, Line, WINDOWS};
use crate::experiment::{Chart, Curve, Runs};

/// Error over the window, printed and measured, then by run at windows of 20, 50 and 200.
pub(super) fn charts(runs: Runs<'_>) -> Vec<Chart> {
    let over_window = |title: &str, error: &dyn Fn(&Line, usize) -> f64| {
        let points = |line: &Line| {
            let point = |(at, window): (usize, &&str)| Some((window.parse().ok()?, error(line, at)));
            WINDOWS.iter().enumerate().filter_map(point).filter(|(_, y): &(f64, f64)| *y > 0.0).collect()
        };
        chart(
            title.to_owned(),
            "window",
            LINES.iter().map(|line| Curve { name: line.id, points: points(line) }).collect(),
        )
    };
    let mut charts = vec![
        over_window("Table 1 as printed: final error over the window", &|line, at| line.printed[at]),
        over_window("Here, defaults: final error over the window", &|line, at| runs.mean(line.default[at], ERROR)),
        over_window("Here, paper settings: final error over the window", &|line, at| runs.mean(line.paper[at], ERROR)),
    ];
    for (at, figure) in [(3, 6), (5, 11), (7, 16)] {
        let curve = |line: &Line| Curve { name: line.id, points: by_run(runs, line.default[at]) };
        let title = format!("Figure {figure}: final error by run at a window of {}, defaults", WINDOWS[at]);
        charts.push(chart(title, "run", LINES.iter().map(curve).collect()));
    }
    charts
}

fn chart(title: String, x: &'static str, curves: Vec<Curve>) -> Chart {
    Chart { title, x, y: "km", logarithmic_x: x == "window", curves }
}

#[expect(clippy::cast_precision_loss, reason = "a number of runs")]
fn by_run(runs: Runs<'_>, label: &str) -> Vec<(f64, f64)> {
    let point = |(run, figures)| ((run + 1) as f64, Runs(std::slice::from_ref(figures)).mean(label, ERROR));
    runs.0.iter().enumerate().map(point).filter(|(_, y)| *y > 0.0).collect()
}
