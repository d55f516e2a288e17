//! Two passes of the filter with the fill of patches between them, in both directions (step 4 of section 7).

use super::fill::Fill;
use crate::method::predictor::Page;
use crate::method::{Judged, Verdict, Way};
use crate::stop::{Stop, Stopped};

/// What a filter runs over: times with one or more channels, of which every time has at least one.
pub(super) trait Record: Sync {
    /// Times in seconds, increasing.
    fn times(&self) -> &[f64];

    /// Values of each channel, one per time; NaN where it has none.
    fn channels(&self) -> Vec<&[f64]>;

    /// Runs a filter in one direction over the values, or over `filled` where that has another (empty lists: nothing
    /// is filled). One page per channel, an entry per time.
    fn run(&self, filled: &[Vec<f64>], way: Way, pages: &mut [Page], stop: &Stop) -> Result<(), Stopped>;
}

/// How patches are treated.
#[derive(Debug, Clone, Copy)]
pub(super) struct Plan {
    /// Runs of so many samples and more are filled.
    pub(super) patch: usize,
    /// By what.
    pub(super) fill: Fill,
    /// Whether the beginning is judged by a run backwards.
    pub(super) look_back: bool,
}

/// Judges every channel of a record; with entries for all times, also where a channel has no sample.
pub(super) fn judge(record: &impl Record, plan: &Plan, stop: &Stop) -> Result<Vec<Judged>, Stopped> {
    if !plan.look_back {
        return Ok(one_way(record, plan, Way::Forward, stop)?.into_iter().map(|page| page.judged).collect());
    }
    let (forward, backward) =
        rayon::join(|| one_way(record, plan, Way::Forward, stop), || one_way(record, plan, Way::Backward, stop));
    let pages = forward?.into_iter().zip(backward?);
    Ok(pages.map(|(forward, backward)| looked_back(forward, backward)).collect())
}

/// The first start group and all before it as the backward run has them.
fn looked_back(forward: Page, backward: Page) -> Judged {
    let end = forward.first.map_or(0, |group| group.end);
    let (mut judged, back) = (forward.judged, backward.judged);
    judged.verdict[..end].copy_from_slice(&back.verdict[..end]);
    judged.expected[..end].copy_from_slice(&back.expected[..end]);
    judged.tolerance[..end].copy_from_slice(&back.tolerance[..end]);
    judged.own[..end].copy_from_slice(&back.own[..end]);
    judged.restarts.extend(back.restarts.iter().filter(|r| r.at < end));
    judged
}

/// One direction: filter, fill, filter again.
fn one_way(record: &impl Record, plan: &Plan, way: Way, stop: &Stop) -> Result<Vec<Page>, Stopped> {
    let n = record.times().len();
    let channels = record.channels();
    let mut pages: Vec<Page> = channels.iter().map(|_| Page::new(n, way, n)).collect();
    record.run(&[], way, &mut pages, stop)?;
    let fill = |(page, y): (&Page, &&[f64])| filled(record.times(), y, &page.judged.verdict, plan);
    let filled: Vec<Vec<f64>> = pages.iter().zip(&channels).map(fill).collect();
    if filled.iter().any(|values| !values.is_empty()) {
        let kept: Vec<Vec<(usize, f64, f64)>> = pages.iter().zip(&filled).map(|(page, f)| first_run(page, f)).collect();
        pages.iter_mut().for_each(Page::clear);
        record.run(&filled, way, &mut pages, stop)?;
        for (page, kept) in pages.iter_mut().zip(kept) {
            for (i, expected, tolerance) in kept {
                page.judged.verdict[i] = Verdict::Outlier;
                page.judged.expected[i] = expected;
                page.judged.tolerance[i] = tolerance;
            }
        }
    }
    for ((page, y), filled) in pages.iter_mut().zip(&channels).zip(&filled) {
        page.judged.own = own(y, &page.judged, filled, plan.patch, way);
    }
    Ok(pages)
}

/// Expected values and tolerances of the filled samples, which stay those of the first run.
fn first_run(page: &Page, filled: &[f64]) -> Vec<(usize, f64, f64)> {
    let judged = &page.judged;
    let of = |(i, _): (usize, &f64)| (i, judged.expected[i], judged.tolerance[i]);
    filled.iter().enumerate().filter(|(_, v)| !v.is_nan()).map(of).collect()
}

/// Calls `visit` with each run of outliers among the samples that a channel has.
fn for_runs(y: &[f64], verdict: &[Verdict], mut visit: impl FnMut(&[usize])) {
    let mut run: Vec<usize> = Vec::new();
    for (i, _) in y.iter().enumerate().filter(|(_, y)| !y.is_nan()) {
        if verdict[i] == Verdict::Outlier {
            run.push(i);
        } else if !run.is_empty() {
            visit(&run);
            run.clear();
        }
    }
    if !run.is_empty() {
        visit(&run);
    }
}

/// What patches are filled with, NaN elsewhere; empty when nothing is filled.
fn filled(t: &[f64], y: &[f64], verdict: &[Verdict], plan: &Plan) -> Vec<f64> {
    let mut values = Vec::new();
    let accepted = |i: usize| !y[i].is_nan() && verdict[i] != Verdict::Outlier;
    for_runs(y, verdict, |run| {
        if run.len() < plan.patch {
            return;
        }
        for (&i, value) in run.iter().zip(plan.fill.values(t, y, accepted, run)) {
            if !value.is_nan() {
                values.resize(y.len(), f64::NAN);
                values[i] = value;
            }
        }
    });
    values
}

/// The own repair of every outlier; NaN where it is removed, and for all other samples.
fn own(y: &[f64], judged: &Judged, filled: &[f64], patch: usize, way: Way) -> Vec<f64> {
    let mut own = vec![f64::NAN; y.len()];
    let end = match way {
        Way::Forward => y.iter().rposition(|y| !y.is_nan()),
        Way::Backward => y.iter().position(|y| !y.is_nan()),
    };
    let fill = |i: usize| filled.get(i).copied().filter(|v| !v.is_nan());
    for_runs(y, &judged.verdict, |run| {
        let ends = run.iter().any(|&i| Some(i) == end);
        let unfilled = run.len() >= patch && run.iter().all(|&i| fill(i).is_none());
        if !ends && !unfilled {
            run.iter().for_each(|&i| own[i] = fill(i).unwrap_or(judged.expected[i]));
        }
    });
    own
}
