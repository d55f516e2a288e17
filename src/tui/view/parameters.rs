//! Method and parameters: the panel, and the one line that stands in for it.

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::text::{Line, Span};
use ratatui::widgets::Widget;

use super::super::action::{Action, Panel};
use super::super::advice::{Advice, Step};
use super::super::model::{Knob, Model};
use super::super::update::{tune, value_text};
use super::super::words::{counted, key};
use super::{clear, compare, fit, heading, thousands};
use crate::param::Value;
use crate::plot::Drawn;
use crate::session::sweep::Threshold;
use crate::track::printable;

/// The rows of the panel below its heading.
pub(in crate::tui) struct Rows {
    /// What stands below the parameters; true for a warning.
    notes: Vec<(String, bool)>,
    /// Rows above the notes.
    room: usize,
    /// The index of the first parameter in sight.
    pub(in crate::tui) from: usize,
    /// How many parameters are in sight.
    pub(in crate::tui) visible: usize,
}

impl Rows {
    /// The rows in `body`: counts, help and advice below as many parameters as there is room for, the active one among
    /// them.
    pub(in crate::tui) fn of(model: &Model, body: Rect) -> Self {
        let knobs = model.knobs().len();
        let active = model.state().knob.min(knobs.saturating_sub(1));
        let height = usize::from(body.height);
        let width = usize::from(body.width).saturating_sub(1);
        // The first block (the counts) always shows; the others where they fit whole, once the parameters have their
        // rows.
        let least = if model.focus == Panel::Parameters { height * 3 / 5 } else { height * 9 / 20 };
        let spare = height.saturating_sub(knobs).max(least);
        let mut notes: Vec<(String, bool)> = Vec::new();
        for (index, block) in blocks(model, width).into_iter().enumerate() {
            if index == 0 || notes.len() + block.len() <= spare {
                notes.extend(block);
            }
        }
        // Facts take what is left, and no parameter its row.
        let calibration = model.state().drawn.as_ref().and_then(|d| d.outcome.detection.calibration.as_deref());
        let record = calibration.map(|found| format!("the record: {}", found.words(&model.channel().unit).join("; ")));
        let facts = model.plan().setup.method.notes(&model.plan().setup.settings);
        for fact in record.into_iter().chain(facts) {
            let block = wrapped(&fact, width);
            if notes.len() + block.len() + knobs <= height {
                notes.extend(block.into_iter().map(|line| (line, false)));
            }
        }
        notes.truncate(height.saturating_sub(4));
        let room = height - notes.len();
        // Parameters that do not fit scroll; the last row says how many are out of sight.
        let visible = if knobs > room { room.saturating_sub(1) } else { room };
        Self { notes, room, from: (active + 1).saturating_sub(visible), visible }
    }
}

pub(super) fn draw(model: &Model, area: Rect, buffer: &mut Buffer) {
    clear(area, buffer);
    let body = heading(model, Panel::Parameters, &[], area, buffer);
    let theme = &model.theme;
    let knobs = model.knobs();
    let active = model.state().knob.min(knobs.len().saturating_sub(1));
    let Rows { notes, room, from, visible } = Rows::of(model, body);
    let setup = &model.plan().setup;
    let shown: Vec<(usize, &Knob)> = knobs.iter().enumerate().skip(from).take(visible).collect();
    for (row, (index, knob)) in shown.into_iter().enumerate() {
        let value = printable(&value_text(setup, *knob));
        let changed = match knob {
            Knob::Detection(p) => setup.settings.get(p.key) != Some(p.default),
            Knob::Repair(p) => setup.repair.get(p.key) != Some(p.default),
            Knob::OfCheck(i, p) => {
                setup.preparation.checks.get(*i).is_some_and(|c| c.settings.get(p.key) != Some(p.default))
            }
            _ => false,
        };
        let name_style = if knob.begins_group() { theme.title } else { theme.dim };
        let value = if index == active { format!("‹ {value} ›") } else { format!("  {value}") };
        let value_style = if index == active {
            theme.focus
        } else if changed {
            theme.title
        } else {
            theme.text
        };
        let unit = knob.param().map_or("", |p| tune::value(setup, *knob).map_or(p.unit, |v| p.unit_of(v)));
        let line = Line::from(vec![
            Span::styled(format!("{:15}", fit(knob.name(), 14)), name_style),
            Span::styled(value, value_style),
            Span::styled(format!(" {unit}"), theme.dim),
        ]);
        put(line, row, body, buffer);
    }
    if knobs.len() > room {
        let hidden = knobs.len() - visible;
        put(Line::styled(format!("{:15}  … {hidden} more", ""), theme.dim), visible, body, buffer);
    }
    for (i, (text, warn)) in notes.into_iter().enumerate() {
        let style = if warn { theme.warning } else { theme.dim };
        put(Line::styled(text, style), room + i, body, buffer);
    }
}

fn put(line: Line<'_>, row: usize, body: Rect, buffer: &mut Buffer) {
    let row = u16::try_from(row).unwrap_or(u16::MAX);
    if row < body.height {
        line.render(Rect { y: body.y + row, height: 1, ..body }, buffer);
    }
}

/// Blocks of rows of at most `width` columns, the most wanted first: counts, the help of the active parameter while the
/// panel has the keyboard, warnings. True for a warning.
fn blocks(model: &Model, width: usize) -> Vec<Vec<(String, bool)>> {
    let mut blocks = Vec::new();
    let block = |text: &str, warn: bool| wrapped(text, width).into_iter().map(|line| (line, warn)).collect::<Vec<_>>();
    let setup = &model.plan().setup;
    let drawn = model.state().drawn.as_ref();
    blocks.extend(drawn.map(|drawn| flagged(model, drawn)));
    let pinned = compare::rows(model);
    blocks.extend(pinned.map(|rows| rows.into_iter().map(|row| (fit(&row, width), false)).collect()));
    let advice = model.advice().map(|advice| advice_rows(model, advice, width));
    let about_it = model.advice().is_some_and(|advice| model.knob().name() == advice.sweep.key);
    if about_it {
        blocks.extend(advice.clone());
    }
    if model.focus == Panel::Parameters
        && let Some(p) = model.knob().param()
    {
        let paper = p.paper.map_or(String::new(), |paper| format!(", paper {}", paper.value));
        let mut help = vec![(String::new(), false)];
        help.extend(block(&format!("{} [{}], default {}{paper}", p.help, p.range(), p.default), false));
        blocks.push(help);
    }
    let fresh = drawn.filter(|_| !model.state().stale);
    let warnings = fresh.map_or_else(|| setup.method.warnings(&setup.settings), |drawn| drawn.outcome.warnings());
    blocks.extend(warnings.iter().map(|warning| block(warning, true)));
    blocks.extend(drawn.map(|drawn| counts(drawn, width)));
    if !about_it {
        blocks.extend(advice);
    }
    blocks
}

/// The counts along the multiplier as a small curve, and what it suggests. The mark under it is where the multiplier is.
fn advice_rows(model: &Model, advice: &Advice, width: usize) -> Vec<(String, bool)> {
    let sweep = &advice.sweep;
    let columns = width.min(sweep.points.len()).max(1);
    let at = |column: usize| &sweep.points[column * (sweep.points.len() - 1) / columns.max(2).saturating_sub(1)];
    let most = sweep.points.iter().map(|p| p.flagged).max().unwrap_or(0);
    // Counts span decades: the height is that of the logarithm.
    #[expect(clippy::cast_precision_loss, reason = "counts are far below 2^53")]
    let height = |flagged: usize| {
        let share = (flagged as f64 + 1.0).ln() / (most as f64 + 1.0).ln().max(f64::MIN_POSITIVE);
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "between 0 and 8")]
        let eighths = (share * 8.0).round() as u8;
        if flagged == 0 { ' ' } else { model.glyphs.bar(eighths.clamp(1, 8)) }
    };
    let curve: String = (0..columns).map(|c| height(at(c).flagged)).collect();
    let now = model.plan().setup.settings.get(sweep.key);
    let now = now.and_then(|v| if let Value::Real(x) = v { Some(x) } else { None }).unwrap_or(0.0);
    let mark = (0..columns).take_while(|c| at(*c).value <= now).count().saturating_sub(1);
    let ends = [sweep.points.first(), sweep.points.last()].map(|p| p.map_or(0.0, |p| p.value));
    let scale = format!("{:>mark$}^", "");
    let words = match sweep.threshold {
        Threshold::Suggested { suggestion, range } => {
            let f = key(&model.keys, Action::Suggested);
            format!("{f} sets {} to {suggestion}: {range} from {:.1} to {:.1}", sweep.key, range.from, range.to)
        }
        Threshold::None { no_suggestion } => no_suggestion.to_string(),
    };
    let head = format!("flagged for {} from {} to {}", sweep.key, ends[0], ends[1]);
    let mut rows = vec![(head, false), (curve, false), (scale, false)];
    rows.extend(wrapped(&words, width).into_iter().map(|line| (line, false)));
    rows
}

/// How many samples are flagged, and how many were with another value of the active parameter.
fn flagged(model: &Model, drawn: &Drawn) -> Vec<(String, bool)> {
    let n = drawn.outcome.counts;
    #[expect(clippy::cast_precision_loss, reason = "counts are far below 2^53")]
    let share = if n.present > 0 { 100.0 * n.flagged as f64 / n.present as f64 } else { 0.0 };
    let mut lines = vec![String::new(), format!("flagged        {} ({share:.2} %)", thousands(n.flagged))];
    lines.extend(steps(model, drawn));
    lines.into_iter().map(|line| (line, false)).collect()
}

/// How many samples are what.
fn counts(drawn: &Drawn, width: usize) -> Vec<(String, bool)> {
    let n = drawn.outcome.counts;
    let mut lines = vec![format!("{} isolated, {}", n.isolated, counted(n.patches, "run"))];
    let mut rest = vec![format!("repaired {}, removed {}", n.repaired, n.removed)];
    let restarts = drawn.outcome.detection.judged.restarts().len();
    for (count, word) in
        [(n.suspects, "suspect"), (n.unchecked, "unchecked"), (n.filled, "filled"), (restarts, "restarts")]
    {
        if count > 0 {
            rest.push(format!("{word} {}", thousands(count)));
        }
    }
    lines.extend(wrapped(&rest.join(", "), width));
    lines.into_iter().map(|line| (line, false)).collect()
}

/// How many flags there are one step of the active parameter up and down from the result on the screen, and how many of
/// them come and go.
fn steps(model: &Model, drawn: &Drawn) -> Vec<String> {
    let flagged = drawn.outcome.counts.flagged;
    let Knob::Detection(param) = model.knob() else { return Vec::new() };
    let Some(now) = drawn.outcome.detection.setup.settings.get(param.key) else { return Vec::new() };
    let decisions = &model.plan().decisions;
    let known = model.steps();
    let row = |steps: i64, step: Option<&Step>| {
        let value = param.step(now, steps);
        let counts = step.map_or_else(
            || "…".to_owned(),
            |step| {
                let (gained, lost) = step.counts(decisions);
                let there = (flagged + gained).saturating_sub(lost);
                format!("{} (+{gained} −{lost})", thousands(there))
            },
        );
        (value != now).then(|| format!("{:<15}{counts}", fit(&format!("{} {value}", param.key), 14)))
    };
    let up = known.and_then(|s| s.up.as_ref());
    let down = known.and_then(|s| s.down.as_ref());
    [row(1, up), row(-1, down)].into_iter().flatten().collect()
}

/// The same in a few characters, for the line.
fn steps_in_line(model: &Model) -> String {
    let Some(known) = model.steps() else { return String::new() };
    let decisions = &model.plan().decisions;
    let words = |arrow: char, step: Option<&Step>| {
        let counts = step.map(|step| step.counts(decisions));
        counts.map_or_else(String::new, |(gained, lost)| format!(" {arrow}+{gained}−{lost}"))
    };
    format!("{}{}", words('↑', known.up.as_ref()), words('↓', known.down.as_ref()))
}

/// Text broken into lines of a width.
pub(super) fn wrapped(text: &str, width: usize) -> Vec<String> {
    crate::wrapped::wrapped(text, width, ("", ""))
}

/// Method and parameters in one line, the active parameter always among them.
pub(super) fn one_line(model: &Model, area: Rect, buffer: &mut Buffer) {
    clear(area, buffer);
    let theme = &model.theme;
    let setup = &model.plan().setup;
    let knobs = model.knobs();
    let active = model.state().knob.min(knobs.len().saturating_sub(1));
    let item = |i: usize| {
        let (name, value) = (knobs[i].name(), printable(&value_text(setup, knobs[i])));
        let name = if i == 0 { String::new() } else { format!("{name} ") };
        if i == active { format!("  {name}‹{value}›") } else { format!("  {name}{value}") }
    };
    // Its place is kept while it is not known, so that nothing moves when it comes.
    let beside = format!("{:<14}", steps_in_line(model));
    let room = usize::from(area.width) >= 70 && matches!(model.knob(), Knob::Detection(_));
    let width = |i: usize| item(i).chars().count() + if i == active && room { beside.chars().count() } else { 0 };
    // As many as fit: the method, the active one and the repair before all others.
    let mut wanted = vec![0, active];
    wanted.extend(knobs.iter().position(|k| k.name() == "repair"));
    wanted.extend(1..knobs.len());
    let (mut shown, mut used) = (Vec::new(), 0);
    for i in wanted {
        if !shown.contains(&i) && (shown.len() < 2 || used + width(i) + 3 < usize::from(area.width)) {
            used += width(i);
            shown.push(i);
        }
    }
    let all = shown.len() == knobs.len();
    shown.sort_unstable();
    let span = |i: usize| {
        let style = if i == active {
            theme.focus
        } else if i == 0 {
            theme.title
        } else {
            theme.dim
        };
        Span::styled(item(i), style)
    };
    let mut spans: Vec<Span<'_>> = Vec::new();
    for i in shown {
        spans.push(span(i));
        if i == active && room {
            spans.push(Span::styled(beside.clone(), theme.dim));
        }
    }
    if !all {
        spans.push(Span::styled(" …", theme.dim));
    }
    Line::from(spans).render(area, buffer);
}
