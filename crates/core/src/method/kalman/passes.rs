//! Two passes of the filter with the fill of patches between them, in both directions (step 4 of section 7).

use std::ops::Range;

use super::fill::Fill;
use crate::math::pieces::{self, PIECE};
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
    /// Runs of this many samples and more are filled.
    pub(super) patch: usize,
    /// By what.
    pub(super) fill: Fill,
    /// Whether the beginning is judged by a run backwards.
    pub(super) look_back: bool,
}

/// Judges every channel of a record; with entries for all times, also where a channel has no sample.
pub(super) fn judge(record: &impl Record, plan: &Plan, stop: &Stop) -> Result<Vec<Judged>, Stopped> {
    let channels = record.channels();
    let forward = || -> Result<Vec<Page>, Stopped> {
        let (mut pages, filled) = one_way(record, plan, Way::Forward, stop)?;
        for ((page, y), filled) in pages.iter_mut().zip(&channels).zip(&filled) {
            page.judged.own = own(y, &page.judged, filled, plan.patch, Way::Forward, stop)?;
        }
        Ok(pages)
    };
    if !plan.look_back {
        return Ok(forward()?.into_iter().map(|page| page.judged).collect());
    }
    let (forward, backward) = rayon::join(forward, || one_way(record, plan, Way::Backward, stop));
    let (forward, (backward, filled)) = (forward?, backward?);
    let pages = forward.into_iter().zip(backward).zip(channels.iter().zip(&filled));
    pages.map(|((forward, backward), (y, filled))| looked_back(forward, backward, y, filled, plan, stop)).collect()
}

/// The first start group and all before it as the backward run has them.
fn looked_back(
    forward: Page,
    backward: Page,
    y: &[f64],
    filled: &[f64],
    plan: &Plan,
    stop: &Stop,
) -> Result<Judged, Stopped> {
    let end = forward.first.map_or(0, |group| group.end);
    let (mut judged, back) = (forward.judged, backward.judged);
    // The own repair of a run depends on all of it.
    let inside = |i: &usize| y[*i].is_nan() || back.verdict[*i] == Verdict::Outlier;
    let whole = end + (end..y.len()).take_while(inside).count();
    let own = own(&y[..whole], &back, filled, plan.patch, Way::Backward, stop)?;
    judged.verdict[..end].copy_from_slice(&back.verdict[..end]);
    judged.expected[..end].copy_from_slice(&back.expected[..end]);
    judged.tolerance[..end].copy_from_slice(&back.tolerance[..end]);
    judged.own[..end].copy_from_slice(&own[..end]);
    judged.restarts.extend(back.restarts.iter().filter(|r| r.at < end));
    Ok(judged)
}

/// One direction: filter, fill, filter again. With the pages, what patches were filled with.
fn one_way(record: &impl Record, plan: &Plan, way: Way, stop: &Stop) -> Result<(Vec<Page>, Vec<Vec<f64>>), Stopped> {
    let n = record.times().len();
    let channels = record.channels();
    let mut pages: Vec<Page> = channels.iter().map(|_| Page::new(n, way, n, stop)).collect::<Result<_, _>>()?;
    record.run(&[], way, &mut pages, stop)?;
    let fill = |(page, y): (&Page, &&[f64])| filled(record.times(), y, &page.judged.verdict, plan, stop);
    let filled: Vec<Vec<f64>> = pages.iter().zip(&channels).map(fill).collect::<Result<_, _>>()?;
    if filled.iter().any(|values| !values.is_empty()) {
        let kept = pages.iter().zip(&filled).map(|(page, filled)| first_run(page, filled, stop));
        let kept: Vec<Vec<(usize, f64, f64)>> = kept.collect::<Result<_, _>>()?;
        pages.iter_mut().try_for_each(|page| page.clear(stop))?;
        record.run(&filled, way, &mut pages, stop)?;
        for (page, kept) in pages.iter_mut().zip(kept) {
            for (i, expected, tolerance) in kept {
                page.judged.verdict[i] = Verdict::Outlier;
                page.judged.expected[i] = expected;
                page.judged.tolerance[i] = tolerance;
            }
        }
    }
    Ok((pages, filled))
}

/// Expected values and tolerances of the filled samples, which stay those of the first run.
fn first_run(page: &Page, filled: &[f64], stop: &Stop) -> Result<Vec<(usize, f64, f64)>, Stopped> {
    let judged = &page.judged;
    let of = |piece: Range<usize>| {
        let there = piece.filter(|&i| !filled[i].is_nan());
        there.map(|i| (i, judged.expected[i], judged.tolerance[i])).collect::<Vec<_>>()
    };
    Ok(pieces::map(filled.len(), &|| stop.check(), of)?.concat())
}

/// Calls `visit` with each run of outliers among the samples that a channel has.
fn for_runs(
    y: &[f64],
    verdict: &[Verdict],
    stop: &Stop,
    mut visit: impl FnMut(&[usize]) -> Result<(), Stopped>,
) -> Result<(), Stopped> {
    let mut run: Vec<usize> = Vec::new();
    let mut at = 0;
    while at < y.len() {
        stop.check()?;
        // From outlier to outlier: nearly all samples are none.
        let end = y.len().min(at + PIECE);
        let Some(skipped) = verdict[at..end].iter().position(|v| *v == Verdict::Outlier) else {
            at = end;
            continue;
        };
        at += skipped;
        while at < y.len() && (verdict[at] == Verdict::Outlier || y[at].is_nan()) {
            if !y[at].is_nan() {
                run.push(at);
            }
            at += 1;
        }
        if !run.is_empty() {
            visit(&run)?;
            run.clear();
        }
    }
    Ok(())
}

/// What patches are filled with, NaN elsewhere; empty when nothing is filled.
fn filled(t: &[f64], y: &[f64], verdict: &[Verdict], plan: &Plan, stop: &Stop) -> Result<Vec<f64>, Stopped> {
    let mut values = Vec::new();
    let accepted = |i: usize| !y[i].is_nan() && verdict[i] != Verdict::Outlier;
    for_runs(y, verdict, stop, |run| {
        if run.len() < plan.patch {
            return Ok(());
        }
        for (&i, value) in run.iter().zip(plan.fill.values(t, y, accepted, run)) {
            if !value.is_nan() {
                if values.is_empty() {
                    values = pieces::collect(y.len(), &|| stop.check(), |_| f64::NAN)?;
                }
                values[i] = value;
            }
        }
        Ok(())
    })?;
    Ok(values)
}

/// The own repair of every outlier of `y`; NaN where it is removed, and for all other samples.
fn own(y: &[f64], judged: &Judged, filled: &[f64], patch: usize, way: Way, stop: &Stop) -> Result<Vec<f64>, Stopped> {
    let mut own = pieces::collect(y.len(), &|| stop.check(), |_| f64::NAN)?;
    let end = match way {
        Way::Forward => y.iter().rposition(|y| !y.is_nan()),
        Way::Backward => y.iter().position(|y| !y.is_nan()),
    };
    let fill = |i: usize| filled.get(i).copied().filter(|v| !v.is_nan());
    for_runs(y, &judged.verdict, stop, |run| {
        let ends = run.iter().any(|&i| Some(i) == end);
        let unfilled = run.len() >= patch && run.iter().all(|&i| fill(i).is_none());
        if !ends && !unfilled {
            run.iter().for_each(|&i| own[i] = fill(i).unwrap_or(judged.expected[i]));
        }
        Ok(())
    })?;
    Ok(own)
}
