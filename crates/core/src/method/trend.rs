//! What the criteria of section 2 of `docs/methods.md` share: blocks, a least-squares trend, and passes over the
//! samples that survive \[001 s.2, 002\].

use std::borrow::Cow;
use std::ops::Range;
use std::sync::OnceLock;

use rayon::prelude::*;

use super::{Judged, Segment, Verdict, shared};
use crate::math::pieces::{self, Check, PIECE};
use crate::math::polyfit::Polynomial;
use crate::param::Settings;
use crate::stop::{Stop, Stopped};

mod at_once;
mod filtered;
mod one_at_a_time;
mod warning;

pub(super) use at_once::{AtOnce, normal_at};
pub(super) use filtered::filter;
pub(super) use one_at_a_time::{Chance, Critical, OneAtATime, Removals};
pub(super) use warning::of_settings as warnings;

/// How a criterion judges the residuals of the survivors, once.
pub(super) trait Criterion: Sync {
    /// How many groups are judged by themselves: position `i` of a block belongs to group `i` modulo this.
    fn groups(&self) -> usize {
        1
    }

    /// How many scales a residual must deviate to be flagged, among `n >= 3` of a group.
    fn needed(&self, n: usize) -> f64;

    /// What one pass says of the survivors.
    fn pass(&self, survivors: &Survivors<'_>, stop: &Stop) -> Result<Pass, Stopped>;
}

/// The samples of a block that no pass has flagged.
#[derive(Debug)]
pub(super) struct Survivors<'a> {
    /// Their residuals from the trend.
    pub(super) residual: &'a [f64],
    /// Their positions in the block, ascending.
    pub(super) position: &'a [usize],
    pub(super) segment: &'a Segment<'a>,
    pub(super) zero: f64,
}

impl Survivors<'_> {
    /// A standard deviation with the bounds of the segment.
    pub(super) fn bounded(&self, deviation: f64) -> f64 {
        self.segment.bounded(deviation, self.zero)
    }
}

/// What one pass says.
#[derive(Debug, Clone, Default)]
pub(super) struct Pass {
    /// What it flags: indices into the survivors, in any order.
    pub(super) flagged: Vec<usize>,
    /// What each group was judged by; none for a group with too few survivors.
    pub(super) groups: Vec<Option<Limit>>,
}

/// What a group of residuals was judged by.
#[derive(Debug, Clone, Copy)]
pub(super) struct Limit {
    /// Mean residual.
    pub(super) mean: f64,
    /// Standard deviation, bounded.
    pub(super) scale: f64,
    /// A residual that deviates from the mean by this is flagged; 0 where nothing can be.
    pub(super) tolerance: f64,
}

/// The settings that the criteria share.
#[derive(Debug, Clone)]
struct Rule {
    order: usize,
    refit: bool,
    max_passes: usize,
    block: usize,
    /// Noise of the whole segment, once a short block asks for it.
    noise: OnceLock<f64>,
}

/// Judges a segment block by block.
pub(super) fn judge(
    criterion: &impl Criterion,
    segment: &Segment<'_>,
    settings: &Settings,
    stop: &Stop,
) -> Result<Judged, Stopped> {
    let order = settings.whole(shared::TREND_ORDER.key);
    let max_passes = settings.whole(shared::MAX_PASSES.key);
    let refit = order > 0 && settings.switch(shared::REFIT.key);
    let rule = Rule { order, refit, max_passes, block: settings.whole(shared::BLOCK.key), noise: OnceLock::new() };
    let zero = segment.zero(stop)?;
    let parts: Vec<Judged> = blocks(segment.len(), rule.block)
        .into_par_iter()
        .map(|block| {
            stop.check()?;
            judge_block(criterion, segment, block, zero, &rule, stop)
        })
        .collect::<Result<_, _>>()?;
    let mut parts = parts.into_iter();
    let mut whole = parts.next().unwrap_or_default();
    parts.try_for_each(|part| whole.append(part, stop))?;
    Ok(whole)
}

/// The blocks of `size` samples of a segment (0: all of it); one shorter than half of that joins the one before.
pub(super) fn blocks(len: usize, size: usize) -> Vec<Range<usize>> {
    if size == 0 || len <= size {
        return std::iter::once(0..len).collect();
    }
    let mut blocks: Vec<Range<usize>> = (0..len).step_by(size).map(|at| at..(at + size).min(len)).collect();
    if blocks.last().is_some_and(|last| 2 * last.len() < size) {
        blocks.pop();
        if let Some(last) = blocks.last_mut() {
            last.end = len;
        }
    }
    blocks
}

fn judge_block(
    criterion: &impl Criterion,
    segment: &Segment<'_>,
    block: Range<usize>,
    zero: f64,
    rule: &Rule,
    stop: &Stop,
) -> Result<Judged, Stopped> {
    let (t, y) = (&segment.t[block.clone()], &segment.y[block.clone()]);
    let (n, fewest) = (y.len(), rule.order + 3);
    if n < fewest {
        return Ok(Judged::unchecked(n));
    }
    let check = || stop.check();
    let mut position: Vec<usize> = pieces::collect(n, &check, |i| i)?;
    let (mut ts, mut ys) = (Cow::Borrowed(t), Cow::Borrowed(y));
    let mut fit = Polynomial::fit_long(t, y, rule.order, &check)?;
    let mut residual = vec![0.0; n];
    fit.residuals_long(&ts, &ys, &mut residual, &check)?;
    let mut flagged = vec![false; n];
    let mut limits = vec![None; criterion.groups()];
    let mut passes = 0;
    loop {
        let survivors = Survivors { residual: &residual, position: &position, segment, zero };
        let pass = criterion.pass(&survivors, stop)?;
        limits.iter_mut().zip(pass.groups).for_each(|(limit, new)| *limit = new.or(*limit));
        passes += 1;
        pass.flagged.iter().for_each(|&i| flagged[position[i]] = true);
        let found = pass.flagged.len();
        if found == 0 || passes == rule.max_passes || position.len() - found < fewest {
            break;
        }
        let out = |piece: Range<usize>| piece.filter(|&i| flagged[position[i]]).collect::<Vec<usize>>();
        let out = pieces::map(position.len(), &check, out)?.concat();
        let (positions, (times, values)) = rayon::join(
            || remove(&mut position, &out, &check),
            || rayon::join(|| remove_from_slice(&mut ts, &out, &check), || remove_from_slice(&mut ys, &out, &check)),
        );
        positions.and(times).and(values)?;
        residual.truncate(position.len());
        if rule.refit {
            fit = Polynomial::fit_long(&ts, &ys, rule.order, &check)?;
        }
        fit.residuals_long(&ts, &ys, &mut residual, &check)?;
    }
    let mut judged = verdicts(&fit, t, &flagged, &limits, stop)?;
    // Full blocks are warned of by their settings.
    if rule.block == 0 || n < rule.block {
        judged.warnings.extend(warning::of_reach(criterion, t, &fit));
    }
    judged.warnings.extend(warning::of_trend(segment, &block, &limits, &rule.noise, stop)?);
    Ok(judged)
}

/// The stretches of `0 .. n` without the entries at `out` (ascending), none longer than a piece.
fn stretches(n: usize, out: &[usize]) -> impl Iterator<Item = Range<usize>> + '_ {
    let begins = std::iter::once(0).chain(out.iter().map(|at| at + 1));
    let whole = begins.zip(out.iter().copied().chain(std::iter::once(n)));
    whole.flat_map(|(begin, end)| (begin..end).step_by(PIECE).map(move |at| at..end.min(at + PIECE)))
}

/// Takes the entries at `out` (ascending) out of a list.
fn remove<T: Copy, E>(list: &mut Vec<T>, out: &[usize], check: &impl Check<E>) -> Result<(), E> {
    let (mut end, mut moved) = (0, 0);
    for stretch in stretches(list.len(), out) {
        if moved >= PIECE {
            check()?;
            moved = 0;
        }
        moved += stretch.len();
        let begin = end;
        end += stretch.len();
        if begin < stretch.start {
            list.copy_within(stretch, begin);
        }
    }
    list.truncate(end);
    Ok(())
}

/// [`remove`] from values that are perhaps not copied yet.
fn remove_from_slice<E>(list: &mut Cow<'_, [f64]>, out: &[usize], check: &impl Check<E>) -> Result<(), E> {
    match list {
        Cow::Owned(list) => remove(list, out, check),
        Cow::Borrowed(values) => {
            let mut kept = Vec::with_capacity(values.len() - out.len());
            let mut next_look = 0;
            for stretch in stretches(values.len(), out) {
                if kept.len() >= next_look {
                    check()?;
                    next_look = kept.len() + PIECE;
                }
                kept.extend_from_slice(&values[stretch]);
            }
            *list = Cow::Owned(kept);
            Ok(())
        }
    }
}

/// Expected value: the trend plus the mean of the last pass. Tolerance: the last limit applied.
fn verdicts(
    fit: &Polynomial,
    t: &[f64],
    flagged: &[bool],
    limits: &[Option<Limit>],
    stop: &Stop,
) -> Result<Judged, Stopped> {
    let of = |i: usize| limits[i % limits.len()];
    let check = || stop.check();
    let mut expected = vec![0.0; t.len()];
    fit.values_long(t, &mut expected, &check)?;
    pieces::over(&mut expected, &check, |first, expected| {
        for (i, expected) in (first..).zip(expected) {
            *expected = of(i).map_or(f64::NAN, |limit| *expected + limit.mean);
        }
    })?;
    let tolerance = pieces::collect(t.len(), &check, |i| of(i).map_or(f64::NAN, |limit| limit.tolerance))?;
    let mut verdict = vec![Verdict::Normal; t.len()];
    pieces::over(&mut verdict, &check, |first, verdict| {
        for (i, verdict) in (first..).zip(verdict) {
            *verdict = match of(i) {
                _ if flagged[i] => Verdict::Outlier,
                Some(_) => Verdict::Normal,
                None => Verdict::Unchecked,
            };
        }
    })?;
    Ok(Judged { verdict, expected, tolerance, ..Judged::default() })
}

#[cfg(test)]
mod tests;
