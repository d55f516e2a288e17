//! The queue: which flags are in it, in which order, and which of them the panel shows.

use std::ops::Range;
use std::sync::Arc;

use super::super::layout;
use super::super::model::{Group, Model, Sort, Unit};
use crate::method::Verdict;
use crate::plot::{Drawn, FlagState, state};
use crate::session::Mark;
use crate::track::Series;

/// Brings the queue of a channel into order.
pub(super) fn arrange(model: &mut Model, plan: usize) {
    let channel = model.channels[plan].channel;
    let samples = Arc::clone(&model.channels[plan].samples);
    let series = samples.series(&model.track.channels[channel], &model.track.time);
    let Some(drawn) = model.channels[plan].drawn.clone() else { return };
    let groups = groups(&drawn.outcome.marks, &drawn.outcome.detection.segments);
    let single = |m: &Mark| Group { start: m.position, length: 1 };
    let mut items: Vec<Group> = match model.review.unit {
        Unit::Sample => drawn.outcome.marks.iter().map(single).collect(),
        Unit::Run => groups.clone(),
    };
    match model.review.sort {
        Sort::Time => {}
        Sort::Ratio => items.sort_by(|a, b| worst(&drawn, &series, *b).total_cmp(&worst(&drawn, &series, *a))),
        Sort::State => items.sort_by_key(|item| urgency(&drawn, *item)),
        Sort::Run => items.sort_by_key(|item| {
            let after = groups.partition_point(|g| g.start <= item.start);
            std::cmp::Reverse(after.checked_sub(1).and_then(|at| groups.get(at)).map_or(0, |g| g.length))
        }),
    }
    let state = &mut model.channels[plan];
    state.queue = items.into_iter().map(|item| item.start).collect();
    state.groups = groups;
    state.gone.clear();
}

/// Adjacent marks within a segment; suspects are a class of their own.
fn groups(marks: &[Mark], segments: &[Range<usize>]) -> Vec<Group> {
    let mut groups: Vec<Group> = Vec::new();
    let mut class = None;
    for mark in marks {
        let own = state(mark) == Some(FlagState::Suspect);
        let cut = segments.binary_search_by_key(&(mark.position as usize), |s| s.start).is_ok();
        match groups.last_mut() {
            Some(g) if g.start + g.length == mark.position && class == Some(own) && !cut => g.length += 1,
            _ => groups.push(Group { start: mark.position, length: 1 }),
        }
        class = Some(own);
    }
    groups
}

/// The largest residual of some flags, whatever its sign.
fn worst(drawn: &Drawn, series: &Series<'_>, item: Group) -> f64 {
    item.positions().filter_map(|i| drawn.residual(series, i)).fold(0.0, |worst, r| worst.max(r.abs()))
}

/// What needs the analyst most comes first.
fn urgency(drawn: &Drawn, item: Group) -> u8 {
    let rank = |mark: &Mark| match mark.ruling {
        _ if mark.conflict() => 0,
        None if mark.verdict == Verdict::Outlier => 1,
        None => 2,
        Some(_) => 3,
    };
    item.positions().filter_map(|i| drawn.outcome.mark(i)).map(rank).min().unwrap_or(3)
}

/// The flags that a panel of `rows` rows shows, row by row: of runs the first sample. Rows stay where they are as long
/// as the current flag is among them, and among them are those that a parameter has just taken away.
#[must_use]
pub(in crate::tui) fn listed(model: &Model, rows: usize) -> Vec<u32> {
    let state = model.state();
    let (shown, current) = window(model, rows);
    let flags = || state.queue[shown.clone()].to_vec();
    if state.gone.is_empty() {
        return flags();
    }
    let near = nearby(&state.queue, &state.gone, state.top..state.top, rows);
    let from = near.partition_point(|p| *p < state.top).min(near.len().saturating_sub(rows));
    let list = near[from..near.len().min(from + rows)].to_vec();
    let in_sight = |position: u32| list.binary_search(&position).is_ok();
    let cursor = u32::try_from(state.cursor).unwrap_or(u32::MAX);
    if in_sight(cursor) || state.queue.get(current).is_some_and(|p| in_sight(*p)) { list } else { flags() }
}

/// True when there are flags above those of the panel.
#[must_use]
pub(in crate::tui) fn goes_on_above(model: &Model, listed: &[u32]) -> bool {
    let (all, shown) = (model.state().queue.first(), listed.first());
    if model.review.sort == Sort::Time { all < shown } else { all != shown }
}

/// The part of the queue that a panel of `rows` rows has room for, and the place of the current flag in the queue (of
/// the next one, where the cursor is on none).
fn window(model: &Model, rows: usize) -> (Range<usize>, usize) {
    let queue = &model.state().queue;
    let cursor = model.state().cursor;
    let n = queue.len();
    let at_or_after = |position: usize| queue.partition_point(|&p| (p as usize) < position).min(n.saturating_sub(1));
    let by_time = model.review.sort == Sort::Time;
    let find = |position: usize| queue.iter().position(|&p| p as usize == position);
    let head = match model.review.unit {
        Unit::Run => model.group(cursor).map_or(cursor, |g| g.start as usize),
        Unit::Sample => cursor,
    };
    let top = model.state().top as usize;
    let current = if by_time { at_or_after(head) } else { find(head).unwrap_or(0) };
    let from = if by_time { Some(at_or_after(top)) } else { find(top) };
    let last = n.saturating_sub(rows);
    let from = match from.map(|from| from.min(last)) {
        Some(from) if (from..from + rows).contains(&current) => from,
        _ => current.saturating_sub(rows / 2).min(last),
    };
    (from..n.min(from + rows), current)
}

/// Remembers which flag stands in the first row of the panel. What is gone leaves it when the cursor moves on, but for a
/// click on one of them.
pub(super) fn keep_in_sight(model: &mut Model) {
    let Some(rows) = panel_rows(model) else { return };
    let state = model.state_mut();
    let on_one = u32::try_from(state.cursor).is_ok_and(|cursor| state.gone.contains(&cursor));
    if state.gone_at != state.cursor && !on_one {
        state.gone.clear();
    }
    if let Some(&top) = listed(model, rows).first() {
        model.state_mut().top = top;
    }
}

/// The flags that the panel shows; none where it is not on the screen.
pub(super) fn in_sight(model: &Model) -> Vec<u32> {
    panel_rows(model).map(|rows| listed(model, rows)).unwrap_or_default()
}

/// After a method has judged anew: has the panel begin where most of the flags that `before` were in sight stay in
/// their rows. Those it no longer flags keep theirs until the cursor moves, unless they are many: one sees what a step
/// of a parameter has taken away, and the rest need not be looked for.
pub(super) fn stay(model: &mut Model, before: &[u32]) {
    // Only by time do the others keep their order; runs grow and shrink.
    let by_time = model.review.sort == Sort::Time && model.review.unit == Unit::Sample;
    let (Some(rows), Some(first), Some(last)) = (panel_rows(model), before.first(), before.last()) else { return };
    if !by_time {
        return;
    }
    let current = window(model, rows).1;
    let state = model.state_mut();
    let gone = before.iter().copied().filter(|p| state.queue.binary_search(p).is_err()).collect::<Vec<_>>();
    state.gone = if gone.len() > rows / 2 || state.queue.is_empty() { Vec::new() } else { gone };
    state.gone_at = state.cursor;
    let near = nearby(&state.queue, &state.gone, *first..*last, rows);
    let current = match near.binary_search(&u32::try_from(state.cursor).unwrap_or(u32::MAX)) {
        Ok(at) => Some(at),
        Err(_) => state.queue.get(current).and_then(|p| near.binary_search(p).ok()),
    };
    if let Some(start) = current.and_then(|current| steadiest(before, &near, rows, state.top, current)) {
        state.top = near[start];
    }
}

fn panel_rows(model: &Model) -> Option<usize> {
    layout::arrange(model, model.screen()).and_then(|areas| areas.queue).map(layout::queue_rows)
}

/// The flags from `rows` before some positions to `rows` after them, with those that are gone, by time.
fn nearby(queue: &[u32], gone: &[u32], positions: Range<u32>, rows: usize) -> Vec<u32> {
    let from = queue.partition_point(|p| *p < positions.start).saturating_sub(rows);
    let to = queue.partition_point(|p| *p < positions.end).saturating_add(rows).min(queue.len());
    let mut near = [&queue[from..to], gone].concat();
    near.sort_unstable();
    near
}

/// The start of the window of `rows` flags that has most flags of `before` in their rows and the one at `current` in
/// any; among equals the one that keeps `top` in the first row.
fn steadiest(before: &[u32], flags: &[u32], rows: usize, top: u32, current: usize) -> Option<usize> {
    let starts: Vec<usize> = before
        .iter()
        .enumerate()
        .filter_map(|(row, position)| flags.binary_search(position).ok()?.checked_sub(row))
        .filter(|start| *start <= flags.len().saturating_sub(rows) && (*start..*start + rows).contains(&current))
        .collect();
    let same = |start: usize| starts.iter().filter(|s| **s == start).count();
    starts.iter().copied().max_by_key(|start| (same(*start), flags[*start] == top))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn runs_end_at_holes_cuts_and_suspects() {
        let mark = |position, verdict| Mark { position, verdict, ruling: None, said: None };
        let wild = |position| mark(position, Verdict::Outlier);
        let marks = [wild(2), wild(3), mark(4, Verdict::Suspect), wild(6), wild(7), wild(8), wild(9)];
        let found = groups(&marks, &[0..8, 8..20]);
        let lengths: Vec<(u32, u32)> = found.iter().map(|g| (g.start, g.length)).collect();
        assert_eq!(lengths, [(2, 2), (4, 1), (6, 2), (8, 2)]);
    }

    #[test]
    fn most_rows_stay_where_they_are_when_flags_come_and_go() {
        let queue = |gone: &[u32], new: &[u32]| {
            let kept = (0..40).map(|i| i * 10).filter(|i| !gone.contains(i));
            let mut queue: Vec<u32> = kept.chain(new.to_vec()).collect();
            queue.sort_unstable();
            queue
        };
        let before = &queue(&[], &[])[10..20];
        let start = |queue: &[u32], current| steadiest(before, queue, 10, 100, current);
        // One comes in the second row: nine stay if it pushes the first one out. One comes in the last row but one.
        assert_eq!(start(&queue(&[], &[105]), 15), Some(11));
        assert_eq!(start(&queue(&[], &[175]), 15), Some(10));
        // Those out of sight move nothing.
        assert_eq!(start(&queue(&[], &[5, 15]), 15), Some(12));
        // The current one stays in sight.
        assert_eq!(start(&queue(&[], &[105]), 10), Some(10));
        // One goes.
        assert_eq!(start(&queue(&[120], &[]), 15), Some(9));
        assert_eq!(start(&queue(&[180], &[]), 15), Some(10));
        // There is nothing to begin with, or nothing left.
        assert_eq!(steadiest(&[], &queue(&[], &[]), 10, 0, 3), None);
        assert_eq!(steadiest(before, &[], 10, 0, 0), None);
    }
}
