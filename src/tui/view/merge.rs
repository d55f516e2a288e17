//! The question whose decision holds: that of the session, or that of a journal which is taken in.

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::text::{Line, Span};

use super::super::model::{Merging, Model};
use super::overlay::{popup, rows};
use super::parameters::wrapped;
use crate::param::Settings;
use crate::review::Decision;
use crate::session::Setup;
use crate::session::journal::Disputed;
use crate::track::printable;

/// Columns of the question.
const WIDTH: u16 = 74;

pub(super) fn draw(model: &Model, merging: &Merging, area: Rect, buffer: &mut Buffer) {
    let title = format!("conflict {} of {}", merging.at + 1, merging.conflicts.len());
    let lines = lines(model, merging, usize::from(WIDTH.min(area.width)).saturating_sub(4).max(1));
    let height = u16::try_from(lines.len() + 2).unwrap_or(u16::MAX);
    let inside = popup(model, &title, (WIDTH, height), area, buffer);
    rows(model, lines, 0, inside, buffer);
}

fn lines(model: &Model, merging: &Merging, width: usize) -> Vec<Line<'static>> {
    let theme = &model.theme;
    let (Some(conflict), Some(found)) = (merging.conflicts.get(merging.at), merging.offered.first()) else {
        return Vec::new();
    };
    let channel = model.session.plans.get(conflict.plan).map(|p| printable(&p.channel)).unwrap_or_default();
    let (what, here, there) = match &conflict.about {
        Disputed::Decision { row, here, there } => {
            let what = format!("Row {} of {channel} is decided on in two ways.", row + 1);
            (what, decision(here.as_ref()), decision(there.as_ref()))
        }
        Disputed::Setup { here, there } => {
            let (own, other) = differing(here, there);
            (format!("The settings of {channel} are not the same."), own, other)
        }
    };
    let mut lines = vec![Line::styled(what, theme.warning)];
    for (side, words) in [("here", here), ("there", there)] {
        let text = wrapped(&words, width.saturating_sub(7).max(1));
        for (i, row) in text.into_iter().enumerate() {
            let side = if i == 0 { side } else { "" };
            lines.push(Line::from(vec![Span::styled(format!("{side:7}"), theme.dim), Span::styled(row, theme.text)]));
        }
    }
    lines.push(Line::styled(format!("(there: the unsaved work of {})", found.when), theme.dim));
    lines.push(Line::default());
    let key = |k: &str, words: &str| {
        Line::from(vec![Span::styled(format!("{k:5}"), theme.key), Span::styled(words.to_owned(), theme.text)])
    };
    lines.push(key("h", "keep what is here"));
    lines.push(key("t", "take what is there"));
    lines.push(key("H T", "the same for all that are left"));
    lines.push(key("Esc", "take nothing in for now"));
    lines
}

fn decision(decision: Option<&Decision>) -> String {
    match decision {
        None => "nothing is decided".into(),
        Some(d) if d.note.is_empty() => d.ruling.verdict().word().into(),
        Some(d) => format!("{}: {}", d.ruling.verdict().word(), printable(&d.note)),
    }
}

/// Each setup in words: the method, and what differs from the other one.
fn differing(a: &Setup, b: &Setup) -> (String, String) {
    (words(a, b), words(b, a))
}

fn words(setup: &Setup, other: &Setup) -> String {
    let mut words = vec![setup.method.about().id.to_owned()];
    words.extend(setup.rate.iter().map(|rate| format!("rate {}", printable(rate))));
    let of = |own: &Settings, other: &Settings| -> Vec<String> {
        let theirs: Vec<String> = other.iter().map(|(p, v)| format!("{} {v}", p.key)).collect();
        own.iter().map(|(p, v)| format!("{} {v}", p.key)).filter(|text| !theirs.contains(text)).collect()
    };
    words.extend(of(&setup.settings, &other.settings));
    words.extend(of(&setup.repair, &other.repair));
    words.join(", ")
}
