//! A against B, and all methods at once, in words.

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::style::Style;
use ratatui::text::{Line, Span};
use ratatui::widgets::Widget;

use super::super::action::Action;
use super::super::model::{Model, Pinned};
use super::parameters::wrapped;
use super::{clear, fit, thousands};
use crate::param::{Settings, Value};
use crate::plot::Side;
use crate::session::Ballot;

/// How many samples only A, only B and both flag, for the heading of the trace.
pub(super) fn counts(model: &Model) -> Option<String> {
    let pinned = model.state().pinned.as_deref()?;
    let Some(sides) = &pinned.sides else { return Some("A pinned, B without a result  ".to_owned()) };
    let [a, b, both] = sides.counts().map(thousands);
    Some(format!("A only {a}, B only {b}, both {both}  "))
}

/// Who of A and B flags a sample, for the card.
pub(super) fn who(model: &Model, position: usize) -> Option<&'static str> {
    let sides = model.state().pinned.as_deref()?.sides.as_ref()?;
    Some(match sides.side(position)? {
        Side::OnlyA => "A flags it, B does not",
        Side::OnlyB => "B flags it, A does not",
        Side::Both => "A and B flag it",
    })
}

/// Rows for the parameter panel: the counts, and what A has otherwise.
pub(super) fn rows(model: &Model) -> Option<Vec<String>> {
    let pinned = model.state().pinned.as_deref()?;
    let mut rows = vec![String::new(), "A is pinned; g b returns to it".to_owned()];
    if let Some(sides) = &pinned.sides {
        let [a, b, both] = sides.counts().map(thousands);
        rows.push(format!("A only {a}   B only {b}   both {both}"));
    }
    rows.extend(differences(model, pinned));
    Some(rows)
}

/// The settings of A and B that differ.
fn differences(model: &Model, pinned: &Pinned) -> Vec<String> {
    let (a, b) = (&pinned.setup, &model.plan().setup);
    let row = |name: &str, a: &str, b: &str| format!("{name:14} A {a}  B {b}");
    let mut rows = Vec::new();
    let ids = [a, b].map(|setup| setup.method.about().id);
    if ids[0] != ids[1] {
        rows.push(row("method", ids[0], ids[1]));
    }
    if a.rate != b.rate {
        let name = |rate: &Option<String>| rate.as_deref().map_or_else(|| "(none)".to_owned(), crate::track::printable);
        rows.push(row("rate", &name(&a.rate), &name(&b.rate)));
    }
    let of = |name: fn(&'static str) -> &'static str, a: &Settings, b: &Settings| {
        let other = |key: &str| b.get(key);
        let differs = |(p, x): (&'static crate::param::Param, Value)| {
            let y = other(p.key).filter(|y| *y != x)?;
            Some(row(name(p.key), &x.to_string(), &y.to_string()))
        };
        a.iter().filter_map(differs).collect::<Vec<_>>()
    };
    rows.extend(of(|key| key, &a.settings, &b.settings));
    rows.extend(of(|key| if key == "method" { "repair" } else { key }, &a.repair, &b.repair));
    if rows.is_empty() {
        rows.push("the settings of A and B are the same".to_owned());
    }
    rows
}

/// How many methods flag a sample, which, and how that is shown; none before they were asked.
pub(super) fn votes_words(model: &Model, position: usize) -> Option<(String, String, Style)> {
    let ballot = &model.state().consensus.as_deref()?.ballot;
    let (votes, of) = (ballot.votes(position), ballot.methods());
    let style = if votes >= ballot.half() { model.theme.over } else { model.theme.text };
    let names = who_votes(ballot, position).map_or_else(String::new, |names| format!(": {names}"));
    Some((format!("{votes} of {of} methods flag it"), names, style))
}

/// The methods that flag a sample, or all but those that do not where that list is shorter; none where nobody does.
fn who_votes(ballot: &Ballot, position: usize) -> Option<String> {
    match (ballot.voters(position), ballot.others(position)) {
        (voters, _) if voters.is_empty() => None,
        (_, others) if others.is_empty() => Some("all".to_owned()),
        (voters, others) if voters.len() <= others.len() => Some(voters.join(", ")),
        (_, others) => Some(format!("all but {}", others.join(", "))),
    }
}

/// The methods that flag the sample under the cursor, below the picture of all methods.
pub(super) fn voters(model: &Model, area: Rect, buffer: &mut Buffer) {
    clear(area, buffer);
    let Some(consensus) = model.state().consensus.as_deref() else { return };
    let row = model.series().row_of(model.state().cursor).map_or(String::new(), |row| format!("#{} ", row + 1));
    let names = match who_votes(&consensus.ballot, model.state().cursor) {
        Some(names) => format!("{row}flagged by {names}"),
        None => format!("{row}flagged by no method"),
    };
    let width = usize::from(area.width).saturating_sub(2).max(1);
    let mut lines = wrapped(&names, width);
    let height = usize::from(area.height);
    if lines.len() > height {
        let rest = lines.drain(height.saturating_sub(1)..).collect::<Vec<_>>().join(" ");
        lines.push(fit(&rest, width));
    }
    for (line, row) in lines.into_iter().zip(area.rows()) {
        Line::styled(format!(" {line}"), model.theme.dim).render(row, buffer);
    }
}

/// How many methods flag a sample, and which, for the card: up to two lines.
pub(super) fn votes(model: &Model, position: usize, width: u16) -> Vec<Line<'static>> {
    let Some((head, names, style)) = votes_words(model, position) else { return Vec::new() };
    let theme = &model.theme;
    let lines = wrapped(&format!("{head}{names}"), usize::from(width).saturating_sub(3));
    let line = |(i, text): (usize, String)| match text.strip_prefix(&head) {
        Some(rest) if i == 0 => {
            Line::from(vec![Span::styled(format!(" {head}"), style), Span::styled(rest.to_owned(), theme.dim)])
        }
        _ => Line::styled(format!(" {text}"), theme.dim),
    };
    lines.into_iter().take(2).enumerate().map(line).collect()
}

/// The heading of the picture of all methods: how far they have been asked, the votes, and those at the cursor.
pub(super) fn consensus_words(model: &Model) -> Vec<Span<'static>> {
    let (theme, state) = (&model.theme, model.state());
    if let Some(polling) = model.polling.as_ref().filter(|p| p.plan == model.shown) {
        let text = format!(
            "running all methods: {} of {} done ({} stops)  ",
            polling.done,
            polling.of,
            model.key(Action::Back)
        );
        return vec![Span::styled(text, theme.warning)];
    }
    let Some(consensus) = state.consensus.as_deref() else {
        return vec![Span::styled("not computed: press C twice to run all methods  ", theme.warning)];
    };
    let ballot = &consensus.ballot;
    let (votes, of) = (ballot.votes(state.cursor), ballot.methods());
    let style = if votes >= ballot.half() { theme.over } else { theme.dim };
    let mut words = vec![
        Span::styled(format!("{votes} of {of} methods agree here"), style),
        Span::styled(format!(" (majority {})  ", ballot.half()), theme.dim),
    ];
    if !consensus.left_out.is_empty() {
        let ids: Vec<&str> = consensus.left_out.iter().map(|(id, _)| *id).collect();
        words.push(Span::styled(format!("without {}  ", ids.join(", ")), theme.dim));
    }
    words
}
