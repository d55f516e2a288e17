//! Where each panel lies: plain arithmetic on the area that is drawn into.

use ratatui::layout::Rect;

use super::action::Panel;
use super::model::{LowerKind, Model};
use super::plot::GUTTER;

/// The least size with something to see.
pub const LEAST: (u16, u16) = (40, 10);

/// From this width on, parameters and queue have a column of their own.
const WIDE: u16 = 110;
/// From this width on, a second channel has a trace of its own.
pub(super) const SECOND: u16 = 160;
/// The width of that column, and of the drawer that takes its place on narrower screens.
const SIDE: u16 = 38;

/// Where each panel lies; none for one that has no room.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Areas {
    /// The first line.
    pub title: Rect,
    /// The whole record with its rail.
    pub overview: Option<Rect>,
    /// The trace with its heading, rail and time axis.
    pub trace: Option<Rect>,
    /// The trace of a second channel with its heading and rail.
    pub second: Option<Rect>,
    /// The residual with its heading.
    pub residual: Option<Rect>,
    /// The methods that flag the sample under the cursor, below the picture of all methods, where the card has no room
    /// to name them.
    pub voters: Option<Rect>,
    /// Method and parameters with their heading.
    pub parameters: Option<Rect>,
    /// The queue with its heading.
    pub queue: Option<Rect>,
    /// The card with its heading.
    pub card: Option<Rect>,
    /// The parameters in one line, where they have no panel.
    pub knobs: Option<Rect>,
    /// The line on which the program speaks.
    pub toast: Rect,
    /// The line of keys.
    pub footer: Rect,
}

/// The panels for the model within `whole`; none when it is too small. A frame passes the area it is drawn into: the
/// terminal may have another size by then than the one of the last message about it.
#[must_use]
pub fn arrange(model: &Model, whole: Rect) -> Option<Areas> {
    let Rect { width, height, .. } = whole;
    if width < LEAST.0 || height < LEAST.1 {
        return None;
    }
    let voters = model.lower.kind == LowerKind::Consensus;
    if model.maximised {
        return Some(maximised(whole, model.focus, voters));
    }
    Some(if width >= WIDE && height >= 24 {
        wide(whole, width >= SECOND && model.second_plan().is_some())
    } else {
        compact(whole, model.focus, voters)
    })
}

/// Takes `height` rows off the top of what is left.
fn top(rest: &mut Rect, height: u16) -> Rect {
    let height = height.min(rest.height);
    let taken = Rect { height, ..*rest };
    rest.y += height;
    rest.height -= height;
    taken
}

/// Takes `height` rows off the bottom of what is left.
fn bottom(rest: &mut Rect, height: u16) -> Rect {
    let height = height.min(rest.height);
    rest.height -= height;
    Rect { y: rest.y + rest.height, height, ..*rest }
}

fn wide(whole: Rect, second: bool) -> Areas {
    let mut rest = whole;
    let title = top(&mut rest, 1);
    let footer = bottom(&mut rest, 1);
    let toast = bottom(&mut rest, 1);
    let side = Rect { x: rest.x + rest.width - SIDE, width: SIDE, ..rest };
    rest.width -= SIDE;
    let mut column = side;
    // One row of air between the plots and the side.
    column.x += 1;
    column.width -= 1;
    let parameters = top(&mut column, (side.height * 3 / 5).clamp(12, 24));
    let overview = top(&mut rest, if whole.height >= 36 { 5 } else { 4 });
    let card = bottom(&mut rest, 6);
    let third = rest.height / 3;
    let residual = bottom(&mut rest, third.clamp(5, 12));
    // Where the trace would keep too little of its height, it has it all.
    let half = rest.height * 2 / 5;
    let second = (second && half >= 5).then(|| bottom(&mut rest, half));
    Areas {
        second,
        title,
        overview: Some(overview),
        trace: Some(rest),
        residual: Some(residual),
        voters: None,
        parameters: Some(parameters),
        queue: Some(column),
        card: Some(card),
        knobs: None,
        toast,
        footer,
    }
}

/// Rows for the names of the methods that flag a sample: as many whatever their number, so that the picture keeps its
/// place while the cursor moves. The shorter list of two is shown, half of all methods at most.
fn rows_of_voters(width: u16) -> u16 {
    if width >= 72 { 2 } else { 3 }
}

fn compact(whole: Rect, focus: Panel, voters: bool) -> Areas {
    let mut rest = whole;
    let title = top(&mut rest, 1);
    let footer = bottom(&mut rest, 1);
    let toast = bottom(&mut rest, 1);
    let small = whole.width < 60 || whole.height < 16;
    let overview = (whole.height >= 20 && !small).then(|| top(&mut rest, 2));
    let knobs = (!small).then(|| bottom(&mut rest, 1));
    let card = bottom(&mut rest, if small { 2 } else { 3 });
    let quarter = rest.height / 4;
    let lower = whole.height >= 24 && !small;
    let voters = (lower && voters).then(|| bottom(&mut rest, rows_of_voters(whole.width)));
    // A row less for the picture above the names: three still tell all counts of votes apart.
    let height = quarter.clamp(5, 9) - u16::from(voters.is_some());
    let residual = lower.then(|| bottom(&mut rest, height));
    // The drawer lies over the plots while one of its panels has the keyboard.
    let drawer = Rect {
        x: whole.right() - SIDE.min(whole.width),
        y: whole.y + 1,
        width: SIDE.min(whole.width),
        height: whole.height.saturating_sub(3),
    };
    let parameters = (focus == Panel::Parameters).then_some(drawer);
    let queue = (focus == Panel::Queue).then_some(drawer);
    let second = None;
    Areas {
        title,
        overview,
        trace: Some(rest),
        second,
        residual,
        voters,
        parameters,
        queue,
        card: Some(card),
        knobs,
        toast,
        footer,
    }
}

fn maximised(whole: Rect, focus: Panel, voters: bool) -> Areas {
    let mut rest = whole;
    let title = top(&mut rest, 1);
    let footer = bottom(&mut rest, 1);
    let toast = bottom(&mut rest, 1);
    let voters = (voters && focus == Panel::Residual).then(|| bottom(&mut rest, rows_of_voters(whole.width)));
    let mut areas = Areas { title, voters, toast, footer, ..Areas::default() };
    let slot = match focus {
        Panel::Trace => &mut areas.trace,
        Panel::Residual => &mut areas.residual,
        Panel::Parameters => &mut areas.parameters,
        Panel::Queue => &mut areas.queue,
        Panel::Card => &mut areas.card,
    };
    *slot = Some(rest);
    areas
}

/// Rows of flags in the panel of the queue: below the heading, and the names of the columns where there is room.
#[must_use]
pub fn queue_rows(area: Rect) -> usize {
    let body = area.height.saturating_sub(1);
    usize::from(if body >= 6 { body - 1 } else { body })
}

/// The parts of the trace's area.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct TraceParts {
    /// The heading.
    pub head: Rect,
    /// Labels and curve.
    pub body: Rect,
    /// The rail.
    pub rail: Rect,
    /// The samples on which the pinned result differs, where there is one and room for it.
    pub sides: Option<Rect>,
    /// Labels of the time axis, where there is room for them.
    pub axis: Option<Rect>,
}

/// Divides the area of the trace; `pinned` when there is a pinned result to compare with.
#[must_use]
pub fn trace_parts(area: Rect, pinned: bool) -> TraceParts {
    let mut body = area;
    let head = top(&mut body, 1);
    let axis = (body.height >= 5).then(|| bottom(&mut body, 1));
    let sides = (pinned && body.height >= 6).then(|| bottom(&mut body, 1));
    let rail = bottom(&mut body, 1);
    TraceParts { head, body, rail, sides, axis }
}

/// The parts of the area of the second channel.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct SecondParts {
    /// The heading.
    pub head: Rect,
    /// Labels and curve.
    pub body: Rect,
    /// The rail.
    pub rail: Rect,
}

/// Divides the area of the second channel.
#[must_use]
pub fn second_parts(area: Rect) -> SecondParts {
    let mut body = area;
    let head = top(&mut body, 1);
    let rail = bottom(&mut body, 1);
    SecondParts { head, body, rail }
}

/// The inside of a panel that is a drawer over the plots, beside its edge.
#[must_use]
pub fn drawer(area: Rect) -> Rect {
    Rect { x: area.x + area.width.min(2), width: area.width.saturating_sub(2), ..area }
}

/// Columns of cells on which the trace draws samples.
#[must_use]
pub fn plot_columns(model: &Model) -> u16 {
    let areas = arrange(model, model.screen());
    let area = areas.and_then(|a| a.trace.or(a.residual)).unwrap_or_default();
    area.width.saturating_sub(GUTTER)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn panels_lie_on_the_screen_and_side_by_side_at_every_size() {
        for width in LEAST.0..200 {
            for (height, voters) in (LEAST.1..70).flat_map(|height| [(height, false), (height, true)]) {
                let whole = Rect { x: 0, y: 0, width, height };
                let areas = if width >= WIDE && height >= 24 {
                    wide(whole, width % 2 == 0)
                } else {
                    compact(whole, Panel::Trace, voters)
                };
                let panels = [
                    Some(areas.title),
                    areas.overview,
                    areas.trace,
                    areas.second,
                    areas.residual,
                    areas.voters,
                    areas.parameters,
                    areas.queue,
                    areas.card,
                    areas.knobs,
                    Some(areas.toast),
                    Some(areas.footer),
                ];
                let panels: Vec<Rect> = panels.into_iter().flatten().collect();
                for (i, a) in panels.iter().enumerate() {
                    assert_eq!(whole.intersection(*a), *a, "{width}x{height}");
                    assert!(panels[i + 1..].iter().all(|b| a.intersection(*b).is_empty()), "{width}x{height}");
                }
                // A heading, three rows of curve, the rail and the axis.
                let trace = areas.trace.unwrap_or_default();
                assert!(trace.height >= 4, "{width}x{height}: {trace:?}");
            }
        }
    }
}
