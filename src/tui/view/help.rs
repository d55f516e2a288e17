//! The help: the keys in force, commands, jumps, and what marks and styles mean; narrowed by what is typed.

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::style::Style;
use ratatui::text::{Line, Span};
use ratatui::widgets::Widget;
use tui_input::Input;
use unicode_width::UnicodeWidthStr;

use super::super::keys::Context;
use super::super::model::Model;
use super::super::plot::FlagState;
use super::super::update::{COMMANDS, FORMS};
use super::overlay::{popup, rows, typed};

/// Columns of keys.
const KEYS: usize = 18;
/// From this width on, the names of actions stand beside what they do.
const NAMED: u16 = 100;

pub(super) fn draw(model: &Model, filter: &Input, from: usize, area: Rect, buffer: &mut Buffer) {
    let width = if area.width >= NAMED + 8 { NAMED } else { 78 };
    let inside = popup(model, "keys and commands", (width, area.height), area, buffer);
    let head = Rect { height: inside.height.min(1), ..inside };
    typed(model, "filter: ", filter, inside.width).render(head, buffer);
    let body = Rect { y: inside.y + head.height, height: inside.height - head.height, ..inside };
    let lines = lines(model, filter.value(), usize::from(body.width));
    let last = lines.len().saturating_sub(usize::from(body.height));
    rows(model, lines, from.min(last), body, buffer);
}

/// One line of the help.
struct Entry {
    keys: String,
    style: Style,
    help: String,
    /// The name of the action, for the palette and the configuration.
    name: String,
}

impl Entry {
    fn fits(&self, heading: &str, words: &[String]) -> bool {
        let text = format!("{heading} {} {} {}", self.keys, self.help, self.name).to_lowercase();
        words.iter().all(|word| text.contains(word.as_str()))
    }

    fn line(&self, model: &Model, width: usize) -> Line<'static> {
        let theme = &model.theme;
        let blanks = KEYS.saturating_sub(self.keys.width());
        let mut spans = vec![
            Span::raw("  "),
            Span::styled(self.keys.clone(), self.style),
            Span::styled(format!("{:blanks$} {}", "", self.help), theme.text),
        ];
        let used: usize = spans.iter().map(Span::width).sum();
        let name = if width >= usize::from(NAMED) - 4 { self.name.as_str() } else { "" };
        if !name.is_empty() && used + name.width() + 2 <= width {
            let gap = width - used - name.width();
            spans.push(Span::styled(format!("{:gap$}{name}", ""), theme.dim));
        }
        Line::from(spans)
    }
}

/// The lines that hold every word that was typed.
fn lines(model: &Model, filter: &str, width: usize) -> Vec<Line<'static>> {
    let words: Vec<String> = filter.split_whitespace().map(str::to_lowercase).collect();
    let mut lines = Vec::new();
    let mut group = |heading: &str, entries: Vec<Entry>| {
        let entries: Vec<Entry> = entries.into_iter().filter(|e| e.fits(heading, &words)).collect();
        if entries.is_empty() {
            return;
        }
        if !lines.is_empty() {
            lines.push(Line::default());
        }
        lines.push(Line::styled(heading.to_owned(), model.theme.title));
        lines.extend(entries.iter().map(|e| e.line(model, width)));
    };
    for context in Context::ALL {
        group(context.heading(), of_keys(model, context));
    }
    let key = model.theme.key;
    let plain = |keys: String, help: &str| Entry { keys, style: key, help: help.to_owned(), name: String::new() };
    group("mouse (M gives it to the terminal)", MOUSE.iter().map(|(k, h)| plain((*k).to_owned(), h)).collect());
    group("marks", marks(model));
    group("styles", styles(model));
    let command = |c: &super::super::update::Command| {
        plain(format!(":{} {}", c.name.replace('|', " :"), c.takes).trim_end().to_owned(), c.help)
    };
    group("commands", COMMANDS.iter().map(command).collect());
    group("jumps after /", FORMS.iter().map(|(form, help)| plain((*form).to_owned(), help)).collect());
    if lines.is_empty() {
        lines.push(Line::styled("no match; type fewer letters", model.theme.dim));
    }
    lines
}

/// What the mouse does.
const MOUSE: &[(&str, &str)] = &[
    ("click", "cursor to the flag near it, else the sample; focus the panel"),
    ("click in the queue", "go to the flag; a second click zooms to it"),
    ("click in a list", "choose the row; a second click does what Enter does, or changes the row"),
    ("click on a rail", "go to the first flag of the column; on the overview: go there"),
    ("wheel", "zoom at the pointer; walk the queue or a list; change the active parameter"),
    ("Shift-wheel", "pan"),
    ("drag", "select a range, as v does"),
    ("right drag", "move the record"),
];

/// The rows of a context, those without keys too: the palette runs them.
fn of_keys(model: &Model, context: Context) -> Vec<Entry> {
    let entry = |b: &super::super::keys::Bound| {
        let keys = if b.keys.is_empty() { format!(":{}", b.row.action.name()) } else { b.shown() };
        Entry { keys, style: model.theme.key, help: b.row.help.to_owned(), name: b.row.action.name() }
    };
    model.keys.of(context).map(entry).collect()
}

fn marks(model: &Model) -> Vec<Entry> {
    let (theme, glyphs) = (&model.theme, model.glyphs);
    let entry =
        |keys: String, style: Style, help: &str| Entry { keys, style, help: help.to_owned(), name: String::new() };
    let mut marks: Vec<Entry> = FlagState::BY_URGENCY
        .into_iter()
        .map(|s| entry(glyphs.flag(s).to_string(), theme.flag(s), super::card::state_word(s)))
        .collect();
    let beyond = format!("{} {}", glyphs.beyond(true, false), glyphs.beyond(false, true));
    let rail: String = [0, 1, 3, 9, 31, 99, 100].map(|n| glyphs.rail(n)).iter().collect();
    marks.push(entry(beyond, theme.flag_unreviewed, "a sample off the scale (y changes the scale)"));
    marks.push(entry(
        rail,
        theme.flag_unreviewed,
        "the rail: flags in a column; none, 1, 2 to 3, to 9, to 31, to 99, more",
    ));
    marks.push(entry("!".into(), theme.warning, "decisions that the method now contradicts"));
    marks.push(entry("[+]".into(), theme.warning, "something is not saved"));
    marks
}

/// What the styles of the plots mean, each in its own.
fn styles(model: &Model) -> Vec<Entry> {
    let (theme, glyphs) = (&model.theme, model.glyphs);
    let dots: String = [glyphs.dots(0x24), glyphs.dots(0x24), glyphs.dots(0x24)].iter().collect();
    let entry =
        |keys: String, style: Style, help: &str| Entry { keys, style, help: help.to_owned(), name: String::new() };
    vec![
        entry(dots.clone(), theme.raw, "the samples that are kept"),
        entry(dots.clone(), theme.expected, "the value that the method expects"),
        entry(dots.clone(), theme.band, "the edges of its tolerance"),
        entry(dots.clone(), theme.repaired, "repaired values"),
        entry(dots, theme.filtered, "the track that the method's model makes of the samples (:layers +filtered)"),
        entry(glyphs.threshold().to_string().repeat(3), theme.threshold, "the residual from which samples are flagged"),
        entry(glyphs.bar(8).to_string().repeat(3), theme.over, "residuals beyond it"),
        entry(" x ".into(), theme.cursor, "the cursor"),
        entry(glyphs.viewport().to_string(), theme.viewport, "in the overview: the part that the trace shows"),
    ]
}
