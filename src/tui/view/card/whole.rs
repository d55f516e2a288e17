//! The card with room: a line for each fact, and a table of the samples around.

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::style::Style;
use ratatui::text::{Line, Span};
use ratatui::widgets::Widget;

use super::super::super::action::Action;
use super::super::super::model::Model;
use super::super::super::smoothing::Smoothed;
use super::super::super::update::mark_at;
use super::super::compare::votes_words;
use super::super::parameters::wrapped;
use super::super::queue::ratio_text;
use super::super::{short, thousands};
use super::{state_word, why, written};
use crate::method::{Direction, Verdict};
use crate::plot::{Drawn, state};
use crate::session::Mark;
use crate::track::{Series, printable};

/// Rows from which on the card is drawn so.
pub(super) const LEAST: u16 = 12;

/// Samples on each side in the table, at most.
const AROUND: usize = 12;

type Fact = (&'static str, String, Style);

pub(super) fn draw(model: &Model, series: &Series<'_>, mark: Option<&Mark>, body: Rect, buffer: &mut Buffer) {
    let i = model.state().cursor;
    let mut lines: Vec<Line<'static>> = facts(model, series, i, mark)
        .into_iter()
        .flat_map(|(name, value, style)| {
            let names = std::iter::once(name).chain(std::iter::repeat(""));
            let value = wrapped(&value, usize::from(body.width).saturating_sub(14).max(1));
            let line = |(name, part): (&str, String)| {
                Line::from(vec![Span::styled(format!(" {name:<12}"), model.theme.dim), Span::styled(part, style)])
            };
            names.zip(value).map(line).collect::<Vec<_>>()
        })
        .collect();
    let room = usize::from(body.height).saturating_sub(lines.len() + 2);
    if room >= 3 {
        lines.push(Line::default());
        lines.extend(table(model, series, i, ((room - 1) / 2).min(AROUND)));
    }
    for (row, line) in lines.into_iter().enumerate() {
        let row = u16::try_from(row).unwrap_or(u16::MAX);
        if row < body.height {
            line.render(Rect { y: body.y + row, height: 1, ..body }, buffer);
        }
    }
}

/// Everything that is known about a sample.
fn facts(model: &Model, series: &Series<'_>, i: usize, mark: Option<&Mark>) -> Vec<Fact> {
    let theme = &model.theme;
    let row = format!("#{} of {}", series.row(i) + 1, thousands(model.track.rows));
    let mut facts = vec![
        ("row", row, theme.title),
        ("time", model.track.time.full_label(series.t[i]), theme.text),
        ("raw", short(series.y[i]), theme.text),
    ];
    if let Some(drawn) = &model.state().drawn {
        judgement(model, drawn, series, i, &mut facts);
        let repair = crate::repair::chosen(&drawn.outcome.detection.setup.repair);
        let mut text = written(model, drawn, series, i, mark, false);
        if drawn.outcome.fix(i).is_some() {
            text.push_str(&format!(" (repair {})", repair.id));
        }
        facts.push(("will be", text, theme.text));
        smoothed(model, i, &mut facts);
    }
    let decided = match (mark.and_then(|m| m.ruling), why(model)) {
        (Some(ruling), Some(why)) => format!("{}, {why}", ruling.verdict().word()),
        (_, Some(why)) => why,
        _ => format!(
            "undecided: {} accepts, {} rejects, {} flags by hand",
            model.key(Action::Accept),
            model.key(Action::Reject),
            model.key(Action::ByHand)
        ),
    };
    facts.push(("decided", decided, theme.text));
    if let Some(said) = mark.filter(|m| m.conflict()).and_then(|m| m.said) {
        let text = format!("the method said {} when this was decided", said.word());
        facts.push(("conflict", text, theme.warning));
    }
    if let Some((count, names, style)) = votes_words(model, i) {
        facts.push(("all methods", format!("{count}{names}"), style));
    }
    let elsewhere = elsewhere(model, series.row(i));
    if !elsewhere.is_empty() {
        facts.push(("elsewhere", elsewhere, theme.text));
    }
    facts
}

/// What smoothing the result has shown: of the sample where the filtered track is on, and of the whole channel.
fn smoothed(model: &Model, i: usize, facts: &mut Vec<Fact>) {
    let Some(smoothed) = Smoothed::of(model) else { return };
    if let Some(track) = &smoothed.track {
        let at = |values: &[f64]| values.get(i).copied().filter(|v| v.is_finite()).map(short);
        let text = match (at(&track.values.value), at(&track.values.deviation)) {
            (Some(value), Some(deviation)) => format!("{value}, standard deviation {deviation}"),
            (Some(value), None) => value,
            (None, _) => "none".into(),
        };
        facts.push(("filtered", text, model.theme.text));
    }
    if let Some(residual) = smoothed.residual {
        let text =
            format!("{} before the repair, {} after (whole channel)", short(residual.before), short(residual.after));
        facts.push(("residual", text, model.theme.text));
    }
}

/// What the method says, and with what.
fn judgement(model: &Model, drawn: &Drawn, series: &Series<'_>, i: usize, facts: &mut Vec<Fact>) {
    let theme = &model.theme;
    let judged = &drawn.outcome.detection.judged;
    let written = |v: f64| short(drawn.outcome.detection.written(v));
    let number = |values: &[f64]| values.get(i).copied().filter(|v| v.is_finite()).map_or("none".into(), written);
    facts.push(("expected", number(judged.expected()), theme.text));
    let tolerance = judged.tolerance(i).filter(|h| *h > 0.0).map_or("none".into(), short);
    facts.push(("tolerance", tolerance, theme.text));
    if let Some(ratio) = drawn.ratio(series, i) {
        let mut text = format!("{} tolerances", ratio_text(ratio));
        if drawn.in_scales() {
            let sigma = ratio_text(ratio * drawn.threshold);
            text.push_str(&format!(", {sigma} sigma (threshold {})", short(drawn.threshold)));
        }
        facts.push(("ratio", text, theme.text));
    }
    let verdict = judged.verdict().get(i).copied().unwrap_or(Verdict::Missing);
    let detection = &drawn.outcome.detection;
    match detection.objected(i) {
        Some(objected) => {
            let text = format!("{} says {}: {}", objected.by, verdict.word(), objected.evidence);
            facts.push(("check", text, theme.text));
            let id = detection.setup.method.about().id;
            facts.push(("method", format!("{id} is not shown this sample"), theme.text));
        }
        None => {
            let id = detection.setup.method.about().id;
            facts.push(("method", format!("{id} says {}", verdict.word()), theme.text));
        }
    }
    if let Some(d) = judged.directions().get(i) {
        for (name, direction) in [("forward", d.forward), ("backward", d.backward)] {
            facts.push((name, direction.map_or("not judged".into(), |d| Direction::word(d).to_owned()), theme.text));
        }
    }
    let run = match model.group(i).map(|g| g.positions()) {
        Some(run) if run.len() > 1 => {
            let (first, last) = (series.row(run.start) + 1, series.row(run.end - 1) + 1);
            format!("{} of a run of {}, rows {first} to {last}", i - run.start + 1, run.len())
        }
        Some(_) => "isolated".into(),
        None => "none".into(),
    };
    facts.push(("run", run, theme.text));
    if judged.restarts().iter().any(|r| r.at == i) {
        let text = "the model restarted here: a manoeuvre, or a long run of outliers";
        facts.push(("restart", text.into(), theme.warning));
    }
}

/// The other channels in the same row.
fn elsewhere(model: &Model, row: usize) -> String {
    let mut words = Vec::new();
    for (plan, other) in model.channels.iter().enumerate().filter(|(plan, _)| *plan != model.shown) {
        let channel = &model.track.channels[other.channel];
        let series = other.samples.series(channel, &model.track.time);
        let name = printable(&channel.name);
        let Some(at) = series.position(row) else {
            words.push(format!("{name} missing"));
            continue;
        };
        let decision = u32::try_from(row).ok().and_then(|r| model.session.plans[plan].decisions.get(r));
        let judged = other.drawn.as_ref().map(|d| d.outcome.verdict(at).word());
        let said = decision.map(|d| d.ruling.verdict().word()).or(judged).unwrap_or("not judged yet");
        words.push(format!("{name} {} {said}", short(series.y[at])));
    }
    words.join(" · ")
}

/// The samples around, with what is said of them.
fn table(model: &Model, series: &Series<'_>, i: usize, around: usize) -> Vec<Line<'static>> {
    let theme = &model.theme;
    let head = format!("  {:>9} {:>13} {:>12} {:>12} {:>7}", "row", "time", "raw", "expected", "ratio");
    let mut lines = vec![Line::styled(head, theme.dim)];
    let drawn = model.state().drawn.as_deref();
    let from = i.saturating_sub(around);
    for k in from..(i + around + 1).min(series.len()) {
        let lost = if k > from { series.lost_before(k) } else { 0 };
        let lost = if lost > 0 { format!("  {lost} lost before") } else { String::new() };
        let here = if k == i { '>' } else { ' ' };
        let expected = drawn.and_then(|d| d.outcome.detection.judged.expected().get(k).copied());
        let expected = expected.filter(|e| e.is_finite()).map_or_else(|| "-".into(), short);
        let ratio = drawn.and_then(|d| d.ratio(series, k)).map_or_else(|| "-".into(), ratio_text);
        let time = model.track.time.label(series.t[k], 2);
        let text =
            format!(" {here}{:>9} {time:>13} {:>12} {expected:>12} {ratio:>7} ", series.row(k) + 1, short(series.y[k]));
        let shown = mark_at(model, k).as_ref().and_then(state);
        let mark = shown.map_or(String::new(), |s| format!("{} {}", model.glyphs.flag(s), state_word(s)));
        let style = if k == i { theme.focus } else { theme.text };
        lines.push(Line::from(vec![
            Span::styled(text, style),
            Span::styled(mark, shown.map_or(theme.dim, |s| theme.flag(s))),
            Span::styled(lost, theme.dim),
        ]));
    }
    lines
}
